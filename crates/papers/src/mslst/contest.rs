//! Tables 2 and 3: all brains in one world.

use alloc::collections::BTreeMap;
use std::sync::OnceLock;

use serde::Serialize;
use tolman_control::Outcome;
use tolman_maze::Direction;

use super::MAPS;
use super::entrant::{Entrant, LearnerConfig, Ready};
use super::families::over;
use crate::kept::once;
use crate::rows::row_of;
use crate::venue::{self, MazeRun, PAPER_RUNS, Venue, World};
use tolman_arena::Mind;
use tolman_arena::cast::Agent;
use tolman_arena::episode::{self, Episode, Trial};
use tolman_experiment::{
    BoxError, Correction, Fields, Job, Metric, Pairwise, Record, Table, record, require, run_seed,
};
use tolman_replay::Replay;
use tolman_systems::mslst::{Learned, MslstConfig};

record! {
    /// A run of a brain that competes.
    #[check(ContestRun::relations)]
    pub(super) struct ContestRun {
        ..run: MazeRun,
        /// Number of actions that take back the one before, soon after another such action.
        bounces: u32 => lower("bounces"),
        /// Number of the map with which a learner navigates.
        map: Option<u32> => neither("map").at_most(MAPS - 1),
    }
}

impl ContestRun {
    fn relations(&self) -> Result<(), String> {
        require(
            self.bounces <= self.run.actions,
            "more bounces than actions",
        )
    }
}

/// Configuration of the runs in one world.
#[derive(Serialize)]
pub(super) struct ContestConfig<'a> {
    #[serde(flatten)]
    world: World,
    maps: u32,
    #[serde(flatten)]
    learners: BTreeMap<&'a str, LearnerConfig>,
}

/// A world, the brains that compete in it, and their common data.
#[derive(Debug)]
pub(super) struct Contest {
    pub(super) venue: Venue,
    pub(super) competitors: Vec<Competitor>,
    /// Number of maps of each learner.
    pub(super) maps: u32,
    /// Fixed number of runs of each row; `None` leaves it to the caller.
    runs: Option<u32>,
}

/// A competitor, and its maps so far.
#[derive(Debug)]
pub(super) struct Competitor {
    pub(super) row: String,
    entrant: Entrant,
    /// Maps, each with its seed, which is the same for every learner; a single one for a brain that
    /// learns none.
    ready: Vec<(u64, OnceLock<Ready>)>,
}

/// The significant differences that the paper reports, by row of MSLST and other row.
const PAPER_P: [(&str, &str, f64); 6] = [
    ("MSLST 100", "Wall-follow", 0.0018),
    ("MSLST 100", "Avoid", 0.0036),
    ("MSLST 20", "Avoid", 6.66e-5),
    ("MSLST 20", "Wall-follow", 9.22e-4),
    ("MSLST 50", "Avoid", 1.88e-5),
    ("MSLST 50", "Wall-follow", 2.93e-4),
];

impl Contest {
    /// Returns the contest with [`MAPS`] maps of each learner.
    pub(super) fn new(venue: Venue, master_seed: u64) -> Self {
        Self::with_maps(venue, master_seed, MAPS, None)
    }

    /// Returns the contest with 25 runs by one map, which is how the paper's own table must have
    /// been made.
    pub(super) fn with_one_map(venue: Venue, master_seed: u64) -> Self {
        let table = format!("{}, one map", venue.table);
        let title = format!("{}, 25 runs by one map", venue.title);
        let venue = venue.renamed(&table, &title);
        Self::with_maps(venue, master_seed, 1, Some(PAPER_RUNS))
    }

    fn with_maps(venue: Venue, master_seed: u64, maps: u32, runs: Option<u32>) -> Self {
        let configs = match venue.course.name.as_str() {
            "J" => vec![MslstConfig::j()],
            "Large" | "Large, hard" => vec![MslstConfig::large(20.0), MslstConfig::large(50.0)],
            _ => vec![MslstConfig::large(50.0)],
        };
        let stream = format!("maps of {}", venue.table);
        let map = |number| (run_seed(master_seed, &stream, number), OnceLock::new());
        let learners = configs.into_iter().map(Entrant::Mslst);
        let learners = learners.chain([Entrant::Better]);
        let competitor = |entrant: Entrant| {
            let count = if entrant.learns() { maps } else { 1 };
            Competitor {
                row: entrant.row(),
                entrant,
                ready: (0..count).map(map).collect(),
            }
        };
        Self {
            competitors: Entrant::lineup(learners)
                .into_iter()
                .map(competitor)
                .collect(),
            venue,
            maps,
            runs,
        }
    }

    pub(super) fn table(&self) -> Table {
        let table = self.measured();
        let competitors = self.competitors.iter().filter(|one| one.entrant.competes());
        // Rows that do not compete have no tests of significance.
        let paper: &[_] = if self.venue.is_papers() {
            &PAPER_P
        } else {
            &[]
        };
        let paper = paper
            .iter()
            .map(|&(row, other, p)| (row.to_owned(), other.to_owned(), p));
        let maps = match self.maps {
            1 => "All runs of a learner are by one map.".to_owned(),
            maps => format!("Run n of a learner is by map n mod {maps}."),
        };
        let note = format!(
            "{} {maps} A bounce is an action that takes back the one before, soon after another such.",
            table.note
        );
        let row = |name: &str| {
            let row = self.venue.row(name);
            match self.runs {
                Some(runs) => row.run_each(runs),
                None => row,
            }
        };
        table
            .rows(self.competitors.iter().map(|one| row(&one.row)))
            .pairwise(Pairwise {
                field: MazeRun::steps.to_owned(),
                rows: competitors.map(|one| one.row.clone()).collect(),
                correction: Correction::Bonferroni,
                paper: paper.collect(),
            })
            .note(note)
    }

    /// Returns the table with its metrics, without rows.
    fn measured(&self) -> Table {
        self.venue
            .table::<ContestRun>()
            .metric(Metric::mean(MazeRun::steps_arrived))
            .metric(over("steps_over_oracle", Agent::Oracle))
            .metric(over(
                "steps_over_unlocalized_oracle",
                Agent::UnlocalizedOracle,
            ))
            .metric(
                Metric::ratio_of_spreads("sd_ratio", MazeRun::actions, MazeRun::steps)
                    .titled("sd of actions / of steps")
                    .defined(
                        "Of runs that get stuck it is near 1: they differ by actions of one step.",
                    ),
            )
            .metric(
                Metric::ratio("failed_at_once", MazeRun::failed_at_once, MazeRun::actions)
                    .titled("failed at once / actions")
                    .defined("The share of all actions that failed in their first time step."),
            )
            .metric(
                Metric::ratio("steps_per_action", MazeRun::steps, MazeRun::actions)
                    .titled("steps / action"),
            )
            .metric(Metric::mean(ContestRun::bounces))
    }

    /// Returns the configuration that the runs depend on.
    pub(super) fn config(&self) -> ContestConfig<'_> {
        let learners = self.competitors.iter();
        let width = self.venue.course.corridor_width;
        let learners = learners.filter_map(|one| Some((&*one.row, one.entrant.config(width)?)));
        ContestConfig {
            world: self.venue.world(),
            maps: self.maps,
            learners: learners.collect(),
        }
    }

    /// Returns the competitors that learn a map.
    pub(super) fn learners(&self) -> impl Iterator<Item = &Competitor> {
        let competitors = self.competitors.iter();
        competitors.filter(|one| one.entrant.learns())
    }

    /// Returns those that learn as the paper does.
    pub(super) fn faithful(&self) -> impl Iterator<Item = &Competitor> {
        let competitors = self.competitors.iter();
        competitors.filter(|one| matches!(one.entrant, Entrant::Mslst(_)))
    }

    fn competitor(&self, job: &Job<'_>) -> Result<&Competitor, BoxError> {
        row_of(job, &self.competitors, |one| one.row == job.row)
    }

    /// Returns the name of the map that a learner's run uses; `None` for those that learn none.
    pub(super) fn map_of(&self, job: &Job<'_>) -> Option<String> {
        let competitor = self.competitor(job).ok()?;
        let map = job.run % self.maps;
        let name = || format!("map {map} of {} in {}", job.row, job.table);
        competitor.entrant.learns().then(name)
    }

    /// Plays one run.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let learns = self.competitor(job)?.entrant.learns();
        let (episode, bounces) = self.episode(job)?;
        let run = ContestRun {
            run: MazeRun::of(&episode),
            bounces,
            map: learns.then_some(job.run % self.maps),
        };
        Ok(run.fields()?)
    }

    /// Returns the trial of a run, its mind, and the state that the competitor has learned.
    fn cast(&self, job: &Job<'_>) -> Result<(Trial<'_>, Mind, &Ready), BoxError> {
        let competitor = self.competitor(job)?;
        let ready = competitor.ready(&self.venue, job.run)?;
        let trial = Trial {
            robot: competitor.entrant.robot(&self.venue),
            ..self.venue.trial(job.seed)
        };
        Ok((trial, ready.mind(&self.venue)?, ready))
    }

    /// Plays one run, and returns it with its number of bounces.
    pub(super) fn episode(&self, job: &Job<'_>) -> Result<(Episode, u32), BoxError> {
        let (trial, mut mind, _) = self.cast(job)?;
        let mut bounces = Bounces::default();
        let episode = episode::run(&trial, &mut mind, |step| {
            if step.ends.is_some_and(Outcome::moved) {
                bounces.moved(step.action);
            }
        })?;
        Ok((episode, bounces.count))
    }

    /// Returns the replay of one run.
    pub(super) fn replay(&self, job: &Job<'_>) -> Result<Replay, BoxError> {
        let (trial, mut mind, ready) = self.cast(job)?;
        Ok(venue::replay(job, &trial, &mut mind, ready.nodes())?)
    }
}

impl Competitor {
    /// Returns the competitor ready for this run. The first caller makes it learn.
    pub(super) fn ready(&self, venue: &Venue, run: u32) -> Result<&Ready, BoxError> {
        let (seed, ready) = &self.ready[run as usize % self.ready.len()];
        once(ready, || self.entrant.ready(venue, *seed))
    }

    /// Returns map 0 of MSLST; `None` for other brains.
    pub(super) fn first_map(&self, venue: &Venue) -> Result<Option<&Learned>, BoxError> {
        Ok(self.ready(venue, 0)?.learned())
    }
}

/// Counts how often a robot goes back and forth between two ways ("this process of bouncing between
/// two possible routes").
///
/// Turning back once is not bouncing: every dead end requires it. An action counts if it takes back
/// the one before, at most [`Bounces::SOON`] completed actions after the last such action.
#[derive(Debug, Default)]
struct Bounces {
    last: Option<Direction>,
    since_reversal: Option<u32>,
    count: u32,
}

impl Bounces {
    /// Number of actions that the brain remembers in the Large maze.
    const SOON: u32 = 8;

    fn moved(&mut self, action: Direction) {
        self.since_reversal = self.since_reversal.map(|since| since + 1);
        if self.last == Some(action.opposite()) {
            let soon = |since: u32| since <= Self::SOON;
            self.count += u32::from(self.since_reversal.is_some_and(soon));
            self.since_reversal = Some(0);
        }
        self.last = Some(action);
    }
}

#[cfg(test)]
mod tests {
    use tolman_maze::Direction::{East, North, West};

    use super::*;

    #[test]
    fn to_turn_back_once_is_no_bounce() {
        let count = |actions: &[Direction]| {
            let mut bounces = Bounces::default();
            actions.iter().for_each(|action| bounces.moved(*action));
            bounces.count
        };
        assert_eq!(count(&[]), 0);
        assert_eq!(count(&[East, East, West, West]), 0);
        assert_eq!(count(&[East, West, East]), 1);
        assert_eq!(count(&[East, West, North, West, East, West]), 2);
        let far = [vec![East, West], vec![North; 8], vec![North.opposite()]].concat();
        assert_eq!(count(&far), 0, "nine actions later");
    }
}
