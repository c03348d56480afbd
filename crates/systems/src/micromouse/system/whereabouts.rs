//! Where a mouse is: dead reckoning, set right by the walls it sees.

use tolman_geom::{Pose, Vector};
use tolman_maze::Direction;
use tolman_robot::{Compass, Odometry, Ranges, Rolls, Scan, TurnTranslate};

use super::MazeMouseConfig;
use super::sight::{self, TOLERANCE};

/// A pose kept by wheels, compass and walls.
///
/// Walls stand on the lines of the grid. A range that ends near a line tells how far the robot is
/// from it, so that the wheels need be right to less than half a cell between two walls.
#[derive(Clone, Copy, Debug)]
pub(super) struct Whereabouts(pub(super) Pose);

impl Whereabouts {
    /// Takes in a time step in which the robot was told `command`.
    pub(super) fn take_in(
        &mut self,
        sensing: &(impl Ranges + Compass + Rolls),
        command: &TurnTranslate,
        config: &MazeMouseConfig,
    ) {
        let told = Odometry {
            distance: command.translate * config.translate_per_step,
            turn: command.turn * config.turn_per_step,
        };
        self.0 = sensing.odometry().unwrap_or(told).applied_to(self.0);
        if let Some(heading) = sensing.heading().filter(|heading| heading.is_finite()) {
            self.0.heading = heading;
        }
        if let Some(scan) = sensing.scan() {
            self.0.position += self.correction(scan, config);
        }
    }

    /// From where it believes to be to where the walls say it is: the mean over all beams that meet
    /// one, on each axis.
    fn correction(&self, scan: &Scan, config: &MazeMouseConfig) -> Vector {
        let pitch = config.pitch;
        let (mut sum, mut count) = (Vector::zeros(), Vector::zeros());
        for beam in sight::beams(scan, self.0, pitch) {
            if !beam.met || !beam.is_inside(beam.along, pitch) {
                continue;
            }
            let to_line = beam.along + 0.5 * config.wall_thickness;
            let off = |line: f64| libm::round(line / pitch) * pitch - line;
            let position = self.0.position;
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
}
