//! The prototypes of all units, laid out so that one instruction compares many of them.

use alloc::vec::Vec;

use crate::Scalar;

/// Number of units in a block.
pub(crate) const LANES: usize = 16;

/// Vectors of one dimension in blocks of [`LANES`]. A block holds the first feature of each vector,
/// then the second, and so on. A lane without a unit holds infinities, which are never the nearest.
///
/// While many vectors are moved, a block may hold one vector after the other instead: a vector with
/// many features then lies in far fewer cache lines.
#[derive(Clone, Debug)]
pub(crate) struct Prototypes<S> {
    dimension: usize,
    len: usize,
    features: Vec<[S; LANES]>,
    in_turn: bool,
}

impl<S: Scalar> Prototypes<S> {
    pub(crate) fn new(dimension: usize) -> Self {
        Self {
            dimension,
            len: 0,
            features: Vec::new(),
            in_turn: false,
        }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.dimension
    }

    /// Returns all blocks, each of which has one row of lanes per feature. The vectors must not lie
    /// in turn.
    #[inline(always)]
    pub(crate) fn rows(&self) -> &[[S; LANES]] {
        debug_assert!(!self.in_turn, "the lanes are of vectors, not of features");
        &self.features
    }

    /// Copies a block, one row of lanes per feature, however it lies.
    #[inline(always)]
    pub(crate) fn copy_block(&self, block: usize, rows: &mut [[S; LANES]]) {
        let own = &self.features[block * self.dimension..][..self.dimension];
        if !self.in_turn {
            rows.copy_from_slice(own);
            return;
        }
        let own = own.as_flattened();
        for (piece, rows) in rows.chunks_mut(LANES).enumerate() {
            for lane in 0..LANES {
                let values = &own[lane * self.dimension + piece * LANES..][..rows.len()];
                for (row, value) in rows.iter_mut().zip(values) {
                    row[lane] = *value;
                }
            }
        }
    }

    /// Lets the vectors of each block lie in turn, or no longer.
    pub(crate) fn lie_in_turn(&mut self, in_turn: bool) {
        if in_turn == self.in_turn {
            return;
        }
        let mut rows = alloc::vec![[S::ZERO; LANES]; self.dimension];
        for block in 0..self.features.len() / self.dimension {
            self.copy_block(block, &mut rows);
            let own = &mut self.features[block * self.dimension..][..self.dimension];
            if !in_turn {
                own.copy_from_slice(&rows);
                continue;
            }
            let own = own.as_flattened_mut();
            for (piece, rows) in rows.chunks(LANES).enumerate() {
                for lane in 0..LANES {
                    let values = &mut own[lane * self.dimension + piece * LANES..][..rows.len()];
                    for (row, value) in rows.iter().zip(values) {
                        *value = row[lane];
                    }
                }
            }
        }
        self.in_turn = in_turn;
    }

    /// Returns a vector, if the vectors lie in turn.
    #[inline(always)]
    pub(crate) fn vector(&self, slot: usize) -> Option<&[S]> {
        let all = self.features.as_flattened();
        let start = self.place(slot, 0);
        self.in_turn.then(|| &all[start..start + self.dimension])
    }

    /// Returns where a feature of a vector is among all values.
    #[inline(always)]
    fn place(&self, slot: usize, feature: usize) -> usize {
        let (block, lane) = (slot / LANES * LANES * self.dimension, slot % LANES);
        match self.in_turn {
            true => block + lane * self.dimension + feature,
            false => block + feature * LANES + lane,
        }
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
        self.features.as_flattened()[self.place(slot, feature)]
    }

    #[inline(always)]
    pub(crate) fn put(&mut self, slot: usize, feature: usize, value: S) {
        let place = self.place(slot, feature);
        self.features.as_flattened_mut()[place] = value;
    }

    /// Empties a slot: its vector becomes infinitely far.
    pub(crate) fn vacate(&mut self, slot: usize) {
        for feature in 0..self.dimension {
            self.put(slot, feature, S::INFINITY);
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
        (0..self.dimension).map(move |feature| self.at(slot, feature))
    }

    /// Moves a prototype by `rate` of the way to `target`.
    #[inline(always)]
    pub(crate) fn approach(&mut self, slot: usize, target: &[S], rate: S) {
        let start = self.place(slot, 0);
        let own = &mut self.features.as_flattened_mut()[start..];
        if self.in_turn {
            for (value, target) in own.iter_mut().zip(target) {
                *value += rate * (*target - *value);
            }
        } else {
            for (value, target) in own.iter_mut().step_by(LANES).zip(target) {
                *value += rate * (*target - *value);
            }
        }
    }
}
