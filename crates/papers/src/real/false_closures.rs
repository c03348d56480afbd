//! False loop closures of the kinds in the literature, drawn from a seed.
//!
//! Source of the kinds: N. Sünderhauf, P. Protzel: Towards a Robust Back-End for Pose Graph SLAM,
//! 2012. There are two deviations. The closures of a group agree with each other, because the pairs
//! after the first follow from odometry. *Local* means near in the true map, not by number.

use alloc::collections::BTreeSet;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_geom::nalgebra::Matrix3;
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph};

/// Choice of the poses of a false closure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Joins any two poses.
    Random,
    /// Joins two poses within 5 m in the true map.
    Local,
    /// Joins 10 to 20 consecutive pairs that agree with each other, beginning at any two poses.
    RandomGroups,
    /// Joins 10 to 20 consecutive pairs that agree with each other, beginning at two poses within 5
    /// m.
    LocalGroups,
    /// Joins two poses by a measurement that is off by less than 1 m and 20°, but by more than its
    /// bound.
    Near,
}

/// Maximum distance of a false closure's poses, m.
const RADIUS: f64 = 5.0;

/// Error above which a closure is false, m and degrees.
const FALSE_M: f64 = 1.0;
const FALSE_DEG: f64 = 20.0;

/// Spread of a place matcher's measurements near zero, m and degrees.
const JITTER_M: f64 = 0.3;
const JITTER_DEG: f64 = 10.0;

/// Spread of a group's measurements around those that follow from the first, m and rad.
const GROUP_M: f64 = 0.02;
const GROUP_RAD: f64 = 0.01;

impl Kind {
    /// The kinds with their names in rows.
    pub(super) const ALL: [(Self, &str); 5] = [
        (Self::Random, "random"),
        (Self::Local, "local"),
        (Self::RandomGroups, "random groups"),
        (Self::LocalGroups, "local groups"),
        (Self::Near, "near"),
    ];

    const fn is_grouped(self) -> bool {
        matches!(self, Self::RandomGroups | Self::LocalGroups)
    }

    const fn is_local(self) -> bool {
        matches!(self, Self::Local | Self::LocalGroups | Self::Near)
    }
}

/// Returns whether a measurement is off from the truth by more than 1 m or 20°.
pub(super) fn is_false(measured: Pose, truth: Pose) -> bool {
    let off = truth.between(measured);
    off.position.coords.norm() > FALSE_M || off.heading.degrees().abs() > FALSE_DEG
}

/// Draws false closures for a graph with known true poses.
pub(super) struct Spoiler<'a> {
    graph: &'a PoseGraph,
    truth: &'a [Pose],
    /// Odometry from each pose to the next.
    steps: Vec<Option<Pose>>,
    /// Information matrices of the right closures.
    information: Vec<Matrix3<f64>>,
    taken: BTreeSet<(u32, u32)>,
}

impl<'a> Spoiler<'a> {
    pub(super) fn new(graph: &'a PoseGraph, truth: &'a [Pose]) -> Self {
        let mut steps = vec![None; graph.poses().len()];
        for edge in graph.edges() {
            if edge.kind == PoseEdgeKind::Odometry && edge.from + 1 == edge.to {
                steps[edge.from as usize] = Some(edge.measured);
            }
        }
        let closures = graph
            .edges()
            .iter()
            .filter(|edge| edge.kind == PoseEdgeKind::Closure);
        let ends = graph.edges().iter();
        Self {
            graph,
            truth,
            steps,
            information: closures.map(|edge| edge.information).collect(),
            taken: ends
                .map(|edge| (edge.from.min(edge.to), edge.from.max(edge.to)))
                .collect(),
        }
    }

    /// Draws `count` false closures; fewer if the graph has no room for them.
    pub(super) fn draw(mut self, kind: Kind, count: usize, rng: &mut ChaCha8Rng) -> Vec<PoseEdge> {
        let mut drawn = Vec::new();
        for _ in 0..500 * count + 10_000 {
            if drawn.len() >= count {
                break;
            }
            if let Some(group) = self.group(kind, rng) {
                self.taken
                    .extend(group.iter().map(|edge| (edge.from, edge.to)));
                drawn.extend(group);
            }
        }
        drawn.truncate(count);
        drawn
    }

    /// Returns one false closure, or a group of them; `None` if the random poses do not fit.
    fn group(&self, kind: Kind, rng: &mut ChaCha8Rng) -> Option<Vec<PoseEdge>> {
        let length = if kind.is_grouped() {
            rng.random_range(10..=20_u32)
        } else {
            1
        };
        let poses = u32::try_from(self.graph.poses().len())
            .ok()?
            .checked_sub(length)?;
        let one = rng.random_range(0..poses.max(1));
        let other = match kind.is_local() {
            true => self.near(one, rng)?,
            false => rng.random_range(0..poses.max(1)),
        };
        let (first, second) = (one.min(other), one.max(other));
        let least = if kind.is_grouped() { length + 3 } else { 2 };
        if second - first < least || second >= poses {
            return None;
        }
        let information = self
            .information
            .get(rng.random_range(0..self.information.len().max(1) as u32) as usize)?;
        let mut group = Vec::new();
        let mut measured = spread(Pose::IDENTITY, JITTER_M, JITTER_DEG.to_radians(), rng);
        for step in 0..length {
            let (from, to) = (first + step, second + step);
            if step > 0 {
                // It follows from the previous pair, by odometry on both sides.
                let [back, forth] = [from - 1, to - 1].map(|pose| self.steps[pose as usize]);
                measured = back?.inverse().compose(measured).compose(forth?);
            }
            let said = match step {
                0 => measured,
                _ => spread(measured, GROUP_M, GROUP_RAD, rng),
            };
            let edge = PoseEdge {
                from,
                to,
                measured: said,
                information: *information,
                kind: PoseEdgeKind::Closure,
            };
            if self.taken.contains(&(from, to)) || !self.fits(kind, &edge) {
                return None;
            }
            group.push(edge);
        }
        Some(group)
    }

    fn fits(&self, kind: Kind, edge: &PoseEdge) -> bool {
        let [from, to] = [edge.from, edge.to].map(|pose| self.truth[pose as usize]);
        match (is_false(edge.measured, from.between(to)), kind) {
            (is_false, Kind::Near) => !is_false && edge.squared_error(from, to) > 25.0,
            (is_false, _) => is_false,
        }
    }

    /// Returns a random pose near another one in the true map.
    fn near(&self, one: u32, rng: &mut ChaCha8Rng) -> Option<u32> {
        let place = self.truth[one as usize].position;
        let near = (0..)
            .zip(self.truth)
            .filter(|(_, pose)| (pose.position - place).norm() < RADIUS);
        let near: Vec<u32> = near.map(|(pose, _)| pose).collect();
        let chosen = rng.random_range(0..near.len().max(1) as u32);
        near.get(chosen as usize).copied()
    }
}

/// Returns a pose moved at random, in its own frame.
fn spread(pose: Pose, metres: f64, radians: f64, rng: &mut ChaCha8Rng) -> Pose {
    let (x, y) = gaussians(rng);
    let (turn, _) = gaussians(rng);
    pose.compose(Pose::new(
        Point::new(metres * x, metres * y),
        Heading::from_radians(radians * turn),
    ))
}

/// Returns two independent numbers of the standard normal distribution (Box and Muller, 1958).
fn gaussians(rng: &mut ChaCha8Rng) -> (f64, f64) {
    let unit = |rng: &mut ChaCha8Rng| (f64::from(rng.random::<u32>()) + 0.5) / 4_294_967_296.0;
    let radius = libm::sqrt(-2.0 * libm::log(unit(rng)));
    let (sin, cos) = libm::sincos(core::f64::consts::TAU * unit(rng));
    (radius * cos, radius * sin)
}
