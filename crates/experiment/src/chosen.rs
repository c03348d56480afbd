//! An experiment of which only some tables are filled.

use super::{BoxError, Error, Experiment, Fields, Job, Run, Table};
use tolman_draw::Figure;
use tolman_replay::Replay;

/// The rows of all tables but those chosen have no runs. All else is the experiment's own, its configuration too: runs of
/// tables that are not chosen now stay in the folder of results.
struct Chosen {
    experiment: Box<dyn Experiment>,
    tables: Vec<Table>,
}

/// The experiment with the tables of these names alone; all of them where none is named.
///
/// # Errors
/// [`Error::NoRow`] if it has no table of a name.
pub(super) fn choose(
    experiment: Box<dyn Experiment>,
    names: &[String],
) -> Result<Box<dyn Experiment>, Error> {
    if names.is_empty() {
        return Ok(experiment);
    }
    let mut tables = experiment.tables().to_vec();
    let known = |name: &&String| tables.iter().any(|table| table.name == **name);
    if let Some(name) = names.iter().find(|name| !known(name)) {
        let known: Vec<&str> = tables.iter().map(|table| table.name.as_str()).collect();
        return Err(Error::NoRow {
            what: "table",
            name: name.clone(),
            known: known.join(", "),
        });
    }
    for table in &mut tables {
        if !names.contains(&table.name) {
            for row in &mut table.rows {
                row.runs = Some(0);
            }
        }
    }
    Ok(Box::new(Chosen { experiment, tables }))
}

impl Experiment for Chosen {
    fn name(&self) -> &str {
        self.experiment.name()
    }

    fn title(&self) -> &str {
        self.experiment.title()
    }

    fn source(&self) -> &str {
        self.experiment.source()
    }

    fn default_runs(&self) -> u32 {
        self.experiment.default_runs()
    }

    fn quick_runs(&self) -> u32 {
        self.experiment.quick_runs()
    }

    fn tables(&self) -> &[Table] {
        &self.tables
    }

    fn skipped(&self) -> Option<&str> {
        self.experiment.skipped()
    }

    fn config(&self) -> Result<toml::Table, BoxError> {
        self.experiment.config()
    }

    fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        self.experiment.run(job)
    }

    /// Those of the chosen tables; figures of several tables are left out.
    fn figures(&self, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
        let mut figures = self.experiment.figures(runs)?;
        figures.retain(|figure| {
            let mut chosen = self.tables.iter().filter(|table| table.is_filled());
            chosen.any(|table| figure.table.as_ref() == Some(&table.name))
        });
        Ok(figures)
    }

    fn replay(&self, job: &Job<'_>) -> Result<Option<Replay>, BoxError> {
        self.experiment.replay(job)
    }
}
