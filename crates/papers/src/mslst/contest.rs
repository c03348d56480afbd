//! Tables 2 and 3: the brains against each other in one world.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use std::sync::OnceLock;

use serde::Serialize;
use tolman_control::Outcome;
use tolman_maze::Direction;

use super::MAPS;
use crate::tolerances::{SUCCESS, TIME};
use crate::venue::{self, MazeRun, Venue, World};
use tolman_arena::Mind;
use tolman_arena::cast::Agent;
use tolman_arena::episode::{self, Episode, Trial};
use tolman_arena::mslst::{LearnError, learn};
use tolman_experiment::{
    BoxError, Correction, Fields, Job, Metric, Pairwise, Record, Table, record, require, run_seed,
};
use tolman_replay::Replay;
use tolman_systems::mslst::{Learned, MslstConfig, Navigator};

record! {
    /// A run of a brain that competes.
    #[check(ContestRun::relations)]
    pub(super) struct ContestRun {
        ..run: MazeRun,
        /// Actions that take back the one before, soon after another such.
        bounces: u32 => lower("bounces"),
        /// Number of the map by which MSLST navigates.
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

/// What the runs in one world depend on.
#[derive(Serialize)]
pub(super) struct ContestConfig<'a> {
    #[serde(flatten)]
    world: World,
    #[serde(flatten)]
    mslst: BTreeMap<&'a str, MslstConfig>,
}

/// One world, the brains that compete in it, and what they share.
#[derive(Debug)]
pub(super) struct Contest {
    pub(super) venue: Venue,
    pub(super) apprentices: Vec<Apprentice>,
}

/// MSLST with one threshold, and the maps it has learned so far.
#[derive(Debug)]
pub(super) struct Apprentice {
    pub(super) row: String,
    pub(super) config: MslstConfig,
    /// The seed of each map, the same for every threshold.
    seeds: Vec<u64>,
    maps: Vec<OnceLock<Learned>>,
}

/// The agents beside MSLST, the paper's first.
const OTHERS: [Agent; 4] = [
    Agent::Avoid,
    Agent::WallFollow,
    Agent::Oracle,
    Agent::UnlocalizedOracle,
];

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
    pub(super) fn new(venue: Venue, master_seed: u64) -> Self {
        let configs = match venue.course.name.as_str() {
            "J" => vec![MslstConfig::j()],
            "Large" => vec![MslstConfig::large(20.0), MslstConfig::large(50.0)],
            _ => vec![MslstConfig::large(50.0)],
        };
        let stream = format!("maps of {}", venue.table);
        let seeds: Vec<u64> = (0..MAPS)
            .map(|map| run_seed(master_seed, &stream, map))
            .collect();
        let apprentice = |config: MslstConfig| Apprentice {
            row: format!("MSLST {}", config.threshold),
            config,
            seeds: seeds.clone(),
            maps: seeds.iter().map(|_| OnceLock::new()).collect(),
        };
        Self {
            venue,
            apprentices: configs.into_iter().map(apprentice).collect(),
        }
    }

    pub(super) fn table(&self) -> Table {
        let oracle = Agent::Oracle.name();
        let unlocalized = Agent::UnlocalizedOracle.name();
        let table = self
            .venue
            .table::<ContestRun>()
            .metric(Metric::percent("success_percent", MazeRun::reached).tolerance(SUCCESS))
            .metric(Metric::mean(MazeRun::actions).tolerance(TIME))
            .metric(Metric::mean(MazeRun::steps).tolerance(TIME))
            .metric(
                Metric::multiple("steps_of_oracle", MazeRun::steps, oracle)
                    .titled("steps / Oracle's"),
            )
            .metric(
                Metric::multiple("steps_of_unlocalized", MazeRun::steps, unlocalized)
                    .titled("steps / Unlocalized oracle's"),
            )
            .metric(Metric::mean(ContestRun::bounces));
        let (baselines, yardsticks) = OTHERS.split_at(2);
        let names = |agents: &[Agent]| -> Vec<String> {
            agents.iter().map(|agent| agent.name().to_owned()).collect()
        };
        let apprentices = self.apprentices.iter().map(|one| one.row.clone());
        let competitors: Vec<String> = names(baselines).into_iter().chain(apprentices).collect();
        let rows = [competitors.clone(), names(yardsticks)].concat();
        // Of rows that do not compete nobody asks.
        let paper = PAPER_P.map(|(row, other, p)| (row.to_owned(), other.to_owned(), p));
        let note = format!(
            "{} Run n of MSLST navigates by map n mod {MAPS}. A bounce is an action that takes back the one before, soon \
             after another such.",
            table.note
        );
        table
            .rows(rows.iter().map(|name| self.venue.row(name)))
            .pairwise(Pairwise {
                field: MazeRun::steps.to_owned(),
                rows: competitors,
                correction: Correction::Bonferroni,
                paper: paper.into(),
            })
            .note(note)
    }

    /// What the runs depend on.
    pub(super) fn config(&self) -> ContestConfig<'_> {
        let mslst = self.apprentices.iter();
        ContestConfig {
            world: self.venue.world(),
            mslst: mslst.map(|one| (&*one.row, one.config)).collect(),
        }
    }

    pub(super) fn apprentice(&self, row: &str) -> Option<&Apprentice> {
        self.apprentices.iter().find(|one| one.row == row)
    }

    /// Plays one run.
    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (episode, bounces) = self.episode(job)?;
        let run = ContestRun {
            run: MazeRun::of(&episode),
            bounces,
            map: self.apprentice(job.row).map(|_| job.run % MAPS),
        };
        Ok(run.fields()?)
    }

    /// Where a run takes place, who drives, and what MSLST has learned, if it does.
    fn cast(&self, job: &Job<'_>) -> Result<(Trial<'_>, Mind, Option<&Learned>), BoxError> {
        let trial = self.venue.trial(job.seed);
        let Some(apprentice) = self.apprentice(job.row) else {
            let agent = Agent::named(job.row);
            let agent = agent.ok_or_else(|| format!("there is no brain {:?}", job.row))?;
            return Ok((trial, self.venue.mind(agent)?, None));
        };
        let learned = apprentice.learned(&self.venue, job.run % MAPS)?;
        let map = Arc::new(learned.map.clone());
        let navigator = Navigator::new(map, &apprentice.config);
        Ok((trial, Mind::Brain(Box::new(navigator)), Some(learned)))
    }

    /// One run and how often the robot bounced in it.
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

    /// One run as it can be watched.
    pub(super) fn replay(&self, job: &Job<'_>) -> Result<Replay, BoxError> {
        let (trial, mut mind, learned) = self.cast(job)?;
        let nodes = learned.map_or(&[][..], |learned| &learned.survey.positions);
        Ok(venue::replay(job, &trial, &mut mind, nodes)?)
    }
}

impl Apprentice {
    /// The map of this number, learned by whoever asks first.
    pub(super) fn learned(&self, venue: &Venue, number: u32) -> Result<&Learned, LearnError> {
        let cell = &self.maps[number as usize];
        if let Some(learned) = cell.get() {
            return Ok(learned);
        }
        let seed = self.seeds[number as usize];
        let learned = learn(&venue.course, &venue.robot, &self.config, seed)?;
        // Two threads may learn it at once; they learn the same.
        Ok(cell.get_or_init(|| learned))
    }
}

/// Counts how often a robot goes back and forth between two ways ("this process of bouncing between two
/// possible routes").
///
/// To turn back once is no bouncing: every dead end asks for it. What counts is an action that takes back the
/// one before it, no more than [`Bounces::SOON`] completed actions after the last such.
#[derive(Debug, Default)]
struct Bounces {
    last: Option<Direction>,
    since_reversal: Option<u32>,
    count: u32,
}

impl Bounces {
    /// As many as the brain remembers in the Large maze.
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
