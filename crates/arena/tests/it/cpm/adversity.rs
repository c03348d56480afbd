//! CPM in worlds, and with sensors, for which it was not made. It must always end: with an error
//! that says what is wrong, or without the goal, and then it must say so.

use alloc::sync::Arc;
use core::f64::consts::{PI, TAU};

use tolman_arena::cpm::{CpmRun, SimulatedEpuck, epuck, walker_config};
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::epuck::{EpuckSensing, PROXIMITY_SENSORS, WheelSpeeds};
use tolman_robot::{Landmark, Robot, SensesLandmarks};
use tolman_sim::robots::Epuck;
use tolman_sim::{Area, StepError, WallSegment, World, Zone};
use tolman_systems::cpm::{Aim, CpmConfig, CpmFailure, CpmRobot, Done, EpisodeSummary, Mode};

use super::trials::{PATTERNS, maze_1};

const WIDTH: f64 = 0.25;

/// A robot one of whose sensors always reads the same.
#[derive(Debug)]
struct OneSensor {
    body: SimulatedEpuck,
    sensor: usize,
    value: f64,
    sensing: EpuckSensing,
}

impl OneSensor {
    fn new(body: SimulatedEpuck, sensor: usize, value: f64) -> Self {
        let sensing = EpuckSensing::default();
        let mut robot = Self {
            body,
            sensor,
            value,
            sensing,
        };
        robot.read();
        robot
    }

    fn read(&mut self) {
        self.sensing = *self.body.sensing();
        if let Some(values) = &mut self.sensing.proximity {
            values[self.sensor] = self.value;
        }
    }
}

impl Robot for OneSensor {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = StepError;

    fn sensing(&self) -> &EpuckSensing {
        &self.sensing
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), StepError> {
        self.body.step(command)?;
        self.read();
        Ok(())
    }
}

impl SensesLandmarks for OneSensor {
    fn landmark(&self) -> Option<Landmark> {
        self.body.landmark()
    }
}

/// Plays the first episode. Returns its result, and whether the robot truly ends at the goal.
fn search<B: CpmRobot>(
    body: B,
    width: f64,
) -> Result<(EpisodeSummary, bool), CpmFailure<B::Error>> {
    // Enough for worlds of this size.
    let mut config = CpmConfig::online();
    config.most_traversals = 20;
    let mut walker = walker_config(&epuck(), width).unwrap();
    walker.longest_fragment = 150;
    let mut run = CpmRun::begin(body, walker, &PATTERNS, Mode::Paper(config), 1)?;
    let episode = run.pursue(Aim::Find(Landmark::Goal), |_, _, _| {})?;
    let is_there = run.walker.body().landmark() == Some(Landmark::Goal);
    Ok((episode, is_there))
}

#[test]
fn one_sensor_that_fails_ends_in_an_error_or_as_it_is_said() {
    let maze = maze_1();
    let start = maze.start().unwrap();
    let body = || {
        maze.robot_at(start, Epuck::new(epuck()).unwrap(), 1)
            .unwrap()
    };
    let (mut blind_reached, mut stuck_told) = (0, 0);
    for sensor in 0..PROXIMITY_SENSORS {
        // A sensor that is not there sees nothing, one that is stuck a wall that touches it.
        for value in [0.0, 3800.0] {
            match search(OneSensor::new(body(), sensor, value), WIDTH) {
                Ok((episode, is_there)) => {
                    assert_eq!(episode.done == Done::Reached, is_there, "{sensor} {value}");
                    blind_reached += u32::from(is_there);
                    assert!(!is_there || value == 0.0, "sensor {sensor} is stuck");
                }
                Err(error) => {
                    assert!(error.to_string().contains("check the sensors"), "{error}");
                    stuck_told += u32::from(value > 0.0);
                }
            }
        }
        let broken = search(OneSensor::new(body(), sensor, f64::NAN), WIDTH);
        let error = broken.unwrap_err().to_string();
        assert!(
            error.contains(&format!("of sensor {sensor} is not finite")),
            "{error}"
        );
    }
    // Most of them can be done without; with none can the robot drive through a wall that it always
    // sees.
    assert!(blind_reached >= 5, "{blind_reached} reached");
    assert!(stuck_told >= 3, "{stuck_told} told");
}

/// Returns a world of `branches` corridors that meet in its middle, each 0.8 m long. The robot
/// starts at the end of the first; the goal is at the end of the one across.
fn star(branches: u32, width: f64) -> (World, Pose) {
    let (length, half) = (0.8, width / 2.0);
    let spacing = TAU / f64::from(branches);
    // Where the walls of neighbouring corridors meet.
    let meet = half / libm::tan(spacing / 2.0);
    let mut walls = Vec::new();
    for branch in 0..branches {
        let ahead = Heading::from_radians(spacing * f64::from(branch)).unit();
        let left = Vector::new(-ahead.y, ahead.x);
        let at = |along: f64, aside: f64| Point::from(ahead * along + left * aside);
        walls.push(WallSegment::between(at(meet, half), at(length, half)));
        walls.push(WallSegment::between(at(meet, -half), at(length, -half)));
        walls.push(WallSegment::between(at(length, half), at(length, -half)));
    }
    let end = |branch: u32| {
        let ahead = Heading::from_radians(spacing * f64::from(branch));
        Point::from(ahead.unit() * (length - half))
    };
    let zone = |name, centre| {
        let area = Area::Disc {
            centre,
            radius: half,
        };
        Zone::new(name, vec![area])
    };
    let world = World::from_segments(walls).unwrap();
    let world = world.with_zone(zone("start", end(0))).unwrap();
    let world = world
        .with_zone(zone("destination", end(branches / 2)))
        .unwrap();
    (world, Pose::new(end(0), Heading::from_radians(PI)))
}

/// A junction may have more branches than a feature has room for. "The vector's size might be more
/// than ten if the junction size is larger than five ways." In corridors of its width the middle is
/// a room whose walls the robot does not see.
#[test]
fn junctions_of_many_branches_end_in_an_error_or_as_it_is_said() {
    for (branches, width) in [(5, 0.25), (8, 0.15), (10, 0.12), (10, 0.25)] {
        let (world, start) = star(branches, width);
        let robot = Epuck::new(epuck()).unwrap();
        let body = SimulatedEpuck::new(Arc::new(world), robot, start, 1).unwrap();
        match search(body, width) {
            Ok((episode, is_there)) => {
                assert_eq!(
                    episode.done == Done::Reached,
                    is_there,
                    "{branches} {width}"
                );
            }
            Err(error) => assert!(error.to_string().contains("check"), "{branches}: {error}"),
        }
    }
}
