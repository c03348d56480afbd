//! The colours of the view, or none: of the sixteen that every terminal has and its owner has
//! chosen, none of them one that vanishes on a light or on a dark ground.

use ratatui::style::{Color, Modifier, Style};
use tolman_experiment::Ink;

pub(super) const WALLS: Color = Color::Reset;
pub(super) const TRAIL: Color = Color::Cyan;
pub(super) const BEAMS: Color = Color::DarkGray;
pub(super) const DESTINATION: Color = Color::Green;
/// The map that the robot learned.
pub(super) const MAP: Color = Color::Blue;
/// Where the robot believes to be.
pub(super) const BELIEF: Color = Color::Yellow;
pub(super) const ROBOT: Color = Color::Magenta;
/// Where the robot bumps.
pub(super) const BUMP: Color = Color::Red;

/// What stands beside the values.
pub(super) const LABEL: Style = Style::new().add_modifier(Modifier::DIM);

/// Returns what a colour becomes with such ink.
pub(super) const fn inked(color: Color, ink: Ink) -> Color {
    match ink {
        Ink::Plain => Color::Reset,
        Ink::Coloured => color,
    }
}
