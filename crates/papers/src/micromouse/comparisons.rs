//! Comparisons that the paper only describes (section 3.2): ways to search a known maze, and
//! Q-learning.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Maze};
use tolman_planners::{Arcs, Found, a_star, best_first, depth_first, path_to};

use super::paper::PaperTable;
use super::{Fields, Job, Metric, Row, Table};
use crate::rows::row_of;
use tolman_arena::micromouse::{CellTask, MAX_STEPS};
use tolman_experiment::{BoxError, Record, record, require};
use tolman_systems::baselines::q_learning::{QLearner, QLearningConfig};

/// Name of the table of planners.
pub(super) const PLANNERS: &str = "planners";
/// Name of the table of Q-learning.
pub(super) const Q_LEARNING: &str = "q-learning";

/// Maximum number of steps of Q-learning.
const MOST_STEPS: u32 = 1_000_000;
/// Number of steps between two tests of what was learned.
const LOOK: u32 = 100;

const ROWS: [&str; 5] = [
    "breadth-first",
    "depth-first",
    "Dijkstra",
    "A*",
    "best-first",
];

record! {
    /// A search in a known maze.
    struct PlannerRun {
        /// Length of the path that was found, in steps from cell to cell.
        path_cells: u32 => lower("path").unit("cells").at_least(1),
        /// Number of cells whose neighbours were listed, if the search counts them.
        expanded: Option<u32> => lower("expanded").unit("cells"),
    }
}

record! {
    /// Q-learning in a known maze.
    #[check(LearningRun::relations)]
    struct LearningRun {
        /// Whether a shortest path was learned within a mouse's time limit.
        learned_in_time: bool => higher("learned in time"),
        /// Whether a shortest path was learned at all.
        learned: bool => higher("learned"),
        /// Number of steps until a shortest path was learned.
        steps: Option<u32> => lower("steps to learn").at_most(MOST_STEPS),
    }
}

impl LearningRun {
    fn relations(&self) -> Result<(), String> {
        let in_time = !self.learned_in_time || self.learned;
        require(in_time, "what is learned in time is learned")?;
        let learned = self.learned == self.steps.is_some();
        require(learned, "what is learned was learned in some steps")
    }
}

/// Returns the tables, if the paper's mazes are here.
pub(super) fn tables(paper: &[PaperTable]) -> Vec<Table> {
    let mazes = mazes(paper);
    if mazes.is_empty() {
        return Vec::new();
    }
    let of_all = |row| Row::new(row).run_each(mazes.len() as u32);
    let planners = Table::of::<PlannerRun>(PLANNERS, "Searches in a known maze, by cells")
        .metrics_from(PlannerRun::path_cells)
        .rows(ROWS.map(of_all))
        .note(
            "One run on each of the paper's mazes 1 to 3. A* and best-first guess by the Manhattan distance. Expanded \
             is how many cells' neighbours were looked at.",
        );
    let learning = Table::of::<LearningRun>(Q_LEARNING, "Q-learning in a known maze")
        .metric(
            Metric::percent("learned_in_time_percent", LearningRun::learned_in_time)
                .titled(format!("learned in {MAX_STEPS} steps")),
        )
        .metric(Metric::median("steps_to_learn", LearningRun::steps))
        .rows(mazes.iter().map(|(name, _)| Row::new(*name)))
        .note(format!(
            "Learned is a shortest path in cells. Looked at every {LOOK} steps, up to {MOST_STEPS}."
        ));
    vec![planners, learning]
}

/// Returns the mazes of tables 1 to 3.
fn mazes(paper: &[PaperTable]) -> Vec<(&'static str, &Maze)> {
    ["1", "2", "3"]
        .into_iter()
        .zip(["maze 1", "maze 2", "maze 3"])
        .filter_map(|(table, name)| {
            let table = paper.iter().find(|paper| paper.name == table)?;
            Some((name, table.mazes().next()?.1))
        })
        .collect()
}

/// Returns the steps from cell to cell, with cells as nodes by [`tolman_maze::Grid::index`].
fn steps(maze: &Maze) -> Arcs {
    let grid = maze.grid();
    let node = |cell| grid.index(cell) as u32;
    let from = |cell| {
        let beside = maze.neighbours(cell).map(|(_, beside)| beside);
        beside.map(move |beside| (node(cell), node(beside), 1))
    };
    let arcs: Vec<_> = grid.cells().flat_map(from).collect();
    Arcs::new(grid.cell_count(), &arcs)
}

/// Plays a run: searches one maze.
pub(super) fn plan(paper: &[PaperTable], job: &Job<'_>) -> Result<Fields, BoxError> {
    let mazes = mazes(paper);
    let (_, maze) = mazes.get(job.run as usize).ok_or("there is no such maze")?;
    let grid = maze.grid();
    let (start, _) = maze.start().ok_or("the maze has no start")?;
    let source = grid.index(start) as u32;
    let goals: Vec<u32> = maze
        .goals()
        .iter()
        .map(|goal| grid.index(*goal) as u32)
        .collect();
    let is_goal = |node: u32| goals.contains(&node);
    let manhattan = |node: u32| {
        let cell = grid.cells().nth(node as usize).unwrap_or(start);
        let distance = |goal: &Cell| u32::from(goal.x.abs_diff(cell.x) + goal.y.abs_diff(cell.y));
        maze.goals().iter().map(distance).min().unwrap_or(0)
    };
    let cells = steps(maze);
    let counted = |Found { cost, expanded, .. }: Found| (cost, Some(expanded));
    let found = match job.row {
        "breadth-first" => {
            let path = path_to(&cells, source, is_goal);
            path.map(|path| (path.len() as u32 - 1, None))
        }
        "depth-first" => depth_first(&cells, source, is_goal).map(counted),
        "Dijkstra" => a_star(&cells, source, is_goal, |_| 0).map(counted),
        "A*" => a_star(&cells, source, is_goal, manhattan).map(counted),
        _ => best_first(&cells, source, is_goal, manhattan).map(counted),
    };
    let (path_cells, expanded) = found.ok_or("no way")?;
    let run = PlannerRun {
        path_cells,
        expanded,
    };
    Ok(run.fields()?)
}

/// Plays a run: learns one maze.
pub(super) fn learn(paper: &[PaperTable], job: &Job<'_>) -> Result<Fields, BoxError> {
    let (_, maze) = row_of(job, mazes(paper), |(name, _)| *name == job.row)?;
    let (start, _) = maze.start().ok_or("the maze has no start")?;
    let shortest = maze.steps_to_goal()[maze.grid().index(start)];
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    let mut learner = QLearner::new(QLearningConfig::usual(), CellTask::new(maze, start));
    let mut steps = 0;
    while steps < MOST_STEPS {
        for _ in 0..LOOK {
            learner.step(&mut rng);
        }
        steps += LOOK;
        if learner.greedy_cost() == shortest {
            let run = LearningRun {
                learned: true,
                learned_in_time: steps <= MAX_STEPS,
                steps: Some(steps),
            };
            return Ok(run.fields()?);
        }
    }
    Ok(LearningRun::default().fields()?)
}
