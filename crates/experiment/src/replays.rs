//! The replays that the report carries: runs played again from their seeds, and recorded.

use alloc::collections::BTreeSet;

use rayon::prelude::*;

use super::{Easel, Error, Experiment, Job, Run};

/// Maximum number of runs of each row that are recorded, as many as MSLST's paper made. More would
/// take little time, but most of the page.
const FIRST: u32 = 25;

/// Maximum size of all replays of a page, bytes.
const MOST: usize = 4_250_000;

/// Maximum size of a page with all its tables, figures and replays, bytes.
const PAGE: usize = 5_000_000;

/// Maximum size that a page adds to each replay, bytes.
const TAG: usize = 400;

/// Returns the size left for replays, bytes, on a page that takes `page` bytes without them.
pub(super) fn budget(page: usize) -> usize {
    let player = tolman_replay::style().len() + tolman_replay::script().len();
    PAGE.saturating_sub(page + player).min(MOST)
}

/// Replays of the first runs of each row.
#[derive(Clone, Debug, Default)]
pub struct Replays {
    /// Number of runs of each row, if the row can be recorded.
    pub of_each_row: u32,
    /// Replays by run, then in the order of tables and rows.
    pub recorded: Vec<Recorded>,
    /// Names of the tables whose runs can be recorded.
    pub tables: BTreeSet<String>,
    /// Maximum size of all replays together, bytes.
    pub budget: usize,
}

/// The replay of one run.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// Name of the table.
    pub table: String,
    /// Name of the row.
    pub row: String,
    /// Index of the run, from 0.
    pub run: u32,
    /// Input of the player, suitable for a `script` element.
    pub json: String,
}

impl Recorded {
    /// Returns an upper bound of the replay's size on a page, bytes.
    const fn bytes(&self) -> usize {
        self.json.len() + TAG
    }
}

/// Records the first runs of each row, up to [`FIRST`], as long as their replays fit into `budget`
/// bytes. It works in parallel on the current threads. It plays no run that is unlikely to fit, and
/// keeps each finished replay on the easel. `None` if the caller asked to stop.
pub(super) fn record(
    easel: &Easel<'_>,
    runs: &[Run],
    master_seed: u64,
    runs_per_row: u32,
    budget: usize,
) -> Result<Option<Replays>, Error> {
    let experiment = easel.experiment;
    let mut replays = Replays {
        budget,
        ..Replays::default()
    };
    let shown = experiment
        .procedure
        .shown(runs)
        .map_err(|source| Error::Figures {
            name: experiment.entry.name.to_owned(),
            source,
        })?;
    if let Some(shown) = shown {
        let jobs: Vec<Job<'_>> = shown.iter().map(Run::job).collect();
        let recorded = record_all(easel, &jobs)?;
        return Ok(recorded.map(|recorded| {
            replays.carry(recorded, 0);
            replays
        }));
    }
    let most = runs_per_row.min(FIRST);
    let (mut done, mut bytes) = (0, 0);
    while done < most {
        let runs = match room(done, bytes, budget).min(most - done) {
            0 => break,
            count => done..done + count,
        };
        let jobs: Vec<Job<'_>> = runs
            .clone()
            .flat_map(|run| jobs_of(experiment, master_seed, run))
            .collect();
        let Some(recorded) = record_all(easel, &jobs)? else {
            return Ok(None);
        };
        replays
            .tables
            .extend(recorded.iter().map(|one| one.table.clone()));
        for run in runs {
            let of_run = || recorded.iter().filter(move |one| one.run == run);
            bytes += of_run().map(Recorded::bytes).sum::<usize>();
            if replays.tables.is_empty() {
                return Ok(Some(replays));
            }
            if bytes > budget {
                bytes -= of_run().map(Recorded::bytes).sum::<usize>();
                replays.carry(of_run().cloned(), bytes);
                return Ok(Some(replays));
            }
            replays.recorded.extend(of_run().cloned());
            replays.of_each_row = run + 1;
        }
        done = replays.of_each_row;
    }
    Ok(Some(replays))
}

/// Returns the replays of all these runs that have one; `None` if the user stopped.
fn record_all(easel: &Easel<'_>, jobs: &[Job<'_>]) -> Result<Option<Vec<Recorded>>, Error> {
    let recorded: Result<Vec<Option<Recorded>>, Error> = jobs
        .par_iter()
        .with_max_len(1)
        .filter(|_| !easel.progress.stop_requested())
        .map(|job| record_one(easel, job))
        .collect();
    let recorded = recorded?;
    let is_whole = recorded.len() == jobs.len();
    Ok(is_whole.then(|| recorded.into_iter().flatten().collect()))
}

impl Replays {
    /// Adds the recorded runs that fit, one by one, if others already take `bytes`.
    fn carry(&mut self, recorded: impl IntoIterator<Item = Recorded>, mut bytes: usize) {
        for one in recorded {
            self.tables.insert(one.table.clone());
            if bytes + one.bytes() <= self.budget {
                bytes += one.bytes();
                self.recorded.push(one);
            }
        }
    }
}

/// Returns the number of further runs of each row that are likely to fit, if `done` of them took
/// `bytes` bytes. The first run is always tried.
fn room(done: u32, bytes: usize, budget: usize) -> u32 {
    match done {
        0 => 1,
        _ => {
            let each = (bytes / done as usize).max(1);
            u32::try_from(budget.saturating_sub(bytes) / each).unwrap_or(u32::MAX)
        }
    }
}

/// Returns the job with this run index of every row.
fn jobs_of(experiment: &Experiment, master_seed: u64, run: u32) -> impl Iterator<Item = Job<'_>> {
    experiment.tables.iter().flat_map(move |table| {
        // A row with a fixed number of runs may have fewer.
        let rows = table.rows.iter();
        let rows = rows.filter(move |row| row.runs_of(run + 1) > run);
        rows.map(move |row| Job::of(master_seed, &table.name, &row.name, run))
    })
}

fn record_one(easel: &Easel<'_>, job: &Job<'_>) -> Result<Option<Recorded>, Error> {
    let json = easel.pictures.replay(job, || {
        let replay = easel.experiment.replay(job)?;
        let json = replay.as_ref().map(tolman_replay::json).transpose();
        json.map_err(|source| Error::run(job, source.into()))
    })?;
    Ok(json.map(|json| Recorded {
        table: job.table.to_owned(),
        row: job.row.to_owned(),
        run: job.run,
        json,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replays_are_carried_one_by_one_until_the_budget_is_full() {
        let one = |run, size| Recorded {
            table: "1".to_owned(),
            row: "Novice".to_owned(),
            run,
            json: "x".repeat(size),
        };
        let mut replays = Replays {
            budget: 2000,
            ..Replays::default()
        };
        replays.carry([one(0, 500), one(1, 5000), one(2, 600)], 0);
        let carried: Vec<u32> = replays.recorded.iter().map(|one| one.run).collect();
        assert_eq!(carried, [0, 2]);
    }

    #[test]
    fn a_page_has_as_much_room_for_replays_as_its_tables_leave() {
        assert_eq!(budget(0), MOST);
        let left = budget(1_400_000);
        assert!(left < MOST && left + 1_400_000 < PAGE);
        assert_eq!(budget(PAGE), 0);
    }
}
