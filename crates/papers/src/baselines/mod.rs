//! The baselines of MSLST: what wandering and wall-following reach without a map.
//!
//! Tables 2 and 3 of "Maze Solving by Learning State Topologies" for its two simple brains. A
//! random brain is the lower bound, and an oracle the upper bound. Competition mazes, or any
//! others, are further tables. A last table shows how often the corridor detector calls each kind
//! of place a corridor.

mod detector;
mod figures;
mod worlds;

use crate::tolerances::STEPS_PER_ACTION;
use crate::venue::{self, MazeRun, Venue};
use tolman_arena::Mind;
use tolman_arena::cast::Agent;
use tolman_arena::episode::{self, Episode, EpisodeError, Trial};
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Correction, Easel, Entry, Experiment, Fields, Job, Metric, Options, Procedure,
    Record, Run, Table,
};
use tolman_replay::Replay;

/// The rows: the paper's brains in its order, then lower and upper bound.
const ROWS: [Agent; 4] = [
    Agent::Avoid,
    Agent::WallFollow,
    Agent::Random,
    Agent::Oracle,
];

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "baselines",
    title: "Mazes without a map: MSLST's baselines",
    source: "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 2 and 3",
    runs: 25,
    quick_runs: 10,
    main: &["2 (J)", "3 (Large)"],
    tour: &[],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Baselines {
    venues: Vec<Venue>,
}

/// Returns the experiment with its worlds and tables.
///
/// # Errors
/// If a maze cannot be read, or the robot does not fit its corridors.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    let (venues, skipped) = worlds::venues(&options.mazes)?;
    let venues: Vec<Venue> = venues
        .into_iter()
        .map(|venue| venue.limited(options.limit))
        .collect();
    let mut tables: Vec<Table> = venues.iter().map(table).collect();
    tables.push(detector::table());
    let worlds = venues.iter();
    let config = venue::config(worlds.map(|venue| (&*venue.table, venue.world())))?;
    Ok(Experiment::new(ENTRY, tables, config, Baselines { venues }).skipped(skipped))
}

fn table(venue: &Venue) -> Table {
    let row = |agent: Agent| {
        let row = venue.row(agent.name());
        let paper = |metric| Some(row.paper_value(metric)?.value);
        match paper("steps").zip(paper("actions")) {
            Some((steps, actions)) => row.paper("steps_per_action", steps / actions),
            None => row,
        }
    };
    venue
        .table::<MazeRun>()
        .metric(
            Metric::ratio("steps_per_action", MazeRun::steps, MazeRun::actions)
                .titled("steps / action")
                .defined("Time steps of all runs for each of their actions.")
                .tolerance(STEPS_PER_ACTION),
        )
        .rows(ROWS.map(row))
        .compared_with(ROWS[0].name(), Correction::Bonferroni)
}

impl Baselines {
    /// Returns trial and mind of a run; `None` for a run of the detector.
    fn cast(&self, job: &Job<'_>) -> Result<Option<(Trial<'_>, Mind)>, EpisodeError> {
        let mut venues = self.venues.iter();
        let venue = venues.find(|venue| venue.table == job.table);
        let Some((venue, agent)) = venue.zip(Agent::named(job.row)) else {
            return Ok(None);
        };
        Ok(Some((venue.trial(job.seed), venue.mind(agent)?)))
    }

    /// Plays one run. Figures use it to play a run again. `None` for a run of the detector.
    fn episode(&self, job: &Job<'_>) -> Result<Option<Episode>, EpisodeError> {
        let Some((trial, mut mind)) = self.cast(job)? else {
            return Ok(None);
        };
        episode::run(&trial, &mut mind, |_| {}).map(Some)
    }
}

impl Procedure for Baselines {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match self.episode(job)? {
            Some(episode) => Ok(MazeRun::of(&episode).fields()?),
            None => detector::run(job),
        }
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs, easel)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let Some((trial, mut mind)) = self.cast(job)? else {
            return Ok(None);
        };
        Ok(Some(venue::replay(job, &trial, &mut mind, &[])?))
    }
}
