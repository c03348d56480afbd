//! Logs and graphs of real robots, and a small log of the project's own simulator. The tables show
//! the errors of ways found from logs, and audits of pose graphs with false closures.

mod audit;
mod drawing;
mod false_closures;
mod figures;
mod film;
mod gnc;
mod graph;
mod landmarks;
mod log;
mod relations;
mod small;
#[cfg(test)]
mod tests;
mod trajectories;
mod tuc;
mod utias;
mod wean;

use serde::Serialize;
use tolman_draw::Figure;
use tolman_experiment::{BoxError, Easel, Entry, Experiment, Fields, Job, Options, Procedure, Run};
use tolman_maps::audit::AuditConfig;
use tolman_maps::scan_matching::ScanMatchingConfig;
use tolman_systems::places::PlacesConfig;

use crate::data;
use crate::quantizers::sonar;

pub use drawing::{MapPicture, ros_map};
pub use graph::{GraphFile, GraphFileError};
pub use log::{FoundClosure, MappedLog, RobotLog};
pub use tolman_arena::registry::LogMapper;

/// Entry in the catalogue.
pub(super) const ENTRY: Entry = Entry {
    name: "real",
    title: "Logs and graphs of real robots",
    source: "N. Sünderhauf, P. Protzel: Towards a Robust Back-End for Pose Graph SLAM, 2012, for the kinds of false closures; R. Kümmerle et al.: On Measuring the Accuracy of \
             SLAM Algorithms, 2009, for the relations",
    runs: 5,
    quick_runs: 1,
    main: &["small log"],
    tour: &[],
    open,
};

/// The prepared experiment.
#[derive(Debug)]
struct Real {
    small: small::Small,
    relations: relations::Intel,
    graphs: audit::Graphs,
    sonar: Option<sonar::Log>,
}

/// Configuration of the runs.
#[derive(Serialize)]
struct Config {
    scan_matching: ScanMatchingConfig,
    places: PlacesConfig,
    audit: AuditConfig,
}

/// Returns the experiment with the logs and graphs that are here.
///
/// # Errors
/// If the caller names mazes, which this experiment does not use, or a log or graph cannot be read.
fn open(options: &Options) -> Result<Experiment, BoxError> {
    if !options.mazes.is_empty() {
        return Err("logs know no mazes: leave --maze out".into());
    }
    let config = toml::Table::try_from(Config {
        scan_matching: ScanMatchingConfig::indoor(),
        places: PlacesConfig::indoor(),
        audit: AuditConfig::standard(),
    })?;
    let real = Real {
        small: small::Small::read()?,
        relations: relations::Intel::default(),
        graphs: audit::Graphs::find()?,
        sonar: sonar::Log::find()?,
    };
    let mut tables = vec![
        small::table(),
        relations::table(),
        trajectories::table(),
        utias::table(),
        wean::table(),
        tuc::table(),
        audit::table(&real.graphs, options),
    ];
    tables.extend(real.sonar.is_some().then(sonar::table));
    let missing = [
        relations::missing(),
        trajectories::missing(),
        utias::missing(),
        wean::missing(),
        tuc::missing(),
        real.graphs.missing(),
        (real.sonar.is_none()).then(|| data::missing("the logs of a ring of sonars")),
    ];
    let missing: Vec<String> = missing.into_iter().flatten().collect();
    let skipped = (!missing.is_empty()).then(|| missing.join(" "));
    Ok(Experiment::new(ENTRY, tables, config, real).skipped(skipped))
}

impl Procedure for Real {
    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        match (job.table, &self.sonar) {
            (small::NAME, _) => self.small.run(job),
            (relations::NAME, _) => self.relations.run(job),
            (trajectories::NAME, _) => trajectories::run(job),
            (utias::NAME, _) => utias::run(job),
            (wean::NAME, _) => wean::run(job),
            (tuc::NAME, _) => tuc::run(job),
            (audit::NAME, _) => self.graphs.run(job),
            (sonar::NAME, Some(log)) => log.run(job),
            (table, _) => Err(format!("there is no table {table}").into()),
        }
    }

    /// Returns the name of the table, whose rows use the same log.
    fn shares(&self, job: &Job<'_>) -> Option<String> {
        Some(job.table.to_owned())
    }

    fn figures(&self, runs: &[Run], easel: &Easel<'_>) -> Result<Vec<Figure>, BoxError> {
        easel.draw("small log", small::NAME, || figures::of(self, runs))
    }
}
