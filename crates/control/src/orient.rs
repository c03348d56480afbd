use rand::{Rng, RngExt};

use crate::{Layer, Outcome, Proposal, Situation};

/// Keeps the robot facing along the corridor it is in (MSLST, "Orient").
///
/// - **Turn**: adds 0.04 for each beam between the robot's heading and the corridor's axis.
/// - **Contradiction**: the paper lets the action fail when that turn "contradicts the rotation Move
///   requested". Here: the turn that Move asks for would leave the robot further from the axis than
///   it is, by more than `slack_beams`. So a robot that is already aligned and told to turn to
///   the wall fails in its first step, without turning; one that stands askew may turn to the axis by
///   either way; and Orient's own turn is carried out in the step that fails.
/// - **Stuck**: where the walls are noticeably nearer than the corridor is wide, the robot stands in a
///   corner: a small random translation is added instead.
#[derive(Clone, Debug, PartialEq)]
pub struct Orient {
    /// Turn command per beam of misalignment. Paper: 0.04 at 72 beams.
    pub turn_per_beam: f64,
    /// Move's turn command per beam of heading error: its 0.0105 a degree times the beam spacing.
    pub requested_per_beam: f64,
    /// How many beams Move may turn away from the axis before it contradicts. One beam is as finely
    /// as the axis is seen, so: 1.
    pub slack_beams: f64,
    /// Beams in the half circle.
    pub half_circle_beams: f64,
    /// Narrower than this is a corner, m. Paper: "noticeably less than the width"; here 0.85 widths.
    pub corner_below: f64,
    /// Largest random translation out of a corner. Paper: "small"; here 0.1.
    pub nudge: f64,
}

impl Orient {
    /// The paper's gains for a ring of `beams` in corridors `width` metres wide.
    #[must_use]
    pub fn paper(beams: u32, width: f64) -> Self {
        // The gain is given per beam of 5°; other rings turn the same for the same angle.
        let degrees_per_beam = 360.0 / f64::from(beams);
        Self {
            turn_per_beam: 0.04 * degrees_per_beam / 5.0,
            requested_per_beam: 0.0105 * degrees_per_beam,
            slack_beams: 1.0,
            half_circle_beams: f64::from(beams) / 2.0,
            corner_below: 0.85 * width,
            nudge: 0.1,
        }
    }

    /// Whether turning by the `requested` command's full angle ends further from an axis that lies
    /// `misaligned` beams away.
    fn contradicts(&self, requested: f64, misaligned: f64) -> bool {
        let left_over = misaligned - requested / self.requested_per_beam;
        // The axis has no front: half a circle away is the axis again.
        let wrapped =
            left_over - self.half_circle_beams * libm::round(left_over / self.half_circle_beams);
        wrapped.abs() > misaligned.abs() + self.slack_beams
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
            proposal.command.translate += rng.random_range(-self.nudge..=self.nudge);
            return proposal;
        }
        let misaligned = f64::from(corridor.misaligned_beams);
        let turn = self.turn_per_beam * misaligned;
        if self.contradicts(proposal.command.turn, misaligned) {
            proposal.command.turn = turn;
            proposal.command.translate = 0.0;
            proposal.ends = Some(Outcome::Failed);
        } else {
            proposal.command.turn += turn;
        }
        proposal
    }
}
