//! Search for the nearest units of many inputs at once, so that each unit is read once for many of
//! them.

use alloc::vec;
use alloc::vec::Vec;

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

/// Number of units from which on products pay for turning inputs and units. With 100 units,
/// comparing distances row by row took 0.4 to 0.7 times as long; with 1000 units, 1.4 to 4.8 times.
const MANY: usize = 256;

/// Number of distances that are summed at once, as each sum waits for itself.
const AT_ONCE: usize = 8;

/// Offers all units of `blocks`, whose squared lengths are `lengths`, to the `best` of each row.
///
/// What is compared is ‖w‖² − 2 x · w, which orders the units as ‖x − w‖² does. The products are
/// fused, which gives the same bits on every machine, unlike a matrix product of BLAS.
#[inline(always)]
fn sweep<S: Scalar>(
    registers: Registers,
    blocks: &[[S; LANES]],
    lengths: &[S],
    rows: &[S],
    dimension: usize,
    best: &mut [Best<S>],
) {
    let dot = Sweep {
        blocks,
        lengths,
        rows,
        dimension,
    };
    // As many sums as there are registers for, less those for a row of units and an input.
    match (registers.count, registers.size) {
        (32, 64) => dot.run::<12, LANES>(best),
        (_, 32) => dot.run::<6, { LANES / 2 }>(best),
        _ => dot.run::<3, LANES>(best),
    }
}

struct Sweep<'a, S> {
    blocks: &'a [[S; LANES]],
    lengths: &'a [S],
    rows: &'a [S],
    dimension: usize,
}

impl<S: Scalar> Sweep<'_, S> {
    /// Compares `R` rows with `W` units at once.
    #[inline(always)]
    fn run<const R: usize, const W: usize>(&self, best: &mut [Best<S>]) {
        let dimension = self.dimension;
        // The same feature of `R` rows side by side, so that all are read in turn.
        let mut groups = vec![[S::ZERO; R]; best.len().div_ceil(R) * dimension];
        let rows = self.rows.chunks(R * dimension);
        for (rows, group) in rows.zip(groups.chunks_exact_mut(dimension)) {
            // Some features at a time, whose values stay at hand while they are written.
            for (piece, group) in group.chunks_mut(LANES).enumerate() {
                for (place, row) in rows.chunks_exact(dimension).enumerate() {
                    let row = &row[piece * LANES..][..group.len()];
                    for (values, value) in group.iter_mut().zip(row) {
                        values[place] = *value;
                    }
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
        for (units, inputs) in units.iter().zip(group) {
            for (sums, input) in sums.iter_mut().zip(inputs) {
                for (sum, unit) in sums.iter_mut().zip(&units[first..first + W]) {
                    *sum = input.mul_add(*unit, *sum);
                }
            }
        }
        // What follows looks at sums one by one, which else keeps the compiler from summing in
        // lanes.
        let mut sums = core::hint::black_box(sums);
        let lengths = &self.lengths[slot + first..][..W];
        for sums in &mut sums {
            for (sum, length) in sums.iter_mut().zip(lengths) {
                *sum = *length - (*sum + *sum);
            }
        }
        sums
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
            _ if self.len() < MANY => None,
            _ => self.nearest_by_product(rows),
        };
        let Some(products) = products else {
            found.extend(inputs.filter_map(|input| self.found(self.search_first(input))));
            return Ok(());
        };
        let mut units = self.prototypes.clone();
        units.lie_in_turn(true);
        let mut best = Vec::with_capacity(products.best.len());
        let pieces = rows.chunks(AT_ONCE * self.dimension());
        for (rows, by_product) in pieces.zip(products.best.chunks(AT_ONCE)) {
            best.extend(self.distances(rows, &units, by_product));
        }
        for row in products.doubtful(self.dimension()) {
            best[row] = self.search_first(&rows[row * self.dimension()..][..self.dimension()]);
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
        let dimension = self.dimension();
        // Where there are fewer, the first is summed again, for nobody.
        let (first, none) = (&rows[..dimension], vec![S::ZERO; dimension]);
        let mut vectors: [(&[S], &[S]); AT_ONCE] = [(first, &none); AT_ONCE];
        for ((pair, input), best) in vectors.iter_mut().zip(rows.chunks(dimension)).zip(best) {
            *pair = (
                input,
                units.vector(best.first.slot as usize).unwrap_or(&none),
            );
        }
        let sums = match self.weights() {
            None => sum_abreast(&vectors, dimension, Plain),
            Some(weights) => sum_abreast(&vectors, dimension, Weighted(weights)),
        };
        let found = best.iter().zip(sums);
        found.map(|(best, squared_distance)| Candidate {
            squared_distance,
            slot: best.first.slot,
        })
    }

    /// Returns the two nearest slots to each valid input of `rows` by their products with all
    /// units, or `None` where a search for each is faster.
    ///
    /// Inputs and units are taken from the mean of the inputs, lest the products of large numbers
    /// hide small distances.
    pub(crate) fn nearest_by_product(&self, rows: &[S]) -> Option<Products<S>> {
        // Products of 32-bit numbers leave most inputs of many features in doubt, and the compiler
        // keeps their sums in memory: comparing distances is several times as fast.
        if self.tree.is_some() || size_of::<S>() == 4 {
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
        let mut centred = rows.to_vec();
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
                for input in centred.chunks_exact_mut(dimension) {
                    for (value, centre) in input.iter_mut().zip(&centre) {
                        *value = *value - *centre;
                    }
                    inputs.push(squared_distance(input, &none, weights));
                }
                sweep(registers, &units, &lengths, &centred, dimension, &mut best);
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

/// Returns the squared distances of some pairs of vectors of one size, each summed feature after
/// feature.
#[inline(always)]
fn sum_abreast<S: Scalar, const N: usize>(
    pairs: &[(&[S], &[S]); N],
    dimension: usize,
    terms: impl Terms<S>,
) -> [S; N] {
    let pairs = pairs.map(|(one, other)| (&one[..dimension], &other[..dimension]));
    let mut sums = [S::ZERO; N];
    for feature in 0..dimension {
        for (sum, (one, other)) in sums.iter_mut().zip(&pairs) {
            *sum += terms.square(feature, one[feature] - other[feature]);
        }
    }
    sums
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
