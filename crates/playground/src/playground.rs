use serde::Serialize;
use thiserror::Error;
use tolman_arena::BoxError;
use tolman_arena::contest::{Condition, Contest, ContestError, SteppedContest};
use tolman_arena::course::CourseError;
use tolman_arena::registry::{Registry, Schooling, SystemEntry};
use tolman_maze::{GenerateError, MazeError};
use tolman_replay::EncodeError;
use tolman_systems::planners::TooLarge;

use crate::{Session, Sketch};

/// Reason why the playground cannot fulfil a request.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlaygroundError {
    /// The text is not a maze that can be solved.
    #[error("no robot can be sent into this maze: {0}")]
    Maze(#[from] MazeError),
    /// The maze that is drawn cannot be solved.
    #[error("no robot can be sent into this maze: {0}")]
    Sketch(String),
    /// A family has no such maze.
    #[error("no maze of the family {name} can be drawn: {source}")]
    Family {
        /// Name of the family.
        name: String,
        /// Reason why the family has no such drawing.
        source: BoxError,
    },
    /// There is no such system.
    #[error("there is no system {name}; choose one of the list")]
    System {
        /// Name that was given.
        name: String,
    },
    /// System, robot and maze do not fit together, or the robot cannot stand at a position.
    #[error("{0}: {source}", source = root(.0))]
    Contest(#[from] ContestError),
    /// The cell has no way out.
    #[error("this cell is walled in: choose one with a way out")]
    WalledIn,
    /// The run cannot be shown.
    #[error(transparent)]
    Replay(#[from] EncodeError),
    /// There is no such task.
    #[error("lesson {lesson} has no task {task}; both count from 1")]
    Task {
        /// Number of the lesson.
        lesson: usize,
        /// Number of the task in the lesson.
        task: usize,
    },
    /// The answer to a task is not of the form that the page sends.
    #[error("the answer cannot be read: {0}")]
    Answer(#[from] serde_json::Error),
    /// A lesson's robot cannot run in the maze.
    #[error("no robot can be sent into this maze: {0}")]
    Course(#[from] CourseError),
    /// A lesson's robot cannot be made, or cannot go on.
    #[error("the robot cannot drive here: {0}")]
    Robot(#[source] BoxError),
    /// A lesson's maze cannot be drawn.
    #[error("the maze cannot be drawn: {0}")]
    Drawing(#[from] GenerateError),
    /// A lesson's maze is too large.
    #[error("the maze is too large: {0}")]
    TooLarge(#[from] TooLarge),
}

/// Returns the message of an error's innermost source.
fn root(error: &dyn core::error::Error) -> String {
    let mut error = error;
    while let Some(source) = error.source() {
        error = source;
    }
    error.to_string()
}

/// A system that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct SystemChoice {
    /// Name of the system, as in tables.
    pub name: &'static str,
    /// Task of the system, in one line.
    pub about: &'static str,
    /// Whether the system is as its paper has it.
    pub is_paper: bool,
}

/// Sends systems into mazes, and keeps their prior knowledge: CPM's common patterns, which take a
/// second to learn.
#[derive(Debug, Default)]
pub struct Playground {
    schooling: Schooling,
}

impl Playground {
    /// Returns the systems that can be chosen: all that learn a map, those that work best first.
    #[must_use]
    pub fn systems() -> Vec<SystemChoice> {
        let facts = Registry::current().learners().map(SystemEntry::facts);
        let choices = facts.map(|facts| SystemChoice {
            name: facts.title,
            about: facts.about,
            is_paper: facts.is_paper,
        });
        let mut systems: Vec<SystemChoice> = choices.collect();
        systems.sort_by_key(|choice| choice.is_paper);
        systems
    }

    /// Puts a system's own robot at the start of a maze. `seed` seeds all noise.
    ///
    /// # Errors
    /// [`PlaygroundError`] if there is no such system, or it cannot work in that maze.
    pub fn begin(
        &self,
        sketch: &Sketch,
        system: &str,
        seed: u64,
    ) -> Result<Session, PlaygroundError> {
        let contestant = Registry::current().system(system);
        let contestant = contestant.filter(|system| system.learns());
        let contestant = contestant.ok_or_else(|| PlaygroundError::System {
            name: system.to_owned(),
        })?;
        if let Some(fault) = sketch.fault() {
            return Err(PlaygroundError::Sketch(fault));
        }
        let contest = Contest {
            contestant,
            robot: None,
            maze: &sketch.maze,
            name: &sketch.name,
            condition: Condition::AsMade,
            starts: 0,
            seed,
            stopwatch: None,
        };
        let stepped = SteppedContest::new(&contest, &self.schooling)?;
        Ok(Session::new(contestant, &sketch.name, seed, stepped))
    }
}
