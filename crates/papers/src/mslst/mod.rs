//! MSLST itself: tables 1 to 3 of "Maze Solving by Learning State Topologies", and all tests of significance.
//!
//! In a paper's world every brain meets the same starts and the same noise. MSLST learns `MAPS` maps of each
//! world and navigates by map number (run mod `MAPS`): the paper's 25 runs by 25 maps, a thousand runs by each map
//! twenty times.

mod contest;
pub mod drawing;
mod figures;
mod states;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_sim::robots::LaserPioneerConfig;

use crate::venue;
use tolman_arena::pioneer;
use tolman_draw::Figure;
use tolman_experiment::P_TABLE;
use tolman_experiment::{BoxError, Experiment, Fields, Job, Options, Run, Table};
use tolman_replay::Replay;

use contest::{Contest, ContestConfig};

/// How many maps are learned of each world and threshold.
const MAPS: u32 = 50;

/// The experiment, ready to run.
#[derive(Debug)]
struct Mslst {
    robot: LaserPioneerConfig,
    contests: Vec<Contest>,
    tables: Vec<Table>,
}

/// What the runs depend on.
#[derive(Serialize)]
struct Config<'a> {
    robot: &'a LaserPioneerConfig,
    worlds: BTreeMap<&'a str, ContestConfig<'a>>,
}

/// Reads the worlds and sets the tables up.
///
/// # Errors
/// If a maze cannot be read, or the robot does not fit its corridors.
pub(super) fn open(options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let venues = if options.mazes.is_empty() {
        venue::papers()?
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
    Ok(Box::new(Mslst {
        robot: pioneer::calibrated(),
        contests,
        tables,
    }))
}

impl Mslst {
    fn contest(&self, table: &str) -> Option<&Contest> {
        let mut contests = self.contests.iter();
        contests.find(|contest| contest.venue.table == table)
    }
}

impl Experiment for Mslst {
    fn name(&self) -> &str {
        "mslst"
    }

    fn title(&self) -> &str {
        "MSLST: maze solving by learning state topologies"
    }

    fn source(&self) -> &str {
        "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 1 to 3"
    }

    fn default_runs(&self) -> u32 {
        25
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let worlds = self.contests.iter();
        let worlds = worlds.map(|contest| (&*contest.venue.table, contest.config()));
        Ok(toml::Table::try_from(Config {
            robot: &self.robot,
            worlds: worlds.collect(),
        })?)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match self.contest(job.table) {
            Some(contest) => contest.run(job, &self.robot),
            None => states::run(job, &self.contests, &self.robot),
        }
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let contest = self.contest(job.table);
        contest
            .map(|contest| contest.replay(job, &self.robot))
            .transpose()
    }
}
