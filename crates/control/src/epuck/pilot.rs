use core::f64::consts::TAU;

use thiserror::Error;
use tolman_geom::{Point, Twist};
use tolman_robot::Robot;
use tolman_robot::epuck::{
    ENCODER_STEP, EpuckSensing, MOST_WHEEL_SPEED, TRACK, WHEEL_RADIUS, WheelSpeeds,
};

use super::{Echoes, Forward, ForwardConfig, KeepOff, RangeCurve, Sweep};

/// Drives an e-puck for layer 3: sweeps, half seconds of path, turns.
#[derive(Clone, Debug)]
pub struct Pilot<R> {
    robot: R,
    config: PilotConfig,
    forward: Forward,
}

/// Minimum turn that the real robot's encoders can resolve, rad: each wheel by a step, against the
/// other.
pub const TURN_STEP: f64 = 2.0 * ENCODER_STEP * WHEEL_RADIUS / TRACK;

/// Number of time steps for which encoders that count whole steps may report no motion: in a slow
/// turn, or before the motors start.
const PATIENCE: u32 = 10;

/// Parameters of a pilot.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct PilotConfig {
    /// Length of the robot's time step, µs.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_one_long")
    )]
    pub step_us: u64,
    /// Number of samples of a sweep; the paper takes 100.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_one")
    )]
    pub samples: u32,
    /// Speed of turning in a sweep, rad/s. The paper says 2π, but the wheels reach only 4.9; the
    /// real robot had 3π/5.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub sweep_speed: f64,
    /// Maximum commanded speed of a wheel, rad/s: at most the wheels' limit, 6.28.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub most_wheel_speed: f64,
    /// Maximum error at which a turn ends, rad. It must be at least what the encoders can resolve:
    /// [`TURN_STEP`] on the real robot, next to nothing where they are exact. The next sample's
    /// turn compensates the error.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub turn_tolerance: f64,
    /// Conversion of the proximity sensors' raw values to distances.
    pub curve: RangeCurve,
    /// Parameters of layer 1, which drives on.
    pub forward: ForwardConfig,
    /// Parameters of layer 0, which keeps off the walls.
    pub keep_off: KeepOff,
}

/// "The robot samples the sensor value … 100 times" (section 4.1).
const SAMPLES: u32 = 100;

/// Smallest turn that continuous encoders distinguish, rad.
const EXACT: f64 = 1e-9;

impl PilotConfig {
    /// Returns the configuration of the paper's robot in corridors `width` wide, m, with encoders
    /// that are exact. A sample of a sweep takes one time step, so the time step sets the speed of
    /// a sweep.
    ///
    /// ```
    /// use tolman_control::epuck::{PilotConfig, RangeCurve, TURN_STEP};
    ///
    /// let mut config = PilotConfig::paper(RangeCurve::cpm(), 13_000, 0.1);
    /// config.turn_tolerance = TURN_STEP; // on the real robot
    /// assert_eq!(config.samples, 100);
    /// ```
    #[must_use]
    pub fn paper(curve: RangeCurve, step_us: u64, width: f64) -> Self {
        Self {
            step_us,
            samples: SAMPLES,
            sweep_speed: TAU / f64::from(SAMPLES) / (step_us as f64 * 1e-6),
            most_wheel_speed: MOST_WHEEL_SPEED,
            turn_tolerance: EXACT,
            curve,
            forward: ForwardConfig::for_width(width),
            keep_off: KeepOff::ours(),
        }
    }
}

impl<R> Pilot<R>
where
    R: Robot<Command = WheelSpeeds, Sensing = EpuckSensing>,
{
    /// Returns a pilot of this robot.
    pub fn new(robot: R, config: PilotConfig) -> Self {
        let forward = Forward::new(config.forward);
        Self::resume(robot, config, forward)
    }

    /// Returns a pilot that continues with this robot from the state of its layer 1.
    pub const fn resume(robot: R, config: PilotConfig, forward: Forward) -> Self {
        Self {
            robot,
            config,
            forward,
        }
    }

    /// Returns layer 1 as it is now.
    pub const fn forward(&self) -> &Forward {
        &self.forward
    }

    /// Returns the robot.
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, to be lifted.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }

    /// Returns the free distance straight ahead, m, or `None` without an echo.
    pub fn ahead(&self) -> Option<f64> {
        self.echoes().ok()?.ahead()
    }

    /// Returns whether walls stand ahead and on both sides, none farther than this from the middle
    /// of the robot, m.
    pub fn is_enclosed(&self, within: f64) -> bool {
        let Ok(echoes) = self.echoes() else {
            return false;
        };
        let ahead = echoes.ahead().is_some_and(|ahead| ahead < within);
        let beside = |sensor| {
            let echo = echoes.of_sensor(sensor);
            echo.is_some_and(|point| point.y.abs() < within)
        };
        ahead && beside(2) && beside(5)
    }

    /// Returns the pilot's configuration.
    pub const fn config(&self) -> &PilotConfig {
        &self.config
    }

    /// Turns once round in place, counter-clockwise, and reads all sensors at every sample's
    /// bearing (section 4.1).
    ///
    /// # Errors
    /// If the robot fails, or its wheels do not say how far they turned.
    pub fn sweep(&mut self) -> Result<Sweep, PilotError<R::Error>> {
        let mut sweep = Sweep::default();
        let spacing = TAU / f64::from(self.config.samples.max(1));
        let mut turned = 0.0;
        for sample in 0..self.config.samples {
            turned += self.turn_on(
                spacing * f64::from(sample) - turned,
                self.config.sweep_speed,
            )?;
            sweep.samples.push(self.robot.sensing().proximity);
        }
        self.turn_on(TAU - turned, self.config.sweep_speed)?;
        Ok(sweep)
    }

    /// Drives forward along the path for about `seconds` seconds: layer 1 proposes, layer 0
    /// corrects. Turning in place in a bend does not count as forward, but is limited to ten times
    /// as long.
    ///
    /// # Errors
    /// If the robot fails, or its proximity sensors give nothing.
    pub fn follow(&mut self, seconds: f64) -> Result<(), PilotError<R::Error>> {
        let steps = libm::round(seconds * 1e6 / self.config.step_us as f64) as u64;
        let mut forward = 0;
        for _ in 0..10 * steps {
            if forward >= steps {
                break;
            }
            let echoes = self.echoes()?;
            let proposal = self.forward.propose(&echoes);
            forward += u64::from(proposal.linear > 0.0);
            let twist = self.config.keep_off.correct(proposal, &echoes);
            self.drive(twist, 1.0)?;
            self.forward.turned(twist.angular * self.step_seconds());
        }
        Ok(())
    }

    /// Stands still for a time step, so that the sensors read the present surroundings. After the
    /// robot was carried elsewhere, they still hold the readings of its old position.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn stand(&mut self) -> Result<(), PilotError<R::Error>> {
        self.drive(Twist::ZERO, 1.0)
    }

    /// Turns in place by `radians`, rad, counter-clockwise.
    ///
    /// # Errors
    /// If the robot fails, or its wheels do not say how far they turned.
    pub fn turn(&mut self, radians: f64) -> Result<(), PilotError<R::Error>> {
        self.forward.look_along();
        self.turn_on(radians, self.config.sweep_speed).map(|_| ())
    }

    /// Drives straight to a point of its own frame, m, as far as layer 0 lets it. It drives ahead
    /// or backward, whichever needs the smaller turn. Then it turns back to its former heading.
    ///
    /// # Errors
    /// If the robot fails, or its sensors give nothing.
    pub fn go_to(&mut self, point: Point) -> Result<(), PilotError<R::Error>> {
        let mut way = point.coords;
        let mut speed = self.config.forward.speed;
        if way.x < 0.0 {
            (way, speed) = (-way, -speed);
        }
        let turn = libm::atan2(way.y, way.x);
        self.turn(turn)?;
        let step = speed.abs() * self.step_seconds();
        let mut left = way.norm();
        while left > 1e-6 {
            let share = (left / step).min(1.0);
            let twist = Twist::new(speed * share, 0.0);
            let corrected = self.config.keep_off.correct(twist, &self.echoes()?);
            if speed > 0.0 && corrected.linear <= 0.0 {
                break;
            }
            self.drive(twist, 1.0)?;
            left -= step * share;
        }
        self.turn(-turn)
    }

    /// Turns by `radians` and returns the turn by its wheels, rad.
    fn turn_on(&mut self, radians: f64, speed: f64) -> Result<f64, PilotError<R::Error>> {
        let step = speed * self.step_seconds();
        let mut turned = 0.0;
        let mut still = 0;
        // Every step but the last is a whole one.
        while (radians - turned).abs() > self.config.turn_tolerance {
            let left = radians - turned;
            let share = (left.abs() / step).min(1.0);
            let twist = Twist::new(0.0, speed * left.signum());
            self.drive(twist, share)?;
            let encoders = self
                .robot
                .sensing()
                .encoders
                .ok_or(PilotError::NoEncoders)?;
            let by = (encoders.right - encoders.left) * WHEEL_RADIUS / TRACK;
            still = if by.abs() < 1e-12 { still + 1 } else { 0 };
            if still == PATIENCE {
                return Err(PilotError::Stuck);
            }
            turned += by;
        }
        Ok(turned)
    }

    /// Drives for one time step at `twist` times `share`.
    fn drive(&mut self, twist: Twist, share: f64) -> Result<(), PilotError<R::Error>> {
        let part = Twist::new(twist.linear * share, twist.angular * share);
        let speeds = WheelSpeeds::of_twist(part, self.config.most_wheel_speed);
        self.robot.step(&speeds).map_err(PilotError::Robot)
    }

    fn echoes(&self) -> Result<Echoes, PilotError<R::Error>> {
        let values = self.robot.sensing().proximity.ok_or(PilotError::Blind)?;
        Ok(Echoes::of(&values, &self.config.curve))
    }

    fn step_seconds(&self) -> f64 {
        self.config.step_us as f64 * 1e-6
    }
}

/// Reason why the robot stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PilotError<E> {
    /// The robot failed.
    #[error("the robot failed: {0}")]
    Robot(E),
    /// The proximity sensors give nothing.
    #[error(
        "the proximity sensors give no values, and nothing else keeps the robot off the walls; check them"
    )]
    Blind,
    /// The wheels do not report their turns.
    #[error("the encoders give no values; check them")]
    NoEncoders,
    /// The wheels were commanded to turn and did not.
    #[error("the wheels do not turn although commanded to; check the motors")]
    Stuck,
}
