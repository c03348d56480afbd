//! Completely explored mazes: the robot's walk compared with the best one, and the bound of Theorem
//! 1 compared with the measured times.

use alloc::collections::BTreeSet;

use tolman_maps::cpm::theorem_1;
use tolman_systems::cpm::{Aim, Done};

use super::trials::{Setting, Trials, better, in_both_modes};
use tolman_arena::course::Course;
use tolman_arena::cpm::{CpmTrial, TrueFragments, is_whole_map_right};
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

/// Explores one maze to its end and returns the record; a failure on the way is part of it.
fn measure(trial: &CpmTrial<'_>) -> Result<Fields, BoxError> {
    let maze = &trial.course.maze;
    let fragments = TrueFragments::of(maze);
    let mut found = ExploredRun {
        fragments: fragments.count(),
        best: fragments.covering_walk(maze),
        ..ExploredRun::default()
    };
    let mut run = match trial.begin()? {
        Ok(run) => run,
        Err(error) => {
            found.trouble = Some(error.to_string());
            return Ok(found.fields()?);
        }
    };
    let mut ends_us = vec![run.walker.time_us()];
    // How many fragments were known after each walk.
    let (mut walked, mut known) = (BTreeSet::new(), Vec::new());
    let ended = run.pursue(Aim::Explore, |_, walker, step| {
        let way = step.arrival.and_then(|_| fragments.taken(walker));
        walked.extend(way.map(|way| way.fragment));
        ends_us.push(walker.time_us());
        known.push(walked.len() as u32);
    });
    match ended {
        Ok(episode) => found.finished = episode.done == Done::Reached,
        Err(error) => found.trouble = Some(error.to_string()),
    }
    let seconds = |pair: &[u64]| (pair[1] - pair[0]) as f64 * 1e-6;
    let times: Vec<f64> = ends_us.windows(2).map(seconds).collect();
    // T₁ … of the fragments "the robot passes before detecting duplication".
    let first = (1..)
        .zip(&known)
        .take_while(|(walks, known)| walks == *known);
    let longest = times.iter().copied().fold(0.0, f64::max);
    found.bound = theorem_1(&times[..first.count()], longest, found.fragments);
    let last = known.iter().position(|known| *known == found.fragments);
    found.seconds = last.map(|last| times[..=last].iter().sum());
    found.within_bound = found.seconds.is_some_and(|seconds| seconds <= found.bound);
    found.traversals = run.layer.explorer.mapper.traversals();
    let to_best = |best: u32| f64::from(found.traversals) / f64::from(best);
    found.traversals_to_best = found.best.filter(|_| found.finished).map(to_best);
    found.map_right = found.finished && last.is_some() && is_whole_map_right(run.layer.map(), maze);
    found.bumps = run.walker.body().bumps();
    Ok(found.fields()?)
}
