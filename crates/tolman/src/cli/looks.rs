use std::io::{self, Write};
use std::path::Path;

use anyhow::{Error, anyhow};
use serde_json::Value;
use tolman_replay::Replay;

use super::outputs::{self, Output};
use super::replay_file::{self, Overwrite};
use super::{Failure, Result, file};

/// Help of `--live`.
#[cfg(feature = "live")]
pub(super) const LIVE: &str = "\
Show the run on the terminal. Space pauses, → steps, + and - change the speed, q closes the view";
/// Help of `--live`.
#[cfg(not(feature = "live"))]
pub(super) const LIVE: &str = "\
Show the number of steps and where the robot is, in one line; a build with the feature `live` draws the run";

/// Options for showing and recording a run.
#[derive(clap::Args)]
pub(super) struct Looks {
    #[arg(long, help = LIVE)]
    pub(super) live: bool,
    /// Draw the robot's path over the maze or the world
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["svg"]))]
    pub(super) svg: Option<Output>,
    /// Write a trace of the run, as JSON lines: the world and the robot, then command, outcome and
    /// readings of every step
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["jsonl", "json", "ndjson"]))]
    pub(super) trace: Option<Output>,
    /// Write a replay: one HTML file that plays the run in any browser. If the name ends in .mcap
    /// and the feature `mcap` is on, the file is for Foxglove. The command tolman-rerun writes
    /// .rrd, for Rerun
    #[arg(long, value_name = "FILE", value_parser = outputs::file(outputs::REPLAYS))]
    pub(super) replay: Option<Output>,
    /// Overwrite the replay's file even if it is not a replay
    #[arg(long, requires = "replay")]
    pub(super) force: bool,
    /// Write the outcome as JSON
    #[arg(long)]
    pub(super) json: bool,
}

impl Looks {
    /// Refuses to show more than one run.
    ///
    /// # Errors
    /// Bad input if `path` holds several `mazes` and an option needs a single one.
    pub(super) fn of_one(&self, path: &Path, mazes: usize) -> Result {
        match self.shown().find(|(_, given)| *given) {
            Some((flag, _)) if mazes != 1 => Err(Failure::BadInput(anyhow!(
                "{flag} needs a single maze, but {} holds {mazes}: name a file",
                path.display()
            ))),
            _ => Ok(()),
        }
    }

    /// Returns whether any option asks to show the run.
    pub(super) fn any(&self) -> bool {
        self.shown().any(|(_, given)| given)
    }

    /// Returns the options that show the run, each with whether it is given.
    fn shown(&self) -> impl Iterator<Item = (&'static str, bool)> {
        [
            ("--live", self.live),
            ("--svg", self.svg.is_some()),
            ("--trace", self.trace.is_some()),
            ("--replay", self.replay.is_some()),
        ]
        .into_iter()
    }

    /// Refuses to overwrite a file that is not a replay. It is called before the work begins.
    ///
    /// # Errors
    /// Bad input if the file exists and is not a replay.
    pub(super) fn check(&self) -> Result {
        match &self.replay {
            Some(path) => replay_file::check(path, Overwrite::if_forced(self.force)),
            None => Ok(()),
        }
    }

    /// Writes the files that are asked for, each as its function makes it.
    ///
    /// # Errors
    /// If one cannot be made or written.
    pub(super) fn write(
        &self,
        trace: impl FnOnce() -> Result<Vec<u8>, Error>,
        svg: impl FnOnce() -> String,
        replay: impl FnOnce() -> Replay,
    ) -> Result {
        if let Some(path) = &self.trace {
            file::write(path, trace()?)?;
        }
        if let Some(path) = &self.svg {
            file::write(path, svg())?;
        }
        match &self.replay {
            Some(path) => replay_file::write(path, replay(), Overwrite::if_forced(self.force)),
            None => Ok(()),
        }
    }

    /// Tells the outcome: as indented JSON if that is asked for, or else by `tell` and the address
    /// of the replay.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn tell(
        &self,
        out: &mut dyn Write,
        json: impl FnOnce() -> Value,
        tell: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result {
        if self.json {
            return Ok(writeln!(out, "{:#}", json())?);
        }
        tell(out)?;
        self.tell_replay(out)
    }

    /// Writes the address of the replay, if there is one.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn tell_replay(&self, out: &mut dyn Write) -> Result {
        match &self.replay {
            Some(path) => replay_file::tell(path, out),
            None => Ok(()),
        }
    }
}
