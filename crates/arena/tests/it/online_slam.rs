//! The system that corrects its pose while it learns, in the arenas of the place map.

use tolman_arena::Simulated;
use tolman_arena::gngslam::Pitch;
use tolman_arena::pioneer::calibrated;
use tolman_robot::{Goal, Ring, Standing, Stopping, System, Task};
use tolman_sim::robots::{LaserPioneer, Pioneer2dx};
use tolman_systems::gngslam::{OnlineSlam, OnlineSlamConfig};

fn put(pitch: &Pitch, seed: u64) -> Stopping<Simulated<Pioneer2dx>> {
    let robot = pitch.robot(seed, 0.03).unwrap();
    pitch.put(robot, seed).unwrap()
}

#[test]
fn it_drives_back_to_where_it_began() {
    let pitch = Pitch::named("l-room").unwrap();
    let mut robot = put(&pitch, 3);
    let start = robot.truth().pose;
    let mut system = OnlineSlam::new(OnlineSlamConfig::pioneer_2dx(), 3);
    for _ in 0..100 {
        system.act(&mut robot, Task::Explore).unwrap();
    }
    let task = Task::Reach(Goal::Place(0));
    let mut standings = (0..200).map(|_| system.act(&mut robot, task).unwrap());
    let end = standings.find(|standing| *standing != Standing::UnderWay);
    assert_eq!(end, Some(Standing::Done));
    let off = (robot.truth().pose.position - start.position).norm();
    assert!(off < 0.5, "{off}");
}

#[test]
fn a_robot_that_is_lifted_while_it_learns_finds_itself_again() {
    let pitch = Pitch::named("l-room").unwrap();
    let mut robot = put(&pitch, 4);
    let start = robot.truth().pose;
    let mut system = OnlineSlam::new(OnlineSlamConfig::pioneer_2dx(), 4);
    for _ in 0..150 {
        system.act(&mut robot, Task::Explore).unwrap();
    }
    robot.robot_mut().place(pitch.start(77).unwrap()).unwrap();
    system.put_down();
    system.act(&mut robot, Task::Localize).unwrap();
    assert!(!system.graph().is_localized());
    let mut standings = (0..100).map(|_| system.act(&mut robot, Task::Localize).unwrap());
    assert!(standings.any(|standing| standing == Standing::Done));
    let here = start.compose(system.graph().here().unwrap());
    let off = (here.position - robot.truth().pose.position).norm();
    assert!(off < 0.3, "{off}");
}

#[test]
fn a_robot_with_a_laser_and_no_camera_learns_too() {
    let pitch = Pitch::named("l-room").unwrap();
    let start = pitch.start(5).unwrap();
    let mut laser = calibrated();
    laser.ring = Ring::full(90, 4.0);
    let per_step = laser.translate_per_step;
    let model = LaserPioneer::new(laser).unwrap();
    let robot = pitch.course.robot_at(start, model, 5).unwrap();
    let mut robot = Stopping::new(robot);
    let mut config = OnlineSlamConfig::pioneer_2dx();
    config.drive.translate = 0.04 / per_step;
    config.drive.turn = 0.1;
    let mut system = OnlineSlam::new(config, 5);
    for _ in 0..80 {
        system.act(&mut robot, Task::Explore).unwrap();
    }
    let here = start.compose(system.graph().here().unwrap());
    let off = (here.position - robot.truth().pose.position).norm();
    assert!(system.graph().is_localized() && off < 0.25, "{off}");
}
