//! The difference between our value and the paper's, and the number of runs that it needs.

use super::sample::{LEVEL, Sample};
use super::verdict::Case;
use super::{Centre, Doubt, Metric, Options, Statistic};
use tolman_stats::{
    ConfidenceInterval, SampleSummary, mean_difference_interval, rate_difference_interval,
};

/// Ours minus the paper's value, with its interval for any number of our runs that scatter as those
/// that were made.
#[derive(Clone, Debug)]
pub(super) struct Difference {
    observed: f64,
    /// Number of our runs.
    runs: u32,
    /// Number of the paper's runs.
    paper_runs: u32,
    /// Rounding error of the paper's value.
    rounding: f64,
    /// Minimum and maximum of the difference, from the range of the quantity.
    range: (f64, f64),
    spread: Spread,
}

/// Spread of both values.
#[derive(Clone, Debug)]
enum Spread {
    /// Neither scatters.
    None,
    /// Both are shares of `whole`: successes in our runs and in the paper's.
    Shares { ours: u64, paper: u64, whole: f64 },
    /// Both are means with a standard deviation.
    Means {
        ours: SampleSummary,
        paper: SampleSummary,
    },
    /// Our runs stand for the paper's too: the interval that resamples of them gave.
    Resampled(ConfidenceInterval),
}

impl Difference {
    /// Returns the difference; an error if its interval is unknown.
    pub(super) fn of(case: &Case<'_>) -> Result<Self, Doubt> {
        let Case { paper, sample, .. } = *case;
        let (ours, (least, most)) = (sample.value().0, case.range());
        let runs = sample.len() as u32;
        let known = |paper_runs, rounding, spread| Self {
            observed: ours - paper.value,
            runs,
            paper_runs,
            rounding,
            range: (least - paper.value, most - paper.value),
            spread,
        };
        let rounding = half_a_digit(paper.value);
        if case.is_exact() {
            return Ok(known(1, rounding, Spread::None));
        }
        let paper_runs = case.row.paper_runs.or(case.table.paper_runs);
        let paper_runs = paper_runs.ok_or(Doubt::UnknownRuns)?;
        if let Sample::Flags { flags, whole } = sample {
            let theirs = (paper.value / whole * f64::from(paper_runs)).round();
            let spread = Spread::Shares {
                ours: flags.iter().filter(|flag| **flag).count() as u64,
                paper: theirs.clamp(0.0, f64::from(paper_runs)) as u64,
                whole: *whole,
            };
            return Ok(known(paper_runs, 0.0, spread));
        }
        if runs < 2 {
            return Err(Doubt::OneRun);
        }
        let is_mean = matches!(case.metric.statistic, Statistic::Of(Centre::Mean, _));
        let spreads = paper.sd.zip(sample.sd()).filter(|_| is_mean);
        let spread = match spreads {
            Some((paper_sd, sd)) if paper_runs > 1 => {
                let summary = |runs: u32, mean, sd| SampleSummary {
                    count: u64::from(runs),
                    mean,
                    sd,
                };
                Spread::Means {
                    ours: summary(runs, ours, sd),
                    paper: summary(paper_runs, paper.value, paper_sd),
                }
            }
            // If the paper gives no spread, ours is used for it.
            _ => {
                let today = sample.stand_in(ours - paper.value, paper_runs, case.seed);
                Spread::Resampled(today.ok_or(Doubt::NoInterval)?)
            }
        };
        Ok(known(paper_runs, rounding, spread))
    }

    /// Returns the interval by the runs that were made, limited to possible values.
    pub(super) fn interval(&self) -> Result<ConfidenceInterval, Doubt> {
        let interval = self.interval_of(self.runs)?;
        let (least, most) = self.range;
        let (low, high) = (interval.low.max(least), interval.high.min(most));
        Ok(ConfidenceInterval::new(low, high.max(low)))
    }

    /// Returns the smallest difference that the runs that were made could have shown.
    pub(super) fn resolution(&self) -> Option<f64> {
        self.resolution_of(self.runs)
    }

    /// Returns the smallest difference that `runs` of ours would show: from the difference to the
    /// end of its interval on the side of 0.
    fn resolution_of(&self, runs: u32) -> Option<f64> {
        let interval = self.interval_of(runs).ok()?;
        Some(match self.observed > 0.0 {
            true => self.observed - interval.low,
            false => interval.high - self.observed,
        })
    }

    /// Returns the interval by `runs` of ours.
    fn interval_of(&self, runs: u32) -> Result<ConfidenceInterval, Doubt> {
        let paper_runs = u64::from(self.paper_runs);
        let interval = match self.spread {
            Spread::None => ConfidenceInterval::new(self.observed, self.observed),
            Spread::Shares { ours, paper, whole } => {
                // Our share of these runs may lie between two counts: the interval holds both.
                let (all, made) = (ours * u64::from(runs), u64::from(self.runs));
                let of = |hits| {
                    let ours = (hits, u64::from(runs));
                    rate_difference_interval(ours, (paper, paper_runs), LEVEL)
                        .map_err(|_| Doubt::NoInterval)
                };
                let (few, many) = (of(all / made)?, of(all.div_ceil(made))?);
                ConfidenceInterval::new(few.low, many.high).scaled(whole)
            }
            Spread::Means { ours, paper } => {
                let count = u64::from(runs);
                mean_difference_interval(SampleSummary { count, ..ours }, paper, LEVEL)
                    .map_err(|_| Doubt::NoInterval)?
            }
            Spread::Resampled(today) => {
                // The variance of either value goes with the inverse of its runs.
                let of_paper = f64::from(self.paper_runs).recip();
                let variance = |runs: u32| f64::from(runs).recip() + of_paper;
                let by = (variance(runs) / variance(self.runs)).sqrt();
                let end = |end: f64| self.observed + by * (end - self.observed);
                ConfidenceInterval::new(end(today.low), end(today.high))
            }
        };
        let (low, high) = (interval.low - self.rounding, interval.high + self.rounding);
        Ok(ConfidenceInterval::new(low, high))
    }

    /// Returns how many runs would do: the first round number, `least` or more, at which the
    /// interval excludes 0. None does if the paper's runs are too few.
    pub(super) fn too_few(&self, least: u32, metric: &Metric) -> Doubt {
        let tens = core::iter::successors(Some(1_u32), |ten| ten.checked_mul(10));
        let round = tens.flat_map(|ten| [1, 2, 5].map(|digit| ten.saturating_mul(digit)));
        let mut possible = round
            .skip_while(|runs| *runs < least.max(self.runs + 1))
            .take_while(|runs| *runs <= Options::MOST_RUNS);
        let excludes = |runs: &u32| {
            let interval = self.interval_of(*runs);
            interval.is_ok_and(|interval| !interval.contains(0.0))
        };
        if let Some(needed) = possible.find(excludes) {
            return Doubt::TooFew { needed };
        }
        let resolution = self.resolution_of(Options::MOST_RUNS);
        Doubt::PaperTooFew {
            runs: self.paper_runs,
            resolution: metric.difference(resolution.unwrap_or(f64::NAN)),
        }
    }
}

/// Returns the rounding error of `printed`: half a unit of its last digit.
fn half_a_digit(printed: f64) -> f64 {
    let text = printed.to_string();
    let decimals = text.split_once('.').map_or("", |(_, decimals)| decimals);
    decimals.chars().fold(0.5, |half, _| half / 10.0)
}

#[cfg(test)]
mod tests {
    use super::half_a_digit;

    #[test]
    fn a_rounded_number_may_be_half_a_digit_off() {
        for (printed, expect) in [(0.18, 0.005), (22.11, 0.005), (17.0, 0.5)] {
            assert!((half_a_digit(printed) - expect).abs() < 1e-12, "{printed}");
        }
    }
}
