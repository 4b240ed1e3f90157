//! WGSL from files: the ones a pass shares before its own, with what an option does not need left out.

/// A shader's text. A line `#if NAME` keeps the lines up to its `#endif` (or `#else`) where `NAME` is among `flags`, `#if !NAME` where it is not;
/// they nest. WGSL has no conditions before compilation, and what a pass does not do must not cost it an interpolated value.
pub(crate) fn assemble(files: &[&str], flags: &[&str]) -> String {
    let mut text = String::new();
    let mut kept: Vec<bool> = Vec::new();
    for line in files.iter().flat_map(|file| file.lines()) {
        let word = line.trim();
        if let Some(condition) = word.strip_prefix("#if ") {
            let (name, wanted) = condition.strip_prefix('!').map_or((condition, true), |name| (name, false));
            kept.push(flags.contains(&name) == wanted);
        } else if word == "#else" {
            if let Some(last) = kept.last_mut() {
                *last = !*last;
            }
        } else if word == "#endif" {
            kept.pop();
        } else if kept.iter().all(|&keep| keep) {
            text.push_str(line);
            text.push('\n');
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::assemble;

    #[test]
    fn conditions_nest_and_turn_round() {
        let file = "a\n#if X\nb\n#if !Y\nc\n#else\nd\n#endif\n#endif\ne";
        assert_eq!(assemble(&[file], &[]), "a\ne\n");
        assert_eq!(assemble(&[file], &["X"]), "a\nb\nc\ne\n");
        assert_eq!(assemble(&[file, "f"], &["X", "Y"]), "a\nb\nd\ne\nf\n");
    }
}
