//! Runs GTSAM's graduated non-convexity on the same graph, in a Python that has it.
//!
//! Source: H. Yang, P. Antonante, V. Tzoumas, L. Carlone: Graduated Non-Convexity for Robust
//! Spatial Perception, 2020.

use core::time::Duration;
use std::env;
use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Instant;

use tolman_experiment::BoxError;
use tolman_formats::G2o;

const SCRIPT: &str = include_str!("gnc.py");

/// Maximum duration of GTSAM's run, s.
const CAP: f64 = 600.0;

/// Maximum duration of GTSAM's run, as a multiple of the audit's time.
const TIMES: f64 = 40.0;
const LEAST: f64 = 60.0;

/// A Python with GTSAM.
#[derive(Debug)]
pub(super) struct Gnc {
    python: String,
}

/// Result of the optimizer.
pub(super) struct GncRun {
    /// Duration, or the time limit if it was stopped, s.
    pub(super) seconds: f64,
    pub(super) false_kept: Option<u32>,
    pub(super) true_dropped: Option<u32>,
}

impl Gnc {
    /// Returns the Python that `TOLMAN_PYTHON` names, or `python3`, if it has GTSAM.
    pub(super) fn find() -> Option<Self> {
        let python = env::var("TOLMAN_PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let mut command = Command::new(&python);
        command.args(["-c", "import gtsam"]).stdin(Stdio::null());
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let found = command.status().is_ok_and(|status| status.success());
        found.then_some(Self { python })
    }

    /// Runs GTSAM on a graph whose edges from `right` on are false, with standard deviations
    /// multiplied by `scale`. `ours` is the duration of the audit, s.
    pub(super) fn run(
        &self,
        graph: &G2o,
        right: u32,
        scale: f64,
        ours: f64,
    ) -> Result<GncRun, BoxError> {
        let path = env::temp_dir().join(format!(
            "tolman-gnc-{}-{:?}.g2o",
            std::process::id(),
            thread::current().id()
        ));
        fs::write(&path, graph.text())?;
        let cap = (TIMES * ours).clamp(LEAST, CAP);
        let out = self.answer(&[
            &path.to_string_lossy(),
            &right.to_string(),
            &scale.to_string(),
            &cap.to_string(),
        ]);
        // A file that is not removed does no harm; the answer matters.
        let _ = fs::remove_file(&path);
        let Some(text) = out? else {
            return Ok(GncRun {
                seconds: cap,
                false_kept: None,
                true_dropped: None,
            });
        };
        let numbers: Vec<f64> = text
            .split_whitespace()
            .map(str::parse)
            .collect::<Result<_, _>>()?;
        let [seconds, kept, dropped] = numbers[..] else {
            return Err(format!("GTSAM answered `{text}`").into());
        };
        Ok(GncRun {
            seconds,
            false_kept: Some(kept as u32),
            true_dropped: Some(dropped as u32),
        })
    }

    /// Returns the script's output; `None` if it had to be stopped.
    fn answer(&self, arguments: &[&str; 4]) -> Result<Option<String>, BoxError> {
        let mut command = Command::new(&self.python);
        command.args(["-c", SCRIPT]).args(arguments);
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        // The time limit begins after the graph is read, which takes seconds.
        let cap = Duration::from_secs_f64(arguments[3].parse::<f64>()? + 30.0);
        let start = Instant::now();
        loop {
            if let Some(status) = child.try_wait()? {
                let mut text = String::new();
                if let Some(mut out) = child.stdout.take() {
                    out.read_to_string(&mut text)?;
                }
                return match status.success() {
                    true => Ok(Some(text)),
                    false => Err("GTSAM failed; is it one of PyPI's, 4.2 or newer?".into()),
                };
            }
            if start.elapsed() > cap {
                child.kill()?;
                child.wait()?;
                return Ok(None);
            }
            thread::sleep(Duration::from_millis(20));
        }
    }
}
