use rand::Rng;
use tolman_maze::Direction;

use crate::{Layer, Outcome, Proposal, Situation};

/// The last resort before a wall (MSLST, "Avoid").
///
/// Works only while the robot translates, on the beams in the direction of travel. If any of the
/// three in the middle is below the buffer, the translation stops and the action ends. It is cut
/// short if a step was already made, and failed if not. The eight beside them end it only when far
/// below the buffer, and otherwise add a small turn away from the nearest wall.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Avoid {
    /// Clear distance wanted ahead, from the robot's centre, m. Paper: 0.9 units.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub buffer: f64,
    /// Range beside the middle at or below which the action ends, too, m. Paper: "much less than
    /// the buffer"; here half of it.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub far_below: f64,
    /// Turn command, a fraction of the full turn rate, that is added to turn away from a wall
    /// beside. Paper: "a small rotation"; here 0.05, as Center's.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub turn: f64,
    /// Number of beams from the middle one that are "directly in front" on either side. Paper: 1
    /// of 72.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::beams"))]
    pub ahead: usize,
    /// Number of beams beyond those, on either side, that are watched. Paper: 4 of 72.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::beams"))]
    pub beside: usize,
    /// Whether the present action has made a step ahead, and a step back.
    #[cfg_attr(feature = "serde", serde(skip))]
    stepped: Steps,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Steps {
    ahead: bool,
    back: bool,
}

impl Avoid {
    /// Returns the paper's figures for a ring of `beams` on a robot `robot_unit` metres in
    /// diameter.
    #[must_use]
    pub fn paper(beams: u32, robot_unit: f64) -> Self {
        let share = |of_72: usize| (of_72 * beams as usize).div_ceil(72);
        Self {
            buffer: 0.9 * robot_unit,
            far_below: 0.45 * robot_unit,
            turn: 0.05,
            ahead: share(1),
            beside: share(4),
            stepped: Steps::default(),
        }
    }
}

impl Layer for Avoid {
    fn begin(&mut self, _action: Direction) {
        self.stepped = Steps::default();
    }

    fn correct(
        &mut self,
        mut proposal: Proposal,
        situation: &Situation<'_>,
        _rng: &mut dyn Rng,
    ) -> Proposal {
        let translate = proposal.command.translate;
        let ranges = &situation.view.scan.ranges;
        let beams = ranges.len();
        if translate == 0.0 || beams == 0 {
            return proposal;
        }
        let middle = if translate > 0.0 { 0 } else { beams / 2 };
        let left = |offset: usize| ranges[(middle + offset) % beams];
        let right = |offset: usize| ranges[(middle + beams - offset % beams) % beams];
        let nearest = |from: usize, to: usize, side: &dyn Fn(usize) -> f64| {
            (from..=to).map(side).fold(f64::INFINITY, f64::min)
        };

        let stepped = if translate > 0.0 {
            &mut self.stepped.ahead
        } else {
            &mut self.stepped.back
        };

        let front = nearest(0, self.ahead, &left).min(nearest(0, self.ahead, &right));
        let beside_left = nearest(self.ahead + 1, self.ahead + self.beside, &left);
        let beside_right = nearest(self.ahead + 1, self.ahead + self.beside, &right);
        let beside = beside_left.min(beside_right);

        if front < self.buffer || beside < self.far_below {
            proposal.command.translate = 0.0;
            proposal.ends = Some(if *stepped {
                Outcome::CutShort
            } else {
                Outcome::Failed
            });
            return proposal;
        }
        if beside < self.buffer {
            // Left and right of the direction of travel, so the sign holds backward as well.
            proposal.command.turn += if beside_left < beside_right {
                -self.turn
            } else {
                self.turn
            };
        }
        *stepped = true;
        proposal
    }
}
