//! Number of common patterns that the robot learns (section 5: "31 clusters are obtained with 102
//! nodes").

use crate::tolerances::PROTOTYPES;
use tolman_arena::course::Course;
use tolman_arena::cpm::learn;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record, require};
use tolman_systems::cpm::CommonPatterns;

/// Name of the table.
pub(super) const DICTIONARY: &str = "dictionary";

record! {
    /// Patterns learned on a walk through the learning maze.
    #[check(DictionaryRun::relations)]
    pub(super) struct DictionaryRun {
        /// Number of SOINN's units, each one of our common patterns.
        units: u32 => neither("units").tolerance(PROTOTYPES),
        /// Number of SOINN's clusters, each a common pattern in the paper.
        clusters: u32 => neither("clusters").at_least(1).tolerance(PROTOTYPES),
    }
}

impl DictionaryRun {
    pub(super) fn of(patterns: &CommonPatterns) -> Self {
        Self {
            units: patterns.unit_count,
            clusters: patterns.cluster_count,
        }
    }

    fn relations(&self) -> Result<(), String> {
        require(self.clusters <= self.units, "a cluster has a unit or more")
    }
}

pub(super) fn table(learning: &Course) -> Table {
    Table::of::<DictionaryRun>(DICTIONARY, "The dictionary of common patterns")
        .metrics_from(DictionaryRun::units)
        .paper_runs(1)
        .row(
            Row::new(&learning.name)
                .paper(DictionaryRun::units, 102.0)
                .paper(DictionaryRun::clusters, 31.0),
        )
        .note(
            "SOINN after 1000 observations; one walk through the learning maze a run. The paper's common patterns are the clusters, ours the units.",
        )
}

/// Plays one run: a walk through the learning maze.
pub(super) fn run(learning: &Course, job: &Job<'_>) -> Result<Fields, BoxError> {
    let patterns = learn(learning, job.seed)?;
    Ok(DictionaryRun::of(&patterns).fields()?)
}
