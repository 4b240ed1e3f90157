//! Which new item is which old one.

use std::collections::HashMap;

use crate::parts::{Item, same};

/// For each new item the old one that it is: the one that it was read from, or that has its name, or, without names, that says the same or
/// has its position. No old one is taken twice, and one that was `passed_over` only where no other has the name.
pub(crate) fn matched(old: &[Item<'_>], new: &[Item<'_>], passed_over: impl Fn(&Item<'_>) -> bool) -> Vec<Option<usize>> {
    let mut matching = Matching { pairs: vec![None; new.len()], taken: vec![false; old.len()] };
    let at: HashMap<(usize, usize), usize> =
        old.iter().enumerate().filter_map(|(index, item)| item.value.place.map(|place| ((place.start, place.end), index))).collect();
    let origins: Vec<Option<usize>> =
        new.iter().map(|item| item.value.place.and_then(|place| at.get(&(place.start, place.end))).copied()).collect();
    matching.pass(new, |index, item| origins[index].filter(|&origin| old[origin].called_as(item)).into_iter().collect());
    matching.pass(new, |index, _| origins[index].into_iter().collect());
    if old.iter().chain(new).any(|item| item.key.is_some()) {
        let mut called: HashMap<String, Vec<usize>> = HashMap::new();
        for (index, item) in old.iter().enumerate() {
            called.entry(name(item)).or_default().push(index);
        }
        called.values_mut().for_each(|named| named.sort_by_key(|&index| passed_over(&old[index])));
        matching.pass(new, |_, item| called.get(&name(item)).cloned().unwrap_or_default());
    } else {
        let mut next = 0;
        // In order, so that a list from which one is left out is not compared with itself over and over.
        matching.pass(new, |_, item| {
            let found = (next..old.len()).find(|&index| same(old[index].value, item.value));
            next = found.map_or(next, |found| found + 1);
            found.into_iter().collect()
        });
        matching.pass(new, |index, _| (index < old.len()).then_some(index).into_iter().collect());
    }
    matching.pairs
}

/// The name of an item as text.
fn name(item: &Item<'_>) -> String {
    match item.key {
        Some(crate::parts::Key::Name(name)) => name.text.clone(),
        Some(crate::parts::Key::Value(key)) => key.to_string(),
        None => String::new(),
    }
}

struct Matching {
    pairs: Vec<Option<usize>>,
    taken: Vec<bool>,
}

impl Matching {
    /// Gives each new item without an old one the first that is free of those proposed.
    fn pass<'n, 'l>(&mut self, new: &'n [Item<'l>], mut propose: impl FnMut(usize, &'n Item<'l>) -> Vec<usize>) {
        for (index, item) in new.iter().enumerate() {
            if self.pairs[index].is_some() {
                continue;
            }
            if let Some(old) = propose(index, item).into_iter().find(|&old| !self.taken[old]) {
                self.taken[old] = true;
                self.pairs[index] = Some(old);
            }
        }
    }
}
