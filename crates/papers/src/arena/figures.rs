//! A heat map of all systems in all worlds, and the cost of learning by the size of the world.

use tolman_draw::{Axis, Chart, Figure, Hatching, HeatMap, Line, LinePoint, Series, Shade};
use tolman_experiment::{BoxError, Record, Run};

use super::records::{HomeRun, LearnRun, LocateRun, SizeRun};
use super::rows::{ALL, SIZES, contestants, row_name, size_name, sized};
use super::worlds::ArenaWorld;
use super::{ArenaTask, SIZE_TABLE, TABLES};

pub(super) fn of(worlds: &[ArenaWorld], runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, (table, task, _)) in TABLES.into_iter().enumerate() {
        figures.extend(heat_map(number, table, task, worlds, runs)?);
    }
    figures.extend(by_size(runs)?);
    figures.extend(super::errands::figures(runs)?);
    Ok(figures)
}

fn heat_map(
    number: usize,
    table: &str,
    task: ArenaTask,
    worlds: &[ArenaWorld],
    runs: &[Run],
) -> Result<Option<Figure>, BoxError> {
    let (what, title, hatched) = match task {
        ArenaTask::Learn => ("right maps, %", "Right maps", "abstained"),
        ArenaTask::Home => ("came to the goal, %", "Came to the goal", "abstained"),
        ArenaTask::Locate => ("found itself, %", "Found itself", "did not say"),
    };
    let names = worlds.iter().map(ArenaWorld::name).chain([ALL]);
    let names: Vec<&str> = names.collect();
    let (mut systems, mut values, mut abstained) = (Vec::new(), Vec::new(), Vec::new());
    for contestant in contestants(task) {
        let rows = names.iter().map(|world| row_name(contestant, world));
        let ends = rows.map(|row| ends(runs, table, task, &row));
        let ends: Vec<Vec<End>> = ends.collect::<Result<_, _>>()?;
        if ends.iter().all(Vec::is_empty) {
            continue;
        }
        systems.push(contestant.title().to_owned());
        values.push(
            ends.iter()
                .map(|of| 100.0 * share(of, End::Right))
                .collect(),
        );
        let shares = ends.iter().map(|of| share(of, End::Abstained));
        abstained.push(shares.collect());
    }
    if systems.is_empty() {
        return Ok(None);
    }
    let map = HeatMap {
        across: "world".to_owned(),
        columns: names.iter().map(|name| (*name).to_owned()).collect(),
        down: "system".to_owned(),
        rows: systems,
        values,
        shade: Shade::new(what, 0.0, 100.0),
        hatching: Some(Hatching {
            title: hatched.to_owned(),
            shares: abstained,
        }),
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
    let caption = format!(
        "Percent of all runs of a row. Hatched is the share that {hatched}, a dash where all did; 0 is tried and failed; an empty cell was not tried."
    );
    Ok(Some(figure.caption(caption).table(table)))
}

/// End of a run, as a heat map shows it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Right,
    Wrong,
    Abstained,
}

impl End {
    const fn of(is_right: bool, has_abstained: bool) -> Self {
        match (is_right, has_abstained) {
            (true, _) => Self::Right,
            (false, true) => Self::Abstained,
            (false, false) => Self::Wrong,
        }
    }
}

/// Returns the end of each run of a row.
fn ends(runs: &[Run], table: &str, task: ArenaTask, row: &str) -> Result<Vec<End>, BoxError> {
    Ok(match task {
        ArenaTask::Learn => {
            let of_row = LearnRun::of_row(runs, table, row)?.into_iter();
            of_row
                .map(|run| End::of(run.right, run.abstained))
                .collect()
        }
        ArenaTask::Home => {
            let of_row = HomeRun::of_row(runs, table, row)?.into_iter();
            of_row
                .map(|run| End::of(run.success, run.abstained))
                .collect()
        }
        ArenaTask::Locate => {
            let of_row = LocateRun::of_row(runs, table, row)?.into_iter();
            of_row
                .map(|run| End::of(run.right, run.abstained))
                .collect()
        }
    })
}

/// Returns the share of runs with this end; NaN without runs.
fn share(ends: &[End], end: End) -> f64 {
    let count = ends.iter().filter(|one| **one == end).count();
    count as f64 / ends.len() as f64
}

fn by_size(runs: &[Run]) -> Result<Option<Figure>, BoxError> {
    let side = Axis::linear("cells a side").from_zero();
    let mut chart = Chart::new(side, Axis::log("time steps for each cell"));
    let mut has_lines = false;
    for (series, contestant) in (0..).zip(sized()) {
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
            chart.line(Line::new(contestant.title(), Series(series), points));
        }
    }
    let drawing = chart.drawing("Time steps for each cell against the size of braided worlds.");
    let figure = Figure::new("cost", "What a world costs by its size", drawing);
    Ok(has_lines.then(|| figure.table(SIZE_TABLE)))
}
