//! The motion from cell to cell.

use tolman_geom::{Heading, Point, Pose};
use tolman_maps::wall_map::CellRay;
use tolman_robot::{Compass, Ranges, Robot, Rolls, Scan, TurnTranslate};

use super::whereabouts::next_pose;
use super::{MazeMouseConfig, sight};
use crate::lifts::{CONTRADICTING, contradiction};

/// Maximum number of time steps of a way from cell to cell, or of a turn.
pub(super) const PATIENCE: u32 = 100;

/// Number of time steps in which it waits for ranges that dropped out.
const LOOKS: u32 = 10;
/// Distance within which a position is reached, as a share of the pitch.
const CLOSE: f64 = 0.06;
/// Angle within which a heading is reached, rad.
const AIMED: f64 = 0.05;
/// Angle past its target above which a robot turns before it drives, rad.
const ASIDE: f64 = 0.15;
/// Maximum distance of a time step, as a share of the pitch, so that the walls are seen meanwhile.
const STRIDE: f64 = 0.25;

/// A robot that a [`Pilot`] can drive.
pub(super) trait Body:
    Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>
{
}

impl<R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>> Body for R {}

/// Whether the robot reached its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arrival {
    Arrived,
    /// The robot has not reached its target after [`PATIENCE`] time steps.
    OutOfPatience,
    /// The robot was carried on its way.
    Carried,
}

/// Drives a robot on the grid, and keeps its believed pose.
#[derive(Clone, Debug)]
pub(super) struct Pilot {
    pose: Pose,
    config: MazeMouseConfig,
    /// Heading and ranges after the last time step; `None` without ranges.
    seen: Option<(Heading, Scan)>,
}

/// What a mouse sees from its cell.
pub(super) struct View {
    /// One ray for each side that it sees.
    pub(super) rays: Vec<CellRay>,
    /// Whether it was carried.
    pub(super) was_carried: bool,
}

impl Pilot {
    pub(super) const fn new(pose: Pose, config: MazeMouseConfig) -> Self {
        let seen = None;
        Self { pose, config, seen }
    }

    /// Returns the robot's believed pose.
    pub(super) const fn pose(&self) -> Pose {
        self.pose
    }

    /// Sets the believed position; the heading stays the same.
    pub(super) fn put_at(&mut self, position: Point) {
        self.pose.position = position;
        self.seen = None;
    }

    /// Stands still and returns the view from the cell with this `middle`; `None` if no ranges
    /// come.
    pub(super) fn look<R: Body>(
        &mut self,
        robot: &mut R,
        middle: Point,
    ) -> Result<Option<View>, R::Error> {
        let mut was_carried = false;
        for _ in 0..LOOKS {
            was_carried |= self.step(robot, TurnTranslate::STOP)?;
            if let Some(scan) = robot.sensing().scan() {
                let rays = sight::rays(scan, self.pose, middle, &self.config);
                return Ok(Some(View { rays, was_carried }));
            }
        }
        Ok(None)
    }

    /// Turns in place to `heading`.
    pub(super) fn turn_to<R: Body>(
        &mut self,
        robot: &mut R,
        heading: Heading,
    ) -> Result<Arrival, R::Error> {
        for _ in 0..PATIENCE {
            let off = self.pose().heading.turn_to(heading);
            if off.abs() < AIMED {
                return Ok(Arrival::Arrived);
            }
            if self.step(robot, self.towards(off, 0.0))? {
                return Ok(Arrival::Carried);
            }
        }
        Ok(Arrival::OutOfPatience)
    }

    /// Drives straight to `target`, at most one cell away.
    pub(super) fn drive_to<R: Body>(
        &mut self,
        robot: &mut R,
        target: Point,
    ) -> Result<Arrival, R::Error> {
        for _ in 0..PATIENCE {
            let away = target - self.pose().position;
            let way = away.norm();
            if way < CLOSE * self.config.pitch {
                return Ok(Arrival::Arrived);
            }
            let off = self.pose().heading.turn_to(Heading::of(away));
            let stride = if off.abs() < ASIDE {
                way.min(STRIDE * self.config.pitch)
            } else {
                0.0
            };
            if self.step(robot, self.towards(off, stride))? {
                return Ok(Arrival::Carried);
            }
        }
        Ok(Arrival::OutOfPatience)
    }

    /// Returns the command that turns by `turn` rad and drives `distance` m, as far as a time step
    /// allows.
    fn towards(&self, turn: f64, distance: f64) -> TurnTranslate {
        TurnTranslate {
            turn: (turn / self.config.turn_per_step).clamp(-1.0, 1.0),
            translate: (distance / self.config.translate_per_step).min(1.0),
        }
    }

    /// Makes a time step. Returns whether the robot was carried: it sees walls where it just saw
    /// none, or the other way round.
    fn step<R: Body>(&mut self, robot: &mut R, command: TurnTranslate) -> Result<bool, R::Error> {
        let from = self.pose.position;
        robot.step(&command)?;
        self.pose = next_pose(self.pose, robot.sensing(), &command, &self.config);
        let scan = robot.sensing().scan();
        let now = scan.map(|scan| (self.pose.heading, scan.clone()));
        let before = core::mem::replace(&mut self.seen, now);
        let moved = self.pose.position - from;
        let was_carried = before.zip(self.seen.as_ref()).map(|(before, now)| {
            contradiction((&now.1, now.0), (&before.1, before.0), moved) > CONTRADICTING
        });
        Ok(was_carried.unwrap_or(false))
    }
}
