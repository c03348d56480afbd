//! Figure 9's times; and figure 8: the map by itself and over its maze, with the ways of both
//! episodes.

use tolman_geom::Point;

use super::Cpm;
use super::trials::{BETTER, FIGURE_9, TrialRun};
use tolman_arena::course::Course;
use tolman_arena::cpm::TrialRecord;
use tolman_arena::drawing::cpm as drawing;
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{BoxError, Easel, FieldsError, Run};

pub(super) fn of(
    experiment: &Cpm,
    runs: &[Run],
    easel: &Easel<'_>,
) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for (number, course) in (1_u32..).zip(&experiment.courses) {
        for (suffix, kind) in [("", "paper"), (BETTER, "better")] {
            let row = format!("{}{suffix}", course.name);
            let of_row = |run: &&Run| run.is_of(FIGURE_9, &row);
            let runs = runs.iter().filter(of_row);
            let runs = runs.map(|run| Ok((run, run.record()?)));
            let runs: Vec<(&Run, TrialRun)> = runs.collect::<Result<_, FieldsError>>()?;
            let Some(longest) = longest(&runs) else {
                continue;
            };
            figures.push(times(&row, &format!("times-{number}-{kind}"), &runs));
            figures.extend(easel.draw(&row, FIGURE_9, || {
                let Some((course, record)) = experiment.play(&longest.job())? else {
                    return Ok(Vec::new());
                };
                let name = format!("{number}-{kind}");
                let mut drawn = vec![ways(&course, &record, &row, &format!("ways-{name}"))];
                drawn.extend(maps(&course, &record, &row, &name));
                Ok(drawn)
            })?);
        }
    }
    Ok(figures)
}

/// Returns the run with the longest first episode among those that were solved, or else among all.
fn longest<'a>(runs: &[(&'a Run, TrialRun)]) -> Option<&'a Run> {
    let key = |trial: &TrialRun| (trial.solved, trial.seconds_1.unwrap_or(0.0));
    let order = |(_, a): &&(&Run, TrialRun), (_, b): &&(&Run, TrialRun)| {
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    runs.iter().max_by(order).map(|(run, _)| *run)
}

/// Returns the paper's figure 9, panels (a) to (c): the duration of both episodes by trial.
fn times(row: &str, name: &str, runs: &[(&Run, TrialRun)]) -> Figure {
    let mut chart = Chart::new(
        Axis::linear("trial").whole_numbers(),
        Axis::linear("time, s").from_zero(),
    );
    let seconds: [fn(&TrialRun) -> Option<f64>; 2] =
        [|trial| trial.seconds_1, |trial| trial.seconds_2];
    for ((series, label), seconds) in (0..).zip(["episode 1", "episode 2"]).zip(seconds) {
        let point = |(run, trial): &(&Run, TrialRun)| {
            Some(LinePoint::new(f64::from(run.run + 1), seconds(trial)?))
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

/// Returns the paper's figure 8, (b) and (c): the ways of both episodes in the trial with the
/// longest first episode.
fn ways(course: &Course, record: &TrialRecord, row: &str, name: &str) -> Figure {
    let mut plan = drawing::plan_of(course);
    let positions: Vec<Point> = record.path.iter().map(|pose| pose.position).collect();
    let (first, second) = positions.split_at(record.second_from.min(positions.len()));
    plan.faint_trajectory(first, Series(0));
    plan.trajectory(second, Series(1));
    let start = course.maze.start().map(|(cell, _)| (cell, "start"));
    let goals = course.maze.goals().iter().map(|cell| (*cell, "goal"));
    for (cell, word) in start.into_iter().chain(goals) {
        plan.label(course.world.cell_centre(cell), word);
    }
    Figure::new(
        name,
        format!("{row}: the ways of one trial"),
        plan.drawing(format!("Plan of {row} with the ways of both episodes.")),
    )
    .caption(format!(
        "The solved trial with the longest first episode (first colour): {} fragments walked, {} of them different, {} on the map. The second \
         colour is the second episode. As the paper's figure 8, (b) and (c).",
        record.traversals,
        record.true_fragments,
        record.map.fragments().len()
    ))
    .table(FIGURE_9)
}

/// Returns the paper's figure 8 (a): the map at the end of the first episode, over the maze and by
/// itself.
fn maps(course: &Course, record: &TrialRecord, row: &str, name: &str) -> [Figure; 2] {
    let over = drawing::over_maze(&record.map, course);
    let graph = drawing::graph(&record.map, course);
    [
        Figure::new(format!("map-{name}"), format!("{row}: the map over its maze"), over)
            .caption(
                "The map at the end of that trial's first episode, laid over the maze port by port. \
                 Each fragment A has its ends − and +. Junctions are squares, and unexplored ends \
                 are rings. A dashed fragment leads elsewhere on the map than in the maze.",
            )
            .table(FIGURE_9),
        Figure::new(format!("graph-{name}"), format!("{row}: the map"), graph)
            .caption(
                "The same map as a graph, like the paper's figures 5 (b) and 8 (a). Fragment nodes \
                 are discs with their length in observations, junction nodes are squares. Each edge \
                 has the fragment's end and the junction's port. The turn Δ from one fragment into \
                 another is the number of ports between them, counter-clockwise. Point at a node for \
                 its patterns and transitions.",
            )
            .table(FIGURE_9),
    ]
}
