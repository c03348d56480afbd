use core::f64::consts::PI;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::wander::{TurnEnd, UntilNear, UntilNearConfig};
use tolman_geom::Pose;
use tolman_maps::place_map::PlaceRecord;
use tolman_robot::{Odometry, Reckoned, Robot, Rolls, TakesSnapshots, TurnTranslate};

use super::SnapshotRobot;
use crate::stream;

/// Parameters of a [`Wanderer`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct WandererConfig {
    /// Parameters of driving and turning.
    pub drive: UntilNearConfig,
    /// Minimum of the share of the limit ahead at which a leg ends, 0 to 1. The share of each leg
    /// is drawn between this value and 1; at 1, the paper's value, it is always the limit.
    pub nearest: f64,
    /// Minimum length of a leg, m; a shorter one is followed by another before a record is taken.
    /// Ours: 0.3.
    pub least_way: f64,
    /// Number of legs that the robot tries before it takes a record wherever it is, at least 1.
    /// Ours: 12.
    pub most_tries: u32,
    /// Factor on all thresholds each time that no direction is free, 0 to 1. Ours: 0.7.
    pub give_way: f64,
    /// Maximum number of time steps to stand still for a snapshot, at least 1. Ours: 10.
    pub patience: u32,
}

impl WandererConfig {
    /// Returns the paper's parameters for gathering data (section 3.2) with the Pioneer 2-DX.
    /// Values that the paper leaves open are ours.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            drive: UntilNearConfig::paper(),
            nearest: 1.0,
            least_way: 0.3,
            most_tries: 12,
            give_way: 0.7,
            patience: 10,
        }
    }

    /// Returns the same configuration, except that the robot approaches things to a random distance
    /// for every record: 0.22 to 1.1 m. So it reaches the edge of the floor, along which the
    /// paper's limits only let it drive. Ours.
    #[must_use]
    pub const fn near_and_far() -> Self {
        Self {
            nearest: 0.2,
            ..Self::paper()
        }
    }
}

/// Reason why a place has no record.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum WandererError<E> {
    /// No snapshot came while the robot stood still.
    #[error(
        "the robot stood still for {steps} time steps and took no snapshot; switch its camera and range sensors on, or raise `patience`"
    )]
    NoSnapshot {
        /// Number of time steps for which the robot stood.
        steps: u32,
    },
    /// The robot failed.
    #[error(transparent)]
    Robot(#[from] E),
}

/// Gathers records: a robot that drives straight on until something is near, takes a record there,
/// and turns by a random angle (section 3.2).
///
/// It gets out of corners: it turns until the way is clear. If no direction is clear, it lets
/// things come nearer. It backs off if its body is wedged.
#[derive(Clone, Debug)]
pub struct Wanderer {
    config: WandererConfig,
    driver: UntilNear,
    rng: ChaCha8Rng,
    odometry: Pose,
}

/// Number of time steps that a wedged robot backs off.
const BACK_OFF: u32 = 4;

impl Wanderer {
    /// Returns a wanderer whose robot has just been put down. `seed` seeds all its turns.
    #[must_use]
    pub fn new(config: WandererConfig, seed: u64) -> Self {
        Self {
            driver: UntilNear::new(config.drive),
            rng: stream(seed, 0),
            odometry: Pose::IDENTITY,
            config,
        }
    }

    /// Returns the robot's pose by odometry, relative to the pose where it was put down.
    #[must_use]
    pub const fn odometry(&self) -> Pose {
        self.odometry
    }

    /// Drives one leg, or several short ones, and returns the record of the place at its end. It
    /// takes at most [`most_tries`](WandererConfig::most_tries) legs and turns, each with a bound
    /// on its time steps.
    ///
    /// # Errors
    /// [`WandererError`] if the robot fails or takes no snapshot.
    pub fn leg<R: SnapshotRobot>(
        &mut self,
        robot: &mut R,
    ) -> Result<PlaceRecord, WandererError<R::Error>> {
        let start = self.odometry.position;
        let nearest = self.config.nearest;
        let share = nearest + (1.0 - nearest) * self.rng.random_range(0.0..1.0);
        self.driver.limit_ahead(share);
        let mut nearness = 1.0;
        for _ in 0..self.config.most_tries {
            self.driver.give_way(nearness);
            if self.go(robot)? != TurnEnd::Clear {
                nearness *= self.config.give_way;
            }
            if (self.odometry.position - start).norm() >= self.config.least_way {
                break;
            }
        }
        self.driver.give_way(1.0);
        self.record(robot)
    }

    /// Turns to a random new heading and drives there if the way is clear.
    fn go<R: SnapshotRobot>(&mut self, robot: &mut R) -> Result<TurnEnd, R::Error> {
        let angle = self.rng.random_range(-PI..PI);
        let mut robot = Reckoned::new(robot, adding_to(&mut self.odometry));
        let end = self.driver.turn(&mut robot, angle)?;
        match end {
            TurnEnd::Clear => {
                self.driver.drive(&mut robot)?;
            }
            TurnEnd::Wedged => self.driver.back_off(&mut robot, BACK_OFF)?,
            TurnEnd::Enclosed => {}
        }
        Ok(end)
    }

    /// Returns a robot that adds the odometry of every step to the wanderer's pose.
    pub(super) fn reckoned<'a, R>(&'a mut self, robot: R) -> Reckoned<R, impl FnMut(Odometry) + 'a>
    where
        R: Robot<Sensing: Rolls> + 'a,
    {
        Reckoned::new(robot, adding_to(&mut self.odometry))
    }

    /// Stands still until a snapshot comes, and returns the record of this place.
    ///
    /// # Errors
    /// [`WandererError`] if the robot fails or takes no snapshot.
    pub fn record<R>(&mut self, robot: &mut R) -> Result<PlaceRecord, WandererError<R::Error>>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls,
    {
        for _ in 0..self.config.patience {
            Reckoned::new(&mut *robot, adding_to(&mut self.odometry)).stop()?;
            if let Some(snapshot) = robot.sensing().snapshot() {
                let odometry = self.odometry;
                return Ok(PlaceRecord { odometry, snapshot });
            }
        }
        let steps = self.config.patience;
        Err(WandererError::NoSnapshot { steps })
    }
}

/// Returns dead reckoning: a function that adds a step of odometry to the pose.
fn adding_to(pose: &mut Pose) -> impl FnMut(Odometry) {
    move |rolled| *pose = rolled.applied_to(*pose)
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use tolman_geom::Point;
    use tolman_robot::Odometry;
    use tolman_robot::pioneer_2dx::{Pioneer2dxSensing, SONARS};

    use super::*;

    /// A robot on a plain with one wall in the east, which it hears ahead. Its sensors give
    /// readings only `late` steps after it stops.
    struct Plain {
        pose: Pose,
        late: u32,
        stood: u32,
        sensing: Pioneer2dxSensing,
    }

    impl Plain {
        fn new(late: u32) -> Self {
            let mut plain = Self {
                pose: Pose::IDENTITY,
                late,
                stood: 0,
                sensing: Pioneer2dxSensing::SILENT,
            };
            plain.sense(Odometry::default());
            plain
        }

        fn sense(&mut self, rolled: Odometry) {
            let cosine = libm::cos(self.pose.heading.radians());
            let ahead = (10.0 - self.pose.position.x) / cosine;
            let range = if cosine > 0.1 { ahead.min(5.0) } else { 5.0 };
            let black = tolman_robot::Picture::black(2, 2, tolman_robot::pioneer_2dx::CAMERA);
            self.sensing = Pioneer2dxSensing {
                sonars: Some([range; SONARS]),
                picture: (self.stood > self.late).then_some(black),
                odometry: Some(rolled),
                ..Pioneer2dxSensing::SILENT
            };
        }
    }

    impl Robot for Plain {
        type Command = TurnTranslate;
        type Sensing = Pioneer2dxSensing;
        type Error = Infallible;

        fn sensing(&self) -> &Pioneer2dxSensing {
            &self.sensing
        }

        fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
            let rolled = Odometry {
                distance: 0.04 * command.translate,
                turn: 0.2 * command.turn,
            };
            self.stood = if *command == TurnTranslate::STOP {
                self.stood + 1
            } else {
                0
            };
            self.pose = rolled.applied_to(self.pose);
            self.sense(rolled);
            Ok(())
        }
    }

    #[test]
    fn records_are_where_the_wheels_have_the_robot() {
        let mut robot = Plain::new(2);
        let mut wanderer = Wanderer::new(WandererConfig::paper(), 1);
        let mut poses = Vec::new();
        for _ in 0..20 {
            let record = wanderer.leg(&mut robot).unwrap();
            let apart = record.odometry.position - robot.pose.position;
            assert!(apart.norm() < 1e-9);
            assert_eq!(record.snapshot.soundings.len(), SONARS);
            assert!(record.snapshot.picture.is_some());
            assert!(robot.pose.position.x < 9.0, "{:?}", robot.pose);
            poses.push(record.odometry);
        }
        let far = |pair: &[Pose]| (pair[0].position - pair[1].position).norm() >= 0.3;
        assert!(poses.windows(2).all(far));
        assert!(poses.iter().any(|pose| pose.position != Point::origin()));
    }

    #[test]
    fn the_same_seed_wanders_the_same_way_and_another_one_does_not() {
        let end = |seed| {
            let mut robot = Plain::new(0);
            let mut wanderer = Wanderer::new(WandererConfig::paper(), seed);
            wanderer.leg(&mut robot).unwrap();
            wanderer.odometry()
        };
        assert_eq!(end(1), end(1));
        assert_ne!(end(1), end(2));
    }

    #[test]
    fn a_robot_without_a_picture_is_told_of() {
        let mut robot = Plain::new(1000);
        let mut wanderer = Wanderer::new(WandererConfig::paper(), 1);
        let error = wanderer.record(&mut robot).unwrap_err();
        assert_eq!(error, WandererError::NoSnapshot { steps: 10 });
    }
}
