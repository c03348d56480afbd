//! Which units are nearest: all of them are looked at, many abreast.

use super::prototypes::LANES;
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
}

/// One term of a squared distance. Everything that computes distances does it by these, feature after
/// feature, so that all agree to the bit.
pub(crate) trait Terms<S>: Copy {
    /// What feature `feature` adds if it differs by `difference`; none if it is not compared.
    fn square(self, feature: usize, difference: S) -> S;
    /// Whether the feature is compared at all.
    fn compares(self, feature: usize) -> bool;
}

/// All features alike.
#[derive(Clone, Copy)]
pub(crate) struct Plain;

/// Each feature by its weight.
#[derive(Clone, Copy)]
pub(crate) struct Weighted<'a, S>(pub(crate) &'a [S]);

/// Only features whose flag is set.
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

/// Offers all units of `blocks` to `best`. Slots count from 0.
#[inline(always)]
pub(crate) fn scan<'a, S: Scalar>(
    blocks: impl Iterator<Item = &'a [[S; LANES]]>,
    input: &[S],
    terms: impl Terms<S>,
    best: &mut Best<S>,
) {
    for (block, rows) in blocks.enumerate() {
        let mut sums = [S::ZERO; LANES];
        for (feature, (row, value)) in rows.iter().zip(input).enumerate() {
            if terms.compares(feature) {
                for lane in 0..LANES {
                    sums[lane] += terms.square(feature, *value - row[lane]);
                }
            }
        }
        // Later slots lose ties, so only what is strictly nearer matters.
        let bound = best.second.squared_distance;
        let mut some = false;
        for sum in sums {
            some |= sum < bound;
        }
        if some {
            for (lane, squared_distance) in sums.into_iter().enumerate() {
                let slot = (block * LANES + lane) as u32;
                best.offer(Candidate {
                    squared_distance,
                    slot,
                });
            }
        }
    }
}
