use rand::{Rng, RngExt};

use crate::{Layer, Outcome, Proposal, Situation};

/// Keeps the robot facing along the corridor it is in (MSLST, "Orient").
///
/// - **Turn**: adds 0.04 for each beam between the robot's heading and the corridor's axis.
/// - **Contradiction**: the paper lets the action fail when that turn "contradicts the rotation
///   Move requested". Here that has two cases. The two have opposite signs. Or the robot is aligned
///   to the nearest beam, and Move asks for more than an eighth of a circle. In a corridor, that
///   leads to the wall. So a robot told to go across the corridor fails in its first step wherever
///   it looks. The step that fails carries out Orient's own turn.
/// - **Stuck**: where the walls are noticeably nearer than the corridor is wide, the robot stands
///   in a corner: a small random translation is added instead.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Orient {
    /// Turn command per beam of misalignment. Paper: 0.04 at 72 beams.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub turn_per_beam: f64,
    /// Move's turn command for an eighth of a circle: its 0.0105 a degree times 45.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub across_above: f64,
    /// Misalignment at which the robot stands square across the corridor, beams: a quarter circle.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::positive"))]
    pub square_beams: f64,
    /// Width below which a sum of ranges is a corner, m. Paper: "noticeably less than the width";
    /// here 0.95 widths, since in a corridor the least sum is the width to within half a percent.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub corner_below: f64,
    /// Largest random translation out of a corner. Paper: "small"; here 0.1.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub nudge: f64,
}

impl Orient {
    /// Returns the paper's gains for a ring of `beams` in corridors `width` metres wide.
    #[must_use]
    pub fn paper(beams: u32, width: f64) -> Self {
        // The gain is given per beam of 5°; other rings turn the same for the same angle.
        let degrees_per_beam = 360.0 / f64::from(beams);
        Self {
            turn_per_beam: 0.04 * degrees_per_beam / 5.0,
            across_above: 0.0105 * 45.0,
            square_beams: f64::from(beams) / 4.0,
            corner_below: 0.95 * width,
            nudge: 0.1,
        }
    }

    /// Returns whether Move's `requested` turn contradicts Orient's own.
    fn contradicts(&self, requested: f64, turn: f64) -> bool {
        requested * turn < 0.0 || (turn == 0.0 && requested.abs() > self.across_above)
    }
}

impl Layer for Orient {
    fn correct(
        &mut self,
        mut proposal: Proposal,
        situation: &Situation<'_>,
        rng: &mut dyn Rng,
    ) -> Proposal {
        let Some(corridor) = situation.corridor else {
            return proposal;
        };
        if corridor.narrowest < self.corner_below {
            proposal.command.translate += self.nudge * rng.random_range(-1.0..=1.0);
            return proposal;
        }
        let misaligned = f64::from(corridor.misaligned_beams);
        let mut turn = self.turn_per_beam * misaligned;
        if misaligned.abs() >= self.square_beams {
            // Square across, both ways to the axis are as long: take Move's.
            turn = libm::copysign(turn, proposal.command.turn);
        }
        if self.contradicts(proposal.command.turn, turn) {
            proposal.command.turn = turn;
            proposal.command.translate = 0.0;
            proposal.ends = Some(Outcome::Failed);
        } else {
            proposal.command.turn += turn;
        }
        proposal
    }
}
