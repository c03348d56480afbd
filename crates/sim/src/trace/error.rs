use std::io;

use thiserror::Error;

use crate::{DoorError, PlaceError, StepError, WorldFileError};

/// Reason why a run was not recorded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The trace could not be written.
    #[error("cannot write the trace: {0}")]
    Write(#[from] io::Error),
    /// A number cannot be written as JSON.
    #[error("cannot write the trace: {0}")]
    Json(#[from] serde_json::Error),
    /// The world cannot be written.
    #[error("cannot write the trace's world: {0}")]
    World(#[from] WorldFileError),
    /// There is nothing to record.
    #[error("there is no robot to record; give at least one")]
    NoRobots,
    /// A robot cannot stand where it was put.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// A step was not made.
    #[error(transparent)]
    Step(#[from] StepError),
    /// There is no such door.
    #[error(transparent)]
    Door(#[from] DoorError),
}

/// Reason why a trace was not read, or not replayed, to its end.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReplayError {
    /// The file could not be read.
    #[error("cannot read the trace: {0}")]
    Read(#[from] io::Error),
    /// There is no first line.
    #[error("the trace is empty; record one")]
    Empty,
    /// The trace has another format.
    #[error("line 1: the format is `{found}`; expected `tolman-trace`; give a recorded trace")]
    Format {
        /// The format found.
        found: String,
    },
    /// The trace has a version that this program does not know.
    #[error("line 1: the version is {found}; this program reads version 1; record the trace again")]
    Version {
        /// The version found.
        found: u32,
    },
    /// A line is incomplete or was changed by hand.
    #[error("line {line}, column {column}: {what}; record the trace again")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// Column of the line, from 1; 0 if there is none.
        column: usize,
        /// The fault, in words.
        what: String,
    },
    /// The world cannot be built again.
    #[error("line 1: {0}")]
    World(#[from] WorldFileError),
    /// A robot cannot be built or placed again, or a command is refused.
    #[error("line {line}: {source}")]
    Refused {
        /// Number of the line, from 1.
        line: usize,
        /// The underlying error.
        source: Box<dyn core::error::Error + Send + Sync>,
    },
    /// A robot had disturbances beyond its configuration, and the robot built for the replay has
    /// others.
    #[error(
        "line 1: robot {robot} ran with disturbances {recorded:?}, the robot built for the replay has {built:?}; \
         a trace holds no code, so build the same robot and give it to `replay_with`"
    )]
    Disturbances {
        /// Number of the robot.
        robot: u32,
        /// Disturbances of the recorded robot.
        recorded: Vec<String>,
        /// Disturbances of the robot that was built.
        built: Vec<String>,
    },
    /// The lines of a tick are not one per robot, in order.
    #[error(
        "line {line}: expected robot {robot} at tick {tick}; lines are missing or out of order; record the trace again"
    )]
    Order {
        /// Number of the line, from 1.
        line: usize,
        /// The robot expected.
        robot: usize,
        /// The tick expected.
        tick: u64,
    },
    /// The simulation differs from the recording.
    #[error(
        "line {line}: at tick {tick} robot {robot} differs:\n  recorded {recorded}\n  replayed {replayed}"
    )]
    Differs {
        /// Number of the line, from 1.
        line: usize,
        /// The first tick that differs.
        tick: u64,
        /// The first robot that differs in that tick.
        robot: u32,
        /// The line as it was recorded.
        recorded: String,
        /// Line that the simulation gives now.
        replayed: String,
    },
}

impl ReplayError {
    /// Returns the error that JSON reports in a line.
    pub(super) fn of_line(line: usize, error: &serde_json::Error) -> Self {
        // To JSON every line is its line 1.
        let told = error.to_string();
        let what = told.split(" at line ").next().unwrap_or_default();
        Self::Line {
            line,
            column: error.column(),
            what: what.to_owned(),
        }
    }
}
