//! The micromouse of "Plot and Navigate a Virtual Maze" (Wang): its tables 1 to 4, and our search on whole sets of
//! mazes.
//!
//! The searches of tables 1 to 3 that leave things to chance have as many runs as the caller asks for, all others
//! make the same run each time and have one. In the tables `sets` and `competition` a run is a maze of the set; the
//! latter is of the competition model, which the paper does not know. The table `noise` is the paper's outlook.

mod comparisons;
mod competition;
mod figures;
mod noise;
mod paper;
mod sets;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_maze::Maze;
use tolman_planners::moves::{MoveExplorerConfig, RolloutConfig};

use crate::data;
use tolman_arena::micromouse::{Judgement, MAX_STEPS, try_on};
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Experiment, Fields, Job, Metric, Options, Record, Row, Run, Table, Tolerance, record,
    require,
};
use tolman_systems::baselines::q_learning::QLearningConfig;
use tolman_systems::micromouse::Searcher;

use competition::COMPETITION;
use paper::PaperTable;
use sets::{HALF_SIZE, MazeSet};

/// The experiment, ready to run.
#[derive(Debug)]
struct Micromouse {
    paper: Vec<PaperTable>,
    sets: Vec<MazeSet>,
    tables: Vec<Table>,
    skipped: Option<String>,
}

/// What the runs depend on.
#[derive(Serialize)]
struct Config {
    search: MoveExplorerConfig,
    rollouts: RolloutConfig,
    q_learning: QLearningConfig,
    mazes: BTreeMap<String, String>,
}

/// The name of the table of sets.
const SETS: &str = "sets";

/// The same, every stop chosen by the base policy.
const WITHOUT_ROLLOUTS: &str = "sets-without-rollouts";

/// Reads the mazes and sets the tables up.
///
/// # Errors
/// If a maze that the caller names cannot be read, or is too large.
pub(super) fn open(options: &Options) -> Result<Box<dyn Experiment>, BoxError> {
    let folder = data::folder();
    let paper = match &folder {
        Some(folder) => paper::tables(folder)?,
        None => Vec::new(),
    };
    let sets = sets::all(folder.as_deref(), &options.mazes)?;
    let mut tables: Vec<Table> = paper.iter().map(PaperTable::table).collect();
    tables.extend(comparisons::tables(&paper));
    let mut table = sets_table(SETS, "Our search on sets of mazes", &sets);
    if folder.is_none() {
        table.note = format!("{} {}", table.note, data::missing("the mazes of others"));
    }
    tables.push(table);
    let title = "The same search, without rollouts";
    tables.push(sets_table(WITHOUT_ROLLOUTS, title, &sets));
    tables.push(competition::table(&sets));
    tables.push(noise::table());
    let complaints: Vec<String> = sets.iter().filter_map(MazeSet::complaint).collect();
    Ok(Box::new(Micromouse {
        paper,
        sets,
        tables,
        skipped: (!complaints.is_empty()).then(|| complaints.join(" ")),
    }))
}

fn sets_table(name: &str, title: &str, sets: &[MazeSet]) -> Table {
    let mut table = Table::of::<SetRun>(name, title)
        .metric(Metric::mean(MouseRun::score_minus_floor))
        .metric(Metric::percent("certified_percent", MouseRun::certified))
        .metric(Metric::percent("finished_percent", MouseRun::finished))
        .metric(Metric::mean(MouseRun::score))
        .note(format!(
            "One run a maze. The floor is the score of a mouse that knows the maze. A mouse that has not \
             finished after {MAX_STEPS} steps has no score."
        ));
    for set in sets.iter().filter(|set| set.name != HALF_SIZE) {
        let mazes = u32::try_from(set.mazes.len()).unwrap_or(u32::MAX);
        table = table.row(Row::new(&set.name).runs(mazes));
    }
    table
}

/// Who plays in a table of sets of mazes.
fn on_sets(table: &str) -> Option<Searcher> {
    match table {
        SETS => Some(Searcher::Certify),
        WITHOUT_ROLLOUTS => Some(Searcher::CertifyPlain),
        _ => None,
    }
}

record! {
    /// Both runs of a mouse in a maze.
    #[check(MouseRun::relations)]
    struct MouseRun {
        /// Whether the mouse reached the goal in both runs within its steps.
        finished: bool => higher("finished"),
        /// Whether the second run is proved to be the best.
        certified: bool => higher("certified"),
        /// Steps of the best second run.
        optimum: u32 => neither("optimum").unit("steps"),
        /// Steps of the first run.
        run_1: Option<u32> => lower("first run").unit("steps"),
        /// Steps of the second run.
        move_length: Option<u32> => lower("move length").tolerance(Tolerance::Relative(0.15)),
        /// A thirtieth of the first run's steps and all of the second's.
        score: Option<f64> => lower("score").tolerance(Tolerance::Relative(0.2)),
        /// Score above that of a mouse that knows the maze.
        score_minus_floor: Option<f64> => lower("score − floor"),
    }
}

record! {
    /// The same in a maze of a set.
    struct SetRun {
        ..run: MouseRun,
        /// Name of the maze.
        maze: String => neither("maze"),
    }
}

impl MouseRun {
    fn of(judgement: &Judgement) -> Self {
        let runs = judgement.run_1.zip(judgement.run_2);
        let scores = judgement.score.zip(judgement.above_floor());
        Self {
            finished: judgement.score.is_some(),
            certified: judgement.certified,
            optimum: judgement.optimum,
            run_1: runs.map(|runs| runs.0),
            move_length: runs.map(|runs| runs.1),
            score: scores.map(|scores| scores.0),
            score_minus_floor: scores.map(|scores| scores.1),
        }
    }

    fn relations(&self) -> Result<(), String> {
        let (run_1, run_2) = (self.run_1, self.move_length);
        let finished = "a run that finished has a score, another has none";
        require(self.finished == self.score.is_some(), finished)?;
        require(run_1.is_some() == run_2.is_some(), finished)?;
        check_score(run_1, run_2, self.score)?;
        let possible = self.score.is_none() || run_2.is_none_or(|run_2| run_2 >= self.optimum);
        require(possible, "the second run has fewer steps than the optimum")?;
        let best = !self.certified || run_2 == Some(self.optimum);
        require(best, "what is certified is the optimum")
    }
}

impl Micromouse {
    fn set(&self, name: &str) -> Option<&MazeSet> {
        self.sets.iter().find(|set| set.name == name)
    }

    /// What is played: by whom, in which maze, and how the maze is called.
    fn cast(&self, job: &Job<'_>) -> Option<(Searcher, &Maze, &str)> {
        if let Some(searcher) = on_sets(job.table) {
            let set = self.set(job.row)?;
            let (name, maze) = set.mazes.get(job.run as usize)?;
            return Some((searcher, maze, name));
        }
        let table = self.paper.iter().find(|table| table.name == job.table)?;
        let (searcher, maze) = table.row(job.row)?;
        Some((searcher, maze, ""))
    }
}

/// Refuses a score that is not that of its runs, and runs that no mouse has the time for.
fn check_score(run_1: Option<u32>, run_2: Option<u32>, score: Option<f64>) -> Result<(), String> {
    let (Some(run_1), Some(run_2), Some(score)) = (run_1, run_2, score) else {
        return Ok(());
    };
    let expected = f64::from(run_1) / 30.0 + f64::from(run_2);
    require(
        (expected - score).abs() <= 1e-9,
        "the score is not that of its runs",
    )?;
    require(
        run_1 + run_2 <= MAX_STEPS,
        "the runs have more steps than a mouse has",
    )
}

impl Experiment for Micromouse {
    fn name(&self) -> &str {
        "micromouse"
    }

    fn title(&self) -> &str {
        "A micromouse in a virtual maze"
    }

    fn source(&self) -> &str {
        "X. Wang: Plot and Navigate a Virtual Maze, tables 1 to 4"
    }

    fn default_runs(&self) -> u32 {
        5
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn skipped(&self) -> Option<&str> {
        self.skipped.as_deref()
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        let mut mazes = BTreeMap::new();
        for table in &self.paper {
            for (row, maze) in table.mazes() {
                mazes.insert(format!("{}, {row}", table.name), maze.to_string());
            }
        }
        for set in &self.sets {
            for (name, maze) in &set.mazes {
                mazes.insert(format!("{}, {name}", set.name), maze.to_string());
            }
        }
        Ok(toml::Table::try_from(Config {
            search: MoveExplorerConfig::tuned(),
            rollouts: RolloutConfig::tuned(),
            q_learning: QLearningConfig::usual(),
            mazes,
        })?)
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        if job.table == COMPETITION {
            let set = self.set(job.row).ok_or("there is no such row")?;
            return competition::run(set, job.run as usize);
        }
        if job.table == noise::NOISE {
            return noise::run(job);
        }
        let compared = comparisons::run(&self.paper, job.table, job.row, job.run, job.seed)?;
        if let Some(fields) = compared {
            return Ok(fields);
        }
        let (searcher, maze, name) = self.cast(job).ok_or("there is no such run")?;
        let (_, judgement) = try_on(maze, searcher, job.seed)?;
        let run = MouseRun::of(&judgement);
        let maze = name.to_owned();
        Ok(match on_sets(job.table) {
            Some(_) => SetRun { run, maze }.fields()?,
            None => run.fields()?,
        })
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        let mut figures = figures::of(self, runs)?;
        figures.push(noise::figure(runs));
        Ok(figures)
    }
}
