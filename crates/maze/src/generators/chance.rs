//! Draws over `u32`, so that 32-bit and 64-bit machines generate the same mazes.

use rand::{Rng, RngExt};

/// Returns a random position in a list of `len` items, which must not be empty.
pub(super) fn position(len: usize, rng: &mut impl Rng) -> usize {
    rng.random_range(0..len as u32) as usize
}

/// Returns a random number from `least` to `most`, both included.
pub(super) fn between(least: u16, most: u16, rng: &mut impl Rng) -> u16 {
    rng.random_range(u32::from(least)..=u32::from(most)) as u16
}

/// Puts `items` into a random order (Fisher and Yates).
pub(super) fn shuffle<T>(items: &mut [T], rng: &mut impl Rng) {
    for last in (1..items.len()).rev() {
        items.swap(last, position(last + 1, rng));
    }
}
