//! Runs steps that wait for each other, as many at a time as there are threads.
//!
//! The threads are the run's own, not rayon's. A rayon worker that waits for the pieces of its own work takes up whatever
//! else is queued: another node would then run in the middle of the first, on its stack, in its time, and under its locks, so that two nodes
//! that share a device could each wait for the other on one thread. And a node that waits for a device would hold up a worker that
//! other nodes need. So nodes have threads of their own, which sleep when there is nothing to do, and what a node does
//! with rayon goes to rayon's pool.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, Scope};

/// Which steps wait for which.
pub(crate) struct Order {
    /// How many steps each waits for.
    waits: Vec<usize>,
    /// Which steps wait for each.
    after: Vec<Vec<usize>>,
}

impl Order {
    /// From the earlier steps that each waits for.
    pub(crate) fn new(before: &[BTreeSet<usize>]) -> Self {
        let mut after = vec![Vec::new(); before.len()];
        for (step, earlier) in before.iter().enumerate() {
            for &earlier in earlier {
                after[earlier].push(step);
            }
        }
        Self { waits: before.iter().map(BTreeSet::len).collect(), after }
    }

    /// Runs every step after all it waits for; of those that could run, the first. Where `step` says `false`, what waits for it does not run.
    ///
    /// One thread runs them in ascending order. A thread is made when there is something for it to do, and if the system gives none, those
    /// there are go on. A panic of `step` stops the others and goes on to the caller.
    pub(crate) fn run(self, threads: usize, step: &(dyn Fn(usize) -> bool + Sync)) {
        let ready = (0..self.waits.len()).filter(|&step| self.waits[step] == 0).map(Reverse).collect();
        let state = State { ready, waits: self.waits, running: 0, idle: 0, threads: 1, panicked: false };
        let crew = Crew { state: Mutex::new(state), wake: Condvar::new(), after: &self.after, most: threads, step };
        thread::scope(|scope| crew.work(scope));
    }
}

struct State {
    ready: BinaryHeap<Reverse<usize>>,
    waits: Vec<usize>,
    running: usize,
    /// Threads that sleep.
    idle: usize,
    /// Threads there are.
    threads: usize,
    panicked: bool,
}

struct Crew<'s> {
    state: Mutex<State>,
    wake: Condvar,
    after: &'s [Vec<usize>],
    most: usize,
    step: &'s (dyn Fn(usize) -> bool + Sync),
}

/// Tells the others that a step panicked, or they would wait for it for ever.
struct Alarm<'c, 's>(&'c Crew<'s>);

impl Drop for Alarm<'_, '_> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.lock().panicked = true;
            self.0.wake.notify_all();
        }
    }
}

impl<'s> Crew<'s> {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What each thread does until nothing is left.
    fn work<'scope, 'env>(&'env self, scope: &'scope Scope<'scope, 'env>)
    where
        's: 'env,
    {
        let mut state = self.lock();
        while !state.panicked {
            let Some(Reverse(next)) = state.ready.pop() else {
                if state.running == 0 {
                    return;
                }
                state.idle += 1;
                state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner);
                state.idle -= 1;
                continue;
            };
            state.running += 1;
            let help = !state.ready.is_empty() && state.idle == 0 && state.threads < self.most;
            state.threads += usize::from(help);
            drop(state);
            if help && thread::Builder::new().spawn_scoped(scope, || self.work(scope)).is_err() {
                self.lock().threads -= 1;
            }
            let alarm = Alarm(self);
            let passed = (self.step)(next);
            drop(alarm);
            state = self.lock();
            state.running -= 1;
            if passed {
                state.release(&self.after[next]);
            }
            self.wake_for(&state);
        }
    }

    /// Wakes a thread for each ready step but the one that the caller takes; all, when it was the last.
    fn wake_for(&self, state: &State) {
        if state.ready.is_empty() && state.running == 0 {
            self.wake.notify_all();
        }
        for _ in 1..state.ready.len().min(state.idle + 1) {
            self.wake.notify_one();
        }
    }
}

impl State {
    fn release(&mut self, after: &[usize]) {
        for &next in after {
            self.waits[next] -= 1;
            if self.waits[next] == 0 {
                self.ready.push(Reverse(next));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    fn ran(before: &[&[usize]], threads: usize, passes: impl Fn(usize) -> bool + Sync) -> Vec<usize> {
        let before: Vec<BTreeSet<usize>> = before.iter().map(|before| before.iter().copied().collect()).collect();
        let ran = Mutex::new(Vec::new());
        Order::new(&before).run(threads, &|step| {
            ran.lock().unwrap().push(step);
            passes(step)
        });
        ran.into_inner().unwrap()
    }

    #[test]
    fn one_thread_runs_them_in_order() {
        assert_eq!(ran(&[&[], &[0], &[], &[1, 2], &[]], 1, |_| true), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn what_waits_for_a_step_that_did_not_pass_does_not_run() {
        for threads in [1, 2, 8] {
            let mut ran = ran(&[&[], &[0], &[], &[1, 2], &[2], &[4]], threads, |step| step != 1);
            ran.sort_unstable();
            assert_eq!(ran, [0, 1, 2, 4, 5], "{threads} threads");
        }
    }

    #[test]
    fn independent_steps_run_at_the_same_time() {
        // Each waits in the barrier for the other three: with fewer than four threads this would never end.
        let (barrier, after) = (Barrier::new(4), AtomicUsize::new(0));
        let before = [BTreeSet::new(), BTreeSet::new(), BTreeSet::new(), BTreeSet::new(), BTreeSet::from([0, 1, 2, 3])];
        Order::new(&before).run(4, &|step| {
            if step < 4 {
                barrier.wait();
            } else {
                after.fetch_add(1, Ordering::Relaxed);
            }
            true
        });
        assert_eq!(after.into_inner(), 1);
    }

    #[test]
    fn no_more_threads_than_asked_for() {
        let (running, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let before = vec![BTreeSet::new(); 200];
        Order::new(&before).run(3, &|_| {
            most.fetch_max(1 + running.fetch_add(1, Ordering::SeqCst), Ordering::SeqCst);
            thread::yield_now();
            running.fetch_sub(1, Ordering::SeqCst);
            true
        });
        assert!((1..=3).contains(&most.into_inner()));
    }

    #[test]
    fn every_step_comes_after_what_it_waits_for() {
        let before: Vec<BTreeSet<usize>> =
            (0..300_usize).map(|step| (1..=3).map(|back| step * back / 4).filter(|&b| b < step).collect()).collect();
        for threads in [1, 2, 8] {
            let done: Vec<AtomicUsize> = before.iter().map(|_| AtomicUsize::new(0)).collect();
            Order::new(&before).run(threads, &|step| {
                assert!(before[step].iter().all(|&earlier| done[earlier].load(Ordering::SeqCst) == 1));
                done[step].fetch_add(1, Ordering::SeqCst);
                true
            });
            assert!(done.into_iter().all(|done| done.into_inner() == 1));
        }
    }

    #[test]
    fn a_panic_stops_all_and_goes_on_to_the_caller() {
        for threads in [1, 2, 8] {
            let panicked =
                std::panic::catch_unwind(|| ran(&[&[], &[], &[], &[0, 1, 2]], threads, |step| step != 1 || panic!("as it should")));
            assert!(panicked.is_err());
        }
    }
}
