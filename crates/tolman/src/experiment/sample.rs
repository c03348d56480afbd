//! The runs of one row as the sample of one metric.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::{Field, Run, Statistic};
use crate::stats::{self, Interval};

/// Resamples of the bootstrap.
pub(crate) const RESAMPLES: u32 = 2000;
/// The confidence of every interval.
pub(crate) const LEVEL: f64 = 0.95;

/// The measured values of one metric in one row. Never empty.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Sample {
    /// Whether each run succeeded.
    Flags(Vec<bool>),
    /// One number for each run.
    Numbers(Vec<f64>),
    /// A numerator and a denominator for each run.
    Pairs(Vec<(f64, f64)>),
}

impl Sample {
    /// What a statistic measures of runs; `None` if no run has the field.
    pub(super) fn of(statistic: &Statistic, runs: &[&Run]) -> Option<Self> {
        let number = |run: &Run, field: &str| run.fields.get(field).and_then(Field::as_number);
        let sample = match statistic {
            Statistic::Percent { field } => Self::Flags(
                runs.iter()
                    .filter_map(|run| run.fields.get(field)?.as_flag())
                    .collect(),
            ),
            Statistic::Mean { field } => {
                Self::Numbers(runs.iter().filter_map(|run| number(run, field)).collect())
            }
            Statistic::Ratio { over, under } => Self::Pairs(
                runs.iter()
                    .filter_map(|run| Some((number(run, over)?, number(run, under)?)))
                    .collect(),
            ),
        };
        (sample.len() > 0).then_some(sample)
    }

    /// How many runs were measured.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Flags(flags) => flags.len(),
            Self::Numbers(numbers) => numbers.len(),
            Self::Pairs(pairs) => pairs.len(),
        }
    }

    /// The value: percentage, mean, or ratio of sums.
    pub(super) fn value(&self) -> f64 {
        match self {
            Self::Flags(flags) => 100.0 * mean(&zeros_and_ones(flags)),
            Self::Numbers(numbers) => mean(numbers),
            Self::Pairs(pairs) => ratio_of_sums(pairs),
        }
    }

    /// The standard deviation, where the value is a mean of two runs or more.
    pub(super) fn sd(&self) -> Option<f64> {
        match self {
            Self::Numbers(numbers) => stats::standard_deviation(numbers).ok(),
            Self::Flags(_) | Self::Pairs(_) => None,
        }
    }

    /// The median, where the value is a mean.
    pub(super) fn median(&self) -> Option<f64> {
        match self {
            Self::Numbers(numbers) => stats::quantile(numbers, 0.5).ok(),
            Self::Flags(_) | Self::Pairs(_) => None,
        }
    }

    /// The 95 % interval of the value: exact binomial for a percentage, BCa bootstrap otherwise.
    pub(super) fn interval(&self, seed: u64) -> Option<Interval> {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        match self {
            Self::Flags(flags) => {
                let successes = flags.iter().filter(|flag| **flag).count() as u64;
                stats::exact_binomial_interval(successes, flags.len() as u64, LEVEL)
                    .map(|interval| interval.scaled(100.0))
            }
            Self::Numbers(numbers) => stats::bca_interval(numbers, mean, RESAMPLES, LEVEL, rng),
            Self::Pairs(pairs) => stats::bca_interval(pairs, ratio_of_sums, RESAMPLES, LEVEL, rng),
        }
        .ok()
    }

    /// One number for each run, for rank tests.
    pub(super) fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Flags(flags) => zeros_and_ones(flags),
            Self::Numbers(numbers) => numbers.clone(),
            // A run without denominator says nothing of the ratio.
            Self::Pairs(pairs) => pairs
                .iter()
                .filter(|(_, under)| *under > 0.0)
                .map(|(over, under)| over / under)
                .collect(),
        }
    }
}

fn zeros_and_ones(flags: &[bool]) -> Vec<f64> {
    flags
        .iter()
        .map(|&flag| f64::from(u8::from(flag)))
        .collect()
}

#[expect(clippy::cast_precision_loss, reason = "far fewer runs than 2^53")]
fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

fn ratio_of_sums(pairs: &[(f64, f64)]) -> f64 {
    let over: f64 = pairs.iter().map(|pair| pair.0).sum();
    let under: f64 = pairs.iter().map(|pair| pair.1).sum();
    over / under
}
