//! The colours of the view, or none.

use ratatui::style::{Color, Modifier, Style};
use tolman_experiment::Ink;

/// Colours of the sixteen that every terminal has and its owner has chosen, none of them one that vanishes on
/// a light or on a dark ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Palette {
    pub(super) walls: Color,
    pub(super) trail: Color,
    pub(super) beams: Color,
    pub(super) destination: Color,
    pub(super) robot: Color,
    /// Where the robot bumps.
    pub(super) bump: Color,
}

impl Palette {
    pub(super) const fn of(ink: Ink) -> Self {
        match ink {
            Ink::Plain => Self {
                walls: Color::Reset,
                trail: Color::Reset,
                beams: Color::Reset,
                destination: Color::Reset,
                robot: Color::Reset,
                bump: Color::Reset,
            },
            Ink::Coloured => Self {
                walls: Color::Reset,
                trail: Color::Cyan,
                beams: Color::DarkGray,
                destination: Color::Green,
                robot: Color::Magenta,
                bump: Color::Red,
            },
        }
    }

    /// What stands beside the values.
    pub(super) const fn label() -> Style {
        Style::new().add_modifier(Modifier::DIM)
    }
}
