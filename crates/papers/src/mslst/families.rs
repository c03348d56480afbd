//! Every entrant in many mazes: drawings of Large by the rule, and random mazes of other kinds.
//!
//! A run of these tables is a maze with several starts, so the spread is between mazes.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use std::sync::{Mutex, PoisonError};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;
use tolman_maze::{Braided, Perfect};

use super::entrant::{Entrant, LearnerConfig};
use crate::metrics::UsualMetrics as _;
use crate::rows::row_of;
use crate::venue::{Drawing, LARGE_DRAWINGS, Played, Venue};
use tolman_arena::cast::Agent;
use tolman_arena::episode::{self, Trial};
use tolman_arena::pioneer;
use tolman_experiment::{
    BoxError, Correction, Fields, Job, Metric, Pairwise, Record, Row, Table, record, run_seed,
};
use tolman_systems::mslst::MslstConfig;

record! {
    /// A maze and several starts in it.
    pub(super) struct FamilyRun {
        /// Share of starts from which the destination is reached within the time limit.
        success_percent: f64 => higher("success").percent(),
        /// Mean number of actions.
        actions: f64 => lower("actions").at_least(0),
        /// Mean number of time steps. A run that does not arrive counts as its limit.
        steps: f64 => lower("steps").at_least(0),
        /// Mean number of time steps over the starts that arrive; no value if none does.
        steps_arrived: Option<f64> => lower("steps, arrived").at_least(0),
    }
}

/// Mazes of one kind, and their entrants.
#[derive(Debug)]
pub(super) struct Family {
    kind: Kind,
    /// Number of starts in each maze.
    starts: u32,
    /// Number of mazes.
    mazes: u32,
    limit: Option<u32>,
    entrants: Vec<Entrant>,
    /// Mazes, by number, in which one baseline has planned and the last has not run yet.
    planned: Mutex<BTreeMap<u32, Arc<Venue>>>,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The first kept drawings of the sequence of Large mazes.
    Drawings,
    /// The same drawings, for MSLST with and without a second graph.
    Overlay,
    /// Perfect and braided mazes in turn.
    Random,
}

/// Configuration of the runs in a family.
#[derive(Serialize)]
pub(super) struct FamilyConfig {
    starts: u32,
    limit: Option<u32>,
    #[serde(flatten)]
    learners: BTreeMap<String, LearnerConfig>,
}

/// Sides of random mazes, cells.
const LEAST_SIDE: u32 = 10;
const MOST_SIDE: u32 = 20;

/// Maximum number of random mazes.
const RANDOM_MAZES: u32 = 200;

/// Share of dead ends that are opened in a braided maze.
const BRAIDED: f64 = 0.5;

impl Family {
    /// Returns the kept drawings of Large. Each has at least 20 starts, of `runs` starts in
    /// all.
    pub(super) fn drawings(runs: u32, limit: Option<u32>) -> Self {
        let [twenty, fifty] =
            [20.0, 50.0].map(|threshold| Entrant::Mslst(MslstConfig::large(threshold)));
        let learners = [twenty, fifty, Entrant::Better];
        let most = LARGE_DRAWINGS.len() as u32;
        Self::new(
            Kind::Drawings,
            runs,
            (most, 20),
            limit,
            Entrant::lineup(learners),
        )
    }

    /// Returns the kept drawings of Large with the paper's two ways to localize. Each has at least
    /// 20 starts, of `runs` starts in all.
    pub(super) fn overlay(runs: u32, limit: Option<u32>) -> Self {
        let rows = [20.0, 50.0].map(MslstConfig::large);
        let both = rows.map(|config| [Entrant::Mslst(config), Entrant::Overlay(config)]);
        let most = LARGE_DRAWINGS.len() as u32;
        Self::new(Kind::Overlay, runs, (most, 20), limit, both.concat())
    }

    /// Returns perfect and braided mazes, new ones for every master seed. Each has at least five
    /// starts.
    pub(super) fn random(runs: u32, limit: Option<u32>) -> Self {
        let learner = Entrant::Mslst(MslstConfig::large(50.0));
        Self::new(
            Kind::Random,
            runs,
            (RANDOM_MAZES, 5),
            limit,
            Entrant::lineup([learner, Entrant::Better]),
        )
    }

    fn new(
        kind: Kind,
        runs: u32,
        (most, least_starts): (u32, u32),
        limit: Option<u32>,
        entrants: Vec<Entrant>,
    ) -> Self {
        let mazes = (runs / least_starts).clamp(1, most);
        Self {
            kind,
            starts: (runs / mazes).max(least_starts),
            mazes,
            limit,
            entrants,
            planned: Mutex::default(),
        }
    }

    /// Returns the name of its table.
    pub(super) const fn name(&self) -> &'static str {
        match self.kind {
            Kind::Drawings => "drawings",
            Kind::Overlay => "overlay",
            Kind::Random => "random mazes",
        }
    }

    pub(super) fn config(&self) -> FamilyConfig {
        let entrants = self.entrants.iter();
        let learners = entrants.filter_map(|entrant| {
            let config = entrant.config(pioneer::CORRIDOR_WIDTH)?;
            Some((entrant.row(), config))
        });
        FamilyConfig {
            starts: self.starts,
            limit: self.limit,
            learners: learners.collect(),
        }
    }

    pub(super) fn table(&self) -> Table {
        let title = match self.kind {
            Kind::Drawings => "The Large maze as others might have drawn it",
            Kind::Overlay => {
                "A second graph in place of the last experiences, in drawings of Large"
            }
            Kind::Random => "Random mazes of 10 to 20 cells a side",
        };
        let kind = match self.kind {
            Kind::Drawings | Kind::Overlay => "the drawings are the first that the rule keeps",
            Kind::Random => {
                "every other maze is perfect, the others have half of their dead ends opened"
            }
        };
        let competitors = self.entrants.iter().filter(|entrant| entrant.competes());
        let success = spread("success", FamilyRun::success_percent, "_percent");
        let steps = spread("steps", FamilyRun::steps, "");
        let oracles = self.entrants.iter().filter_map(|entrant| match entrant {
            Entrant::Agent(Agent::Oracle) => Some(over("steps_over_oracle", Agent::Oracle)),
            Entrant::Agent(agent @ Agent::UnlocalizedOracle) => {
                Some(over("steps_over_unlocalized_oracle", *agent))
            }
            _ => None,
        });
        let table = Table::of::<FamilyRun>(self.name(), title)
            .metric(Metric::mean(FamilyRun::success_percent).decimals(1))
            .metrics([FamilyRun::steps, FamilyRun::steps_arrived]);
        oracles
            .chain(success)
            .chain(steps)
            .fold(table, Table::metric)
            .rows(self.entrants.iter().map(|entrant| Row::new(entrant.row()).runs(self.mazes)))
            .pairwise(Pairwise {
                field: FamilyRun::steps.to_owned(),
                rows: competitors.map(|entrant| entrant.row()).collect(),
                correction: Correction::Bonferroni,
                paper: Vec::new(),
            })
            .note(format!(
                "A run is a maze with {} starts, in which each learner learns a map of its own; {kind}. Runs that time out count \
                 with their limit.",
                self.starts
            ))
    }

    /// Plays a maze from all its starts.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let entrant = row_of(job, &self.entrants, |entrant| entrant.row() == job.row)?;
        let venue = self.venue_of(entrant, job)?;
        let ready = entrant.ready(&venue, job.seed)?;
        let played = Played::of(self.starts, |start| {
            let trial = Trial {
                robot: entrant.robot(&venue),
                ..venue.trial(run_seed(job.seed, "starts", start))
            };
            episode::run(&trial, &mut ready.mind(&venue)?, |_| {})
        })?;
        let run = FamilyRun {
            success_percent: played.success_percent(),
            actions: played.actions(),
            steps: played.steps(),
            steps_arrived: played.steps_arrived(),
        };
        Ok(run.fields()?)
    }

    /// Returns the world of a run. A baseline gets the world of the baseline before, which has
    /// already planned in it.
    fn venue_of(&self, entrant: &Entrant, job: &Job<'_>) -> Result<Arc<Venue>, BoxError> {
        if entrant.competes() {
            return Ok(Arc::new(self.venue(job)?));
        }
        let mut planned = self.planned.lock().unwrap_or_else(PoisonError::into_inner);
        let venue = match planned.remove(&job.run) {
            Some(venue) => venue,
            None => Arc::new(self.venue(job)?),
        };
        let last = self.entrants.last().map(|last| last.row());
        if last != Some(entrant.row()) {
            planned.insert(job.run, Arc::clone(&venue));
        }
        Ok(venue)
    }

    /// Returns the world of a run.
    fn venue(&self, job: &Job<'_>) -> Result<Venue, BoxError> {
        let venue = match self.kind {
            Kind::Drawings | Kind::Overlay => {
                Drawing::Large.venue(LARGE_DRAWINGS[job.run as usize])?
            }
            Kind::Random => random(job)?,
        };
        Ok(venue.limited(self.limit))
    }
}

/// Returns the random maze of a run.
pub(super) fn random(job: &Job<'_>) -> Result<Venue, BoxError> {
    let rng = &mut ChaCha8Rng::seed_from_u64(job.seed);
    let mut side = || rng.random_range(LEAST_SIDE..=MOST_SIDE) as u16;
    let (width, height) = (side(), side());
    let maze = match job.run % 2 {
        0 => Perfect { width, height }.generate(rng)?,
        _ => {
            let share = BRAIDED;
            Braided {
                width,
                height,
                share,
            }
            .generate(rng)?
        }
    };
    let name = format!("random maze {}", job.run);
    Venue::of_maze(job.table, &name, maze)
}

/// Returns metrics for median, quartiles and range of a field over all mazes.
fn spread(name: &str, field: &str, unit: &str) -> [Metric; 5] {
    let named = |which: &str| format!("{name}_{which}{unit}");
    let titled =
        |metric: Metric, which: &str| metric.titled(format!("{name}, {which}")).decimals(1);
    [
        titled(Metric::median(named("median"), field), "median"),
        titled(
            Metric::quantile(named("lower_quartile"), field, 0.25),
            "lower quartile",
        ),
        titled(
            Metric::quantile(named("upper_quartile"), field, 0.75),
            "upper quartile",
        ),
        titled(Metric::least(named("least"), field), "least"),
        titled(Metric::greatest(named("most"), field), "most"),
    ]
}

/// Returns the metric of steps as a multiple of a baseline's, a ratio of sums.
pub(super) fn over(name: &str, baseline: Agent) -> Metric {
    let title = format!("steps / {}'s", baseline.name());
    Metric::multiple(name, FamilyRun::steps, baseline.name()).titled(title)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_of_runs_is_that_of_all_starts() {
        for (runs, mazes, starts) in [(1000, 50, 20), (25, 1, 25), (5, 1, 20), (6000, 150, 40)] {
            let family = Family::drawings(runs, None);
            assert_eq!((family.mazes, family.starts), (mazes, starts), "{runs}");
        }
        for (runs, mazes, starts) in [(1000, 200, 5), (25, 5, 5), (1, 1, 5)] {
            let family = Family::random(runs, None);
            assert_eq!((family.mazes, family.starts), (mazes, starts), "{runs}");
        }
    }
}
