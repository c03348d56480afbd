//! Whether our value matches the paper's.

use core::fmt;

use super::difference::Difference;
use super::sample::Sample;
use super::{Better, Metric, PaperValue, Reached, Row, Statistic, Table, Tolerance, Within};
use tolman_stats::ConfidenceInterval;

/// The verdict on one value. A difference is sure if its 95 % interval, with the spread of both
/// samples, excludes 0.
///
/// - It *differs* if the difference is sure and exceeds the tolerance.
/// - It is *close* if the difference is sure and within the tolerance.
/// - It *matches* if the difference is not sure and within the tolerance.
/// - Otherwise the runs are too few: they *cannot tell*.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Result of the comparison with the paper.
    pub finding: Finding,
    /// Interval of ours minus the paper's, in the metric's unit; `None` if it is unknown.
    pub difference: Option<ConfidenceInterval>,
    /// Smallest difference that could have been detected, in the metric's unit: from ours minus the
    /// paper's to the end of its interval on the side of 0. `None` if the interval is unknown.
    pub resolution: Option<f64>,
    /// Range of our values within the tolerance, ends included; `None` without a tolerance.
    pub accepted: Option<ConfidenceInterval>,
}

/// Result of comparing a value with the paper's.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// The value matches the paper's.
    Matches,
    /// The value differs from the paper's by less than the tolerance.
    Close,
    /// The value is better than the paper's. Only rows of our own systems can be.
    Better,
    /// The value differs from the paper's.
    Differs,
    /// The runs cannot tell, for this reason.
    CannotTell(Doubt),
}

/// Reason why a value cannot be judged.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Doubt {
    /// Our runs are too few.
    TooFew {
        /// Number of runs that would do, if they scatter as those that were made.
        needed: u32,
    },
    /// The paper's runs are too few, whatever the number of ours.
    PaperTooFew {
        /// Number of the paper's runs.
        runs: u32,
        /// Smallest difference that endless runs of ours would show, with its unit.
        resolution: String,
    },
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
            Self::TooFew { needed } => return write!(f, "too few runs: {needed} would do"),
            Self::PaperTooFew { runs, resolution } => {
                let noun = if *runs == 1 { "run" } else { "runs" };
                return write!(
                    f,
                    "no number of our runs would do: the paper's {runs} {noun} cannot tell ± {resolution}"
                );
            }
            Self::UnknownRuns => "the paper does not say of how many runs its value is",
            Self::NoTolerance => "no tolerance is stated",
            Self::OneRun => return write!(f, "one run shows no spread: {LEAST_RUNS} would"),
            Self::NotReached => "ours was not reached",
            Self::NoRuns => "no run was made",
            Self::NoInterval => "there is no interval for such runs",
            Self::NoData(what) | Self::Aside(what) => what,
        })
    }
}

impl Doubt {
    /// Returns the number of our runs that would do; `None` if more runs do not help.
    #[must_use]
    pub const fn runs_needed(&self) -> Option<u32> {
        match self {
            Self::TooFew { needed } => Some(*needed),
            Self::OneRun => Some(LEAST_RUNS),
            _ => None,
        }
    }
}

/// Minimum number of our runs that show a difference beyond the tolerance. The interval rests on
/// their spread, and a few runs may agree by chance.
const LEAST_RUNS: u32 = 5;

impl Finding {
    /// Returns the verdict as a word.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Matches => "matches",
            Self::Close => "close",
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
            resolution: None,
            accepted: None,
        }
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
        let difference = Difference::of(self);
        let interval = difference.as_ref().map_err(Doubt::clone);
        let interval = interval.and_then(Difference::interval);
        let finding = match (accepted, &difference, &interval) {
            (None, ..) => Finding::CannotTell(Doubt::NoTolerance),
            (_, Err(doubt), _) | (_, _, Err(doubt)) => Finding::CannotTell(doubt.clone()),
            (Some(accepted), Ok(difference), Ok(interval)) => {
                match (accepted.contains(ours), interval.contains(0.0)) {
                    (true, true) => Finding::Matches,
                    (true, false) => Finding::Close,
                    (false, false) if self.has_enough_runs() => self.differs(ours),
                    (false, _) => Finding::CannotTell(difference.too_few(LEAST_RUNS, metric)),
                }
            }
        };
        Verdict {
            finding,
            resolution: difference.as_ref().ok().and_then(Difference::resolution),
            difference: interval.ok(),
            accepted,
        }
    }

    /// Returns whether neither value scatters: the row has the same value in every run, including
    /// the paper's.
    pub(super) fn is_exact(&self) -> bool {
        self.row.is_deterministic() && self.sample.len() == 1 && self.paper.sd.is_none()
    }

    fn has_enough_runs(&self) -> bool {
        self.is_exact() || self.sample.len() >= LEAST_RUNS as usize
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
    pub(super) fn range(&self) -> (f64, f64) {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Centre, record};

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

    fn too_few(needed: u32) -> Finding {
        Finding::CannotTell(Doubt::TooFew { needed })
    }

    #[test]
    fn a_share_is_judged_by_both_samples_and_the_tolerance() {
        let check = |sample: Sample<'_>, expect: Finding| {
            let verdict = judge(success(), of_25(), &sample);
            assert_eq!(verdict.finding, expect, "{verdict:?}");
        };
        check(hits(680, 1000), Finding::Matches);
        check(hits(800, 1000), Finding::Matches);
        check(hits(860, 1000), Finding::Differs);
        check(hits(950, 1000), Finding::Differs);
        check(hits(24, 25), Finding::Differs);
        check(hits(22, 25), too_few(50));
        // Five runs detect less.
        let resolution = |sample| judge(success(), of_25(), &sample).resolution.unwrap();
        assert!(resolution(hits(3, 5)) > resolution(hits(600, 1000)) + 10.0);
        // No share is above 100 %.
        let verdict = judge(success(), of_25(), &hits(1000, 1000));
        assert!(verdict.difference.unwrap().high <= 32.0 + 1e-9);
        assert_eq!(verdict.accepted, Some(ConfidenceInterval::new(53.0, 83.0)));
        // It is sure that 100 is not 92, and that it is within 15.
        let row = Row::new("Adept").paper("hits", 92.0).paper_runs(25);
        let verdict = judge(success(), row, &hits(200, 200));
        assert_eq!(verdict.finding, Finding::Close);
        assert!(verdict.resolution.unwrap() < 6.2, "{verdict:?}");
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
        check(steps(140.0, 60.0, 4), too_few(50));
        // The difference is sure, but within the tolerance.
        let row = Row::new("Novice").paper_mean("steps", 100.0, 5.0);
        let verdict = judge(time(), row.paper_runs(25), &steps(120.0, 6.0, 1000));
        assert_eq!(verdict.finding, Finding::Close);
        // No run has fewer than zero steps.
        let verdict = judge(time(), paper(), &steps(10.0, 9.0, 3));
        assert!(verdict.difference.unwrap().low >= -100.0);
    }

    #[test]
    fn a_paper_without_spread_is_held_against_ours() {
        let one_run = || Row::new("Novice").paper("steps", 200.0).paper_runs(1);
        let verdict = judge(time(), one_run(), &steps(100.0, 6.0, 1000));
        assert_eq!(verdict.finding, Finding::Differs);
        let verdict = judge(time(), one_run(), &steps(190.0, 20.0, 1000));
        assert_eq!(verdict.finding, Finding::Matches);
        let median = Metric::median("steps", Throw::steps).tolerance(THIRD);
        let verdict = judge(median, one_run(), &steps(190.0, 20.0, 1000));
        assert_eq!(verdict.finding, Finding::Matches);
    }

    #[test]
    fn no_number_of_runs_makes_up_for_the_papers() {
        let check = |metric, row: Row, sample: &Sample<'_>, expect: &str| {
            let finding = judge(metric, row, sample).finding;
            let doubt = finding.doubt().unwrap();
            assert_eq!(doubt.runs_needed(), None);
            assert!(doubt.to_string().contains(expect), "{doubt}");
        };
        let one_run = Row::new("Novice").paper("steps", 200.0).paper_runs(1);
        check(
            time(),
            one_run,
            &steps(100.0, 120.0, 1000),
            "the paper's 1 run cannot tell ± 12",
        );
        let of_5 = Row::new("Novice").paper("hits", 60.0).paper_runs(5);
        check(
            success(),
            of_5,
            &hits(80, 100),
            "the paper's 5 runs cannot tell ± 28.2 %",
        );
    }

    #[test]
    fn so_many_runs_would_do() {
        // Twice as scattered is four times as many runs.
        let row = || {
            Row::new("Novice")
                .paper_mean("steps", 100.0, 5.0)
                .paper_runs(25)
        };
        let needed = |metric, row, sample: &Sample<'_>| {
            let finding = judge(metric, row, sample).finding;
            finding.doubt().unwrap().runs_needed().unwrap()
        };
        let (few, many) = (steps(140.0, 100.0, 8), steps(140.0, 200.0, 8));
        assert_eq!(needed(time(), row(), &few), 50);
        assert_eq!(needed(time(), row(), &many), 200);
        for (sample, spread) in [(few, 100.0), (many, 200.0)] {
            let needed = needed(time(), row(), &sample);
            let finding = judge(time(), row(), &steps(140.0, spread, needed)).finding;
            assert_eq!(finding, Finding::Differs);
        }
        let needed = needed(success(), of_25(), &hits(22, 25)) as usize;
        let finding = judge(success(), of_25(), &hits(22 * needed / 25, needed)).finding;
        assert_eq!(finding, Finding::Differs);
    }

    #[test]
    fn a_handful_of_runs_never_differs() {
        let row = || Row::new("Novice").paper("steps", 100.0).paper_runs(25);
        assert_eq!(
            judge(time(), row(), &steps(300.0, 1.0, 4)).finding,
            too_few(5)
        );
        let finding = judge(time(), row(), &steps(300.0, 1.0, 5)).finding;
        assert_eq!(finding, Finding::Differs);
        let all = Row::new("Novice").paper("hits", 100.0).paper_runs(25);
        assert_eq!(
            judge(success(), all.clone(), &hits(0, 2)).finding,
            too_few(5)
        );
        assert_eq!(
            judge(success(), all.own(), &hits(0, 5)).finding,
            Finding::Differs
        );
        // One run of a row that is not deterministic, whatever it is one of.
        let finding = judge(time(), row().runs(1), &steps(300.0, 0.0, 1)).finding;
        assert_eq!(finding, Finding::CannotTell(Doubt::OneRun));
    }

    #[test]
    fn a_deterministic_row_needs_only_one_run() {
        let score = |row: Row, ours| judge(time(), row.run_each(1), &steps(ours, 0.0, 1)).finding;
        let paper = || Row::new("Novice").paper("steps", 32.63);
        assert_eq!(score(paper(), 32.633), Finding::Matches);
        assert_eq!(score(paper(), 34.40), Finding::Close);
        assert_eq!(score(paper(), 65.0), Finding::Differs);
        assert_eq!(score(paper().own(), 12.0), Finding::Better);
        let spread = Row::new("Novice")
            .paper_mean("steps", 32.63, 9.0)
            .paper_runs(25);
        assert_eq!(score(spread, 65.0), Finding::CannotTell(Doubt::OneRun));
    }

    #[test]
    fn what_cannot_be_judged_says_why() {
        let check = |metric, row, sample: &Sample<'_>, expect: Doubt| {
            let finding = judge(metric, row, sample).finding;
            assert_eq!(finding, Finding::CannotTell(expect));
        };
        let sample = steps(100.0, 5.0, 10);
        let row = || Row::new("Novice").paper("steps", 100.0);
        check(time(), row(), &sample, Doubt::UnknownRuns);
        let untold = Metric::mean(Throw::steps);
        check(untold, row().paper_runs(5), &sample, Doubt::NoTolerance);
        let one = steps(100.0, 0.0, 1);
        check(time(), row().paper_runs(5), &one, Doubt::OneRun);
        let aside = Row::new("Novice").paper_aside("steps", 100.0, "a bound");
        check(time(), aside, &sample, Doubt::Aside("a bound".to_owned()));
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
}
