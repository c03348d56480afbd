//! Output of the observer.

use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::{Action, LinkId, Matcher, PlaceId, TrackId};

/// Result of a move.
#[derive(Clone, Debug, PartialEq)]
pub struct StepReport {
    /// Number of the move, from 1.
    pub number: u64,
    /// All surviving tracks, the best first.
    pub tracks: Vec<TrackReport>,
    /// Contradictions, each with its culprit. They narrow no box.
    pub contradictions: Vec<Contradiction>,
    /// Changes of the map, in order.
    pub restructured: Vec<Restructured>,
    /// Whether the dynamic order of priorities decided: by the static order the best track would
    /// have gone on by another match.
    pub reordered: bool,
}

/// Result of a move for one track.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackReport {
    /// Id of the track.
    pub track: TrackId,
    /// Place of the track before the move.
    pub from: PlaceId,
    /// Matcher by which the track came to its place, or `None` if the move was blocked.
    pub matcher: Option<Matcher>,
    /// Place of the track after the move.
    pub place: PlaceId,
    /// Confidence in the track, 0 to 1.
    pub confidence: f64,
    /// The map's prediction before the move.
    pub predicted: Option<Predicted>,
    /// Displacement of the move by the updated map, from `from` to `place`, m. `None` if no way
    /// through the reference graph is known.
    pub motion: Option<PointBox>,
}

/// Prediction of the map for an action at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predicted {
    /// Place to which the action leads.
    pub place: PlaceId,
    /// Probability of that place, by the counts of the links. Those of an action at a place sum to
    /// 1.
    pub probability: f64,
    /// Displacement to that place, m, or `None` if the reference graph does not relate the two.
    pub displacement: Option<PointBox>,
}

/// Two facts that cannot both be true: a bound was broken, or places were confused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contradiction {
    /// Track that noticed the contradiction.
    pub track: TrackId,
    /// Part of the map to blame, if not the move itself.
    pub culprit: Culprit,
    /// Displacement by the map, m.
    pub known: PointBox,
    /// Displacement by the move, m.
    pub estimate: PointBox,
}

/// Part of the map that a move contradicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Culprit {
    /// A link that should have led to its place, which is elsewhere.
    Link(LinkId),
    /// A link that should have led to its place, which looks different.
    Look(LinkId),
    /// The bounds of the relation between two places at which the robot was recognized.
    Relation {
        /// Place where the move began.
        from: PlaceId,
        /// Place where the move ended.
        to: PlaceId,
    },
}

/// Part of the mapper that proposes that two places are one, or that one is two. In the order in
/// which they are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Restructurer {
    /// Positions: geometric constraints.
    Geometry,
    /// Ways of a static world: an action leads from a place to one place. Beyond the paper.
    OneWay,
    /// Turns round a rectangle. Beyond the paper.
    Winding,
    /// Links: local path constraints.
    LocalPath,
    /// Histories of tracks: non-local path constraints.
    NonLocalPath,
    /// Looks along equal actions. Beyond the paper.
    Looks,
}

/// A change of the map's structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Restructured {
    /// Two places turned out to be one.
    Merged {
        /// The place that remains.
        kept: PlaceId,
        /// Place whose id now stands for the other.
        merged: PlaceId,
        /// The first in order that proposed it.
        by: Restructurer,
    },
    /// One place turned out to be two.
    Split {
        /// The place that remains.
        kept: PlaceId,
        /// The new place.
        new: PlaceId,
        /// Who proposed it.
        by: Restructurer,
    },
    /// A place turned out not to exist.
    PlaceElided(PlaceId),
    /// A link turned out not to exist.
    LinkElided(LinkId),
}

/// One action of a plan, along a known link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanStep {
    /// Action to take.
    pub action: Action,
    /// Place to which the action most often led.
    pub to: PlaceId,
}
