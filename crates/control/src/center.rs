use rand::Rng;

use crate::{Layer, Proposal, Situation};

/// Steers to the middle of a corridor while the robot moves (MSLST, "Center").
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Center {
    /// Ratio of the distances to the two walls above which it steers. Paper: 1.25.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub ratio: f64,
    /// Turn command, a fraction of the full turn rate, that is added towards the middle. Paper:
    /// 0.05.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub turn: f64,
}

impl Center {
    /// Returns the paper's gains.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            ratio: 1.25,
            turn: 0.05,
        }
    }
}

impl Layer for Center {
    fn correct(
        &mut self,
        mut proposal: Proposal,
        situation: &Situation<'_>,
        _rng: &mut dyn Rng,
    ) -> Proposal {
        let translate = proposal.command.translate;
        if situation.corridor.is_none() || translate == 0.0 {
            return proposal;
        }
        let ranges = &situation.view.scan.ranges;
        let beam = |quarters: usize| ranges.get(quarters * ranges.len() / 4);
        let (Some(left), Some(right)) = (beam(1), beam(3)) else {
            return proposal;
        };
        let towards_middle = if *left > self.ratio * *right {
            self.turn
        } else if *right > self.ratio * *left {
            -self.turn
        } else {
            0.0
        };
        // Backing up, the nose has to point away from the middle for the tail to go there.
        proposal.command.turn += if translate > 0.0 {
            towards_middle
        } else {
            -towards_middle
        };
        proposal
    }
}
