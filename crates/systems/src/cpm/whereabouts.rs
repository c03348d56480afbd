use tolman_maps::cpm::Location;

use super::walker::Observation;

/// The way to the first place for a robot that was put down in mid-fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approach {
    /// To the one ahead: it "continues moving forward until the first junction is found" (section
    /// 8).
    StraightOn,
    /// To the one ahead. If the robot is not sure of its place when that comes into sight, it turns
    /// round and goes to the one at the other end. Ours: it sees the whole fragment and both ends
    /// before it enters any place.
    ToAndFro,
}

/// Probability from which a robot knows where it is and stops searching.
pub(super) const SURE: f64 = 0.95;

/// What a robot that was put down somewhere found out about its place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whereabouts {
    /// Whether it turned round before the first place.
    pub has_turned_round: bool,
    /// Its belief at each place it came to: the fragment it came by, and the port behind it.
    pub at_places: Vec<Location>,
    /// Its belief before each of them, when it first saw it ahead; `None` if it had observed
    /// nothing.
    pub under_way: Vec<Option<Location>>,
    /// Its observations along each fragment it walked whole, from end to end.
    pub walks: Vec<Vec<Observation>>,
}

impl Whereabouts {
    /// Returns where it believes to be in the end: at the place to which that fragment has led it.
    #[must_use]
    pub fn here(&self) -> Option<Location> {
        self.at_places.last().copied()
    }

    /// Returns whether it is sure of that.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.here().is_some_and(|here| here.probability > SURE)
    }
}
