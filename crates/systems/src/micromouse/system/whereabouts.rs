//! Tracks the pose of a mouse: dead reckoning, corrected by visible walls.

use tolman_geom::{Pose, Vector};
use tolman_maze::Direction;
use tolman_robot::{Compass, Odometry, Ranges, Rolls, Scan, TurnTranslate};

use super::MazeMouseConfig;
use super::sight::{self, TOLERANCE};

/// Returns the pose of a mouse after a time step from `pose` with `command`, by its wheels, its
/// compass and the walls.
///
/// Walls stand on the lines of the grid. A range that ends near a line gives the robot's distance
/// from it. The wheels' error therefore only has to stay below half a cell between two walls.
pub(super) fn next_pose(
    pose: Pose,
    sensing: &(impl Ranges + Compass + Rolls),
    command: &TurnTranslate,
    config: &MazeMouseConfig,
) -> Pose {
    let told = Odometry {
        distance: command.translate * config.translate_per_step,
        turn: command.turn * config.turn_per_step,
    };
    let mut pose = sensing.odometry().unwrap_or(told).applied_to(pose);
    if let Some(heading) = sensing.heading().filter(|heading| heading.is_finite()) {
        pose.heading = heading;
    }
    if let Some(scan) = sensing.scan() {
        pose.position += correction(scan, pose, config);
    }
    pose
}

/// Returns the displacement from `pose` to the position that the walls show: the mean over all
/// beams that meet one, on each axis.
fn correction(scan: &Scan, pose: Pose, config: &MazeMouseConfig) -> Vector {
    let pitch = config.pitch;
    let (mut sum, mut count) = (Vector::zeros(), Vector::zeros());
    for beam in sight::beams(scan, pose, pitch) {
        if !beam.met || !beam.is_inside(beam.along, pitch) {
            continue;
        }
        let to_line = beam.along + 0.5 * config.wall_thickness;
        let off = |line: f64| libm::round(line / pitch) * pitch - line;
        let position = pose.position;
        let (axis, off) = match beam.side {
            Direction::East => (Vector::x(), off(position.x + to_line)),
            Direction::West => (Vector::x(), off(position.x - to_line)),
            Direction::North => (Vector::y(), off(position.y + to_line)),
            Direction::South => (Vector::y(), off(position.y - to_line)),
        };
        if off.abs() < TOLERANCE * pitch {
            sum += axis * off;
            count += axis;
        }
    }
    Vector::new(sum.x / count.x.max(1.0), sum.y / count.y.max(1.0))
}
