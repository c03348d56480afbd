//! Runs of the system that corrects its pose while it learns, with the truth beside them.

use alloc::sync::Arc;
use core::ops::Range;

use thiserror::Error;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::place_graph::PlaceGraph;
use tolman_robot::{Reckoned, Stopping, System, Task};
use tolman_sim::robots::{Pioneer2dx, Pioneer2dxError};
use tolman_sim::{PlaceError, StepError};
use tolman_systems::gngslam::{OnlineSlam, OnlineSlamConfig, OnlineSlamError};

use super::{Pitch, PitchError};
use crate::Simulated;

/// Where a robot was at a look, and where it was believed to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookedFrom {
    /// Where it truly was.
    pub truth: Pose,
    /// Where the system had it.
    pub corrected: Pose,
    /// Where its wheels had it, from its true first pose.
    pub reckoned: Pose,
    /// Whether the system knew where it was.
    pub is_localized: bool,
    /// The share of what it saw that the map had there.
    pub recognized: f64,
    /// Way that the wheels had rolled, m.
    pub rolled: f64,
}

/// A run in an arena.
#[derive(Clone, Debug)]
pub struct OnlineRun {
    /// Each look, in order.
    pub looks: Vec<LookedFrom>,
    /// What was learned.
    pub map: PlaceGraph,
    /// Where the origin of the map truly lies.
    pub world_from_map: Pose,
    /// Time steps in which the robot touched something.
    pub bumps: u32,
}

impl OnlineRun {
    /// Lays the map over the world by the looks of `learned`: the rigid motion under which the squared distances are least, as
    /// trajectories are compared (Horn 1987). O(looks).
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

/// The rigid motion that brings the first points of all pairs nearest to the second.
fn rigid_motion(pairs: &[(Point, Point)]) -> Pose {
    let count = pairs.len().max(1) as f64;
    let sum = |sum: (Vector, Vector), (from, to): &(Point, Point)| {
        (sum.0 + from.coords, sum.1 + to.coords)
    };
    let (from, to) = pairs.iter().fold((Vector::zeros(), Vector::zeros()), sum);
    let (from, to) = (from / count, to / count);
    let (mut along, mut across) = (0.0, 0.0);
    for (a, b) in pairs {
        let (a, b) = (a.coords - from, b.coords - to);
        along += a.dot(&b);
        across += a.perp(&b);
    }
    let heading = Heading::from_radians(libm::atan2(across, along));
    Pose::new(Point::from(to - heading.rotate(from)), heading)
}

/// Why there is no run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OnlineRunError {
    /// The robot cannot be built.
    #[error("the robot cannot be built")]
    Robot(#[from] Pioneer2dxError),
    /// There is no place for the robot in the arena.
    #[error(transparent)]
    Pitch(#[from] PitchError),
    /// The robot cannot stand where it begins.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// The system cannot go on.
    #[error("the system cannot go on")]
    System(#[from] OnlineSlamError<StepError>),
}

/// Lets a robot learn an arena for so many looks. `seed` is that of all chance: where it begins, how its wheels are out of
/// calibration, within ± `calibration`, its noise and its turns.
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
    let system = OnlineSlam::new(config, seed);
    let start = pitch.start(seed)?;
    run(pitch, system, start, calibration, seed, looks)
}

/// Puts another robot down anywhere in the arena of a run, with the map that was learned there and without a word of where it is.
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
    run(
        pitch,
        system,
        learned.world_from_map,
        calibration,
        seed,
        looks,
    )
}

fn run(
    pitch: &Pitch,
    mut system: OnlineSlam,
    world_from_map: Pose,
    calibration: f64,
    seed: u64,
    looks: u32,
) -> Result<OnlineRun, OnlineRunError> {
    let start = pitch.start(seed)?;
    let model = Pioneer2dx::new(pitch.robot(seed, calibration)?)?;
    let robot = Simulated::new(Arc::clone(&pitch.world), model, start, seed)?;
    let mut robot = Stopping::new(robot);
    let (mut reckoned, mut way) = (start, 0.0);
    let mut seen = Vec::with_capacity(looks as usize);
    for _ in 0..looks {
        // Its standing is no matter: it has as many looks as it has.
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
            recognized: system.graph().recognized(),
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
    use tolman_robot::{Goal, Ring, Standing};
    use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};

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
        let start = pitch.start(3).unwrap();
        let model = Pioneer2dx::new(pitch.robot(3, CALIBRATION).unwrap()).unwrap();
        let robot = Simulated::new(Arc::clone(&pitch.world), model, start, 3).unwrap();
        let mut robot = Stopping::new(robot);
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
    fn a_robot_with_a_laser_and_no_camera_learns_too() {
        let pitch = Pitch::named("l-room").unwrap();
        let start = pitch.start(5).unwrap();
        let laser = LaserPioneerConfig {
            ring: Ring::full(90, 4.0),
            ..calibrated()
        };
        let per_step = laser.translate_per_step;
        let model = LaserPioneer::new(laser).unwrap();
        let robot = Simulated::new(Arc::clone(&pitch.world), model, start, 5).unwrap();
        let mut robot = Stopping::new(robot);
        let mut config = OnlineSlamConfig::pioneer_2dx();
        config.drive = config.drive.with_rates(0.04 / per_step, 0.1);
        let mut system = OnlineSlam::new(config, 5);
        for _ in 0..80 {
            system.act(&mut robot, Task::Explore).unwrap();
        }
        let here = start.compose(system.graph().here().unwrap());
        let off = (here.position - robot.truth().pose.position).norm();
        assert!(system.graph().is_localized() && off < 0.25, "{off}");
    }
}
