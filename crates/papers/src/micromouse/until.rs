//! The classic set, with three seeds per maze, for two ways to stop exploring: with a proof, or
//! when further looks no longer pay.

use tolman_arena::micromouse::{self, Judgement, brief};
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table};
use tolman_maze::Maze;
use tolman_planners::moves::{MoveExplorerConfig, RolloutConfig, WorthConfig};
use tolman_systems::micromouse::{Certify, Driver, RunTwo, Until};

use super::SetRun;
use super::sets::MazeSet;

/// Name of the set.
pub(super) const SET: &str = "classic";

/// Number of runs in each maze, with different random numbers.
const SEEDS: u32 = 3;

const ROWS: [(&str, Until); 2] = [
    ("classic · proof", Until::Proof),
    ("classic · worth", Until::Worth),
];

/// Adds the rows, if the set is here.
pub(super) fn rows(table: Table, sets: &[MazeSet]) -> Table {
    let Some(set) = sets.iter().find(|set| set.name == SET) else {
        return table;
    };
    let runs = SEEDS * set.mazes.len() as u32;
    let note = format!(
        "{} In the rows that say when the mouse stops to explore, each maze has {SEEDS} runs, which are the same in both but for that.",
        table.note
    );
    let rows = ROWS.map(|(row, _)| Row::new(row).run_each(runs));
    table.rows(rows).note(note)
}

/// Returns when the mouse of a row stops; `None` for other rows.
pub(super) fn of_row(row: &str) -> Option<Until> {
    let found = ROWS.into_iter().find(|(name, _)| *name == row);
    found.map(|(_, until)| until)
}

/// Plays a run in a maze of the set.
pub(super) fn run(set: &MazeSet, until: Until, job: &Job<'_>) -> Result<Fields, BoxError> {
    let count = set.mazes.len().max(1) as u32;
    let (name, maze) = set.maze(job.run % count)?;
    let judgement = judged(maze, until, job.seed)?;
    Ok(SetRun::of(&judgement, name).fields()?)
}

/// Returns the judgement of a mouse whose random numbers are seeded by `seed`.
fn judged(maze: &Maze, until: Until, seed: u64) -> Result<Judgement, BoxError> {
    let brief = brief(maze)?;
    let explorer = MoveExplorerConfig::tuned();
    let mut rollouts = RolloutConfig::tuned();
    rollouts.seed = seed;
    let worth = (until == Until::Worth).then(WorthConfig::tuned);
    let search = Certify::new(explorer, Some(rollouts), worth, brief.grid, brief.start)?;
    let mouse = Driver::new(brief, search, RunTwo::FewestMoves)?;
    Ok(micromouse::send(maze, mouse, |_| {})?.1)
}
