//! Sweeps that the paper does not have: MSLST with other thresholds, training times, memories and
//! noises, and in other worlds.
//!
//! A run learns its own map and plays [`STARTS`] starts by it, so the spread over runs is between
//! maps. All rows of a table share the seeds of maps and starts.

mod figures;
mod settings;

use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use tolman_arena::Mind;
use tolman_arena::cast::Agent;
use tolman_arena::episode::{self, EpisodeError};
use tolman_arena::mslst::learn;
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Easel, Entry, Experiment, Fields, Job, Options, Procedure, Record, Row, Run, Table,
    record, run_seed,
};
use tolman_systems::mslst::Navigator;

use crate::rows::row_of;
use crate::venue::Played;
use settings::Sweep;

/// Number of starts for each map.
const STARTS: u32 = 10;

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "mslst-sweeps",
    title: "MSLST under other settings and in other worlds",
    source: "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, future work",
    runs: 10,
    quick_runs: 2,
    main: &[],
    tour: &[],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Sweeps {
    sweeps: Vec<Sweep>,
}

/// Returns the experiment with its tables.
///
/// # Errors
/// If the caller names mazes, which this experiment does not use, or a world cannot be built.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("the tables have mazes of their own: leave --maze out, or give it to `tolman experiment mslst`".into());
    }
    let sweeps = settings::all()?;
    let tables = sweeps.iter().map(table).collect();
    let mut config = BTreeMap::<_, BTreeMap<_, _>>::new();
    for sweep in &sweeps {
        let rows = sweep.settings.iter();
        let rows = rows.map(|setting| (&*setting.row, setting.config()));
        config.insert(sweep.name, rows.collect());
    }
    let config = toml::Table::try_from(config)?;
    Ok(Experiment::new(ENTRY, tables, config, Sweeps { sweeps }))
}

record! {
    /// A map and [`STARTS`] starts by it.
    pub(super) struct SweepRun {
        /// Number of states of the map.
        states: usize => neither("states").at_least(1),
        /// Number of nodes of the map.
        nodes: usize => neither("nodes"),
        /// Share of starts from which MSLST reaches the destination within the time limit.
        success_percent: f64 => higher("MSLST arrives").percent(),
        /// Mean number of time steps of MSLST.
        steps: f64 => lower("steps").at_least(0),
        /// Mean number of time steps of Wall-follow from the same starts.
        wall_follow_steps: f64 => neither("steps of Wall-follow").at_least(0),
        /// Mean number of time steps of the Oracle from the same starts.
        oracle_steps: f64 => neither("steps of Oracle").at_least(0),
    }
}

fn table(sweep: &Sweep) -> Table {
    let rows = sweep.settings.iter();
    Table::of::<SweepRun>(sweep.name, sweep.title)
        .metrics_from(SweepRun::states)
        .rows(rows.map(|setting| Row::new(&setting.row)))
        .note(format!(
            "{} A run is a map with {STARTS} starts; ± is the spread between maps. Runs that time out count with their limit.",
            sweep.note
        ))
}

impl Procedure for Sweeps {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let sweeps = self.sweeps.iter().filter(|sweep| sweep.name == job.table);
        let settings = sweeps.flat_map(|sweep| &sweep.settings);
        let setting = row_of(job, settings, |setting| setting.row == job.row)?;
        let venue = setting.venue(job.seed)?;
        let learned = learn(&venue.course, &venue.robot, &setting.config, job.seed)?;
        let (states, nodes) = (learned.map.states.models().len(), learned.map.graph.len());
        let map = Arc::new(learned.map);
        let played = |mind: &dyn Fn() -> Result<Mind, EpisodeError>| {
            Played::of(STARTS, |start| {
                let trial = venue.trial(run_seed(job.seed, "starts", start));
                episode::run(&trial, &mut mind()?, |_| {})
            })
        };
        let mslst = || Navigator::new(Arc::clone(&map), &setting.config);
        let by_mslst = played(&|| Ok(Mind::Brain(Box::new(mslst()))))?;
        let other = |agent| played(&|| venue.mind(agent));
        let run = SweepRun {
            states,
            nodes,
            success_percent: by_mslst.success_percent(),
            steps: by_mslst.steps(),
            wall_follow_steps: other(Agent::WallFollow)?.steps(),
            oracle_steps: other(Agent::Oracle)?.steps(),
        };
        Ok(run.fields()?)
    }

    fn figures(&self, runs: &[Run], _easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        Ok(figures::of(&self.sweeps, runs))
    }
}
