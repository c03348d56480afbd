use std::path::PathBuf;

use super::Failure;
use super::replay_file::{self, Overwrite};

/// How somebody looks at a run.
#[derive(clap::Args)]
pub(super) struct Looks {
    /// Show it on the terminal as it goes; space pauses, → steps, + and - change the speed, q stops looking
    #[arg(long)]
    pub(super) live: bool,
    /// Draw its way over the maze
    #[arg(long, value_name = "FILE")]
    pub(super) svg: Option<PathBuf>,
    /// Write the run down step by step, as JSON lines: world, robot, and every command, true pose, bump and
    /// scan
    #[arg(long, value_name = "FILE")]
    pub(super) trace: Option<PathBuf>,
    /// Write a replay: one HTML file that plays the run in any browser
    #[arg(long, value_name = "FILE")]
    pub(super) replay: Option<PathBuf>,
    /// Overwrite the replay's file even if it is no replay
    #[arg(long, requires = "replay")]
    pub(super) force: bool,
    /// Write the outcome as JSON
    #[arg(long)]
    pub(super) json: bool,
}

impl Looks {
    /// Returns what the replay may overwrite, before the work is done.
    ///
    /// # Errors
    /// Bad input if its file is there and is no replay.
    pub(super) fn overwrite(&self) -> Result<Overwrite, Failure> {
        let overwrite = Overwrite::if_forced(self.force);
        if let Some(path) = &self.replay {
            replay_file::check(path, overwrite)?;
        }
        Ok(overwrite)
    }
}
