use thiserror::Error;
use tolman_robot::Body;

use crate::{Chance, Contact, Surroundings};

/// Motion of a robot in one time step: a circular arc with a path of length `distance`, m, and a
/// turn of `turn`, rad, counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Motion {
    /// Path length, m; negative is backward.
    pub distance: f64,
    /// Turn, rad; positive is counter-clockwise.
    pub turn: f64,
}

impl tolman_robot::Standstill for Motion {
    const STOP: Self = Self {
        distance: 0.0,
        turn: 0.0,
    };
}

/// A kind of robot: its body, its motors, its sensors.
///
/// The simulation calls [`motion`](Self::motion) and then [`sense`](Self::sense) once a step, each
/// with the [`Chance`] of this robot and tick.
pub trait Model {
    /// Command for one time step.
    type Command: Clone + core::fmt::Debug + tolman_robot::Standstill;
    /// Readings after a time step.
    type Sensing: core::fmt::Debug;

    /// Returns the robot's outline.
    fn body(&self) -> &Body;

    /// Returns the rule for contacts: how the body moves on when it meets something.
    fn contact(&self) -> Contact;

    /// Returns the length of one time step, µs.
    fn step_us(&self) -> u64;

    /// Checks that a command can be carried out at all.
    ///
    /// # Errors
    /// The part of the command that is not a number.
    fn check(&self, command: &Self::Command) -> Result<(), CommandError>;

    /// Returns the motion that the motors make of a command. Called only with a command that passed
    /// [`check`](Self::check).
    fn motion(&mut self, command: &Self::Command, chance: &Chance) -> Motion;

    /// Returns the readings before anything was sensed: the buffers that [`sense`](Self::sense)
    /// fills.
    fn silent(&self) -> Self::Sensing;

    /// Senses again.
    fn sense(
        &mut self,
        surroundings: &Surroundings<'_>,
        chance: &Chance,
        sensing: &mut Self::Sensing,
    );
}

/// A command that cannot be carried out.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("the command's {part} is {value}; give a finite number")]
pub struct CommandError {
    /// Part of the command.
    pub part: &'static str,
    /// Value that was given.
    pub value: f64,
}

impl CommandError {
    /// Checks that one part of a command is a finite number.
    ///
    /// # Errors
    /// If it is not.
    pub fn check(part: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() {
            Ok(())
        } else {
            Err(Self { part, value })
        }
    }
}
