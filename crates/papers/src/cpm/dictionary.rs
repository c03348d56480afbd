//! How many common patterns the robot learns: section 5, "31 clusters are obtained with 102 nodes".

use tolman_arena::cpm::{Venue, learn};
use tolman_experiment::{BoxError, Field, Fields, Job, Kind, Metric, Row, Run, Table, Tolerance};

/// The name of the table.
pub(super) const DICTIONARY: &str = "dictionary";

/// From walk to walk our clusters vary by a quarter; the paper's are those of one.
const TOLERANCE: Tolerance = Tolerance::Factor(1.5);

pub(super) fn table(learning: &Venue) -> Table {
    Table::new(DICTIONARY, "The dictionary of common patterns")
        .field("units", Kind::Count)
        .field("clusters", Kind::Count)
        .metric(Metric::mean("units").tolerance(TOLERANCE))
        .metric(Metric::mean("clusters").tolerance(TOLERANCE))
        .row(
            Row::new(&learning.name)
                .paper("units", 102.0)
                .paper("clusters", 31.0),
        )
        .note(
            "SOINN after 1000 observations; one walk through the learning maze a run. The paper's common patterns are the clusters, ours the units.",
        )
}

/// One walk through the learning maze.
pub(super) fn run(learning: &Venue, job: &Job<'_>) -> Result<Fields, BoxError> {
    let patterns = learn(&learning.maze, learning.corridor_width, job.seed)?;
    Ok(Fields::new()
        .count("units", patterns.unit_count().into())
        .count("clusters", patterns.cluster_count().into()))
}

/// What no run of this table can be.
pub(super) fn check(run: &Run) -> Result<(), BoxError> {
    let number = |name: &str| run.fields.get(name).and_then(Field::as_number);
    if number("clusters") < Some(1.0) || number("clusters") > number("units") {
        return Err("a cluster has a unit or more".into());
    }
    Ok(())
}
