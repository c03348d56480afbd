//! The baselines of MSLST: what wandering and wall-following reach without any map.
//!
//! Tables 2 and 3 of "Maze Solving by Learning State Topologies" for its two simple brains, with a random
//! one as the floor and an oracle as the ceiling; competition mazes, or any others, as further tables; and
//! how often the corridor detector takes each kind of place for a corridor.

mod detector;
mod figures;
mod worlds;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_sim::robots::LaserPioneerConfig;

use crate::venue::{self, MazeRun, Venue, World};
use tolman_arena::Mind;
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::episode::{self, Episode, EpisodeError, Trial};
use tolman_arena::pioneer;
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Correction, Experiment, Fields, Job, Metric, Options, Record, Run, Table, Tolerance,
};
use tolman_replay::Replay;

/// The rows: the paper's brains in its order, then floor and ceiling.
const ROWS: [Agent; 4] = [
    Agent::Avoid,
    Agent::WallFollow,
    Agent::Random,
    Agent::Oracle,
];

/// The experiment, ready to run.
#[derive(Debug)]
struct Baselines {
    robot: LaserPioneerConfig,
    venues: Vec<Venue>,
    /// The agents of each venue.
    casts: Vec<Cast>,
    tables: Vec<Table>,
    /// What is not here.
    skipped: Option<String>,
}

/// What the runs depend on.
#[derive(Serialize)]
struct Config<'a> {
    robot: &'a LaserPioneerConfig,
    worlds: BTreeMap<&'a str, World>,
}

/// Reads the worlds and sets the tables up.
///
/// # Errors
/// If a maze cannot be read, or the robot does not fit its corridors.
pub(super) fn open(options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let (venues, skipped) = worlds::venues(&options.mazes)?;
    let mut tables: Vec<Table> = venues.iter().map(table).collect();
    tables.push(detector::table());
    let casts = venues.iter().map(|_| Cast::default()).collect();
    Ok(Box::new(Baselines {
        robot: pioneer::calibrated(),
        venues,
        casts,
        tables,
        skipped,
    }))
}

fn table(venue: &Venue) -> Table {
    let mut table = venue
        .table::<MazeRun>()
        .metric(
            Metric::percent("success_percent", MazeRun::reached)
                .tolerance(Tolerance::Absolute(15.0)),
        )
        .metric(Metric::mean(MazeRun::actions))
        .metric(Metric::mean(MazeRun::steps).tolerance(Tolerance::Relative(0.35)))
        .metric(
            Metric::ratio("steps_per_action", MazeRun::steps, MazeRun::actions)
                .titled("steps / action")
                .defined("Time steps of all runs for each of their actions.")
                .tolerance(Tolerance::Relative(0.2)),
        );
    for name in ROWS.map(Agent::name) {
        let row = venue.row(name);
        let paper = |metric| Some(row.paper_value(metric)?.value);
        table = table.row(match paper("steps").zip(paper("actions")) {
            Some((steps, actions)) => row.paper("steps_per_action", steps / actions),
            None => row,
        });
    }
    table.compared_with(ROWS[0].name(), Correction::Bonferroni)
}

impl Baselines {
    fn venue(&self, table: &str) -> Option<(usize, &Venue)> {
        self.venues
            .iter()
            .enumerate()
            .find(|(_, venue)| venue.table == table)
    }

    /// What a run is made of; `None` for one of the detector.
    fn cast(&self, job: &Job<'_>) -> Result<Option<(Trial<'_>, Mind)>, EpisodeError> {
        let (Some((index, venue)), Some(agent)) = (self.venue(job.table), Agent::named(job.row))
        else {
            return Ok(None);
        };
        let trial = venue.trial(&self.robot, job.seed);
        let mind = self.casts[index].mind(agent, &venue.course, &self.robot)?;
        Ok(Some((trial, mind)))
    }

    /// Plays one run; also how figures play it again.
    fn episode(&self, job: &Job<'_>) -> Result<Option<Episode>, EpisodeError> {
        let Some((trial, mut mind)) = self.cast(job)? else {
            return Ok(None);
        };
        episode::run(&trial, &mut mind, |_| {}).map(Some)
    }
}

impl Experiment for Baselines {
    fn name(&self) -> &str {
        "baselines"
    }

    fn title(&self) -> &str {
        "Mazes without a map: MSLST's baselines"
    }

    fn source(&self) -> &str {
        "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 2 and 3"
    }

    fn default_runs(&self) -> u32 {
        25
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn skipped(&self) -> Option<&str> {
        self.skipped.as_deref()
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let worlds = self.venues.iter();
        Ok(toml::Table::try_from(Config {
            robot: &self.robot,
            worlds: worlds.map(|venue| (&*venue.table, venue.world())).collect(),
        })?)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match self.episode(job)? {
            Some(episode) => Ok(MazeRun::of(&episode).fields()?),
            None => detector::run(job),
        }
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let Some((trial, mut mind)) = self.cast(job)? else {
            return Ok(None);
        };
        Ok(Some(venue::replay(job, &trial, &mut mind, &[])?))
    }
}
