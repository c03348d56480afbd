//! `tolman trial`: plays a share of an experiment's runs.

use std::io::Write;

use tolman_experiment::{Chunk, Terminal, play_chunk};

use super::experiment::{Choice, classify};
use super::{App, Result, interrupt};

/// Plays one share of an experiment's runs, so that several machines fill its tables
#[derive(clap::Args)]
#[command(group(clap::ArgGroup::new("which").args(["name"])), after_help = "\
The share lies in chunk-I-of-K in the experiment's folder. Give every machine the same program and the
same options except I, gather the shares in one folder, and call `tolman merge`. An interrupted
share continues where it stopped. docs/many-machines.md has recipes.

Examples:
  tolman trial --experiment baselines --chunk 1/2 --quick --out shared
  tolman trial --experiment baselines --chunk 2/2 --quick --out shared
  tolman merge shared")]
pub(super) struct Arguments {
    /// Experiment whose runs are shared
    #[arg(id = "name", long = "experiment", value_name = "NAME")]
    name: String,
    /// Share to play: the I-th of K, such as 3/8
    #[arg(long, value_name = "I/K")]
    chunk: Chunk,
    #[command(flatten)]
    choice: Choice,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let options = arguments.choice.options(app);
    let experiment = app.experiment(&arguments.name, &options)?;
    let progress = Terminal::new(interrupt::flag()?);
    let folder = play_chunk(
        &experiment,
        &options,
        &app.build,
        arguments.chunk,
        &progress,
    );
    let folder = folder.map_err(classify)?;
    Ok(writeln!(out, "The share: {}", folder.display())?)
}
