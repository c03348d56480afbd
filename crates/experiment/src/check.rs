//! What is refused before or after it is used.

use alloc::collections::BTreeSet;

use super::{
    BoxError, Column, Entry, Error, Experiment, Kind, Metric, Options, Presence, Run, Settling,
    Statistic, Table, Tolerance, plots,
};
use tolman_draw::Figure;

/// Refuses options that would run nothing, more than there is room for, or could not be written down.
pub(super) fn options(options: &Options, entry: &Entry) -> Result<(), Error> {
    match options.runs_of(entry) {
        0 => return Err(Error::Zero { option: "--runs" }),
        1..=Options::MOST_RUNS => {}
        runs => {
            return Err(Error::TooManyRuns {
                runs,
                most: Options::MOST_RUNS,
            });
        }
    }
    if options.jobs == Some(0) {
        return Err(Error::Zero { option: "--jobs" });
    }
    if i64::try_from(options.seed).is_err() {
        return Err(Error::Seed { seed: options.seed });
    }
    Ok(())
}

/// Refuses tables whose rows or metrics could not be told apart or refer to what is not there.
pub(super) fn tables(experiment: &Experiment) -> Result<(), Error> {
    let refuse = |what: String| {
        Err(Error::Tables {
            name: experiment.entry.name.to_owned(),
            what,
        })
    };
    let tables = &experiment.tables;
    if let Some(name) = repeated(tables.iter().map(|table| &table.name)) {
        return refuse(format!("two tables are named {name:?}"));
    }
    if tables.iter().all(|table| table.rows.is_empty()) {
        return refuse("no table has a row".to_owned());
    }
    for table in tables {
        let place = format!("table {:?}", table.name);
        if let Some(name) = repeated(table.rows.iter().map(|row| &row.name)) {
            return refuse(format!("{place} has two rows named {name:?}"));
        }
        if let Some(name) = repeated(table.metrics.iter().map(|metric| &metric.name)) {
            return refuse(format!("{place} has two metrics named {name:?}"));
        }
        for row in &table.rows {
            let mut values = row.paper.iter();
            let stray = values.find(|value| {
                !table
                    .metrics
                    .iter()
                    .any(|metric| metric.name == value.metric)
            });
            if let Some(value) = stray {
                return refuse(format!(
                    "{place}, row {:?} has the paper's {:?}, which is no metric",
                    row.name, value.metric
                ));
            }
        }
        if let Some(comparison) = &table.comparison
            && !table
                .rows
                .iter()
                .any(|row| row.name == comparison.reference)
        {
            let reference = &comparison.reference;
            return refuse(format!(
                "{place} is compared with {reference:?}, which is no row"
            ));
        }
        let others = table
            .metrics
            .iter()
            .filter_map(|metric| match &metric.statistic {
                Statistic::Multiple { of, .. } | Statistic::Settling(Settling { of, .. }) => {
                    Some(of)
                }
                _ => None,
            });
        let compared = table.pairwise.iter().flat_map(|pairwise| &pairwise.rows);
        let is_row = |name: &&String| table.rows.iter().any(|row| row.name == **name);
        if let Some(name) = others.chain(compared).find(|name| !is_row(name)) {
            return refuse(format!(
                "{place} is compared with {name:?}, which is no row"
            ));
        }
        if let Some(what) = columns(table) {
            return refuse(format!("{place}: {what}"));
        }
        for metric in &table.metrics {
            if let Some(what) = unsound(metric) {
                return refuse(format!("{place} has the metric {:?} {what}", metric.name));
            }
            if let Statistic::Settling(Settling { curve, .. }) = &metric.statistic {
                let column = table.record.column(curve);
                if column.is_none_or(|column| column.kind != Kind::Curve) {
                    return refuse(format!(
                        "{place} has the metric {:?} of {curve:?}, which is no curve",
                        metric.name
                    ));
                }
            }
            let (fields, kinds): (&[&String], &[Kind]) = match &metric.statistic {
                Statistic::Percent { field } | Statistic::Count { field, .. } => {
                    (&[field], &[Kind::Flag])
                }
                Statistic::Mean { field }
                | Statistic::Median { field }
                | Statistic::Least { field } => (&[field], NUMERIC),
                Statistic::Ratio { over, under } => (&[over, under], NUMERIC),
                Statistic::Multiple { field, .. } => (&[field], NUMERIC),
                Statistic::Settling(Settling { level, scale, .. }) => (&[level, scale], NUMERIC),
            };
            let measured = |name: &String| {
                let column = table.record.column(name);
                column.is_some_and(|column| kinds.contains(&column.kind))
            };
            if let Some(name) = fields.iter().find(|name| !measured(name)) {
                return refuse(format!(
                    "{place} has the metric {:?} of {name:?}, which is no field of kind {kinds:?}",
                    metric.name
                ));
            }
        }
    }
    if let Err(what) = figure_names(&plots::names(experiment)) {
        return refuse(what);
    }
    Ok(())
}

/// Says what is wrong with the columns of a table; `None` if nothing is.
fn columns(table: &Table) -> Option<String> {
    let columns = table.record.columns();
    if let Some(name) = repeated(columns.iter().map(|column| &column.field)) {
        return Some(format!("two fields are named {name:?}"));
    }
    let reserved = |column: &&Column| RESERVED.contains(&column.field.as_str());
    if let Some(Column { field, .. }) = columns.iter().find(reserved) {
        return Some(format!("the field {field:?} identifies a run"));
    }
    if let Some(Column { field, .. }) = columns.iter().find(|column| column.is_void()) {
        return Some(format!("the range of {field:?} leaves no value"));
    }
    table.record.compare().err().map(|error| error.to_string())
}

/// What no value can be measured or judged by.
fn unsound(metric: &Metric) -> Option<String> {
    let reaches = |size: f64, least: f64| size.is_finite() && size >= least;
    match metric.tolerance {
        Some(Tolerance::Absolute(size) | Tolerance::Relative(size)) if !reaches(size, 0.0) => {
            return Some(format!("within {size} of the paper's; give 0 or more"));
        }
        Some(Tolerance::Factor(factor)) if !reaches(factor, 1.0) => {
            return Some(format!("within the factor {factor}; give 1 or more"));
        }
        _ => {}
    }
    matches!(metric.statistic, Statistic::Count { whole: 0, .. })
        .then(|| "counted in 0 runs; give 1 or more".to_owned())
}

/// The names of a run's own parts in `runs.jsonl`.
pub(super) const RESERVED: [&str; 4] = ["table", "row", "run", "seed"];

const NUMERIC: &[Kind] = &[Kind::Count, Kind::Number];

/// Refuses a run, just played or read back, that is no record of its table or has a value that none can
/// have.
pub(super) fn run(experiment: &Experiment, run: &Run) -> Result<(), BoxError> {
    let mut tables = experiment.tables.iter();
    let Some(table) = tables.find(|table| table.name == run.table) else {
        return Err(format!("there is no table {:?}", run.table).into());
    };
    for (name, field) in run.fields.iter() {
        let Some(column) = table.record.column(name) else {
            return Err(format!("{name:?} is no field of the table's runs").into());
        };
        if field.kind() != column.kind {
            return Err(format!("{name} is {field:?} and not a {:?}", column.kind).into());
        }
        if let Some(what) = field.numbers().find_map(|value| column.refusal(value)) {
            return Err(what.into());
        }
    }
    let mut needed = table.record.columns().iter();
    let lacking = needed.find(|column| {
        column.presence == Presence::Always && run.fields.get(&column.field).is_none()
    });
    match lacking {
        Some(column) => Err(format!("it has no field {:?}", column.field).into()),
        None => table.record.check(&run.fields),
    }
}

/// Refuses figures whose names do not serve as file names and ids.
pub(super) fn figures(experiment: &Experiment, figures: &[Figure]) -> Result<(), Error> {
    let names: Vec<String> = figures.iter().map(|figure| figure.name.clone()).collect();
    figure_names(&names).map_err(|what| Error::Figures {
        name: experiment.entry.name.to_owned(),
        source: what.into(),
    })
}

/// The longest name of a figure: file systems allow 255 bytes with the extension and what a temporary
/// file adds, and nobody reads as many.
const LONGEST_NAME: usize = 100;

fn figure_names(names: &[String]) -> Result<(), String> {
    if let Some(name) = repeated(names.iter()) {
        return Err(format!("two figures are named {name:?}"));
    }
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    let serves = |name: &String| {
        name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(plain)
            && name.len() <= LONGEST_NAME
    };
    match names.iter().find(|name| !serves(name)) {
        Some(name) => Err(format!(
            "{name:?} is no name of a figure; use lower-case letters, digits and hyphens, at most \
             {LONGEST_NAME}"
        )),
        None => Ok(()),
    }
}

fn repeated<'a>(mut names: impl Iterator<Item = &'a String>) -> Option<&'a String> {
    let mut seen = BTreeSet::new();
    names.find(|name| !seen.insert(*name))
}
