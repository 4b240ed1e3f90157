//! A new value in the place of an old text: what says the same keeps its bytes.
//!
//! The text that was read is kept with its tree, in which every value knows its bytes. Saving lays the tree of what is to be said beside
//! it: equal values are copied from the text, with all that stands within them; where two differ, their items are laid beside
//! each other in turn. So however the document was changed, a comment is lost only with the value it stands in or whose line it ends, and what
//! was changed and changed back leaves no trace.

use std::collections::{BTreeSet, HashMap};

use crate::literal::{Literal, Place, Shape, identifier};
use crate::matching::matched;
use crate::parts::{Item, Key, Parts, parts, same};
use crate::sequence::{Old, Sequence};
use crate::trivia::blank;

/// A text, and what it says.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) text: String,
    pub(crate) tree: Literal,
}

/// The text of `source`, changed to say `new`. Items that no longer are in `new` are left out, but for those that begin at one of `kept`,
/// which the reader passed over.
pub(crate) fn rewrite(source: &Source, new: &Literal, kept: &BTreeSet<usize>) -> String {
    let mut places = HashMap::new();
    note_places(&source.tree, &mut places);
    let newline = if source.text.contains("\r\n") { "\r\n" } else { "\n" };
    let rewriter = Rewriter { text: &source.text, newline, places, kept };
    let Some(place) = source.tree.place else { return new.to_string() };
    let (before, after) = (&source.text[..place.start], &source.text[place.end..]);
    format!("{before}{}{after}", rewriter.value(&source.tree, place, new, 0))
}

fn note_places<'l>(literal: &'l Literal, places: &mut HashMap<(usize, usize), &'l Literal>) {
    if let Some(place) = literal.place {
        places.insert((place.start, place.end), literal);
    }
    for item in parts(literal).into_iter().flat_map(|parts| parts.items) {
        note_places(item.value, places);
    }
}

pub(crate) struct Rewriter<'t> {
    pub(crate) text: &'t str,
    pub(crate) newline: &'t str,
    /// Every value of the text.
    places: HashMap<(usize, usize), &'t Literal>,
    kept: &'t BTreeSet<usize>,
}

impl<'t> Rewriter<'t> {
    /// The text of `old`, which is at `place`, changed to say `new`. `depth` counts the brackets around it.
    fn value(&self, old: &Literal, place: Place, new: &Literal, depth: usize) -> String {
        let text = &self.text[place.start..place.end];
        if same(old, new) {
            return text.to_owned();
        }
        let both = parts(old).zip(parts(new));
        let Some((old_parts, new_parts)) = both.filter(|(old, new)| alike(old, new)) else { return self.unmatched(new, depth) };
        // The word and the bracket, which are there or not.
        let name_end = name_end(text);
        let name = match (old_parts.name == new_parts.name, new_parts.name) {
            (true, _) => text[..name_end].to_owned(),
            (false, name) => name.map(identifier).unwrap_or_default(),
        };
        if old_parts.bracket.is_none() {
            return format!("{name}({})", self.joined(&new_parts.items, depth));
        }
        let open = name_end + blank(&text[name_end..]);
        let within = place.start + open + 1..place.end - 1;
        format!("{name}{}{}{}", &text[name_end..=open], self.items(&old_parts, &new_parts, within, depth), &text[text.len() - 1..])
    }

    /// The items between two brackets.
    fn items(&self, old: &Parts<'_>, new: &Parts<'_>, within: std::ops::Range<usize>, depth: usize) -> String {
        let pairs = matched(&old.items, &new.items, |item| self.was_passed_over(item));
        let stays: BTreeSet<usize> = pairs.iter().flatten().copied().collect();
        let (mut olds, mut seen) = (Vec::new(), HashMap::new());
        for (index, item) in old.items.iter().enumerate() {
            let Some((start, end)) = self.span(item) else { continue };
            if !stays.contains(&index) && self.was_passed_over(item) {
                continue;
            }
            if stays.contains(&index) {
                seen.insert(index, seen.len());
            }
            olds.push(Old { start, end, stays: stays.contains(&index) });
        }
        let block = old.bracket == Some('{') || depth == 0;
        let sequence = Sequence::new(self.text, self.newline, within, &olds, block);
        let lines = new.items.iter().zip(pairs).map(|(item, pair)| match pair.and_then(|pair| Some((pair, *seen.get(&pair)?))) {
            Some((pair, seen)) => (Some(seen), self.item(&old.items[pair], item, depth)),
            None => (None, self.fresh(item, &sequence, &old.items, depth)),
        });
        sequence.write(lines.collect())
    }

    /// Whether the reader had a fault to find with its key or its value, and no place for it in the graph.
    fn was_passed_over(&self, item: &Item<'_>) -> bool {
        let key = item.key.and_then(|key| match key {
            Key::Name(name) => name.place,
            Key::Value(key) => key.place,
        });
        [key, item.value.place].into_iter().flatten().any(|place| self.kept.contains(&place.start))
    }

    /// First and last byte of an item.
    fn span(&self, item: &Item<'_>) -> Option<(usize, usize)> {
        let value = item.value.place?;
        let start = match item.key {
            None => value.start,
            Some(Key::Value(key)) => key.place?.start,
            Some(Key::Name(name)) => {
                let start = name.place?.start;
                if self.text[..start].ends_with("r#") { start - 2 } else { start }
            }
        };
        Some((start, value.end))
    }

    /// An old item, changed.
    fn item(&self, old: &Item<'_>, new: &Item<'_>, depth: usize) -> String {
        let (Some((start, _)), Some(place)) = (self.span(old), old.value.place) else { return self.plain_item(new, depth) };
        let value = self.value(old.value, place, new.value, depth + 1);
        let key_end = match old.key {
            None => return value,
            Some(Key::Value(key)) => key.place.map_or(start, |place| place.end),
            Some(Key::Name(name)) => name.place.map_or(start, |place| place.end),
        };
        let key = if old.called_as(new) { self.text[start..key_end].to_owned() } else { key_text(new) };
        format!("{key}{}{value}", &self.text[key_end..place.start])
    }

    /// A new item in the style of the old ones: where the values of a map stand below each other, so does the new one.
    fn fresh(&self, new: &Item<'_>, sequence: &Sequence<'_>, old: &[Item<'_>], depth: usize) -> String {
        let text = self.plain_item_in(new, sequence.indent(), depth);
        let Some(Key::Value(_)) = new.key else { return text };
        let key = key_text(new);
        let columns: BTreeSet<usize> = old.iter().filter_map(|item| self.value_column(item)).collect();
        match (columns.first(), columns.len(), old.len()) {
            (Some(column), 1, 2..) => {
                let pad = column.saturating_sub(key.chars().count() + 1).max(1);
                format!("{key}:{:pad$}{}", "", &text[key.len() + 2..])
            }
            _ => text,
        }
    }

    /// How far from its beginning the value of an item is, in characters, if it is on the same line.
    fn value_column(&self, item: &Item<'_>) -> Option<usize> {
        let between = &self.text[self.span(item)?.0..item.value.place?.start];
        (!between.contains('\n')).then(|| between.chars().count())
    }

    fn plain_item(&self, new: &Item<'_>, depth: usize) -> String {
        self.plain_item_in(new, "", depth)
    }

    fn plain_item_in(&self, new: &Item<'_>, indent: &str, depth: usize) -> String {
        let value = match parts(new.value) {
            // A map of the frame has a line for each of its entries.
            Some(map) if depth == 0 && map.bracket == Some('{') && !map.items.is_empty() => {
                let line = |item| format!("{indent}{}{},{}", unit(indent), self.plain_item(item, depth + 1), self.newline);
                format!("{{{}{}{indent}}}", self.newline, map.items.iter().map(line).collect::<String>())
            }
            _ => self.unmatched(new.value, depth + 1),
        };
        if new.key.is_none() { value } else { format!("{}: {value}", key_text(new)) }
    }

    /// A value that is in no old one's place: copied from where it stands in the text, if it does, else written out.
    fn unmatched(&self, new: &Literal, depth: usize) -> String {
        let from = new.place.and_then(|place| Some((place, *self.places.get(&(place.start, place.end))?)));
        if let Some((place, _)) = from.filter(|(_, old)| same(old, new)) {
            return self.text[place.start..place.end].to_owned();
        }
        match parts(new) {
            Some(Parts { name, bracket: Some(open), items }) => {
                let close = match open {
                    '[' => ']',
                    '{' => '}',
                    _ => ')',
                };
                format!("{}{open}{}{close}", name.map(|name| self.name(new, name)).unwrap_or_default(), self.joined(&items, depth))
            }
            _ => new.to_string(),
        }
    }

    /// `Some` is a word of the language, not a name that would have to be written raw.
    fn name(&self, literal: &Literal, name: &str) -> String {
        if matches!(literal.shape, Shape::Present(_)) { name.to_owned() } else { identifier(name) }
    }

    fn joined(&self, items: &[Item<'_>], depth: usize) -> String {
        items.iter().map(|item| self.plain_item(item, depth.max(1))).collect::<Vec<_>>().join(", ")
    }
}

/// One step of indentation, in the way of `indent`.
pub(crate) fn unit(indent: &str) -> &'static str {
    if indent.contains('\t') { "\t" } else { "    " }
}

fn key_text(item: &Item<'_>) -> String {
    match item.key {
        Some(Key::Name(name)) => identifier(&name.text),
        Some(Key::Value(key)) => key.to_string(),
        None => String::new(),
    }
}

/// Whether one can be changed into the other item by item.
fn alike(old: &Parts<'_>, new: &Parts<'_>) -> bool {
    let keyed = |parts: &Parts<'_>| parts.items.first().map(|item| item.key.is_some());
    let brackets = match (old.bracket, new.bracket) {
        (Some(old), Some(new)) => old == new,
        (None, Some(new)) => new == '(',
        (_, None) => false,
    };
    let special = |parts: &Parts<'_>| parts.name == Some("Some");
    brackets && special(old) == special(new) && keyed(old).zip(keyed(new)).is_none_or(|(old, new)| old == new)
}

/// Bytes of the name that a value begins with.
fn name_end(text: &str) -> usize {
    text.find(|c: char| !(c == '_' || c == '#' || matches!(c, '.' | '+' | '-') || c.is_alphanumeric())).unwrap_or(text.len())
}
