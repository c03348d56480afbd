//! The robot of the place map wanders in arenas by seed: it gets everywhere and out of everywhere.

use alloc::collections::BTreeSet;

use tolman_arena::gngslam::{DataSet, Pitch, gather};
use tolman_maze::Cell;
use tolman_robot::Robot;
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig, Pioneer2dx, Pioneer2dxConfig};
use tolman_sim::{Solo, StepError};
use tolman_systems::gngslam::{Wanderer, WandererConfig};

/// Results of many legs.
#[derive(Debug)]
struct Wandered {
    /// Share of the steps in which something was touched.
    bumps: f64,
    /// Share of the legs that led nowhere.
    idle: f64,
    /// The cells that the robot was in.
    visited: BTreeSet<Cell>,
}

/// Counts what a robot does.
struct Watched<'a> {
    solo: Solo<Pioneer2dx>,
    pitch: &'a Pitch,
    steps: u32,
    visited: BTreeSet<Cell>,
}

impl Robot for Watched<'_> {
    type Command = tolman_robot::TurnTranslate;
    type Sensing = tolman_robot::pioneer_2dx::Pioneer2dxSensing;
    type Error = StepError;

    fn sensing(&self) -> &Self::Sensing {
        self.solo.sensing()
    }

    fn step(&mut self, command: &Self::Command) -> Result<(), StepError> {
        self.solo.step(command)?;
        self.steps += 1;
        let position = self.solo.truth().pose.position;
        assert!(
            self.pitch.course.leads_on(position),
            "it left the floor: {position}"
        );
        self.visited.insert(self.pitch.cells.cell_of(position));
        Ok(())
    }
}

/// Returns the arena's robot with pictures of a few pixels: nobody looks at them here.
fn quick(pitch: &Pitch, seed: u64) -> Pioneer2dxConfig {
    let mut robot = pitch.robot(seed, 0.03).unwrap();
    robot.camera.width = 4;
    robot.camera.height = 3;
    robot
}

fn wander(pitch: &Pitch, config: WandererConfig, legs: u32, seed: u64) -> Wandered {
    let model = Pioneer2dx::new(quick(pitch, seed)).unwrap();
    let start = pitch.start(seed).unwrap();
    let mut robot = Watched {
        solo: Solo::new(pitch.course.world.clone(), model, start, seed).unwrap(),
        pitch,
        steps: 0,
        visited: BTreeSet::new(),
    };
    let mut wanderer = Wanderer::new(config, seed);
    let (mut idle, mut before) = (0, start.position);
    for _ in 0..legs {
        wanderer.leg(&mut robot).unwrap();
        let here = robot.solo.truth().pose.position;
        idle += u32::from((here - before).norm() < 0.2);
        before = here;
    }
    Wandered {
        bumps: f64::from(robot.solo.bumps()) / f64::from(robot.steps),
        idle: f64::from(idle) / f64::from(legs),
        visited: robot.visited,
    }
}

/// Returns the cells where the middle of the robot can be: those that hold a place with room for
/// half its width.
fn reachable(pitch: &Pitch) -> BTreeSet<Cell> {
    let (bounds, steps) = (pitch.cells.bounds(), 160);
    let points = (0..steps).flat_map(|x| (0..steps).map(move |y| (x, y)));
    let points = points.map(|(x, y)| {
        let along = |index: i32, size: f64| (f64::from(index) + 0.5) / f64::from(steps) * size;
        bounds.min + tolman_geom::Vector::new(along(x, bounds.width()), along(y, bounds.height()))
    });
    let free = points.filter(|point| {
        pitch.course.leads_on(*point) && pitch.course.world.nearest_wall_distance(*point) > 0.4
    });
    free.map(|point| pitch.cells.cell_of(point)).collect()
}

/// Checks that 300 legs miss at most the share `most_missed` of the cells that can be reached.
fn check(pitch: &Pitch, config: WandererConfig, seed: u64, most_missed: f64) {
    let wandered = wander(pitch, config, 300, seed);
    let all = reachable(pitch);
    let missed = all.difference(&wandered.visited).count();
    let name = &pitch.course.name;
    assert!(wandered.bumps < 0.01, "{name}: {}", wandered.bumps);
    assert!(wandered.idle < 0.02, "{name}: {}", wandered.idle);
    let share = missed as f64 / all.len() as f64;
    assert!(share <= most_missed, "{name}: missed {missed}");
}

#[test]
fn it_gets_everywhere_and_out_of_everywhere() {
    for seed in 0..20 {
        let pitch = Pitch::random(seed).unwrap();
        check(&pitch, WandererConfig::near_and_far(), seed, 0.1);
    }
}

/// By the paper's limits the robot reaches the cells in the corners by luck alone.
#[test]
fn by_the_papers_limits_it_gets_nearly_everywhere() {
    for name in ["pitch", "hall", "l-room"] {
        let pitch = Pitch::named(name).unwrap();
        check(&pitch, WandererConfig::paper(), 1, 0.3);
        check(&pitch, WandererConfig::near_and_far(), 1, 0.1);
    }
}

fn data(seed: u64) -> DataSet {
    let pitch = Pitch::named("pitch").unwrap();
    gather(&pitch, quick(&pitch, seed), seed, 300).unwrap()
}

/// Checks the labels, of which one in a hundred is wrong, and the goals, which lie straight ahead
/// of their records.
#[test]
fn the_truth_is_written_down_beside_the_records() {
    let (data, pitch) = (data(1), Pitch::named("pitch").unwrap());
    let wrong = data
        .records
        .iter()
        .filter(|record| record.label != record.cell);
    assert_eq!(wrong.count(), 3);
    for record in &data.records {
        assert_eq!(record.cell, pitch.cells.cell_of(record.truth.position));
    }
    let goals = [
        (data.goals.blue, pitch.goals.blue),
        (data.goals.yellow, pitch.goals.yellow),
    ];
    for (index, goal) in goals {
        let truth = data.records[index].truth;
        let towards = tolman_geom::Heading::of(goal.position - truth.position);
        let aside = truth.heading.turn_to(towards).to_degrees();
        assert!(aside.abs() < 15.0, "{aside}°");
        assert!((goal.position - truth.position).norm() < 2.5);
    }
    assert_ne!(data.goals.blue, data.goals.yellow);
}

#[test]
fn the_same_seed_gathers_the_same_data() {
    assert_eq!(data(2), data(2));
    assert_ne!(data(2), data(3));
}

/// Any robot that turns, translates and senses ranges wanders: this one has a ring of laser beams
/// and no camera.
#[test]
fn a_robot_with_a_laser_wanders_too() {
    let pitch = Pitch::named("pitch").unwrap();
    let model = LaserPioneer::new(LaserPioneerConfig::noiseless()).unwrap();
    let start = pitch.start(1).unwrap();
    let mut robot = Solo::new(pitch.course.world.clone(), model, start, 1).unwrap();
    let mut config = WandererConfig::paper();
    config.drive.translate = 0.08;
    config.drive.turn = 0.15;
    let mut wanderer = Wanderer::new(config, 1);
    for _ in 0..50 {
        let record = wanderer.leg(&mut robot).unwrap();
        assert_eq!(record.snapshot.soundings.len(), 72);
        assert_eq!(record.snapshot.picture, None);
        let there = start.compose(record.odometry).position;
        assert!((there - robot.truth().pose.position).norm() < 1e-6);
    }
    assert_eq!(robot.bumps(), 0);
}

#[test]
fn arenas_have_names() {
    for name in ["pitch", "hall", "l-room", "random-12"] {
        assert_eq!(Pitch::named(name).unwrap().course.name, name);
    }
    let told = Pitch::named("beach").unwrap_err().to_string();
    assert!(
        told.starts_with("no arena is called \"beach\"; the arenas are"),
        "{told}"
    );
    let told = Pitch::named("pitch")
        .unwrap()
        .robot(1, 0.9)
        .unwrap_err()
        .to_string();
    assert_eq!(told, "`calibration` is 0.9; give a share from 0 to 0.5");
}
