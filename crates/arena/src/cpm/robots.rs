use tolman_control::epuck::{RangeCurve, RangeCurveError};
use tolman_geom::Pose;
use tolman_sim::robots::{Epuck, EpuckConfig, LaserPioneer, LaserPioneerConfig};
use tolman_sim::sensors::ResponseCurve;
use tolman_systems::cpm::{RingAsEpuck, RingMeasures, WalkerConfig};

use crate::course::Course;
use crate::pioneer::CoursePioneer;
use crate::{BoxError, Simulated};

/// The simulated e-puck. Its maze's zones `start` and `destination` are its landmarks.
pub type SimulatedEpuck = Simulated<Epuck>;

/// A sweep at 4.83 rad/s, just below the wheels' limit, takes one sample per step.
const STEP_US: u64 = 13_000;

/// Returns the paper's e-puck, with the wheels of the real one, so that a sweep takes 1.3 s.
#[must_use]
pub fn epuck() -> EpuckConfig {
    let mut config = EpuckConfig::cpm();
    config.step_us = STEP_US;
    config
}

/// Returns the paper's e-puck at the speed of the real one, which swept at 3π/5 rad/s, in 3.3 s
/// (section 7).
#[must_use]
pub fn slow_epuck() -> EpuckConfig {
    let mut config = EpuckConfig::cpm();
    config.step_us = 33_333;
    config
}

/// Returns the configuration of the paper's robot in corridors `width` wide, m. It takes one sample
/// of a sweep per time step, so the time step sets the speed of a sweep.
///
/// # Errors
/// If the response curve cannot be inverted.
pub fn walker_config(robot: &EpuckConfig, width: f64) -> Result<WalkerConfig, RangeCurveError> {
    let mut config = WalkerConfig::paper(curve(&robot.response)?, robot.step_us, width);
    config.pilot.most_wheel_speed = robot.most_wheel_speed;
    Ok(config)
}

/// Returns a response curve with its axes exchanged, sampled every millimetre.
fn curve(response: &ResponseCurve) -> Result<RangeCurve, RangeCurveError> {
    let reach = libm::round(response.reach() * 1e3) as u32;
    let millimetres = (0..=reach).map(|millimetre| f64::from(millimetre) * 1e-3);
    let points = millimetres.map(|range| (range, response.at(range).value));
    RangeCurve::new(points.collect())
}

/// Returns the measures by which a laser Pioneer in corridors `width` wide, m, looks like the
/// paper's e-puck to CPM.
///
/// The tolerance of turns is twice the error of the motors.
#[must_use]
pub fn ring_measures(robot: &LaserPioneerConfig, width: f64) -> RingMeasures {
    RingMeasures {
        corridor_width: width,
        body_radius: robot.radius,
        turn_per_step: robot.turn_per_step,
        translate_per_step: robot.translate_per_step,
        step_us: robot.step_us,
        turn_tolerance: (2.0 * robot.motor_noise.turn.absolute_sd).max(1e-9),
    }
}

/// Puts a laser Pioneer down on a course. Returns it as an e-puck, with the configuration of its
/// walker there.
///
/// # Errors
/// If the robot cannot be built, looks like no e-puck, or cannot stand there.
pub fn pioneer_as_epuck(
    course: &Course,
    pose: Pose,
    robot: LaserPioneerConfig,
    seed: u64,
) -> Result<(RingAsEpuck<CoursePioneer>, WalkerConfig), BoxError> {
    let measures = ring_measures(&robot, course.corridor_width);
    let config = measures.walker_config();
    let body = course.robot_at(pose, LaserPioneer::new(robot)?, seed)?;
    Ok((RingAsEpuck::new(body, measures)?, config))
}
