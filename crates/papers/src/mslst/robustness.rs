//! The better system with faults, and without each of its parts, in drawings of Large.
//!
//! A run is a drawing with several starts, so the spread is between mazes.

use alloc::sync::Arc;

use rand::RngExt;
use serde::Serialize;
use tolman_maze::{Maze, MazeFile};

use super::condition::Condition;
use super::driven::{DrivenRun, Driver, shared_out};
use super::entrant::{Entrant, LearnerConfig};
use crate::kept::Kept;
use crate::rows::row_of;
use crate::venue::{self, Drawing, LARGE_DRAWINGS, Venue};
use tolman_arena::course::Course;
use tolman_arena::mslst::learn_better_without;
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, run_seed};
use tolman_sim::DoorState;
use tolman_systems::mslst::better::BetterPart;
use tolman_systems::stream;

/// Names of the tables.
pub(super) const ROBUSTNESS: &str = "robustness";
pub(super) const ABLATION: &str = "ablation";

/// Rows of the ablation, with the part that each leaves out.
const PARTS: [(&str, Option<BetterPart>); 7] = [
    ("Better", None),
    ("positions by wheels alone", Some(BetterPart::Fit)),
    ("wandering like Avoid", Some(BetterPart::Exploration)),
    ("plans for exact motors", Some(BetterPart::Chances)),
    ("the likeliest place only", Some(BetterPart::Average)),
    ("absence of the goal unused", Some(BetterPart::Absence)),
    ("scans as sensed", Some(BetterPart::Straightening)),
];

/// Stream of random numbers for the position of doors.
const DOOR_STREAM: u64 = 4;

/// The drawings, and the plans made in them.
#[derive(Debug)]
pub(super) struct Robustness {
    mazes: u32,
    starts: u32,
    limit: Option<u32>,
    /// Venues by number of the drawing, and whether a door is shut in it.
    venues: Kept<(u32, bool), Venue>,
}

/// Configuration of the runs.
#[derive(Serialize)]
pub(super) struct RobustnessConfig {
    starts: u32,
    limit: Option<u32>,
    /// Configuration of the better system in all rows. Each row of the ablation leaves out a part.
    better: Option<LearnerConfig>,
}

impl Robustness {
    /// Returns the experiment with `runs` starts in all; each drawing has at least five.
    pub(super) fn new(runs: u32, limit: Option<u32>) -> Self {
        let (mazes, starts) = shared_out(runs, LARGE_DRAWINGS.len() as u32);
        Self {
            mazes,
            starts,
            limit,
            venues: Kept::default(),
        }
    }

    pub(super) fn config(&self) -> RobustnessConfig {
        RobustnessConfig {
            starts: self.starts,
            limit: self.limit,
            better: Entrant::Better.config(pioneer::CORRIDOR_WIDTH),
        }
    }

    /// Returns its two tables.
    pub(super) fn tables(&self) -> [Table; 2] {
        let conditions = Condition::ALL.map(|(_, name)| name);
        let parts = PARTS.map(|(name, _)| name);
        [
            self.table(
                ROBUSTNESS,
                "The better system where something is wrong",
                conditions,
            ),
            self.table(
                ABLATION,
                "The better system without each of its parts",
                parts,
            ),
        ]
    }

    fn table(
        &self,
        name: &str,
        title: &str,
        rows: impl IntoIterator<Item = &'static str>,
    ) -> Table {
        DrivenRun::table(name, title)
            .rows(rows.into_iter().map(|row| Row::new(row).runs(self.mazes)))
            .note(format!(
                "A run is a drawing of Large with {} starts, by one map that was learned in it. The \
                 Unlocalized oracle's robot has the same calibration, with sensors without errors. \
                 It knows of a door that was shut since.",
                self.starts
            ))
    }

    /// Plays a run: a drawing.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (condition, without) = row(job)?;
        let learned_in = self.venue(job.run, DoorState::Open)?;
        let venue = self.venue(job.run, condition.door())?;
        let robot = condition.robot(&venue.robot);
        let learned = learn_better_without(without, &learned_in.course, &robot, job.seed)?;
        let driver = Driver {
            venue: &venue,
            robot: &robot,
            map: &learned.map,
            starts: self.starts,
            seed: job.seed,
        };
        let lifted = |start| condition.lifted(&venue, run_seed(job.seed, "elsewhere", start));
        let run = driver.drive(lifted, |_, _| {})?;
        Ok(run.fields()?)
    }

    /// Returns a drawing as it was learned, or with a door shut afterwards, with the plans made
    /// there.
    fn venue(&self, number: u32, door: DoorState) -> Result<Arc<Venue>, BoxError> {
        self.venues.get((number, door == DoorState::Shut), || {
            let drawing = LARGE_DRAWINGS[number as usize];
            let venue = match door {
                DoorState::Open => Drawing::Large.venue(drawing)?,
                DoorState::Shut => with_a_door_shut(drawing)?,
            };
            Ok(venue.limited(self.limit))
        })
    }
}

/// Returns a drawing in which the way between two random cells of its loop is shut.
fn with_a_door_shut(drawing: u32) -> Result<Venue, BoxError> {
    let maze = Drawing::Large.maze(drawing)?;
    let mut shut: Vec<Maze> = Vec::new();
    for cell in maze.grid().cells() {
        for (direction, _) in maze.neighbours(cell) {
            let mut with_door = maze.clone();
            with_door.set_wall(cell, direction, true);
            if with_door.reachable().count() == maze.reachable().count() {
                shut.push(with_door);
            }
        }
    }
    let any = stream(u64::from(drawing), DOOR_STREAM).random_range(0..shut.len().max(1) as u32);
    let maze = shut.into_iter().nth(any as usize);
    let maze = maze.ok_or_else(|| format!("drawing {drawing} has no loop"))?;
    let course = Course::for_body("Large", &MazeFile::from(maze), &pioneer::body())?;
    Ok(venue::large_like(course))
}

/// Returns the condition of a row, and the part that it leaves out.
fn row(job: &Job<'_>) -> Result<(Condition, Option<BetterPart>), BoxError> {
    if job.table == ROBUSTNESS {
        let (condition, _) = row_of(job, Condition::ALL, |(_, name)| *name == job.row)?;
        return Ok((condition, None));
    }
    let (_, part) = row_of(job, PARTS, |(name, _)| *name == job.row)?;
    Ok((Condition::AsJudged, part))
}
