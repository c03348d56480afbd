//! The baseline: random positions for random cells.

use crate::tolerances::{AREA, MAP_SCORE};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::gngslam::PointScore;
use tolman_experiment::{BoxError, Fields, Job, Options, Record, Row, Table, record};
use tolman_stats::{mean, quantile, standard_deviation};

/// Name of the table.
pub(super) const NAME: &str = "guesses";

const BY_CENTRE: &str = "to the centre";
const BY_BORDER: &str = "to the border";

/// Number of guesses of a run, and the number of runs: ten million guesses together, as in the
/// paper.
const GUESSES: usize = 1_000_000;
const RUNS: u32 = 10;

record! {
    /// A million guesses.
    struct GuessRun {
        /// Mean score of a guess.
        score: f64 => higher("score").share().decimals(3).tolerance(MAP_SCORE),
        /// Median score of a guess.
        median: f64 => higher("median").share().decimals(3).tolerance(MAP_SCORE),
        /// Standard deviation of the scores of guesses.
        sd: f64 => neither("standard deviation").share().decimals(3).tolerance(MAP_SCORE),
        /// Share of the guesses inside the cell.
        inside_percent: f64 => higher("inside").percent().tolerance(AREA),
    }
}

pub(super) fn table(options: &Options) -> Table {
    let runs = options.runs_else(RUNS, RUNS);
    Table::of::<GuessRun>(NAME, "The baseline: any position for any cell")
        .metrics_from(GuessRun::score)
        .row(
            Row::new(BY_CENTRE)
                .paper(GuessRun::score, 0.18)
                .paper(GuessRun::median, 0.12)
                .paper(GuessRun::sd, 0.16)
                .paper(GuessRun::inside_percent, 1.56)
                .paper_runs(RUNS)
                .runs(runs),
        )
        .row(Row::new(BY_BORDER).runs(runs))
        .note("A million guesses a run, ten million together as in the paper.")
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let scores: Vec<f64> = guesses(job.seed, GUESSES)
        .map(|score| match job.row {
            BY_BORDER => score.by_border,
            _ => score.by_centre,
        })
        .collect();
    let inside = scores.iter().filter(|score| **score >= 1.0).count();
    let run = GuessRun {
        score: mean(&scores)?,
        median: quantile(&scores, 0.5)?,
        sd: standard_deviation(&scores)?,
        inside_percent: 100.0 * inside as f64 / GUESSES as f64,
    };
    Ok(run.fields()?)
}

/// Returns the scores of random guesses.
pub(super) fn guesses(seed: u64, count: usize) -> impl Iterator<Item = PointScore> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..count).map(move |_| PointScore::random(&mut rng))
}
