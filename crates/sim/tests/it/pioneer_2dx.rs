//! The Pioneer 2-DX: its sonars, its camera and its wheels.

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::pioneer_2dx::{self, SONAR_MOST, SONARS};
use tolman_robot::{Picture, Robot, TakesSnapshots, TurnTranslate};
use tolman_sim::noise::Fault;
use tolman_sim::robots::{Pioneer2dx, Pioneer2dxConfig, Pioneer2dxError, WheelScale};
use tolman_sim::sensors::{Light, LightDrift};
use tolman_sim::trace::{Detail, Recording, replay};
use tolman_sim::{Material, Solo, WallSegment, World};

const WHITE: [u8; 3] = [255, 255, 255];
const BLUE: [u8; 3] = [0, 0, 255];
const RED: [u8; 3] = [255, 0, 0];

fn wall(start: (f64, f64), end: (f64, f64), material: Material) -> WallSegment {
    WallSegment {
        start: Point::new(start.0, start.1),
        end: Point::new(end.0, end.1),
        material,
    }
}

/// Returns a room with white boarding 2 m to every side; in the north it is blue.
fn room() -> World {
    let low = |colour| Material::painted(colour).standing(0.0, 0.4);
    World::from_segments(vec![
        wall((-2.0, -2.0), (2.0, -2.0), low(WHITE)),
        wall((2.0, -2.0), (2.0, 2.0), low(WHITE)),
        wall((2.0, 2.0), (-2.0, 2.0), low(BLUE)),
        wall((-2.0, 2.0), (-2.0, -2.0), low(WHITE)),
    ])
    .unwrap()
}

fn robot(world: World, config: Pioneer2dxConfig, pose: Pose) -> Solo<Pioneer2dx> {
    Solo::new(world, Pioneer2dx::new(config).unwrap(), pose, 1).unwrap()
}

fn picture(world: World, pose: Pose) -> Picture {
    let solo = robot(world, Pioneer2dxConfig::noiseless(), pose);
    solo.sensing().picture.clone().unwrap()
}

fn facing(heading: Heading) -> Pose {
    Pose::new(Point::origin(), heading)
}

/// Facing a corner, the robot sees the blue wall on its left in the left half of the picture.
#[test]
fn what_is_on_the_robots_left_is_on_the_left_of_the_picture() {
    let picture = picture(room(), facing(Heading::from_degrees(45.0)));
    let blue = |column: u32| (0..60).any(|row| picture.pixel(column, row) == Some(BLUE));
    let columns: Vec<u32> = (0..80).filter(|column| blue(*column)).collect();
    assert_eq!(columns, (0..40).collect::<Vec<u32>>());
}

/// The foot of a wall z m ahead is seen at −0.3 / z and its top at (0.4 − 0.3) / z. By hand, that
/// is rows 51.5 and 22.8 for 1.25 m.
#[test]
fn the_foot_and_the_top_of_a_wall_are_at_their_rows() {
    let low = Material::painted(WHITE).standing(0.0, 0.4);
    let world = World::from_segments(vec![wall((1.25, -3.0), (1.25, 3.0), low)]).unwrap();
    let config = Pioneer2dxConfig::noiseless();
    let backdrop = config.camera.backdrop;
    let picture = picture(world, facing(Heading::EAST));
    for column in [0, 40, 79] {
        let seen = |row| picture.pixel(column, row).unwrap();
        assert_eq!(seen(22), backdrop.ceiling);
        assert_eq!(seen(23), WHITE);
        assert_eq!(seen(51), WHITE);
        assert_eq!(seen(52), backdrop.floor);
    }
}

/// A window above a low wall is seen over it, from its sill to its lintel.
#[test]
fn what_stands_behind_a_low_wall_is_seen_above_it() {
    let world = World::from_segments(vec![
        wall(
            (1.0, -3.0),
            (1.0, 3.0),
            Material::painted(WHITE).standing(0.0, 0.4),
        ),
        wall(
            (2.0, -3.0),
            (2.0, 3.0),
            Material::painted(RED).standing(0.6, 0.8),
        ),
        wall((3.0, -9.0), (3.0, 9.0), Material::painted(BLUE)),
    ])
    .unwrap();
    let picture = picture(world, facing(Heading::EAST));
    let column: Vec<[u8; 3]> = (0..60).map(|row| picture.pixel(40, row).unwrap()).collect();
    let mut seen = column.clone();
    seen.dedup();
    let floor = Pioneer2dxConfig::noiseless().camera.backdrop.floor;
    assert_eq!(seen, [BLUE, RED, BLUE, WHITE, floor]);
}

#[test]
fn pictures_are_taken_standing_still() {
    let config = Pioneer2dxConfig::noiseless();
    let mut solo = robot(room(), config, facing(Heading::EAST));
    assert!(solo.sensing().snapshot().is_some());
    let turn = TurnTranslate {
        turn: 0.1,
        translate: 0.0,
    };
    solo.step(&turn).unwrap();
    assert!(solo.sensing().snapshot().is_none());
    solo.step(&TurnTranslate::STOP).unwrap();
    assert!(solo.sensing().snapshot().is_some());
}

/// In a corner every sonar reads the wall as it stands, from its own mount.
#[test]
fn sonars_read_the_nearest_point_in_their_cones() {
    let solo = robot(room(), Pioneer2dxConfig::noiseless(), facing(Heading::EAST));
    let ranges = solo.sensing().sonars.unwrap();
    // Straight to the left, and 10° to the left of ahead, where the nearest is 2.5° from straight
    // on.
    assert!((ranges[0] - (2.0 - 0.136)).abs() < 1e-9);
    let slant = (2.0 - 0.166) / libm::cos(2.5_f64.to_radians());
    assert!((ranges[3] - slant).abs() < 1e-9, "{}", ranges[3]);
    for sonar in 0..SONARS / 2 {
        let mirrored = ranges[7 - sonar];
        assert!((ranges[sonar] - mirrored).abs() < 1e-9, "{ranges:?}");
    }
}

#[test]
fn sonars_read_their_most_where_nothing_is() {
    let far =
        World::from_segments(vec![wall((9.0, 0.0), (9.0, 1.0), Material::default())]).unwrap();
    let solo = robot(far, Pioneer2dxConfig::paper(), facing(Heading::EAST));
    let ranges = solo.sensing().sonars.unwrap();
    assert!(
        ranges
            .iter()
            .all(|range| (range - SONAR_MOST).abs() < 1e-12)
    );
}

/// Other robots are heard, and seen.
#[test]
fn robots_meet_each_other() {
    let model = || Pioneer2dx::new(Pioneer2dxConfig::noiseless()).unwrap();
    let mut simulation = tolman_sim::Simulation::new(room(), 1);
    let here = simulation.add(model(), facing(Heading::EAST)).unwrap();
    let there = Pose::new(Point::new(1.0, 0.0), Heading::EAST);
    simulation.add(model(), there).unwrap();
    simulation.step(&[TurnTranslate::STOP; 2]).unwrap();
    let gap = 1.0 + pioneer_2dx::FRONT - pioneer_2dx::LENGTH - 0.166;
    let ahead = simulation.sensing(here).sonars.unwrap()[3];
    assert!(
        (ahead * libm::cos(2.5_f64.to_radians()) - gap).abs() < 1e-6,
        "{ahead}"
    );
}

/// One wheel counts 3 % too much and the other 3 % too little, so that a straight counts as a bend.
#[test]
fn odometry_follows_wheels_that_count_wrongly() {
    let scale = WheelScale {
        left: 1.03,
        right: 0.98,
    };
    let config = Pioneer2dxConfig::noiseless().with_wheel_scale(scale);
    let mut solo = robot(room(), config, facing(Heading::EAST));
    let ahead = TurnTranslate {
        turn: 0.0,
        translate: 1.0,
    };
    solo.step(&ahead).unwrap();
    let rolled = solo.sensing().odometry.unwrap();
    assert!((rolled.distance - 0.04 * 1.005).abs() < 1e-12);
    let bend = -0.05 * 0.04 / pioneer_2dx::TRACK;
    assert!((rolled.turn - bend).abs() < 1e-12, "{rolled:?}");
}

/// Without noise the odometry is the truth, bends included.
#[test]
fn perfect_wheels_know_where_the_robot_is() {
    let mut solo = robot(room(), Pioneer2dxConfig::noiseless(), facing(Heading::EAST));
    let mut pose = Pose::IDENTITY;
    for step in 0..40 {
        let command = TurnTranslate {
            turn: if step % 3 == 0 { 0.5 } else { -0.1 },
            translate: 0.7,
        };
        solo.step(&command).unwrap();
        pose = solo.sensing().odometry.unwrap().applied_to(pose);
    }
    let apart = pose.position - solo.truth().pose.position;
    assert!(apart.norm() < 1e-9, "{apart}");
}

fn mean(picture: &Picture) -> f64 {
    let values = picture.pixels.iter().flatten().map(|part| f64::from(*part));
    values.sum::<f64>() / (3.0 * picture.pixels.len() as f64)
}

/// Light changes slowly from picture to picture: successive pictures are more alike than distant
/// ones.
#[test]
fn light_drifts_slowly() {
    let mut config = Pioneer2dxConfig::noiseless();
    config.camera.light = Light {
        drift: LightDrift {
            pictures: 30.0,
            brightness_sd: 0.1,
            ..LightDrift::default()
        },
        brightness: 0.6,
        ..Light::steady()
    };
    let mut solo = robot(room(), config, facing(Heading::EAST));
    let mut means = Vec::new();
    for _ in 0..300 {
        solo.step(&TurnTranslate::STOP).unwrap();
        means.push(mean(solo.sensing().picture.as_ref().unwrap()));
    }
    let apart = |lag: usize| {
        let pairs = means.iter().zip(&means[lag..]);
        let squares: Vec<f64> = pairs.map(|(a, b)| (a - b) * (a - b)).collect();
        squares.iter().sum::<f64>() / squares.len() as f64
    };
    assert!(apart(1) > 0.0);
    assert!(apart(60) > 5.0 * apart(1), "{} {}", apart(60), apart(1));
}

#[test]
fn windows_glare_over_the_picture() {
    let with_glow = |glow| {
        let window = Material::painted(WHITE).glowing(glow);
        let mut walls = room().walls().to_vec();
        walls.push(wall((2.5, -9.0), (2.5, 9.0), window));
        let mut config = Pioneer2dxConfig::noiseless();
        config.camera.light.glare = 0.5;
        let world = World::from_segments(walls).unwrap();
        let solo = robot(world, config, facing(Heading::EAST));
        solo.sensing()
            .picture
            .as_ref()
            .unwrap()
            .pixel(40, 59)
            .unwrap()
    };
    let (without, with) = (with_glow(0.0), with_glow(1.0));
    assert!(with[0] > without[0] + 20, "{with:?} {without:?}");
}

/// A run with all noise on depends on nothing but its seed, and its trace can be replayed.
#[test]
fn a_noisy_run_is_replayed_to_the_bit() {
    let mut config = Pioneer2dxConfig::paper();
    config
        .faults
        .sonars
        .push(Fault::DropOut { probability: 0.1 });
    config.faults.picture.push(Fault::Outliers {
        probability: 0.01,
        low: 0.0,
        high: 255.0,
    });
    let robot = Pioneer2dx::new(config).unwrap();
    let mut file = Vec::new();
    let robots = vec![(robot, facing(Heading::NORTH))];
    let mut recording = Recording::start(room(), 5, robots, &mut file, Detail::Sensing).unwrap();
    for step in 0..30 {
        let turn = if step % 5 == 4 { 0.0 } else { 0.3 };
        let translate = turn * 2.0;
        recording
            .step(&[TurnTranslate { turn, translate }])
            .unwrap();
    }
    recording.finish().unwrap();
    assert_eq!(replay::<Pioneer2dx>(file.as_slice()).unwrap().tick(), 30);
}

#[test]
fn a_configuration_survives_json_and_its_faults_are_named() {
    let config = Pioneer2dxConfig::paper();
    let json = serde_json::to_string(&config).unwrap();
    assert_eq!(
        serde_json::from_str::<Pioneer2dxConfig>(&json).unwrap(),
        config
    );
    let told = |change: fn(&mut Pioneer2dxConfig)| {
        let mut config = Pioneer2dxConfig::paper();
        change(&mut config);
        Pioneer2dx::new(config).unwrap_err().to_string()
    };
    let wheel = told(|config| config.wheel_scale.left = f64::NAN);
    assert_eq!(
        wheel,
        "`wheel_scale.left` is NaN; give a number from 0 to 1000"
    );
    let levels = told(|config| config.camera.levels = 1);
    assert_eq!(
        levels,
        "`camera`: `levels` is 1; give a number from 2 to 256"
    );
    let cone = told(|config| config.sonar.half_width = 2.0);
    assert!(
        cone.starts_with("`sonar`: `half_width` is 2; give"),
        "{cone}"
    );
    let fault = told(|config| config.faults.sonars.push(Fault::Slip { share: -1.0 }));
    assert!(fault.starts_with("`faults.sonars`, fault 0"), "{fault}");
    let mut config = Pioneer2dxConfig::paper();
    config.step_us = 0;
    assert_eq!(
        Pioneer2dx::new(config).unwrap_err(),
        Pioneer2dxError::NoTime
    );
}
