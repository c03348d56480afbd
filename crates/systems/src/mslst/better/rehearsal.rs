use core::ops::ControlFlow;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_control::{Drive, RingError, Stack, heading_of};
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::scan_map::Standpoints;
use tolman_maze::Direction;
use tolman_planners::Decisions;
use tolman_robot::Ring;

use super::imagined::Imagined;
use super::{BetterConfig, BetterPart};
use crate::stream;

/// Axes along which a robot faces: east–west, north–south.
const AXES: [Direction; 2] = [Direction::East, Direction::North];
/// Number of trials of each action from each standpoint and axis.
const TRIES: u32 = 4;
/// Maximum angle between a robot's heading and its axis, rad.
const ASKEW: f64 = 5.0 * core::f64::consts::PI / 180.0;
/// Number of time steps after which an action counts as leading nowhere.
const LONGEST_ACTION: u32 = 40;

/// Simulates every action, from every standpoint and along every axis, with the robot's own layers
/// on its own map. Returns costs in time steps, and the ends of each action. O(standpoints · tries
/// · steps · beams).
///
/// # Errors
/// If the layers cannot read the ring.
pub(super) fn rehearse(
    standpoints: &Standpoints,
    ring: Ring,
    config: &BetterConfig,
) -> Result<Decisions, RingError> {
    let stack = Stack::paper(ring, config.diameter, config.corridor_width)?;
    let mut drive = Drive::new(stack, stream(0, 1)).longest_action(LONGEST_ACTION);
    let motors = match config.has(BetterPart::Chances) {
        true => config.motors,
        false => config.motors.exact(),
    };
    let grid = standpoints.chart().ground().grid();
    let clearings = standpoints.chart().clearings(&grid);
    let mut robot = Imagined::new(standpoints, &clearings, ring, motors, stream(0, 2));
    let mut rng = stream(0, 3);
    let mut decisions = Decisions::between(Direction::ALL.len());
    for (number, position) in (0..).zip(standpoints.positions()) {
        for axis in AXES {
            for action in Direction::ALL {
                let mut ends = [state(number, axis_of(axis)); TRIES as usize];
                let mut steps = 0;
                for end in &mut ends {
                    robot.put(about(position, axis, &mut rng));
                    // It fails with no robot of metal.
                    let Ok(_) = drive.carry_out(&mut robot, action, |_| ControlFlow::Continue(()));
                    steps += robot.steps;
                    if let Some(to) = standpoints.at(robot.pose.position) {
                        *end = state(to, facing(robot.pose.heading));
                    }
                }
                let share = 1.0 / f64::from(TRIES);
                let ends = ends.into_iter().map(|end| (end as u32, share));
                decisions.add(f64::from(steps) * share, ends);
            }
        }
    }
    Ok(decisions)
}

/// Returns the number of the state at a standpoint with a heading along an axis.
pub(super) const fn state(standpoint: u32, axis: usize) -> usize {
    standpoint as usize * AXES.len() + axis
}

/// Returns the axis that a heading is nearest to.
pub(super) fn facing(heading: Heading) -> usize {
    let across = libm::fabs(libm::sin(heading.radians()));
    usize::from(across > core::f64::consts::FRAC_1_SQRT_2)
}

fn axis_of(direction: Direction) -> usize {
    facing(heading_of(direction))
}

/// Returns a pose near a standpoint, roughly along an axis.
fn about(standpoint: Point, axis: Direction, rng: &mut ChaCha8Rng) -> Pose {
    let mut off = |most: f64| rng.random_range(-most..=most);
    let half = 0.5 * Standpoints::SPACING;
    let offset = Vector::new(off(half), off(half));
    let heading = heading_of(axis).turned(off(ASKEW));
    Pose::new(standpoint + offset, heading)
}
