//! The micromouse of "Plot and Navigate a Virtual Maze" (Wang): its tables 1 to 4, and our search
//! on whole sets of mazes.
//!
//! Random searches of tables 1 to 3 have as many runs as the caller asks for. All other rows are
//! deterministic and have one run. In the tables `sets` and `competition` a run is a maze of the
//! set. The latter uses the competition model, which the paper does not have. The table `noise` is
//! the paper's outlook.

mod comparisons;
mod competition;
mod figures;
mod noise;
mod paper;
mod sets;
mod until;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_planners::moves::{MoveExplorerConfig, RolloutConfig, WorthConfig};

use crate::data;
use crate::metrics::UsualMetrics as _;
use crate::tolerances::{MOUSE_SCORE, MOVES};
use tolman_arena::micromouse::{Judgement, MAX_STEPS, floor, try_on};
use tolman_draw::Figure;
use tolman_experiment::{
    Beside, BoxError, Easel, Entry, Experiment, Fields, Headline, Job, Metric, Options, Procedure,
    Record, Row, Run, Table, record, require,
};
use tolman_maze::Maze;
use tolman_systems::baselines::q_learning::QLearningConfig;
use tolman_systems::micromouse::Searcher;

use comparisons::{PLANNERS, Q_LEARNING};
use competition::COMPETITION;
use noise::NOISE;
use paper::PaperTable;
use sets::{HALF_SIZE, MazeSet};

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "micromouse",
    title: "A micromouse in a virtual maze",
    source: "X. Wang: Plot and Navigate a Virtual Maze, tables 1 to 4",
    runs: 5,
    quick_runs: 5,
    main: &["1", "competition"],
    tour: &[
        Headline {
            system: "Micromouse",
            measures: "score in Maze 1, less is good",
            table: "1",
            row: "certifying search",
            metric: "average_score",
            beside: Beside::Paper,
            runs: None,
        },
        Headline {
            system: "Micromouse",
            measures: "proves its best run, %",
            table: "competition",
            row: "braided 16",
            metric: "certified_percent",
            beside: Beside::Nothing,
            runs: None,
        },
    ],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Micromouse {
    paper: Vec<PaperTable>,
    sets: Vec<MazeSet>,
}

/// Configuration of the runs.
#[derive(Serialize)]
struct Config {
    search: MoveExplorerConfig,
    rollouts: RolloutConfig,
    worth: WorthConfig,
    q_learning: QLearningConfig,
    mazes: BTreeMap<String, String>,
}

/// Name of the table of sets.
const SETS: &str = "sets";

/// Name of the same table with every stop chosen by the base policy.
const WITHOUT_ROLLOUTS: &str = "sets-without-rollouts";

/// Returns the experiment with its mazes and tables.
///
/// # Errors
/// If a maze that the caller names cannot be read, or is too large.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    let folder = data::folder();
    let paper = paper::tables(folder.as_deref())?;
    let sets = sets::all(folder.as_deref(), &options.mazes)?;
    let mut tables: Vec<Table> = paper.iter().map(PaperTable::table).collect();
    tables.extend(comparisons::tables(&paper));
    let mut table = until::rows(
        sets_table(SETS, "Our search on sets of mazes", &sets),
        &sets,
    );
    if folder.is_none() {
        table.note = format!("{} {}", table.note, data::missing("the mazes of others"));
    }
    tables.push(table);
    let title = "The same search, without rollouts";
    tables.push(sets_table(WITHOUT_ROLLOUTS, title, &sets));
    tables.push(competition::table(&sets));
    tables.push(noise::table(options));
    let complaints: Vec<String> = sets.iter().filter_map(MazeSet::complaint).collect();
    let skipped = (!complaints.is_empty()).then(|| complaints.join(" "));
    let config = toml::Table::try_from(Config {
        search: MoveExplorerConfig::tuned(),
        rollouts: RolloutConfig::tuned(),
        worth: WorthConfig::tuned(),
        q_learning: QLearningConfig::usual(),
        mazes: all_mazes(&paper, &sets),
    })?;
    let micromouse = Micromouse { paper, sets };
    Ok(Experiment::new(ENTRY, tables, config, micromouse).skipped(skipped))
}

/// Returns the mazes of all tables by table and name.
fn all_mazes(paper: &[PaperTable], sets: &[MazeSet]) -> BTreeMap<String, String> {
    let of_paper = paper
        .iter()
        .flat_map(|table| table.mazes().map(|(row, maze)| (table.name, row, maze)));
    let of_sets = sets.iter().flat_map(|set| {
        let mazes = set.mazes.iter();
        mazes.map(|(name, maze)| (set.name.as_str(), name.as_str(), maze))
    });
    let all = of_paper.chain(of_sets);
    all.map(|(table, name, maze)| (format!("{table}, {name}"), maze.to_string()))
        .collect()
}

fn sets_table(name: &str, title: &str, sets: &[MazeSet]) -> Table {
    Table::of::<SetRun>(name, title)
        .metrics([SetRun::score, MouseRun::certified, MouseRun::finished])
        .rows(sets.iter().filter(|set| set.name != HALF_SIZE).map(MazeSet::row))
        .note(format!(
            "One run a maze. The floor is the score of a mouse that knows the maze, and is subtracted. A mouse that \
             has not finished after {MAX_STEPS} steps has no score."
        ))
}

record! {
    /// Both runs of a mouse in a maze.
    #[check(MouseRun::relations)]
    struct MouseRun {
        /// Whether the mouse reached the goal in both runs within its steps.
        finished: bool => higher("finished"),
        /// Whether the second run is proven to be the best.
        certified: bool => higher("certified"),
        /// Number of steps of the best second run.
        optimum: u32 => neither("optimum").unit("steps"),
        /// Number of steps of the first run.
        run_1: Option<u32> => lower("first run").unit("steps"),
        /// Number of steps of the second run.
        move_length: Option<u32> => lower("move length").tolerance(MOVES),
    }
}

record! {
    /// Both runs in a maze of the paper.
    #[check(PaperRun::relations)]
    struct PaperRun {
        ..run: MouseRun,
        /// A thirtieth of the first run's steps plus those of the second run.
        score: Option<f64> => lower("score").tolerance(MOUSE_SCORE),
        /// The paper's benchmark: a thirtieth of the number of cells plus the steps of the best
        /// second run.
        benchmark: f64 => neither("benchmark"),
    }
}

record! {
    /// Both runs in a maze of a set.
    #[check(SetRun::relations)]
    struct SetRun {
        ..run: MouseRun,
        /// Score minus that of a mouse that knows the maze.
        score: Option<f64> => lower("score − floor"),
        /// Name of the maze.
        maze: String => neither("maze"),
    }
}

impl MouseRun {
    fn of(judgement: &Judgement) -> Self {
        let runs = judgement.run_1.zip(judgement.run_2);
        Self {
            finished: judgement.score.is_some(),
            certified: judgement.certified,
            optimum: judgement.optimum,
            run_1: runs.map(|runs| runs.0),
            move_length: runs.map(|runs| runs.1),
        }
    }

    fn relations(&self) -> Result<(), String> {
        let (run_1, run_2) = (self.run_1, self.move_length);
        require(
            run_1.is_some() == run_2.is_some(),
            "a mouse that finished has made both runs",
        )?;
        let possible = run_2.is_none_or(|run_2| run_2 >= self.optimum);
        require(
            possible || !self.finished,
            "the second run has fewer steps than the optimum",
        )?;
        let best = !self.certified || run_2 == Some(self.optimum);
        require(best, "what is certified is the optimum")
    }

    /// Refuses a score that, after adding `subtracted`, does not follow from the runs.
    fn check_score(&self, score: Option<f64>, subtracted: f64) -> Result<(), String> {
        let finished = "a run that finished has a score, another has none";
        require(self.finished == score.is_some(), finished)?;
        check_score(
            self.run_1,
            self.move_length,
            score.map(|score| score + subtracted),
        )
    }
}

impl PaperRun {
    fn of(judgement: &Judgement, maze: &Maze) -> Self {
        let cells = maze.grid().cell_count() as f64;
        Self {
            run: MouseRun::of(judgement),
            score: judgement.score,
            benchmark: cells / 30.0 + f64::from(judgement.optimum),
        }
    }

    fn relations(&self) -> Result<(), String> {
        self.run.check_score(self.score, 0.0)
    }
}

impl SetRun {
    fn of(judgement: &Judgement, maze: &str) -> Self {
        Self {
            run: MouseRun::of(judgement),
            score: judgement.above_floor(),
            maze: maze.to_owned(),
        }
    }

    fn relations(&self) -> Result<(), String> {
        let floor = floor(self.run.optimum);
        self.run.check_score(self.score, floor)
    }
}

impl Micromouse {
    fn set(&self, name: &str) -> Result<&MazeSet, BoxError> {
        let set = self.sets.iter().find(|set| set.name == name);
        set.ok_or_else(|| format!("there is no set {name:?}").into())
    }

    /// Plays a run in a maze of a set.
    fn run_on_set(&self, job: &Job<'_>, searcher: Searcher) -> Result<Fields, BoxError> {
        let (maze, walls) = self.set(job.row)?.maze(job.run)?;
        let judgement = try_on(walls, searcher, job.seed, |_| {})?.1;
        Ok(SetRun::of(&judgement, maze).fields()?)
    }

    /// Plays a run in the maze of a table of the paper.
    fn run_of_paper(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let table = self.paper.iter().find(|table| table.name == job.table);
        let row = table.and_then(|table| table.row(job.row));
        let (searcher, maze) = row.ok_or("there is no such run")?;
        let judgement = try_on(maze, searcher, job.seed, |_| {})?.1;
        Ok(PaperRun::of(&judgement, maze).fields()?)
    }
}

/// Refuses a score that does not follow from its runs, and runs that take longer than a mouse's
/// time limit.
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

impl Procedure for Micromouse {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match job.table {
            SETS => match until::of_row(job.row) {
                Some(until) => until::run(self.set(until::SET)?, until, job),
                None => self.run_on_set(job, Searcher::Certify),
            },
            WITHOUT_ROLLOUTS => self.run_on_set(job, Searcher::CertifyPlain),
            COMPETITION => competition::run(self.set(job.row)?, job.run),
            NOISE => noise::run(job),
            PLANNERS => comparisons::plan(&self.paper, job),
            Q_LEARNING => comparisons::learn(&self.paper, job),
            _ => self.run_of_paper(job),
        }
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        let mut figures = easel.draw("paper", figures::TABLE, || figures::of(self, runs))?;
        figures.push(noise::figure(runs));
        Ok(figures)
    }
}
