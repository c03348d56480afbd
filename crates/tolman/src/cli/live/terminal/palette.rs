//! The colours of the view, or none.
//!
//! They are among the sixteen colours that every terminal has and its owner may choose. All of them
//! are visible on light and on dark backgrounds.

use ratatui::style::{Color, Modifier, Style};
use tolman_experiment::Ink;

pub(super) const WALLS: Color = Color::Reset;
pub(super) const TRAIL: Color = Color::Cyan;
pub(super) const BEAMS: Color = Color::DarkGray;
pub(super) const DESTINATION: Color = Color::Green;
/// Colour of the map that the robot learned.
pub(super) const MAP: Color = Color::Blue;
/// Colour of the believed pose.
pub(super) const BELIEF: Color = Color::Yellow;
pub(super) const ROBOT: Color = Color::Magenta;
/// Colour of the robot while it touches something.
pub(super) const BUMP: Color = Color::Red;

/// Style of the labels beside the values.
pub(super) const LABEL: Style = Style::new().add_modifier(Modifier::DIM);

/// Returns `color` if output is coloured, and the terminal's default otherwise.
pub(super) const fn inked(color: Color, ink: Ink) -> Color {
    match ink {
        Ink::Plain => Color::Reset,
        Ink::Coloured => color,
    }
}
