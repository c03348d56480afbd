//! Search for the nearest units of many inputs at once, so that each unit is read once for many of
//! them.

use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

use super::kernels::Registers;
use super::prototypes::{LANES, Prototypes};
use super::search::{Best, Candidate, Plain, Terms, Weighted};
use super::{Network, squared_distance};
use crate::{InputError, Nearest, Scalar};

/// Number of values of inputs that are compared with a block of units while it is at hand: half of
/// a usual second-level cache.
const TILE: usize = 65_536;

/// Number of inputs that are too few for products with all units.
pub(crate) const FEW: usize = 8;

/// Number of distances that are summed at once, as each sum waits for itself.
const AT_ONCE: usize = 8;

/// The part of an input in what is compared, summed feature after feature.
trait Fold<S>: Copy {
    /// Returns the sum with one more feature.
    fn fold(self, sum: S, feature: usize, input: S, unit: S) -> S;
    /// Returns what is compared of the units from `slot` on.
    fn values<const W: usize>(self, sums: [S; W], slot: usize) -> [S; W];
}

/// Squared distances, summed as the search for one input sums them.
#[derive(Clone, Copy)]
struct Exact<T>(T);

impl<S: Scalar, T: Terms<S>> Fold<S> for Exact<T> {
    #[inline(always)]
    fn fold(self, sum: S, feature: usize, input: S, unit: S) -> S {
        sum + self.0.square(feature, input - unit)
    }
    #[inline(always)]
    fn values<const W: usize>(self, sums: [S; W], _: usize) -> [S; W] {
        sums
    }
}

/// ‖w‖² − 2 x · w, which orders the units as ‖x − w‖² does. The products are fused, which gives the
/// same bits on every machine, unlike a matrix product of BLAS.
#[derive(Clone, Copy)]
struct Product<'a, S>(&'a [S]);

impl<S: Scalar> Fold<S> for Product<'_, S> {
    #[inline(always)]
    fn fold(self, sum: S, _: usize, input: S, unit: S) -> S {
        input.mul_add(unit, sum)
    }
    #[inline(always)]
    fn values<const W: usize>(self, mut sums: [S; W], slot: usize) -> [S; W] {
        for (sum, length) in sums.iter_mut().zip(&self.0[slot..slot + W]) {
            *sum = *length - (*sum + *sum);
        }
        sums
    }
}

/// Offers all units of `blocks` to the `best` of each row.
#[inline(always)]
fn sweep<S: Scalar, F: Fold<S>>(
    registers: Registers,
    blocks: &[[S; LANES]],
    rows: &[S],
    dimension: usize,
    fold: F,
    best: &mut [Best<S>],
) {
    let dot = Sweep {
        blocks,
        rows,
        dimension,
        fold,
        scalar: PhantomData,
    };
    // As many sums as there are registers for, less those for a row of units and an input.
    match (registers.count, registers.size, size_of::<S>()) {
        (32, 64, 4) => dot.run::<24, LANES>(best),
        (32, 64, _) => dot.run::<12, LANES>(best),
        (_, 32, 8) => dot.run::<6, { LANES / 2 }>(best),
        (_, _, 4) => dot.run::<6, LANES>(best),
        _ => dot.run::<3, LANES>(best),
    }
}

struct Sweep<'a, S, F> {
    blocks: &'a [[S; LANES]],
    rows: &'a [S],
    dimension: usize,
    fold: F,
    scalar: PhantomData<S>,
}

impl<S: Scalar, F: Fold<S>> Sweep<'_, S, F> {
    /// Compares `R` rows with `W` units at once.
    #[inline(always)]
    fn run<const R: usize, const W: usize>(&self, best: &mut [Best<S>]) {
        let dimension = self.dimension;
        // The same feature of `R` rows side by side, so that all are read in turn.
        let mut groups = vec![[S::ZERO; R]; best.len().div_ceil(R) * dimension];
        let rows = self.rows.chunks(R * dimension);
        for (rows, group) in rows.zip(groups.chunks_exact_mut(dimension)) {
            for (place, row) in rows.chunks_exact(dimension).enumerate() {
                for (values, value) in group.iter_mut().zip(row) {
                    values[place] = *value;
                }
            }
        }
        let tile = (TILE / dimension / R).max(1);
        let tiles = groups.chunks(tile * dimension);
        for (groups, best) in tiles.zip(best.chunks_mut(tile * R)) {
            for (number, units) in self.blocks.chunks_exact(dimension).enumerate() {
                let groups = groups.chunks_exact(dimension);
                for (group, best) in groups.zip(best.chunks_mut(R)) {
                    for first in (0..LANES).step_by(W) {
                        let values = self.compare::<R, W>(units, first, group, number * LANES);
                        for (best, values) in best.iter_mut().zip(&values) {
                            best.offer_later(values, number * LANES + first);
                        }
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn compare<const R: usize, const W: usize>(
        &self,
        units: &[[S; LANES]],
        first: usize,
        group: &[[S; R]],
        slot: usize,
    ) -> [[S; W]; R] {
        let mut sums = [[S::ZERO; W]; R];
        for (feature, (units, inputs)) in units.iter().zip(group).enumerate() {
            for (sums, input) in sums.iter_mut().zip(inputs) {
                for (sum, unit) in sums.iter_mut().zip(&units[first..first + W]) {
                    *sum = self.fold.fold(*sum, feature, *input, *unit);
                }
            }
        }
        // What follows looks at sums one by one, which else keeps the compiler from summing in
        // lanes.
        let sums = core::hint::black_box(sums);
        sums.map(
            #[inline(always)]
            |sums| self.fold.values(sums, slot + first),
        )
    }
}

impl<S: Scalar> Network<S> {
    /// Appends to `found` the unit nearest to each row of `rows`, which holds inputs in turn. Units
    /// and distances are those of [`nearest`](Self::nearest), to the bit, but found many times as
    /// fast with many features: products of inputs and units tell which unit is the nearest, unless
    /// two are so near that rounding could have exchanged them. Then distances are compared.
    ///
    /// # Errors
    /// If `rows` is not a whole number of inputs, one of them is invalid, or there are no units.
    /// Nothing is appended then.
    ///
    /// # Complexity
    /// Inputs × units × features.
    pub fn nearest_rows(&self, rows: &[S], found: &mut Vec<Nearest<S>>) -> Result<(), InputError> {
        let inputs = rows.chunks(self.dimension());
        for input in inputs.clone() {
            self.check(input)?;
        }
        if self.is_empty() && inputs.len() > 0 {
            return Err(InputError::NoUnits);
        }
        let products = match inputs.len() {
            0..FEW => None,
            _ => self.nearest_by_product(rows),
        };
        let Some(products) = products else {
            found.extend(inputs.filter_map(|input| self.found(self.search(input).first)));
            return Ok(());
        };
        let mut units = self.prototypes.clone();
        units.lie_in_turn(true);
        let mut best = Vec::with_capacity(products.best.len());
        let pieces = rows.chunks(AT_ONCE * self.dimension());
        for (rows, by_product) in pieces.zip(products.best.chunks(AT_ONCE)) {
            best.extend(self.distances(rows, &units, by_product));
        }
        let doubtful: Vec<usize> = products.doubtful(self.dimension()).collect();
        let again = doubtful.iter().map(|row| &rows[row * self.dimension()..]);
        let again = again.flat_map(|row| &row[..self.dimension()]).copied();
        let again: Vec<S> = again.collect();
        for (row, by_distance) in doubtful.iter().zip(self.nearest_by_distance(&again)) {
            best[*row] = by_distance.first;
        }
        found.extend(best.iter().filter_map(|best| self.found(*best)));
        Ok(())
    }

    /// Returns the first candidates of up to [`AT_ONCE`] inputs with their distances, summed as the
    /// search sums them. The units lie in turn.
    fn distances(
        &self,
        rows: &[S],
        units: &Prototypes<S>,
        best: &[Best<S>],
    ) -> impl Iterator<Item = Candidate<S>> {
        let mut vectors: [(&[S], &[S]); AT_ONCE] = [(&[], &[]); AT_ONCE];
        let inputs = rows.chunks_exact(self.dimension());
        for ((pair, input), best) in vectors.iter_mut().zip(inputs).zip(best) {
            *pair = (input, units.vector(best.first.slot as usize).unwrap_or(&[]));
        }
        let mut sums = [S::ZERO; AT_ONCE];
        for feature in 0..self.dimension() {
            let weight = self.weights().map(|weights| weights[feature]);
            for (sum, (input, unit)) in sums.iter_mut().zip(&vectors) {
                if let (Some(input), Some(unit)) = (input.get(feature), unit.get(feature)) {
                    let square = (*input - *unit) * (*input - *unit);
                    *sum += weight.map_or(square, |weight| weight * square);
                }
            }
        }
        let found = best.iter().zip(sums);
        found.map(|(best, squared_distance)| Candidate {
            squared_distance,
            slot: best.first.slot,
        })
    }

    fn nearest_by_distance(&self, rows: &[S]) -> Vec<Best<S>> {
        match self.metric.weights() {
            None => self.sweep_by(rows, Exact(Plain)),
            Some(weights) => self.sweep_by(rows, Exact(Weighted(weights))),
        }
    }

    fn sweep_by(&self, rows: &[S], fold: impl Fold<S>) -> Vec<Best<S>> {
        let (blocks, dimension) = (self.prototypes.rows(), self.dimension());
        let mut best = vec![Best::none(); rows.len() / dimension];
        self.kernels.run_in(
            #[inline(always)]
            |registers| sweep(registers, blocks, rows, dimension, fold, &mut best),
        );
        best
    }

    /// Returns the two nearest slots to each valid input of `rows` by their products with all
    /// units, or `None` where the index is faster.
    ///
    /// Inputs and units are taken from the mean of the inputs, lest the products of large numbers
    /// hide small distances.
    pub(crate) fn nearest_by_product(&self, rows: &[S]) -> Option<Products<S>> {
        if self.tree.is_some() {
            return None;
        }
        let dimension = self.dimension();
        let count = rows.len() / dimension;
        let mut centre = vec![0.0; dimension];
        for input in rows.chunks_exact(dimension) {
            for (sum, value) in centre.iter_mut().zip(input) {
                *sum += value.to_f64();
            }
        }
        let centre = centre.iter().map(|sum| S::from_f64(sum / count as f64));
        let centre: Vec<S> = centre.collect();
        let centred = rows.chunks_exact(dimension).flat_map(|input| {
            let pairs = input.iter().zip(&centre);
            pairs.map(|(value, centre)| *value - *centre)
        });
        let centred: Vec<S> = centred.collect();
        let blocks = self.ids.len().div_ceil(LANES);
        let mut units = vec![[S::ZERO; LANES]; blocks * dimension];
        let mut lengths = Vec::with_capacity(blocks * LANES);
        let mut best = vec![Best::none(); count];
        let mut inputs = Vec::with_capacity(count);
        let weights = self.weights();
        self.kernels.run_in(
            #[inline(always)]
            |registers| {
                for (number, block) in units.chunks_exact_mut(dimension).enumerate() {
                    self.prototypes.copy_block(number, block);
                    lengths.extend(match weights {
                        None => centre_block(block, &centre, |_, value| value),
                        Some(weights) => {
                            centre_block(block, &centre, |feature, value| weights[feature] * value)
                        }
                    });
                }
                let none = vec![S::ZERO; dimension];
                for input in centred.chunks_exact(dimension) {
                    inputs.push(squared_distance(input, &none, weights));
                }
                let fold = Product(&lengths);
                sweep(registers, &units, &centred, dimension, fold, &mut best);
            },
        );
        let finite = lengths.iter().filter(|length| length.is_finite());
        let longest = finite.map(|length| length.to_f64()).fold(0.0, f64::max);
        Some(Products {
            best,
            inputs,
            longest,
        })
    }
}

/// The two nearest slots to each of some inputs, by products.
pub(crate) struct Products<S> {
    pub(crate) best: Vec<Best<S>>,
    /// The squared length of each input, from the centre.
    inputs: Vec<S>,
    /// The largest squared length of a unit, from the centre.
    longest: f64,
}

impl<S: Scalar> Products<S> {
    /// Returns the inputs to which another slot could be nearer than the first, as far as rounding
    /// lets one tell.
    ///
    /// With n features and the unit roundoff u, lengths, products and distances are each off by at
    /// most (n + 4) u (‖x‖ + ‖w‖)², from the centre, as n terms are summed; subnormal terms add
    /// less than the smallest normal number each. So are both values that are compared.
    fn doubtful(&self, features: usize) -> impl Iterator<Item = usize> {
        let terms = (features + 4) as f64;
        let longest = libm::sqrt(self.longest);
        let inputs = self.best.iter().zip(&self.inputs).enumerate();
        inputs.filter_map(move |(number, (best, squared))| {
            let lengths = libm::sqrt(squared.to_f64()) + longest;
            // Three such errors on either side; a unit roundoff is half an epsilon.
            let margin = 3.0 * terms * S::EPSILON * lengths * lengths + 8.0 * terms * S::TINY;
            let (first, second) = (best.first.squared_distance, best.second.squared_distance);
            let apart = second.to_f64() - first.to_f64();
            (apart <= margin).then_some(number)
        })
    }
}

/// Takes a block of units from `centre` and weighs them. Returns their squared lengths, infinite
/// where there is no unit.
#[inline(always)]
fn centre_block<S: Scalar>(
    block: &mut [[S; LANES]],
    centre: &[S],
    weigh: impl Fn(usize, S) -> S,
) -> [S; LANES] {
    let mut lengths = [S::ZERO; LANES];
    for (feature, (row, centre)) in block.iter_mut().zip(centre).enumerate() {
        for (value, length) in row.iter_mut().zip(&mut lengths) {
            let from_centre = *value - *centre;
            let weighed = weigh(feature, from_centre);
            *length += weighed * from_centre;
            *value = weighed;
        }
    }
    for (lane, length) in lengths.iter().enumerate() {
        if !length.is_finite() {
            for row in block.iter_mut() {
                row[lane] = S::ZERO;
            }
        }
    }
    lengths
}
