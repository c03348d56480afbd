//! One run as a replay file of its own.

use std::path::PathBuf;

use super::at::{make_folder, write_whole};
use super::{Error, Experiment, Job, Options, check};

/// Plays one run again from its seed, and writes its replay to `replays/TABLE-ROW-RUN.html` in the
/// folder of results. TABLE and ROW are counted from 1. Runs that the experiment did not play can
/// be written as well. Returns the path of the file.
///
/// # Errors
/// If there is no such table or row, its runs cannot be recorded, or the run or the file cannot be
/// made.
pub fn write_replay(
    experiment: &Experiment,
    options: &Options,
    table: &str,
    row: &str,
    run: u32,
) -> Result<PathBuf, Error> {
    check::options(options, &experiment.entry)?;
    let (t, one) = experiment.table(table)?;
    let rows = one.rows.iter().map(|row| row.name.as_str());
    let r = Error::place_of("row", row, rows)?;
    let job = Job::of(options.seed, table, row, run);
    let replay = experiment.replay(&job)?.ok_or_else(|| Error::NoReplay {
        table: table.to_owned(),
    })?;
    let page = tolman_replay::page(&replay).map_err(|source| Error::run(&job, source.into()))?;
    let folder = options
        .folder_of(experiment.entry.name)
        .join(super::folder::REPLAYS);
    make_folder(&folder)?;
    let file = folder.join(format!("{}-{}-{run}.html", t + 1, r + 1));
    write_whole(&file, page.as_bytes())?;
    Ok(file)
}
