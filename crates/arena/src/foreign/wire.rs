//! The lines between a brain and its body.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use core::fmt;
use std::io::{self, BufRead, Read, Write};

use serde::Deserialize;
use serde_json::Value;
use thiserror::Error;
use tolman_geom::Heading;
use tolman_robot::{Goal, Landmark, LaserSensing, Odometry, Ring, Scan, Task};

/// Maximum length of a line from a body, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// Maximum length of a line quoted in an error, characters.
const QUOTED: usize = 80;

/// The streams to and from a body, in lines of JSON.
pub(super) struct Wire {
    from: Box<dyn BufRead>,
    to: Box<dyn Write>,
    /// Beams of the body's laser.
    ring: Ring,
    /// Number of lines read.
    line: u64,
    /// Time of the last reading, µs.
    time_us: u64,
}

/// Reason why a brain cannot go on with its body. The robot was told to stand still.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WireError {
    /// The streams fail.
    #[error("the body cannot be read or written after its line {line}")]
    Io {
        /// Number of the last line.
        line: u64,
        /// The system's reason.
        source: io::Error,
    },
    /// The body has ended.
    #[error("the body's lines end after line {line}, and it owes a reading")]
    Ended {
        /// Number of the last line.
        line: u64,
    },
    /// A line is no message.
    #[error("line {line} of the body is no message: `{quoted}`")]
    Message {
        /// Number of the line, from 1.
        line: u64,
        /// The line, or its beginning.
        quoted: String,
        /// Error of the JSON reader.
        source: serde_json::Error,
    },
    /// A line is too long, or no text.
    #[error("line {line} of the body is longer than {MOST_BYTES} bytes or no UTF-8")]
    Text {
        /// Number of the line, from 1.
        line: u64,
    },
    /// The laser has another number of beams than told.
    #[error(
        "line {line} of the body has {given} ranges, and its measures say {beams}: correct `laser.beams`"
    )]
    Beams {
        /// Number of the line, from 1.
        line: u64,
        /// Number of ranges.
        given: usize,
        /// Number of beams by the measures.
        beams: u32,
    },
    /// A range is below 0.
    #[error(
        "line {line} of the body: range {beam} is {range} m; give 0 for a beam that met nothing"
    )]
    Range {
        /// Number of the line, from 1.
        line: u64,
        /// Number of the beam, from 0.
        beam: usize,
        /// Its range, m.
        range: f64,
    },
    /// Time goes back.
    #[error(
        "line {line} of the body is from {given} µs, and the one before from {before} µs: time goes on"
    )]
    Time {
        /// Number of the line, from 1.
        line: u64,
        /// Its time, µs.
        given: u64,
        /// Time of the reading before, µs.
        before: u64,
    },
    /// A message comes at the wrong time.
    #[error("line {line} of the body: {why}")]
    OutOfTurn {
        /// Number of the line, from 1.
        line: u64,
        /// What is wrong, and what to do.
        why: &'static str,
    },
}

/// A line from a body.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Message {
    #[serde(default)]
    pub(super) sensing: Option<Reading>,
    #[serde(default)]
    pub(super) landmark: Option<Landmark>,
    #[serde(default)]
    pub(super) ask: Vec<Question>,
    #[serde(default)]
    pub(super) task: Option<NamedTask>,
    #[serde(default)]
    pub(super) put_down: bool,
    #[serde(default)]
    pub(super) break_off: bool,
}

/// Readings after a motion.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reading {
    time_us: u64,
    #[serde(default)]
    ranges: Option<Vec<f64>>,
    #[serde(default)]
    compass: Option<f64>,
    #[serde(default)]
    odometry: Option<Odometry>,
    #[serde(default)]
    bump: Option<bool>,
}

/// A question of a body, answered when an action has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Question {
    Standing,
    Belief,
    Map,
    Visits,
    Verdict,
}

/// A task by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NamedTask {
    /// Learn the world.
    Explore,
    /// Go to the landmark of the goal.
    ReachGoal,
    /// Find the robot's place on the map.
    Localize,
}

impl NamedTask {
    /// All tasks.
    pub const ALL: [Self; 3] = [Self::Explore, Self::ReachGoal, Self::Localize];

    /// Returns the name, as in messages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Explore => "explore",
            Self::ReachGoal => "reach-goal",
            Self::Localize => "localize",
        }
    }

    /// Returns the task.
    #[must_use]
    pub const fn task(self) -> Task {
        match self {
            Self::Explore => Task::Explore,
            Self::ReachGoal => Task::Reach(Goal::Landmark(Landmark::Goal)),
            Self::Localize => Task::Localize,
        }
    }
}

impl fmt::Debug for Wire {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Wire")
            .field("line", &self.line)
            .finish_non_exhaustive()
    }
}

impl Wire {
    pub(super) fn new(from: Box<dyn BufRead>, to: Box<dyn Write>, ring: Ring) -> Self {
        Self {
            from,
            to,
            ring,
            line: 0,
            time_us: 0,
        }
    }

    /// Writes one line.
    pub(super) fn say(&mut self, message: &Value) -> Result<(), WireError> {
        let line = self.line;
        let said = writeln!(self.to, "{message}").and_then(|()| self.to.flush());
        said.map_err(|source| WireError::Io { line, source })
    }

    /// Reads one message; `None` at the end of the stream.
    pub(super) fn hear(&mut self) -> Result<Option<Message>, WireError> {
        let line = self.line;
        let mut bytes = Vec::new();
        let read = self
            .from
            .by_ref()
            .take(MOST_BYTES)
            .read_until(b'\n', &mut bytes);
        read.map_err(|source| WireError::Io { line, source })?;
        if bytes.is_empty() {
            return Ok(None);
        }
        self.line += 1;
        let line = self.line;
        let is_whole = bytes.last() == Some(&b'\n') || (bytes.len() as u64) < MOST_BYTES;
        let text = core::str::from_utf8(&bytes).ok().filter(|_| is_whole);
        let text = text.ok_or(WireError::Text { line })?;
        let message: Message = serde_json::from_str(text).map_err(|source| WireError::Message {
            line,
            quoted: text.trim_end().chars().take(QUOTED).collect(),
            source,
        })?;
        if let Some(reading) = &message.sensing {
            self.check(reading)?;
        }
        Ok(Some(message))
    }

    /// Returns the error of a body that ended while it owes a reading.
    pub(super) const fn ended(&self) -> WireError {
        WireError::Ended { line: self.line }
    }

    /// Returns the error of a message at the wrong time.
    pub(super) const fn out_of_turn(&self, why: &'static str) -> WireError {
        WireError::OutOfTurn {
            line: self.line,
            why,
        }
    }

    /// Returns what a body sensed, as its laser has it.
    pub(super) fn sensed(&self, reading: Reading) -> LaserSensing {
        let ring = self.ring;
        LaserSensing {
            time_us: reading.time_us,
            scan: reading.ranges.map(|ranges| Scan { ring, ranges }),
            compass: reading.compass.map(Heading::from_radians),
            odometry: reading.odometry,
            bump: reading.bump,
        }
    }

    fn check(&mut self, reading: &Reading) -> Result<(), WireError> {
        let (line, beams) = (self.line, self.ring.beams);
        if let Some(ranges) = &reading.ranges {
            if ranges.len() != beams as usize {
                let given = ranges.len();
                return Err(WireError::Beams { line, given, beams });
            }
            let mut numbered = ranges.iter().enumerate();
            if let Some((beam, range)) = numbered.find(|(_, range)| **range < 0.0) {
                let range = *range;
                return Err(WireError::Range { line, beam, range });
            }
        }
        let (given, before) = (reading.time_us, self.time_us);
        if given < before {
            return Err(WireError::Time {
                line,
                given,
                before,
            });
        }
        self.time_us = given;
        Ok(())
    }
}
