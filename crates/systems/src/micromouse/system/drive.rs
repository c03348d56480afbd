//! The motion from cell to cell.

use tolman_geom::{Heading, Point};
use tolman_robot::{Compass, Ranges, Robot, Rolls, TurnTranslate};

use super::MazeMouseConfig;
use super::whereabouts::Whereabouts;

/// Time steps that a way from cell to cell, or a turn, may take.
pub(super) const PATIENCE: u32 = 100;

/// This near, as a share of the pitch, a place is reached.
const CLOSE: f64 = 0.06;
/// This near, rad, a heading is reached.
const AIMED: f64 = 0.05;
/// A robot that looks farther past its target than this turns before it drives, rad.
const ASIDE: f64 = 0.15;
/// The longest way of a time step, as a share of the pitch: the walls are to be seen meanwhile.
const STRIDE: f64 = 0.25;

/// Whether the robot came to where it was sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arrival {
    Arrived,
    /// It is not there after [`PATIENCE`] time steps.
    OutOfPatience,
}

/// One time step of a robot that stands still.
pub(super) fn look<R>(
    robot: &mut R,
    whereabouts: &mut Whereabouts,
    config: &MazeMouseConfig,
) -> Result<(), R::Error>
where
    R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
{
    step(robot, TurnTranslate::STOP, whereabouts, config)
}

/// Turns in place to `heading`.
pub(super) fn turn_to<R>(
    robot: &mut R,
    heading: Heading,
    whereabouts: &mut Whereabouts,
    config: &MazeMouseConfig,
) -> Result<Arrival, R::Error>
where
    R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
{
    for _ in 0..PATIENCE {
        let off = whereabouts.0.heading.turn_to(heading);
        if off.abs() < AIMED {
            return Ok(Arrival::Arrived);
        }
        step(robot, towards(off, 0.0, config), whereabouts, config)?;
    }
    Ok(Arrival::OutOfPatience)
}

/// Drives straight to `target`, a cell away or less.
pub(super) fn drive_to<R>(
    robot: &mut R,
    target: Point,
    whereabouts: &mut Whereabouts,
    config: &MazeMouseConfig,
) -> Result<Arrival, R::Error>
where
    R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
{
    for _ in 0..PATIENCE {
        let away = target - whereabouts.0.position;
        let way = away.norm();
        if way < CLOSE * config.pitch {
            return Ok(Arrival::Arrived);
        }
        let off = whereabouts.0.heading.turn_to(Heading::of(away));
        let stride = if off.abs() < ASIDE {
            way.min(STRIDE * config.pitch)
        } else {
            0.0
        };
        step(robot, towards(off, stride, config), whereabouts, config)?;
    }
    Ok(Arrival::OutOfPatience)
}

/// The command that turns by `turn` rad and drives `distance` m, as far as the drive can in a time step.
fn towards(turn: f64, distance: f64, config: &MazeMouseConfig) -> TurnTranslate {
    TurnTranslate {
        turn: (turn / config.turn_per_step).clamp(-1.0, 1.0),
        translate: (distance / config.translate_per_step).min(1.0),
    }
}

fn step<R>(
    robot: &mut R,
    command: TurnTranslate,
    whereabouts: &mut Whereabouts,
    config: &MazeMouseConfig,
) -> Result<(), R::Error>
where
    R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
{
    robot.step(&command)?;
    whereabouts.take_in(robot.sensing(), &command, config);
    Ok(())
}
