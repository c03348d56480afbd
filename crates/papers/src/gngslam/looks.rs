//! A run of the system that corrects its pose while it learns, with the truth beside.

use tolman_arena::gngslam::{LaidOver, Pitch};
use tolman_arena::run::within;
use tolman_experiment::BoxError;
use tolman_geom::{Point, Pose};
use tolman_maps::place_graph::PlaceGraph;
use tolman_robot::{Reckoned, Standing, System, Task};
use tolman_systems::gngslam::OnlineSlam;

/// True and believed poses of a robot at a look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LookedFrom {
    /// True pose of the robot at the look.
    pub(super) truth: Pose,
    /// Pose that the system believes in.
    pub(super) corrected: Pose,
    /// Pose by odometry alone, from the true first pose.
    pub(super) reckoned: Pose,
    /// Whether the system knew where it was.
    pub(super) is_localized: bool,
    /// Distance that the wheels had rolled, m.
    pub(super) rolled: f64,
}

/// A run of the online system in an arena.
#[derive(Debug)]
pub(super) struct OnlineRun {
    /// Each look, in order.
    pub(super) looks: Vec<LookedFrom>,
    /// The learned map.
    pub(super) map: PlaceGraph,
    /// True pose of the map's origin.
    pub(super) world_from_map: Pose,
    /// Number of time steps in which the robot touched something.
    pub(super) bumps: u32,
}

impl OnlineRun {
    /// Lets a system explore an arena for `looks` looks. The origin of its map lies at
    /// `world_from_map`, or else where the robot is put down. `seed` seeds the robot's start, its
    /// noise, and its wheels' calibration errors within ± `calibration`.
    pub(super) fn of(
        pitch: &Pitch,
        mut system: OnlineSlam,
        world_from_map: Option<Pose>,
        calibration: f64,
        seed: u64,
        looks: u32,
    ) -> Result<Self, BoxError> {
        let mut robot = pitch.put(pitch.robot(seed, calibration)?, seed)?;
        let (mut reckoned, mut way) = (robot.truth().pose, 0.0);
        let world_from_map = world_from_map.unwrap_or(reckoned);
        let mut seen = Vec::with_capacity(looks as usize);
        within(looks, || {
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
            // It looks on, whether or not all is explored.
            Ok::<_, BoxError>(Standing::UnderWay)
        })?;
        Ok(Self {
            looks: seen,
            map: system.graph().clone(),
            world_from_map,
            bumps: robot.bumps(),
        })
    }

    /// Aligns the map with the world by the first `learned` looks: the rigid motion with the least
    /// squared distances, as trajectories are compared (Horn 1987). O(looks).
    pub(super) fn aligned(mut self, learned: usize) -> Self {
        let looks = &self.looks[..learned.min(self.looks.len())];
        let truth: Vec<Point> = looks.iter().map(|look| look.truth.position).collect();
        let corrected = looks.iter().map(|look| look.corrected.position);
        let Some(laid) = LaidOver::of_places(corrected, &truth) else {
            return self;
        };
        self.world_from_map = laid.world_from_map.compose(self.world_from_map);
        for look in &mut self.looks {
            look.corrected = laid.world_from_map.compose(look.corrected);
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use tolman_systems::gngslam::OnlineSlamConfig;

    use super::*;

    #[test]
    fn the_pose_is_corrected_and_the_same_seed_makes_the_same_run() {
        let pitch = Pitch::named("pitch").unwrap();
        let run = || {
            let system = OnlineSlam::new(OnlineSlamConfig::pioneer_2dx(), 2);
            OnlineRun::of(&pitch, system, None, 0.03, 2, 120).unwrap()
        };
        let (run, again) = (run(), run());
        assert_eq!(run.looks, again.looks);
        let run = run.aligned(120);
        let last = run.looks.last().unwrap();
        let off = |pose: Pose| (pose.position - last.truth.position).norm();
        assert!(off(last.corrected) < 0.25, "{}", off(last.corrected));
        assert!(off(last.reckoned) > 2.0 * off(last.corrected));
        assert!(run.looks.iter().all(|look| look.is_localized));
    }
}
