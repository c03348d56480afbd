//! Table 1: how many states Phase I makes.

use tolman_sim::robots::LaserPioneerConfig;

use super::contest::Contest;
use tolman_arena::mslst::scans;
use tolman_experiment::{BoxError, Fields, Job, Kind, Metric, Row, Table};
use tolman_systems::mslst::{MslstConfig, States};

/// The rows of the paper: the maze, the threshold, the states.
const ROWS: [(&str, &str, f64, f64); 3] = [
    ("J 100", "J", 100.0, 16.0),
    ("Large 20", "Large", 20.0, 43.0),
    ("Large 50", "Large", 50.0, 26.0),
];

pub(super) fn table() -> Table {
    let mut table = Table::new("1", "The states of Phase I")
        .field("states", Kind::Count)
        .metric(Metric::mean("states"))
        .note(
            "Every run wanders anew. The quantizer's one parameter that no source gives was chosen on the row Large 50; \
             the others are predictions.",
        );
    for (row, .., states) in ROWS {
        table = table.row(Row::new(row).paper("states", states));
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
    Ok(Fields::new().count("states", states.models().len() as u64))
}
