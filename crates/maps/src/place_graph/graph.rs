use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use thiserror::Error;
use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Point, Pose};
use tolman_robot::{Guess, MapLink, MapPlace, MapView, Mapper, Odometry, Position, Snapshot};

use super::fit::{Fit, fit};
use super::hypotheses::{self, Hypothesis, turned_into};
use super::surfaces::{Surface, Surfaces};
use super::wheels::WheelError;
use super::{Outline, PlaceGraphConfig};
use crate::pose_graph::{PoseEdge, PoseEdgeKind, PoseGraph, PoseGraphError};
use crate::tangent::difference;

/// A robot's view from its pose, and the odometry of the way there.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SeenThere {
    /// Odometry of the robot's wheels since its last look, step by step.
    pub rolled: Vec<Odometry>,
    /// Snapshot taken at the end of the way.
    pub snapshot: Snapshot,
    /// Whether the robot was lifted and put down elsewhere since its last look, so that its
    /// odometry says nothing.
    pub put_down: bool,
}

/// Map of the places where a robot has been. It corrects the robot's pose while it grows.
///
/// The map's frame has its origin where the robot was first put down, looking along x.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "super::SavedPlaceGraph", into = "super::SavedPlaceGraph")
)]
pub struct PlaceGraph {
    pub(super) config: PlaceGraphConfig,
    /// Outline seen from each place.
    pub(super) places: Vec<Outline>,
    pub(super) graph: PoseGraph,
    /// Pairs of places between which the robot went, the lower id first.
    pub(super) links: BTreeSet<(u32, u32)>,
    surfaces: Surfaces,
    wheels: WheelError,
    whereabouts: Whereabouts,
    /// Number of places added since the last optimization of the graph.
    unsettled: u32,
    /// Whether new places are still added.
    grows: bool,
    /// Number of places at which all places are next fitted to each other.
    relaxes_at: usize,
}

/// Knowledge of the robot's pose.
#[derive(Clone, Debug)]
enum Whereabouts {
    /// The robot has not taken a snapshot yet.
    Nowhere,
    /// The robot is followed from place to place.
    Known(Here),
    /// The robot may be at any of these hypotheses, the likeliest first.
    Lost(Vec<Hypothesis>),
}

#[derive(Clone, Debug)]
struct Here {
    pose: Pose,
    covariance: Matrix3<f64>,
    /// Place to which the robot was nearest when it was last recognized, with its odometry since
    /// then.
    last: u32,
    since: Pose,
    since_covariance: Matrix3<f64>,
    /// Evidence of the robot's latest looks against the map, in looks.
    doubt: f64,
}

/// Reason why a map cannot take in a view.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlaceGraphError {
    /// A number of the odometry is not finite.
    #[error("step {step} of the odometry is not finite: leave it out")]
    Odometry {
        /// Number of the step, from 0.
        step: usize,
    },
    /// The pose graph refuses an edge between two places.
    #[error("two places cannot be joined; correct the configuration of the graph")]
    Edge(#[from] PoseGraphError),
}

/// Belief, 0 to 1, above which a hypothesis becomes the robot's pose, once it has had enough looks.
const SURE: f64 = 0.98;
const LEAST_LOOKS: u32 = 20;

/// Minimum evidence from a place, in points, for the place to be joined.
const LEAST_SEEN: f64 = 6.0;

/// Number of rounds in which places are fitted to each other.
const RELAX_ROUNDS: u32 = 4;
/// Maximum displacement of a place in each of these rounds, m and rad.
const RELAX_WITHIN: (f64, f64) = (0.1, 0.05);

/// Number of places at which all places are fitted to each other for the first time.
const FIRST_RELAXED: usize = 20;

/// Distance above which two places have others between them, as a multiple of the distance of
/// places.
const LONGEST_LINK: f64 = 2.0;

/// Maximum number of places joined by a fit: those with the most evidence.
const MOST_JOINED: usize = 4;

impl PlaceGraph {
    /// Returns an empty map.
    #[must_use]
    pub fn new(config: PlaceGraphConfig) -> Self {
        Self {
            wheels: WheelError::unknown(config.scale_deviation, config.curvature_deviation),
            config,
            places: Vec::new(),
            graph: PoseGraph::new(),
            links: BTreeSet::new(),
            surfaces: Surfaces::default(),
            whereabouts: Whereabouts::Nowhere,
            unsettled: 0,
            grows: true,
            relaxes_at: FIRST_RELAXED,
        }
    }

    /// Returns a map from its saved parts, with a robot put down anywhere on it.
    #[cfg(feature = "serde")]
    pub(super) fn restored(
        config: PlaceGraphConfig,
        places: Vec<Outline>,
        graph: PoseGraph,
        links: BTreeSet<(u32, u32)>,
    ) -> Self {
        let mut map = Self {
            relaxes_at: FIRST_RELAXED.max(places.len() + places.len() / 4),
            places,
            graph,
            links,
            ..Self::new(config)
        };
        map.survey();
        map.put_down(true)
    }

    /// Returns the map with another robot on it, whose wheels and pose are unknown. The robot adds
    /// new places only if `grows`. An empty map begins at the robot's first look, in any case.
    #[must_use]
    pub fn put_down(mut self, grows: bool) -> Self {
        self.wheels =
            WheelError::unknown(self.config.scale_deviation, self.config.curvature_deviation);
        // An empty map has no places to search: the robot's first look is the first place.
        if !self.places.is_empty() {
            self.whereabouts = Whereabouts::Lost(Vec::new());
        }
        self.grows = grows;
        self
    }

    /// Returns the memory of places, poses and the links between them, bytes. O(places).
    #[must_use]
    pub fn bytes(&self) -> usize {
        let outlines = self.places.iter().map(|outline| {
            size_of_val(outline)
                + size_of_val(outline.points.as_slice())
                + size_of_val(outline.arcs.as_slice())
                + size_of_val(outline.faced.as_slice())
        });
        outlines.sum::<usize>()
            + size_of_val(self.graph.poses())
            + size_of_val(self.graph.edges())
            + self.links.len() * size_of::<(u32, u32)>()
            + self.surfaces.bytes()
    }

    /// Returns the view from each place, by id.
    #[must_use]
    pub fn places(&self) -> &[Outline] {
        &self.places
    }

    /// Returns the pose graph of the places.
    #[must_use]
    pub const fn poses(&self) -> &PoseGraph {
        &self.graph
    }

    /// Returns the learned errors of the robot's wheels.
    #[must_use]
    pub const fn wheels(&self) -> &WheelError {
        &self.wheels
    }

    /// Returns the likeliest pose of the robot in the map's frame; `None` if it has not looked yet.
    #[must_use]
    pub fn here(&self) -> Option<Pose> {
        match &self.whereabouts {
            Whereabouts::Nowhere => None,
            Whereabouts::Known(here) => Some(here.pose),
            Whereabouts::Lost(hypotheses) => hypotheses.first().map(|hypothesis| hypothesis.pose),
        }
    }

    /// Returns whether the robot's pose is known.
    #[must_use]
    pub const fn is_localized(&self) -> bool {
        matches!(self.whereabouts, Whereabouts::Known(_))
    }

    fn begin(&mut self, outline: Outline) -> Whereabouts {
        let place = self.graph.add_pose(Pose::IDENTITY);
        self.surfaces.add(place, Pose::IDENTITY, &outline);
        self.places.push(outline);
        Whereabouts::Known(Here::at(Pose::IDENTITY, Matrix3::identity() * 1e-6, place))
    }

    /// Follows the robot by its odometry and its view.
    fn follow(
        &mut self,
        mut here: Here,
        rolled: &[Odometry],
        outline: Outline,
    ) -> Result<Whereabouts, PlaceGraphError> {
        let predicted = self.wheels.predict(rolled);
        let covariance = turned_into(predicted.pose, &here.covariance) + predicted.covariance;
        here.since_covariance =
            turned_into(predicted.pose, &here.since_covariance) + predicted.covariance;
        here.since = here.since.compose(predicted.pose);
        let expected = here.pose.compose(predicted.pose);
        let surfaces: Vec<&Surface> = self.surfaces.all().collect();
        let fitted = fit(&outline, &surfaces, expected, &covariance);
        let contradicted = fitted.as_ref().map_or(0.0, |fit| fit.contradicted);
        here.doubt = (here.doubt + contradicted - USUAL_CONTRADICTION).max(0.0);
        match fitted.filter(|fit| self.believes(&outline, fit)) {
            Some(fit) => {
                let off = difference(expected, fit.pose);
                self.wheels
                    .learn(&predicted, &off, &covariance, &fit.covariance);
                here.pose = fit.pose;
                here.covariance = fit.covariance;
                // The place to continue from is the nearest one, not the one that was new last.
                let nearest = self.nearest(fit.pose.position);
                self.link(here.last, nearest);
                here.last = nearest;
                here.since = self.graph.poses()[here.last as usize].between(fit.pose);
                here.since_covariance = fit.covariance + Matrix3::from_diagonal(&beside_a_place());
                self.grow(&mut here, outline, Some(&fit))?;
            }
            None => {
                here.pose = expected;
                here.covariance = covariance;
                self.grow(&mut here, outline, None)?;
            }
        }
        // While the map grows, contradictions are new places.
        if !self.grows && here.doubt > self.config.most_doubt {
            let mut anywhere = hypotheses::everywhere(self.graph.poses());
            anywhere.push(Hypothesis::held(here.pose, here.covariance));
            return Ok(Whereabouts::Lost(anywhere));
        }
        Ok(Whereabouts::Known(here))
    }

    /// Returns whether a fit is the robot's pose: the map shows most of the view, and odometry
    /// could have led there.
    fn believes(&self, outline: &Outline, fit: &Fit) -> bool {
        let tells_little = outline.points.len() < LEAST_POINTS;
        fit.surprise < MOST_SURPRISE && (tells_little || fit.share >= self.config.least_share)
    }

    /// Adds the robot's place, if it is new.
    fn grow(
        &mut self,
        here: &mut Here,
        outline: Outline,
        fit: Option<&Fit>,
    ) -> Result<(), PlaceGraphError> {
        if !self.grows || outline.points.is_empty() || self.is_known(here.pose) {
            return Ok(());
        }
        let place = self.graph.add_pose(here.pose);
        let information = here
            .since_covariance
            .try_inverse()
            .unwrap_or_else(Matrix3::identity);
        self.join(
            here.last,
            place,
            here.since,
            information,
            PoseEdgeKind::Odometry,
        )?;
        for (other, share) in fit.into_iter().flat_map(seen_by) {
            let measured = self.graph.poses()[other as usize].between(here.pose);
            let information = fit.map_or_else(Matrix3::identity, |fit| fit.information);
            self.join(
                other,
                place,
                measured,
                information * share,
                PoseEdgeKind::Closure,
            )?;
        }
        self.links
            .insert((here.last.min(place), here.last.max(place)));
        self.surfaces.add(place, here.pose, &outline);
        self.places.push(outline);
        self.unsettled += 1;
        *here = Here::at(here.pose, here.covariance, place);
        if self.unsettled >= self.config.optimize_every {
            self.settle(here);
        }
        Ok(())
    }

    /// Records that the robot went from one place to another, if they are near enough to have none
    /// in between.
    fn link(&mut self, from: u32, to: u32) {
        let [a, b] = [from, to].map(|id| self.graph.poses()[id as usize].position);
        if from != to && (a - b).norm() < LONGEST_LINK * self.config.place_distance {
            self.links.insert((from.min(to), from.max(to)));
        }
    }

    fn is_known(&self, pose: Pose) -> bool {
        self.graph.poses().iter().any(|place| {
            let off = difference(*place, pose);
            libm::hypot(off.x, off.y) < self.config.place_distance
                && off.z.abs() < self.config.place_turn
        })
    }

    fn join(
        &mut self,
        from: u32,
        to: u32,
        measured: Pose,
        information: Matrix3<f64>,
        kind: PoseEdgeKind,
    ) -> Result<(), PlaceGraphError> {
        // In a direction without measurements, as along a wall, almost nothing is known.
        let information = information + Matrix3::identity() * 1e-3;
        let information = 0.5 * (information + information.transpose());
        let edge = PoseEdge {
            from,
            to,
            measured,
            information,
            kind,
        };
        Ok(self.graph.add_edge(edge)?)
    }

    /// Optimizes the poses of all places, and moves the robot and the surfaces along.
    fn settle(&mut self, here: &mut Here) {
        self.unsettled = 0;
        self.graph.optimize(&self.config.optimizer);
        self.survey();
        if self.places.len() >= self.relaxes_at {
            self.relaxes_at += self.places.len() / 4;
            self.relax();
        }
        here.pose = self.graph.poses()[here.last as usize].compose(here.since);
    }

    /// Computes the surfaces from the outlines of all places.
    fn survey(&mut self) {
        self.surfaces = Surfaces::default();
        let places = self.places.iter().zip(self.graph.poses());
        for (id, (outline, pose)) in (0..).zip(places) {
            self.surfaces.add(id, *pose, outline);
        }
    }

    /// Fits every place to the surfaces of all places, of which early places knew only a part.
    /// O(places · outline · surfaces).
    fn relax(&mut self) {
        let (distance, turn) = RELAX_WITHIN;
        let variances = Vector3::new(distance * distance, distance * distance, turn * turn);
        let covariance = Matrix3::from_diagonal(&variances);
        for _ in 0..RELAX_ROUNDS {
            let surfaces: Vec<&Surface> = self.surfaces.all().collect();
            for (id, outline) in (0..).zip(&self.places) {
                let pose = self.graph.poses()[id as usize];
                let fitted = fit(outline, &surfaces, pose, &covariance);
                if let Some(fit) = fitted.filter(|fit| fit.share >= self.config.least_share) {
                    self.graph.move_pose(id, fit.pose);
                }
            }
            self.survey();
        }
        self.graph.measure_closures_anew();
    }

    /// Searches for the robot among all places, and returns the knowledge of its pose.
    fn search(
        &self,
        hypotheses: Vec<Hypothesis>,
        rolled: &[Odometry],
        outline: &Outline,
    ) -> Whereabouts {
        let hypotheses = match hypotheses.is_empty() {
            true => hypotheses::everywhere(self.graph.poses()),
            false => hypotheses,
        };
        let rolled = self.wheels.predict(rolled);
        let surfaces: Vec<&Surface> = self.surfaces.all().collect();
        let hypotheses = hypotheses::looked(
            hypotheses,
            &rolled,
            outline,
            &surfaces,
            self.config.most_hypotheses,
        );
        let weights = hypotheses::weights(&hypotheses);
        match (hypotheses.first(), weights.first()) {
            (Some(best), Some(weight)) if *weight > SURE && best.looks >= LEAST_LOOKS => {
                let last = self.nearest(best.pose.position);
                Whereabouts::Known(Here {
                    since: self.graph.poses()[last as usize].between(best.pose),
                    ..Here::at(best.pose, best.covariance, last)
                })
            }
            _ => Whereabouts::Lost(hypotheses),
        }
    }

    /// Returns the place nearest to a point of the map; 0 on an empty map. O(places).
    #[must_use]
    pub fn nearest(&self, point: Point) -> u32 {
        let distance = |place: &Pose| (place.position - point).norm();
        let places = (0..).zip(self.graph.poses());
        let nearest = places.min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
        nearest.map_or(0, |(id, _)| id)
    }
}

/// Returns the variances of a robot's pose beside a recognized place, m² and rad². They are
/// increased, because fits of neighbouring places err together.
const fn beside_a_place() -> Vector3<f64> {
    Vector3::new(0.05 * 0.05, 0.05 * 0.05, 0.04 * 0.04)
}

/// Share of each look that contradicts even a right map, because light changes and edges are vague.
const USUAL_CONTRADICTION: f64 = 0.08;

/// Squared distance, in standard deviations, between fit and odometry beyond which a fit is
/// rejected.
const MOST_SURPRISE: f64 = 16.0;

/// Minimum number of points of an outline that counts as evidence.
const LEAST_POINTS: usize = 8;

/// Returns the places that first saw the surfaces of a fit. Each comes with its share of the
/// information, the largest first.
fn seen_by(fit: &Fit) -> Vec<(u32, f64)> {
    let total: f64 = fit.by_place.values().sum();
    let mut places: Vec<(u32, f64)> = (fit.by_place.iter())
        .filter(|(_, seen)| **seen >= LEAST_SEEN)
        .map(|(place, seen)| (*place, seen / total))
        .collect();
    places.sort_by(|a, b| b.1.total_cmp(&a.1));
    places.truncate(MOST_JOINED);
    places
}

impl Here {
    fn at(pose: Pose, covariance: Matrix3<f64>, last: u32) -> Self {
        Self {
            pose,
            covariance,
            last,
            since: Pose::IDENTITY,
            since_covariance: Matrix3::identity() * 1e-6,
            doubt: 0.0,
        }
    }
}

impl Mapper for PlaceGraph {
    type Observation = SeenThere;
    type Error = PlaceGraphError;

    fn observe(&mut self, seen: &SeenThere) -> Result<(), PlaceGraphError> {
        let is_sound = |step: &Odometry| step.distance.is_finite() && step.turn.is_finite();
        if let Some(step) = seen.rolled.iter().position(|step| !is_sound(step)) {
            return Err(PlaceGraphError::Odometry { step });
        }
        let outline = Outline::of(&seen.snapshot);
        self.whereabouts = match self.whereabouts.clone() {
            Whereabouts::Nowhere => self.begin(outline),
            Whereabouts::Known(_) | Whereabouts::Lost(_) if seen.put_down => {
                self.search(Vec::new(), &[], &outline)
            }
            Whereabouts::Known(here) => self.follow(here, &seen.rolled, outline)?,
            Whereabouts::Lost(hypotheses) => self.search(hypotheses, &seen.rolled, &outline),
        };
        Ok(())
    }

    fn map(&self) -> MapView {
        let places = (0..).zip(self.graph.poses()).map(|(id, pose)| MapPlace {
            id,
            position: Some(pose.position),
            landmark: None,
        });
        let links = self.links.iter().copied();
        let links = links.flat_map(|(a, b)| MapLink::both_ways(a, b));
        MapView {
            places: places.collect(),
            links: links.collect(),
            ..MapView::default()
        }
    }

    fn belief(&self) -> Vec<Guess> {
        let guess = |pose: Pose, weight: f64| Guess {
            at: Position::Point(pose.position),
            weight,
        };
        match &self.whereabouts {
            Whereabouts::Nowhere => Vec::new(),
            Whereabouts::Known(here) => [guess(here.pose, 1.0)].to_vec(),
            Whereabouts::Lost(hypotheses) => {
                let weights = hypotheses::weights(hypotheses);
                let pairs = hypotheses.iter().zip(weights);
                pairs
                    .map(|(hypothesis, weight)| guess(hypothesis.pose, weight))
                    .collect()
            }
        }
    }
}
