//! MSLST itself: tables 1 to 3 of "Maze Solving by Learning State Topologies", and all tests of
//! significance.
//!
//! In a paper's world every brain meets the same starts and the same noise. MSLST learns `MAPS`
//! maps of each world. Run number n navigates by map n mod `MAPS`, so a thousand runs use each map
//! twenty times. The tables *one map* are the paper's 25 runs. One drawing says little about what
//! the paper's maze would have shown. So `families` plays all entrants in many drawings.

mod condition;
mod contest;
mod driven;
mod entrant;
mod families;
mod figures;
mod free_worlds;
mod hardest;
mod map_size;
mod robustness;
mod states;

use crate::venue::{self, Venue};
use tolman_draw::Figure;
use tolman_experiment::{
    Beside, BoxError, Easel, Entry, Experiment, Fields, Headline, Job, Options, P_TABLE, Procedure,
    Run, Table,
};
use tolman_replay::Replay;

use contest::Contest;
use families::Family;
use free_worlds::{FREE_WORLDS, FreeWorlds};
use hardest::{HARDEST, Hardest};
use robustness::{ABLATION, ROBUSTNESS, Robustness};

/// Number of maps learned of each world and threshold.
const MAPS: u32 = 50;

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "mslst",
    title: "MSLST: maze solving by learning state topologies",
    source: "D. Tingle, E. Ball, M. Augat: Maze Solving by Learning State Topologies, tables 1 to 3",
    runs: 25,
    quick_runs: 10,
    main: &["2 (J)"],
    tour: &[
        Headline {
            system: "MSLST",
            measures: "arrives in the J maze, %",
            table: "2 (J)",
            row: "MSLST 100",
            metric: "success_percent",
            beside: Beside::Paper,
            runs: Some(10),
        },
        Headline {
            system: "MSLST",
            measures: "arrives in the Large maze, %",
            table: "3 (Large)",
            row: "MSLST 50",
            metric: "success_percent",
            beside: Beside::Paper,
            runs: Some(10),
        },
        Headline {
            system: "MSLST Better",
            measures: "arrives in random mazes, %",
            table: "random mazes",
            row: "Better",
            metric: "success_percent",
            beside: Beside::Rival {
                row: "MSLST 50",
                called: "MSLST",
            },
            runs: Some(20),
        },
    ],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Mslst {
    contests: Vec<Contest>,
    families: Vec<Family>,
    robustness: Robustness,
    free_worlds: FreeWorlds,
    /// The hardest worlds; `None` if the caller names mazes.
    hardest: Option<Hardest>,
}

/// Returns the experiment with its worlds and tables.
///
/// # Errors
/// If a maze cannot be read, or the robot does not fit its corridors.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    let papers = options.mazes.is_empty();
    let contest = |venue: Venue| Contest::new(venue.limited(options.limit), options.seed);
    let contests: Vec<Contest> = if papers {
        let [j, large] = venue::papers()?.map(contest);
        let one_map =
            |venue: Venue| Contest::with_one_map(venue.limited(options.limit), options.seed);
        let [j_by_one, large_by_one] = venue::papers()?.map(one_map);
        vec![
            j,
            j_by_one,
            large,
            large_by_one,
            contest(venue::large_hard()?),
        ]
    } else {
        let venues = venue::from_files(&options.mazes, &[P_TABLE])?;
        venues.into_iter().map(contest).collect()
    };
    let worlds = contests.iter();
    let worlds = worlds.map(|contest| (&*contest.venue.table, contest.config()));
    let mut config = venue::config(worlds)?;
    let mut tables: Vec<Table> = contests.iter().map(Contest::table).collect();
    let (runs, limit) = (options.runs_of(&ENTRY), options.limit);
    let mut mslst = Mslst {
        contests,
        families: Vec::new(),
        robustness: Robustness::new(runs, limit),
        free_worlds: FreeWorlds::new(runs, options.seed),
        hardest: None,
    };
    if papers {
        mslst.families = vec![
            Family::drawings(runs, limit),
            Family::overlay(runs, limit),
            Family::random(runs, limit),
        ];
        let hardest = mslst.hardest.insert(Hardest::new(runs, limit)?);
        tables.insert(0, states::table());
        tables.extend(mslst.families.iter().map(Family::table));
        tables.push(map_size::table(runs));
        tables.extend(mslst.robustness.tables());
        tables.push(hardest.table());
        tables.push(mslst.free_worlds.table());
        for family in &mslst.families {
            let of_mazes = toml::Value::try_from(family.config())?;
            config.insert(family.name().to_owned(), of_mazes);
        }
        let of_drawings = toml::Value::try_from(mslst.robustness.config())?;
        config.insert(ROBUSTNESS.to_owned(), of_drawings);
        let of_worlds = toml::Value::try_from(hardest.config())?;
        config.insert(HARDEST.to_owned(), of_worlds);
    }
    Ok(Experiment::new(ENTRY, tables, config, mslst))
}

impl Mslst {
    fn contest(&self, table: &str) -> Option<&Contest> {
        let mut contests = self.contests.iter();
        contests.find(|contest| contest.venue.table == table)
    }
}

impl Procedure for Mslst {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let mut families = self.families.iter();
        if let Some(family) = families.find(|family| family.name() == job.table) {
            return family.run(job);
        }
        if job.table == map_size::MAP_SIZE {
            return map_size::run(job);
        }
        if [ROBUSTNESS, ABLATION].contains(&job.table) {
            return self.robustness.run(job);
        }
        if job.table == FREE_WORLDS {
            return self.free_worlds.run(job);
        }
        if let Some(hardest) = self.hardest.as_ref().filter(|_| job.table == HARDEST) {
            return hardest.run(job);
        }
        match self.contest(job.table) {
            Some(contest) => contest.run(job),
            None => states::run(job, &self.contests),
        }
    }

    fn shares(&self, job: &Job<'_>) -> Option<String> {
        let run = job.run;
        if self
            .families
            .iter()
            .any(|family| family.name() == job.table)
        {
            return Some(format!("maze {run} of {}", job.table));
        }
        if [ROBUSTNESS, ABLATION].contains(&job.table) {
            return Some(format!("drawing {run}"));
        }
        self.contest(job.table)?.map_of(job)
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs, easel)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        let contest = self.contest(job.table);
        contest.map(|contest| contest.replay(job)).transpose()
    }
}
