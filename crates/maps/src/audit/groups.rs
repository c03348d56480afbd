//! Groups things that belong together.

use alloc::vec::Vec;

/// A partition of 0 … n − 1 that grows coarser (union–find with halved paths; R. Tarjan, 1975).
#[derive(Clone)]
pub(super) struct Groups(Vec<usize>);

impl Groups {
    pub(super) fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    pub(super) fn find(&mut self, mut one: usize) -> usize {
        while self.0[one] != one {
            self.0[one] = self.0[self.0[one]];
            one = self.0[one];
        }
        one
    }

    /// Joins two groups under the lower of their heads.
    pub(super) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// Returns the group of each thing. Groups are numbered in the order of their first thing.
    pub(super) fn numbers(&mut self) -> Vec<u32> {
        let mut number_of = alloc::vec![None; self.0.len()];
        let mut next = 0;
        (0..self.0.len())
            .map(|one| {
                let head = self.find(one);
                *number_of[head].get_or_insert_with(|| {
                    next += 1;
                    next - 1
                })
            })
            .collect()
    }
}
