//! The robot of MSLST: a Pioneer with a ring of 72 laser beams and a compass, and its layers.

use core::f64::consts::FRAC_PI_2;

use tolman_geom::Heading;
use tolman_robot::{Body, Ring, Scan};
use tolman_sim::Contact;
use tolman_sim::noise::Gaussian;
use tolman_sim::robots::{LaserPioneerConfig, MotorNoise};

/// MSLST measures in robot units: one is the robot's diameter. Metres.
pub const ROBOT_UNIT: f64 = 0.5;

/// The width of a corridor where a maze says nothing of it: 1.9 robot units, in metres.
///
/// Avoid's buffer of 0.9 units needs more than 1.8; the corridor test needs less than 2.0
/// (see `docs/mslst.md`).
pub const CORRIDOR_WIDTH: f64 = 1.9 * ROBOT_UNIT;

/// How many beams the ring has.
const BEAMS: u32 = 72;

/// How far they reach, robot units.
const REACH_UNITS: f64 = 2.5;

/// The ring of 72 beams over the full circle that reaches 2.5 robot units.
#[must_use]
pub fn ring() -> Ring {
    Ring::full(BEAMS, REACH_UNITS * ROBOT_UNIT)
}

/// A scan as MSLST's quantizer sees it: in robot units, and turned by the compass, to the nearest beam, so
/// that "a particular location is distinct no matter which way the robot is facing". Beam 0 looks
/// north, the others follow counter-clockwise.
///
/// ```
/// use tolman_arena::pioneer;
/// use tolman_geom::Heading;
/// use tolman_robot::Scan;
///
/// let mut scan = Scan::clear(pioneer::ring());
/// scan.ranges[0] = 0.5;
/// let facing_west = pioneer::heading_free(&scan, Heading::from_degrees(180.0));
/// assert_eq!((facing_west[18], facing_west[0]), (1.0, 2.5));
/// ```
#[must_use]
pub fn heading_free(scan: &Scan, heading: Heading) -> Vec<f64> {
    let beams = scan.ranges.len();
    let mut turned: Vec<f64> = scan.ranges.iter().map(|range| range / ROBOT_UNIT).collect();
    if beams > 0 {
        let ahead = (heading.radians() + scan.ring.first_bearing - FRAC_PI_2) / scan.ring.spacing;
        turned.rotate_right(libm::round(ahead).rem_euclid(beams as f64) as usize);
    }
    turned
}

/// The robot as it was calibrated on the paper's baselines, and then frozen (see `docs/mslst.md`).
#[must_use]
pub fn calibrated() -> LaserPioneerConfig {
    LaserPioneerConfig {
        radius: 0.5 * ROBOT_UNIT,
        ring: ring(),
        turn_per_step: 91_f64.to_radians(),
        translate_per_step: 2.0 * ROBOT_UNIT,
        motor_noise: MotorNoise {
            turn: Gaussian {
                relative_sd: 0.12,
                absolute_sd: 0.5_f64.to_radians(),
            },
            translate: Gaussian::relative(0.25),
            drift_sd: 2_f64.to_radians(),
        },
        contact: Contact::Slide,
        ..LaserPioneerConfig::noiseless()
    }
}

/// Its body: a disc one robot unit across.
#[must_use]
pub const fn body() -> Body {
    Body::Circle {
        radius: 0.5 * ROBOT_UNIT,
    }
}

/// The same robot with perfect motors and sensors: what a planner reckons with.
#[must_use]
pub fn without_noise(robot: &LaserPioneerConfig) -> LaserPioneerConfig {
    let perfect = LaserPioneerConfig::noiseless();
    LaserPioneerConfig {
        motor_noise: perfect.motor_noise,
        scan_noise: perfect.scan_noise,
        compass_noise: perfect.compass_noise,
        odometry_distance_noise: perfect.odometry_distance_noise,
        odometry_turn_noise: perfect.odometry_turn_noise,
        faults: perfect.faults,
        ..robot.clone()
    }
}
