use std::sync::OnceLock;

use tolman_systems::cpm::CommonPatterns;

use crate::BoxError;
use crate::course::Course;
use crate::cpm::{self, epuck_course};
use crate::pioneer::CORRIDOR_WIDTH;

/// Knowledge that systems learn once, before they are sent out: CPM's common patterns (section
/// 4.1).
#[derive(Debug, Default)]
pub struct Schooling {
    epuck: OnceLock<CommonPatterns>,
    pioneer: OnceLock<CommonPatterns>,
}

/// Maze in which common patterns are learned.
const LEARNING_MAZE: &str = include_str!("../../mazes/cpm-learning.maze");

/// Seed for the knowledge that is learned before a robot is sent out.
const SEED: u64 = 1;

impl Schooling {
    /// Returns the common patterns that the e-puck learns in the learning maze.
    ///
    /// # Errors
    /// If it learns none.
    pub fn of_epuck(&self) -> Result<CommonPatterns, BoxError> {
        taught(&self.epuck, || Self::of_epuck_by(SEED))
    }

    /// Returns the same, learned with another seed.
    ///
    /// # Errors
    /// If it learns none.
    pub fn of_epuck_by(seed: u64) -> Result<CommonPatterns, BoxError> {
        let course = epuck_course("learning", tolman_maze::read(LEARNING_MAZE)?)?;
        cpm::learn(&course, seed)
    }

    /// Returns the common patterns that the laser Pioneer learns in the learning maze, with
    /// corridors `width` m wide. Those of the usual width are learned once.
    ///
    /// # Errors
    /// If it learns none.
    pub fn of_pioneer(&self, width: f64) -> Result<CommonPatterns, BoxError> {
        match width.to_bits() == CORRIDOR_WIDTH.to_bits() {
            true => taught(&self.pioneer, || pioneers_lesson(width)),
            false => pioneers_lesson(width),
        }
    }
}

fn pioneers_lesson(width: f64) -> Result<CommonPatterns, BoxError> {
    let maze = tolman_maze::read(LEARNING_MAZE)?.maze;
    let course = Course::new("learning", maze, width)?;
    cpm::learn_on_pioneer(&course, SEED)
}

fn taught(
    known: &OnceLock<CommonPatterns>,
    learn: impl FnOnce() -> Result<CommonPatterns, BoxError>,
) -> Result<CommonPatterns, BoxError> {
    if let Some(known) = known.get() {
        return Ok(known.clone());
    }
    let learned = learn()?;
    Ok(known.get_or_init(|| learned).clone())
}
