//! A heat map of all systems in all worlds, and what worlds cost by their size.

use tolman_draw::{Axis, Chart, Figure, HeatMap, Line, LinePoint, Series, Shade};
use tolman_experiment::{BoxError, Record, Run};

use super::records::{HomeRun, LearnRun, LocateRun, SizeRun};
use super::rows::{ALL, SIZED, SIZES, contestants, row_name, size_name};
use super::worlds::ArenaWorld;
use super::{ArenaTask, SIZE_TABLE, TABLES};

pub(super) fn of(worlds: &[ArenaWorld], runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, (table, task, _)) in TABLES.into_iter().enumerate() {
        figures.extend(heat_map(number, table, task, worlds, runs)?);
    }
    figures.extend(by_size(runs)?);
    Ok(figures)
}

fn heat_map(
    number: usize,
    table: &str,
    task: ArenaTask,
    worlds: &[ArenaWorld],
    runs: &[Run],
) -> Result<Option<Figure>, BoxError> {
    let (what, title) = match task {
        ArenaTask::Learn => ("right maps, %", "Right maps"),
        ArenaTask::Home => ("came to the goal, %", "Came to the goal"),
        ArenaTask::Locate => ("found itself, %", "Found itself"),
    };
    let names = worlds.iter().map(ArenaWorld::name).chain([ALL]);
    let names: Vec<&str> = names.collect();
    let mut values = Vec::new();
    for contestant in contestants(task) {
        let mut of_row = Vec::new();
        for world in &names {
            of_row.push(percent(runs, table, task, &row_name(contestant, world))?);
        }
        values.push(of_row);
    }
    if values.iter().flatten().all(|value| !value.is_finite()) {
        return Ok(None);
    }
    let map = HeatMap {
        across: "world".to_owned(),
        columns: names.iter().map(|name| (*name).to_owned()).collect(),
        down: "system".to_owned(),
        rows: contestants(task).map(|c| c.name().to_owned()).collect(),
        values,
        shade: Shade::new(what, 0.0, 100.0),
    };
    let drawing = map.drawing(format!(
        "{title} of each system in each family of worlds, in percent."
    ));
    let name = format!("heat-map-{}", number + 1);
    let figure = Figure::new(
        name,
        format!("{title}: every system in every kind of world"),
        drawing,
    );
    Ok(Some(
        figure
            .caption("Who abstained counts as not right.")
            .table(table),
    ))
}

/// The share of a row's runs that are right, in percent; not a number without runs.
fn percent(runs: &[Run], table: &str, task: ArenaTask, row: &str) -> Result<f64, BoxError> {
    let flags: Vec<bool> = match task {
        ArenaTask::Learn => {
            let of_row = LearnRun::of_row(runs, table, row)?;
            of_row.iter().map(|run| run.right).collect()
        }
        ArenaTask::Home => {
            let of_row = HomeRun::of_row(runs, table, row)?;
            of_row.iter().map(|run| run.success).collect()
        }
        ArenaTask::Locate => {
            let of_row = LocateRun::of_row(runs, table, row)?;
            of_row.iter().map(|run| run.right).collect()
        }
    };
    let right = flags.iter().filter(|flag| **flag).count() as f64;
    Ok(100.0 * right / flags.len() as f64)
}

fn by_size(runs: &[Run]) -> Result<Option<Figure>, BoxError> {
    let side = Axis::linear("cells a side").from_zero();
    let mut chart = Chart::new(side, Axis::log("time steps for each cell"));
    let mut has_lines = false;
    for (series, contestant) in (0..).zip(SIZED) {
        let mut points = Vec::new();
        for side in SIZES {
            let of_row =
                SizeRun::of_row(runs, SIZE_TABLE, &row_name(contestant, &size_name(side)))?;
            let steps: Vec<f64> = of_row.iter().filter_map(|run| run.steps_per_cell).collect();
            if let Ok(mean) = tolman_stats::mean(&steps) {
                points.push(LinePoint::new(f64::from(side), mean));
            }
        }
        if !points.is_empty() {
            has_lines = true;
            chart.line(Line::new(contestant.name(), Series(series), points));
        }
    }
    let drawing = chart.drawing("Time steps for each cell against the size of braided worlds.");
    let figure = Figure::new("cost", "What a world costs by its size", drawing);
    Ok(has_lines.then(|| figure.table(SIZE_TABLE)))
}
