use rand::Rng;
use tolman_maze::Direction;

use crate::{Layer, Proposal, Situation};

/// Makes a swing die out: halves the turn each time it changes its side too often within one
/// action. Not in the paper.
///
/// Move and Orient turn by gains, so a turn can miss by as much as it was to correct. That happens
/// where a beam is wider than Move's tolerance, or where a full command turns by more than 108°.
/// The robot would then turn to and fro without end. The paper's robot changes the side seven times
/// an action at most when its motors make no noise. With their noise this layer changes none of its
/// runs in `docs/mslst.md`.
///
/// Stands last, so that it sees what the motors would be told. It helps wherever the robot turns to
/// the side that it is told, by less than half a circle a time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settle {
    /// Changes of side within one action that are left alone. Ours: 20.
    pub patience: u32,
    /// The last turn of this action that was not zero, as the layers above wanted it; zero before
    /// the first.
    last: f64,
    /// Changes of side in this action.
    changes: u32,
}

impl Settle {
    /// Returns our values: more changes of side than the paper's robot makes.
    #[must_use]
    pub const fn ours() -> Self {
        Self {
            patience: 20,
            last: 0.0,
            changes: 0,
        }
    }
}

impl Layer for Settle {
    fn begin(&mut self, _action: Direction) {
        self.last = 0.0;
        self.changes = 0;
    }

    fn correct(
        &mut self,
        mut proposal: Proposal,
        _situation: &Situation<'_>,
        _rng: &mut dyn Rng,
    ) -> Proposal {
        let turn = proposal.command.turn;
        if turn != 0.0 {
            self.changes += u32::from(turn * self.last < 0.0);
            self.last = turn;
        }
        let halvings = self.changes.saturating_sub(self.patience);
        proposal.command.turn *= libm::exp2(-f64::from(halvings));
        if proposal.ends.is_some() {
            // An action that is not followed by another starts again.
            self.last = 0.0;
            self.changes = 0;
        }
        proposal
    }
}
