//! A world and a robot of any size: systems make the same run.

use alloc::rc::Rc;
use core::cell::RefCell;

use tolman_arena::Simulated;
use tolman_arena::course::Course;
use tolman_arena::pioneer::{CORRIDOR_WIDTH, calibrated, with_sensor_noise};
use tolman_arena::registry::{Registry, RobotFailure, SystemEntry};
use tolman_geom::Pose;
use tolman_robot::{
    Goal, Landmark, LaserMeasures, LaserSensing, MapView, Robot, RobotMeasures, SensesLandmarks,
    StepMeasures, Task, TurnTranslate,
};
use tolman_sim::robots::LaserPioneer;

const FORKS: &str = include_str!("../../mazes/forks.maze");

/// A simulated robot, of which the test sees the path. All lengths that it senses are `size` times
/// as large: so are its world and its body.
struct Magnified {
    robot: Rc<RefCell<Simulated<LaserPioneer>>>,
    size: f64,
    sensing: LaserSensing,
}

impl Robot for Magnified {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = RobotFailure;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), RobotFailure> {
        let mut robot = self.robot.borrow_mut();
        let stepped = robot.step(command);
        stepped.map_err(|error| RobotFailure(error.into()))?;
        self.sensing = robot.sensing().clone();
        if let Some(scan) = &mut self.sensing.scan {
            scan.ring.max_range *= self.size;
            scan.ranges.iter_mut().for_each(|range| *range *= self.size);
        }
        if let Some(rolled) = &mut self.sensing.odometry {
            rolled.distance *= self.size;
        }
        Ok(())
    }
}

impl SensesLandmarks for Magnified {
    fn landmark(&self) -> Option<Landmark> {
        self.robot.borrow().landmark()
    }
}

/// Lets a system explore with a robot `size` times as large as the laser Pioneer, in a world that
/// is, too. Returns its path in the Pioneer's metres, and its map.
fn explored(system: &dyn SystemEntry, size: f64) -> (Vec<Pose>, MapView) {
    let maze = tolman_maze::read(FORKS).unwrap().maze;
    let course = Course::new("forks", maze, CORRIDOR_WIDTH).unwrap();
    let mut config = with_sensor_noise(&calibrated(), 0.03);
    config.ring.max_range *= 2.0;
    let reach = config.ring.max_range * size;
    let laser = LaserMeasures::all_round(config.ring.beams, 0.0, reach);
    let diameter = 2.0 * config.radius * size;
    let mut measures = RobotMeasures::new(diameter, CORRIDOR_WIDTH * size, laser);
    measures.corridor_spacing = Some(course.pitch() * size);
    measures.step = Some(StepMeasures {
        turn: config.turn_per_step,
        distance: config.translate_per_step * size,
    });
    let sensing = LaserSensing::silent(config.ring);
    let model = LaserPioneer::new(config).unwrap();
    let robot = course.robot_at(course.start().unwrap(), model, 7).unwrap();
    let robot = Rc::new(RefCell::new(robot));
    let magnified = Magnified {
        robot: Rc::clone(&robot),
        size,
        sensing,
    };
    let put = system.facts().for_robot.unwrap();
    let mut pilot = put(&measures, Box::new(magnified), 3).unwrap();
    let task = match system.baseline() {
        Some(_) => Task::Reach(Goal::Landmark(Landmark::Goal)),
        None => Task::Explore,
    };
    for _ in 0..ACTIONS {
        pilot.act(task).unwrap();
    }
    let path = robot.borrow().path().to_vec();
    (path, pilot.map())
}

/// Number of actions of a run.
const ACTIONS: u32 = 60;

#[test]
fn a_world_and_a_robot_scaled_by_a_power_of_two_make_the_same_run() {
    let systems = Registry::current().systems.iter();
    let able: Vec<_> = systems.filter(|it| it.facts().for_robot.is_ok()).collect();
    assert_eq!(able.len(), 9);
    for system in able {
        let name = system.name();
        let (path, map) = explored(*system, 1.0);
        assert!(path.len() > 10, "{name} moves");
        for size in [0.125, 0.5, 4.0] {
            let told = format!("{name}, {size} times as large");
            let (scaled_path, scaled_map) = explored(*system, size);
            // To the bit: a robot that turns or rolls otherwise by one bit is elsewhere.
            assert!(path == scaled_path, "{told}");
            assert_eq!(map.links, scaled_map.links, "{told}");
            let larger = map
                .places
                .iter()
                .map(|place| place.position.map(|at| at * size));
            let scaled = scaled_map.places.iter().map(|place| place.position);
            assert!(larger.eq(scaled), "{told}");
        }
    }
}
