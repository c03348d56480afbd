use tolman_control::{Outcome, unit_of};
use tolman_geom::{Heading, Vector};
use tolman_maze::Direction;

use super::BetterConfig;
use crate::{Doing, RolledStep};

/// Displacement of the robot since it was last taken, along the compass's axes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reckoning {
    heading: Option<Heading>,
    /// Whether the compass gave a heading at the end of the step before.
    is_fresh: bool,
    moved: Vector,
    variance: Vector,
    /// Displacement of the action in progress, by odometry.
    rolled: Vector,
    /// Number of the action's time steps with odometry that leads on.
    heard: u32,
    /// Number of the action's time steps without odometry.
    unheard: u32,
}

/// Number of time steps in which a whole action leads on.
const STEPS_OF_ACTION: u32 = 2;
/// Minimum distance of a step that leads on, as a share of an action's.
const LEADS_ON: f64 = 0.1;

/// Standard deviation of an action's sideways displacement without odometry, as a share of its
/// distance.
const ASIDE: f64 = 0.05;

impl Reckoning {
    /// Adds a time step. Without odometry, the action's expected motion counts.
    pub(super) fn add(&mut self, seen: &RolledStep, config: &BetterConfig) {
        let along = self.along(seen.step.heading);
        if let (Some(along), Some(odometry)) = (along, seen.odometry) {
            self.rolled += along.unit() * odometry.distance;
            self.heard += u32::from(odometry.distance.abs() > LEADS_ON * config.action_way);
            let sd = config.odometry_sd * odometry.distance.abs();
            self.variance += Vector::repeat(sd * sd);
        } else {
            self.unheard += u32::from(seen.step.doing != Doing::PutDown);
        }
        if seen.bump == Some(true) {
            // The wheels may have spun all the way, or a wall pushed the body aside.
            let sd = config.action_way / f64::from(STEPS_OF_ACTION);
            self.variance += Vector::repeat(sd * sd);
        }
        if let Doing::Ended(action, outcome) = seen.step.doing {
            self.end(action, outcome, config);
        }
    }

    /// Returns the mean heading of a time step at whose end the compass gives `now`. `None` if the
    /// compass gave no heading before the step.
    fn along(&mut self, now: Option<Heading>) -> Option<Heading> {
        let (before, was_fresh) = (self.heading, self.is_fresh);
        (self.heading, self.is_fresh) = (now.or(before), now.is_some());
        match (before?, now) {
            // It turned in part before and in part after the middle of the step.
            (before, Some(now)) if was_fresh => Some(before.turned(0.5 * before.turn_to(now))),
            // Who knows not how far it had turned before takes it that it had turned already.
            (before, now) => Some(now.unwrap_or(before)),
        }
    }

    /// Returns the displacement since the last call and its standard deviations, and starts again.
    pub(super) fn take(&mut self) -> (Vector, Vector) {
        let (moved, variance) = (self.since(), self.variance);
        (self.moved, self.rolled, self.variance) =
            (Vector::zeros(), Vector::zeros(), Vector::zeros());
        (moved, variance.map(libm::sqrt))
    }

    /// Returns the displacement since the last call of [`take`](Self::take).
    pub(super) fn since(&self) -> Vector {
        self.moved + self.rolled
    }

    /// Ends an action. Steps without odometry count with the usual length of such steps.
    fn end(&mut self, action: Direction, outcome: Outcome, config: &BetterConfig) {
        let steps = match outcome {
            Outcome::Completed => STEPS_OF_ACTION,
            Outcome::CutShort => 1,
            Outcome::Failed | Outcome::TimedOut => 0,
        };
        let unheard = f64::from(steps.saturating_sub(self.heard).min(self.unheard));
        if unheard > 0.0 {
            let along = unit_of(action);
            let rest = unheard * config.action_way / f64::from(STEPS_OF_ACTION);
            self.moved += along * rest;
            let sd = along.map(|along| {
                config.action_sd * rest * along.abs() + ASIDE * rest * (1.0 - along.abs())
            });
            self.variance += sd.component_mul(&sd);
        }
        self.moved += self.rolled;
        (self.rolled, self.heard, self.unheard) = (Vector::zeros(), 0, 0);
    }
}

#[cfg(test)]
mod tests {
    use tolman_robot::Odometry;

    use super::*;
    use crate::TimeStep;

    /// Returns the displacement to the east, m, and its standard deviation, for these distances per
    /// step by odometry.
    fn reckoned(told: &[Option<f64>], outcome: Outcome, bump: bool) -> (Vector, Vector) {
        let step = |doing, distance: Option<f64>| RolledStep {
            step: TimeStep {
                scan: None,
                heading: Some(Heading::EAST),
                landmark: None,
                doing,
            },
            odometry: distance.map(|distance| Odometry {
                distance,
                turn: 0.0,
            }),
            bump: Some(bump),
        };
        let config = BetterConfig::pioneer();
        let mut reckoning = Reckoning::default();
        reckoning.add(&step(Doing::PutDown, None), &config);
        for (index, distance) in told.iter().enumerate() {
            let doing = match index + 1 == told.len() {
                true => Doing::Ended(Direction::East, outcome),
                false => Doing::UnderWay(Direction::East),
            };
            reckoning.add(&step(doing, *distance), &config);
        }
        reckoning.take()
    }

    #[test]
    fn what_the_wheels_did_not_tell_is_what_the_action_lacks() {
        let way = BetterConfig::pioneer().action_way;
        let half = Some(0.5 * way);
        let (_, sure) = reckoned(&[half, half], Outcome::Completed, false);
        for told in [[half, half], [half, None], [None, half], [None, None]] {
            let (moved, sd) = reckoned(&told, Outcome::Completed, false);
            assert!((moved - Vector::new(way, 0.0)).norm() < 1e-9, "{told:?}");
            let has_gap = told.contains(&None);
            assert_eq!(sd.x > sure.x, has_gap, "{told:?}");
        }
        let (moved, _) = reckoned(&[None], Outcome::CutShort, false);
        assert!((moved.x - 0.5 * way).abs() < 1e-9, "{moved}");
        let (moved, _) = reckoned(&[None], Outcome::Failed, false);
        assert_eq!(moved, Vector::zeros());
        // Against a wall it may not have moved at all.
        let (moved, sd) = reckoned(&[half], Outcome::Completed, true);
        assert!(sd.x >= moved.x, "{moved} ± {sd}");
    }
}
