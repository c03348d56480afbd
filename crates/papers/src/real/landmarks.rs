//! A map of recognized landmarks, from dead reckoning and from the ranges and bearings at which
//! they were seen.

use alloc::collections::BTreeMap;

use tolman_formats::{BarcodeSighting, LogVelocity};
use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::pose_graph::{OptimizerConfig, PoseEdge, PoseEdgeKind, PoseGraph, PoseGraphError};
use tolman_robot::{TimedPose, Trajectory};

/// Time between two poses of the robot that are kept, s.
const STEP_S: f64 = 1.0;
/// Number of new poses after which all poses are optimized again.
const ROUND: usize = 60;
/// Standard deviations of a range, m, and of a bearing, rad.
const RANGE_ERROR: f64 = 0.15;
const BEARING_ERROR: f64 = 0.05;
/// Standard deviations of dead reckoning: in each step, m and rad; and as a share of the way and of
/// the turn.
const STEP_ERROR: [f64; 2] = [0.01, 0.01];
const WAY_ERROR: f64 = 0.1;
/// Information of a landmark's heading, which has no meaning.
const NO_HEADING: f64 = 1e-6;

/// Poses of a robot and positions of landmarks, in the frame of its first pose.
#[derive(Clone, Debug)]
pub(super) struct LandmarkMap {
    /// Poses of the robot, one per second.
    pub(super) way: Vec<TimedPose>,
    /// Position of each landmark, m, by the landmark's number.
    pub(super) landmarks: BTreeMap<u32, Point>,
}

impl LandmarkMap {
    /// Returns the map of a robot's records: the poses and landmarks of a pose graph that agree
    /// best with wheels and sightings.
    pub(super) fn of(
        odometry: &[LogVelocity],
        sightings: &[BarcodeSighting],
    ) -> Result<Self, PoseGraphError> {
        let reckoned = LogVelocity::dead_reckoning(odometry);
        let times = steps_of(&reckoned);
        let mut seen = sightings.iter().filter(|one| one.is_landmark()).peekable();
        let mut graph = PoseGraph::new();
        let mut robot: Vec<u32> = Vec::new();
        let mut landmarks: BTreeMap<u32, u32> = BTreeMap::new();
        let mut before = Pose::IDENTITY;
        for (index, time) in times.iter().enumerate() {
            let Some(now) = reckoned.at(*time) else {
                continue;
            };
            let here = step(&mut graph, robot.last().copied(), before.between(now))?;
            robot.push(here);
            before = now;
            while let Some(one) = seen.next_if(|one| one.time < time + 0.5 * STEP_S) {
                let Some(then) = reckoned.at(one.time) else {
                    continue;
                };
                see(&mut graph, here, &mut landmarks, now.between(then), one)?;
            }
            if (index + 1) % ROUND == 0 {
                graph.optimize(&on_the_way());
            }
        }
        graph.optimize(&OptimizerConfig::robust());
        let pose = |id: u32| graph.poses()[id as usize];
        let way = times.iter().zip(&robot);
        Ok(Self {
            way: way
                .map(|(&time, &id)| TimedPose {
                    time,
                    pose: pose(id),
                })
                .collect(),
            landmarks: landmarks
                .iter()
                .map(|(&name, &id)| (name, pose(id).position))
                .collect(),
        })
    }
}

/// Returns the configuration of the optimizer while poses are still added; it is less exact.
const fn on_the_way() -> OptimizerConfig {
    let mut config = OptimizerConfig::robust();
    config.most_steps = 4;
    config.most_iterations = 100;
    config
}

/// Returns the times of the poses that are kept, s.
pub(super) fn steps_of(reckoned: &Trajectory) -> Vec<f64> {
    let (Some(first), Some(last)) = (reckoned.poses().first(), reckoned.poses().last()) else {
        return Vec::new();
    };
    let count = ((last.time - first.time) / STEP_S) as u32;
    (0..=count)
        .map(|number| first.time + STEP_S * f64::from(number))
        .collect()
}

/// Adds a pose by odometry, and returns its id.
fn step(graph: &mut PoseGraph, before: Option<u32>, moved: Pose) -> Result<u32, PoseGraphError> {
    let Some(before) = before else {
        return Ok(graph.add_pose(Pose::IDENTITY));
    };
    let here = graph.add_pose(graph.poses()[before as usize].compose(moved));
    let [least, least_turn] = STEP_ERROR;
    let error = least + WAY_ERROR * moved.position.coords.norm();
    let turn = least_turn + WAY_ERROR * moved.heading.radians().abs();
    graph.add_edge(PoseEdge {
        from: before,
        to: here,
        measured: moved,
        information: information([error, error, turn]),
        kind: PoseEdgeKind::Odometry,
    })?;
    Ok(here)
}

/// Adds a landmark that was seen after the robot had moved by `moved` from the pose `here`.
fn see(
    graph: &mut PoseGraph,
    here: u32,
    landmarks: &mut BTreeMap<u32, u32>,
    moved: Pose,
    seen: &BarcodeSighting,
) -> Result<(), PoseGraphError> {
    // The axes of the error are along the ray and across it.
    let bearing = moved.heading.turned(seen.bearing);
    let position = moved.position + seen.range * bearing.unit();
    let measured = Pose::new(position, bearing);
    let landmark = *landmarks.entry(seen.subject).or_insert_with(|| {
        let there = graph.poses()[here as usize].compose(measured);
        graph.add_pose(Pose::new(there.position, Heading::EAST))
    });
    let across = RANGE_ERROR.min(0.02 + BEARING_ERROR * seen.range);
    let mut information = information([RANGE_ERROR, across, 1.0]);
    information[(2, 2)] = NO_HEADING;
    graph.add_edge(PoseEdge {
        from: here,
        to: landmark,
        measured,
        information,
        // A barcode may be misread.
        kind: PoseEdgeKind::Closure,
    })
}

/// Returns the information matrix for standard deviations: ahead and left, m, and heading, rad.
pub(super) fn information(errors: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(errors).map(|error| 1.0 / (error * error)))
}
