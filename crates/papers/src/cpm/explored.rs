//! Completely explored mazes: the robot's walk compared with the best one, and the bound of Theorem
//! 1 compared with the measured times.

use tolman_systems::cpm::Done;

use super::trials::{Setting, Trials, better, in_both_modes};
use tolman_arena::course::Course;
use tolman_arena::cpm::CpmTrial;
use tolman_experiment::{BoxError, Fields, Options, Record, Table, record, require};

/// Name of the table.
pub(super) const EXPLORED: &str = "explored";

/// Number of runs of a row. If a walk is half as long again as the best one, this gives its mean to
/// within a thirtieth.
const RUNS: u32 = 40;

/// Number of runs of a row for a first look.
const QUICK_RUNS: u32 = 3;

record! {
    /// A maze explored until its map has no unknown port.
    #[check(ExploredRun::relations)]
    struct ExploredRun {
        /// Number of time steps in which the robot touched a wall.
        bumps: u32 => lower("steps at a wall"),
        /// Whether the exploration was completed.
        finished: bool => higher("finished"),
        /// Whether every junction and fragment is on the map exactly once, and all are joined as
        /// they truly are.
        map_right: bool => higher("map right"),
        /// Number of fragments on the map.
        fragments: u32 => neither("fragments"),
        /// Number of walks along fragments.
        traversals: u32 => lower("fragments walked"),
        /// Number of fragments in the shortest walk from the start through all of them.
        best: Option<u32> => neither("best covering walk"),
        /// Walked fragments per fragment of the best covering walk.
        traversals_to_best: Option<f64> => lower("walked / best"),
        /// Time until the last fragment was first walked.
        seconds: Option<f64> => lower("all walked after").unit("s").at_least(0),
        /// Bound of Theorem 1 on that time.
        bound: f64 => neither("Theorem 1").unit("s"),
        /// Whether that time is within the bound.
        within_bound: bool => higher("within Theorem 1"),
        /// Reason why the exploration ended early.
        trouble: Option<String> => neither("trouble"),
    }
}

impl ExploredRun {
    fn relations(&self) -> Result<(), String> {
        let is_within = self.seconds.is_some_and(|seconds| seconds <= self.bound);
        let told = "within_bound is not whether the seconds are within the bound";
        require(self.within_bound == is_within, told)?;
        let finished = !self.map_right || self.finished;
        require(
            finished,
            "an exploration that is not finished has no right map",
        )?;
        let covered = !self.map_right || self.best.is_none_or(|best| self.traversals >= best);
        require(
            covered,
            "a maze was explored by less than the best covering walk",
        )
    }
}

/// Returns the trials. If `papers` is true, the mazes are the paper's, and drawn ones are added.
pub(super) fn explored(courses: &[Course], papers: bool, options: &Options) -> Trials {
    let mut settings = in_both_modes(courses);
    if papers {
        settings.push(Setting::aliased("Aliased better", better()));
    }
    let table = Table::of::<ExploredRun>(EXPLORED, "Mazes explored to their end")
        .metrics_from(ExploredRun::finished)
        .note(
            "The robot walks until no port of its map is unknown. The best covering walk is the \
             shortest from the start through all fragments, given the maze. Theorem 1 bounds the \
             time until the last fragment is walked, whether the robot knows that or not. The bound \
             follows from the times of the fragments before the first repeated one, and from the \
             longest time of any fragment.",
        );
    let runs = options.runs_else(RUNS, QUICK_RUNS);
    let row = |setting: &Setting| setting.row().runs(runs);
    Trials::new(table, settings, row, measure)
}

/// Explores one maze and returns the record.
fn measure(trial: &CpmTrial<'_>) -> Result<Fields, BoxError> {
    let found = trial.explore()?;
    let is_within = found.seconds.is_some_and(|seconds| seconds <= found.bound);
    let is_finished = found.done == Some(Done::Reached);
    let to_best = |best: u32| f64::from(found.traversals) / f64::from(best);
    let run = ExploredRun {
        finished: is_finished,
        map_right: is_finished && found.is_map_right,
        traversals: found.traversals,
        fragments: found.fragments,
        best: found.best,
        traversals_to_best: found.best.filter(|_| is_finished).map(to_best),
        seconds: found.seconds,
        bound: found.bound,
        within_bound: is_within,
        bumps: found.bumps,
        trouble: found.trouble,
    };
    Ok(run.fields()?)
}
