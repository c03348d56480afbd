use tolman_robot::TurnTranslate;

use super::LegStep;

/// The top layer: straight on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GoAhead {
    /// Fraction of the full speed, 0 … 1.
    pub translate: f64,
}

impl GoAhead {
    /// Proposes the next time step.
    #[must_use]
    pub const fn propose(&self) -> LegStep {
        LegStep {
            command: TurnTranslate {
                turn: 0.0,
                translate: self.translate,
            },
            ends: None,
        }
    }
}
