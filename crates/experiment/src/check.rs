//! Checks that refuse tables and records.

use alloc::collections::{BTreeMap, BTreeSet};

use super::{
    BoxError, Entry, Error, Experiment, Metric, Options, Presence, Run, Statistic, Table,
    Tolerance, Within, plots, require,
};
use tolman_draw::Figure;

/// Refuses options that would run nothing, run more than fits into memory, or cannot be written to
/// `config.toml`.
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

/// Refuses tables whose rows or metrics have equal names, or refer to something that does not
/// exist.
pub(super) fn tables(experiment: &Experiment) -> Result<(), Error> {
    let sound = |tables: &[Table]| {
        distinct("tables", tables.iter().map(|table| &table.name))?;
        let has_row = tables.iter().any(|table| !table.rows.is_empty());
        require(has_row, "no table has a row")?;
        for table in tables {
            self::table(table).map_err(|what| format!("table {:?}: {what}", table.name))?;
        }
        one_tolerance(tables)?;
        figure_names(&plots::names(experiment))
    };
    sound(&experiment.tables).map_err(|what| Error::Tables {
        name: experiment.entry.name.to_owned(),
        what,
    })
}

/// Refuses a metric that has different tolerances in two tables.
fn one_tolerance(tables: &[Table]) -> Result<(), String> {
    let mut stated: BTreeMap<&str, (&str, Tolerance)> = BTreeMap::new();
    for table in tables {
        for metric in &table.metrics {
            let Some(tolerance) = metric.tolerance else {
                continue;
            };
            let (first, other) = *stated
                .entry(&metric.name)
                .or_insert((&table.name, tolerance));
            if other != tolerance {
                return Err(format!(
                    "the metric {:?} has one tolerance in table {first:?} and another in {:?}; a quantity has one",
                    metric.name, table.name
                ));
            }
        }
    }
    Ok(())
}

fn table(table: &Table) -> Result<(), String> {
    distinct("rows", table.rows.iter().map(|row| &row.name))?;
    distinct("metrics", table.metrics.iter().map(|metric| &metric.name))?;
    for row in &table.rows {
        let mut values = row.paper.iter().map(|value| &value.metric);
        let is_metric = |name: &String| table.metrics.iter().any(|metric| metric.name == *name);
        if let Some(name) = values.find(|name| !is_metric(name)) {
            let row = &row.name;
            return Err(format!(
                "row {row:?} has the paper's {name:?}, which is not a metric"
            ));
        }
    }
    let references = table.comparison.iter().map(|one| &one.reference);
    let metrics = table.metrics.iter();
    let others = metrics.filter_map(|metric| metric.statistic.other_row());
    let compared = table.pairwise.iter().flat_map(|pairwise| &pairwise.rows);
    let is_row = |name: &String| table.rows.iter().any(|row| row.name == *name);
    let mut named = references.chain(others).chain(compared);
    if let Some(name) = named.find(|name| !is_row(name)) {
        return Err(format!("it is compared with {name:?}, which is not a row"));
    }
    columns(table)?;
    for metric in &table.metrics {
        self::metric(table, metric)
            .map_err(|what| format!("the metric {:?} is {what}", metric.name))?;
    }
    Ok(())
}

fn columns(table: &Table) -> Result<(), String> {
    let columns = table.record.columns();
    distinct("fields", columns.iter().map(|column| &column.field))?;
    for column in columns {
        let field = &column.field;
        let reserved = RESERVED.contains(&field.as_str());
        require(!reserved, &format!("the field {field:?} identifies a run"))?;
        let what = format!("the range of {field:?} leaves no value");
        require(!column.is_void(), &what)?;
    }
    Ok(())
}

/// Refuses a metric by which no value can be measured or judged.
fn metric(table: &Table, metric: &Metric) -> Result<(), String> {
    let reaches = |size: f64, least: f64| size.is_finite() && size >= least;
    match metric.tolerance.map(|tolerance| tolerance.within) {
        Some(Within::Absolute(size) | Within::Relative(size)) if !reaches(size, 0.0) => {
            return Err(format!("within {size} of the paper's; give 0 or more"));
        }
        Some(Within::Factor(factor)) if !reaches(factor, 1.0) => {
            return Err(format!("within the factor {factor}; give 1 or more"));
        }
        _ => {}
    }
    let counted = !matches!(metric.statistic, Statistic::Count { whole: 0, .. });
    require(counted, "counted in 0 runs; give 1 or more")?;
    for (field, kinds) in metric.statistic.fields() {
        let column = table.record.column(field);
        if !column.is_some_and(|column| kinds.contains(&column.kind)) {
            return Err(format!(
                "of {field:?}, which is not a field of kind {kinds:?}"
            ));
        }
    }
    Ok(())
}

/// Names in `runs.jsonl` that identify a run.
pub(super) const RESERVED: [&str; 5] = ["table", "row", "run", "seed", "checksum"];

/// Refuses a run, just played or read back, that does not fit the record of its table or has an
/// impossible value.
pub(super) fn run(experiment: &Experiment, run: &Run) -> Result<(), BoxError> {
    let mut tables = experiment.tables.iter();
    let Some(table) = tables.find(|table| table.name == run.table) else {
        return Err(format!("there is no table {:?}", run.table).into());
    };
    for (name, field) in run.fields.iter() {
        let Some(column) = table.record.column(name) else {
            return Err(format!("{name:?} is not a field of the table's runs").into());
        };
        if field.kind() != column.kind {
            return Err(format!("{name} is {field:?} and not a {:?}", column.kind).into());
        }
        if let Some(what) = field
            .numbers()
            .into_iter()
            .find_map(|value| column.refusal(value))
        {
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

/// Refuses figures whose names cannot serve as file names and ids.
pub(super) fn figures(experiment: &Experiment, figures: &[Figure]) -> Result<(), Error> {
    let names: Vec<String> = figures.iter().map(|figure| figure.name.clone()).collect();
    figure_names(&names).map_err(|what| Error::Figures {
        name: experiment.entry.name.to_owned(),
        source: what.into(),
    })
}

/// Maximum length of a figure's name. File systems allow 255 bytes with the extension and the
/// suffix of a temporary file.
const LONGEST_NAME: usize = 100;

fn figure_names(names: &[String]) -> Result<(), String> {
    distinct("figures", names.iter())?;
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    let serves = |name: &String| {
        name.starts_with(|c: char| c.is_ascii_lowercase())
            && name.chars().all(plain)
            && name.len() <= LONGEST_NAME
    };
    match names.iter().find(|name| !serves(name)) {
        Some(name) => Err(format!(
            "{name:?} cannot name a figure; use lower-case letters, digits and hyphens, at most \
             {LONGEST_NAME}"
        )),
        None => Ok(()),
    }
}

fn distinct<'a>(what: &str, mut names: impl Iterator<Item = &'a String>) -> Result<(), String> {
    let mut seen = BTreeSet::new();
    match names.find(|name| !seen.insert(*name)) {
        Some(name) => Err(format!("two {what} are named {name:?}")),
        None => Ok(()),
    }
}
