//! The lines of a file, as statements.

use super::{ObjError, ObjFault};

/// A statement on one line, or on several of which all but the last end with a backslash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Statement<'a> {
    /// Its bytes, from the first line's start to the last line's end.
    bytes: &'a [u8],
    /// The number of its first line, from 1.
    pub(super) line: usize,
    /// How many lines it has.
    pub(super) height: usize,
}

impl<'a> Statement<'a> {
    /// Its words up to a comment: what stands between blanks, and backslashes at the end of lines.
    pub(super) fn words(self) -> impl Iterator<Item = &'a [u8]> {
        // A statement of several lines is split at backslashes too: they end its lines, and belong to no number.
        let joined = self.height > 1;
        let is_gap = move |byte: &u8| byte.is_ascii_whitespace() || (joined && *byte == b'\\');
        let mut rest = self.bytes;
        std::iter::from_fn(move || {
            let start = rest.iter().position(|byte| !is_gap(byte))?;
            let word = &rest[start..];
            let length = word.iter().position(|byte| is_gap(byte) || *byte == b'#').unwrap_or(word.len());
            // At a comment there is no word left.
            rest = word.get(length..).filter(|rest| !rest.starts_with(b"#")).unwrap_or_default();
            (length > 0).then_some(&word[..length])
        })
    }
}

/// Goes through the statements of a file. Lines end with a line feed, a carriage return, or both; a byte-order mark is passed over.
///
/// A comment that ends with a backslash does not go on: it is a path, more likely than not.
pub(super) fn statements(bytes: &[u8]) -> Result<impl Iterator<Item = Statement<'_>>, ObjError> {
    if is_utf16(bytes) {
        return Err(ObjError::whole(ObjFault::Utf16));
    }
    let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut line = 1;
    Ok(std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let (mut end, mut next, mut height) = (0, 0, 0);
        loop {
            let here = &rest[next..];
            let length = here.iter().position(|&byte| byte == b'\n' || byte == b'\r').unwrap_or(here.len());
            end = next.max(end) + length;
            height += 1;
            let after = if rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
            next = (end + after).min(rest.len());
            if !goes_on(&here[..length]) || next == rest.len() || rest.trim_ascii_start().starts_with(b"#") {
                break;
            }
        }
        let statement = Statement { bytes: &rest[..end], line, height };
        line += height;
        rest = &rest[next..];
        Some(statement)
    }))
}

fn goes_on(line: &[u8]) -> bool {
    line.trim_ascii_end().ends_with(b"\\")
}

/// Whether the text is UTF-16: by its byte-order mark, or every other one of its first bytes being zero.
fn is_utf16(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(64)];
    let zeros = |parity: usize| start.len() >= 4 && start.iter().skip(parity).step_by(2).all(|&byte| byte == 0);
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") || (zeros(0) != zeros(1))
}
