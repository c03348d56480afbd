//! Whether our value matches the paper's.

use core::fmt;

use super::sample::{LEVEL, Sample};
use super::{
    Better, Centre, Metric, PaperValue, Reached, Row, Statistic, Table, Tolerance, Within,
};
use tolman_stats::{
    ConfidenceInterval, SampleSummary, mean_difference_interval, rate_difference_interval,
};

/// The verdict on one value.
///
/// - It *differs* if the difference exceeds the tolerance, and its 95 % interval, with the spread
///   of both samples, excludes 0.
/// - It *matches* if the difference is within the tolerance, and the interval includes 0.
/// - Otherwise the runs *cannot tell*.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Result of the comparison with the paper.
    pub finding: Finding,
    /// Interval of ours minus the paper's, in the metric's unit; `None` if it is unknown. Half its
    /// width is the smallest difference that could have been detected.
    pub difference: Option<ConfidenceInterval>,
    /// Range of our values within the tolerance, ends included; `None` without a tolerance.
    pub accepted: Option<ConfidenceInterval>,
}

/// Result of comparing a value with the paper's.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// The value matches the paper's.
    Matches,
    /// The value is better than the paper's. Only rows of our own systems can be.
    Better,
    /// The value differs from the paper's.
    Differs,
    /// The runs cannot tell, for this reason.
    CannotTell(Doubt),
}

/// Reason why a value cannot be judged.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// The difference exceeds the tolerance, but its interval includes 0.
    TooWide,
    /// The difference is certain, but within the tolerance.
    Slight,
    /// The paper's number of runs is unknown.
    UnknownRuns,
    /// No tolerance is stated.
    NoTolerance,
    /// One run shows no spread.
    OneRun,
    /// The event that the metric waits for did not happen.
    NotReached,
    /// Files that the runs need are missing: their names, and where to get them.
    NoData(String),
    /// No run was made.
    NoRuns,
    /// Reason why no value can be compared with the paper's.
    Aside(String),
    /// This statistic has no interval for such runs.
    NoInterval,
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TooWide => "the runs are too few or too scattered",
            Self::Slight => "it differs, but by less than the tolerance",
            Self::UnknownRuns => "the paper does not say of how many runs its value is",
            Self::NoTolerance => "no tolerance is stated",
            Self::OneRun => "one run shows no spread: give more --runs",
            Self::NotReached => "ours was not reached",
            Self::NoRuns => "no run was made",
            Self::NoInterval => "there is no interval for such runs",
            Self::NoData(what) | Self::Aside(what) => what,
        })
    }
}

impl Finding {
    /// Returns the verdict as a word.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Matches => "matches",
            Self::Better => "better",
            Self::Differs => "differs",
            Self::CannotTell(_) => "cannot tell",
        }
    }

    /// Returns the reason why the value cannot be judged; `None` if it can.
    #[must_use]
    pub const fn doubt(&self) -> Option<&Doubt> {
        match self {
            Self::CannotTell(doubt) => Some(doubt),
            _ => None,
        }
    }
}

impl Verdict {
    /// Returns the verdict on a value that cannot be judged.
    pub(super) const fn unknown(doubt: Doubt) -> Self {
        Self {
            finding: Finding::CannotTell(doubt),
            difference: None,
            accepted: None,
        }
    }

    /// Returns half the width of the interval of the difference, in the metric's unit: the smallest
    /// difference that could have been detected.
    #[must_use]
    pub fn resolution(&self) -> Option<f64> {
        self.difference
            .map(|interval| 0.5 * (interval.high - interval.low))
    }
}

/// One of our values and the paper's value that it is compared with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case<'a> {
    pub(super) table: &'a Table,
    pub(super) row: &'a Row,
    pub(super) metric: &'a Metric,
    pub(super) sample: &'a Sample<'a>,
    pub(super) paper: &'a PaperValue,
    /// Seed of the resamples.
    pub(super) seed: u64,
}

impl Case<'_> {
    /// Returns the verdict.
    pub(super) fn judge(&self) -> Verdict {
        let Self { metric, paper, .. } = *self;
        if let Some(why) = &paper.aside {
            return Verdict::unknown(Doubt::Aside(why.clone()));
        }
        let (ours, reached) = self.sample.value();
        if reached == Reached::No {
            return Verdict::unknown(Doubt::NotReached);
        }
        let accepted = metric.tolerance.map(|tolerance| self.accepted(tolerance));
        let difference = self.difference();
        let finding = match (accepted, &difference) {
            (None, _) => Finding::CannotTell(Doubt::NoTolerance),
            (_, Err(doubt)) => Finding::CannotTell(doubt.clone()),
            (Some(accepted), Ok(interval)) => {
                match (accepted.contains(ours), interval.contains(0.0)) {
                    (true, true) => Finding::Matches,
                    (true, false) => Finding::CannotTell(Doubt::Slight),
                    (false, true) => Finding::CannotTell(Doubt::TooWide),
                    (false, false) => self.differs(ours),
                }
            }
        };
        Verdict {
            finding,
            difference: difference.ok(),
            accepted,
        }
    }

    fn differs(&self, ours: f64) -> Finding {
        let paper = self.paper.value;
        let is_better = match self.metric.better.unwrap_or_default() {
            Better::Higher => ours > paper,
            Better::Lower => ours < paper,
            Better::Neither => false,
        };
        match self.row.own && is_better {
            true => Finding::Better,
            false => Finding::Differs,
        }
    }

    /// Returns the range of values that are within the tolerance and possible for a run.
    fn accepted(&self, tolerance: Tolerance) -> ConfidenceInterval {
        let paper = self.paper.value;
        let (low, high) = match tolerance.within {
            Within::Absolute(half) => (paper - half, paper + half),
            Within::Relative(share) => (paper - share * paper.abs(), paper + share * paper.abs()),
            Within::Factor(factor) => (paper / factor, paper * factor),
        };
        let (least, most) = self.range();
        ConfidenceInterval::new(low.min(high).max(least), high.max(low).min(most))
    }

    /// Returns the minimum and the maximum value of the metric.
    fn range(&self) -> (f64, f64) {
        let fields = self.metric.statistic.fields();
        let column = match fields[..] {
            [(field, _)] => self.table.record.column(field),
            _ => None,
        };
        match (&self.metric.statistic, column) {
            (Statistic::Percent(_), _) => (0.0, 100.0),
            (Statistic::Count { whole, .. }, _) => (0.0, f64::from(*whole)),
            (_, Some(column)) => column.range(),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// Returns the interval of ours minus the paper's, limited to possible values.
    fn difference(&self) -> Result<ConfidenceInterval, Doubt> {
        let paper = self.paper.value;
        let interval = self.unbounded_difference()?;
        let (least, most) = self.range();
        let low = interval.low.max(least - paper);
        let high = interval.high.min(most - paper);
        Ok(ConfidenceInterval::new(low, high.max(low)))
    }

    fn unbounded_difference(&self) -> Result<ConfidenceInterval, Doubt> {
        let Self { paper, sample, .. } = *self;
        let observed = sample.value().0 - paper.value;
        let rounding = half_a_digit(paper.value);
        // A deterministic row has the same value in every run, including the paper's.
        if sample.len() == 1 && self.row.runs == Some(1) {
            return Ok(around(observed, rounding));
        }
        let paper_runs = self.row.paper_runs.or(self.table.paper_runs);
        let paper_runs = paper_runs.ok_or(Doubt::UnknownRuns)?;
        if let Sample::Flags { flags, whole } = sample {
            return rates(flags, *whole, paper.value, paper_runs);
        }
        if sample.len() < 2 {
            return Err(Doubt::OneRun);
        }
        let is_mean = matches!(self.metric.statistic, Statistic::Of(Centre::Mean, _));
        let spreads = paper.sd.zip(sample.sd()).filter(|_| is_mean);
        let interval = match spreads {
            Some((theirs, ours)) if paper_runs > 1 => {
                let ours = SampleSummary {
                    count: sample.len() as u64,
                    mean: sample.value().0,
                    sd: ours,
                };
                let theirs = SampleSummary {
                    count: u64::from(paper_runs),
                    mean: paper.value,
                    sd: theirs,
                };
                mean_difference_interval(ours, theirs, LEVEL).ok()
            }
            // If the paper gives no spread, ours is used for it.
            _ => sample.stand_in(observed, paper_runs, self.seed),
        };
        let interval = interval.ok_or(Doubt::NoInterval)?;
        Ok(ConfidenceInterval::new(
            interval.low - rounding,
            interval.high + rounding,
        ))
    }
}

fn around(middle: f64, half: f64) -> ConfidenceInterval {
    ConfidenceInterval::new(middle - half, middle + half)
}

/// Returns the interval of the difference of two shares of `whole`.
fn rates(
    flags: &[bool],
    whole: f64,
    paper: f64,
    paper_runs: u32,
) -> Result<ConfidenceInterval, Doubt> {
    let ours = flags.iter().filter(|flag| **flag).count() as u64;
    let theirs = (paper / whole * f64::from(paper_runs)).round();
    let theirs = theirs.clamp(0.0, f64::from(paper_runs)) as u64;
    let ours = (ours, flags.len() as u64);
    rate_difference_interval(ours, (theirs, u64::from(paper_runs)), LEVEL)
        .map(|interval| interval.scaled(whole))
        .map_err(|_| Doubt::NoInterval)
}

/// Returns the rounding error of `printed`: half a unit of its last digit.
fn half_a_digit(printed: f64) -> f64 {
    let text = printed.to_string();
    let decimals = text.split_once('.').map_or("", |(_, decimals)| decimals);
    decimals.chars().fold(0.5, |half, _| half / 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record;

    record! {
        /// One throw.
        struct Throw {
            /// Whether the throw hit.
            hit: bool => higher("hits"),
            /// Number of steps to the line.
            steps: u32 => lower("steps"),
        }
    }

    const POINTS: Tolerance = Tolerance::absolute(15.0, "darts scatter");
    const THIRD: Tolerance = Tolerance::relative(0.35, "lines are drawn again");

    fn judge(metric: Metric, row: Row, sample: &Sample<'_>) -> Verdict {
        let table = Table::of::<Throw>("1", "Throws").metric(metric).row(row);
        let case = Case {
            table: &table,
            row: &table.rows[0],
            metric: &table.metrics[0],
            sample,
            paper: &table.rows[0].paper[0],
            seed: 1,
        };
        case.judge()
    }

    fn hits(hits: usize, of: usize) -> Sample<'static> {
        Sample::Flags {
            flags: (0..of).map(|run| run < hits).collect(),
            whole: 100.0,
        }
    }

    fn steps(middle: f64, spread: f64, runs: u32) -> Sample<'static> {
        let ends = (0..runs).map(|run| if run % 2 == 0 { -spread } else { spread });
        Sample::Numbers {
            numbers: ends.map(|by| middle + by).collect(),
            centre: Centre::Mean,
        }
    }

    fn success() -> Metric {
        Metric::percent("hits", Throw::hit).tolerance(POINTS)
    }

    fn time() -> Metric {
        Metric::mean(Throw::steps).tolerance(THIRD)
    }

    /// Returns a row with 17 successes in the paper's 25 runs.
    fn of_25() -> Row {
        Row::new("Novice").paper("hits", 68.0).paper_runs(25)
    }

    #[test]
    fn a_share_differs_only_where_both_samples_are_large_enough_to_tell() {
        let check = |sample: Sample<'_>, expect: Finding| {
            let verdict = judge(success(), of_25(), &sample);
            assert_eq!(verdict.finding, expect, "{verdict:?}");
        };
        check(hits(680, 1000), Finding::Matches);
        check(hits(800, 1000), Finding::Matches);
        check(hits(860, 1000), Finding::Differs);
        check(hits(950, 1000), Finding::Differs);
        check(hits(24, 25), Finding::Differs);
        check(hits(22, 25), Finding::CannotTell(Doubt::TooWide));
        // Five runs detect less.
        let resolution = |sample| judge(success(), of_25(), &sample).resolution().unwrap();
        assert!(resolution(hits(3, 5)) > resolution(hits(600, 1000)) + 10.0);
        // No share is above 100 %.
        let verdict = judge(success(), of_25(), &hits(1000, 1000));
        assert!(verdict.difference.unwrap().high <= 32.0 + 1e-9);
        assert_eq!(verdict.accepted, Some(ConfidenceInterval::new(53.0, 83.0)));
    }

    #[test]
    fn a_mean_counts_the_spread_of_both() {
        let paper = || {
            let row = Row::new("Novice").paper_mean("steps", 100.0, 80.0);
            row.paper_runs(25)
        };
        let check = |sample: Sample<'_>, expect: Finding| {
            let verdict = judge(time(), paper(), &sample);
            assert_eq!(verdict.finding, expect, "{verdict:?}");
        };
        check(steps(120.0, 60.0, 1000), Finding::Matches);
        check(steps(132.0, 60.0, 1000), Finding::Matches);
        check(steps(140.0, 60.0, 1000), Finding::Differs);
        check(steps(140.0, 60.0, 4), Finding::CannotTell(Doubt::TooWide));
        // The difference is certain, but within the tolerance.
        let row = Row::new("Novice").paper_mean("steps", 100.0, 5.0);
        let verdict = judge(time(), row.paper_runs(25), &steps(120.0, 6.0, 1000));
        assert_eq!(verdict.finding, Finding::CannotTell(Doubt::Slight));
        // No run has fewer than zero steps.
        let verdict = judge(time(), paper(), &steps(10.0, 9.0, 3));
        assert!(verdict.difference.unwrap().low >= -100.0);
    }

    #[test]
    fn a_paper_without_spread_is_held_against_ours() {
        let one_run = || Row::new("Novice").paper("steps", 200.0).paper_runs(1);
        let verdict = judge(time(), one_run(), &steps(100.0, 120.0, 1000));
        assert_eq!(verdict.finding, Finding::CannotTell(Doubt::TooWide));
        let verdict = judge(time(), one_run(), &steps(100.0, 6.0, 1000));
        assert_eq!(verdict.finding, Finding::Differs);
        let verdict = judge(time(), one_run(), &steps(190.0, 20.0, 1000));
        assert_eq!(verdict.finding, Finding::Matches);
        let median = Metric::median("steps", Throw::steps).tolerance(THIRD);
        let verdict = judge(median, one_run(), &steps(190.0, 20.0, 1000));
        assert_eq!(verdict.finding, Finding::Matches);
    }

    #[test]
    fn what_cannot_be_judged_says_why() {
        let why = |metric, row, sample: &Sample<'_>| judge(metric, row, sample).finding;
        let check = |finding: Finding, expect: Doubt| {
            assert_eq!(finding, Finding::CannotTell(expect));
        };
        let sample = steps(100.0, 5.0, 10);
        let row = || Row::new("Novice").paper("steps", 100.0);
        check(why(time(), row(), &sample), Doubt::UnknownRuns);
        let untold = Metric::mean(Throw::steps);
        check(
            why(untold, row().paper_runs(5), &sample),
            Doubt::NoTolerance,
        );
        check(
            why(time(), row().paper_runs(5), &steps(100.0, 0.0, 1)),
            Doubt::OneRun,
        );
        let aside = Row::new("Novice").paper_aside("steps", 100.0, "a bound");
        check(
            why(time(), aside, &sample),
            Doubt::Aside("a bound".to_owned()),
        );
        // A deterministic row needs only one run.
        let finding = why(time(), row().runs(1), &steps(100.0, 0.0, 1));
        assert_eq!(finding, Finding::Matches);
        let finding = why(time(), row().runs(1), &steps(200.0, 0.0, 1));
        assert_eq!(finding, Finding::Differs);
    }

    #[test]
    fn only_a_system_of_our_own_is_better() {
        let sample = hits(1000, 1000);
        assert_eq!(judge(success(), of_25(), &sample).finding, Finding::Differs);
        assert_eq!(
            judge(success(), of_25().own(), &sample).finding,
            Finding::Better
        );
        let worse = judge(success(), of_25().own(), &hits(10, 1000)).finding;
        assert_eq!(worse, Finding::Differs);
    }

    #[test]
    fn a_rounded_number_may_be_half_a_digit_off() {
        for (printed, expect) in [(0.18, 0.005), (22.11, 0.005), (17.0, 0.5)] {
            assert!((half_a_digit(printed) - expect).abs() < 1e-12, "{printed}");
        }
    }
}
