//! MSLST itself: tables 1 to 3 of "Maze Solving by Learning State Topologies", and all tests of significance.
//!
//! In a paper's world every brain meets the same starts and the same noise. MSLST learns `MAPS` maps of each
//! world and navigates by map number (run mod `MAPS`): the paper's 25 runs by 25 maps, a thousand runs by each map
//! twenty times.

mod contest;
pub mod drawing;
mod figures;
mod states;

use crate::venue;
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Entry, Experiment, Fields, Job, Options, P_TABLE, Procedure, Run,
};
use tolman_replay::Replay;

use contest::Contest;

/// How many maps are learned of each world and threshold.
const MAPS: u32 = 50;

/// What the catalogue says of it.
pub(super) const ENTRY: Entry = Entry {
    name: "mslst",
    title: "MSLST: maze solving by learning state topologies",
    source: "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 1 to 3",
    runs: 25,
    quick_runs: 10,
    open,
};

/// The experiment, ready to run.
#[derive(Debug)]
struct Mslst {
    contests: Vec<Contest>,
}

/// Reads the worlds and sets the tables up.
///
/// # Errors
/// If a maze cannot be read, or the robot does not fit its corridors.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    let venues = if options.mazes.is_empty() {
        venue::papers()?.into()
    } else {
        venue::from_files(&options.mazes, &[P_TABLE])?
    };
    let contests: Vec<Contest> = venues
        .into_iter()
        .map(|venue| Contest::new(venue, options.seed))
        .collect();
    let mut tables = Vec::new();
    if options.mazes.is_empty() {
        tables.push(states::table());
    }
    tables.extend(contests.iter().map(Contest::table));
    let worlds = contests.iter();
    let worlds = worlds.map(|contest| (&*contest.venue.table, contest.config()));
    let config = venue::config(worlds)?;
    Ok(Experiment::new(ENTRY, tables, config, Mslst { contests }))
}

impl Mslst {
    fn contest(&self, table: &str) -> Option<&Contest> {
        let mut contests = self.contests.iter();
        contests.find(|contest| contest.venue.table == table)
    }
}

impl Procedure for Mslst {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match self.contest(job.table) {
            Some(contest) => contest.run(job),
            None => states::run(job, &self.contests),
        }
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let contest = self.contest(job.table);
        contest.map(|contest| contest.replay(job)).transpose()
    }
}
