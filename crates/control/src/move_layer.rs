use rand::Rng;
use tolman_geom::{Heading, Vector};
use tolman_maze::Direction;
use tolman_robot::TurnTranslate;

use crate::{Layer, Outcome, Proposal, Situation};

/// Returns the heading of a compass direction.
#[must_use]
pub const fn heading_of(direction: Direction) -> Heading {
    match direction {
        Direction::North => Heading::NORTH,
        Direction::East => Heading::EAST,
        Direction::South => Heading::SOUTH,
        Direction::West => Heading::WEST,
    }
}

/// Returns the vector of one metre in a compass direction, exactly along an axis.
#[must_use]
pub const fn unit_of(direction: Direction) -> Vector {
    let (east, north) = direction.step();
    Vector::new(east as f64, north as f64)
}

/// The top layer: expands a direction into a turn and a translation (MSLST, "Move").
///
/// It turns in proportion to the heading error until the error is within the tolerance. Then it
/// translates for a fixed number of steps, without checking distance or heading. Forward and
/// backward are the same to it: it takes whichever turns less.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Move {
    /// Turn command per degree of heading error. Paper: 0.0105.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub turn_per_degree: f64,
    /// Heading error at which turning ends, degrees. Paper: 4.
    #[cfg_attr(
        feature = "serde",
        serde(deserialize_with = "crate::read::at_least_zero")
    )]
    pub tolerance_deg: f64,
    /// Translation command. Paper: 0.25.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::read::finite"))]
    pub translate: f64,
    /// Number of steps of translation that make an action. Paper: 2.
    pub translate_steps: u32,
    #[cfg_attr(feature = "serde", serde(skip, default = "north"))]
    target: Heading,
    #[cfg_attr(feature = "serde", serde(skip, default = "turning"))]
    phase: Phase,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Turning,
    Translating { ahead: bool, steps_left: u32 },
}

#[cfg(feature = "serde")]
const fn north() -> Heading {
    Heading::NORTH
}

#[cfg(feature = "serde")]
const fn turning() -> Phase {
    Phase::Turning
}

impl Move {
    /// Returns the paper's gains.
    #[must_use]
    pub const fn paper() -> Self {
        Self {
            turn_per_degree: 0.0105,
            tolerance_deg: 4.0,
            translate: 0.25,
            translate_steps: 2,
            target: Heading::NORTH,
            phase: Phase::Turning,
        }
    }

    fn translated(&mut self, ahead: bool, steps_left: u32) -> Proposal {
        let steps_left = steps_left - 1;
        self.phase = Phase::Translating { ahead, steps_left };
        Proposal {
            command: TurnTranslate {
                turn: 0.0,
                translate: if ahead {
                    self.translate
                } else {
                    -self.translate
                },
            },
            ends: (steps_left == 0).then_some(Outcome::Completed),
        }
    }
}

impl Layer for Move {
    fn begin(&mut self, action: Direction) {
        self.target = heading_of(action);
        self.phase = Phase::Turning;
    }

    fn correct(
        &mut self,
        _proposal: Proposal,
        situation: &Situation<'_>,
        _rng: &mut dyn Rng,
    ) -> Proposal {
        if let Phase::Translating {
            ahead,
            steps_left: steps_left @ 1..,
        } = self.phase
        {
            return self.translated(ahead, steps_left);
        }
        let heading = situation.view.heading;
        let forward = heading.turn_to(self.target).to_degrees();
        let backward = heading.turn_to(self.target.reversed()).to_degrees();
        let ahead = forward.abs() <= backward.abs();
        let error_deg = if ahead { forward } else { backward };
        if error_deg.abs() <= self.tolerance_deg {
            return self.translated(ahead, self.translate_steps.max(1));
        }
        Proposal {
            command: TurnTranslate {
                turn: self.turn_per_degree * error_deg,
                translate: 0.0,
            },
            ends: None,
        }
    }
}
