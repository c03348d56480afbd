//! `tolman replay`: makes replays of traces.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use serde_json::Value;
use tolman_replay::{Portrait, Replay, Trace, TraceComparison};
use tolman_sim::robots::{CameraPioneer, Epuck, LaserPioneer, Pioneer2dx};

use super::kind::Kind;
use super::outputs::{self, Output};
use super::replay_file::{self, Overwrite};
use super::{Failure, OrBadInput, Result, maze};

/// Makes a replay from a trace: one HTML file that plays it in any browser
#[derive(clap::Args)]
#[command(after_help = "\
`tolman run`, `learn` and `drive` write traces with --trace. Several traces of the same world play side by side on one
slider. The step at which each first differs from the first trace is reported and marked.

Examples:
  tolman run wall-follow --maze mazes/j.maze --trace one.jsonl
  tolman run avoid --maze mazes/j.maze --trace two.jsonl
  tolman replay one.jsonl two.jsonl --out compared.html")]
pub(super) struct Arguments {
    /// Trace files; - reads standard input
    #[arg(required = true, value_name = "TRACE")]
    traces: Vec<PathBuf>,
    /// File to write [default: the first trace's name with .html]. If the name ends in .mcap and
    /// the feature `mcap` is on, the file is for Foxglove. The command tolman-rerun writes .rrd,
    /// for Rerun
    #[arg(long, value_name = "FILE", value_parser = outputs::file(outputs::REPLAYS))]
    out: Option<Output>,
    /// Overwrite the file even if it is not a replay
    #[arg(long)]
    force: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result {
    let overwrite = Overwrite::if_forced(arguments.force);
    let path = arguments.path()?;
    if arguments.out.is_none() {
        outputs::note("out", &path)?;
    }
    replay_file::check(&path, overwrite)?;
    let mut texts = Vec::new();
    for path in &arguments.traces {
        texts.push((path, text(path)?));
    }
    // Each kind of robot has its own lines; those of the first trace decide.
    let first = texts.first().and_then(|(_, text)| text.lines().next());
    let has = |field: &str| {
        let header: Option<Value> = first.and_then(|line| serde_json::from_str(line).ok());
        header.is_some_and(|header| header["robots"][0]["config"].get(field).is_some())
    };
    let (replay, verdicts) = if has("response") {
        of::<Epuck>(arguments, &texts)?
    } else if has("sonar") {
        of::<Pioneer2dx>(arguments, &texts)?
    } else if has("pioneer") {
        of::<CameraPioneer>(arguments, &texts)?
    } else {
        of::<LaserPioneer>(arguments, &texts)?
    };
    replay_file::write(&path, replay, overwrite)?;
    for verdict in &verdicts {
        writeln!(out, "{verdict}")?;
    }
    replay_file::tell(&path, out)
}

impl Arguments {
    /// Returns the path of the replay.
    fn path(&self) -> Result<PathBuf> {
        match (&self.out, self.traces.first()) {
            (Some(path), _) => Ok(path.to_path_buf()),
            (None, Some(first)) if !maze::is_stdin(first) => Ok(first.with_extension("html")),
            _ => Err(Failure::BadInput(anyhow!(
                "a trace from standard input has no name; name the replay with --out"
            ))),
        }
    }

    /// Returns the name of a trace without its folder, unless another trace has the same name.
    fn short_name(&self, path: &Path) -> String {
        let file_name = path.file_name();
        let same = |other: &PathBuf| other.file_name() == file_name && other != path;
        match file_name {
            Some(file_name) if !self.traces.iter().any(same) => maze::name(Path::new(file_name)),
            _ => maze::name(path),
        }
    }
}

/// Returns the replay of traces from one kind of robot.
fn of<M: Portrait>(
    arguments: &Arguments,
    texts: &[(&PathBuf, String)],
) -> Result<(Replay, Vec<TraceComparison>)> {
    let mut traces = Vec::new();
    for (path, text) in texts {
        let trace = Trace::<M>::read(arguments.short_name(path), text.as_bytes());
        let trace = trace.map_err(|error| Kind::Trace.explain(text, &maze::name(path), error));
        traces.push(trace.or_bad_input()?);
    }
    Replay::of_traces(&traces).or_bad_input()
}

/// Returns the text of the trace at `path`.
fn text(path: &Path) -> Result<String> {
    maze::source(path)
        .with_context(|| format!("cannot read {}; give the path of a trace", maze::name(path)))
        .or_bad_input()
}
