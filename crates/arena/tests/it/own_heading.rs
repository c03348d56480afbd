//! MSLST Better learns a maze whatever its compass says, since walls tell its heading.

use alloc::rc::Rc;
use core::cell::Cell;

use tolman_arena::Simulated;
use tolman_arena::course::Course;
use tolman_arena::pioneer::{CORRIDOR_WIDTH, calibrated, with_sensor_noise};
use tolman_arena::registry::{AnyRobot, Registry, RobotFailure};
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{
    Goal, Landmark, LaserMeasures, LaserSensing, Robot, RobotMeasures, SensesLandmarks, Standing,
    StepMeasures, Task, TurnTranslate,
};
use tolman_sim::robots::LaserPioneer;
use tolman_systems::AnyOnRobot;

const FORKS: &str = include_str!("../../mazes/forks.maze");

/// A compass: the heading that it gives in a time step for a true one.
type Told = fn(Heading, u32) -> Option<Heading>;

struct WithCompass {
    robot: Simulated<LaserPioneer>,
    told: Told,
    steps: u32,
    sensing: LaserSensing,
    /// Where it truly is, m.
    at: Rc<Cell<Point>>,
}

impl Robot for WithCompass {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = RobotFailure;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), RobotFailure> {
        let stepped = self.robot.step(command);
        stepped.map_err(|error| RobotFailure(error.into()))?;
        self.steps += 1;
        self.at.set(self.robot.path().last().unwrap().position);
        self.sensing = self.robot.sensing().clone();
        let compass = self.sensing.compass;
        self.sensing.compass = compass.and_then(|true_one| (self.told)(true_one, self.steps));
        Ok(())
    }
}

impl SensesLandmarks for WithCompass {
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}

/// Lets MSLST Better explore the maze. Returns it, where it began, and where its robot truly is.
fn explored(told: Told, seed: u64) -> (Box<dyn AnyOnRobot>, Pose, Rc<Cell<Point>>) {
    let maze = tolman_maze::read(FORKS).unwrap().maze;
    let course = Course::new("forks", maze, CORRIDOR_WIDTH).unwrap();
    let config = with_sensor_noise(&calibrated(), 0.03);
    let laser = LaserMeasures::all_round(config.ring.beams, 0.0, 2.0 * config.ring.max_range);
    let mut measures = RobotMeasures::new(2.0 * config.radius, CORRIDOR_WIDTH, laser);
    measures.compass_error = None;
    measures.step = Some(StepMeasures {
        turn: config.turn_per_step,
        distance: config.translate_per_step,
    });
    let sensing = LaserSensing::silent(config.ring);
    let model = LaserPioneer::new(config).unwrap();
    let start = course.start().unwrap();
    let robot = course.robot_at(start, model, seed).unwrap();
    let at = Rc::new(Cell::new(robot.path().last().unwrap().position));
    let robot = WithCompass {
        robot,
        told,
        steps: 0,
        sensing,
        at: Rc::clone(&at),
    };
    let system = Registry::current().system("mslst-better").unwrap();
    let put = system.facts().for_robot.unwrap();
    let mut pilot = put(&measures, Box::new(robot) as AnyRobot, seed).unwrap();
    for _ in 0..ACTIONS {
        if pilot.act(Task::Explore).unwrap() != Standing::UnderWay {
            break;
        }
    }
    (pilot, start, at)
}

/// Lets MSLST Better explore the maze and returns the numbers of places and links of its map, and
/// why it doubts it.
fn learned(told: Told, seed: u64) -> (usize, usize, Option<String>) {
    let (pilot, ..) = explored(told, seed);
    let map = pilot.map();
    (map.places.len(), map.links.len(), pilot.doubt())
}

#[test]
fn it_goes_to_any_place_and_any_point_of_its_map() {
    let (mut pilot, start, at) = explored(|heading, _| Some(heading), 3);
    let map = pilot.map();
    let position = |id: u32| {
        let mut places = map.places.iter();
        places
            .find(|place| place.id == id)
            .unwrap()
            .position
            .unwrap()
    };
    let places = map.places.iter().map(|place| Goal::Place(place.id));
    let ways = map.ways.iter().map(|way| Goal::Point(way[way.len() / 2]));
    let mut reached = 0;
    for goal in places.chain(ways).step_by(2) {
        let wanted = match goal {
            Goal::Place(id) => position(id),
            Goal::Point(at) => at,
            Goal::Landmark(_) => continue,
        };
        let mut standing = Standing::UnderWay;
        for _ in 0..ACTIONS {
            standing = pilot.act(Task::Reach(goal)).unwrap();
            if standing != Standing::UnderWay {
                break;
            }
        }
        assert_eq!(standing, Standing::Done, "{goal:?}");
        // Its map begins where the robot did.
        let off = (at.get() - start.transform(wanted)).norm();
        assert!(off < CORRIDOR_WIDTH, "{goal:?}: {off:.2} m");
        reached += 1;
    }
    assert!(reached > 5, "{reached} goals");
    let outside = Goal::Point(Point::new(100.0, 0.0));
    let refused = pilot.act(Task::Reach(outside)).unwrap();
    assert_eq!(refused, Standing::gave_up("its map has no floor there"));
}

/// Maximum number of actions of a run.
const ACTIONS: u32 = 600;

#[test]
fn a_map_is_learned_without_a_compass() {
    let exact: Told = |heading, _| Some(heading);
    let none: Told = |_, _| None;
    let from_anywhere: Told = |heading, _| Some(heading.turned(2.2));
    // A gyro that drifts by 1° a minute.
    let drifting: Told = |heading, steps| {
        let minutes = f64::from(steps) / 600.0;
        Some(heading.turned(minutes.to_radians()))
    };
    let expected = learned(exact, 3);
    assert_eq!(expected.2, None);
    for (name, told) in [
        ("none", none),
        ("zero anywhere", from_anywhere),
        ("drift", drifting),
    ] {
        for seed in 3..5 {
            assert_eq!(learned(told, seed), expected, "{name}, seed {seed}");
        }
    }
}
