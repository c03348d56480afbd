//! Table 1: the number of states that Phase I learns.

use super::contest::Contest;
use crate::rows::row_of;
use crate::tolerances::PROTOTYPES;
use crate::venue::{StatesRow, TABLE_1};
use tolman_arena::mslst::scans;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_systems::mslst::{MslstConfig, States};

record! {
    /// A run of Phase I.
    struct StatesRun {
        /// Number of model scans of the equilibrium GNG.
        states: usize => neither("states").at_least(1).tolerance(PROTOTYPES),
    }
}

pub(super) fn table() -> Table {
    let row = |row: StatesRow| Row::new(row.row).paper(StatesRun::states, row.states);
    Table::of::<StatesRun>("1", "The states of Phase I")
        .metrics_from(StatesRun::states)
        .paper_runs(1)
        .rows(TABLE_1.map(row))
        .note(
            "Every run wanders again. The quantizer's one parameter that no source gives was chosen on the row Large 50; \
             the others are predictions.",
        )
}

/// Plays one run: Phase I.
pub(super) fn run(job: &Job<'_>, contests: &[Contest]) -> Result<Fields, BoxError> {
    let row = row_of(job, TABLE_1, |row| row.row == job.row)?;
    let venues = contests.iter().map(|contest| &contest.venue);
    let venue = row_of(job, venues, |venue| venue.course.name == row.maze)?;
    let steps = MslstConfig::large(row.threshold).scan_steps;
    let scans = scans(&venue.course, &venue.robot, steps, job.seed)?;
    let states = States::learn(&scans, row.threshold)?;
    let states = states.models().len();
    Ok(StatesRun { states }.fields()?)
}
