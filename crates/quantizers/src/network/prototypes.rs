//! The prototypes of all units, laid out so that one instruction compares many of them.

use alloc::vec::Vec;

use crate::Scalar;

/// Number of units in a block.
pub(crate) const LANES: usize = 16;

/// Vectors of one dimension in blocks of [`LANES`]. A block holds the first feature of each vector,
/// then the second, and so on. A lane without a unit holds infinities, which are never the nearest.
#[derive(Clone, Debug)]
pub(crate) struct Prototypes<S> {
    dimension: usize,
    len: usize,
    features: Vec<[S; LANES]>,
}

impl<S: Scalar> Prototypes<S> {
    pub(crate) fn new(dimension: usize) -> Self {
        Self {
            dimension,
            len: 0,
            features: Vec::new(),
        }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.dimension
    }

    /// Returns all blocks, each of which has one row of lanes per feature.
    #[inline(always)]
    pub(crate) fn rows(&self) -> &[[S; LANES]] {
        &self.features
    }

    #[inline(always)]
    fn block(&self, slot: usize) -> &[[S; LANES]] {
        let start = slot / LANES * self.dimension;
        &self.features[start..start + self.dimension]
    }

    #[inline(always)]
    fn block_mut(&mut self, slot: usize) -> &mut [[S; LANES]] {
        let start = slot / LANES * self.dimension;
        &mut self.features[start..start + self.dimension]
    }

    /// Makes room for one more vector, at infinity, and returns its slot.
    pub(crate) fn push(&mut self) -> usize {
        let slot = self.len;
        if slot.is_multiple_of(LANES) {
            let longer = self.features.len() + self.dimension;
            self.features.resize(longer, [S::INFINITY; LANES]);
        }
        self.len += 1;
        slot
    }

    #[inline(always)]
    pub(crate) fn at(&self, slot: usize, feature: usize) -> S {
        self.block(slot)[feature][slot % LANES]
    }

    #[inline(always)]
    pub(crate) fn put(&mut self, slot: usize, feature: usize, value: S) {
        self.block_mut(slot)[feature][slot % LANES] = value;
    }

    /// Empties a slot: its vector becomes infinitely far.
    pub(crate) fn vacate(&mut self, slot: usize) {
        for row in self.block_mut(slot) {
            row[slot % LANES] = S::INFINITY;
        }
    }

    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        for feature in 0..self.dimension {
            self.put(to, feature, self.at(from, feature));
        }
    }

    pub(crate) fn truncate(&mut self, len: usize) {
        for slot in len..self.len.min(len.next_multiple_of(LANES)) {
            self.vacate(slot);
        }
        self.len = len;
        self.features.truncate(len.div_ceil(LANES) * self.dimension);
    }

    #[inline(always)]
    pub(crate) fn values(&self, slot: usize) -> impl ExactSizeIterator<Item = S> + Clone + '_ {
        self.block(slot).iter().map(move |row| row[slot % LANES])
    }

    /// Moves a prototype by `rate` of the way to `target`.
    #[inline(always)]
    pub(crate) fn approach(&mut self, slot: usize, target: &[S], rate: S) {
        for (row, target) in self.block_mut(slot).iter_mut().zip(target) {
            let value = &mut row[slot % LANES];
            *value += rate * (*target - *value);
        }
    }
}
