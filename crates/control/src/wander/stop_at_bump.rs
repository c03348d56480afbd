use tolman_robot::Bumps;

use super::{LegEnd, LegStep};

/// The lowest layer: the leg ends where the body touches something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StopAtBump {
    /// Whether this leg has made a step. Touches before the leg do not count.
    has_moved: bool,
}

impl StopAtBump {
    /// Starts a new leg.
    pub const fn begin(&mut self) {
        self.has_moved = false;
    }

    /// Corrects the proposal of the layers above for this time step.
    pub fn correct(&mut self, proposal: LegStep, sensing: &impl Bumps) -> LegStep {
        let bumped = self.has_moved && sensing.bump() == Some(true);
        self.has_moved = true;
        if bumped {
            LegStep::end(LegEnd::Bumped)
        } else {
            proposal
        }
    }
}
