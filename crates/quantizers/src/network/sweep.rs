//! Search for the nearest units of many inputs at once, so that each unit is read once for all of
//! them.

use alloc::vec;
use alloc::vec::Vec;

use super::Network;
use super::prototypes::LANES;
use super::search::{Best, Plain, Terms, Weighted};
use crate::{InputError, Nearest, Scalar};

/// Number of inputs that are compared with a block of units while it is at hand; a multiple of
/// what is compared at once.
const TILE: usize = 96;

/// The part of an input in what is compared, summed feature after feature.
trait Fold<S>: Copy {
    /// Returns the sum with one more feature.
    fn fold(self, sum: S, feature: usize, input: S, unit: S) -> S;
    /// Returns what is compared of a block of units.
    fn values(self, sums: &[S; LANES], block: usize) -> [S; LANES];
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
    fn values(self, sums: &[S; LANES], _: usize) -> [S; LANES] {
        *sums
    }
}

/// ‖w‖² − 2 x · w, which orders the units as ‖x − w‖² does. The products are fused, which gives the
/// same bits on every machine, unlike a matrix product of BLAS.
#[derive(Clone, Copy)]
struct Product<'a, S>(&'a [[S; LANES]]);

impl<S: Scalar> Fold<S> for Product<'_, S> {
    #[inline(always)]
    fn fold(self, sum: S, _: usize, input: S, unit: S) -> S {
        input.mul_add(unit, sum)
    }
    #[inline(always)]
    fn values(self, sums: &[S; LANES], block: usize) -> [S; LANES] {
        let mut values = self.0[block];
        for (value, sum) in values.iter_mut().zip(sums) {
            *value = *value - (*sum + *sum);
        }
        values
    }
}

/// Offers all units to the `best` of each row.
#[inline(always)]
fn sweep<S: Scalar, F: Fold<S>>(
    blocks: &[[S; LANES]],
    rows: &[S],
    dimension: usize,
    fold: F,
    best: &mut [Best<S>],
) {
    let tiles = rows.chunks(TILE * dimension);
    for (rows, best) in tiles.zip(best.chunks_mut(TILE)) {
        for (number, units) in blocks.chunks_exact(dimension).enumerate() {
            // As many sums as there are registers for.
            match size_of::<S>() {
                4 => compare::<S, F, 6>(units, rows, number, fold, best),
                _ => compare::<S, F, 3>(units, rows, number, fold, best),
            }
        }
    }
}

/// Offers a block of units to all rows of a tile, `R` at once.
#[inline(always)]
fn compare<S: Scalar, F: Fold<S>, const R: usize>(
    units: &[[S; LANES]],
    rows: &[S],
    number: usize,
    fold: F,
    best: &mut [Best<S>],
) {
    let whole = best.len() / R * R;
    let (rows, others) = rows.split_at(whole * units.len());
    let (best, last) = best.split_at_mut(whole);
    let groups = rows.chunks_exact(R * units.len());
    for (rows, best) in groups.zip(best.chunks_exact_mut(R)) {
        compare_group::<S, F, R>(units, rows, number, fold, best);
    }
    for (row, best) in others
        .chunks_exact(units.len())
        .zip(last.chunks_exact_mut(1))
    {
        compare_group::<S, F, 1>(units, row, number, fold, best);
    }
}

#[inline(always)]
fn compare_group<S: Scalar, F: Fold<S>, const R: usize>(
    units: &[[S; LANES]],
    rows: &[S],
    number: usize,
    fold: F,
    best: &mut [Best<S>],
) {
    let row = |row: usize| &rows[row * units.len()..][..units.len()];
    let rows: [&[S]; R] = core::array::from_fn(row);
    let mut sums = [[S::ZERO; LANES]; R];
    for (feature, units) in units.iter().enumerate() {
        for (sums, row) in sums.iter_mut().zip(&rows) {
            let input = row[feature];
            for (sum, unit) in sums.iter_mut().zip(units) {
                *sum = fold.fold(*sum, feature, input, *unit);
            }
        }
    }
    // What follows looks at sums one by one, which else keeps the compiler from summing in lanes.
    let sums = core::hint::black_box(sums);
    for (best, sums) in best.iter_mut().zip(&sums) {
        best.offer_later(&fold.values(sums, number), number * LANES);
    }
}

impl<S: Scalar> Network<S> {
    /// Appends to `found` the unit nearest to each row of `rows`, which holds inputs in turn. Units
    /// and distances are those of [`nearest`](Self::nearest), to the bit, but each unit is read
    /// once for many inputs. With many features that is several times as fast.
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
        let mut best = vec![Best::none(); inputs.len()];
        match (&self.tree, self.metric.weights()) {
            (Some(_), _) => {
                for (input, best) in inputs.zip(&mut best) {
                    *best = self.search(input);
                }
            }
            (None, None) => self.sweep_by(rows, Exact(Plain), &mut best),
            (None, Some(weights)) => self.sweep_by(rows, Exact(Weighted(weights)), &mut best),
        }
        if self.is_empty() && !best.is_empty() {
            return Err(InputError::NoUnits);
        }
        found.extend(best.iter().filter_map(|best| self.found(best.first)));
        Ok(())
    }

    fn sweep_by(&self, rows: &[S], fold: impl Fold<S>, best: &mut [Best<S>]) {
        let blocks = self.prototypes.rows();
        self.kernels.run(
            #[inline(always)]
            || sweep(blocks, rows, self.dimension(), fold, best),
        );
    }

    /// Returns the two nearest slots to each valid input of `rows` by their products with all
    /// units, or `None` where the index is faster. Distances are left out.
    ///
    /// Inputs and units are taken from the mean of the inputs, lest the products of large numbers
    /// hide small distances.
    pub(crate) fn nearest_by_product(&self, rows: &[S]) -> Option<Vec<(u32, u32)>> {
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
        let mut units = self.prototypes.rows().to_vec();
        let mut lengths = Vec::with_capacity(units.len() / dimension);
        let weight = |feature: usize| self.weights().map(|weights| weights[feature]);
        let mut best = vec![Best::none(); count];
        self.kernels.run(
            #[inline(always)]
            || {
                for block in units.chunks_exact_mut(dimension) {
                    lengths.push(centre_block(block, &centre, weight));
                }
                sweep(&units, &centred, dimension, Product(&lengths), &mut best);
            },
        );
        let slots = best.iter().map(|best| (best.first.slot, best.second.slot));
        Some(slots.collect())
    }
}

/// Takes a block of units from `centre` and multiplies them by the weights. Returns their squared
/// lengths, infinite where there is no unit.
#[inline(always)]
fn centre_block<S: Scalar>(
    block: &mut [[S; LANES]],
    centre: &[S],
    weight: impl Fn(usize) -> Option<S>,
) -> [S; LANES] {
    let mut lengths = [S::ZERO; LANES];
    for (feature, (row, centre)) in block.iter_mut().zip(centre).enumerate() {
        let weight = weight(feature);
        for (value, length) in row.iter_mut().zip(&mut lengths) {
            let from_centre = *value - *centre;
            let weighted = weight.map_or(from_centre, |weight| weight * from_centre);
            *length += weighted * from_centre;
            *value = weighted;
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
