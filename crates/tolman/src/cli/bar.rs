//! Progress on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// Returns a bar on stderr that shows, on a terminal, how much of `length` is done.
pub(super) fn bar(length: u32, template: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length.into()).with_style(style)
}
