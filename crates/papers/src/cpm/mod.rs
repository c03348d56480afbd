//! CPM: figures 9 and 11 of "Reasoning on the Self-Organizing Incremental Associative Memory for Online Robot Path Planning" (Kawewong
//! and others), the same with our own reading of loops, mazes that the paper's robot cannot tell apart, and what lies beneath: how
//! well junctions are told, how many patterns there are, what other learners need.

mod detector;
mod dictionary;
pub mod drawing;
mod episodes;
mod explored;
mod figures;
mod localization;
mod places;
mod real;
mod replay;
mod trials;
mod venue;

use tolman_arena::cpm::{CommonPatterns, Mode, Record, Venue, epuck, learn};
use tolman_draw::Figure;
use tolman_experiment::Run;
use tolman_experiment::{BoxError, Experiment, Fields, Job, Options, Table};
use tolman_replay::Replay;
use tolman_systems::baselines::q_learning::QLearningConfig;

use detector::DETECTOR;
use dictionary::DICTIONARY;
use episodes::EPISODES;
use explored::{EXPLORED, Explored};
use localization::{Known, LOCALIZATION};
use places::PLACES;
use real::{FIGURE_11, Real};
use trials::Trials;

/// The experiment, ready to run.
#[derive(Debug)]
struct Cpm {
    venues: Vec<Venue>,
    real: Real,
    learning: Venue,
    /// What the robot learned in the learning maze.
    patterns: CommonPatterns,
    trials: Vec<Trials>,
    explored: Explored,
    /// What the robot learned of the venues.
    known: Known,
    master_seed: u64,
    tables: Vec<Table>,
}

/// Reads the mazes, and lets the robot learn.
///
/// # Errors
/// If a maze cannot be read, or nothing is learned.
pub(super) fn open(options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let papers = options.mazes.is_empty();
    let venues = if papers {
        venue::papers()?
    } else {
        venue::from_files(&options.mazes)?
    };
    let (learning, real) = (venue::learning()?, Real::new(options.seed)?);
    let patterns = learn(&learning.maze, learning.corridor_width, options.seed)?;
    let mut trials = vec![
        trials::figure_9(&venues, papers),
        trials::offline(&venues),
        trials::unlearned(&venues),
    ];
    let mut tables: Vec<Table> = trials.iter().map(|trials| trials.table.clone()).collect();
    let explored = explored::explored(&venues, papers, options.quick);
    tables.push(explored.table.clone());
    tables.push(episodes::table(&venues));
    tables.push(places::table(&venues));
    if papers {
        let aliased = trials::aliased(options.quick);
        tables.push(aliased.table.clone());
        trials.push(aliased);
        tables.push(real.table());
        tables.push(localization::table(&venues, options.quick));
        tables.push(dictionary::table(&learning));
        tables.push(detector::table());
    }
    Ok(Box::new(Cpm {
        venues,
        real,
        learning,
        patterns,
        trials,
        explored,
        known: Known::default(),
        master_seed: options.seed,
        tables,
    }))
}

impl Cpm {
    /// The maze and the way of mapping of a run that is a trial.
    fn cast(&self, job: &Job<'_>) -> Result<Option<(Venue, Mode)>, BoxError> {
        match job.table {
            EPISODES => Ok(Some((self.venue(job.row)?.clone(), trials::faithful()))),
            _ => match self.trials_of(job.table) {
                Some(trials) => trials.cast(job).map(Some),
                None => Ok(None),
            },
        }
    }

    /// Plays the trial of a run, and says where; none of a run that is no trial.
    fn play(&self, job: &Job<'_>) -> Result<Option<(Venue, Record)>, BoxError> {
        let Some((venue, mode)) = self.cast(job)? else {
            return Ok(None);
        };
        let record = trials::trial(&venue, &self.patterns, mode, job.seed).play()?;
        Ok(Some((venue, record)))
    }

    fn trials_of(&self, table: &str) -> Option<&Trials> {
        self.trials.iter().find(|trials| trials.table.name == table)
    }

    fn venue(&self, name: &str) -> Result<&Venue, BoxError> {
        let venue = self.venues.iter().find(|venue| venue.name == name);
        venue.ok_or_else(|| format!("there is no row {name:?}").into())
    }
}

impl Experiment for Cpm {
    fn name(&self) -> &str {
        "cpm"
    }

    fn title(&self) -> &str {
        "CPM: common-pattern maps on an e-puck"
    }

    fn source(&self) -> &str {
        "A. Kawewong, Y. Honda, M. Tsuboyama, O. Hasegawa: Reasoning on the Self-Organizing Incremental Associative Memory for Online \
         Robot Path Planning, figures 9 and 11"
    }

    fn default_runs(&self) -> u32 {
        10
    }

    fn quick_runs(&self) -> u32 {
        3
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let mut config = toml::Table::new();
        config.insert("robot".into(), toml::Value::try_from(epuck())?);
        config.insert("real".into(), real::config()?);
        for trials in &self.trials {
            config.insert(trials.table.name.clone(), trials.modes().into());
        }
        config.insert(EXPLORED.into(), self.explored.modes().into());
        let learner = format!("{:?}", QLearningConfig::usual());
        config.insert("q_learning".into(), learner.into());
        config.insert("places".into(), places::config().into());
        config.insert("detector".into(), detector::config().into());
        let mut dictionary = toml::Table::new();
        dictionary.insert("units".into(), self.patterns.unit_count().into());
        dictionary.insert("clusters".into(), self.patterns.cluster_count().into());
        config.insert("dictionary".into(), dictionary.into());
        let mut mazes = toml::Table::new();
        for venue in self.venues.iter().chain([&self.learning, &self.real.venue]) {
            mazes.insert(venue.name.clone(), venue.maze.to_string().into());
        }
        config.insert("mazes".into(), mazes.into());
        Ok(config)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match job.table {
            FIGURE_11 => self.real.run(job),
            LOCALIZATION => {
                let known = &self.known;
                known.run(&self.venues, &self.patterns, self.master_seed, job)
            }
            EXPLORED => self.explored.run(&self.patterns, job),
            EPISODES => episodes::run(self.venue(job.row)?, &self.patterns, job),
            PLACES => places::run(self.venue(job.row)?, job),
            DICTIONARY => dictionary::run(&self.learning, job),
            DETECTOR => detector::run(&self.venues, job),
            table => match self.trials_of(table) {
                Some(trials) => trials.run(&self.patterns, job),
                None => Err(format!("there is no table {table:?}").into()),
            },
        }
    }

    fn check(&self, run: &Run) -> Result<(), BoxError> {
        match run.table.as_str() {
            FIGURE_11 => real::check(run),
            EXPLORED => explored::check(run),
            EPISODES => episodes::check(run),
            LOCALIZATION => localization::check(run),
            PLACES => places::check(run),
            DICTIONARY => dictionary::check(run),
            DETECTOR => detector::check(run),
            _ => trials::check(run),
        }
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        if job.table == FIGURE_11 {
            return replay::of_round_trip(&self.real, job).map(Some);
        }
        // Those are as those of figure 9.
        if job.table == EPISODES {
            return Ok(None);
        }
        let Some((venue, mode)) = self.cast(job)? else {
            return Ok(None);
        };
        let trial = trials::trial(&venue, &self.patterns, mode, job.seed);
        replay::of(&venue, &trial, job).map(Some)
    }
}
