//! The tables of trials: both episodes in one maze.

use alloc::collections::BTreeMap;

use super::{agree, less, mazes};
use crate::metrics::UsualMetrics as _;
use crate::rows::row_of;
use crate::tolerances::SUCCESS;
use tolman_arena::course::Course;
use tolman_arena::cpm::{BendLikeness, CpmTrial, TrialRecord, epuck};
use tolman_experiment::Record as _;
use tolman_experiment::{BoxError, Fields, Job, Metric, Options, Row, Table, record, require};
use tolman_geom::path_length;
use tolman_maps::cpm::{FragmentMatching, Similarity};
use tolman_systems::cpm::{CommonPatterns, CpmConfig, Mode};

/// Name of the table of figure 9.
pub(super) const FIGURE_9: &str = "9";

/// Number of runs in the table of aliased mazes, each in another maze.
const ALIASED_MAZES: u32 = 200;

/// Number of those runs for a first look.
const ALIASED_QUICK: u32 = 20;

/// Number of fragments after which the paper's system gives up in an aliased maze, which has about
/// seven. With a wrong map it may go round forever.
const ALIASED_PATIENCE: u32 = 500;

/// Suffix of rows with the paper's offline system.
const OFFLINE: &str = " offline";

/// Suffix of rows with the offline system that computes f_S literally.
const PAPERS_RULE: &str = " offline (paper's rule)";

/// Suffix of rows with our own version.
pub(super) const BETTER: &str = " better";

/// Multiple of the shortest path from which on an episode is long.
const LONG: f64 = 10.0;

/// A table, and the setting of each of its rows.
#[derive(Debug)]
pub(super) struct Trials {
    pub(super) table: Table,
    settings: Vec<Setting>,
    /// Plays a trial and returns its record.
    measure: fn(&CpmTrial<'_>) -> Result<Fields, BoxError>,
}

/// Setting of a row.
#[derive(Debug)]
pub(super) struct Setting {
    row: String,
    /// Maze of the row; `None` for another maze with similar fragments in each run.
    course: Option<Course>,
    mode: Mode,
}

impl Setting {
    /// Returns a setting with another maze of similar fragments in each run.
    pub(super) fn aliased(row: &str, mode: Mode) -> Self {
        Self {
            row: row.into(),
            course: None,
            mode,
        }
    }

    pub(super) fn row(&self) -> Row {
        Row::new(&self.row)
    }
}

/// Returns the online mode of section 6 of the paper.
pub(super) fn faithful() -> Mode {
    Mode::Paper(CpmConfig::online())
}

/// Returns the mode of the paper's own trials, with its equations taken literally.
fn papers_rule() -> Mode {
    let mut config = CpmConfig::offline();
    config.matching = FragmentMatching::Positions(Similarity::literal());
    Mode::Paper(config)
}

/// Returns the mode of our own version: dead reckoning beside the patterns.
pub(super) fn better() -> Mode {
    Mode::Reckoned(CpmConfig::robust())
}

/// Returns the trials of figure 9. `papers` tells whether the mazes are the paper's.
pub(super) fn figure_9(courses: &[Course], papers: bool) -> Trials {
    let modes = [
        ("", faithful()),
        (OFFLINE, Mode::Paper(CpmConfig::offline())),
        (PAPERS_RULE, papers_rule()),
        (BETTER, better()),
    ];
    let settings = in_modes(courses, modes);
    let least = Metric::least("reduction_min_percent", TrialRun::reduction);
    let table = Table::of::<TrialRun>(FIGURE_9, "Time from the first to the second episode")
    .metrics([TrialRun::solved, TrialRun::shortest_as_it_lies, TrialRun::map_right])
    .metric(least.titled("least time saved"))
    .metric(reduction())
    .metrics([TrialRun::long])
    .metric(Metric::mean(TrialRun::reduction_long).named("reduction_long_percent"))
    .metrics([
        TrialRun::closure_precision,
        TrialRun::closure_recall,
        TrialRun::seconds_1,
        TrialRun::seconds_2,
        TrialRun::bumps,
    ])
    .paper_runs(10)
    .note(format!(
        "Solved: the goal was found, and found again by a way as short as any that could be known. \
         Two visits are known to be of one junction if a fragment that ends there was walked twice. \
         Shortest on true map: as short as any way over the same fragments, joined as they truly \
         are. Map right: each junction and fragment where the robot has been is on the map exactly \
         once, and all are joined as they truly are. Time saved is of solved runs; some drove {LONG} \
         times the shortest path or more in the first episode. Precision and recall of loops are \
         means over the runs in which any was closed, or could have been. In the paper the time \
         saved is over 50 % in every trial, and up to 95 %; its robot needs no more than two \
         episodes either. Its trials are offline: the map is optimized when the goal is found \
         (section 5). So its figures are beside those rows; rows without a word are online (section \
         6). Paper's rule: offline, with f_S taken literally, which compares the numbers of patterns \
         up to the shorter one's end."
    ));
    let row = |setting: &Setting| {
        let row = setting.row();
        // The paper's trials are offline.
        if papers && setting.row.contains(OFFLINE) {
            row.paper("solved_percent", 100.0).paper_aside(
                "reduction_min_percent",
                50.0,
                "the paper has a bound: over 50 % in every trial",
            )
        } else {
            row
        }
    };
    Trials::new(table, settings, row, measure)
}

/// Returns settings with each maze for the paper's system and for ours.
pub(super) fn in_both_modes(courses: &[Course]) -> Vec<Setting> {
    in_modes(courses, [("", faithful()), (BETTER, better())])
}

/// Returns settings with each maze in some modes, each with its row's suffix.
fn in_modes<const N: usize>(courses: &[Course], modes: [(&str, Mode); N]) -> Vec<Setting> {
    let setting = |course: &Course, suffix: &str, mode| Setting {
        row: format!("{}{suffix}", course.name),
        course: Some(course.clone()),
        mode,
    };
    let each = |course| modes.map(|(suffix, mode)| setting(course, suffix, mode));
    courses.iter().flat_map(each).collect()
}

/// Returns the trials of the paper's two systems side by side.
pub(super) fn offline(courses: &[Course]) -> Trials {
    let offline = Mode::Paper(CpmConfig::offline());
    let settings = in_modes(courses, [(OFFLINE, offline), (" online", faithful())]);
    let table = Table::of::<TrialRun>("offline", "Offline against online CPM")
        .metrics([
            TrialRun::solved,
            TrialRun::traversals,
            TrialRun::true_fragments,
            TrialRun::seconds_1,
            TrialRun::seconds_2,
        ])
        .note(
            "Offline the robot takes random ports and compares its map only when the goal is found \
             (section 4); online it does so before each decision (section 6). Rows of one maze have \
             the same random numbers.",
        );
    Trials::new(table, settings, Setting::row, measure)
}

/// Returns trials without a learning maze: "The CPs must be learned incrementally" (section 8).
pub(super) fn unlearned(courses: &[Course]) -> Trials {
    let mode = Mode::Unlearned(CpmConfig::robust());
    let mut settings = in_modes(courses, [("", mode)]);
    settings.push(Setting::aliased("Aliased", mode));
    let table = Table::of::<UnlearnedRun>("unlearned", "Patterns learned on the way")
        .metrics([
            TrialRun::solved,
            TrialRun::map_right,
            TrialRun::closure_precision,
            TrialRun::closure_recall,
        ])
        .metric(reduction())
        .metrics_from(UnlearnedRun::patterns)
        .note(
            "The better robot without a learning maze. An observation unlike all its patterns \
             becomes a pattern, and older sequences stay valid. Aliased: one random maze per run.",
        );
    Trials::new(table, settings, Setting::row, |trial| {
        let record = trial.play()?;
        let run = UnlearnedRun {
            trial: TrialRun::of(trial.course, &record, record.is_solved()),
            patterns: record.patterns,
        };
        Ok(run.fields()?)
    })
}

/// Returns the trials in mazes that the paper excludes.
pub(super) fn aliased(options: &Options) -> Trials {
    let mut patient = CpmConfig::online();
    patient.most_traversals = ALIASED_PATIENCE;
    let rows = [("Better", better()), ("Faithful", Mode::Paper(patient))];
    let settings = Vec::from(rows.map(|(row, mode)| Setting::aliased(row, mode)));
    let table = Table::of::<AliasedRun>("aliased", "Mazes with fragments that look alike")
        .metrics([
            TrialRun::solved,
            TrialRun::map_right,
            AliasedRun::shortest_known,
            TrialRun::shortest_as_it_lies,
            TrialRun::closure_precision,
            TrialRun::closure_recall,
            TrialRun::bumps,
        ])
        .metrics_from(AliasedRun::alike_pairs)
        .note(format!(
            "One random maze per run, the same for both rows, in which two fragments or more bend \
             alike, cell by cell, from one end or the other. Symmetrical ones bend the same from \
             both ends. Faithful is the paper's system, which excludes such mazes, and gives up \
             after {ALIASED_PATIENCE} fragments. Solved: the goal was found, and found again by a \
             way as short as any that could be known, and the map is right. Each junction and \
             fragment where the robot has been is then on it exactly once, and all are joined as \
             they truly are. Shortest on true map: the goal was found again by a way as short as any \
             over the same fragments, joined as they truly are.",
        ));
    let mazes = options.runs_else(ALIASED_MAZES, ALIASED_QUICK);
    let row = |setting: &Setting| setting.row().runs(mazes);
    Trials::new(table, settings, row, |trial| {
        let record = trial.play()?;
        let is_solved = record.is_solved() && record.is_map_right;
        let likeness = BendLikeness::of(&trial.course.maze);
        let run = AliasedRun {
            trial: TrialRun::of(trial.course, &record, is_solved),
            shortest_known: record.is_solved(),
            alike_pairs: likeness.alike_pairs,
            symmetrical: likeness.symmetrical,
        };
        Ok(run.fields()?)
    })
}

/// Returns the metric of time saved in the second episode.
fn reduction() -> Metric {
    Metric::mean(TrialRun::reduction).named("reduction_percent")
}

record! {
    /// Both episodes in one maze.
    #[check(TrialRun::relations)]
    pub(super) struct TrialRun {
        /// Whether the goal was found, and found again by a way as short as any that could be
        /// known.
        solved: bool => higher("solved").tolerance(SUCCESS),
        /// Whether that way was as short as any over the same fragments, joined as they truly are.
        shortest_as_it_lies: bool => higher("shortest on true map"),
        /// Whether every junction and fragment is on the map exactly once, and all are joined as
        /// they truly are.
        map_right: bool => higher("map right"),
        /// Share of time that the second episode of a solved trial saves.
        reduction: Option<f64> => higher("time saved").unit("%").at_most(100),
        /// Whether the first episode of a solved trial was ten times as long as the shortest path.
        long: bool => neither("trials 10× the shortest"),
        /// Share of time that the second episode of such a trial saves.
        reduction_long: Option<f64> =>
            higher("time saved, trials 10× the shortest").unit("%").at_most(100),
        /// Share of the loops closed on the map that are truly closed.
        closure_precision: Option<f64> => higher("loops closed: precision").share(),
        /// Share of the truly closed loops that are closed on the map.
        closure_recall: Option<f64> => higher("loops closed: recall").share(),
        /// Time until the goal is found.
        seconds_1: Option<f64> => lower("episode 1").unit("s").at_least(0),
        /// Time until the goal is found again.
        seconds_2: Option<f64> => lower("episode 2").unit("s").at_least(0),
        /// Number of observations until the goal is found.
        observations_1: Option<u32> => lower("observations in episode 1"),
        /// Number of observations until the goal is found again.
        observations_2: Option<u32> => lower("observations in episode 2"),
        /// Number of walks along fragments in the first episode.
        traversals: u32 => lower("fragments walked"),
        /// Number of fragments on the map.
        fragments: u32 => neither("fragments on the map"),
        /// Number of different fragments walked.
        true_fragments: u32 => neither("different fragments walked"),
        /// Number of fragments that contradicted the map.
        contradictions: u32 => lower("contradictions"),
        /// Number of time steps in which the robot touched a wall.
        bumps: u32 => lower("steps at a wall"),
        /// Reason why the trial ended early.
        trouble: Option<String> => neither("trouble"),
    }
}

record! {
    /// A trial of a robot without a learning maze.
    struct UnlearnedRun {
        ..trial: TrialRun,
        /// Number of common patterns at the end.
        patterns: u32 => neither("patterns"),
    }
}

record! {
    /// A trial in a maze with fragments that look alike.
    struct AliasedRun {
        ..trial: TrialRun,
        /// Whether the goal was found again by a way as short as any that could be known.
        shortest_known: bool => higher("shortest that could be known"),
        /// Number of pairs of fragments that bend alike.
        alike_pairs: u32 => neither("pairs of similar fragments").at_least(1),
        /// Number of fragments that bend the same from both ends.
        symmetrical: u32 => neither("symmetrical fragments"),
    }
}

/// The mode of every row.
pub(super) type Modes<'a> = BTreeMap<&'a str, Mode>;

impl Trials {
    /// Returns a table with a row for each setting.
    pub(super) fn new(
        table: Table,
        settings: Vec<Setting>,
        row: impl Fn(&Setting) -> Row,
        measure: fn(&CpmTrial<'_>) -> Result<Fields, BoxError>,
    ) -> Self {
        Self {
            table: table.rows(settings.iter().map(row)),
            settings,
            measure,
        }
    }

    /// Returns the mode of every row, for the configuration.
    pub(super) fn modes(&self) -> Modes<'_> {
        let settings = self.settings.iter();
        settings
            .map(|setting| (&*setting.row, setting.mode))
            .collect()
    }

    /// Returns maze and mode of a run.
    pub(super) fn cast(&self, job: &Job<'_>) -> Result<(Course, Mode), BoxError> {
        let setting = row_of(job, &self.settings, |setting| setting.row == job.row)?;
        let course = match &setting.course {
            Some(course) => course.clone(),
            None => mazes::aliased(job.seed)?,
        };
        Ok((course, setting.mode))
    }

    /// Plays a run and returns its fields.
    pub(super) fn run(&self, patterns: &CommonPatterns, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (course, mode) = self.cast(job)?;
        (self.measure)(&trial(&course, patterns, mode, job.seed))
    }
}

/// Plays a trial and returns the record of both episodes.
fn measure(trial: &CpmTrial<'_>) -> Result<Fields, BoxError> {
    let record = trial.play()?;
    Ok(TrialRun::of(trial.course, &record, record.is_solved()).fields()?)
}

/// Returns a trial of the paper's robot.
pub(super) fn trial<'a>(
    course: &'a Course,
    patterns: &'a CommonPatterns,
    mode: Mode,
    seed: u64,
) -> CpmTrial<'a> {
    CpmTrial {
        course,
        patterns,
        robot: epuck(),
        mode,
        seed,
    }
}

impl TrialRun {
    fn of(course: &Course, record: &TrialRecord, solved: bool) -> Self {
        let closures = record.closures;
        let shortest = course.shortest_metres();
        let long = solved && shortest.is_some_and(|shortest| metres(record) >= LONG * shortest);
        let reduction = record.reduction_percent().filter(|_| solved);
        Self {
            solved,
            shortest_as_it_lies: record.is_solved() && record.is_shortest_as_it_lies,
            map_right: record.is_map_right,
            reduction,
            long,
            reduction_long: reduction.filter(|_| long),
            closure_precision: share(closures.right, closures.wrong),
            closure_recall: share(closures.right, closures.missed),
            seconds_1: record.first.map(|episode| episode.seconds),
            seconds_2: record.second.map(|episode| episode.seconds),
            observations_1: record.first.map(|episode| episode.observations),
            observations_2: record.second.map(|episode| episode.observations),
            traversals: record.traversals,
            fragments: record.map.fragments().len() as u32,
            true_fragments: record.true_fragments,
            contradictions: record.contradictions,
            bumps: record.bumps,
            trouble: record.trouble.clone(),
        }
    }

    fn relations(&self) -> Result<(), String> {
        let (first, second) = (self.seconds_1, self.seconds_2);
        let together = first.is_some() == self.observations_1.is_some()
            && second.is_some() == self.observations_2.is_some();
        require(together, "seconds and observations come together")?;
        let after = second.is_none() || first.is_some();
        require(after, "there is no second episode without a first")?;
        let both = !self.solved || second.is_some();
        require(both, "a run that is solved has two episodes")?;
        let expected = first.zip(second).filter(|_| self.solved);
        let expected = expected.map(|(first, second)| less([first, second]));
        let reduction = self.reduction;
        let told = format!("reduction is {reduction:?}, expected {expected:?}");
        require(agree(reduction, expected), &told)?;
        require(
            !self.long || self.solved,
            "a long run is one that is solved",
        )?;
        let of_long = expected.filter(|_| self.long);
        let told = "the reduction of a long run, and of no other, is its reduction";
        require(agree(self.reduction_long, of_long), told)?;
        let sound = !self.solved || self.trouble.is_none();
        require(sound, "a run in trouble is not solved")?;
        let most = [self.fragments, self.true_fragments, self.contradictions];
        let walked = most.into_iter().all(|count| count <= self.traversals);
        require(walked, "more fragments or contradictions than traversals")
    }
}

/// Returns the distance driven in the first episode, m.
pub(super) fn metres(record: &TrialRecord) -> f64 {
    let first = record
        .path
        .get(..record.second_from)
        .unwrap_or(&record.path);
    path_length(first)
}

/// Returns the share of `part` in the sum of both; `None` if that is 0.
pub(super) fn share(part: u32, rest: u32) -> Option<f64> {
    (part + rest > 0).then(|| f64::from(part) / f64::from(part + rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solved() -> TrialRun {
        TrialRun {
            solved: true,
            shortest_as_it_lies: true,
            map_right: true,
            reduction: Some(75.0),
            closure_precision: Some(1.0),
            closure_recall: Some(0.5),
            seconds_1: Some(200.0),
            seconds_2: Some(50.0),
            observations_1: Some(100),
            observations_2: Some(5),
            traversals: 9,
            fragments: 4,
            true_fragments: 5,
            ..TrialRun::default()
        }
    }

    #[test]
    fn what_no_trial_measures_is_refused() {
        solved().relations().unwrap();
        let long = |reduction_long| TrialRun {
            long: true,
            reduction_long,
            ..solved()
        };
        long(Some(75.0)).relations().unwrap();
        let spoilt = |spoil: fn(&mut TrialRun)| {
            let mut run = solved();
            spoil(&mut run);
            run
        };
        for (run, why) in [
            (spoilt(|run| run.reduction = Some(70.0)), "expected Some(75"),
            (long(Some(70.0)), "is its reduction"),
            (long(None), "is its reduction"),
            (
                spoilt(|run| (run.solved, run.reduction, run.long) = (false, None, true)),
                "long run",
            ),
            (spoilt(|run| run.solved = false), "expected None"),
            (spoilt(|run| run.seconds_2 = None), "come together"),
            (spoilt(|run| run.trouble = Some("lost".into())), "trouble"),
            (spoilt(|run| run.fragments = 10), "more fragments"),
        ] {
            let found = run.relations().unwrap_err();
            assert!(found.contains(why), "{found}");
        }
        let mut columns = TrialRun::columns().into_iter();
        let recall = columns.find(|column| column.field == TrialRun::closure_recall);
        assert_eq!(recall.unwrap().high, Some(1.0));
    }
}
