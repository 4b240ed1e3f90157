//! Values of past runs, within a bound of bytes.

use std::collections::{BTreeMap, HashMap};

use crate::key::Key;
use crate::value::Value;

/// How full the cache is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CacheUse {
    /// Bytes of the values kept, as their types count them, each at least 64.
    pub bytes: usize,
    /// Bytes it may keep.
    pub budget: usize,
    /// Values kept.
    pub entries: usize,
}

/// What a value counts for. Small ones count for what keeping them costs, so that they too are bounded.
fn cost(value: &Value) -> usize {
    value.bytes().max(64)
}

/// Keeps the most recently used values whose bytes together stay within the budget.
pub(crate) struct Cache {
    budget: usize,
    bytes: usize,
    /// Uses so far; later is larger.
    clock: u64,
    entries: HashMap<Key, (Value, u64)>,
    by_age: BTreeMap<u64, Key>,
}

impl Cache {
    pub(crate) fn new(budget: usize) -> Self {
        Self { budget, bytes: 0, clock: 0, entries: HashMap::new(), by_age: BTreeMap::new() }
    }

    pub(crate) fn usage(&self) -> CacheUse {
        CacheUse { bytes: self.bytes, budget: self.budget, entries: self.entries.len() }
    }

    /// The value, which is now the most recently used.
    pub(crate) fn get(&mut self, key: &Key) -> Option<Value> {
        let (value, age) = self.entries.get_mut(key)?;
        self.by_age.remove(age);
        self.clock += 1;
        *age = self.clock;
        self.by_age.insert(self.clock, *key);
        Some(value.clone())
    }

    /// The value, its age as it was.
    pub(crate) fn peek(&self, key: &Key) -> Option<&Value> {
        self.entries.get(key).map(|(value, _)| value)
    }

    /// Keeps a value, forgetting the least recently used until all fit. One that is larger than the budget is not kept.
    pub(crate) fn insert(&mut self, key: Key, value: Value) {
        self.remove(&key);
        let cost = cost(&value);
        if cost > self.budget {
            return;
        }
        while self.bytes > self.budget - cost {
            let Some((_, oldest)) = self.by_age.pop_first() else { break };
            self.remove(&oldest);
        }
        self.clock += 1;
        self.bytes += cost;
        self.by_age.insert(self.clock, key);
        self.entries.insert(key, (value, self.clock));
    }

    fn remove(&mut self, key: &Key) {
        if let Some((value, age)) = self.entries.remove(key) {
            self.by_age.remove(&age);
            self.bytes -= cost(&value);
        }
    }

    pub(crate) fn clear(&mut self) {
        *self = Self::new(self.budget);
    }
}
