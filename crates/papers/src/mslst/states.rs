//! Table 1: how many states Phase I makes.

use tolman_sim::robots::LaserPioneerConfig;

use super::contest::Contest;
use tolman_arena::mslst::scans;
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record};
use tolman_systems::mslst::{MslstConfig, States};

/// The rows of the paper: the maze, the threshold, the states.
const ROWS: [(&str, &str, f64, f64); 3] = [
    ("J 100", "J", 100.0, 16.0),
    ("Large 20", "Large", 20.0, 43.0),
    ("Large 50", "Large", 50.0, 26.0),
];

record! {
    /// A run of Phase I.
    struct StatesRun {
        /// Model scans of the equilibrium GNG.
        states: usize => neither("states").at_least(1),
    }
}

pub(super) fn table() -> Table {
    let mut table = Table::of::<StatesRun>("1", "The states of Phase I")
        .metric(Metric::mean(StatesRun::states))
        .note(
            "Every run wanders anew. The quantizer's one parameter that no source gives was chosen on the row Large 50; \
             the others are predictions.",
        );
    for (row, .., states) in ROWS {
        table = table.row(Row::new(row).paper(StatesRun::states, states));
    }
    table
}

/// One run: Phase I.
pub(super) fn run(
    job: &Job<'_>,
    contests: &[Contest],
    robot: &LaserPioneerConfig,
) -> Result<Fields, BoxError> {
    let Some((_, maze, threshold, _)) = ROWS.iter().find(|row| row.0 == job.row) else {
        return Err(format!("table 1 has no row {:?}", job.row).into());
    };
    let mut contests = contests.iter();
    let Some(contest) = contests.find(|contest| contest.venue.course.name == *maze) else {
        return Err(format!("there is no maze {maze}").into());
    };
    let steps = MslstConfig::large(*threshold).scan_steps;
    let scans = scans(&contest.venue.course, robot, steps, job.seed)?;
    let states = States::learn(&scans, *threshold)?;
    let states = states.models().len();
    Ok(StatesRun { states }.fields()?)
}
