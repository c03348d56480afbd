//! The competition model: sets of mazes explored for the speed run. Of it the paper says nothing.

use tolman_maze::Maze;
use tolman_planners::speed_run::SpeedRunConfig;

use super::sets::MazeSet;
use tolman_arena::competition;
use tolman_experiment::{BoxError, Field, Fields, Kind, Metric, Row, Run, Table};
use tolman_systems::micromouse::competition::ExploreError;

/// The name of the table.
pub(super) const COMPETITION: &str = "competition";

/// A run is a maze of the set.
pub(super) fn table<'a>(sets: impl IntoIterator<Item = &'a MazeSet>) -> Table {
    let mut table = Table::new(COMPETITION, "Explorations for the speed run")
        .field("maze", Kind::Text)
        .field("certified", Kind::Flag)
        .optional_field("cells", Kind::Count)
        .optional_field("run_ms", Kind::Count)
        .metric(Metric::percent("certified_percent", "certified"))
        .metric(Metric::mean("cells"))
        .metric(Metric::mean("run_ms").titled("speed run").unit("ms"))
        .note(
            "One run a maze. Cells are all that the mouse drives from the start until it is back there with a speed \
             run that is certified to be the fastest; it has been at a goal then. Sets with mazes of more than 16 cells \
             a side are driven as half-size ones, all others as classic ones.",
        );
    for set in sets {
        let mazes = u32::try_from(set.mazes.len()).unwrap_or(u32::MAX);
        table = table.row(Row::new(&set.name).runs(mazes));
    }
    table
}

/// How the mouse drives in the mazes of a set.
fn drive(set: &MazeSet) -> SpeedRunConfig {
    let larger = |maze: &Maze| maze.grid().width().max(maze.grid().height()) > 16;
    if set.mazes.iter().any(|(_, maze)| larger(maze)) {
        SpeedRunConfig::half_size()
    } else {
        SpeedRunConfig::classic()
    }
}

/// Explores one maze of a set.
pub(super) fn run(set: &MazeSet, number: usize) -> Result<Fields, BoxError> {
    let (name, maze) = set.mazes.get(number).ok_or("there is no such run")?;
    let fields = Fields::new().text("maze", name);
    Ok(match competition::explore(maze, &drive(set)) {
        Ok(exploration) => fields
            .flag("certified", exploration.verdict.is_ok())
            .count("cells", exploration.cells.into())
            .count("run_ms", exploration.certificate.time_ms.into()),
        // Such as a start that is open to the sides only.
        Err(ExploreError::NoWay { .. }) => fields.flag("certified", false),
        Err(error) => return Err(error.into()),
    })
}

/// What no run of this table can be.
pub(super) fn check(set: &MazeSet, run: &Run) -> Result<(), BoxError> {
    let (name, maze) = set
        .mazes
        .get(run.run as usize)
        .ok_or("there is no such run")?;
    if run.fields.get("maze").and_then(Field::as_text) != Some(name) {
        return Err(format!("run {} is of {name}", run.run).into());
    }
    let start = maze.start().map(|(cell, _)| maze.grid().index(cell));
    let steps = maze.steps_to_goal();
    let way = start.and_then(|start| steps.get(start).copied().flatten());
    let cells = run.fields.get("cells").and_then(Field::as_number);
    let certified = run.fields.get("certified").and_then(Field::as_flag);
    match (cells, way) {
        (Some(cells), Some(way)) if cells >= 2.0 * f64::from(way) => Ok(()),
        (None, _) if certified == Some(false) => Ok(()),
        _ => Err("the mouse cannot have been at a goal and back in so few cells".into()),
    }
}
