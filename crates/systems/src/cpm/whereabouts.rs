use tolman_maps::cpm::Location;

use super::walker::Observation;

/// Way of a robot that was put down in mid-fragment to its first place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approach {
    /// Goes to the place ahead: it "continues moving forward until the first junction is found"
    /// (section 8).
    StraightOn,
    /// Goes to the place ahead. If the robot is not sure of its place when that place comes into
    /// sight, it turns round and goes to the other end. Ours: it sees the whole fragment and both
    /// ends before it enters any place.
    ToAndFro,
}

/// Probability of a place above which the robot is sure of it and stops searching.
pub(super) const SURE: f64 = 0.95;

/// Knowledge of its place by a robot that was put down anywhere.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Whereabouts {
    /// Whether the robot turned round before the first place.
    pub has_turned_round: bool,
    /// Belief at each visited place: the fragment by which it came, and the port behind it.
    pub at_places: Vec<Location>,
    /// Belief when each place first came into sight; `None` if there were no observations yet.
    pub under_way: Vec<Option<Location>>,
    /// Observations along each fragment walked from end to end.
    pub walks: Vec<Vec<Observation>>,
}

impl Whereabouts {
    /// Returns the final belief: the place to which its last fragment has led it.
    #[must_use]
    pub fn here(&self) -> Option<Location> {
        self.at_places.last().copied()
    }

    /// Returns whether the robot is sure of its final belief.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.here().is_some_and(|here| here.probability > SURE)
    }
}
