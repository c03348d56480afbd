use tolman_control::unit_of;
use tolman_geom::{Heading, Vector};

use super::BetterConfig;
use crate::{Doing, RolledStep};

/// How far the robot came since it was last asked, along the compass's axes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reckoning {
    heading: Option<Heading>,
    moved: Vector,
    variance: Vector,
}

impl Reckoning {
    /// Adds a time step. Where the wheels tell nothing, what the action is made of stands for it.
    pub(super) fn add(&mut self, seen: &RolledStep, config: &BetterConfig) {
        let before = self.heading;
        self.heading = seen.step.heading.or(before);
        let (Some(before), Some(now)) = (before, self.heading) else {
            return;
        };
        let Some(odometry) = seen.odometry else {
            return self.assume(seen.step.doing, config);
        };
        let along = before.turned(0.5 * before.turn_to(now)).unit();
        self.moved += along * odometry.distance;
        let sd = config.odometry_sd * odometry.distance.abs();
        self.variance += Vector::new(sd * sd, sd * sd);
        if seen.bump == Some(true) {
            let sd = config.slide_sd;
            self.variance += Vector::new(sd * sd, sd * sd);
        }
    }

    /// Returns the way since the last time, and its standard deviations, and begins anew.
    pub(super) fn take(&mut self) -> (Vector, Vector) {
        let (moved, variance) = (self.moved, self.variance);
        (self.moved, self.variance) = (Vector::zeros(), Vector::zeros());
        (moved, variance.map(libm::sqrt))
    }

    /// Returns the way since the last time.
    pub(super) const fn since(&self) -> Vector {
        self.moved
    }

    fn assume(&mut self, doing: Doing, config: &BetterConfig) {
        if let Doing::Ended(action, outcome) = doing
            && outcome.moved()
        {
            let way = unit_of(action) * config.action_way;
            self.moved += way;
            let sd = way.map(|way| config.action_sd * way.abs());
            self.variance += sd.component_mul(&sd);
        }
    }
}
