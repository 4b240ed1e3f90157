//! Values of past runs, within a bound of bytes.

use std::collections::{BTreeMap, HashMap};

use crate::key::Key;
use crate::value::Value;

/// How full the cache is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CacheUse {
    /// Bytes of the values kept, as their types count them, each at least 64. A value under several keys counts once.
    pub bytes: usize,
    /// Bytes it may keep.
    pub budget: usize,
    /// Keys under which there is a value.
    pub entries: usize,
}

/// What a value counts for. Small ones count for what keeping them costs, so that they too are bounded.
fn cost(value: &Value) -> usize {
    value.bytes().max(64)
}

/// When a value was last used; later is larger.
pub(crate) type Age = u64;

/// Keeps the most recently used values whose bytes together stay within the budget.
///
/// Which ones these are depends on the ages alone, not on the order in which values arrive: nodes that run side by side
/// finish as they will, and the next run finds the same all the same.
pub(crate) struct Cache {
    budget: usize,
    bytes: usize,
    clock: Age,
    /// The greatest age that was forgotten. There was no room for it, so there is none for anything older.
    forgotten: Age,
    entries: HashMap<Key, (Value, Age)>,
    by_age: BTreeMap<Age, Key>,
    /// Under how many keys each shared value is, by its address.
    sharers: HashMap<usize, usize>,
}

impl Cache {
    pub(crate) fn new(budget: usize) -> Self {
        let (entries, by_age, sharers) = (HashMap::new(), BTreeMap::new(), HashMap::new());
        Self { budget, bytes: 0, clock: 0, forgotten: 0, entries, by_age, sharers }
    }

    pub(crate) fn usage(&self) -> CacheUse {
        CacheUse { bytes: self.bytes, budget: self.budget, entries: self.entries.len() }
    }

    /// An age greater than all before.
    pub(crate) fn next_age(&mut self) -> Age {
        self.clock += 1;
        self.clock
    }

    /// The value, which is now the most recently used.
    pub(crate) fn get(&mut self, key: &Key) -> Option<Value> {
        self.clock += 1;
        let (value, age) = self.entries.get_mut(key)?;
        self.by_age.remove(age);
        *age = self.clock;
        self.by_age.insert(self.clock, *key);
        Some(value.clone())
    }

    /// The value, its age as it was.
    pub(crate) fn peek(&self, key: &Key) -> Option<&Value> {
        self.entries.get(key).map(|(value, _)| value)
    }

    /// Keeps a value of that age, forgetting the oldest until all fit. One that is larger than the budget is not kept and pushes none out.
    pub(crate) fn insert(&mut self, key: Key, value: Value, age: Age) {
        self.remove(&key);
        if cost(&value) > self.budget || age < self.forgotten {
            return;
        }
        let sharers = self.sharers.entry(value.address()).or_default();
        *sharers += 1;
        if *sharers == 1 {
            self.bytes += cost(&value);
        }
        self.by_age.insert(age, key);
        self.entries.insert(key, (value, age));
        while self.bytes > self.budget {
            let Some((age, oldest)) = self.by_age.pop_first() else { break };
            self.forgotten = age;
            self.remove(&oldest);
        }
    }

    fn remove(&mut self, key: &Key) {
        let Some((value, age)) = self.entries.remove(key) else { return };
        self.by_age.remove(&age);
        if let Some(sharers) = self.sharers.get_mut(&value.address()) {
            *sharers -= 1;
            if *sharers == 0 {
                self.sharers.remove(&value.address());
                self.bytes -= cost(&value);
            }
        }
    }

    pub(crate) fn clear(&mut self) {
        *self = Self::new(self.budget);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;

    use super::*;
    use crate::key::KeyHasher;
    use crate::value::TypeEntry;

    fn key(number: u64) -> Key {
        let mut hasher = KeyHasher::new();
        hasher.number(number);
        hasher.finish()
    }

    /// A value that counts for so many bytes.
    fn value(bytes: usize) -> Value {
        Value::new(Arc::new(bytes)).measured(&TypeEntry::new::<usize>("Bytes", |bytes| *bytes))
    }

    #[test]
    fn a_value_under_two_keys_counts_once() {
        let mut cache = Cache::new(1000);
        let shared = value(600);
        for (number, age) in [(0, 1), (1, 2)] {
            cache.insert(key(number), shared.clone(), age);
        }
        assert_eq!(cache.usage(), CacheUse { bytes: 600, budget: 1000, entries: 2 });
        // Room for 500 more there is only when both keys are gone.
        cache.insert(key(2), value(500), 3);
        assert_eq!(cache.usage(), CacheUse { bytes: 500, budget: 1000, entries: 1 });
    }

    #[test]
    fn the_same_key_again_counts_once() {
        let mut cache = Cache::new(1000);
        cache.insert(key(0), value(600), 1);
        cache.insert(key(0), value(300), 2);
        assert_eq!(cache.usage(), CacheUse { bytes: 300, budget: 1000, entries: 1 });
    }

    proptest! {
        /// Whatever the order of arrival, what is kept is the most recent that fit, and the count of bytes is right.
        #[test]
        fn what_is_kept_does_not_depend_on_the_order_of_arrival(
            sizes in prop::collection::vec(0_usize..700, 1..12).prop_shuffle(),
            order in Just((0_usize..12).collect::<Vec<_>>()).prop_shuffle(),
        ) {
            let mut cache = Cache::new(1000);
            for &index in order.iter().filter(|&&index| index < sizes.len()) {
                cache.insert(key(index as u64), value(sizes[index]), index as Age + 1);
                prop_assert!(cache.usage().bytes <= 1000);
            }
            let mut expected = Vec::new();
            let mut bytes = 0;
            for index in (0..sizes.len()).rev() {
                bytes += sizes[index].max(64);
                if bytes > 1000 {
                    break;
                }
                expected.push(index);
            }
            let kept: Vec<usize> = (0..sizes.len()).rev().filter(|&index| cache.peek(&key(index as u64)).is_some()).collect();
            prop_assert_eq!(&kept, &expected);
            prop_assert_eq!(cache.usage().bytes, expected.iter().map(|&index| sizes[index].max(64)).sum::<usize>());
        }
    }
}
