//! One run as a replay file of its own.

use std::path::PathBuf;

use super::at::{make_folder, write_whole};
use super::{Error, Experiment, Job, Options, check, run_seed};

/// Plays one run again from its seed and writes its replay to `replays/TABLE-ROW-RUN.html` in the
/// folder of results, where TABLE and ROW are counted from 1. Runs beyond those that an experiment
/// played can be written as well. Tells where the file is.
///
/// # Errors
/// If there is no such table or row, its runs are not recorded, or the run or the file cannot be made.
pub fn write_replay(
    experiment: &dyn Experiment,
    options: &Options,
    table: &str,
    row: &str,
    run: u32,
) -> Result<PathBuf, Error> {
    check::options(options, experiment)?;
    let no_row = |known: Vec<&str>, what: &'static str, name: &str| Error::NoRow {
        what,
        name: name.to_owned(),
        known: known.join(", "),
    };
    let tables = experiment.tables();
    let t = tables
        .iter()
        .position(|one| one.name == table)
        .ok_or_else(|| {
            let known = tables.iter().map(|one| one.name.as_str()).collect();
            no_row(known, "table", table)
        })?;
    let rows = &tables[t].rows;
    let r = rows.iter().position(|one| one.name == row).ok_or_else(|| {
        let known = rows.iter().map(|one| one.name.as_str()).collect();
        no_row(known, "row", row)
    })?;
    let seed = run_seed(options.seed, table, run);
    let job = Job {
        table,
        row,
        run,
        seed,
    };
    let replay = experiment
        .replay(&job)
        .map_err(|source| Error::run(&job, source))?;
    let replay = replay.ok_or_else(|| Error::NoReplay {
        table: table.to_owned(),
    })?;
    let page = tolman_replay::page(&replay).map_err(|source| Error::run(&job, source.into()))?;
    let folder = options
        .folder_of(experiment.name())
        .join(super::folder::REPLAYS);
    make_folder(&folder)?;
    let file = folder.join(format!("{}-{}-{run}.html", t + 1, r + 1));
    write_whole(&file, page.as_bytes())?;
    Ok(file)
}
