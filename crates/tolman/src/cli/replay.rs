//! `tolman replay`: traces made visible.

use std::fs::File;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use tolman_replay::{Replay, Trace};
use tolman_sim::robots::LaserPioneer;

use super::replay_file::{self, Overwrite};
use super::{Failure, OrBadInput, maze};

/// Makes a replay of a trace: one HTML file that plays it in any browser
#[derive(clap::Args)]
#[command(after_help = "\
Traces are written by `tolman run --trace`. Several of the same world play side by side on one slider; then
it is told at which step each first differs from the first trace, and that step is marked.

Examples:
  tolman run wall-follow --maze mazes/j.maze --trace one.jsonl
  tolman run avoid --maze mazes/j.maze --trace two.jsonl
  tolman replay one.jsonl two.jsonl --out compared.html")]
pub(super) struct Arguments {
    /// The traces; - reads standard input
    #[arg(required = true, value_name = "TRACE")]
    traces: Vec<PathBuf>,
    /// The file to write; beside the first trace, with the extension .html, if not given
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrite the file even if it is no replay
    #[arg(long)]
    force: bool,
}

pub(super) fn carry_out(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let overwrite = Overwrite::if_forced(arguments.force);
    let path = arguments.path()?;
    if arguments.traces.contains(&path) {
        return Err(Failure::BadInput(anyhow!(
            "{} is the trace itself; give the replay another name with --out",
            path.display()
        )));
    }
    replay_file::check(&path, overwrite)?;
    let mut traces = Vec::new();
    for path in &arguments.traces {
        traces.push(read(path, arguments.short_name(path))?);
    }
    let (replay, verdicts) = Replay::of_traces(&traces).or_bad_input()?;
    replay_file::write(&path, replay, overwrite)?;
    for verdict in &verdicts {
        writeln!(out, "{verdict}")?;
    }
    Ok(writeln!(out, "replay: {}", replay_file::address(&path))?)
}

impl Arguments {
    /// Where the replay goes.
    fn path(&self) -> Result<PathBuf, Failure> {
        match (&self.out, self.traces.first()) {
            (Some(path), _) => Ok(path.clone()),
            (None, Some(first)) if first.as_os_str() != "-" => Ok(first.with_extension("html")),
            _ => Err(Failure::BadInput(anyhow!(
                "a trace from standard input has no name; name the replay with --out"
            ))),
        }
    }

    /// The name of a trace without its folder, unless another one has the same.
    fn short_name(&self, path: &Path) -> String {
        let file_name = path.file_name();
        let same = |other: &PathBuf| other.file_name() == file_name && other != path;
        match file_name {
            Some(file_name) if !self.traces.iter().any(same) => maze::name(Path::new(file_name)),
            _ => maze::name(path),
        }
    }
}

/// Reads the trace at `path`, which the replay calls `short`.
fn read(path: &Path, short: String) -> Result<Trace<LaserPioneer>, Failure> {
    let name = maze::name(path);
    let trace = if path.as_os_str() == "-" {
        Trace::read(short, std::io::stdin().lock())
    } else {
        let file = File::open(path)
            .with_context(|| format!("cannot read {name}; give the path of a trace"))
            .or_bad_input()?;
        Trace::read(short, BufReader::new(file))
    };
    trace.context(name).or_bad_input()
}
