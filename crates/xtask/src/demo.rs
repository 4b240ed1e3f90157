//! `cargo demo`: a furry bunny, from a fresh clone.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::failure::{Failure, Result};
use crate::place::Place;
use crate::process::CommandLine;
use crate::vulkan;

/// Renders `graphs/bunny.ron` with the release build of the program; `arguments` are passed on to `pelage render`.
pub(crate) fn run(place: &Place, arguments: &[String]) -> Result<()> {
    vulkan::make_sure()?;
    let (picture, arguments) = match picture_among(arguments) {
        Some(picture) => (picture, arguments.to_vec()),
        None => default_picture(place, arguments)?,
    };

    println!("building the program (release)…");
    let start = Instant::now();
    let manifest = place.at("Cargo.toml");
    let cargo = |verb: &str| {
        CommandLine::cargo().with([verb, "--release", "--locked", "--package", "pelage-cli", "--manifest-path"]).with([&manifest])
    };
    cargo("build").run()?;
    let built = start.elapsed();

    // Started where we were started, so that a path given is taken from there.
    println!("rendering graphs/bunny.ron…");
    let start = Instant::now();
    cargo("run").with(["--quiet", "--", "render"]).with([place.at("graphs/bunny.ron")]).with(arguments).run()?;
    let rendered = start.elapsed();

    let absolute = picture
        .canonicalize()
        .map_err(|cause| Failure::caused(format_args!("the program succeeded, but there is no picture at {}", picture.display()), cause))?;
    println!("built in {:.1} s, rendered in {:.1} s", built.as_secs_f64(), rendered.as_secs_f64());
    println!("the picture: {}", absolute.display());
    Ok(())
}

/// `target/demo/bunny.png` and the arguments that say so.
fn default_picture(place: &Place, arguments: &[String]) -> Result<(PathBuf, Vec<String>)> {
    let folder = place.at("target/demo");
    fs::create_dir_all(&folder).map_err(|cause| Failure::caused(format_args!("{} could not be made", folder.display()), cause))?;
    let picture = folder.join("bunny.png");
    let mut with_picture = vec!["-o".to_owned(), picture.to_string_lossy().into_owned()];
    with_picture.extend_from_slice(arguments);
    Ok((picture, with_picture))
}

/// The picture that `-o FILE`, `-oFILE`, `-o=FILE`, `--out FILE` or `--out=FILE` asks for, if any.
fn picture_among(arguments: &[String]) -> Option<PathBuf> {
    let place =
        arguments.iter().position(|argument| argument.starts_with("-o") || argument == "--out" || argument.starts_with("--out="))?;
    let attached = arguments[place].trim_start_matches("--out").trim_start_matches("-o").trim_start_matches('=');
    let file = if attached.is_empty() { arguments.get(place + 1)? } else { attached };
    Some(Path::new(file).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn among(arguments: &[&str]) -> Option<PathBuf> {
        picture_among(&arguments.iter().map(|&argument| argument.to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn the_picture_asked_for_is_found() {
        for arguments in [&["-q", "-o", "a/b.png"][..], &["-oa/b.png"], &["-o=a/b.png", "-q"], &["--out", "a/b.png"], &["--out=a/b.png"]] {
            assert_eq!(among(arguments), Some("a/b.png".into()), "{arguments:?}");
        }
        for arguments in [&["--set", "bunny.path=x.obj"][..], &[], &["--output", "picture.image"], &["-o"]] {
            assert_eq!(among(arguments), None, "{arguments:?}");
        }
    }
}
