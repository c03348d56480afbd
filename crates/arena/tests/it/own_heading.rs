//! MSLST Better learns a maze whatever its compass says, since walls tell its heading.

use tolman_arena::Simulated;
use tolman_arena::course::Course;
use tolman_arena::pioneer::{CORRIDOR_WIDTH, calibrated, with_sensor_noise};
use tolman_arena::registry::{AnyRobot, Registry, RobotFailure};
use tolman_geom::Heading;
use tolman_robot::{
    Landmark, LaserMeasures, LaserSensing, Robot, RobotMeasures, SensesLandmarks, Standing,
    StepMeasures, Task, TurnTranslate,
};
use tolman_sim::robots::LaserPioneer;

const FORKS: &str = include_str!("../../../../mazes/forks.maze");

/// A compass: the heading that it gives in a time step for a true one.
type Told = fn(Heading, u32) -> Option<Heading>;

struct WithCompass {
    robot: Simulated<LaserPioneer>,
    told: Told,
    steps: u32,
    sensing: LaserSensing,
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

/// Lets MSLST Better explore the maze and returns the numbers of places and links of its map, and
/// why it doubts it.
fn learned(told: Told, seed: u64) -> (usize, usize, Option<String>) {
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
    let robot = course
        .robot_at(course.start().unwrap(), model, seed)
        .unwrap();
    let robot = WithCompass {
        robot,
        told,
        steps: 0,
        sensing,
    };
    let system = Registry::current().system("mslst-better").unwrap();
    let put = system.facts().for_robot.unwrap();
    let mut pilot = put(&measures, Box::new(robot) as AnyRobot, seed).unwrap();
    for _ in 0..ACTIONS {
        if pilot.act(Task::Explore).unwrap() != Standing::UnderWay {
            break;
        }
    }
    let map = pilot.map();
    (map.places.len(), map.links.len(), pilot.doubt())
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
