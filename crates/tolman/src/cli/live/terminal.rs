//! The view that fills the whole terminal.

mod pace;
mod palette;
mod picture;
mod screen;
mod view;
mod window;
mod wish;

use super::Scene;
use crate::cli::{Result, ink, interrupt};
pub(super) use screen::Screen;
use view::{View, fits_the_terminal};

/// Returns a screen that shows a run before its first step, or `None` if there is no terminal to
/// draw on.
pub(super) fn screen(scene: Scene) -> Result<Option<Screen>> {
    if !fits_the_terminal() {
        return Ok(None);
    }
    let view = View::new(scene, ink());
    // A terminal without a keyboard gets the single line, too.
    Ok(Screen::open(view, interrupt::flag()?).ok())
}
