//! The simulated e-pucks.

use tolman_arena::cpm::{epuck, slow_epuck, walker_config};
use tolman_control::epuck::Pilot;
use tolman_robot::Robot;
use tolman_sim::robots::{Epuck, EpuckConfig};

use super::trials::maze_1;

#[test]
fn sweeps_last_as_long_as_the_paper_says() {
    let maze = maze_1();
    let sweep = |robot: &EpuckConfig| {
        let body = Epuck::new(robot.clone()).unwrap();
        let body = maze.robot_at(maze.start().unwrap(), body, 1).unwrap();
        let config = walker_config(robot, 0.25).unwrap();
        let mut pilot = Pilot::new(body, config.pilot);
        let samples = pilot.sweep().unwrap().samples.len();
        assert_eq!(samples, 100);
        pilot.robot().sensing().time_us
    };
    assert_eq!(sweep(&slow_epuck()), 3_333_300);
    assert_eq!(sweep(&epuck()), 1_300_000);
    // Real wheels cannot turn a whole sample in 10 ms, as for a sweep of 1 s (section 4.1).
    let mut too_fast = epuck();
    too_fast.step_us = 10_000;
    assert_eq!(sweep(&too_fast), 2_000_000);
}
