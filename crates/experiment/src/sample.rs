//! The runs of a row as a sample of one metric.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::settling::settles;
use super::{Centre, Reached, Run, Settling, Statistic};
use tolman_stats::ConfidenceInterval;

/// Number of resamples of the bootstrap.
pub(crate) const RESAMPLES: u32 = 2000;
/// Confidence level of every interval.
pub(crate) const LEVEL: f64 = 0.95;

/// The measured values of one metric in one row. Never empty.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Sample<'a> {
    /// Whether each run succeeded. The value is `whole` × the share of those that did.
    Flags { flags: Vec<bool>, whole: f64 },
    /// One number for each run.
    Numbers { numbers: Vec<f64>, centre: Centre },
    /// Two numbers for each run.
    Pairs(Vec<(f64, f64)>, OfPairs),
    /// A curve for each run, and the limit that their mean has to stay below.
    Curves {
        curves: Vec<&'a [f64]>,
        step: f64,
        limit: f64,
    },
}

/// Statistic that turns pairs of numbers into one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum OfPairs {
    /// Ratio of the sums: numerators over denominators.
    Ratio,
    /// Ratio of the standard deviations.
    RatioOfSpreads,
    /// Skill of forecasts: squared errors, with the outcomes, 1 or 0. Both outcomes occur.
    Skill,
}

/// Returns 1 − the mean squared error over the variance of the outcomes.
fn skill(forecasts: &[(f64, f64)]) -> f64 {
    let count = forecasts.len() as f64;
    let (errors, came) = forecasts.iter().fold((0.0, 0.0), |(errors, came), one| {
        (errors + one.0, came + one.1)
    });
    let rate = came / count;
    1.0 - errors / (count * rate * (1.0 - rate))
}

impl<'a> Sample<'a> {
    /// Returns the sample of a statistic; `None` if no run has the field. `others` are the runs of
    /// the row that [`Statistic::Multiple`] names, sorted by index. `table` are the runs of all
    /// rows, row by row.
    pub(super) fn of(
        statistic: &Statistic,
        runs: &[&'a Run],
        others: &[&Run],
        table: &[Vec<&Run>],
    ) -> Option<Self> {
        let runs = runs.iter().copied();
        let flags = |field: &str, whole: f64| Self::Flags {
            flags: runs
                .clone()
                .filter_map(|run| run.fields.flag(field))
                .collect(),
            whole,
        };
        let numbers = |field: &str, centre: Centre| Self::Numbers {
            numbers: runs
                .clone()
                .filter_map(|run| run.fields.number(field))
                .collect(),
            centre,
        };
        let pair = |run: &Run, over: &str, other: &Run, under: &str| {
            Some((run.fields.number(over)?, other.fields.number(under)?))
        };
        let sample = match statistic {
            Statistic::Percent(field) => flags(field, 100.0),
            Statistic::Count { field, whole } => flags(field, f64::from(*whole)),
            Statistic::Of(centre, field) => numbers(field, *centre),
            Statistic::Ratio { over, under } => {
                let pairs = runs.filter_map(|run| pair(run, over, run, under));
                Self::Pairs(pairs.collect(), OfPairs::Ratio)
            }
            Statistic::RatioOfSpreads { over, under } => {
                let pairs = runs.filter_map(|run| pair(run, over, run, under));
                let pairs: Vec<(f64, f64)> = pairs.collect();
                ratio_of_spreads(&pairs)?;
                Self::Pairs(pairs, OfPairs::RatioOfSpreads)
            }
            Statistic::Skill { error, outcome } => {
                let forecasts: Vec<(f64, f64)> = runs
                    .filter_map(|run| {
                        let outcome = f64::from(u8::from(run.fields.flag(outcome)?));
                        Some((run.fields.number(error)?, outcome))
                    })
                    .collect();
                let came = forecasts.iter().filter(|(_, came)| *came > 0.5).count();
                if came == 0 || came == forecasts.len() {
                    return None;
                }
                Self::Pairs(forecasts, OfPairs::Skill)
            }
            Statistic::Multiple { field, .. } => {
                let pairs = runs.filter_map(|run| {
                    let place = others.binary_search_by_key(&run.run, |other| other.run);
                    pair(run, field, others[place.ok()?], field)
                });
                Self::Pairs(pairs.collect(), OfPairs::Ratio)
            }
            Statistic::Settling(settling) => {
                let measured = runs.filter(|run| is_measured(settling, run));
                Self::Curves {
                    curves: measured
                        .filter_map(|run| run.fields.curve(&settling.curve))
                        .collect(),
                    step: settling.step,
                    limit: limit(settling, table)?,
                }
            }
        };
        (sample.len() > 0).then_some(sample)
    }

    /// Returns the number of measured runs.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Flags { flags, .. } => flags.len(),
            Self::Numbers { numbers, .. } => numbers.len(),
            Self::Pairs(pairs, _) => pairs.len(),
            Self::Curves { curves, .. } => curves.len(),
        }
    }

    /// Returns the value and whether it was reached. It is a share of a whole, a mean, median,
    /// quantile, minimum, maximum, sum, or ratio of sums or of spreads. Or it is the time at which
    /// the mean curve settles. Only a curve may fail to settle; all else counts as reached.
    pub(super) fn value(&self) -> (f64, Reached) {
        let value = match self {
            Self::Flags { flags, whole } => whole * mean(&zeros_and_ones(flags)),
            Self::Numbers { numbers, centre } => match centre {
                Centre::Mean => mean(numbers),
                // A sample is neither empty nor infinite: the runner refuses such runs.
                Centre::Median => tolman_stats::quantile(numbers, 0.5).unwrap_or(f64::NAN),
                Centre::Quantile(share) => {
                    tolman_stats::quantile(numbers, *share).unwrap_or(f64::NAN)
                }
                Centre::Least => numbers.iter().copied().fold(f64::INFINITY, f64::min),
                Centre::Greatest => numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                Centre::Total => numbers.iter().sum(),
            },
            Self::Pairs(pairs, of) => match of {
                OfPairs::Ratio => ratio_of_sums(pairs),
                OfPairs::RatioOfSpreads => ratio_of_spreads(pairs).unwrap_or(f64::NAN),
                OfPairs::Skill => skill(pairs),
            },
            Self::Curves {
                curves,
                step,
                limit,
            } => return settles(curves, *step, *limit),
        };
        (value, Reached::Yes)
    }

    /// Returns the standard deviation of two numbers or more.
    pub(super) fn sd(&self) -> Option<f64> {
        tolman_stats::standard_deviation(self.spread()?).ok()
    }

    /// Returns the mean of numbers.
    pub(super) fn mean(&self) -> Option<f64> {
        tolman_stats::mean(self.spread()?).ok()
    }

    /// Returns the median of numbers.
    pub(super) fn median(&self) -> Option<f64> {
        tolman_stats::quantile(self.spread()?, 0.5).ok()
    }

    /// Returns the numbers whose spread bounds the value's error; `None` for minimum, maximum and
    /// sum.
    fn spread(&self) -> Option<&[f64]> {
        match self {
            Self::Numbers {
                numbers,
                centre: Centre::Mean | Centre::Median,
            } => Some(numbers),
            _ => None,
        }
    }

    /// Returns the 95 % interval of the value: exact binomial for a share, order statistics for a
    /// median, BCa bootstrap otherwise. `None` if there are too few runs.
    pub(super) fn interval(&self, seed: u64) -> Option<ConfidenceInterval> {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        match self {
            Self::Flags { flags, whole } => {
                let successes = flags.iter().filter(|flag| **flag).count() as u64;
                tolman_stats::exact_binomial_interval(successes, flags.len() as u64, LEVEL)
                    .map(|interval| interval.scaled(*whole))
            }
            Self::Numbers { numbers, centre } => match centre {
                Centre::Mean => tolman_stats::bca_interval(numbers, mean, RESAMPLES, LEVEL, rng),
                Centre::Median => tolman_stats::median_interval(numbers, LEVEL),
                Centre::Quantile(_) | Centre::Least | Centre::Greatest | Centre::Total => {
                    return None;
                }
            },
            Self::Pairs(_, OfPairs::RatioOfSpreads | OfPairs::Skill) => return None,
            Self::Pairs(pairs, OfPairs::Ratio) => {
                tolman_stats::bca_interval(pairs, ratio_of_sums, RESAMPLES, LEVEL, rng)
            }
            Self::Curves {
                curves,
                step,
                limit,
            } => {
                let value = |curves: &[&[f64]]| settles(curves, *step, *limit).0;
                tolman_stats::bca_interval(curves, value, RESAMPLES, LEVEL, rng)
            }
        }
        .ok()
    }

    /// Returns the interval of the difference between the value and that of another sample of
    /// `others` runs, of which only the value is known. It is `observed` minus the random
    /// difference of two such samples of these runs. `None` if there is nothing to resample.
    pub(super) fn stand_in(
        &self,
        observed: f64,
        others: u32,
        seed: u64,
    ) -> Option<ConfidenceInterval> {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        let own = self.len();
        let by_chance: Vec<f64> = (0..RESAMPLES)
            .map(|_| self.redrawn(own, rng) - self.redrawn(others as usize, rng))
            .collect();
        let end = |share: f64| tolman_stats::quantile(&by_chance, share).ok();
        let (low, high) = (end(0.5 - 0.5 * LEVEL)?, end(0.5 + 0.5 * LEVEL)?);
        Some(ConfidenceInterval::new(observed - high, observed - low))
    }

    /// Returns the value of `count` of its runs, drawn with replacement.
    fn redrawn(&self, count: usize, rng: &mut ChaCha8Rng) -> f64 {
        let drawn = match self {
            Self::Flags { flags, whole } => Self::Flags {
                flags: drawn(flags, count, rng),
                whole: *whole,
            },
            Self::Numbers { numbers, centre } => Self::Numbers {
                numbers: drawn(numbers, count, rng),
                centre: *centre,
            },
            Self::Pairs(pairs, of) => Self::Pairs(drawn(pairs, count, rng), *of),
            Self::Curves {
                curves,
                step,
                limit,
            } => Self::Curves {
                curves: drawn(curves, count, rng),
                step: *step,
                limit: *limit,
            },
        };
        drawn.value().0
    }

    /// Returns one number for each run, for rank tests.
    pub(super) fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Flags { flags, .. } => zeros_and_ones(flags),
            Self::Numbers { numbers, .. } => numbers.clone(),
            // A run with a denominator of 0 has no ratio.
            Self::Pairs(pairs, OfPairs::Ratio) => pairs
                .iter()
                .filter(|(_, under)| *under > 0.0)
                .map(|(over, under)| over / under)
                .collect(),
            // Only several runs together have a settling mean curve, a spread or a skill.
            Self::Curves { .. } | Self::Pairs(..) => Vec::new(),
        }
    }
}

/// Returns `count` of these, drawn with replacement.
fn drawn<T: Copy>(all: &[T], count: usize, rng: &mut ChaCha8Rng) -> Vec<T> {
    let one = |_| all[rng.random_range(0..all.len() as u32) as usize];
    (0..count).map(one).collect()
}

/// Returns whether a run has both the lowest level of its curve and the scale of the margin.
fn is_measured(Settling { level, scale, .. }: &Settling, run: &Run) -> bool {
    run.fields.number(level).is_some() && run.fields.number(scale).is_some()
}

/// Returns the limit that the mean curves of a table have to stay below; `None` if no run gives it.
fn limit(settling: &Settling, table: &[Vec<&Run>]) -> Option<f64> {
    let mean_of = |runs: &[&Run], field: &str| {
        let measured = runs.iter().filter(|run| is_measured(settling, run));
        let numbers: Vec<f64> = measured
            .filter_map(|run| run.fields.number(field))
            .collect();
        tolman_stats::mean(&numbers).ok()
    };
    let levels = table
        .iter()
        .filter_map(|runs| mean_of(runs, &settling.level));
    let lowest = levels.reduce(f64::min)?;
    let of = table
        .iter()
        .filter(|runs| runs.first().is_some_and(|run| run.row == settling.of));
    let scale = of.filter_map(|runs| mean_of(runs, &settling.scale));
    Some(lowest + settling.margin * scale.reduce(f64::min)?)
}

fn zeros_and_ones(flags: &[bool]) -> Vec<f64> {
    flags
        .iter()
        .map(|&flag| f64::from(u8::from(flag)))
        .collect()
}

fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

/// Returns the ratio of the standard deviations; `None` if the denominator is 0.
fn ratio_of_spreads(pairs: &[(f64, f64)]) -> Option<f64> {
    let (over, under): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let over = tolman_stats::standard_deviation(&over).ok()?;
    let under = tolman_stats::standard_deviation(&under).ok()?;
    (under > 0.0).then(|| over / under)
}

fn ratio_of_sums(pairs: &[(f64, f64)]) -> f64 {
    let over: f64 = pairs.iter().map(|pair| pair.0).sum();
    let under: f64 = pairs.iter().map(|pair| pair.1).sum();
    over / under
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_and_ratios_of_spreads_are_values_without_interval() {
        let quarter = Sample::Numbers {
            numbers: vec![5.0, 1.0, 4.0, 2.0, 3.0],
            centre: Centre::Quantile(0.25),
        };
        // The numerators spread twice as far as the denominators.
        let spreads = Sample::Pairs(
            vec![(10.0, 3.0), (14.0, 5.0), (18.0, 7.0)],
            OfPairs::RatioOfSpreads,
        );
        for sample in [quarter, spreads] {
            assert!((sample.value().0 - 2.0).abs() < 1e-12, "{sample:?}");
            assert_eq!(sample.interval(1), None);
            assert_eq!(sample.sd(), None);
        }
    }

    #[test]
    fn what_does_not_spread_divides_nothing() {
        assert_eq!(ratio_of_spreads(&[(1.0, 2.0), (3.0, 2.0)]), None);
        assert_eq!(ratio_of_spreads(&[(1.0, 2.0)]), None);
    }
}
