use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::{Heading, OutOfRange, POSITIVE, Pose, Twist};

use crate::{LaserSensing, Odometry, Ring, Robot, Scan, StepMeasures, TurnTranslate};

/// A base that takes velocities and reports when it has something to report.
pub trait VelocityBase {
    /// Reason why the base cannot be driven or heard.
    type Error;

    /// Sets the velocities, m/s ahead and rad/s counter-clockwise. They hold until the next call.
    ///
    /// # Errors
    /// If the base cannot be reached.
    fn drive(&mut self, velocity: Twist) -> Result<(), Self::Error>;

    /// Waits for the next report, at most `wait_us` µs; `None` if none comes.
    ///
    /// # Errors
    /// If the base cannot be reached.
    fn report(&mut self, wait_us: u64) -> Result<Option<BaseReport>, Self::Error>;
}

/// What a base sensed since its last report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BaseReport {
    /// Time when it was sensed, by the base's clock, µs.
    pub time_us: u64,
    /// Pose by dead reckoning, in any frame that stays the same; `None` if this report has none.
    pub pose: Option<Pose>,
    /// Ranges of all beams, m; `None` if this report has none.
    pub ranges: Option<Vec<f64>>,
    /// Time when the first of the ranges was taken, µs; `None` if that is the report's own time.
    pub taken_us: Option<u64>,
    /// Heading by the compass, 0 for east; `None` if this report has none.
    pub compass: Option<Heading>,
    /// Whether the body touched something; `None` if this report does not say.
    pub bump: Option<bool>,
}

/// Limits of a [`VelocityRover`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RoverConfig {
    /// Motion of the commands `turn: 1.0` and `translate: 1.0`.
    pub step: StepMeasures,
    /// Fastest motion: m/s and rad/s.
    pub fastest: Twist,
    /// Strongest braking: m/s² and rad/s².
    pub braking: Twist,
    /// Error of a motion that is let be, and motion of a robot at rest: m and rad.
    pub tolerance: Twist,
    /// Time from a command to the report of its effect, µs.
    pub latency_us: u64,
    /// Longest time without a report before the robot is stopped, µs.
    pub silence_us: u64,
}

impl RoverConfig {
    /// Returns the limits of a small robot like a TurtleBot3, whose steps are so long: 0.2 m/s,
    /// 1.5 rad/s, a latency of 0.1 s, and 0.5 s of silence.
    #[must_use]
    pub const fn small(step: StepMeasures) -> Self {
        Self {
            step,
            fastest: Twist {
                linear: 0.2,
                angular: 1.5,
            },
            braking: Twist {
                linear: 0.5,
                angular: 3.0,
            },
            tolerance: Twist {
                linear: 0.005,
                angular: 0.01,
            },
            latency_us: 100_000,
            silence_us: 500_000,
        }
    }

    fn check(&self) -> Result<(), OutOfRange> {
        for (field, value) in [
            ("step.turn", self.step.turn),
            ("step.distance", self.step.distance),
            ("fastest.linear", self.fastest.linear),
            ("fastest.angular", self.fastest.angular),
            ("braking.linear", self.braking.linear),
            ("braking.angular", self.braking.angular),
            ("tolerance.linear", self.tolerance.linear),
            ("tolerance.angular", self.tolerance.angular),
            ("silence_us", self.silence_us as f64),
        ] {
            OutOfRange::check(field, value, POSITIVE)?;
        }
        Ok(())
    }
}

/// Reason why a [`VelocityRover`] makes no step. The base was told to stand still.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RoverError<E> {
    /// The base cannot be reached.
    #[error("the base cannot be reached")]
    Base(#[source] E),
    /// The base is silent.
    #[error("the base has not reported for {silence_us} µs; it was told to stop")]
    Silent {
        /// Longest time allowed, µs.
        silence_us: u64,
    },
    /// Time goes back.
    #[error("a report is from {given} µs, and the one before from {before} µs: time goes on")]
    Time {
        /// Time of the report, µs.
        given: u64,
        /// Time of the report before, µs.
        before: u64,
    },
    /// A reading is not a number.
    #[error("the base's {sense} is not a finite number; leave out what it did not sense")]
    NotANumber {
        /// The sense.
        sense: &'static str,
    },
    /// The laser has another number of beams than its ring.
    #[error("the laser gave {given} ranges, and its ring has {beams}")]
    Beams {
        /// Number of ranges.
        given: usize,
        /// Number of beams.
        beams: u32,
    },
    /// The base does not stop.
    #[error("the base still moves {seconds:.0} s after it was told to stop")]
    Restless {
        /// Time since it was told to stop, s.
        seconds: f64,
    },
    /// The base stands still, and its laser gives nothing.
    #[error("the laser gave no scan for {seconds:.0} s while the base stood still")]
    NoScan {
        /// Time at rest, s.
        seconds: f64,
    },
}

/// A robot that turns and rolls as far as it is told, on a base that takes velocities.
///
/// Each step is a motion that is closed on the base's own dead reckoning. Then the robot stands
/// still until a whole scan was taken at rest. A motion that does not end has met something: it is
/// given up, and counts as a bump. The base is told to stop when it is silent, when a
/// report is invalid, and when the rover is dropped.
#[derive(Debug)]
pub struct VelocityRover<B: VelocityBase> {
    base: B,
    config: RoverConfig,
    ring: Ring,
    sensing: LaserSensing,
    /// State by the last reports.
    pose: Option<Pose>,
    time_us: u64,
    /// Motion since the step began, and its rate.
    rolled: Odometry,
    rate: Twist,
}

/// Longest duration of a motion, as a multiple of what its speeds suggest, and in addition, s.
const PATIENCE: [f64; 2] = [4.0, 3.0];

/// Longest time until a base that was told to stop has come to rest and given a scan, s.
const STOPPED: f64 = 10.0;

/// Slowest motion on the way to its end, as a share of the fastest.
const CREEP: f64 = 0.05;

impl<B: VelocityBase> VelocityRover<B> {
    /// Returns a rover on `base`, whose laser has these beams. It senses nothing before its first
    /// step.
    ///
    /// # Errors
    /// [`OutOfRange`] if a limit is not above 0.
    pub fn new(base: B, ring: Ring, config: RoverConfig) -> Result<Self, OutOfRange> {
        config.check()?;
        Ok(Self {
            base,
            config,
            ring,
            sensing: LaserSensing::silent(ring),
            pose: None,
            time_us: 0,
            rolled: Odometry::default(),
            rate: Twist::default(),
        })
    }

    /// Returns the base.
    pub const fn base(&self) -> &B {
        &self.base
    }

    /// Makes a motion and looks. The base may still move when it fails.
    fn make(&mut self, goal: Odometry) -> Result<LaserSensing, RoverError<B::Error>> {
        self.rolled = Odometry::default();
        let mut sensed = LaserSensing {
            scan: None,
            bump: None,
            ..self.sensing.clone()
        };
        let RoverConfig {
            fastest,
            latency_us,
            ..
        } = self.config;
        // Both motions end together.
        let shares = [goal.distance / fastest.linear, goal.turn / fastest.angular].map(f64::abs);
        let least = shares[0].max(shares[1]);
        let [each, more] = PATIENCE;
        let patience = each * least + more;
        let (mut begun, mut stopped) = (None, None);
        let mut is_moving = least > 0.0;
        // When and where it came to rest.
        let mut rest: Option<(u64, Odometry)> = None;
        loop {
            let left = self.left(goal);
            let is_there = left.distance.abs() <= self.config.tolerance.linear
                && left.turn.abs() <= self.config.tolerance.angular;
            is_moving &= !is_there;
            let velocity = match is_moving {
                true => self.velocity(left, goal, least),
                false => Twist::default(),
            };
            self.base.drive(velocity).map_err(RoverError::Base)?;
            let report = self.hear()?;
            // The robot may have rested before this motion.
            let seconds_since = |then| report.time_us.saturating_sub(then) as f64 * 1e-6;
            let seconds = seconds_since(*begun.get_or_insert(report.time_us));
            if is_moving && seconds > patience {
                is_moving = false;
                sensed.bump = Some(true);
            }
            if !is_moving {
                let seconds = seconds_since(*stopped.get_or_insert(report.time_us));
                if seconds > STOPPED {
                    return Err(match rest.map(|(since, _)| seconds_since(since)) {
                        Some(seconds) if seconds > 0.5 * STOPPED => RoverError::NoScan { seconds },
                        _ => RoverError::Restless { seconds },
                    });
                }
            }
            let has_moved = rest.is_none_or(|(_, at)| self.is_off(at));
            if is_moving || has_moved {
                rest = (!is_moving).then_some((report.time_us, self.rolled));
            }
            if let Some(bump) = report.bump {
                sensed.bump = Some(sensed.bump == Some(true) || bump);
            }
            sensed.compass = report.compass.or(sensed.compass);
            let taken_us = report.taken_us.unwrap_or(report.time_us);
            let is_new = rest.is_some_and(|(since, _)| taken_us >= since + latency_us);
            if let Some(ranges) = report.ranges.filter(|_| is_new) {
                let ring = self.ring;
                sensed.scan = Some(Scan { ring, ranges });
                sensed.time_us = self.time_us;
                sensed.odometry = Some(self.rolled);
                return Ok(sensed);
            }
        }
    }

    /// Returns whether the robot is elsewhere than when it had rolled so far.
    fn is_off(&self, at: Odometry) -> bool {
        let Twist { linear, angular } = self.config.tolerance;
        (self.rolled.distance - at.distance).abs() > linear
            || (self.rolled.turn - at.turn).abs() > angular
    }

    /// Returns what is left of a motion once all commands under way have had their effect.
    fn left(&self, goal: Odometry) -> Odometry {
        let late = self.config.latency_us as f64 * 1e-6;
        Odometry {
            distance: goal.distance - self.rolled.distance - late * self.rate.linear,
            turn: goal.turn - self.rolled.turn - late * self.rate.angular,
        }
    }

    /// Returns the velocity with which a motion goes on, of which so much is left. The whole takes
    /// `least` seconds at the least.
    fn velocity(&self, left: Odometry, goal: Odometry, least: f64) -> Twist {
        let RoverConfig {
            fastest,
            braking,
            tolerance,
            ..
        } = self.config;
        let along = |left: f64, goal: f64, fastest: f64, braking: f64, tolerance: f64| {
            if left.abs() <= tolerance {
                return 0.0;
            }
            let most = (goal.abs() / least).max(CREEP * fastest);
            let brakes = libm::sqrt(2.0 * braking * left.abs());
            libm::copysign(most.min(brakes), left)
        };
        Twist {
            linear: along(
                left.distance,
                goal.distance,
                fastest.linear,
                braking.linear,
                tolerance.linear,
            ),
            angular: along(
                left.turn,
                goal.turn,
                fastest.angular,
                braking.angular,
                tolerance.angular,
            ),
        }
    }

    /// Waits for a report and takes in its pose.
    fn hear(&mut self) -> Result<BaseReport, RoverError<B::Error>> {
        let silence_us = self.config.silence_us;
        let report = self.base.report(silence_us).map_err(RoverError::Base)?;
        let report = report.ok_or(RoverError::Silent { silence_us })?;
        let (given, before) = (report.time_us, self.time_us);
        if given < before {
            return Err(RoverError::Time { given, before });
        }
        let finite = |sense, is_finite| match is_finite {
            true => Ok(()),
            false => Err(RoverError::NotANumber { sense }),
        };
        finite("compass", report.compass.is_none_or(Heading::is_finite))?;
        if let Some(ranges) = &report.ranges {
            finite("laser", !ranges.iter().any(|range| range.is_nan()))?;
            let (given, beams) = (ranges.len(), self.ring.beams);
            if given != beams as usize {
                return Err(RoverError::Beams { given, beams });
            }
        }
        if let Some(pose) = report.pose {
            let at = pose.position;
            finite(
                "pose",
                at.x.is_finite() && at.y.is_finite() && pose.heading.is_finite(),
            )?;
            if let Some(last) = self.pose.replace(pose) {
                let turn = last.heading.turn_to(pose.heading);
                let middle = Heading::from_radians(last.heading.radians() + 0.5 * turn);
                let distance = (at - last.position).dot(&middle.unit());
                self.rolled.distance += distance;
                self.rolled.turn += turn;
                let seconds = (given - before) as f64 * 1e-6;
                if seconds > 0.0 {
                    self.rate = Twist {
                        linear: distance / seconds,
                        angular: turn / seconds,
                    };
                }
            }
            self.time_us = given;
        }
        Ok(report)
    }
}

impl<B: VelocityBase> Robot for VelocityRover<B> {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = RoverError<B::Error>;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Self::Error> {
        let goal = Odometry {
            distance: command.translate.clamp(-1.0, 1.0) * self.config.step.distance,
            turn: command.turn.clamp(-1.0, 1.0) * self.config.step.turn,
        };
        let made = self.make(goal);
        let stopped = self.base.drive(Twist::default());
        self.sensing = made?;
        stopped.map_err(RoverError::Base)
    }
}

impl<B: VelocityBase> Drop for VelocityRover<B> {
    fn drop(&mut self) {
        // If the base no longer obeys, there is no one to report it to.
        let _ = self.base.drive(Twist::default());
    }
}

#[cfg(test)]
mod tests {
    use alloc::collections::VecDeque;
    use alloc::vec;
    use core::f64::consts::FRAC_PI_2;

    use super::*;

    /// A base that obeys late and gathers speed slowly. It reports its pose at 50 Hz and a scan at
    /// 5 Hz.
    #[derive(Default)]
    struct Late {
        pose: Pose,
        velocity: Twist,
        /// Commands under way, with the time when they arrive.
        under_way: VecDeque<(u64, Twist)>,
        wanted: Twist,
        last: Twist,
        time_us: u64,
        /// Time from which it is silent.
        silent_from: Option<u64>,
        compass: Option<f64>,
        /// Whether it stands against a wall.
        is_blocked: bool,
        /// Age of its scans, µs.
        scan_age_us: u64,
        /// Time at which it last moved.
        stopped_us: u64,
    }

    const TICK_US: u64 = 20_000;

    impl VelocityBase for &mut Late {
        type Error = ();

        fn drive(&mut self, velocity: Twist) -> Result<(), ()> {
            self.under_way.push_back((self.time_us + 80_000, velocity));
            self.last = velocity;
            Ok(())
        }

        fn report(&mut self, _: u64) -> Result<Option<BaseReport>, ()> {
            if self.silent_from.is_some_and(|from| self.time_us >= from) {
                return Ok(None);
            }
            self.time_us += TICK_US;
            while let Some((arrives, velocity)) = self.under_way.front().copied()
                && arrives <= self.time_us
            {
                self.wanted = velocity;
                self.under_way.pop_front();
            }
            let towards =
                |now: f64, wanted: f64, most: f64| now + (wanted - now).clamp(-most, most);
            self.velocity.linear = towards(self.velocity.linear, self.wanted.linear, 0.02);
            self.velocity.angular = towards(self.velocity.angular, self.wanted.angular, 0.12);
            if self.is_blocked {
                self.velocity = Twist::default();
            }
            if self.velocity != Twist::default() {
                self.stopped_us = self.time_us;
            }
            let (way, turn) = (0.02 * self.velocity.linear, 0.02 * self.velocity.angular);
            self.pose = self.pose.displaced(way, turn);
            Ok(Some(BaseReport {
                time_us: self.time_us,
                pose: Some(self.pose),
                ranges: self.time_us.is_multiple_of(200_000).then(|| vec![1.0; 4]),
                taken_us: Some(self.time_us.saturating_sub(self.scan_age_us)),
                compass: self.compass.map(Heading::from_radians),
                bump: None,
            }))
        }
    }

    fn rover(base: &mut Late) -> VelocityRover<&mut Late> {
        let step = StepMeasures {
            turn: FRAC_PI_2,
            distance: 0.5,
        };
        VelocityRover::new(base, Ring::full(4, 4.0), RoverConfig::small(step)).unwrap()
    }

    #[test]
    fn a_motion_ends_where_it_is_told_though_the_base_is_late() {
        for (turn, translate) in [
            (0.0, 1.0),
            (1.0, 0.0),
            (-0.3, 0.5),
            (0.02, 0.0),
            (0.0, -0.1),
            (0.0, 0.0),
        ] {
            let mut base = Late::default();
            let mut rover = rover(&mut base);
            rover.stop().unwrap();
            rover.step(&TurnTranslate { turn, translate }).unwrap();
            let rolled = rover.sensing().odometry.unwrap();
            assert!(
                (rolled.distance - 0.5 * translate).abs() < 0.015,
                "{translate}: {rolled:?}"
            );
            assert!(
                (rolled.turn - FRAC_PI_2 * turn).abs() < 0.04,
                "{turn}: {rolled:?}"
            );
            // The scan was taken at rest.
            drop(rover);
            assert!(base.velocity.linear.abs() < 0.006, "{:?}", base.velocity);
            assert_eq!(base.last, Twist::default());
        }
    }

    #[test]
    fn a_silent_base_is_stopped() {
        let mut base = Late {
            silent_from: Some(1_000_000),
            ..Late::default()
        };
        let mut rover = rover(&mut base);
        rover.stop().unwrap();
        let silence_us = 500_000;
        assert_eq!(rover.step(&AHEAD), Err(RoverError::Silent { silence_us }));
        assert_eq!(rover.base().last, Twist::default());
    }

    #[test]
    fn a_reading_that_is_no_number_stops_the_robot() {
        let mut base = Late {
            compass: Some(f64::NAN),
            ..Late::default()
        };
        let mut rover = rover(&mut base);
        assert_eq!(
            rover.stop(),
            Err(RoverError::NotANumber { sense: "compass" })
        );
        assert_eq!(rover.base().last, Twist::default());
    }
    const AHEAD: TurnTranslate = TurnTranslate {
        turn: 0.0,
        translate: 1.0,
    };

    #[test]
    fn a_motion_that_does_not_end_is_a_bump() {
        let mut base = Late {
            is_blocked: true,
            ..Late::default()
        };
        let mut rover = rover(&mut base);
        rover.stop().unwrap();
        rover.step(&AHEAD).unwrap();
        let sensed = rover.sensing();
        assert_eq!(sensed.bump, Some(true));
        assert!(sensed.odometry.unwrap().distance.abs() < 1e-9);
        assert_eq!(rover.base().last, Twist::default());
    }

    #[test]
    fn a_base_may_rest_for_minutes_between_motions() {
        let mut base = Late::default();
        rover(&mut base).stop().unwrap();
        base.time_us += 600_000_000;
        let mut rover = rover(&mut base);
        rover.step(&AHEAD).unwrap();
        assert_eq!(rover.sensing().bump, None);
    }

    #[test]
    fn a_scan_of_the_motion_before_is_not_taken() {
        let mut base = Late {
            scan_age_us: 300_000,
            ..Late::default()
        };
        let mut rover = rover(&mut base);
        rover.step(&AHEAD).unwrap();
        // Its latency, and as much again as its scans are old.
        let rested_us = rover.base().time_us - rover.base().stopped_us;
        assert!(rested_us >= 400_000, "{rested_us}");
    }
}
