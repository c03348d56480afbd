//! Size of the better system's map relative to the number of true places, and whether it stops
//! growing.

use super::entrant::Entrant;
use super::families::random;
use crate::metrics::UsualMetrics as _;
use crate::rows::row_of;
use tolman_arena::mslst::learn_better;
use tolman_arena::run::TaskEnd;
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record};
use tolman_systems::mslst::ROBOT_UNIT;

record! {
    /// A random maze that was learned.
    pub(super) struct MapSizeRun {
        /// Whether the robot states that it has been everywhere and knows the goal.
        finished: bool => higher("says finished"),
        /// Number of places on the map.
        nodes: u32 => neither("nodes"),
        /// Number of positions where actions ended, not counting those within a robot's diameter of
        /// another.
        true_places: u32 => neither("true places").at_least(1),
        /// Number of places over that of true places.
        nodes_over_true_places: f64 => neither("nodes / true places").at_least(0).decimals(3),
        /// Share of cells in which an action ended.
        covered_percent: f64 => higher("covered").percent().decimals(1),
        /// Number of actions until the robot had been everywhere, per robot unit of corridor.
        actions_per_unit: f64 => lower("actions / unit of corridor").at_least(0),
    }
}

/// Name of the table.
pub(super) const MAP_SIZE: &str = "map size";

/// The rows, with the duration of each as a multiple of the time that exploring takes.
const ROWS: [(&str, u32); 3] = [
    ("Better", 1),
    ("Better, twice as long", 2),
    ("Better, ten times as long", 10),
];

/// Maximum number of random mazes. Each is learned thirteen times over, so there is only one for
/// several runs.
const MOST_MAZES: u32 = 100;
const RUNS_A_MAZE: u32 = 10;

pub(super) fn table(runs: u32) -> Table {
    let mazes = (runs / RUNS_A_MAZE).clamp(1, MOST_MAZES);
    let of_ratio = MapSizeRun::nodes_over_true_places;
    Table::of::<MapSizeRun>(MAP_SIZE, "How large a map grows, in random mazes of 10 to 20 cells a side")
        .metric(Metric::mean(of_ratio))
        .metric(Metric::greatest("most_nodes_over_true_places", of_ratio).titled("highest nodes / true places"))
        .metrics([MapSizeRun::nodes, MapSizeRun::finished])
        .metrics_from(MapSizeRun::covered_percent)
        .rows(ROWS.map(|(row, _)| Row::new(row).runs(mazes)))
        .note(format!(
            "{mazes} mazes. True places are the positions where actions ended, not counting those \
             within a robot's diameter of an earlier one. After exploring, the robot wanders on like \
             Avoid."
        ))
}

/// Plays a run: learns a maze.
pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let (_, times) = row_of(job, ROWS, |(row, _)| *row == job.row)?;
    let venue = random(job)?;
    let robot = Entrant::Better.robot(&venue);
    let learned = learn_better(&venue.course, &robot, times, job.seed)?;
    let (nodes, places) = (
        learned.positions.len() as u32,
        learned.true_places.len() as u32,
    );
    let width = venue.course.corridor_width;
    let cells = venue.course.maze.grid().cell_count();
    let mut seen: Vec<(i64, i64)> = learned
        .true_places
        .iter()
        .map(|at| ((at.x / width) as i64, (at.y / width) as i64))
        .collect();
    seen.sort_unstable();
    seen.dedup();
    let units = cells as f64 * width / ROBOT_UNIT;
    let run = MapSizeRun {
        finished: learned.ended.end == TaskEnd::Done,
        nodes,
        true_places: places,
        nodes_over_true_places: f64::from(nodes) / f64::from(places.max(1)),
        covered_percent: 100.0 * seen.len() as f64 / cells as f64,
        actions_per_unit: f64::from(learned.actions) / units,
    };
    Ok(run.fields()?)
}
