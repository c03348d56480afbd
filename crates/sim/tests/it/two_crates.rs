//! A robot in a world with two crates, `tolman-sim` and `tolman-robot`: all else is reached through
//! them.

use tolman_robot::epuck::{EpuckSensing, WheelSpeeds};
use tolman_robot::geom::nalgebra::Rotation2;
use tolman_robot::{Body, LaserSensing, Robot, TurnTranslate};
use tolman_sim::geom::{Heading, Point, Pose, Vector};
use tolman_sim::maze::{Cell, Direction, Grid, Maze};
use tolman_sim::rand::{Rng, RngExt};
use tolman_sim::robot::Odometry;
use tolman_sim::robots::{Epuck, EpuckConfig, LaserPioneer, LaserPioneerConfig};
use tolman_sim::{
    Chance, Channel, CommandError, Contact, CorridorSize, Draws, Model, Motion, Solo, Surroundings,
    WallSegment, World,
};

#[test]
fn a_robot_is_built_stepped_and_read() {
    let mut maze = Maze::solid(Grid::new(3, 1));
    maze.set_goals(vec![Cell::new(2, 0)]);
    for x in 0..2 {
        maze.set_wall(Cell::new(x, 0), Direction::East, false);
    }
    let world = World::from_maze(&maze, &CorridorSize::thin(0.95)).unwrap();
    let start = Pose::new(world.cell_centre(Cell::new(0, 0)), Heading::EAST);
    let robot = LaserPioneer::new(LaserPioneerConfig::noiseless()).unwrap();
    let mut solo = Solo::new(world, robot, start, 7).unwrap();
    let command = TurnTranslate {
        turn: 0.0,
        translate: 0.5,
    };
    solo.step(&command).unwrap();
    let sensing: &LaserSensing = solo.sensing();
    let Odometry { distance, .. } = sensing.odometry.unwrap();
    let moved: Vector = solo.truth().pose.position - start.position;
    assert!((moved.norm() - distance).abs() < 1e-12);
    assert!(sensing.scan.as_ref().unwrap().ranges[0] > 1.0);
}

#[test]
fn an_epuck_meets_a_wall_of_free_segments() {
    let wall = WallSegment::between(Point::new(0.06, -1.0), Point::new(0.06, 1.0));
    let turned = Rotation2::new(0.0) * Vector::new(0.0, 0.0);
    let start = Pose::new(Point::from(turned), Heading::EAST);
    let robot = Epuck::new(EpuckConfig::cpm()).unwrap();
    let world = World::from_segments(vec![wall]).unwrap();
    let mut solo = Solo::new(world, robot, start, 7).unwrap();
    let ahead = WheelSpeeds {
        left: 1.0,
        right: 1.0,
    };
    for _ in 0..200 {
        solo.step(&ahead).unwrap();
    }
    let sensing: &EpuckSensing = solo.sensing();
    assert_eq!(sensing.bump, Some(true));
}

/// A robot of one's own, which jumps about at random.
#[derive(Debug)]
struct Flea(Body);

impl Model for Flea {
    type Command = Motion;
    type Sensing = Option<Point>;

    fn body(&self) -> &Body {
        &self.0
    }

    fn contact(&self) -> Contact {
        Contact::Stop
    }

    fn step_us(&self) -> u64 {
        1000
    }

    fn check(&self, command: &Motion) -> Result<(), CommandError> {
        CommandError::check("distance", command.distance)
    }

    fn motion(&mut self, command: &Motion, chance: &Chance) -> Motion {
        let mut draws: Draws = chance.draws(Channel::named("jump"));
        Motion {
            distance: command.distance * random_share(&mut draws),
            turn: 0.0,
        }
    }

    fn silent(&self) -> Option<Point> {
        None
    }

    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, sensing: &mut Option<Point>) {
        *sensing = Some(around.truth.pose.position);
    }
}

fn random_share(rng: &mut impl Rng) -> f64 {
    f64::from(rng.random::<u32>()) / f64::from(u32::MAX)
}

#[test]
fn a_model_of_ones_own_runs() {
    let wall = WallSegment::between(Point::new(9.0, -1.0), Point::new(9.0, 1.0));
    let world = World::from_segments(vec![wall]).unwrap();
    let flea = Flea(Body::Circle { radius: 0.01 });
    let start = Pose::new(Point::origin(), Heading::EAST);
    let mut solo = Solo::new(world, flea, start, 7).unwrap();
    let jump = Motion {
        distance: 1.0,
        turn: 0.0,
    };
    solo.step(&jump).unwrap();
    assert!((0.0..=1.0).contains(&solo.sensing().unwrap().x));
}

#[test]
fn this_file_names_no_third_crate() {
    let own = include_str!("two_crates.rs");
    let paths = own.lines().filter_map(|line| line.strip_prefix("use "));
    for path in paths {
        assert!(
            path.starts_with("tolman_sim::") || path.starts_with("tolman_robot::"),
            "{path}"
        );
    }
}
