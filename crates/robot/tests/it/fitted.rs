//! A robot of any size, with any laser, looks like the one that a system is made for.

use core::convert::Infallible;
use core::f64::consts::{FRAC_PI_2, TAU};

use tolman_robot::geom::Heading;
use tolman_robot::{
    Fitted, FittedError, LaserMeasures, LaserSensing, MadeFor, Odometry, Ring, Robot,
    RobotMeasures, Scan, TurnTranslate,
};

/// Walls of a room around the robot, m: ahead, to the left, behind, to the right.
const ROOM: [f64; 4] = [0.4, 0.25, 0.3, 0.25];

/// A robot that stands still in a room, whatever it is told.
struct Still {
    sensing: LaserSensing,
    told: Vec<TurnTranslate>,
}

impl Robot for Still {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = Infallible;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
        self.told.push(*command);
        Ok(())
    }
}

/// Returns the distance of the wall from (x, y) in a direction, m.
fn wall(x: f64, y: f64, bearing: f64) -> f64 {
    let (sin, cos) = bearing.sin_cos();
    let [ahead, left, behind, right] = ROOM;
    let along = if cos > 0.0 { ahead - x } else { behind + x } / cos.abs().max(1e-12);
    let across = if sin > 0.0 { left - y } else { right + y } / sin.abs().max(1e-12);
    along.min(across)
}

fn still(laser: &LaserMeasures, lost: &[usize]) -> Still {
    let ring = laser.ring();
    let range = |beam: u32| wall(laser.x, laser.y, ring.bearing(beam));
    let mut ranges: Vec<f64> = (0..laser.beams).map(range).collect();
    for beam in lost {
        ranges[*beam] = 0.0;
    }
    let mut sensing = LaserSensing::silent(ring);
    sensing.scan = Some(Scan { ring, ranges });
    sensing.compass = Some(Heading::NORTH);
    sensing.odometry = Some(Odometry {
        distance: 0.1,
        turn: 0.2,
    });
    Still {
        sensing,
        told: Vec::new(),
    }
}

fn made_for() -> MadeFor {
    MadeFor {
        corridor_width: 1.0,
        ring: Ring::full(72, 1.3),
        turn_per_step: FRAC_PI_2,
        translate_per_step: 1.0,
        step_us: 100_000,
    }
}

/// Returns the robot, in corridors half as wide as the system's, once it has looked.
fn looking(laser: LaserMeasures, lost: &[usize]) -> Fitted<Still> {
    let measures = RobotMeasures::new(0.25, 0.5, laser);
    let mut robot = Fitted::new(still(&laser, lost), measures, made_for()).unwrap();
    robot.stop().unwrap();
    robot
}

/// Lasers of all kinds, on a robot in the same place.
fn lasers() -> Vec<LaserMeasures> {
    let central = LaserMeasures::all_round(72, 0.05, 3.5);
    let fine = LaserMeasures::all_round(360, 0.05, 3.5);
    let mut behind = fine;
    behind.x = -0.032;
    let mut turned = behind;
    (turned.y, turned.heading) = (0.05, 1.0);
    let mut upside_down = turned;
    (upside_down.upside_down, upside_down.first_bearing) = (true, -0.5);
    let mut twice = behind;
    // It gives the beam astern as its first and last.
    (twice.first_bearing, twice.spacing) = (-0.5 * TAU, Some(TAU / 359.0));
    vec![central, fine, behind, turned, upside_down, twice]
}

#[test]
fn whatever_the_laser_a_system_sees_from_the_middle_of_the_axle() {
    for laser in lasers() {
        let robot = looking(laser, &[]);
        let scan = robot.sensing().scan.as_ref().unwrap();
        assert_eq!(scan.ring, made_for().ring);
        for beam in 0..72 {
            let seen = scan.ranges[beam as usize];
            // In the system's metres, of which two make one of the robot's.
            let true_range = (2.0 * wall(0.0, 0.0, scan.ring.bearing(beam))).min(1.3);
            let off = (seen - true_range).abs();
            assert!(
                off < 0.02,
                "beam {beam} of {laser:?}: {seen} for {true_range}"
            );
        }
    }
}

#[test]
fn lost_beams_are_no_opening_and_wide_ones_are() {
    let mut laser = LaserMeasures::all_round(360, 0.05, 3.5);
    laser.x = -0.032;
    let seen = |lost: &[usize]| looking(laser, lost).sensing().scan.clone().unwrap();
    let whole = seen(&[]);
    let gap: Vec<usize> = (80..100).collect();
    let near = |a: &Scan, b: &Scan| {
        let mut pairs = a.ranges.iter().zip(&b.ranges);
        pairs.all(|(a, b)| (a - b).abs() < 0.02)
    };
    assert!(near(&whole, &seen(&[0, 5, 45, 89, 90, 91, 200])));
    let open = seen(&gap);
    assert!(!near(&whole, &open));
    assert_eq!(open.ranges.iter().filter(|range| **range >= 1.3).count(), 3);
}

#[test]
fn lengths_come_in_and_go_out_in_their_own_metres() {
    let mut robot = looking(LaserMeasures::all_round(72, 0.05, 3.5), &[]);
    let sensed = robot.sensing();
    let odometry = sensed.odometry.unwrap();
    assert!((odometry.distance - 0.2).abs() < 1e-12 && (odometry.turn - 0.2).abs() < 1e-12);
    assert_eq!(sensed.compass, Some(Heading::NORTH));
    let half = TurnTranslate {
        turn: 0.5,
        translate: 0.5,
    };
    robot.step(&half).unwrap();
    // Half of the system's metre is a quarter of the robot's, which makes half a metre in a step.
    assert_eq!(robot.robot().told.last(), Some(&half));
}

#[test]
fn a_reading_that_fits_no_laser_stops_the_robot() {
    let laser = LaserMeasures::all_round(72, 0.05, 3.5);
    let failed = |change: fn(&mut LaserSensing)| {
        let mut robot = looking(laser, &[]);
        change(&mut robot.robot_mut().sensing);
        let ahead = TurnTranslate {
            turn: 0.0,
            translate: 1.0,
        };
        let error = robot.step(&ahead).unwrap_err();
        let last = *robot.robot().told.last().unwrap();
        assert_eq!((last.turn, last.translate), (0.0, 0.0));
        error
    };
    let few = failed(|sensing| sensing.scan.as_mut().unwrap().ranges.truncate(3));
    assert_eq!(
        few,
        FittedError::Beams {
            given: 3,
            beams: 72
        }
    );
    let nan = failed(|sensing| sensing.scan.as_mut().unwrap().ranges[3] = f64::NAN);
    assert_eq!(nan, FittedError::NotANumber { sense: "laser" });
    let nan = failed(|sensing| sensing.compass = Some(Heading::from_radians(f64::NAN)));
    assert_eq!(nan, FittedError::NotANumber { sense: "compass" });
}
