//! `tolman merge`: combines the shares of an experiment into its results.

use std::io::Write;
use std::path::PathBuf;

use anyhow::anyhow;
use clap::Parser;
use tolman_experiment::{Options, Terminal, command_of_chunks, merge};

use super::caster::Caster;
use super::experiment::{self, classify, show};
use super::{App, Failure, OrBadInput, Result, interrupt};

/// Merges the shares of an experiment and shows its tables
#[derive(clap::Args)]
#[command(after_help = "\
The results are those of one machine, byte for byte. If runs are missing, it says which shares
to play again.

Examples:
  tolman trial --experiment baselines --chunk 1/1 --quick --out whole
  tolman merge whole")]
pub(super) struct Arguments {
    /// Folder that `tolman trial` was given with --out
    #[arg(value_name = "DIR")]
    results: PathBuf,
}

/// The command whose shares are merged, without the program's name.
#[derive(Parser)]
struct Whole {
    #[command(flatten)]
    arguments: experiment::Arguments,
    #[command(flatten)]
    caster: Caster,
}

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    let results = &arguments.results;
    let command = command_of_chunks(results).map_err(classify)?;
    let words = shlex::split(&command).unwrap_or_default();
    let words = words.iter().skip_while(|word| *word != "experiment");
    let whole = Whole::try_parse_from(words).or_bad_input()?;
    whole.caster.install()?;
    let (name, options) = whole.arguments.named(app).ok_or_else(|| {
        let results = results.display();
        Failure::BadInput(anyhow!(
            "{results}: its command names no experiment: {command}"
        ))
    })?;
    let options = Options {
        out: Some(results.clone()),
        ..options
    };
    let experiment = app.experiment(name, &options)?;
    let progress = Terminal::new(interrupt::flag()?);
    show(
        &merge(&experiment, &options, &app.build, &progress).map_err(classify)?,
        out,
    )
}
