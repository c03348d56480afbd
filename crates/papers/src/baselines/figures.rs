//! The robots' ways, for each maze and brain, with the median run on top.

use tolman_geom::Point;

use super::{Baselines, MazeRun, ROWS, Venue};
use tolman_arena::cast::Agent;
use tolman_draw::{Figure, Series};
use tolman_experiment::{BoxError, Easel, Run};

/// Maximum number of runs on one plan.
const SHOWN: usize = 25;

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

pub(super) fn of(
    experiment: &Baselines,
    runs: &[Run],
    easel: &Easel<'_>,
) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, venue) in (1_u32..).zip(&experiment.venues) {
        for (series, row) in (0_u32..).zip(ROWS.map(Agent::name)) {
            let of_row = runs.iter().filter(|run| run.is_of(&venue.table, row));
            let of_row: Vec<&Run> = of_row.collect();
            if let Some(middle) = middle(&of_row)? {
                let name = format!("plan-{number}-{}", series + 1);
                let series = Series(series);
                figures.extend(easel.draw(&name, &venue.table, || {
                    Ok([plan(experiment, venue, &name, &of_row, middle, series)?])
                })?);
            }
        }
    }
    Ok(figures)
}

/// Returns the run with the median number of steps.
fn middle<'a>(runs: &[&'a Run]) -> Result<Option<&'a Run>, BoxError> {
    let steps = |run: &&'a Run| Ok((run.record::<MazeRun>()?.steps, *run));
    let mut sorted = runs
        .iter()
        .map(steps)
        .collect::<Result<Vec<_>, BoxError>>()?;
    sorted.sort_by_key(|(steps, run)| (*steps, run.run));
    Ok(sorted.get(sorted.len() / 2).map(|(_, run)| *run))
}

fn plan(
    experiment: &Baselines,
    venue: &Venue,
    name: &str,
    runs: &[&Run],
    middle: &Run,
    series: Series,
) -> Result<Figure, BoxError> {
    let mut plan = tolman_arena::drawing::plan_of_course(&venue.course, WIDTH);
    for run in runs.iter().take(SHOWN).filter(|run| run.run != middle.run) {
        plan.faint_trajectory(&way(experiment, run)?, series);
    }
    plan.trajectory(&way(experiment, middle)?, series);
    let row = &middle.row;
    let MazeRun { steps, .. } = middle.record()?;
    let shown = runs.len().min(SHOWN);
    let description = format!(
        "Plan of {}: the ways of {shown} runs of {row}.",
        venue.title
    );
    Ok(Figure::new(name, format!("{row} in {}", venue.course.name), plan.drawing(description))
        .caption(format!(
            "Run {} ({steps} steps, the median) from ring to dot, over {shown} runs. The destination is shaded.",
            middle.run
        ))
        .table(&venue.table))
}

fn way(experiment: &Baselines, run: &Run) -> Result<Vec<Point>, BoxError> {
    let episode = experiment.episode(&run.job())?;
    Ok(episode.map_or_else(Vec::new, |episode| {
        episode.path.iter().map(|pose| pose.position).collect()
    }))
}
