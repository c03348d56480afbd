use tolman_maps::cpm::Location;

use super::walker::Observation;

/// How a robot goes to the first place that was put down amid a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approach {
    /// To the one ahead: it "continues moving forward until the first junction is found" (section
    /// 8).
    StraightOn,
    /// To the one ahead; but if it is not sure where it is when that comes into sight, it turns
    /// round and goes to the one at the other end. Ours: before it enters any place it has seen the
    /// whole fragment, and both ends.
    ToAndFro,
}

/// How sure a robot is that knows where it is, 0 … 1: it looks no further.
pub(super) const SURE: f64 = 0.95;

/// What a robot that was put down somewhere found out about where it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whereabouts {
    /// Whether it turned round before the first place.
    pub has_turned_round: bool,
    /// What it believed at each place it came to: the fragment it came by, and the port behind it.
    pub at_places: Vec<Location>,
    /// What it believed before each of them, when it first saw it ahead, or `None` if it had
    /// observed nothing at all, and so does not know.
    pub under_way: Vec<Option<Location>>,
    /// What it saw along each fragment it walked whole, from end to end.
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
