//! CPM's e-puck on the simulator: it follows paths, looks round, finds the middle of junctions, and
//! touches nothing.

use core::f64::consts::PI;

use tolman_control::epuck::{
    MeetPointConfig, Pilot, PilotConfig, PlaceKind, Profile, RangeCurve, SegmentConfig, Segments,
    SensorAlignment,
};
use tolman_control::heading_of;
use tolman_geom::{Point, Pose};
use tolman_maze::{Cell, Maze};
use tolman_sim::noise::Fault;
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_sim::sensors::ResponseCurve;
use tolman_sim::{CorridorSize, Solo, World};

const WIDTH: f64 = 0.25;
/// A sweep of 100 samples at 4.83 rad/s takes one sample a step.
const STEP_US: u64 = 13_000;

fn pilot(maze: &Maze, slip: f64, seed: u64) -> Pilot<Solo<Epuck>> {
    let world = World::from_maze(maze, &CorridorSize::thin(WIDTH)).unwrap();
    let (cell, direction) = maze.start().unwrap();
    let start = Pose::new(world.cell_centre(cell), heading_of(direction));
    let mut robot = EpuckConfig::cpm();
    robot.step_us = STEP_US;
    robot.wheels = vec![Fault::Slip { share: slip }];
    let robot = Epuck::new(robot).unwrap();
    let solo = Solo::new(world, robot, start, seed).unwrap();
    let response = ResponseCurve::cpm();
    let points = (0..=250).map(|millimetre| f64::from(millimetre) * 1e-3);
    let curve = points.map(|range| (range, response.at(range).value));
    let curve = RangeCurve::new(curve.collect()).unwrap();
    Pilot::new(solo, PilotConfig::paper(curve, STEP_US, WIDTH))
}

fn look(pilot: &mut Pilot<Solo<Epuck>>) -> (Profile, Segments) {
    let sweep = pilot.sweep().unwrap();
    let profile = Profile::of(&sweep, SensorAlignment::Mounts).unwrap();
    let segments = profile.segments(&SegmentConfig::cut()).unwrap();
    (profile, segments)
}

/// Returns the robot's offset from its cell's middle, m, and the number of ways out of the cell.
fn truth(pilot: &Pilot<Solo<Epuck>>, maze: &Maze) -> (Point, usize) {
    let solo = pilot.robot();
    let (world, pose) = (solo.simulation().world(), solo.truth().pose);
    let cell = world.cell_at(pose.position).unwrap();
    let off = pose.position - world.cell_centre(cell);
    (Point::from(off), maze.degree(cell))
}

/// Drives for `observations` observations, taking the next branch to the right at junctions. Checks
/// what it sees where it stands near the middle of a cell.
fn drive(maze: &Maze, slip: f64, seed: u64, observations: u32) {
    let mut pilot = pilot(maze, slip, seed);
    let (mut right, mut wrong) = (0, 0);
    for _ in 0..observations {
        let (profile, segments) = look(&mut pilot);
        let (off, degree) = truth(&pilot, maze);
        if off.coords.norm() < 0.06 {
            let seen = match segments.place() {
                PlaceKind::Closed => 0,
                PlaceKind::DeadEnd => 1,
                PlaceKind::Path => 2,
                PlaceKind::Junction => segments.spaces().count(),
            };
            *(if seen == degree {
                &mut right
            } else {
                &mut wrong
            }) += 1;
        }
        match segments.place() {
            PlaceKind::Junction => {
                let config = MeetPointConfig::for_width(WIDTH);
                let mut seen = (profile, segments);
                for _ in 0..3 {
                    let middle = seen.0.meet_point(&pilot.config().curve, &config);
                    pilot.go_to(middle).unwrap();
                    seen = look(&mut pilot);
                }
                let segments = seen.1;
                if segments.place() == PlaceKind::Junction {
                    let (off, _) = truth(&pilot, maze);
                    assert!(off.coords.norm() < 0.06, "{off} is not the middle");
                }
                let way = segments.spaces().nth(1).unwrap_or(0.0);
                pilot.turn(way).unwrap();
                pilot.follow(4.0).unwrap();
            }
            PlaceKind::DeadEnd
                if pilot.ahead().is_some_and(|ahead| ahead < 0.75 * WIDTH)
                    && segments.spaces().all(|way| way.abs() > PI / 2.0) =>
            {
                let way = segments.spaces().next().unwrap();
                pilot.turn(way).unwrap();
                pilot.follow(0.5).unwrap();
            }
            _ => pilot.follow(0.5).unwrap(),
        }
    }
    if slip < 0.2 {
        assert_eq!(
            pilot.robot().bumps(),
            0,
            "slip {slip}, seed {seed}, in {maze}"
        );
    }
    assert!(
        wrong * 5 <= right,
        "{wrong} of {} seen wrongly",
        right + wrong
    );
}

/// Returns every maze of the project that is drawn for this robot.
fn mazes() -> Vec<Maze> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/mazes");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| {
            path.file_name()
                .unwrap()
                .to_string_lossy()
                .starts_with("cpm-")
        })
        .collect();
    files.sort();
    assert!(!files.is_empty());
    let read = |path| tolman_maze::read(&std::fs::read_to_string(path).unwrap()).unwrap();
    files.iter().map(|path| read(path).maze).collect()
}

#[test]
fn it_follows_every_path_without_touching_a_wall() {
    for maze in mazes() {
        for seed in 0..2 {
            drive(&maze, 0.1, seed, 100);
        }
    }
}

/// The robot drives from a fork with a way to the south to the next cell, a fork with a way to the
/// north. It stands off the middle, towards the way to the south, where a fork has the most room.
#[test]
fn between_neighbouring_forks_it_keeps_its_way() {
    let text = "\
start = 1 1 east

o---o---o---o---o
|       |   |   |
o---o---o   o---o
|     S       G |
o---o   o---o---o
|   |   |       |
o---o---o---o---o
";
    let maze = tolman_maze::read(text).unwrap().maze;
    for seed in 0..4 {
        for (aside, turned) in [(-0.045, 0.1), (-0.04, 0.0), (-0.03, 0.15), (0.0, 0.0)] {
            let mut pilot = pilot(&maze, 0.1, seed);
            pilot.turn(-PI / 2.0).unwrap();
            pilot.go_to(Point::new(-aside, 0.0)).unwrap();
            pilot.turn(PI / 2.0 + turned).unwrap();
            pilot.follow(WIDTH / pilot.config().forward.speed).unwrap();
            let pose = pilot.robot().truth().pose;
            let off = pose.position
                - pilot
                    .robot()
                    .simulation()
                    .world()
                    .cell_centre(Cell::new(2, 1));
            assert!(
                pose.heading.radians().abs() < 0.5 && off.norm() < 0.1,
                "{aside} m aside, turned by {turned}: at {off}, {}",
                pose.heading.radians()
            );
            assert_eq!(pilot.robot().bumps(), 0);
        }
    }
}

#[test]
fn wheels_that_slip_by_half_still_find_the_middle_of_junctions() {
    for maze in mazes() {
        drive(&maze, 0.5, 7, 60);
    }
}

#[test]
fn a_sweep_ends_where_it_began() {
    let maze = mazes().remove(0);
    let mut pilot = pilot(&maze, 0.0, 1);
    let before = pilot.robot().truth().pose;
    let sweep = pilot.sweep().unwrap();
    let after = pilot.robot().truth();
    assert_eq!(sweep.samples.len(), 100);
    assert!((after.pose.position - before.position).norm() < 1e-9);
    assert!(before.heading.turn_to(after.pose.heading).abs() < 1e-6);
    // One sample a step: the 1.3 s of wheels that turn no faster.
    assert_eq!(after.tick, 100);
}

#[test]
fn literal_averages_mix_the_bearings() {
    let maze = mazes().remove(0);
    let mut pilot = pilot(&maze, 0.0, 1);
    let sweep = pilot.sweep().unwrap();
    let contrast = |alignment| {
        let profile = Profile::of(&sweep, alignment).unwrap();
        let values = || profile.values().iter().copied();
        values().fold(0.0, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    assert!(contrast(SensorAlignment::Literal) < 0.6 * contrast(SensorAlignment::Mounts));
}
