use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Pose, Vector};
use tolman_robot::{Guess, MapLink, MapPlace, MapView, Mapper, Position, Scan};

use super::ScanMatchingConfig;
use super::closures::Closing;
use super::correlate::{self, Pyramid, Window};
use super::grid::{LikelihoodGrid, Stamp};
use super::outline::ScanOutline;
use super::refine::{self, Prior, Refined};
use crate::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph, PoseGraphError};

/// One observation of a [`ScanMatching`]: a scan and the odometry since the scan before.
#[derive(Clone, Debug, PartialEq)]
pub struct ScanStep {
    /// Odometry since the scan before, as the present pose relative to that one. Ignored for the
    /// first scan.
    pub moved: Pose,
    /// Scan at the end of the step.
    pub scan: Scan,
    /// Pose of the laser on the robot.
    pub robot_from_laser: Pose,
}

/// Reason why a step is refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ScanMatchingError {
    /// The odometry is not a number.
    #[error("the odometry of scan {scan} is not finite; leave the scan out")]
    NotFinite {
        /// Number of the scan, from 0.
        scan: usize,
    },
    /// The number of ranges in a scan is not its number of beams.
    #[error("scan {scan} has {found} ranges for {beams} beams; leave it out")]
    Ranges {
        /// Number of the scan, from 0.
        scan: usize,
        /// Number of ranges in the scan.
        found: usize,
        /// Number of beams of the scan's ring.
        beams: u32,
    },
    /// An edge does not fit the graph.
    #[error("the measurement does not fit the pose graph")]
    Graph(#[from] PoseGraphError),
}

/// The trajectory of a robot and a map of points. See [the module](super).
#[derive(Clone, Debug)]
pub struct ScanMatching {
    pub(super) config: ScanMatchingConfig,
    pub(super) stamp: Stamp,
    pub(super) graph: PoseGraph,
    pub(super) keyframes: Vec<Keyframe>,
    pub(super) closing: Closing,
    /// Pose of each scan, relative to the keyframe before it.
    scans: Vec<Anchored>,
    /// Odometry since the last matched scan, and its length, m.
    rolled: Pose,
    rolled_way: f64,
    matched: Anchored,
    /// Map of the last keyframes, as long as it is valid.
    local: Option<(LikelihoodGrid, Pyramid)>,
}

/// A scan that the map keeps.
#[derive(Clone, Debug)]
pub(super) struct Keyframe {
    pub(super) outline: ScanOutline,
    /// Length of the robot's way from the beginning, m.
    pub(super) way: f64,
    /// Number of the scan that became the keyframe, from 0.
    pub(super) scan: usize,
    /// Direction of the keyframe's surfaces in its own frame: [`ScanOutline::axis`].
    pub(super) axis: Vector,
}

impl Keyframe {
    fn new(outline: ScanOutline, way: f64, scan: usize) -> Self {
        Self {
            axis: outline.axis(),
            outline,
            way,
            scan,
        }
    }
}

/// A pose relative to a keyframe, with which it moves.
#[derive(Clone, Copy, Debug)]
struct Anchored {
    keyframe: u32,
    from_keyframe: Pose,
}

impl ScanMatching {
    /// Returns an empty map.
    #[must_use]
    pub fn new(config: ScanMatchingConfig) -> Self {
        Self {
            stamp: Stamp::new(config.cell, config.kernel),
            config,
            graph: PoseGraph::new(),
            keyframes: Vec::new(),
            closing: Closing::default(),
            scans: Vec::new(),
            rolled: Pose::IDENTITY,
            rolled_way: 0.0,
            matched: Anchored {
                keyframe: 0,
                from_keyframe: Pose::IDENTITY,
            },
            local: None,
        }
    }

    /// Returns the pose of each scan taken in, in order, in the frame of the first. O(scans).
    #[must_use]
    pub fn trajectory(&self) -> Vec<Pose> {
        self.scans.iter().map(|scan| self.pose_of(scan)).collect()
    }

    /// Returns the pose of the last scan, in the frame of the first; `None` before the first.
    #[must_use]
    pub fn pose(&self) -> Option<Pose> {
        self.scans.last().map(|scan| self.pose_of(scan))
    }

    /// Returns the numbers of the scans that are keyframes, in order.
    #[must_use]
    pub fn keyframes(&self) -> Vec<usize> {
        self.keyframes
            .iter()
            .map(|keyframe| keyframe.scan)
            .collect()
    }

    /// Returns the graph of the keyframes' poses and measurements.
    #[must_use]
    pub const fn graph(&self) -> &PoseGraph {
        &self.graph
    }

    /// Returns the number of closures of the map.
    #[must_use]
    pub fn closures(&self) -> usize {
        self.graph.closures().count()
    }

    fn pose_of(&self, anchored: &Anchored) -> Pose {
        self.graph.poses()[anchored.keyframe as usize].compose(anchored.from_keyframe)
    }

    fn check(&self, step: &ScanStep) -> Result<(), ScanMatchingError> {
        let scan = self.scans.len();
        if !(step.moved.is_finite() && step.robot_from_laser.is_finite()) {
            return Err(ScanMatchingError::NotFinite { scan });
        }
        let (found, beams) = (step.scan.ranges.len(), step.scan.ring.beams);
        if found != beams as usize {
            return Err(ScanMatchingError::Ranges { scan, found, beams });
        }
        Ok(())
    }

    fn begin(&mut self, step: &ScanStep) {
        self.graph.add_pose(Pose::IDENTITY);
        self.scans.push(self.matched);
        self.keyframes
            .push(Keyframe::new(self.outline(step), 0.0, 0));
    }

    fn outline(&self, step: &ScanStep) -> ScanOutline {
        ScanOutline::of(&step.scan, step.robot_from_laser, self.config.farthest)
    }

    /// Matches a scan with the last keyframes, near `expected`; `None` if it fits nowhere.
    fn matched_to_last(&mut self, outline: &ScanOutline, expected: Pose) -> Option<Refined> {
        if self.local.is_none() {
            let first = self
                .keyframes
                .len()
                .saturating_sub(self.config.local_keyframes);
            let mut grid = LikelihoodGrid::default();
            let poses = self.graph.poses()[first..].iter().copied();
            let outlines = self.keyframes[first..]
                .iter()
                .map(|keyframe| &keyframe.outline);
            grid.draw(&self.stamp, outlines.zip(poses), self.config.window);
            let pyramid = Pyramid::of(&grid, self.config.window);
            self.local = Some((grid, pyramid));
        }
        let (grid, pyramid) = self.local.as_ref()?;
        let config = &self.config;
        let window = Window {
            reach: config.window,
            turn: config.window_turn,
            prior: config.prior,
            prior_turn: config.prior_turn,
        };
        let thinned = outline.thinned(SEARCHED_POINTS);
        let found = correlate::best(grid, pyramid, &thinned, expected, window)?;
        let prior = Prior {
            pose: expected,
            information: odometry_information(config),
        };
        let refined = refine::refine(grid, outline, found, &prior, config.kernel);
        (refined.score >= config.least_score).then_some(refined)
    }

    /// Makes the scan just taken in a keyframe.
    fn keep(
        &mut self,
        outline: ScanOutline,
        pose: Pose,
        information: Matrix3<f64>,
    ) -> Result<(), ScanMatchingError> {
        let from = self.matched.keyframe;
        let before = self.graph.poses()[from as usize];
        let to = self.graph.add_pose(pose);
        let measured = before.between(pose);
        self.graph.add_edge(PoseEdge {
            from,
            to,
            measured,
            information,
            kind: PoseEdgeKind::Odometry,
        })?;
        let way = self.keyframes[from as usize].way + measured.position.coords.norm();
        let scan = self.scans.len();
        self.keyframes.push(Keyframe::new(outline, way, scan));
        self.matched = Anchored {
            keyframe: to,
            from_keyframe: Pose::IDENTITY,
        };
        self.local = None;
        Ok(())
    }
}

/// Number of points of a scan with which poses are searched.
const SEARCHED_POINTS: usize = 180;

/// Returns the information matrix of a pose by odometry alone: ahead, left, heading.
fn odometry_information(config: &ScanMatchingConfig) -> Matrix3<f64> {
    let [sd, turn_sd] = [config.odometry_sd, config.odometry_turn_sd];
    let sure = Vector3::new(sd * sd, sd * sd, turn_sd * turn_sd);
    Matrix3::from_diagonal(&sure.map(|variance| 1.0 / variance))
}

impl Mapper for ScanMatching {
    type Observation = ScanStep;
    type Error = ScanMatchingError;

    fn observe(&mut self, step: &ScanStep) -> Result<(), ScanMatchingError> {
        self.check(step)?;
        if self.scans.is_empty() {
            self.begin(step);
            return Ok(());
        }
        self.rolled = self.rolled.compose(step.moved);
        self.rolled_way += step.moved.position.coords.norm();
        let Anchored {
            keyframe,
            from_keyframe,
        } = self.matched;
        let expected = from_keyframe.compose(self.rolled);
        let is_near = self.rolled.position.coords.norm() < self.config.step
            && self.rolled.heading.radians().abs() < self.config.turn;
        if is_near {
            self.scans.push(Anchored {
                keyframe,
                from_keyframe: expected,
            });
            return Ok(());
        }
        let anchor = self.graph.poses()[keyframe as usize];
        let outline = self.outline(step);
        let expected = anchor.compose(expected);
        let prior = odometry_information(&self.config);
        let refined = self.matched_to_last(&outline, expected);
        let (pose, information) = refined.map_or((expected, prior), |refined| {
            (refined.pose, refined.information + prior)
        });
        let moved = anchor.between(pose);
        self.rolled = Pose::IDENTITY;
        let is_far = moved.position.coords.norm() >= self.config.keyframe_step
            || moved.heading.radians().abs() >= self.config.keyframe_turn;
        if is_far {
            self.keep(outline, pose, information)?;
            self.close()?;
        } else {
            self.matched.from_keyframe = moved;
        }
        self.scans.push(self.matched);
        Ok(())
    }

    fn map(&self) -> MapView {
        let place = |(id, pose): (u32, &Pose)| MapPlace {
            id,
            position: Some(pose.position),
            landmark: None,
        };
        let links = self.graph.edges().iter().flat_map(|edge| {
            let (from, to) = (edge.from, edge.to);
            [MapLink { from, to }, MapLink { from: to, to: from }]
        });
        MapView {
            places: (0..).zip(self.graph.poses()).map(place).collect(),
            links: links.collect(),
            ..MapView::default()
        }
    }

    fn belief(&self) -> Vec<Guess> {
        let guess = |scan: &Anchored| Guess {
            at: Position::Point(self.pose_of(scan).position),
            weight: 1.0,
        };
        self.scans.last().map(guess).into_iter().collect()
    }
}
