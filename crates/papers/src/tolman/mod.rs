//! Tolman's own experiments: which way a system takes where rats had to choose one.
//!
//! What rats did stands beside each value and judges nothing: a robot is no rat. Each run has a
//! drawing of its own of the [apparatus](tolman_arena::apparatus), the same for all systems.

mod detour;
mod forks;
mod sunburst;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::apparatus::{Apparatus, ApparatusKind};
use tolman_arena::contest::{Condition, Contest, ContestError, RatExperiment, RatRecord, RatStep};
use tolman_arena::registry::{Registry, Schooling, SystemEntry};
use tolman_experiment::{
    BoxError, Entry, Experiment, Fields, Job, Options, Procedure, Record, Table,
};
use tolman_replay::Replay;

use self::detour::{Block, DetourRun};
use self::forks::{Fed, ForksRun};
use self::sunburst::SunburstRun;
use crate::arena::filmed;

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "tolman",
    title: "Tolman's experiments: which way is taken, beside what rats did",
    source: "",
    runs: 30,
    quick_runs: 2,
    main: &["detour"],
    tour: &[],
    open,
};

/// Names of the systems and baselines that are sent. They drive, and are not told the grid.
const SENT: [&str; 8] = [
    "mslst",
    "mslst-better",
    "cpm",
    "cpm-better",
    "diktiometry",
    "diktiometry-better",
    "wall-follow",
    "random",
];

/// Separator of system and condition in a row's name.
const BETWEEN: &str = " · ";

/// Why what rats did judges nothing.
const NO_VERDICT: &str = "a robot is no rat, and its maze is another";

/// The prepared experiment.
#[derive(Debug, Default)]
struct Rats {
    schooling: Schooling,
}

/// Returns the experiment with its tables.
///
/// # Errors
/// If the options name mazes.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err(
            "the mazes are Tolman's, another drawing for each run: leave --maze out".into(),
        );
    }
    let tables: Vec<Table> = vec![detour::table(), sunburst::table(), forks::table()];
    Ok(Experiment::new(
        ENTRY,
        tables,
        toml::Table::new(),
        Rats::default(),
    ))
}

/// Returns the titles of the systems and baselines.
fn sent() -> impl Iterator<Item = &'static str> {
    let names = SENT.into_iter();
    names.filter_map(|name| Some(Registry::current().system(name)?.title()))
}

/// An experiment of a job: in which apparatus, by whom, and what is done.
struct Planned {
    contestant: &'static dyn SystemEntry,
    apparatus: Apparatus,
    steps: Vec<RatStep>,
    seed: u64,
}

impl Planned {
    fn new(
        job: &Job<'_>,
        kind: ApparatusKind,
        contestant: &str,
        steps: &[RatStep],
    ) -> Result<Self, BoxError> {
        let contestant = Registry::current().system(contestant);
        Ok(Self {
            contestant: contestant.ok_or_else(|| no_row(job))?,
            apparatus: drawn(kind, job.seed),
            steps: steps.to_vec(),
            seed: job.seed,
        })
    }

    /// Returns the experiment that a job's row names.
    fn of(job: &Job<'_>) -> Result<Self, BoxError> {
        match job.table {
            detour::TABLE => {
                let (name, block) = Block::of_row(job.row).ok_or_else(|| no_row(job))?;
                Self::new(job, ApparatusKind::Detour, name, &block.steps())
            }
            sunburst::TABLE => Self::new(job, ApparatusKind::Sunburst, job.row, &sunburst::STEPS),
            _ => {
                let (name, fed) = Fed::of_row(job.row).ok_or_else(|| no_row(job))?;
                Self::new(job, ApparatusKind::Forks, name, fed.steps())
            }
        }
    }

    fn experiment(&self) -> RatExperiment<'_> {
        RatExperiment {
            contest: Contest {
                contestant: self.contestant,
                robot: None,
                maze: &self.apparatus.maze,
                name: "tolman",
                condition: Condition::AsMade,
                starts: 0,
                seed: self.seed,
                stopwatch: None,
            },
            apparatus: &self.apparatus,
            steps: &self.steps,
        }
    }

    fn play(&self, schooling: &Schooling) -> Result<RatRecord, ContestError> {
        self.experiment().play(schooling, |_, _| {})
    }
}

/// Returns the drawing of a run.
fn drawn(kind: ApparatusKind, seed: u64) -> Apparatus {
    Apparatus::drawn(kind, &mut ChaCha8Rng::seed_from_u64(seed))
}

fn no_row(job: &Job<'_>) -> BoxError {
    format!("there is no row {:?} of {}", job.row, job.table).into()
}

impl Procedure for Rats {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        if let Some(run) = DetourRun::of_oracle(job) {
            return Ok(run.fields()?);
        }
        let planned = Planned::of(job)?;
        let record = planned.play(&self.schooling)?;
        let apparatus = &planned.apparatus;
        Ok(match job.table {
            detour::TABLE => {
                let (_, block) = Block::of_row(job.row).ok_or_else(|| no_row(job))?;
                DetourRun::of(&record, apparatus, block).fields()?
            }
            sunburst::TABLE => SunburstRun::of(&record, apparatus).fields()?,
            _ => ForksRun::of(&record, apparatus).fields()?,
        })
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        if DetourRun::of_oracle(job).is_some() {
            return Ok(None);
        }
        let planned = Planned::of(job)?;
        let title = format!("{}, {}, run {}", job.table, job.row, job.run);
        let experiment = planned.experiment();
        let replay = filmed(&title, |watch| experiment.play(&self.schooling, watch))?;
        Ok(replay.map(|replay| replay.fact("seed", job.seed.to_string())))
    }
}
