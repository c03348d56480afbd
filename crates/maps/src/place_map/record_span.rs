use alloc::vec;
use alloc::vec::Vec;

/// A change of basis for few vectors of many values: orthonormal coordinates in the vectors' span.
/// Distances between vectors stay the same, up to what is left out.
///
/// Found by Cholesky's factorization of the vectors' inner products. Each step chooses the vector
/// that is farthest from the span so far. This avoids a matrix of principal axes, which would take
/// ten times as long.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RecordSpan {
    mean: Vec<f32>,
    /// Chosen vectors minus the mean, one by one.
    chosen: Vec<f32>,
    /// Lower triangle: row i has the coordinates of the i-th chosen vector. Rows are stored one by
    /// one, each longer than the one before.
    factor: Vec<f64>,
    /// Number of chosen vectors, which is the number of coordinates.
    rank: usize,
}

/// The span of some vectors and the coordinates of each.
#[derive(Debug)]
pub(super) struct Spanned {
    pub(super) span: RecordSpan,
    /// Coordinates by vector, `span.rank` each.
    pub(super) coordinates: Vec<Vec<f32>>,
}

impl RecordSpan {
    /// Spans vectors of one length. Stops once the squared distance of every vector from the span
    /// is small enough. The limit is the share `left_out` of the vectors' mean squared distance
    /// from their mean. O(n² (length + n)).
    pub(super) fn of(vectors: &[Vec<f32>], left_out: f64) -> Spanned {
        let mean = mean(vectors);
        let centred: Vec<Vec<f32>> = vectors
            .iter()
            .map(|vector| vector.iter().zip(&mean).map(|(x, m)| x - m).collect())
            .collect();
        let mut growing = Growing::new(centred, left_out);
        while growing.grow() {}
        growing.finish(mean)
    }

    fn row(&self, row: usize) -> &[f64] {
        let start = row * (row + 1) / 2;
        &self.factor[start..=start + row]
    }

    fn chosen(&self, index: usize) -> &[f32] {
        let length = self.mean.len();
        &self.chosen[index * length..(index + 1) * length]
    }

    /// Returns the coordinates of the point of the span nearest to a vector. O(rank (length +
    /// rank)).
    pub(super) fn coordinates(&self, vector: &[f32]) -> Vec<f32> {
        let centred: Vec<f32> = vector.iter().zip(&self.mean).map(|(x, m)| x - m).collect();
        let mut solved: Vec<f64> = Vec::with_capacity(self.rank);
        for index in 0..self.rank {
            let row = self.row(index);
            let known: f64 = row.iter().zip(&solved).map(|(a, b)| a * b).sum();
            let rest = dot(&centred, self.chosen(index)) - known;
            solved.push(rest / row[index]);
        }
        solved.into_iter().map(|value| value as f32).collect()
    }

    /// Returns the vector with these coordinates. O(rank (length + rank)).
    pub(super) fn vector(&self, coordinates: &[f32]) -> Vec<f32> {
        let mut parts: Vec<f64> = coordinates.iter().map(|value| f64::from(*value)).collect();
        for index in (0..self.rank.min(parts.len())).rev() {
            let row = self.row(index);
            let part = parts[index] / row[index];
            parts[index] = part;
            for (other, value) in parts[..index].iter_mut().zip(row) {
                *other -= part * value;
            }
        }
        let mut vector: Vec<f64> = self.mean.iter().map(|value| f64::from(*value)).collect();
        for (index, part) in parts.iter().enumerate() {
            for (value, axis) in vector.iter_mut().zip(self.chosen(index)) {
                *value += part * f64::from(*axis);
            }
        }
        vector.into_iter().map(|value| value as f32).collect()
    }
}

/// The factorization in progress.
struct Growing {
    vectors: Vec<Vec<f32>>,
    /// Coordinates by vector, as far as they are known.
    coordinates: Vec<Vec<f64>>,
    /// Squared distance of each vector from the span; `None` for chosen vectors.
    missing: Vec<Option<f64>>,
    chosen: Vec<usize>,
    enough: f64,
}

impl Growing {
    fn new(vectors: Vec<Vec<f32>>, left_out: f64) -> Self {
        let squares: Vec<f64> = vectors.iter().map(|vector| dot(vector, vector)).collect();
        let mean_square = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
        Self {
            coordinates: vec![Vec::new(); vectors.len()],
            missing: squares.into_iter().map(Some).collect(),
            vectors,
            chosen: Vec::new(),
            // Less than this is rounding of `f32`.
            enough: mean_square * left_out.max(1e-10),
        }
    }

    /// Adds the vector that is farthest from the span. Returns `false` if none is far enough.
    fn grow(&mut self) -> bool {
        let candidates = self.missing.iter().enumerate();
        let candidates = candidates.filter_map(|(index, missing)| Some((index, (*missing)?)));
        let farther = |a: (usize, f64), b: (usize, f64)| if b.1 > a.1 { b } else { a };
        let Some((pivot, missing)) = candidates.reduce(farther) else {
            return false;
        };
        if missing <= self.enough {
            return false;
        }
        self.span_by(pivot, libm::sqrt(missing));
        true
    }

    fn span_by(&mut self, pivot: usize, length: f64) {
        let axis = self.coordinates[pivot].clone();
        for index in 0..self.vectors.len() {
            let Some(missing) = self.missing[index] else {
                // Chosen before, so it has no part along what is new.
                self.coordinates[index].push(0.0);
                continue;
            };
            let product = dot(&self.vectors[index], &self.vectors[pivot]);
            let known = sum_of_products(&self.coordinates[index], &axis);
            let coordinate = (product - known) / length;
            self.coordinates[index].push(coordinate);
            self.missing[index] = Some((missing - coordinate * coordinate).max(0.0));
        }
        if let Some(own) = self.coordinates[pivot].last_mut() {
            *own = length;
        }
        self.missing[pivot] = None;
        self.chosen.push(pivot);
    }

    fn finish(self, mean: Vec<f32>) -> Spanned {
        let rank = self.chosen.len();
        let mut factor = Vec::with_capacity(rank * (rank + 1) / 2);
        let mut chosen = Vec::with_capacity(rank * mean.len());
        for (row, pivot) in self.chosen.iter().enumerate() {
            factor.extend_from_slice(&self.coordinates[*pivot][..=row]);
            chosen.extend_from_slice(&self.vectors[*pivot]);
        }
        let single = |row: Vec<f64>| row.into_iter().map(|value| value as f32).collect();
        Spanned {
            span: RecordSpan {
                mean,
                chosen,
                factor,
                rank,
            },
            coordinates: self.coordinates.into_iter().map(single).collect(),
        }
    }
}

fn mean(vectors: &[Vec<f32>]) -> Vec<f32> {
    let length = vectors.first().map_or(0, Vec::len);
    let mut sums = vec![0.0_f64; length];
    for vector in vectors {
        for (sum, value) in sums.iter_mut().zip(vector) {
            *sum += f64::from(*value);
        }
    }
    let count = vectors.len().max(1) as f64;
    sums.into_iter().map(|sum| (sum / count) as f32).collect()
}

/// Number of partial sums, which the processor computes at once. The order of terms is the same
/// everywhere.
const LANES: usize = 8;

/// Returns Σ a b, summed in `f64`.
fn dot(a: &[f32], b: &[f32]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0_f64; LANES];
    for (a, b) in a.iter().zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += f64::from(*a) * f64::from(*b);
        }
    }
    let rest = a_rest.iter().zip(b_rest);
    let rest = rest.map(|(a, b)| f64::from(*a) * f64::from(*b));
    sums.iter().sum::<f64>() + rest.sum::<f64>()
}

fn sum_of_products(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0_f64; LANES];
    for (a, b) in a.iter().zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    fn vectors(count: usize, length: usize) -> Vec<Vec<f32>> {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let mut vector = || (0..length).map(|_| rng.random_range(0.0..1.0)).collect();
        (0..count).map(|_| vector()).collect()
    }

    fn squared_distance(a: &[f32], b: &[f32]) -> f64 {
        let squares = a
            .iter()
            .zip(b)
            .map(|(a, b)| f64::from(a - b) * f64::from(a - b));
        squares.sum()
    }

    #[test]
    fn distances_stay_what_they_are() {
        // Fewer vectors than values, and more.
        for (count, length) in [(20, 300), (50, 7)] {
            let vectors = vectors(count, length);
            let Spanned { span, coordinates } = RecordSpan::of(&vectors, 0.0);
            assert!(span.rank < count && span.rank <= length, "{}", span.rank);
            for a in 0..count {
                for b in 0..a {
                    let expect = squared_distance(&vectors[a], &vectors[b]);
                    let found = squared_distance(&coordinates[a], &coordinates[b]);
                    assert!((found / expect - 1.0).abs() < 1e-4, "{expect} {found}");
                }
            }
        }
    }

    #[test]
    fn vectors_come_back_from_their_coordinates() {
        let vectors = vectors(12, 40);
        let Spanned { span, coordinates } = RecordSpan::of(&vectors, 0.0);
        for (vector, coordinates) in vectors.iter().zip(&coordinates) {
            assert!(squared_distance(&span.vector(coordinates), vector) < 1e-9);
            assert!(squared_distance(&span.coordinates(vector), coordinates) < 1e-9);
        }
        // Half-way between coordinates lies what is half-way between vectors, as a unit of a
        // network is.
        let half = |a: &[f32], b: &[f32]| -> Vec<f32> {
            a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect()
        };
        let middle = span.vector(&half(&coordinates[3], &coordinates[8]));
        assert!(squared_distance(&middle, &half(&vectors[3], &vectors[8])) < 1e-9);
    }

    #[test]
    fn what_is_left_out_is_bounded() {
        let vectors = vectors(40, 200);
        let Spanned { span, coordinates } = RecordSpan::of(&vectors, 0.3);
        assert!(span.rank < 39);
        let spread: f64 = vectors
            .iter()
            .map(|v| squared_distance(v, &span.mean))
            .sum();
        for (vector, coordinates) in vectors.iter().zip(&coordinates) {
            let missed = squared_distance(&span.vector(coordinates), vector);
            assert!(missed <= 0.3 * spread / 40.0 + 1e-9);
        }
    }

    #[test]
    fn equal_vectors_span_nothing() {
        let Spanned { span, coordinates } = RecordSpan::of(&vec![vec![0.5; 9]; 4], 0.0);
        assert_eq!(span.rank, 0);
        assert_eq!(span.vector(&coordinates[0]), vec![0.5; 9]);
    }
}
