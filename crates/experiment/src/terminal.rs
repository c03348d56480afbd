//! Progress on a terminal.

use alloc::sync::Arc;
use core::fmt;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::io::{IsTerminal, Write};
use std::sync::OnceLock;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use super::{Progress, ProgressEvent, Remedy};

/// Progress on standard error: on a terminal a bar with rate and time left, elsewhere nothing.
/// Folders set aside and broken lines are reported in both cases.
#[derive(Debug, Default)]
pub struct Terminal {
    stop: Arc<AtomicBool>,
    bar: OnceLock<ProgressBar>,
}

impl Terminal {
    /// Returns a progress display that asks the runner to stop once `stop` is set, for example by
    /// Ctrl-C.
    pub fn new(stop: Arc<AtomicBool>) -> Self {
        Self {
            stop,
            bar: OnceLock::new(),
        }
    }

    /// Writes a line above the bar. Nothing happens if standard error is closed.
    fn line(&self, text: &str) {
        let write = || {
            let _ = writeln!(std::io::stderr(), "{}", tolman_draw::visible(text));
        };
        match self.bar.get() {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }
}

impl Progress for Terminal {
    fn event(&self, event: &ProgressEvent<'_>) {
        match event {
            ProgressEvent::SetAside {
                folder,
                moved_to,
                reason,
            } => self.line(&format!(
                "{} held results of {reason}; they are now in {}",
                folder.display(),
                moved_to.display()
            )),
            ProgressEvent::BrokenLine {
                file,
                line,
                what,
                remedy,
            } => self.line(&format!(
                "{}:{line}: {what}; {}",
                file.display(),
                match remedy {
                    Remedy::PlayedAgain => "the run is played again",
                    Remedy::Ignored => "the line is ignored",
                    Remedy::MissingPlayed =>
                        "the line is ignored and what runs are missing are played again",
                }
            )),
            ProgressEvent::Started { total, reused } => {
                if *reused > 0 {
                    self.line(&format!("{reused} of {total} runs are there from before"));
                }
                let bar = ProgressBar::with_draw_target(Some(*total), target()).with_style(style());
                // Reused runs count as done, but not for the rate.
                bar.set_position(*reused);
                bar.reset_eta();
                bar.reset_elapsed();
                let _ = self.bar.set(bar);
            }
            ProgressEvent::RunFinished => {
                if let Some(bar) = self.bar.get() {
                    bar.inc(1);
                }
            }
            ProgressEvent::RunsFinished { played, elapsed } => {
                if let Some(bar) = self.bar.get() {
                    bar.finish_and_clear();
                }
                if on_terminal() {
                    self.line(&format!(
                        "{played} runs in {}{}",
                        duration(*elapsed),
                        rate(*played, *elapsed)
                    ));
                }
            }
            ProgressEvent::Skipped { what } => self.line(what),
            ProgressEvent::Recording => {
                if on_terminal() {
                    self.line("recording the first runs of each row for the report");
                }
            }
        }
    }

    fn stop_requested(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:30} {pos}/{len} runs  {rate}  {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key("rate", |state: &ProgressState, out: &mut dyn fmt::Write| {
            // A bar that cannot be written is simply not shown.
            let _ = write!(out, "{:.0} a second", state.per_sec());
        })
}

fn target() -> ProgressDrawTarget {
    if on_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    }
}

fn on_terminal() -> bool {
    std::io::stderr().is_terminal()
}

/// Returns a duration for readers: `0.4 s`, `41 s`, `2 min 5 s`.
pub(crate) fn duration(duration: Duration) -> String {
    let seconds = duration.as_secs_f64();
    if seconds < 9.95 {
        return format!("{seconds:.1} s");
    }
    let whole = duration.as_secs() + u64::from(duration.subsec_millis() >= 500);
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds} s"),
        (hours, minutes, _) => format!("{hours} h {minutes} min"),
    }
}

fn rate(played: u64, elapsed: Duration) -> String {
    let seconds = elapsed.as_secs_f64();
    if played > 0 && seconds > 0.0 {
        format!(", {:.0} a second", played as f64 / seconds)
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_for_readers() {
        for (milliseconds, expect) in [
            (0, "0.0 s"),
            (9_949, "9.9 s"),
            (9_960, "10 s"),
            (59_600, "1 min 0 s"),
            (125_000, "2 min 5 s"),
            (3_725_000, "1 h 2 min"),
        ] {
            assert_eq!(duration(Duration::from_millis(milliseconds)), expect);
        }
    }
}
