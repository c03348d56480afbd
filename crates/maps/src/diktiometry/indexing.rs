//! Indexing: "to find likely candidate states to feed to the matcher". It gives streams of sets of
//! candidates, the best set first.

mod active_frames;
mod expectational;
mod geometric;
mod perceptual;

use tolman_geom::{Point, PointBox};

pub use active_frames::ActiveFrame;
pub(super) use active_frames::moved;
pub(super) use expectational::expected;
pub(super) use geometric::plies;
pub(super) use perceptual::ViewIndex;

use super::{Apart, Diktiometry, PlaceId};

/// A place that the robot may be at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    pub(super) place: PlaceId,
    /// Projected position of the robot in the place's own frame, m.
    pub(super) robot: PointBox,
    /// Position of the place relative to the robot, m: contains 0 if the robot may be at the place.
    pub(super) offset: PointBox,
    pub(super) expectation: Expectation,
}

/// Whether the path graph predicted the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expectation {
    Expected,
    Unexpected,
}

impl Candidate {
    /// Returns a place, with the robot projected to be at `robot` in its frame, m.
    fn new(map: &Diktiometry, place: PlaceId, robot: PointBox, expectation: Expectation) -> Self {
        Self {
            place,
            robot,
            offset: map.place(place).position - robot,
            expectation,
        }
    }

    /// Returns whether the robot may be at the place.
    pub(super) fn is_possible(&self) -> bool {
        self.offset.contains(Point::origin())
    }

    /// Returns whether the robot can be at no other place, if all others are at least
    /// `least_distance` away, measured by `apart`.
    pub(super) fn is_certain(&self, apart: Apart, least_distance: f64) -> bool {
        self.is_possible() && apart.most(self.offset) < least_distance
    }
}
