//! The seed of each run.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::hash::Fnv64;

/// The seed of run `run` of a table: word `run` of the table's own `ChaCha8` stream under the master
/// seed.
///
/// The row has no part in it, so all rows of a table meet the same starts. The seed has 53 bits and
/// survives JSON readers that know only doubles.
///
/// ```
/// use tolman::experiment::run_seed;
///
/// assert_eq!(run_seed(1, "2 (J)", 7), run_seed(1, "2 (J)", 7));
/// assert_ne!(run_seed(1, "2 (J)", 7), run_seed(1, "3 (Large)", 7));
/// assert!(run_seed(1, "2 (J)", 7) < 1 << 53);
/// ```
pub fn run_seed(master: u64, table: &str, run: u32) -> u64 {
    let mut rng = ChaCha8Rng::seed_from_u64(master);
    rng.set_stream(Fnv64::of(table.as_bytes()));
    rng.set_word_pos(2 * u128::from(run));
    rng.next_u64() >> 11
}
