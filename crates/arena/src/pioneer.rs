//! The robot of MSLST: a Pioneer with a ring of 72 laser beams and a compass.

use tolman_robot::{Body, Ring};
use tolman_sim::Contact;
use tolman_sim::noise::{Fault, Gaussian};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_systems::mslst::ROBOT_UNIT;

use crate::Simulated;

/// A simulated Pioneer on a course, which senses the goal where its centre lies in the destination.
pub type CoursePioneer = Simulated<LaserPioneer>;

/// Name of the robot in files of learned maps.
pub const LASER_PIONEER: &str = "laser Pioneer";

/// Name of the Pioneer with a camera beside its laser.
pub const CAMERA_PIONEER: &str = "camera Pioneer";

/// Width of a corridor if a maze does not give one: 1.9 robot units, in metres.
///
/// Avoid's buffer of 0.9 units needs more than 1.8; the corridor test needs less than 2.0 (see
/// `docs/notebook/mslst.md`).
pub const CORRIDOR_WIDTH: f64 = 1.9 * ROBOT_UNIT;

/// Number of beams of the ring.
const BEAMS: u32 = 72;

/// Range of the beams, robot units.
const REACH_UNITS: f64 = 2.5;

/// Returns the ring of 72 beams over the full circle that reaches 2.5 robot units.
#[must_use]
pub fn ring() -> Ring {
    Ring::full(BEAMS, REACH_UNITS * ROBOT_UNIT)
}

/// Returns the robot as it was calibrated on the paper's baselines, and then frozen (see
/// `docs/mslst.md`).
#[must_use]
pub fn calibrated() -> LaserPioneerConfig {
    let mut config = LaserPioneerConfig::noiseless();
    config.radius = 0.5 * ROBOT_UNIT;
    config.ring = ring();
    config.turn_per_step = 91_f64.to_radians();
    config.translate_per_step = 2.0 * ROBOT_UNIT;
    config.motor_noise.turn = Gaussian {
        relative_sd: 0.12,
        absolute_sd: 0.5_f64.to_radians(),
    };
    config.motor_noise.translate = Gaussian::relative(0.25);
    config.motor_noise.drift_sd = 2_f64.to_radians();
    config.contact = Contact::Slide;
    config
}

/// Returns the same robot with sensor noise, as the better MSLST is judged. Encoders err by
/// `encoders` of each step (standard deviation), and by a share of up to 2 % that is constant in a
/// run. Ranges err by 2 %.
#[must_use]
pub fn with_sensor_noise(robot: &LaserPioneerConfig, encoders: f64) -> LaserPioneerConfig {
    let mut noisy = robot.clone();
    noisy.odometry_distance_noise = Gaussian::relative(encoders);
    noisy.scan_noise = Gaussian::relative(0.02);
    noisy.faults.odometry_distance.push(Fault::Bounded {
        share: 0.02,
        offset: 0.0,
        steps: u32::MAX,
    });
    noisy
}

/// Default standard deviation of encoders in a step, as a share of it.
pub const ENCODER_SD: f64 = 0.03;

/// Returns the robot's body: a disc one robot unit across.
#[must_use]
pub const fn body() -> Body {
    Body::Circle {
        radius: 0.5 * ROBOT_UNIT,
    }
}

/// Returns the same robot with perfect motors and sensors: the robot that a planner assumes.
#[must_use]
pub fn without_noise(robot: &LaserPioneerConfig) -> LaserPioneerConfig {
    let perfect = LaserPioneerConfig::noiseless();
    let mut config = robot.clone();
    config.motor_noise = perfect.motor_noise;
    config.scan_noise = perfect.scan_noise;
    config.compass_noise = perfect.compass_noise;
    config.odometry_distance_noise = perfect.odometry_distance_noise;
    config.odometry_turn_noise = perfect.odometry_turn_noise;
    config.faults = perfect.faults;
    config
}
