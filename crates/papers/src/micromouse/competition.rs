//! The competition model, which is not in the paper: sets of mazes explored for the speed run.

use tolman_maze::Maze;
use tolman_planners::speed_run::SpeedRunConfig;

use super::sets::MazeSet;
use tolman_arena::competition;
use tolman_experiment::{BoxError, Fields, Record, Table, record, require};
use tolman_systems::micromouse::competition::ExploreError;

/// Name of the table.
pub(super) const COMPETITION: &str = "competition";

record! {
    /// A maze explored for the speed run.
    #[check(CompetitionRun::relations)]
    struct CompetitionRun {
        /// Name of the maze.
        maze: String => neither("maze"),
        /// Whether the known speed run is proven to be the fastest.
        certified: bool => higher("certified"),
        /// Number of cells driven until the mouse is back at the start.
        cells: Option<u32> => lower("cells").at_least(2),
        /// Time of the speed run.
        run_ms: Option<u32> => neither("speed run").unit("ms"),
    }
}

impl CompetitionRun {
    fn relations(&self) -> Result<(), String> {
        let explored = self.cells.is_some() == self.run_ms.is_some();
        require(
            explored,
            "cells and the time of the speed run come together",
        )?;
        require(
            !self.certified || self.cells.is_some(),
            "a certified run was explored",
        )
    }
}

/// Returns the table; each run is a maze of the set.
pub(super) fn table(sets: &[MazeSet]) -> Table {
    Table::of::<CompetitionRun>(COMPETITION, "Explorations for the speed run")
        .metrics_from(CompetitionRun::certified)
        .rows(sets.iter().map(MazeSet::row))
        .note(
            "One run per maze. Cells are all that the mouse drives from the start until it is back \
             there with a speed run that is certified to be the fastest. It has been at a goal then. \
             Sets with mazes of more than 16 cells a side are driven as half-size ones, all others \
             as classic ones.",
        )
}

/// Returns the speed-run settings for the mazes of a set: half-size if any is larger than 16 × 16.
fn drive(set: &MazeSet) -> SpeedRunConfig {
    let larger = |maze: &Maze| maze.grid().width().max(maze.grid().height()) > 16;
    if set.mazes.iter().any(|(_, maze)| larger(maze)) {
        SpeedRunConfig::half_size()
    } else {
        SpeedRunConfig::classic()
    }
}

/// Explores one maze of a set and returns the record.
pub(super) fn run(set: &MazeSet, number: u32) -> Result<Fields, BoxError> {
    let (name, maze) = set.maze(number)?;
    let run = CompetitionRun {
        maze: name.clone(),
        ..CompetitionRun::default()
    };
    let run = match competition::explore(maze, &drive(set), |_, _| {}) {
        Ok(exploration) => CompetitionRun {
            certified: exploration.verdict.is_ok(),
            cells: Some(exploration.cells),
            run_ms: Some(exploration.certificate.time_ms),
            ..run
        },
        // An example is a maze whose start is open only to the sides.
        Err(ExploreError::NoWay { .. }) => run,
        Err(error) => return Err(error.into()),
    };
    Ok(run.fields()?)
}
