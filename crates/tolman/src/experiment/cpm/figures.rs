//! Figure 9's times, figure 8's map over its maze, and the replay of a run.

use tolman_geom::Point;
use tolman_maps::cpm::Landmark;
use tolman_robot::Body;
use tolman_robot::epuck::BODY_RADIUS;

use super::venue::Venue;
use super::{BETTER, Cpm, FIGURE_9};
use crate::agents::cpm::{Record, epuck};
use crate::draw::{Axis, Chart, Figure, Line, LinePoint, Plan, Series};
use crate::experiment::{BoxError, Field, Job, Run};
use crate::replay::{Fact, Mark, Marks, Replay, Scenery, Track};

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

pub(super) fn of(experiment: &Cpm, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, venue) in (1_u32..).zip(&experiment.venues) {
        for (suffix, kind) in [("", "paper"), (BETTER, "better")] {
            let row = format!("{}{suffix}", venue.name);
            let of_row = |run: &&Run| run.table == FIGURE_9 && run.row == row;
            let runs: Vec<&Run> = runs.iter().filter(of_row).collect();
            let Some(longest) = runs.iter().max_by(|a, b| {
                let seconds = |run: &Run| number_of(run, "seconds_1").unwrap_or(0.0);
                seconds(a).total_cmp(&seconds(b))
            }) else {
                continue;
            };
            figures.push(times(&row, &format!("times-{number}-{kind}"), &runs));
            let (venue, record) = experiment.play(&longest.job())?;
            figures.push(ways(
                &venue,
                &record,
                &row,
                &format!("ways-{number}-{kind}"),
            )?);
        }
    }
    Ok(figures)
}

fn number_of(run: &Run, field: &str) -> Option<f64> {
    run.fields.get(field).and_then(Field::as_number)
}

/// The paper's figure 9, panels (a) to (c): the seconds of both episodes by trial.
fn times(row: &str, name: &str, runs: &[&Run]) -> Figure {
    let mut chart = Chart::new(Axis::linear("trial"), Axis::linear("time, s").from_zero());
    for (series, field, label) in [(0, "seconds_1", "episode 1"), (1, "seconds_2", "episode 2")] {
        let point = |run: &&Run| {
            Some(LinePoint::new(
                f64::from(run.run + 1),
                number_of(run, field)?,
            ))
        };
        let points = runs.iter().filter_map(point).take(50).collect();
        chart.line(Line::new(label, Series(series), points));
    }
    Figure::new(
        name,
        format!("{row}: time of both episodes"),
        chart.drawing(format!(
            "The seconds of the first and the second episode in {row}, by trial."
        )),
    )
    .caption("As the paper's figure 9, (a) to (c). The first fifty trials.")
    .table(FIGURE_9)
}

/// The paper's figure 8, (b) and (c): the ways of both episodes in the trial whose first took longest.
fn ways(venue: &Venue, record: &Record, row: &str, name: &str) -> Result<Figure, BoxError> {
    let world = venue.world()?;
    let walls: Vec<[Point; 2]> = world
        .walls()
        .iter()
        .map(|wall| [wall.start, wall.end])
        .collect();
    let mut plan = Plan::of_walls(&walls, WIDTH);
    let positions: Vec<Point> = record.path.iter().map(|pose| pose.position).collect();
    let (first, second) = positions.split_at(record.second_from.min(positions.len()));
    plan.faint_trajectory(first, Series(0));
    plan.trajectory(second, Series(1));
    for (landmark, cells) in [
        (
            Landmark::Start,
            venue
                .maze
                .start()
                .map(|(cell, _)| vec![cell])
                .unwrap_or_default(),
        ),
        (Landmark::Goal, venue.maze.goals().to_vec()),
    ] {
        for cell in cells {
            let word = if landmark == Landmark::Start {
                "start"
            } else {
                "goal"
            };
            plan.label(world.cell_centre(cell), word);
        }
    }
    Ok(Figure::new(
        name,
        format!("{row}: the ways of one trial"),
        plan.drawing(format!("Plan of {row} with the ways of both episodes.")),
    )
    .caption(format!(
        "The trial with the longest first episode (first colour): {} fragments walked, {} of them different, {} on the map. The second \
         colour is the second episode. As the paper's figure 8, (b) and (c).",
        record.traversals, record.true_fragments, record.fragments
    ))
    .table(FIGURE_9))
}

/// The run as the robot drove it, both episodes.
pub(super) fn replay(venue: &Venue, record: &Record, job: &Job<'_>) -> Result<Replay, BoxError> {
    let world = venue.world()?;
    let body = Body::Circle {
        radius: BODY_RADIUS,
    };
    let mut track = Track::new("e-puck", body, record.path.clone());
    if record.second.is_some() {
        track.lifts = vec![record.second_from as u32];
    }
    let mut second = Marks::new(Mark::Arrival, "second episode");
    if record.second.is_some() {
        second.steps.push(record.second_from as u32);
    }
    track.marks = vec![second];
    let step_s = epuck().step_us as f64 * 1e-6;
    let title = format!("{}, run {}", job.row, job.run);
    let mut replay = Replay::new(title, step_s, Scenery::of_world(&world), vec![track]);
    let outcome = if record.is_solved() {
        "solved"
    } else {
        "not solved"
    };
    replay.facts = vec![
        Fact::new("maze", &venue.name),
        Fact::new("seed", job.seed.to_string()),
        Fact::new("outcome", outcome),
    ];
    Ok(replay)
}
