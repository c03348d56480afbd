//! `tolman experiment`: fills the tables of the papers and shows the papers' values beside ours.

mod tour;

use alloc::sync::Arc;
use core::sync::atomic::Ordering;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::anyhow;
use tolman_experiment::{
    Error, Experiment, ExperimentOutcome, Measured, Metric, Options, Program, Table, Terminal,
    VerdictTally, compare, execute, open, tables_as_text, verify, write_replay,
};

use super::kind::Kind;
use super::outputs::{self, Output};
use super::stdout::write_coloured;
use super::{App, Failure, Result, called, caster, ink, interrupt, maze};

/// Runs an experiment, shows its tables beside the paper's, and writes a folder of results; without
/// NAME, gives a tour in a minute
#[derive(clap::Args)]
#[command(group(clap::ArgGroup::new("which").args(["name", "all"])), after_help = "\
The folder holds report.html (opens anywhere), summary.json, runs.jsonl (one line per run),
figures/*.svg and config.toml. An interrupted experiment continues where it stopped.

Examples:
  tolman experiment baselines
  tolman experiment baselines --quick --out one
  tolman experiment baselines --quick --jobs 1 --out two
  tolman experiment --compare one two
  tolman experiment baselines --quick --verify one
  tolman experiment baselines --maze mazes/grid/braided-2.txt --maze mazes/j.maze --runs 5
  tolman experiment diktiometry --table 3b --runs 1
  tolman experiment baselines --replay '2 (J)' Avoid 137")]
pub(super) struct Arguments {
    /// Experiment to run; without it, a tour of the main tables of all
    name: Option<String>,
    /// Run all experiments in turn, with the papers' own numbers of runs
    #[arg(long)]
    all: bool,
    /// List the experiments and exit
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    choice: Choice,
    /// Play one run again, write its replay to replays/ in the folder, and exit
    #[arg(long, num_args = 3, value_names = ["TABLE", "ROW", "RUN"], requires = "name")]
    #[arg(allow_hyphen_values = true, conflicts_with_all = ["check", "json", "list"])]
    replay: Vec<String>,
    /// Compare two folders of results, list the runs that differ, and exit; the exit code is 1 if
    /// any do
    #[arg(long, num_args = 2, value_names = ["DIR", "DIR"], exclusive = true)]
    compare: Vec<PathBuf>,
    /// Play one run of each row of a folder of results again, or --runs of them, and exit. Exits 1
    /// if a value differs in a bit, a line has another checksum, or the summary does not follow
    /// from the runs
    #[arg(long, value_name = "DIR", requires = "name")]
    #[arg(conflicts_with_all = ["check", "json", "list", "out", "replay"])]
    verify: Option<PathBuf>,
    /// Exit with 3 if a table disagrees with the paper, or no value of the paper could be judged
    #[arg(long, requires = "which")]
    check: bool,
    /// Write each summary.json to standard output instead of the tables
    #[arg(long, requires = "which")]
    json: bool,
}

/// Choice of the runs to play, and of their settings.
#[derive(clap::Args)]
pub(super) struct Choice {
    /// Master seed: the same seed gives the same results
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Number of runs of each row, at most 100000, instead of the paper's number
    #[arg(long, value_name = "N", requires = "which")]
    runs: Option<u32>,
    /// Fill only this table; may be given several times
    #[arg(long = "table", value_name = "TABLE", requires = "name")]
    tables: Vec<String>,
    /// Fill only this row, in each table that has it; may be given several times
    #[arg(long = "row", value_name = "ROW", requires = "name")]
    rows: Vec<String>,
    /// Number of runs at a time, at most 256, instead of one per core; results do not depend on it
    #[arg(long, value_name = "N")]
    jobs: Option<u32>,
    /// Maze file of any format, instead of the experiment's own mazes; may be given several times
    #[arg(long = "maze", value_name = "FILE", requires = "which")]
    mazes: Vec<PathBuf>,
    /// Number of time steps after which a run in a maze has failed, instead of the experiment's own
    /// limit (baselines, mslst)
    #[arg(long, value_name = "STEPS", value_parser = clap::value_parser!(u32).range(1..))]
    #[arg(requires = "which")]
    limit: Option<u32>,
    /// Folder for the results; with --all, the folder that holds one folder per experiment
    /// [default: results/NAME, or results/tour]
    #[arg(long, value_name = "DIR", value_parser = outputs::folder(FILES))]
    out: Option<Output>,
    /// Play few runs, for a first look
    #[arg(long, requires = "which")]
    quick: bool,
}

/// Names of files in the folder of results.
const FILES: &[&str] = &["config.toml", "report.html", "runs.jsonl", "summary.json"];

pub(super) fn carry_out(app: &App, arguments: &Arguments, out: &mut dyn Write) -> Result {
    if arguments.list {
        for entry in &app.catalogue.experiments {
            writeln!(out, "{:<14} {}", entry.name, entry.title)?;
        }
        return Ok(());
    }
    if let [first, second] = &arguments.compare[..] {
        let differences = compare(first, second).map_err(classify)?;
        if differences.is_empty() {
            return Ok(writeln!(out, "{differences}")?);
        }
        return Err(Failure::Failed(anyhow!("{differences}")));
    }
    if let [table, row, run] = &arguments.replay[..] {
        return replay(app, arguments, table, row, run, out);
    }
    if let Some(folder) = &arguments.verify {
        return verified(app, arguments, folder, out);
    }
    if arguments.name.is_none() && !arguments.all {
        return tour::carry_out(app, &arguments.choice.options(app), out);
    }
    // The first Ctrl-C lets runs in progress finish.
    let stop = interrupt::flag()?;
    let mut disagreements = Vec::new();
    refuse_other_files(&arguments.choice.mazes)?;
    let chosen = arguments.chosen(app);
    let all = chosen.len();
    for (number, (name, options)) in (1..).zip(chosen) {
        let experiment = app.experiment(name, &options)?;
        if arguments.all && !arguments.json {
            let head = format!("{number} of {all} · {}", experiment.entry.title);
            writeln!(out, "{head}\n")?;
        }
        let progress = Terminal::new(Arc::clone(&stop));
        let outcome = execute(&experiment, &options, &app.build, &progress).map_err(classify)?;
        if arguments.json {
            let summary = outcome.summary.to_json().map_err(classify)?;
            out.write_all(summary.as_bytes())?;
        } else {
            show(&outcome, out)?;
            if number < all {
                writeln!(out)?;
            }
        }
        // The next experiment may take long, so show what there is now.
        out.flush()?;
        disagreements.extend(outcome.analysis.disagreements().filter_map(told));
        let has_paper = !experiment.entry.source.is_empty();
        disagreements.extend(
            unjudged(outcome.analysis.tally())
                .filter(|_| has_paper)
                .map(|why| format!("{name}: {why}")),
        );
    }
    if arguments.check && !disagreements.is_empty() {
        return Err(Failure::Disagrees(anyhow!("{}", disagreements.join("\n"))));
    }
    Ok(())
}

/// Writes the tables, and the path of the report.
pub(super) fn show(outcome: &ExperimentOutcome, out: &mut dyn Write) -> Result {
    let tables = tables_as_text(&outcome.analysis, ink());
    let report = outcome.folder.join("report.html");
    write_coloured(&tables, out)?;
    Ok(writeln!(out, "\nThe report: {}", report.display())?)
}

/// Plays a sample of a folder's runs again and compares every value.
fn verified(app: &App, arguments: &Arguments, folder: &Path, out: &mut dyn Write) -> Result {
    let stop = interrupt::flag()?;
    for (name, options) in arguments.chosen(app) {
        let experiment = app.experiment(name, &options)?;
        let progress = Terminal::new(Arc::clone(&stop));
        let found = verify(&experiment, &options, &app.build, folder, &progress);
        let found = found.map_err(classify)?;
        if !found.faults.is_empty() {
            return Err(Failure::Failed(anyhow!("{found}")));
        }
        if stop.load(Ordering::Relaxed) {
            return Err(Failure::Interrupted(anyhow!(
                "interrupted; up to then, {found}"
            )));
        }
        writeln!(out, "{found}")?;
    }
    Ok(())
}

/// Plays one run again and writes its replay.
fn replay(
    app: &App,
    arguments: &Arguments,
    table: &str,
    row: &str,
    run: &str,
    out: &mut dyn Write,
) -> Result {
    let run = run.parse().map_err(|_| {
        Failure::BadInput(anyhow!(
            "{run:?} is not the index of a run; give a whole number from 0 on"
        ))
    })?;
    for (name, options) in arguments.chosen(app) {
        let experiment = app.experiment(name, &options)?;
        let file = write_replay(&experiment, &options, table, row, run).map_err(classify)?;
        writeln!(out, "The replay: {}", file.display())?;
    }
    Ok(())
}

/// Refuses files of a known kind that are not mazes. The experiment reports what is unknown.
fn refuse_other_files(mazes: &[PathBuf]) -> Result {
    for path in mazes.iter().filter(|path| path.is_file()) {
        let text = maze::text(path)?;
        if Kind::Maze.is_not_of(&text) {
            let error = anyhow!("it is not a maze");
            return Err(Failure::BadInput(Kind::Maze.explain(
                &text,
                &maze::name(path),
                error,
            )));
        }
    }
    Ok(())
}

impl Arguments {
    /// Returns the chosen experiments, each with its options.
    fn chosen<'a>(&'a self, app: &'a App) -> Vec<(&'a str, Options)> {
        let options = self.choice.options(app);
        if let Some(name) = &self.name {
            return vec![(name, options)];
        }
        let names = app.catalogue.experiments.iter().map(|entry| entry.name);
        let chosen = names.map(|name| {
            let out = options.out.as_ref().map(|out| out.join(name));
            let options = options.clone();
            (name, Options { out, ..options })
        });
        chosen.collect()
    }

    /// Returns the one experiment that the command names, with its options.
    pub(super) fn named(&self, app: &App) -> Option<(&str, Options)> {
        Some((self.name.as_deref()?, self.choice.options(app)))
    }
}

impl Choice {
    pub(super) fn options(&self, app: &App) -> Options {
        Options {
            seed: self.seed,
            runs: self.runs,
            jobs: self.jobs,
            mazes: self.mazes.clone(),
            tables: self.tables.clone(),
            rows: self.rows.clone(),
            limit: self.limit,
            out: self.out.as_deref().map(Path::to_owned),
            quick: self.quick,
            caster: caster::unusual(),
            program: Program::current(app.catalogue.program),
        }
    }
}

impl App {
    /// Returns the experiment called `name`, prepared with `options`.
    ///
    /// # Errors
    /// If there is none, or it cannot be prepared.
    pub(super) fn experiment(&self, name: &str, options: &Options) -> Result<Experiment> {
        open(&self.catalogue.experiments, name, options).map_err(classify)
    }
}

pub(super) fn classify(mut error: Error) -> Failure {
    // To continue, the user repeats the whole command, not that of the one experiment at work.
    if let Error::Interrupted { command, .. } = &mut error {
        *command = called::experiment();
    }
    let failure = match error {
        Error::Interrupted { .. } => Failure::Interrupted,
        _ if error.is_bad_input() => Failure::BadInput,
        _ => Failure::Failed,
    };
    failure(error.into())
}

/// Returns why no value of an experiment's paper was judged; `None` if one was, or if there is no
/// paper.
fn unjudged(tally: VerdictTally) -> Option<String> {
    match (tally.all(), tally.judged()) {
        (0, _) => Some("no table has a value from the paper, so nothing was judged".to_owned()),
        (all, 0) => Some(format!(
            "none of the paper's {all} values could be judged; give it more --runs, or the files that it lacks"
        )),
        _ => None,
    }
}

/// Returns a line about a value that disagrees with the paper's; `None` for one that agrees.
fn told((table, metric, measured): (&Table, &Metric, &Measured)) -> Option<String> {
    let verdict = measured.verdict.as_ref()?;
    let (paper, accepted) = (measured.paper.as_ref()?, verdict.accepted?);
    Some(format!(
        "table {}, row {}: {} is {:.2}, the paper has {}; {:.2} to {:.2} are tolerated, and a difference of {:.2} would have been seen",
        table.name,
        measured.row,
        metric.name,
        measured.value,
        paper.value,
        accepted.low,
        accepted.high,
        verdict.resolution?
    ))
}
