//! Figures 4.1 and 4.2: distributions of scores, and their bootstrapped means.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_draw::{Axis, Chart, Drawing, Figure, Line, LinePoint, Points, Series, Tiles};
use tolman_experiment::{BoxError, Record, Run, run_seed};
use tolman_geom::Point;
use tolman_stats::{ConfidenceInterval, bootstrap_means, mean, percentile_interval};

use super::sets::{RANDOM, SETS, TABLE};
use super::{MapRun, guesses};

/// Number of bins from 0 to 1 in the paper.
const BINS: usize = 150;

/// Maximum score that a histogram shows. Only guesses are beyond.
const SHOWN: f64 = 0.6;

/// Number of guesses of the baseline.
const GUESSES: usize = 1_000_000;

/// Number of points and of repetitions of the bootstrap, and its confidence.
const POINTS: u32 = 10_000;
const RESAMPLES: u32 = 1000;
const LEVEL: f64 = 0.999;

/// Scores of each row, without useless maps. The last row has single guesses.
struct Scores {
    rows: Vec<(&'static str, Vec<f64>)>,
}

pub(super) fn of(runs: &[Run], seed: u64) -> Result<Vec<Figure>, BoxError> {
    let scores = Scores::of(runs, seed)?;
    Ok(vec![scores.histograms(), scores.means(seed)?])
}

impl Scores {
    fn of(runs: &[Run], seed: u64) -> Result<Self, BoxError> {
        let mut rows = Vec::new();
        for set in SETS {
            let of_row = MapRun::of_row(runs, TABLE, set.row)?;
            rows.push((set.row, of_row.iter().filter_map(|run| run.score).collect()));
        }
        let seed = run_seed(seed, RANDOM, 0);
        let guesses = guesses::guesses(seed, GUESSES).map(|score| score.by_centre);
        rows.push((RANDOM, guesses.collect()));
        Ok(Self { rows })
    }

    /// Returns figure 4.1: the best sets with the baseline, and the worst set with the best one.
    fn histograms(&self) -> Figure {
        let mut tiles = Tiles::new(1);
        tiles.tile(
            "a) the sets of hsv images",
            self.histogram(&[6, 0, 1, 4, 5]),
        );
        tiles.tile(
            "b) the sets of rgb images, and set 1",
            self.histogram(&[6, 0, 2, 3]),
        );
        let drawing = tiles.drawing("Histograms of the scores of maps and of guesses.");
        Figure::new("figure-4-1", "Distribution of the scores", drawing)
            .caption(format!(
                "Figure 4.1: {BINS} bins from 0 to 1, of which those up to {SHOWN} are shown. The random row is of single guesses, of \
                 which 1.6 % score 1."
            ))
            .table(TABLE)
    }

    fn histogram(&self, rows: &[usize]) -> Drawing {
        let share = Axis::linear("% of maps").from_zero();
        let mut chart = Chart::new(Axis::linear("score").between(0.0, SHOWN), share);
        for row in rows {
            let (name, scores) = &self.rows[*row];
            let label = match *row {
                row if row < SETS.len() => format!("{}: {name}", row + 1),
                _ => (*name).to_owned(),
            };
            chart.line(Line::new(label, series(*row), histogram(scores)));
        }
        chart.drawing("Scores of maps and of guesses.")
    }

    /// Returns figure 4.2: a dot for each row's bootstrapped mean, with its interval.
    fn means(&self, seed: u64) -> Result<Figure, BoxError> {
        let sets = Axis::linear("set").between(-0.5, 6.5).whole_numbers();
        let mut chart = Chart::new(sets, Axis::linear("mean score")).sized(720.0, 320.0);
        let mut said = Vec::new();
        for (place, (name, scores)) in self.rows.iter().enumerate() {
            let Some((middle, interval)) = bootstrapped(scores, run_seed(seed, name, 1))? else {
                continue;
            };
            let x = ((place + 1) % self.rows.len()) as f64;
            let ends = [interval.low, interval.high].map(|end| LinePoint::new(x, end));
            chart.line(Line::new("", series(place), ends.into()));
            let dot = vec![Point::new(x, middle)];
            chart.points(Points::new("", series(place), dot));
            said.push(format!(
                "{name} {middle:.4} ({:.4} to {:.4})",
                interval.low, interval.high
            ));
        }
        let drawing = chart.drawing("Bootstrapped means of the scores of each set.");
        Ok(Figure::new("figure-4-2", "Bootstrapped mean scores", drawing)
            .caption(format!(
                "Figure 4.2: means of {POINTS} scores drawn from each set, {RESAMPLES} times; set 0 \
                 are guesses. Bars hold {} % of the means: {}. As in the paper, more scores are \
                 drawn than there are maps. So the bars are narrower than the uncertainty of a \
                 search's mean.",
                100.0 * LEVEL,
                said.join("; ")
            ))
            .table(TABLE))
    }
}

/// Returns the colour of a row; guesses have the last colour.
const fn series(row: usize) -> Series {
    Series(row as u32)
}

/// Returns the percentage of values in each bin, as a step curve.
fn histogram(values: &[f64]) -> Vec<LinePoint> {
    let mut counts = [0_u32; BINS];
    for value in values {
        counts[((value * BINS as f64) as usize).min(BINS - 1)] += 1;
    }
    let percent = 100.0 / values.len().max(1) as f64;
    let stairs = counts.iter().enumerate().flat_map(|(bin, count)| {
        let edges = [bin, bin + 1].map(|edge| edge as f64 / BINS as f64);
        edges.map(|edge| LinePoint::new(edge, percent * f64::from(*count)))
    });
    stairs.take_while(|point| point.x <= SHOWN + 1e-9).collect()
}

/// Returns the mean of bootstrapped means and its interval; `None` without scores.
fn bootstrapped(scores: &[f64], seed: u64) -> Result<Option<(f64, ConfidenceInterval)>, BoxError> {
    if scores.is_empty() {
        return Ok(None);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let means = bootstrap_means(scores, POINTS, RESAMPLES, &mut rng)?;
    Ok(Some((mean(&means)?, percentile_interval(&means, LEVEL)?)))
}
