use tolman_planners::moves::{MoveDecision, MoveExplorer};

use super::SIDE;
use super::driver::{Next, Search, View};

/// Explores until the best run is known for certain: see [`MoveExplorer`].
#[derive(Clone, Debug)]
pub struct Certify(MoveExplorer<SIDE>);

impl Certify {
    /// A search by an explorer that has seen nothing.
    #[must_use]
    pub const fn new(explorer: MoveExplorer<SIDE>) -> Self {
        Self(explorer)
    }
}

impl Search for Certify {
    fn next(&mut self, view: &View<'_>) -> Next {
        match self.0.decide(view.map, view.goals, view.at) {
            MoveDecision::Drive(leap) => Next::Drive(leap),
            MoveDecision::Turn => Next::Turn,
            MoveDecision::Finished { .. } => Next::Reset,
            MoveDecision::Stuck => Next::Stuck,
        }
    }
}
