//! Whether a value of ours matches the paper's.

use super::sample::LEVEL;
use super::{Metric, PaperValue, Statistic, Tolerance};
use tolman_stats::{ConfidenceInterval, exact_binomial_interval};

/// The judgement of one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Whether our value is accepted.
    pub matches: bool,
    /// The values that are accepted, ends included.
    pub accepted: ConfidenceInterval,
}

impl Verdict {
    /// Judges `ours` by the metric's stated tolerance, or else by the paper's own 95 % interval: exact binomial for a
    /// percentage or a count, mean ± 1.96 standard errors for a mean; `None` if neither a tolerance nor the size and spread of the paper's sample is
    /// known.
    pub(super) fn of(
        ours: f64,
        paper: &PaperValue,
        paper_runs: Option<u32>,
        metric: &Metric,
    ) -> Option<Self> {
        let around = |half: f64| ConfidenceInterval::new(paper.value - half, paper.value + half);
        let accepted = match (metric.tolerance, &metric.statistic) {
            (Some(Tolerance::Absolute(half)), _) => around(half),
            (Some(Tolerance::Relative(share)), _) => around(share * paper.value.abs()),
            (Some(Tolerance::Spread), _) => around(paper.sd?),
            (Some(Tolerance::Factor(factor)), _) => {
                let (one, other) = (paper.value / factor, paper.value * factor);
                ConfidenceInterval::new(one.min(other), one.max(other))
            }
            (None, Statistic::Percent(_)) => own_binomial(paper.value, 100.0, paper_runs?)?,
            (None, Statistic::Count { whole, .. }) => {
                own_binomial(paper.value, f64::from(*whole), *whole)?
            }
            (None, Statistic::Mean(_) | Statistic::Ratio { .. } | Statistic::Multiple { .. }) => {
                around(1.96 * paper.sd? / f64::from(paper_runs?).sqrt())
            }
            // A spread says nothing of a median's error, nor of a minimum's.
            (
                None,
                Statistic::Median(_)
                | Statistic::Least(_)
                | Statistic::Greatest(_)
                | Statistic::Skill { .. }
                | Statistic::Settling(_),
            ) => {
                return None;
            }
        };
        // Of a whole there is no less than none and no more than all.
        let accepted = match metric.statistic {
            Statistic::Percent(_) => within(accepted, 100.0),
            Statistic::Count { whole, .. } => within(accepted, f64::from(whole)),
            _ => accepted,
        };
        Some(Self {
            matches: accepted.contains(ours),
            accepted,
        })
    }
}

fn within(interval: ConfidenceInterval, whole: f64) -> ConfidenceInterval {
    ConfidenceInterval::new(interval.low.max(0.0), interval.high.min(whole))
}

fn own_binomial(value: f64, whole: f64, runs: u32) -> Option<ConfidenceInterval> {
    let successes = (value / whole * f64::from(runs)).round() as u64;
    let rate = exact_binomial_interval(successes, u64::from(runs), LEVEL).ok()?;
    Some(rate.scaled(whole))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judge(ours: f64, metric: &Metric, value: f64, sd: Option<f64>) -> Option<bool> {
        let paper = PaperValue {
            metric: metric.name.clone(),
            value,
            sd,
        };
        Verdict::of(ours, &paper, Some(25), metric).map(|verdict| verdict.matches)
    }

    #[test]
    fn a_tolerance_is_inclusive_on_both_sides() {
        let points =
            Metric::percent("success_percent", "success").tolerance(Tolerance::Absolute(15.0));
        for (ours, expect) in [(53.0, true), (83.0, true), (52.9, false), (83.1, false)] {
            assert_eq!(judge(ours, &points, 68.0, None), Some(expect), "{ours}");
        }
        let share = Metric::mean("steps").tolerance(Tolerance::Relative(0.35));
        for (ours, expect) in [(66.0, true), (134.0, true), (64.0, false), (136.0, false)] {
            assert_eq!(
                judge(ours, &share, 100.0, Some(5.0)),
                Some(expect),
                "{ours}"
            );
        }
    }

    #[test]
    fn a_factor_reaches_as_far_down_as_up() {
        let factor = Metric::median("error", "error").tolerance(Tolerance::Factor(1.5));
        for (ours, expect) in [(4.0, true), (9.0, true), (3.99, false), (9.01, false)] {
            assert_eq!(judge(ours, &factor, 6.0, None), Some(expect), "{ours}");
        }
        assert_eq!(judge(-3.0, &factor, -2.0, None), Some(true));
    }

    #[test]
    fn a_count_is_judged_by_the_runs_it_counts_in_and_a_median_by_nothing() {
        // 19 of 20: 15.02 to 19.97.
        let count = Metric::count_of("five_of_twenty", "five", 20);
        for (ours, expect) in [(15.1, true), (19.9, true), (15.0, false), (20.0, false)] {
            assert_eq!(judge(ours, &count, 19.0, None), Some(expect), "{ours}");
        }
        let median = Metric::median("steps", "steps");
        assert_eq!(judge(100.0, &median, 100.0, Some(10.0)), None);
    }

    #[test]
    fn without_a_tolerance_the_papers_own_interval_decides() {
        let percent = Metric::percent("success_percent", "success");
        // 17 of 25: 46.5 to 85.1 %.
        for (ours, expect) in [(47.0, true), (85.0, true), (46.0, false), (86.0, false)] {
            assert_eq!(judge(ours, &percent, 68.0, None), Some(expect), "{ours}");
        }
        let mean = Metric::mean("steps");
        assert_eq!(judge(103.9, &mean, 100.0, Some(10.0)), Some(true));
        assert_eq!(judge(104.0, &mean, 100.0, Some(10.0)), Some(false));
        assert_eq!(judge(104.0, &mean, 100.0, None), None);
    }
}
