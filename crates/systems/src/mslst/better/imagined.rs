use core::convert::Infallible;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Pose, Vector};
use tolman_maps::scan_map::{Clearings, StandpointViews, Standpoints};
use tolman_robot::{LaserSensing, Ring, Robot, TurnTranslate};

use super::Motors;

/// An imagined robot on its own map. It senses the view of the nearest standpoint, and its motors
/// err like the real ones.
pub(super) struct Imagined<'a> {
    standpoints: &'a Standpoints,
    views: StandpointViews,
    clearings: &'a Clearings<'a>,
    motors: Motors,
    rng: ChaCha8Rng,
    pub(super) pose: Pose,
    pub(super) steps: u32,
    sensing: LaserSensing,
}

/// Length of a stride, m: the robot checks for a wall after each.
const STRIDE: f64 = 0.05;
/// Maximum sideways push by a wall in a stride, m.
const ASIDE: f64 = 0.05;

impl<'a> Imagined<'a> {
    pub(super) fn new(
        standpoints: &'a Standpoints,
        clearings: &'a Clearings<'a>,
        ring: Ring,
        motors: Motors,
        rng: ChaCha8Rng,
    ) -> Self {
        Self {
            standpoints,
            views: standpoints.views(),
            clearings,
            motors,
            rng,
            pose: Pose::IDENTITY,
            steps: 0,
            sensing: LaserSensing::silent(ring),
        }
    }

    /// Puts the imagined robot at `pose`.
    pub(super) fn put(&mut self, pose: Pose) {
        self.pose = pose;
        self.steps = 0;
        self.sense();
    }

    fn sense(&mut self) {
        self.sensing.compass = Some(self.pose.heading);
        let Some(number) = self.standpoints.at(self.pose.position) else {
            return;
        };
        if let Some(scan) = &mut self.sensing.scan {
            self.views.scan(number, self.pose.heading, scan);
        }
    }

    /// Returns a random number with this standard deviation, limited to 1.7 standard deviations.
    fn off(&mut self, sd: f64) -> f64 {
        let most = libm::sqrt(3.0) * sd;
        if most > 0.0 {
            self.rng.random_range(-most..=most)
        } else {
            0.0
        }
    }

    /// Goes straight ahead, or along an obstacle.
    fn go(&mut self, way: f64) {
        let ahead = self.pose.heading.unit() * way.signum();
        let left = Vector::new(-ahead.y, ahead.x) * ASIDE;
        let mut rest = way.abs();
        while rest > 0.0 {
            let to = self.pose.position + ahead * rest.min(STRIDE);
            let free = [to, to + left, to - left].into_iter();
            let Some(to) = free.into_iter().find(|to| self.clearings.stands(*to)) else {
                return;
            };
            self.pose.position = to;
            rest -= STRIDE;
        }
    }
}

impl Robot for Imagined<'_> {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = Infallible;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
        let turn = self.motors.turn_per_command * command.turn.clamp(-1.0, 1.0);
        let turn = turn * (1.0 + self.off(self.motors.turn_sd));
        self.pose.heading = self.pose.heading.turned(turn);
        let way = self.motors.way_per_command * command.translate.clamp(-1.0, 1.0);
        let missed = self.off(self.motors.way_sd);
        self.go(way * (1.0 + missed));
        self.steps += 1;
        self.sense();
        Ok(())
    }
}
