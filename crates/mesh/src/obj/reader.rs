//! A reader that knows how far it was read, as `tobj` does not say in which line it stopped.

use std::io::{self, BufRead, Read};

/// A reader that knows how many lines were taken from it.
pub(super) struct CountingReader<'a> {
    rest: &'a [u8],
    lines: usize,
}

impl<'a> CountingReader<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self { rest: text, lines: 0 }
    }

    /// The number of the last line taken, from 1.
    pub(super) fn line(&self) -> usize {
        self.lines
    }
}

impl Read for CountingReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.rest[..count]);
        self.consume(count);
        Ok(count)
    }
}

impl BufRead for CountingReader<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(self.rest)
    }

    fn consume(&mut self, count: usize) {
        let (taken, rest) = self.rest.split_at(count.min(self.rest.len()));
        // `lines` takes one line at a time, its end included.
        self.lines += usize::from(taken.last() == Some(&b'\n'));
        self.rest = rest;
    }
}
