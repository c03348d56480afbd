//! Inputs for the tests.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Points spread evenly over the unit cube.
pub(crate) fn cube(dimension: usize, len: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut point = || (0..dimension).map(|_| rng.random_range(0.0..1.0)).collect();
    (0..len).map(|_| point()).collect()
}

/// Returns the same in `f32`.
pub(crate) fn narrowed(inputs: &[Vec<f64>]) -> Vec<Vec<f32>> {
    let narrow = |input: &Vec<f64>| input.iter().map(|value| *value as f32).collect();
    inputs.iter().map(narrow).collect()
}

/// Points that lie on few places of a grid, so that equal distances are common.
pub(crate) fn grid(dimension: usize, len: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut point = || {
        let value = |_| f64::from(rng.random_range(0..4_u32));
        (0..dimension).map(value).collect()
    };
    (0..len).map(|_| point()).collect()
}
