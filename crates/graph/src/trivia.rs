//! What stands between the values of a RON text: white space, comments and commas.

/// A piece of what stands between two items of a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Token {
    /// White space within a line, or a block comment.
    Blank,
    /// The end of a line, with the comment that ends there.
    Line,
    Comma,
    /// Part of a value.
    Other,
}

/// The first token of a text that is not empty, and its bytes.
fn token(text: &str) -> (Token, usize) {
    if text.starts_with("//") {
        return text.find('\n').map_or((Token::Blank, text.len()), |end| (Token::Line, end + 1));
    }
    if text.starts_with("/*") {
        return (Token::Blank, block_comment(text));
    }
    match text.chars().next() {
        Some('\n') => (Token::Line, 1),
        Some(',') => (Token::Comma, 1),
        Some(c) if c.is_whitespace() || matches!(c, '\u{200E}' | '\u{200F}') => (Token::Blank, c.len_utf8()),
        Some(c) => (Token::Other, c.len_utf8()),
        None => (Token::Other, 0),
    }
}

/// Bytes of the block comment that the text begins with; they nest.
fn block_comment(text: &str) -> usize {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (0, 0_usize);
    while at < bytes.len() {
        match &bytes[at..] {
            [b'/', b'*', ..] => (at, depth) = (at + 2, depth + 1),
            [b'*', b'/', ..] => (at, depth) = (at + 2, depth.saturating_sub(1)),
            _ => at += 1,
        }
        if depth == 0 {
            break;
        }
    }
    at
}

/// Bytes of white space and comments that the text begins with.
pub(crate) fn blank(text: &str) -> usize {
    let mut at = 0;
    while at < text.len() {
        match token(&text[at..]) {
            (Token::Blank | Token::Line, length) => at += length,
            _ => break,
        }
    }
    at
}

/// What follows an item: where its comma is, and where what belongs to it ends, that is past the end of its line, or, if the line goes on, its
/// comma. What comes then belongs to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Gap {
    pub(crate) comma: Option<usize>,
    pub(crate) end: usize,
    /// Whether what comes next begins a line.
    pub(crate) ends_line: bool,
}

/// The gap that begins at `start`; where `first`, it follows a bracket, and a comma is none of it.
pub(crate) fn gap(text: &str, start: usize, stop: usize, first: bool) -> Gap {
    let (mut at, mut comma, mut line_end) = (start, None, None);
    while at < stop {
        let (token, length) = token(&text[at..stop]);
        match token {
            Token::Blank => {}
            Token::Line if comma.is_some() || first => {
                return Gap { comma, end: at + length, ends_line: true };
            }
            // An item without a comma is the last one, unless its comma stands on a later line.
            Token::Line => line_end = line_end.or(Some(at + length)),
            Token::Comma if comma.is_none() && !first => comma = Some(at),
            Token::Comma | Token::Other => break,
        }
        at += length;
    }
    match (comma, line_end) {
        (Some(comma), _) => Gap { comma: Some(comma), end: comma + 1, ends_line: false },
        (None, Some(end)) => Gap { comma: None, end, ends_line: true },
        (None, None) => Gap { comma: None, end: start, ends_line: false },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> (String, String) {
        let gap = gap(text, 0, text.len(), false);
        (text[..gap.end].to_owned(), text[gap.end..].to_owned())
    }

    #[test]
    fn a_line_belongs_to_what_it_ends_and_the_rest_to_what_follows() {
        for (own, next) in [
            (",", " "),
            (", // one\n", "  // two\n  "),
            (" /* a\n, */ , /* b */\n", "\n  "),
            ("\n  , \n", ""),
            ("", " "),
            ("", " /* end */"),
            (" // last\n", "  "),
            (",", " /* about b */ "),
            ("\r\n", "  "),
        ] {
            assert_eq!(split(&format!("{own}{next}")), (own.to_owned(), next.to_owned()));
        }
    }

    #[test]
    fn comments_nest_and_hide_commas() {
        assert_eq!(blank("/* /* , */ */ x"), 14);
        assert_eq!(blank("// ,\n x"), 6);
        assert_eq!(blank("/* open"), 7);
    }
}
