//! The e-puck against its data sheet.

use core::f64::consts::TAU;

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::Robot;
use tolman_robot::epuck::{MOST_WHEEL_SPEED, TRACK, WHEEL_RADIUS, WheelSpeeds};
use tolman_sim::noise::Fault;
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_sim::sensors::{ResponseCurve, ResponsePoint};
use tolman_sim::trace::{Detail, Recording, replay};
use tolman_sim::{Contact, Material, Simulation, Solo, WallSegment, World};

fn quiet() -> EpuckConfig {
    let mut robot = EpuckConfig::webots();
    robot.wheels = Vec::new();
    let mut config = robot;
    config.response = ResponseCurve::new(
        [(0.0, 4095.0), (0.005, 2133.0), (0.01, 1466.0), (0.07, 67.0)]
            .map(|(range, value)| ResponsePoint {
                range,
                value,
                relative_sd: 0.0,
            })
            .to_vec(),
    )
    .unwrap();
    config
}

/// Returns a room of 1 m square round the origin.
fn room(material: Material) -> World {
    let corner =
        [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| Point::new(x, y));
    let walls = (0..4)
        .map(|i| WallSegment {
            material,
            ..WallSegment::between(corner[i], corner[(i + 1) % 4])
        })
        .collect();
    World::from_segments(walls).unwrap()
}

fn solo(config: &EpuckConfig, x: f64, degrees: f64) -> Solo<Epuck> {
    let start = Pose::new(Point::new(x, 0.0), Heading::from_degrees(degrees));
    let robot = Epuck::new(config.clone()).unwrap();
    Solo::new(room(Material::default()), robot, start, 1).unwrap()
}

#[test]
fn it_turns_in_place_at_nearly_five_radians_a_second() {
    let mut robot = solo(&quiet(), 0.0, 0.0);
    let spin = WheelSpeeds {
        left: -MOST_WHEEL_SPEED,
        right: 9.0 * MOST_WHEEL_SPEED,
    };
    let mut turned = 0.0;
    let mut steps = 0;
    while turned < TAU {
        robot.step(&spin).unwrap();
        turned += robot.truth().motion.turn;
        steps += 1;
    }
    // A full sweep takes about 1.3 s.
    assert_eq!(steps, 130);
    assert!(
        (turned / (f64::from(steps) * 0.01) - 2.0 * MOST_WHEEL_SPEED * WHEEL_RADIUS / TRACK).abs()
            < 1e-9
    );
    assert!(robot.truth().pose.position.coords.norm() < 1e-12);
}

#[test]
fn wheels_turn_as_fast_as_the_configuration_says() {
    let mut ideal = quiet();
    ideal.most_wheel_speed = 9.0;
    let mut robot = solo(&ideal, 0.0, 0.0);
    let spin = WheelSpeeds {
        left: -8.5,
        right: 20.0,
    };
    robot.step(&spin).unwrap();
    let encoders = robot.sensing().encoders.unwrap();
    assert!((encoders.left + 0.085).abs() < 1e-12 && (encoders.right - 0.09).abs() < 1e-12);
    for most in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut none = quiet();
        none.most_wheel_speed = most;
        let error = Epuck::new(none).unwrap_err().to_string();
        assert!(error.contains("most_wheel_speed"), "{error}");
    }
    // Configurations of before had the real robot's wheels.
    let mut before = serde_json::to_value(quiet()).unwrap();
    before.as_object_mut().unwrap().remove("most_wheel_speed");
    assert_eq!(
        serde_json::from_value::<EpuckConfig>(before).unwrap(),
        quiet()
    );
}

#[test]
fn proximity_values_follow_the_curve() {
    // Number 5 looks to the left from 0.031 m beside the middle: 1 cm of air before the wall.
    let robot = solo(&quiet(), 0.5 - 0.041, -90.0);
    let values = robot.sensing().proximity.unwrap();
    assert!((values[5] - 1466.0).abs() < 1e-6, "{values:?}");
    // To the right nothing is near, and that reads as the far end of the curve.
    assert!((values[2] - 67.0).abs() < 1e-9);
    // Straight lines between the points.
    let between = solo(&quiet(), 0.5 - 0.031 - 0.0075, -90.0);
    let value = between.sensing().proximity.unwrap()[5];
    assert!(value < 2133.0 && value > 1466.0 && (value - 1799.5).abs() < 1e-6);
}

#[test]
fn dark_walls_throw_back_less() {
    let seen = |reflectance| {
        let material = Material {
            reflectance,
            ..Material::default()
        };
        let start = Pose::new(Point::new(0.5 - 0.041, 0.0), Heading::from_degrees(-90.0));
        let robot = Solo::new(room(material), Epuck::new(quiet()).unwrap(), start, 1).unwrap();
        robot.sensing().proximity.unwrap()[5]
    };
    assert!((seen(0.5) - (67.0 + 0.5 * (1466.0 - 67.0))).abs() < 1e-6);
    assert!((seen(0.0) - 67.0).abs() < 1e-9);
}

#[test]
fn walls_of_several_materials_are_told_apart() {
    let mut walls = room(Material::default()).walls().to_vec();
    let east = walls
        .iter_mut()
        .find(|wall| wall.start.x > 0.4 && wall.end.x > 0.4)
        .unwrap();
    east.material.reflectance = 0.0;
    let world = World::from_segments(walls).unwrap();
    let seen = |x: f64| {
        let start = Pose::new(Point::new(x, 0.0), Heading::from_degrees(-90.0));
        let robot = Solo::new(world.clone(), Epuck::new(quiet()).unwrap(), start, 1).unwrap();
        robot.sensing().proximity.unwrap()
    };
    assert!((seen(0.5 - 0.041)[5] - 67.0).abs() < 1e-9);
    assert!((seen(-0.5 + 0.041)[2] - 1466.0).abs() < 1e-6);
}

#[test]
fn e_pucks_see_each_other() {
    let at = |x: f64, degrees: f64| Pose::new(Point::new(x, 0.0), Heading::from_degrees(degrees));
    let mut sim = Simulation::new(room(Material::default()), 1);
    let one = sim
        .add(Epuck::new(quiet()).unwrap(), at(0.0, 90.0))
        .unwrap();
    let before = sim.sensing(one).proximity.unwrap();
    // To its right, 1 cm from the sensor to the other's outline.
    let other = sim
        .add(Epuck::new(quiet()).unwrap(), at(0.031 + 0.01 + 0.037, 0.0))
        .unwrap();
    sim.step(&[WheelSpeeds::STOP; 2]).unwrap();
    let after = sim.sensing(one).proximity.unwrap();
    assert!(
        (before[2] - 67.0).abs() < 1e-9 && (after[2] - 1466.0).abs() < 1e-6,
        "{after:?}"
    );
    assert!(sim.sensing(other).proximity.unwrap()[4] > 67.0);
}

#[test]
fn encoders_tell_what_the_wheels_turned_not_what_the_body_moved() {
    for contact in [Contact::Stop, Contact::Slide] {
        let mut config = quiet();
        config.contact = contact;
        let mut robot = solo(&config, 0.4, 0.0);
        let ahead = WheelSpeeds {
            left: 5.0,
            right: 5.0,
        };
        for _ in 0..100 {
            robot.step(&ahead).unwrap();
        }
        assert!(robot.truth().bump && robot.sensing().bump == Some(true));
        let encoders = robot.sensing().encoders.unwrap();
        assert!((encoders.left - 0.05).abs() < 1e-12 && (encoders.right - 0.05).abs() < 1e-12);
        assert!(robot.truth().pose.position.x <= 0.5 - 0.037);
    }
}

#[test]
fn each_wheel_slips_by_itself() {
    let mut config = quiet();
    config.wheels = vec![Fault::Slip { share: 0.1 }];
    let ahead = WheelSpeeds {
        left: 1.0,
        right: 1.0,
    };
    let mut robot = solo(&config, -0.4, 0.0);
    let (mut distances, mut turns) = (Vec::new(), Vec::new());
    for _ in 0..2000 {
        robot.step(&ahead).unwrap();
        distances.push(robot.truth().motion.distance / (0.01 * WHEEL_RADIUS));
        turns.push(robot.truth().motion.turn);
    }
    let mean = distances.iter().sum::<f64>() / 2000.0;
    assert!((mean - 1.0).abs() < 0.005, "{mean}");
    assert!(distances.iter().all(|share| (share - 1.0).abs() <= 0.1));
    // Were both wheels to slip alike it would never turn.
    assert!(turns.iter().any(|turn| *turn > 1e-5) && turns.iter().any(|turn| *turn < -1e-5));
}

#[test]
fn the_noise_of_a_value_is_the_curves() {
    let mut config = EpuckConfig::webots();
    config.wheels = Vec::new();
    let mut robot = solo(&config, 0.5 - 0.041, -90.0);
    let mut values = Vec::new();
    for _ in 0..4000 {
        robot.step(&WheelSpeeds::STOP).unwrap();
        values.push(robot.sensing().proximity.unwrap()[5]);
    }
    let mean = values.iter().sum::<f64>() / 4000.0;
    let sd = (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / 3999.0).sqrt();
    assert!((mean / 1466.0 - 1.0).abs() < 0.001, "{mean}");
    assert!((sd / mean / 0.007 - 1.0).abs() < 0.06, "{}", sd / mean);
}

#[test]
fn a_trace_replays_to_the_bit() {
    let start = Pose::new(Point::origin(), Heading::from_degrees(20.0));
    let mut file = Vec::new();
    let robots = vec![(Epuck::new(EpuckConfig::cpm()).unwrap(), start)];
    let mut recording = Recording::start(
        room(Material::default()),
        3,
        robots,
        &mut file,
        Detail::Sensing,
    )
    .unwrap();
    for step in 0..200 {
        let speeds = WheelSpeeds {
            left: 4.0,
            right: if step % 50 < 25 { 4.0 } else { -4.0 },
        };
        recording.step(&[speeds]).unwrap();
    }
    let ended = *recording.finish().unwrap().truth(tolman_sim::RobotId(0));
    let again = replay::<Epuck>(file.as_slice()).unwrap();
    assert_eq!(*again.truth(tolman_sim::RobotId(0)), ended);
}

#[test]
fn cpms_curve_reaches_a_quarter_of_a_metre() {
    let curve = ResponseCurve::cpm();
    assert!((curve.reach() - 0.25).abs() < 1e-12);
    assert!((curve.at(0.0).value - 3800.0).abs() < 1e-9);
    assert!(curve.at(0.25).value.abs() < 1e-9 && curve.at(1.0).value.abs() < 1e-9);
}

#[test]
fn what_is_no_curve_is_refused() {
    let curve = |points: &[(f64, f64)]| {
        let point = |(range, value): &(f64, f64)| ResponsePoint {
            range: *range,
            value: *value,
            relative_sd: 0.0,
        };
        ResponseCurve::new(points.iter().map(point).collect())
            .unwrap_err()
            .to_string()
    };
    assert!(curve(&[]).contains("no points"));
    assert!(curve(&[(0.0, 1.0), (0.0, 0.5)]).contains("point 1"));
    assert!(curve(&[(f64::NAN, 1.0)]).contains("`range` is NaN"));
    let mut config = quiet();
    config.step_us = 0;
    assert!(
        Epuck::new(config)
            .unwrap_err()
            .to_string()
            .contains("step_us")
    );
    let mut config = quiet();
    config.wheels.push(Fault::Slip { share: f64::NAN });
    assert!(
        Epuck::new(config)
            .unwrap_err()
            .to_string()
            .contains("wheels")
    );
}
