//! Plays the missing runs of an experiment and writes its folder of results.

use core::time::Duration;
use std::path::PathBuf;
use std::time::Instant;

use rayon::prelude::*;

use super::config_file::ConfigFile;
use super::easel::Stopped;
use super::folder::Folder;
use super::runs_file::{Appender, Key, Runs};
use super::{
    Analysis, Build, Chunk, Easel, Entry, Error, Experiment, Job, Options, Progress, ProgressEvent,
    Replays, Run, Summary, check, plots, replays,
};
use crate::report;
use tolman_draw::Figure;

/// Result of an experiment.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ExperimentOutcome {
    /// Entry in the catalogue.
    pub entry: Entry,
    /// Parts left out because data is missing; `None` if nothing is.
    pub skipped: Option<String>,
    /// Folder of the results.
    pub folder: PathBuf,
    /// Command that repeats the results.
    pub command: String,
    /// Master seed of the experiment.
    pub seed: u64,
    /// Number of runs of each row without a fixed number.
    pub runs_per_row: u32,
    /// Number of threads that played.
    pub jobs: u32,
    /// Number of runs that were played now; the others are reused.
    pub played: u64,
    /// Duration of the runs that were played now.
    pub elapsed: Duration,
    /// Program that played the runs.
    pub build: Build,
    /// All runs, sorted by table, row and index.
    pub runs: Vec<Run>,
    /// Analysis of the runs.
    pub analysis: Analysis,
    /// Contents of `summary.json`.
    pub summary: Summary,
    /// Figures: the box plots, and those of the procedure.
    pub figures: Vec<Figure>,
    /// Replays that the report carries.
    pub replays: Replays,
}

/// Runs an experiment and returns its outcome. It resumes the folder, plays the missing runs, and
/// writes `config.toml`, `runs.jsonl`, `summary.json`, `figures/*.svg` and `report.html`.
///
/// The results depend only on the experiment's configuration and the seed. They do not depend on
/// the number of threads, or on interruptions.
///
/// # Errors
/// The error says where it happened and what to do; finished runs are kept in any case. See
/// [`Error::is_bad_input`].
pub fn execute(
    experiment: &Experiment,
    options: &Options,
    build: &Build,
    progress: &dyn Progress,
) -> Result<ExperimentOutcome, Error> {
    let run = Runner {
        experiment,
        options,
        build,
        progress,
    };
    let command = options.command_of(&experiment.entry);
    let path = options.folder_of(experiment.entry.name);
    let played = run.play_missing(path, command, |jobs| jobs)?;
    run.conclude(played)
}

/// Plays a chunk of an experiment: resumes its folder below the experiment's and plays the missing
/// runs. Returns the folder, which [`merge`](super::merge) reads.
///
/// # Errors
/// As [`execute`]; the same call continues an interrupted chunk.
pub fn play_chunk(
    experiment: &Experiment,
    options: &Options,
    build: &Build,
    chunk: Chunk,
    progress: &dyn Progress,
) -> Result<PathBuf, Error> {
    let run = Runner {
        experiment,
        options,
        build,
        progress,
    };
    let command = options.command_of_chunk(&experiment.entry, chunk);
    let path = chunk.folder_in(&options.folder_of(experiment.entry.name));
    let procedure = &*experiment.procedure;
    let played = run.play_missing(path, command, |jobs| chunk.take(jobs, procedure))?;
    Ok(played.path)
}

/// Experiment and options of a run of the runner.
struct Runner<'a> {
    experiment: &'a Experiment,
    options: &'a Options,
    build: &'a Build,
    progress: &'a dyn Progress,
}

/// All runs of a folder, and the effort of playing the missing ones.
struct Played {
    path: PathBuf,
    folder: Folder,
    config: ConfigFile,
    /// All runs, sorted by table, row and index.
    runs: Vec<Run>,
    /// Number of runs played now.
    count: u64,
    elapsed: Duration,
    threads: rayon::ThreadPool,
}

impl Runner<'_> {
    /// Opens the folder `path` and plays the missing jobs among those that `choose` keeps. Writes
    /// `config.toml` and `runs.jsonl`. `command` is the one that continues after an interruption.
    fn play_missing<'a>(
        &'a self,
        path: PathBuf,
        command: String,
        choose: impl FnOnce(Vec<(Key, Job<'a>)>) -> Vec<(Key, Job<'a>)>,
    ) -> Result<Played, Error> {
        let Self {
            experiment,
            options,
            build,
            progress,
        } = *self;
        check::options(options, &experiment.entry)?;
        check::tables(experiment)?;
        let runs_per_row = options.runs_of(&experiment.entry);
        if let Some(what) = &experiment.skipped {
            progress.event(&ProgressEvent::Skipped { what });
        }
        let config = ConfigFile::new(experiment, options, build);
        let folder = Folder::open(&path, &config, progress)?;
        let known = folder.resume(experiment, options.seed, runs_per_row, progress)?;

        let started = Instant::now();
        let jobs = choose(jobs(experiment, options.seed, runs_per_row));
        let total = jobs.len() as u64;
        let is_known = |(key, _): &&(Key, Job<'_>)| known.contains_key(key);
        let reused = jobs.iter().filter(is_known).count() as u64;
        if reused < total {
            // The summary of fewer runs must not be taken for that of these.
            folder.discard("summary.json")?;
            folder.discard("report.html")?;
        }
        progress.event(&ProgressEvent::Started { total, reused });
        let thread_count = options.threads_for(total - reused);
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(thread_count as usize)
            .build()
            .map_err(|source| Error::Threads {
                jobs: thread_count,
                source: source.into(),
            })?;
        let played =
            threads.install(|| play(experiment, &jobs, &known, &folder.appender()?, progress))?;
        let elapsed = started.elapsed();
        let count = played.len() as u64;
        progress.event(&ProgressEvent::RunsFinished {
            played: count,
            elapsed,
        });
        if reused + count < total {
            return Err(Error::Interrupted {
                done: reused + count,
                total,
                folder: path,
                command,
            });
        }
        let mut all = known;
        all.extend(played);
        let runs: Vec<Run> = all.into_values().collect();
        folder.write_runs(&runs)?;
        Ok(Played {
            path,
            folder,
            config,
            runs,
            count,
            elapsed,
            threads,
        })
    }

    /// Makes summary, figures and report from all runs.
    fn conclude(&self, played: Played) -> Result<ExperimentOutcome, Error> {
        let Self {
            experiment,
            options,
            build,
            progress,
        } = *self;
        let Played {
            path,
            folder,
            config,
            runs,
            count,
            elapsed,
            threads,
        } = played;
        let runs_per_row = options.runs_of(&experiment.entry);
        let total = runs.len() as u64;
        let analysis = Analysis::of(experiment, &runs, options.seed);
        let summary = Summary::of(experiment.entry.name, options.seed, &analysis);
        folder.write("summary.json", &summary.to_json()?)?;
        let mut figures = plots::box_plots(experiment, &runs);
        let pictures = folder.pictures(&runs)?;
        let easel = Easel {
            experiment,
            pictures: &pictures,
            progress,
        };
        let interrupted = || Error::Interrupted {
            done: total,
            total,
            folder: path.clone(),
            command: config.command.clone(),
        };
        figures.extend(experiment.figures(&runs, &easel).map_err(|source| {
            match source.is::<Stopped>() {
                true => interrupted(),
                false => Error::Figures {
                    name: experiment.entry.name.to_owned(),
                    source,
                },
            }
        })?);
        check::figures(experiment, &figures)?;
        folder.write_figures(&figures)?;
        progress.event(&ProgressEvent::Recording);
        let mut outcome = ExperimentOutcome {
            entry: experiment.entry,
            skipped: experiment.skipped.clone(),
            folder: path.clone(),
            command: config.command.clone(),
            seed: options.seed,
            runs_per_row,
            jobs: options.threads_for(count),
            played: count,
            elapsed,
            build: build.clone(),
            runs,
            analysis,
            summary,
            figures,
            replays: Replays::default(),
        };
        let budget = replays::budget(report::html(&outcome).len());
        let record = || {
            let (runs, seed) = (&outcome.runs, options.seed);
            replays::record(&easel, runs, seed, runs_per_row, budget)
        };
        outcome.replays = threads.install(record)?.ok_or_else(interrupted)?;
        folder.write("report.html", &report::html(&outcome))?;
        pictures.finish()?;
        Ok(outcome)
    }
}

/// Returns every job of the experiment with its key in the order of results.
pub(super) fn jobs(experiment: &Experiment, master_seed: u64, runs: u32) -> Vec<(Key, Job<'_>)> {
    let mut jobs = Vec::new();
    for (t, table) in experiment.tables.iter().enumerate() {
        for (r, row) in table.rows.iter().enumerate() {
            let runs = 0..row.runs_of(runs);
            let job = |run| Job::of(master_seed, &table.name, &row.name, run);
            jobs.extend(runs.map(|run| ((t, r, run), job(run))));
        }
    }
    jobs
}

/// Plays the jobs that are not known yet, in parallel. Every finished run is in the file before the
/// next one begins. Returns fewer than are missing only if the caller asked to stop.
fn play(
    experiment: &Experiment,
    jobs: &[(Key, Job<'_>)],
    known: &Runs,
    file: &Appender,
    progress: &dyn Progress,
) -> Result<Vec<(Key, Run)>, Error> {
    jobs.par_iter()
        .with_max_len(1)
        .filter(|(key, _)| !known.contains_key(key))
        .filter_map(|(key, job)| {
            if progress.stop_requested() {
                return None;
            }
            Some(play_one(experiment, job).and_then(|run| {
                file.append(&run)?;
                progress.event(&ProgressEvent::RunFinished);
                Ok((*key, run))
            }))
        })
        // The first error ends the other runs.
        .collect()
}

pub(super) fn play_one(experiment: &Experiment, job: &Job<'_>) -> Result<Run, Error> {
    let played = experiment.procedure.run(job).and_then(|fields| {
        let run = Run {
            table: job.table.to_owned(),
            row: job.row.to_owned(),
            run: job.run,
            seed: job.seed,
            fields,
        };
        check::run(experiment, &run)?;
        Ok(run)
    });
    played.map_err(|source| Error::run(job, source))
}
