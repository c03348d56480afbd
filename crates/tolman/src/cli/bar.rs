//! Progress shown on a terminal.

use core::time::Duration;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use tolman_draw::visible;

/// Progress of a run, shown on a terminal unless the run itself is shown there.
pub(super) struct Doing {
    bar: ProgressBar,
    next: Instant,
}

impl Doing {
    /// Returns a progress display, which stays hidden if the run itself is shown.
    pub(super) fn new(is_shown: bool) -> Self {
        let bar = match is_shown {
            true => ProgressBar::hidden(),
            false => ProgressBar::new_spinner(),
        };
        Self {
            bar,
            next: Instant::now() + PERIOD,
        }
    }

    /// Shows the text that `words` returns, at most once every [`PERIOD`].
    pub(super) fn show(&mut self, words: impl FnOnce() -> String) {
        if !self.bar.is_hidden() && Instant::now() >= self.next {
            self.next = Instant::now() + PERIOD;
            self.bar.set_message(visible(&words()).into_owned());
            self.bar.tick();
        }
    }

    /// Removes the progress from the terminal.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

/// Shortest time between two updates.
const PERIOD: Duration = Duration::from_millis(200);

/// Returns a sign on the terminal that the program is at work on something, with the time so far.
/// It stays hidden if the run itself is shown.
pub(super) fn busy(what: &str, is_shown: bool) -> ProgressBar {
    if is_shown {
        return ProgressBar::hidden();
    }
    let bar = bar(0, "{spinner} {msg}, {elapsed}");
    bar.set_message(visible(what).into_owned());
    bar.enable_steady_tick(PERIOD);
    bar
}

/// Returns a progress bar of `length` steps on stderr; it is drawn only on a terminal.
pub(super) fn bar(length: u32, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length.into()).with_style(style)
}
