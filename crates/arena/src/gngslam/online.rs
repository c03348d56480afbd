//! Runs the system that corrects its pose while it learns, and keeps the truth beside.

use core::ops::Range;

use thiserror::Error;
use tolman_geom::{Point, Pose};
use tolman_maps::place_graph::PlaceGraph;
use tolman_robot::{Reckoned, Stopping, System, Task};
use tolman_sim::StepError;
use tolman_sim::robots::Pioneer2dx;
use tolman_systems::gngslam::{OnlineSlam, OnlineSlamConfig, OnlineSlamError};

use super::laid_over::rigid_motion;
use super::{Pitch, PutError};
use crate::Simulated;

/// True and believed poses of a robot at a look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookedFrom {
    /// True pose of the robot at the look.
    pub truth: Pose,
    /// Pose that the system believes in.
    pub corrected: Pose,
    /// Pose by odometry alone, from the true first pose.
    pub reckoned: Pose,
    /// Whether the system knew where it was.
    pub is_localized: bool,
    /// Distance that the wheels had rolled, m.
    pub rolled: f64,
}

/// A run of the online system in an arena.
#[derive(Clone, Debug)]
pub struct OnlineRun {
    /// Each look, in order.
    pub looks: Vec<LookedFrom>,
    /// The learned map.
    pub map: PlaceGraph,
    /// True pose of the map's origin.
    pub world_from_map: Pose,
    /// Number of time steps in which the robot touched something.
    pub bumps: u32,
}

impl OnlineRun {
    /// Aligns the map with the world by the looks of `learned`: the rigid motion with the least
    /// squared distances, as trajectories are compared (Horn 1987). O(looks).
    pub fn align(&mut self, learned: Range<usize>) {
        let pairs: Vec<(Point, Point)> = (self.looks.get(learned).into_iter().flatten())
            .map(|look| (look.corrected.position, look.truth.position))
            .collect();
        let world_from_world = rigid_motion(&pairs);
        self.world_from_map = world_from_world.compose(self.world_from_map);
        for look in &mut self.looks {
            look.corrected = world_from_world.compose(look.corrected);
        }
    }
}

/// Reason why a run cannot be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OnlineRunError {
    /// The robot cannot be put into the arena.
    #[error(transparent)]
    Robot(#[from] PutError),
    /// The system cannot go on.
    #[error("the system cannot continue; correct its configuration")]
    System(#[from] OnlineSlamError<StepError>),
}

/// Lets a robot learn an arena for `looks` looks. `seed` seeds all random numbers: its start, its
/// noise, its turns, and its wheels' calibration errors within ± `calibration`.
///
/// # Errors
/// [`OnlineRunError`] if the robot cannot be built or put down, or the system cannot go on.
pub fn learn_online(
    pitch: &Pitch,
    config: OnlineSlamConfig,
    calibration: f64,
    seed: u64,
    looks: u32,
) -> Result<OnlineRun, OnlineRunError> {
    let robot = put(pitch, calibration, seed)?;
    let start = robot.truth().pose;
    run(OnlineSlam::new(config, seed), robot, start, looks)
}

/// Puts another robot down anywhere in the arena of a run, with the map learned there but without
/// its pose, and returns its run.
///
/// # Errors
/// As [`learn_online`].
pub fn localize_online(
    pitch: &Pitch,
    learned: &OnlineRun,
    config: OnlineSlamConfig,
    calibration: f64,
    seed: u64,
    looks: u32,
) -> Result<OnlineRun, OnlineRunError> {
    let map = learned.map.clone().put_down(false);
    let system = OnlineSlam::on(map, config, seed);
    let robot = put(pitch, calibration, seed)?;
    run(system, robot, learned.world_from_map, looks)
}

/// Returns a robot whose wheels have calibration errors.
fn put(
    pitch: &Pitch,
    calibration: f64,
    seed: u64,
) -> Result<Stopping<Simulated<Pioneer2dx>>, PutError> {
    pitch.put(pitch.robot(seed, calibration)?, seed)
}

/// Lets a system wander, with a map whose origin lies at `world_from_map`.
fn run(
    mut system: OnlineSlam,
    mut robot: Stopping<Simulated<Pioneer2dx>>,
    world_from_map: Pose,
    looks: u32,
) -> Result<OnlineRun, OnlineRunError> {
    let start = robot.truth().pose;
    let (mut reckoned, mut way) = (start, 0.0);
    let mut seen = Vec::with_capacity(looks as usize);
    for _ in 0..looks {
        // Its standing does not matter: it has a fixed number of looks.
        let mut robot_heard = Reckoned::new(&mut robot, |rolled| {
            reckoned = rolled.applied_to(reckoned);
            way += rolled.distance.abs();
        });
        system.act(&mut robot_heard, Task::Explore)?;
        let here = system.graph().here().unwrap_or(Pose::IDENTITY);
        seen.push(LookedFrom {
            truth: robot.truth().pose,
            corrected: world_from_map.compose(here),
            reckoned,
            is_localized: system.graph().is_localized(),
            rolled: way,
        });
    }
    Ok(OnlineRun {
        looks: seen,
        map: system.graph().clone(),
        world_from_map,
        bumps: robot.bumps(),
    })
}

#[cfg(test)]
mod tests {
    use alloc::sync::Arc;

    use tolman_robot::{Goal, Ring, Standing};
    use tolman_sim::robots::LaserPioneer;

    use super::*;
    use crate::pioneer::calibrated;

    const CALIBRATION: f64 = 0.03;

    #[test]
    fn the_pose_is_corrected_and_the_same_seed_makes_the_same_run() {
        let pitch = Pitch::paper().unwrap();
        let config = OnlineSlamConfig::pioneer_2dx();
        let mut run = learn_online(&pitch, config, CALIBRATION, 2, 120).unwrap();
        let again = learn_online(&pitch, config, CALIBRATION, 2, 120).unwrap();
        assert_eq!(run.looks, again.looks);
        run.align(0..120);
        let last = run.looks.last().unwrap();
        let off = |pose: Pose| (pose.position - last.truth.position).norm();
        assert!(off(last.corrected) < 0.25, "{}", off(last.corrected));
        assert!(off(last.reckoned) > 2.0 * off(last.corrected));
        assert!(run.looks.iter().all(|look| look.is_localized));
    }

    #[test]
    fn it_drives_back_to_where_it_began() {
        let pitch = Pitch::named("l-room").unwrap();
        let mut robot = put(&pitch, CALIBRATION, 3).unwrap();
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
        let mut robot = put(&pitch, CALIBRATION, 4).unwrap();
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
        let robot = Simulated::new(Arc::clone(&pitch.world), model, start, 5).unwrap();
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
}
