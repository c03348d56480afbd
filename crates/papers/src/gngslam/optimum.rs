//! Table 3.1: the parameters at which the searches end.

use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};

use super::search_space::TABLE_3_1;
use super::searches::{MAPS, Searches};
use super::sets::SETS;
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "3.1";

record! {
    /// The end of a search.
    struct OptimumRun {
        /// Value of the parameter at the search's last map; no value for a weight that has no
        /// effect.
        value: Option<f64> => neither("value").at_least(0).decimals(3),
    }
}

/// Returns the table. It has as many searches as `runs` of each set complete.
pub(super) fn table(runs: u32) -> Table {
    let searches = SETS.len() as u32 * (runs / MAPS);
    let rows = TABLE_3_1.iter().map(|parameter| {
        let (low, high) = parameter.optimal;
        let row = Row::new(parameter.name).paper_aside(
            OptimumRun::value,
            0.5 * (low + high),
            format!("the paper has a range, {low} to {high}"),
        );
        row.runs(searches)
    });
    Table::of::<OptimumRun>(NAME, "Parameters at the end of the searches")
        .metrics_from(OptimumRun::value)
        .rows(rows)
        .note(format!(
            "A run is a search of {MAPS} maps, by all sets in turn. The paper's value is the middle of its optimal range."
        ))
}

/// Returns the set and the number of the search that a run uses.
pub(super) const fn search_of(job: &Job<'_>) -> (usize, u32) {
    (job.run as usize % SETS.len(), job.run / SETS.len() as u32)
}

/// Returns the value of a row's parameter at the end of a search.
pub(super) fn run(searches: &Searches, job: &Job<'_>) -> Result<Fields, BoxError> {
    let rows = TABLE_3_1.iter().enumerate();
    let (row, _) = row_of(job, rows, |(_, parameter)| parameter.name == job.row)?;
    let (set, search) = search_of(job);
    let last = searches.map(set, search * MAPS + MAPS - 1)?;
    let counts = SETS[set].with_sonar || job.row != "w_sonar";
    let value = last.parameters.get(row).copied().filter(|_| counts);
    Ok(OptimumRun { value }.fields()?)
}
