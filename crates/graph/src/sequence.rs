//! The items between two brackets of a text, some left out, some new, in any order.
//!
//! An item owns what stands between it and the end of its line, and what stands above it goes where it goes. What is left out takes the
//! comment that ends its line along; comments above it stay.

use std::ops::Range;

use crate::rewrite::unit;
use crate::trivia::{Gap, blank, gap};

/// An item of the text.
#[derive(Clone, Copy)]
pub(crate) struct Old {
    pub(crate) start: usize,
    pub(crate) end: usize,
    /// Whether it is still there.
    pub(crate) stays: bool,
}

/// An item with what belongs to it.
struct Piece {
    /// What stands before it.
    lead: String,
    begins_line: bool,
    /// Where it stood among those that stay.
    rank: usize,
    /// From the item to its comma, if it has one.
    comma: bool,
    before_comma: Range<usize>,
    tail: Range<usize>,
    ends_line: bool,
}

/// What items that are left out leave to the next.
#[derive(Default)]
struct Carry {
    lead: String,
    /// Whether they leave it the beginning of a line.
    line: bool,
    /// Whether they leave it the end of a line.
    end: bool,
}

impl Carry {
    fn leave_out(&mut self, own: &str, begins_line: bool, ends_line: bool, newline: &str) {
        let begins_line = begins_line || self.line;
        let own = self.take(own);
        self.line = begins_line && !ends_line;
        self.lead = if self.line { own } else { own.trim_end_matches([' ', '\t']).to_owned() };
        self.end = !begins_line && ends_line;
        if self.end {
            self.lead += newline;
        }
    }

    /// With what stands before the next.
    fn take(&mut self, own: &str) -> String {
        self.end = false;
        let own = if std::mem::take(&mut self.line) { own.trim_start_matches([' ', '\t']) } else { own };
        std::mem::take(&mut self.lead) + own
    }
}

pub(crate) struct Sequence<'t> {
    text: &'t str,
    newline: &'t str,
    /// What follows the bracket on its line.
    head: Range<usize>,
    pieces: Vec<Piece>,
    /// What stands before the closing bracket.
    rest: String,
    rest_begins_line: bool,
    /// Whether the last item has a comma.
    trailing: bool,
    /// Whether items of their own begin a line each, where there are none to go by.
    block: bool,
    indent: String,
    /// What stood before the first item, if nothing but white space on the bracket's line.
    first_lead: String,
    rank_of_last: Option<usize>,
}

impl<'t> Sequence<'t> {
    pub(crate) fn new(text: &'t str, newline: &'t str, within: Range<usize>, old: &[Old], block: bool) -> Self {
        let head = gap(text, within.start, old.first().map_or(within.end, |old| old.start), true);
        let (mut before, mut pieces, mut carry) = (head, Vec::with_capacity(old.len()), Carry::default());
        let (mut indent, mut first_lead) = (None, None);
        let mut trailing = false;
        for (index, item) in old.iter().enumerate() {
            let next = old.get(index + 1).map_or(within.end, |next| next.start);
            let after = gap(text, item.end, next, false);
            let own = &text[before.end..item.start];
            first_lead.get_or_insert_with(|| if own.trim().is_empty() { own.to_owned() } else { String::new() });
            if before.ends_line {
                indent.get_or_insert_with(|| last_line(own).to_owned());
            }
            trailing = after.comma.is_some();
            if item.stays {
                pieces.push(Piece {
                    begins_line: before.ends_line && !carry.end || carry.line,
                    lead: carry.take(own),
                    rank: pieces.len(),
                    comma: after.comma.is_some(),
                    before_comma: item.end..after.comma.unwrap_or(item.end),
                    tail: after.comma.map_or(item.end, |comma| comma + 1)..after.end,
                    ends_line: after.ends_line,
                });
            } else {
                carry.leave_out(own, before.ends_line, after.ends_line, newline);
            }
            before = after;
        }
        let Gap { end, ends_line, .. } = before;
        let ends_line = ends_line && !carry.end;
        let rest = carry.take(&text[end..within.end]);
        let line = &text[..within.start];
        let outer = last_line(line);
        let outer = &outer[..outer.len() - outer.trim_start_matches([' ', '\t']).len()];
        let last_stays = old.last().is_some_and(|old| old.stays);
        Self {
            text,
            newline,
            head: within.start..head.end,
            rest_begins_line: ends_line,
            trailing: if old.is_empty() { block } else { trailing } || blank(&rest) < rest.len(),
            block: block && old.is_empty(),
            indent: indent.unwrap_or_else(|| format!("{outer}{}", unit(outer))),
            first_lead: first_lead.unwrap_or_default(),
            rank_of_last: last_stays.then(|| pieces.len() - 1),
            pieces,
            rest,
        }
    }

    /// Indentation of an item on a line of its own.
    pub(crate) fn indent(&self) -> &str {
        &self.indent
    }

    /// Puts together the texts of items, each with the number of the old one that it is among those that stay.
    pub(crate) fn write(&self, items: Vec<(Option<usize>, String)>) -> String {
        let mut writer = Writer { sequence: self, out: self.text[self.head.clone()].to_owned(), written: 0, before: None };
        let count = items.len();
        for (index, (old, item)) in items.into_iter().enumerate() {
            let comma = index + 1 < count || self.trailing;
            match old.and_then(|old| self.pieces.get(old)) {
                Some(piece) => writer.old(piece, &item, comma),
                None => writer.fresh(&item, comma),
            }
        }
        writer.end()
    }
}

struct Writer<'s, 't> {
    sequence: &'s Sequence<'t>,
    out: String,
    written: usize,
    /// The old item written last, unless a new one was.
    before: Option<&'s Piece>,
}

impl<'s> Writer<'s, '_> {
    fn at_line_start(&self) -> bool {
        self.out.trim_end_matches([' ', '\t']).ends_with('\n')
    }

    fn old(&mut self, piece: &'s Piece, item: &str, comma: bool) {
        let follows = match self.before {
            Some(before) => before.rank + 1 == piece.rank,
            None => self.written == 0 && piece.rank == 0,
        };
        let at_first = self.written == 0 && !piece.begins_line && piece.lead.trim().is_empty();
        if at_first {
            self.out += &self.sequence.first_lead;
        } else if follows {
            self.out += &piece.lead;
        } else {
            self.lead(piece);
        }
        self.out += item;
        self.finish(Some(piece), comma);
        self.before = Some(piece);
    }

    /// What stands before an old item that did not follow what is written before it now.
    fn lead(&mut self, piece: &Piece) {
        match (self.at_line_start(), piece.begins_line) {
            (true, true) => self.out += &piece.lead,
            (false, true) => {
                self.out += self.sequence.newline;
                self.out += &piece.lead;
            }
            (true, false) => {
                self.out += &self.sequence.indent;
                self.out += piece.lead.trim_start_matches([' ', '\t']);
            }
            (false, false) => {
                let lead = piece.lead.trim_start_matches([' ', '\t']);
                if !lead.starts_with(self.sequence.newline) {
                    self.space();
                }
                self.out += lead;
            }
        }
    }

    fn space(&mut self) {
        if self.written > 0 && !self.out.ends_with([' ', '\t', '\n']) {
            self.out.push(' ');
        }
    }

    fn fresh(&mut self, item: &str, comma: bool) {
        let own_line = match self.before {
            Some(before) => before.ends_line || before.begins_line,
            None if self.written > 0 => self.at_line_start() || self.sequence.block,
            None => self.sequence.block || self.at_line_start() || self.sequence.pieces.first().is_some_and(|first| first.begins_line),
        };
        if own_line {
            if !self.at_line_start() {
                self.out.truncate(self.out.trim_end_matches([' ', '\t']).len());
                self.out += self.sequence.newline;
            }
            self.out += &self.sequence.indent;
        } else if self.written == 0 {
            self.out += &self.sequence.first_lead;
        } else {
            self.space();
        }
        self.out += item;
        self.finish(None, comma);
        if own_line && (self.sequence.block || self.sequence.rest_begins_line) {
            self.out += self.sequence.newline;
        }
        self.before = None;
    }

    /// The comma of an item and what ends its line.
    fn finish(&mut self, piece: Option<&Piece>, comma: bool) {
        let text = self.sequence.text;
        match piece {
            Some(piece) if piece.comma => {
                self.out += &text[piece.before_comma.clone()];
                self.out += if comma { "," } else { "" };
                self.out += &text[piece.tail.clone()];
            }
            Some(piece) => {
                self.out += if comma { "," } else { "" };
                self.out += &text[piece.tail.clone()];
            }
            None => self.out += if comma { "," } else { "" },
        }
        self.written += 1;
    }

    fn end(mut self) -> String {
        let sequence = self.sequence;
        let as_it_was = self.before.map(|before| before.rank) == sequence.rank_of_last;
        let blank = sequence.rest.trim().is_empty();
        if sequence.block && blank && self.written > 0 {
            let outer = sequence.indent.strip_suffix(unit(&sequence.indent)).unwrap_or("");
            self.out += outer;
            return self.out;
        }
        if !as_it_was && sequence.rest_begins_line && !self.at_line_start() {
            self.out += sequence.newline;
        }
        self.out += &sequence.rest;
        self.out
    }
}

fn last_line(text: &str) -> &str {
    text.rsplit('\n').next().unwrap_or(text)
}
