//! Logs and graphs of real robots: audits of pose graphs with false closures.

mod audit;
mod false_closures;
mod gnc;
mod graph;

use serde::Serialize;
use tolman_experiment::{BoxError, Entry, Experiment, Fields, Job, Options, Procedure};
use tolman_maps::audit::AuditConfig;

pub use graph::{GraphFile, GraphFileError};

/// What the catalogue says of it.
pub(super) const ENTRY: Entry = Entry {
    name: "real",
    title: "Logs and graphs of real robots",
    source: "N. Sünderhauf, P. Protzel: Towards a Robust Back-End for Pose Graph SLAM, 2012, for the kinds of false closures",
    runs: 5,
    quick_runs: 1,
    open,
};

/// The experiment, ready to run.
#[derive(Debug)]
struct Real {
    graphs: audit::Graphs,
}

/// What the runs depend on.
#[derive(Serialize)]
struct Config {
    audit: AuditConfig,
}

/// Says which graphs are here and sets the table up.
///
/// # Errors
/// If the caller names mazes, which have no place here, or a graph that is here cannot be read.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("logs know no mazes: leave --maze out".into());
    }
    let config = toml::Table::try_from(Config {
        audit: AuditConfig::standard(),
    })?;
    let graphs = audit::Graphs::find()?;
    let tables = vec![audit::table(&graphs, options)];
    let skipped = graphs.missing();
    Ok(Experiment::new(ENTRY, tables, config, Real { graphs }).skipped(skipped))
}

impl Procedure for Real {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match job.table {
            audit::NAME => self.graphs.run(job),
            table => Err(format!("there is no table {table}").into()),
        }
    }
}
