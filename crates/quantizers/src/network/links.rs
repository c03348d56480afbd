//! The edges of the graph and their ages.

use alloc::vec::Vec;

/// One end of an edge, as the unit at the other end sees it.
#[derive(Clone, Copy, Debug, Default)]
struct Half {
    to: u32,
    /// Sum of the wins of both ends when the edge was made or last renewed.
    renewed: u32,
}

/// Symmetric adjacency of slots.
///
/// A step of a neural gas ages all edges of the winner by one. So the age of an edge is how often
/// its ends have won since it was renewed. To age edges it is enough to count the wins of units.
#[derive(Clone, Debug)]
pub(crate) struct Links {
    /// Number of places for neighbours a slot has in `halves`; grows with the largest degree.
    stride: usize,
    halves: Vec<Half>,
    degrees: Vec<u32>,
    /// Number of times that each slot's edges were aged, modulo 2³².
    wins: Vec<u32>,
}

impl Links {
    pub(crate) fn new() -> Self {
        Self {
            stride: 8,
            halves: Vec::new(),
            degrees: Vec::new(),
            wins: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self) {
        self.degrees.push(0);
        self.wins.push(0);
        self.halves
            .resize(self.degrees.len() * self.stride, Half::default());
    }

    #[inline]
    fn halves(&self, slot: usize) -> &[Half] {
        let start = slot * self.stride;
        &self.halves[start..start + self.degrees[slot] as usize]
    }

    pub(crate) fn degree(&self, slot: usize) -> usize {
        self.degrees[slot] as usize
    }

    /// Returns the neighbours of a slot in ascending order.
    #[inline]
    pub(crate) fn neighbours(
        &self,
        slot: usize,
    ) -> impl DoubleEndedIterator<Item = usize> + ExactSizeIterator + Clone + '_ {
        self.halves(slot).iter().map(|half| half.to as usize)
    }

    /// Returns the neighbours of a slot in ascending order, with the ages of the edges.
    #[inline]
    pub(crate) fn ages(&self, slot: usize) -> impl DoubleEndedIterator<Item = (usize, u32)> + '_ {
        (0..self.degree(slot)).map(move |place| self.at(slot, place))
    }

    /// Returns the neighbour at `place` in ascending order, and the edge's age.
    #[inline]
    pub(crate) fn at(&self, slot: usize, place: usize) -> (usize, u32) {
        let half = self.halves(slot)[place];
        let both = self.wins[slot].wrapping_add(self.wins[half.to as usize]);
        (half.to as usize, both.wrapping_sub(half.renewed))
    }

    /// Returns the last neighbour, and the edge's age.
    pub(crate) fn last(&self, slot: usize) -> Option<(usize, u32)> {
        self.ages(slot).next_back()
    }

    /// Ages all edges of a slot by one.
    #[inline]
    pub(crate) fn age(&mut self, slot: usize) {
        self.wins[slot] = self.wins[slot].wrapping_add(1);
    }

    /// Sets the age of the edge between two slots, and returns whether it had to be made.
    #[inline]
    pub(crate) fn renew(&mut self, a: usize, b: usize, age: u32) -> bool {
        let renewed = self.wins[a].wrapping_add(self.wins[b]).wrapping_sub(age);
        let is_new = self.put(a, b, renewed);
        self.put(b, a, renewed);
        is_new
    }

    #[inline]
    fn put(&mut self, from: usize, to: usize, renewed: u32) -> bool {
        let to = to as u32;
        let place = self
            .halves(from)
            .iter()
            .position(|half| half.to >= to)
            .unwrap_or(self.degree(from));
        let start = from * self.stride;
        if place < self.degree(from) && self.halves[start + place].to == to {
            self.halves[start + place].renewed = renewed;
            return false;
        }
        if self.degree(from) == self.stride {
            self.widen();
        }
        let start = from * self.stride;
        let end = start + self.degree(from);
        self.halves
            .copy_within(start + place..end, start + place + 1);
        self.halves[start + place] = Half { to, renewed };
        self.degrees[from] += 1;
        true
    }

    /// Doubles the places for neighbours.
    #[cold]
    fn widen(&mut self) {
        let (old, new) = (self.stride, self.stride * 2);
        self.halves
            .resize(self.degrees.len() * new, Half::default());
        for slot in (0..self.degrees.len()).rev() {
            let start = slot * old;
            let end = start + self.degree(slot);
            self.halves.copy_within(start..end, slot * new);
        }
        self.stride = new;
    }

    /// Removes the edge between two slots, and returns whether there was one.
    pub(crate) fn cut(&mut self, a: usize, b: usize) -> bool {
        self.take(a, b);
        self.take(b, a)
    }

    fn take(&mut self, from: usize, to: usize) -> bool {
        let place = self
            .halves(from)
            .iter()
            .position(|half| half.to as usize == to);
        if let Some(place) = place {
            let start = from * self.stride;
            let end = start + self.degree(from);
            self.halves
                .copy_within(start + place + 1..end, start + place);
            self.degrees[from] -= 1;
        }
        place.is_some()
    }

    /// Renumbers slots. `new[slot]` is at most `slot` and ascends; it is `u32::MAX` for a removed
    /// slot, which has no edges.
    pub(crate) fn renumber(&mut self, new: &[u32]) {
        let mut len = 0;
        for (slot, to) in new.iter().enumerate() {
            if *to == u32::MAX {
                continue;
            }
            let to = *to as usize;
            len = to + 1;
            let start = slot * self.stride;
            let end = start + self.degree(slot);
            for half in &mut self.halves[start..end] {
                half.to = new[half.to as usize];
            }
            self.halves.copy_within(start..end, to * self.stride);
            self.degrees[to] = self.degrees[slot];
            self.wins[to] = self.wins[slot];
        }
        self.degrees.truncate(len);
        self.wins.truncate(len);
        self.halves.truncate(len * self.stride);
    }
}
