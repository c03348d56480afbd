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

use tolman_maze::Maze;
use tolman_planners::moves::{MoveExplorerConfig, RolloutConfig};

use crate::data;
use tolman_arena::micromouse::{MAX_STEPS, Searcher};
use tolman_draw::Figure;
use tolman_experiment::{
    BoxError, Experiment, Field, Fields, Job, Kind, Metric, Options, Row, Run, Table, Tolerance,
};
use tolman_systems::baselines::q_learning::QLearningConfig;

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
    let mut table = fields(Table::new(name, title))
        .field("maze", Kind::Text)
        .metric(Metric::mean("score_minus_floor").titled("score − floor"))
        .metric(Metric::percent("certified_percent", "certified"))
        .metric(Metric::percent("finished_percent", "finished"))
        .metric(Metric::mean("score"))
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

/// What every run of this experiment measures.
fn fields(table: Table) -> Table {
    table
        .field("finished", Kind::Flag)
        .field("certified", Kind::Flag)
        .field("optimum", Kind::Count)
        .optional_field("run_1", Kind::Count)
        .optional_field("move_length", Kind::Count)
        .optional_field("score", Kind::Number)
        .optional_field("score_minus_floor", Kind::Number)
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
fn check_score(run_1: f64, run_2: f64, score: f64) -> Result<(), BoxError> {
    if (run_1 / 30.0 + run_2 - score).abs() > 1e-9 {
        return Err(format!("{run_1} / 30 + {run_2} is not {score}").into());
    }
    if run_1 + run_2 > f64::from(MAX_STEPS) {
        return Err(format!("{run_1} + {run_2} steps are more than {MAX_STEPS}").into());
    }
    Ok(())
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
        let mut config = toml::Table::new();
        config.insert(
            "search".into(),
            format!("{:?}", MoveExplorerConfig::tuned()).into(),
        );
        config.insert(
            "rollouts".into(),
            format!("{:?}", RolloutConfig::tuned()).into(),
        );
        config.insert(
            "q_learning".into(),
            format!("{:?}", QLearningConfig::usual()).into(),
        );
        let mut mazes = toml::Table::new();
        for table in &self.paper {
            for (row, maze) in table.mazes() {
                mazes.insert(format!("{}, {row}", table.name), maze.to_string().into());
            }
        }
        for set in &self.sets {
            for (name, maze) in &set.mazes {
                mazes.insert(format!("{}, {name}", set.name), maze.to_string().into());
            }
        }
        config.insert("mazes".into(), mazes.into());
        Ok(config)
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
        let (_, judgement) = searcher.try_on(maze, job.seed)?;
        let mut fields = Fields::new()
            .flag("finished", judgement.score.is_some())
            .flag("certified", judgement.certified)
            .count("optimum", judgement.optimum.into());
        if let (Some(run_1), Some(run_2)) = (judgement.run_1, judgement.run_2) {
            fields = fields
                .count("run_1", run_1.into())
                .count("move_length", run_2.into());
        }
        if let (Some(score), Some(above)) = (judgement.score, judgement.above_floor()) {
            fields = fields
                .number("score", score)
                .number("score_minus_floor", above);
        }
        if on_sets(job.table).is_some() {
            fields = fields.text("maze", name);
        }
        Ok(fields)
    }

    fn check(&self, run: &Run) -> Result<(), BoxError> {
        if run.table == COMPETITION {
            let set = self.set(&run.row).ok_or("there is no such row")?;
            return competition::check(set, run);
        }
        if run.table == noise::NOISE {
            return noise::check(run);
        }
        if let Some(checked) = comparisons::check(run) {
            return checked;
        }
        let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
        let flag = |name: &str| run.fields.get(name).and_then(Field::as_flag) == Some(true);
        if let Some((_, _, name)) = self.cast(&run.job())
            && on_sets(&run.table).is_some()
            && run.fields.get("maze").and_then(Field::as_text) != Some(name)
        {
            return Err(format!("run {} is of {name}", run.run).into());
        }
        let (run_1, run_2) = (number("run_1"), number("move_length"));
        if flag("finished") != number("score").is_some() || run_1.is_some() != run_2.is_some() {
            return Err("a run that finished has a score, another has none".into());
        }
        if let (Some(run_1), Some(run_2), Some(score)) = (run_1, run_2, number("score")) {
            check_score(run_1, run_2, score)?;
            if number("optimum").is_none_or(|optimum| run_2 < optimum) {
                return Err(format!("{run_2} steps are fewer than the optimum").into());
            }
        }
        if flag("certified") && run_2 != number("optimum") {
            return Err("what is certified is the optimum".into());
        }
        Ok(())
    }

    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        let mut figures = figures::of(self, runs)?;
        figures.push(noise::figure(runs));
        Ok(figures)
    }
}
