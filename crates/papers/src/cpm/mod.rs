//! CPM: figures 9 and 11 of "Reasoning on the Self-Organizing Incremental Associative Memory for
//! Online Robot Path Planning" (Kawewong and others).
//!
//! Further tables show our own version that recognizes loops by dead reckoning, and mazes that the
//! paper's robot cannot tell apart. Others show the parts: how well junctions are recognized, how
//! many patterns there are, and what other learners need.

mod detector;
mod dictionary;
mod episodes;
mod explored;
mod figures;
mod fresh;
mod localization;
mod mazes;
mod places;
mod real;
mod replay;
mod trials;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_sim::robots::EpuckConfig;

use crate::rows::row_of;
use tolman_arena::course::Course;
use tolman_arena::cpm::{TrialRecord, epuck, learn};
use tolman_arena::diktiometry::EpuckSurveyConfig;
use tolman_arena::registry::Schooling;
use tolman_draw::Figure;
use tolman_experiment::{
    Beside, BoxError, Easel, Entry, Experiment, Fields, Headline, Job, Options, Procedure, Run,
    Table,
};
use tolman_replay::Replay;
use tolman_systems::baselines::q_learning::QLearningConfig;
use tolman_systems::cpm::{CommonPatterns, Mode};

use detector::DETECTOR;
use dictionary::{DICTIONARY, DictionaryRun};
use episodes::EPISODES;
use explored::EXPLORED;
use fresh::{FRESH, FreshRow};
use localization::{Known, LOCALIZATION};
use places::PLACES;
use real::{FIGURE_11, Real};
use trials::{Modes, Trials};

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "cpm",
    title: "CPM: common-pattern maps on an e-puck",
    source: "A. Kawewong, Y. Honda, M. Tsuboyama, O. Hasegawa: Reasoning on the Self-Organizing Incremental Associative Memory for Online \
             Robot Path Planning, figures 9 and 11",
    runs: 10,
    quick_runs: 3,
    main: &["9", "11"],
    tour: &[
        Headline {
            system: "CPM",
            measures: "solves Maze-3, %",
            table: "9",
            row: "Maze-3 offline",
            metric: "solved_percent",
            beside: Beside::Paper,
            runs: Some(5),
        },
        Headline {
            system: "CPM Better",
            measures: "solves look-alike mazes, %",
            table: "aliased",
            row: "Better",
            metric: "solved_percent",
            beside: Beside::Rival {
                row: "Faithful",
                called: "CPM",
            },
            runs: Some(25),
        },
    ],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Cpm {
    courses: Vec<Course>,
    real: Real,
    learning: Course,
    /// Patterns learned in the learning maze.
    patterns: CommonPatterns,
    trials: Vec<Trials>,
    /// Learned maps of the courses.
    known: Known,
    fresh: Vec<FreshRow>,
    /// Knowledge that robots learn before they are sent into fresh worlds.
    schooling: Schooling,
    master_seed: u64,
}

/// Configuration of the runs.
#[derive(Serialize)]
struct Config<'a, R, D> {
    robot: EpuckConfig,
    real: R,
    modes: BTreeMap<&'a str, Modes<'a>>,
    q_learning: QLearningConfig,
    places: EpuckSurveyConfig,
    detector: D,
    dictionary: DictionaryRun,
    mazes: BTreeMap<&'a str, String>,
    fresh: &'a [FreshRow],
}

/// Returns the experiment: reads the mazes, and lets the robot learn its patterns.
///
/// # Errors
/// If a maze cannot be read, or nothing is learned.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    let papers = options.mazes.is_empty();
    let courses = if papers {
        mazes::papers()?
    } else {
        mazes::from_files(&options.mazes)?
    };
    let (learning, real) = (mazes::learning()?, Real::new(options.seed)?);
    let patterns = learn(&learning, options.seed)?;
    let mut trials = vec![
        trials::figure_9(&courses, papers),
        trials::offline(&courses),
        trials::unlearned(&courses),
        explored::explored(&courses, papers, options),
    ];
    let mut tables: Vec<Table> = trials.iter().map(|trials| trials.table.clone()).collect();
    tables.push(episodes::table(&courses));
    tables.push(places::table(&courses));
    let fresh = if papers { fresh::rows() } else { Vec::new() };
    if papers {
        tables.push(fresh::table(&fresh, options));
        let aliased = trials::aliased(options);
        tables.push(aliased.table.clone());
        trials.push(aliased);
        tables.push(real::table(&real.course));
        tables.push(localization::table(&courses, options));
        tables.push(dictionary::table(&learning));
        tables.push(detector::table());
    }
    let cpm = Cpm {
        courses,
        real,
        learning,
        patterns,
        trials,
        known: Known::default(),
        fresh,
        schooling: Schooling::default(),
        master_seed: options.seed,
    };
    Ok(Experiment::new(ENTRY, tables, cpm.config()?, cpm))
}

/// Returns the percentage by which the second number is less than the first.
fn less([first, second]: [f64; 2]) -> f64 {
    100.0 * (1.0 - second / first)
}

/// Returns whether a value is present exactly when expected, and equals it within rounding.
fn agree(found: Option<f64>, expected: Option<f64>) -> bool {
    match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() < 1e-9,
        (found, expected) => found.or(expected).is_none(),
    }
}

impl Cpm {
    /// Returns maze and mode of a run that is a trial; `None` for another run.
    fn cast(&self, job: &Job<'_>) -> Result<Option<(Course, Mode)>, BoxError> {
        match job.table {
            EPISODES => Ok(Some((self.course(job)?.clone(), trials::faithful()))),
            _ => match self.trials_of(job.table) {
                Some(trials) => trials.cast(job).map(Some),
                None => Ok(None),
            },
        }
    }

    /// Plays the trial of a run, and returns its maze and its record; `None` for a run that is not
    /// a trial.
    fn play(&self, job: &Job<'_>) -> Result<Option<(Course, TrialRecord)>, BoxError> {
        let Some((course, mode)) = self.cast(job)? else {
            return Ok(None);
        };
        let record = trials::trial(&course, &self.patterns, mode, job.seed).play()?;
        Ok(Some((course, record)))
    }

    fn trials_of(&self, table: &str) -> Option<&Trials> {
        self.trials.iter().find(|trials| trials.table.name == table)
    }

    fn course(&self, job: &Job<'_>) -> Result<&Course, BoxError> {
        row_of(job, &self.courses, |course| course.name == job.row)
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let modes = self.trials.iter();
        let modes = modes.map(|trials| (&*trials.table.name, trials.modes()));
        let mazes = self
            .courses
            .iter()
            .chain([&self.learning, &self.real.course]);
        let mazes = mazes.map(|course| (&*course.name, course.maze.to_string()));
        Ok(toml::Table::try_from(Config {
            robot: epuck(),
            real: real::config(),
            modes: modes.collect(),
            q_learning: QLearningConfig::usual(),
            places: places::config(),
            detector: detector::config(),
            dictionary: DictionaryRun::of(&self.patterns),
            mazes: mazes.collect(),
            fresh: &self.fresh,
        })?)
    }
}

impl Procedure for Cpm {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match job.table {
            FIGURE_11 => self.real.run(job),
            LOCALIZATION => {
                let known = &self.known;
                known.run(&self.courses, &self.patterns, self.master_seed, job)
            }
            FRESH => {
                let row = row_of(job, &self.fresh, |row| row.row == job.row)?;
                row.run(&self.schooling, job.seed)
            }
            EPISODES => episodes::run(self.course(job)?, &self.patterns, job),
            PLACES => places::run(self.course(job)?, job),
            DICTIONARY => dictionary::run(&self.learning, job),
            DETECTOR => detector::run(&self.courses, job),
            table => match self.trials_of(table) {
                Some(trials) => trials.run(&self.patterns, job),
                None => Err(format!("there is no table {table:?}").into()),
            },
        }
    }

    fn shares(&self, job: &Job<'_>) -> Option<String> {
        (job.table == LOCALIZATION).then(|| localization::maps_of(job))?
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        figures::of(self, runs, easel)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        if job.table == FIGURE_11 {
            return replay::of_round_trip(&self.real, job).map(Some);
        }
        // The explored mazes look like those of figure 9, and the others are not trials.
        if [EPISODES, EXPLORED, FRESH].contains(&job.table) {
            return Ok(None);
        }
        let Some((course, mode)) = self.cast(job)? else {
            return Ok(None);
        };
        let trial = trials::trial(&course, &self.patterns, mode, job.seed);
        replay::of(&trial, job).map(Some)
    }
}
