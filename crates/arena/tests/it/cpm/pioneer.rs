//! CPM on the laser Pioneer: mazes learned by a robot nearly four times an e-puck's size, without
//! its sensors.

use tolman_arena::course::Course;
use tolman_arena::cpm::{is_whole_map_right, learn_on_pioneer, pioneer_as_epuck};
use tolman_arena::pioneer::{CORRIDOR_WIDTH, CoursePioneer, calibrated};
use tolman_arena::run::{Ended, Limited, TaskEnd, run};
use tolman_maze::Maze;
use tolman_robot::{Goal, Landmark, Mapper, Position, SensesLandmarks, Task};
use tolman_sim::Truth;
use tolman_systems::cpm::{Cpm, CpmConfig, RingAsEpuck, WalkerConfig};

/// Maximum number of time steps. Explorations take 30 000.
const STEP_LIMIT: u32 = 100_000;

/// A loop with two forks, each with a way to a dead end; one of these is the goal.
const FORKS: &str = include_str!("../../../mazes/forks.maze");

/// Returns a maze as a course with corridors for a Pioneer.
fn course(text: &str) -> Course {
    Course::new("", tolman_maze::read(text).unwrap().maze, CORRIDOR_WIDTH).unwrap()
}

/// A Pioneer that looks like an e-puck.
type Epuck = RingAsEpuck<CoursePioneer>;

/// Returns the robot at the start of a maze, which looks like an e-puck, with the configuration of
/// its walker.
fn placed(course: &Course, seed: u64) -> (Epuck, WalkerConfig) {
    pioneer_as_epuck(course, course.start().unwrap(), calibrated(), seed).unwrap()
}

fn truth(epuck: &Epuck) -> &Truth {
    epuck.robot().truth()
}

/// Lets `cpm` pursue a task to its end. Returns its final standing and the number of steps.
fn pursue(cpm: &mut Cpm, epuck: &mut Epuck, task: Task) -> Ended {
    let mut robot = Limited::new(epuck, STEP_LIMIT);
    let ended = run(&mut robot, cpm, task).unwrap();
    assert_eq!(robot.robot().robot().bumps(), 0, "{task:?}");
    ended
}

/// Lets a robot explore, carries it back to the start, lets it find out where it is, and go to the
/// goal.
fn play(mut cpm: Cpm, mut epuck: Epuck, maze: &Maze) {
    let start = truth(&epuck).pose;
    let explored = pursue(&mut cpm, &mut epuck, Task::Explore);
    let map = cpm.explorer().unwrap().mapper.map();
    assert_eq!(explored.end, TaskEnd::Done);
    assert!(is_whole_map_right(map, maze), "{map:?}");
    let goal = map.landmarks(Landmark::Goal).next().unwrap();
    epuck.robot_mut().place(start).unwrap();
    cpm.carried();
    assert_eq!(cpm.belief(), []);
    let localized = pursue(&mut cpm, &mut epuck, Task::Localize);
    assert_eq!(localized.end, TaskEnd::Done);
    assert_eq!(cpm.belief().len(), 1);
    let reached = pursue(
        &mut cpm,
        &mut epuck,
        Task::Reach(Goal::Landmark(Landmark::Goal)),
    );
    assert_eq!(reached.end, TaskEnd::Done);
    assert_eq!(epuck.landmark(), Some(Landmark::Goal));
    assert_eq!(cpm.belief()[0].at, Position::Place(goal.0));
    // Two fragments, without looking round all the way.
    assert!(8 * reached.steps < explored.steps, "{reached:?}");
}

/// Learns with calibrated motors that miss turns by 12 % and distances by 25 %.
#[test]
fn a_pioneer_learns_a_maze_by_its_laser_and_goes_to_the_goal() {
    let forks = course(FORKS);
    for seed in 0..2 {
        let (epuck, config) = placed(&forks, seed);
        let cpm = Cpm::unlearned(config, CpmConfig::robust(), seed).unwrap();
        play(cpm, epuck, &forks.maze);
    }
}

/// Learns as in the paper: with patterns of a learning maze and without dead reckoning.
#[test]
fn a_pioneer_learns_as_the_paper_s_robot_does() {
    let learning = course(include_str!("../../../mazes/cpm-learning.maze"));
    let patterns = learn_on_pioneer(&learning, 1).unwrap();
    let forks = course(FORKS);
    let (epuck, config) = placed(&forks, 1);
    let cpm = Cpm::new(config, patterns, CpmConfig::online(), 1);
    play(cpm, epuck, &forks.maze);
}
