//! What the observer answers.

use alloc::vec::Vec;

use tolman_geom::PointBox;

use super::{Action, LinkId, Matcher, PlaceId, TrackId};

/// What became of a move.
#[derive(Clone, Debug, PartialEq)]
pub struct StepReport {
    /// Number of the move, from 1.
    pub number: u64,
    /// Every track that lives on, the best first.
    pub tracks: Vec<TrackReport>,
    /// What cannot all be true, with the culprit. Nothing is narrowed by it.
    pub contradictions: Vec<Contradiction>,
    /// How the map was restructured, in this order.
    pub restructured: Vec<Restructured>,
}

/// What became of a track.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackReport {
    /// Which.
    pub track: TrackId,
    /// Where it was.
    pub from: PlaceId,
    /// How it came to its place, or `None` if the move was blocked.
    pub matcher: Option<Matcher>,
    /// Where it is.
    pub place: PlaceId,
    /// How far it is trusted, 0 … 1.
    pub confidence: f64,
    /// What the map predicted before the move.
    pub predicted: Option<Predicted>,
    /// How the map has the move now that it is updated: from the place it was to the one it is, m,
    /// or `None` if it knows no way in the reference graph.
    pub motion: Option<PointBox>,
}

/// What the map expects of an action at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Predicted {
    /// Where it leads.
    pub place: PlaceId,
    /// How probable that is, by the counts of the links; those of an action at a place sum to 1.
    pub probability: f64,
    /// The displacement there, m, or `None` if the reference graph does not relate the two.
    pub displacement: Option<PointBox>,
}

/// Two things that cannot both be true: a bound was broken, or places were confused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contradiction {
    /// The track that noticed.
    pub track: TrackId,
    /// What is to blame, if not the move itself.
    pub culprit: Culprit,
    /// The displacement as the map has it, m.
    pub known: PointBox,
    /// The displacement as the move has it, m.
    pub estimate: PointBox,
}

/// What a move contradicts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Culprit {
    /// A link that should have led to its place, which is elsewhere.
    Link(LinkId),
    /// A link that should have led to its place, which looks different.
    Look(LinkId),
    /// What is known of two places that the robot was recognized at.
    Relation {
        /// Where the move began.
        from: PlaceId,
        /// Where it ended.
        to: PlaceId,
    },
}

/// A change of the map's structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Restructured {
    /// Two places turned out to be one.
    Merged {
        /// What remains.
        kept: PlaceId,
        /// What is now called the same.
        merged: PlaceId,
    },
    /// One place turned out to be two.
    Split {
        /// What remains.
        kept: PlaceId,
        /// What is new.
        new: PlaceId,
    },
    /// A place turned out not to exist.
    PlaceElided(PlaceId),
    /// A link turned out not to exist.
    LinkElided(LinkId),
}

/// One action of a plan: of a way over known links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanStep {
    /// What to do.
    pub action: Action,
    /// Where it most often led.
    pub to: PlaceId,
}
