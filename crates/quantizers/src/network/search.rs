//! Search for the nearest units by comparing all, many at once.

use super::prototypes::{LANES, Prototypes};
use crate::Scalar;

/// The two nearest slots so far, ordered by distance, then by slot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Best<S> {
    pub(crate) first: Candidate<S>,
    pub(crate) second: Candidate<S>,
}

/// A slot and its squared distance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<S> {
    pub(crate) squared_distance: S,
    pub(crate) slot: u32,
}

impl<S: Scalar> Candidate<S> {
    #[inline(always)]
    fn is_nearer_than(self, other: Self) -> bool {
        self.squared_distance < other.squared_distance
            || (self.squared_distance <= other.squared_distance && self.slot < other.slot)
    }
}

impl<S: Scalar> Best<S> {
    #[inline(always)]
    pub(crate) fn none() -> Self {
        let nothing = Candidate {
            squared_distance: S::INFINITY,
            slot: u32::MAX,
        };
        Self {
            first: nothing,
            second: nothing,
        }
    }

    /// Returns the squared distance beyond which a unit cannot be one of the two, or with `FIRST`
    /// the first.
    #[inline(always)]
    pub(super) fn worst<const FIRST: bool>(&self) -> S {
        match FIRST {
            true => self.first.squared_distance,
            false => self.second.squared_distance,
        }
    }

    #[inline(always)]
    pub(crate) fn offer(&mut self, candidate: Candidate<S>) {
        if candidate.is_nearer_than(self.second) {
            if candidate.is_nearer_than(self.first) {
                self.second = self.first;
                self.first = candidate;
            } else {
                self.second = candidate;
            }
        }
    }

    /// Offers a block of slots behind all that were offered before, which therefore lose ties.
    #[inline(always)]
    pub(super) fn offer_later<const N: usize>(&mut self, sums: &[S; N], start: usize) {
        let bound = self.second.squared_distance;
        let mut some = false;
        for sum in sums {
            some |= *sum < bound;
        }
        if !some {
            return;
        }
        for (lane, squared_distance) in sums.iter().copied().enumerate() {
            if squared_distance < self.second.squared_distance {
                self.offer(Candidate {
                    squared_distance,
                    slot: (start + lane) as u32,
                });
            }
        }
    }
}

/// One term of a squared distance. All distances are computed from these, feature after feature, so
/// that all agree to the bit.
pub(crate) trait Terms<S>: Copy {
    /// Returns the term of `feature` if it differs by `difference`; 0 if it is not compared.
    fn square(self, feature: usize, difference: S) -> S;
    /// Returns whether the feature is compared.
    fn compares(self, feature: usize) -> bool;
}

/// Terms in which all features count alike.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

/// Terms in which each feature counts by its weight.
#[derive(Clone, Copy)]
pub(crate) struct Weighted<'a, S>(pub(crate) &'a [S]);

/// Terms that leave out the features whose flag is not set.
#[derive(Clone, Copy)]
pub(crate) struct Masked<'a, T>(pub(crate) T, pub(crate) &'a [bool]);

impl<S: Scalar> Terms<S> for Plain {
    #[inline(always)]
    fn square(self, _: usize, difference: S) -> S {
        difference * difference
    }
    #[inline(always)]
    fn compares(self, _: usize) -> bool {
        true
    }
}

impl<S: Scalar> Terms<S> for Weighted<'_, S> {
    #[inline(always)]
    fn square(self, feature: usize, difference: S) -> S {
        self.0[feature] * (difference * difference)
    }
    #[inline(always)]
    fn compares(self, _: usize) -> bool {
        true
    }
}

impl<S: Scalar, T: Terms<S>> Terms<S> for Masked<'_, T> {
    #[inline(always)]
    fn square(self, feature: usize, difference: S) -> S {
        self.0.square(feature, difference)
    }
    #[inline(always)]
    fn compares(self, feature: usize) -> bool {
        self.1[feature]
    }
}

/// Offers all units to `best`. Slots count from 0.
///
/// Two blocks abreast keep the processor busy while each waits for its own sums.
#[inline(always)]
pub(crate) fn scan<S: Scalar>(
    prototypes: &Prototypes<S>,
    input: &[S],
    terms: impl Terms<S>,
    best: &mut Best<S>,
) {
    let mut pairs = prototypes.rows().chunks_exact(2 * input.len());
    let mut start = 0;
    for pair in &mut pairs {
        compare::<S, 2>(pair, input, terms, start, best);
        start += 2 * LANES;
    }
    for single in pairs.remainder().chunks_exact(input.len()) {
        compare::<S, 1>(single, input, terms, start, best);
    }
}

/// Offers the units of `N` blocks.
#[inline(always)]
fn compare<S: Scalar, const N: usize>(
    rows: &[[S; LANES]],
    input: &[S],
    terms: impl Terms<S>,
    start: usize,
    best: &mut Best<S>,
) {
    let mut sums = [[S::ZERO; LANES]; N];
    for (feature, value) in input.iter().enumerate() {
        if terms.compares(feature) {
            for (block, sums) in sums.iter_mut().enumerate() {
                let row = &rows[block * input.len() + feature];
                for (sum, other) in sums.iter_mut().zip(row) {
                    *sum += terms.square(feature, *value - *other);
                }
            }
        }
    }
    for (block, sums) in sums.iter().enumerate() {
        best.offer_later(sums, start + block * LANES);
    }
}
