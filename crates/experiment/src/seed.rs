//! The seed of each run.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::hash::fnv64;

/// Returns the seed of run `run` of a table: word `run` of the table's own `ChaCha8` stream under
/// the master seed.
///
/// It does not depend on the row, so all rows of a table meet the same starts. The seed has 53
/// bits, which JSON readers that only know doubles keep exactly.
///
/// ```
/// use tolman_experiment::run_seed;
///
/// assert_eq!(run_seed(1, "2 (J)", 7), run_seed(1, "2 (J)", 7));
/// assert_ne!(run_seed(1, "2 (J)", 7), run_seed(1, "3 (Large)", 7));
/// assert!(run_seed(1, "2 (J)", 7) < 1 << 53);
/// ```
pub fn run_seed(master: u64, table: &str, run: u32) -> u64 {
    let mut rng = ChaCha8Rng::seed_from_u64(master);
    rng.set_stream(fnv64(table.as_bytes()));
    rng.set_word_pos(2 * u128::from(run));
    rng.next_u64() >> 11
}

#[cfg(test)]
mod tests {
    use super::run_seed;

    /// Checks seeds that published results name; they must never change.
    #[test]
    fn seeds_are_pinned() {
        assert_eq!(
            [
                run_seed(1, "2 (J)", 0),
                run_seed(1, "2 (J)", 1),
                run_seed(2, "2 (J)", 0)
            ],
            [
                3_597_620_888_080_655,
                5_532_080_688_982_454,
                4_653_329_687_790_262
            ]
        );
    }

    #[test]
    fn a_run_has_its_own_seed_whatever_runs_came_before() {
        let mut seeds: Vec<u64> = (0..1000).map(|run| run_seed(1, "2 (J)", run)).collect();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), 1000);
    }
}
