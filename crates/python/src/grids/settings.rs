//! What all robots of a batch have in common.

use alloc::sync::Arc;
use core::error::Error;

use pyo3::prelude::*;
use rand_chacha::ChaCha8Rng;
use tolman_arena::family::Family;
use tolman_maze::rand::SeedableRng;

use super::episode::{Episode, MOVES};
use super::floor::Floor;
use super::task::GridTask;
use crate::errors::{reasons, wrong};
use crate::maze::{PyMaze, family};

/// Maximum number of columns and of rows: what a robot senses has a byte for each side.
const LONGEST: i64 = 255;

#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) task: GridTask,
    pub(super) size: (u16, u16),
    /// Whether a robot senses how far it can look.
    pub(super) rays: bool,
    pub(super) landmarks: usize,
    pub(super) errands: usize,
    pub(super) max_steps: u32,
}

/// Origin of the mazes.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// The same maze in all episodes.
    Same(Arc<Floor>),
    /// Another maze of a family in each.
    Drawn(Family),
}

/// A maze, or the name of a family, as Python gives them.
#[derive(FromPyObject)]
pub(super) enum Given<'py> {
    Maze(PyRef<'py, PyMaze>),
    Family(String),
}

impl Settings {
    /// Returns the settings with these numbers, in Python's words.
    ///
    /// # Errors
    /// A `ValueError` that names what is too small or too large.
    pub(super) fn new(
        task: GridTask,
        rays: bool,
        [width, height, landmarks, errands, max_steps]: [i64; 5],
    ) -> PyResult<Self> {
        for (name, value, least, most) in [
            ("width", width, 1, LONGEST),
            ("height", height, 1, LONGEST),
            ("landmarks", landmarks, 2, i64::from(u16::MAX)),
            ("errands", errands, 1, i64::from(u16::MAX)),
            ("max_steps", max_steps, 1, i64::from(u32::MAX)),
        ] {
            if !(least..=most).contains(&value) {
                return Err(wrong(format!(
                    "{name} is {value} but has to be from {least} to {most}"
                )));
            }
        }
        Ok(Self {
            task,
            size: (width as u16, height as u16),
            rays,
            landmarks: landmarks as usize,
            errands: errands as usize,
            max_steps: max_steps as u32,
        })
    }

    /// Returns the number of actions: moves, and to locate the poses that can be told.
    pub(super) fn action_count(&self) -> u32 {
        let (width, height) = self.size;
        match self.task {
            GridTask::Errand | GridTask::Learn => MOVES,
            GridTask::Locate => MOVES + 4 * u32::from(width) * u32::from(height),
        }
    }

    /// Returns the origin of the mazes.
    ///
    /// # Errors
    /// A `ValueError` if no family has the name, or the maze has another size.
    pub(super) fn source(&self, given: Given<'_>) -> PyResult<Source> {
        match given {
            Given::Family(name) => Ok(Source::Drawn(family("maze", &name)?)),
            Given::Maze(maze) => {
                let maze = maze.maze();
                let (width, height) = self.size;
                let size = (maze.grid().width(), maze.grid().height());
                match size == self.size {
                    true => Ok(Source::Same(Arc::new(Floor::new(maze.clone())))),
                    false => Err(wrong(format!(
                        "maze has {} x {} cells, but this environment is of {width} x {height}: make another one",
                        size.0, size.1
                    ))),
                }
            }
        }
    }

    /// Returns the beginning of an episode. The same numbers give the same one.
    ///
    /// # Errors
    /// A `ValueError` if the family has no maze of this size, or no room for the landmarks.
    pub(super) fn episode(&self, source: &Source, seed: u64, number: u64) -> PyResult<Episode> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(number);
        let floor = match source {
            Source::Same(floor) => Arc::clone(floor),
            Source::Drawn(family) => {
                let (width, height) = self.size;
                let drawn = (family.draw)(self.size, &mut rng);
                let told = |error: &(dyn Error + 'static)| {
                    wrong(format!(
                        "width {width}, height {height}: {}",
                        reasons(error)
                    ))
                };
                Arc::new(Floor::new(drawn.map_err(|error| told(&*error))?))
            }
        };
        Episode::new(floor, self, &mut rng).map_err(wrong)
    }
}
