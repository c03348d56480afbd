/// Command of a drive, as fractions of its full turn rate and full speed. Source: Pyrobot's
/// `move(translate, rotate)`, in which MSLST is written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TurnTranslate {
    /// Fraction of the full turn rate, −1 … 1; positive is counter-clockwise.
    pub turn: f64,
    /// Fraction of the full speed, −1 … 1; positive is ahead.
    pub translate: f64,
}

impl TurnTranslate {
    /// Command of a robot that stands still.
    pub const STOP: Self = Self {
        turn: 0.0,
        translate: 0.0,
    };
}

impl crate::Standstill for TurnTranslate {
    const STOP: Self = Self::STOP;
}
