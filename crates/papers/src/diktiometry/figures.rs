//! Errors by moves, like the paper's figures 3(b) and 3(c), and learned maps over their worlds,
//! like figures 3(a) and 4.

use super::SurveyRun;
use super::settings::{Setting, Subject, Trial};
use crate::plan::mean_with_quartiles;
use tolman_arena::diktiometry::{Survey, WINDOW};
use tolman_arena::drawing::diktiometry::{map_over_world, place_marks};
use tolman_draw::{Axis, Chart, Figure, Line, Series};
use tolman_experiment::{BoxError, Easel, Record, Run};

/// Width of a chart, user units.
const WIDTH: f64 = 560.0;
/// Maximum number of rows for which a table gets curves; more would be hard to tell apart.
const MOST_CURVES: usize = 5;

pub(super) fn of(
    trials: &[Trial],
    runs: &[Run],
    easel: &Easel<'_>,
) -> Result<Vec<Figure>, BoxError> {
    let mut figures = Vec::new();
    for trial in trials {
        if trial.settings.len() > MOST_CURVES {
            continue;
        }
        figures.push(errors(trial, runs)?);
        let maps = trial.settings.iter().enumerate();
        for (number, setting) in maps.filter(|(_, setting)| setting.subject == Subject::Map) {
            let first = |run: &&Run| run.is_of(trial.name, setting.row) && run.run == 0;
            if let Some(run) = runs.iter().find(first) {
                let name = format!("{} in {}", setting.row, trial.name);
                figures.extend(easel.draw(&name, trial.name, || {
                    Ok([map(trial, setting, run, number)?])
                })?);
            }
        }
    }
    Ok(figures)
}

fn errors(trial: &Trial, runs: &[Run]) -> Result<Figure, BoxError> {
    let mut chart = Chart::new(
        Axis::linear("moves").from_zero(),
        Axis::linear("squared error per move, m²").from_zero(),
    )
    .sized(WIDTH, 340.0);
    for (series, setting) in (0..).map(Series).zip(&trial.settings) {
        let of_row = SurveyRun::of_row(runs, trial.name, setting.row)?;
        let curves: Vec<Vec<f64>> = of_row.into_iter().map(|run| run.curve).collect();
        let windows = curves.iter().map(Vec::len).max().unwrap_or(0);
        let points = (0..windows).filter_map(|window| {
            let values = curves.iter().filter_map(|curve| curve.get(window));
            let values: Vec<f64> = values.copied().collect();
            let moves = (window as f64 + 0.5) * WINDOW as f64;
            mean_with_quartiles(moves, &values)
        });
        chart.line(Line::new(setting.row, series, points.collect()));
    }
    let drawing = chart.drawing(format!(
        "{}: the error of each row against moves.",
        trial.title
    ));
    let figure = Figure::new(format!("error-{}", slug(trial)), trial.title, drawing);
    let caption =
        format!("Mean over runs of the mean over {WINDOW} moves; the bands hold the quartiles.");
    Ok(figure.caption(caption).table(trial.name))
}

/// Returns a table's name in a form for file names.
fn slug(trial: &Trial) -> String {
    trial.name.replace(' ', "-")
}

/// Returns the map of a run, drawn from the robot's true start.
fn map(trial: &Trial, setting: &Setting, run: &Run, number: usize) -> Result<Figure, BoxError> {
    let survey = Survey::run(&setting.office, setting.config.clone(), run.seed, |_, _| {
        Ok(())
    })?;
    let score = survey.score();
    let observer = survey.observer().ok_or("no map is kept")?;
    let marks = place_marks(observer, survey.path()[0].position);
    let drawing = map_over_world(&setting.office.course.world, observer, &marks);
    Ok(Figure::new(
        format!("map-{}-{number}", slug(trial)),
        format!("{}: the map of run 0", setting.row),
        drawing,
    )
    .caption(format!(
        "Its {} places with the boxes that contain them, as seen from where the robot began, and the \
         links, over the world. The robot visited {} true places. Boxes grow with the distance from \
         the start, because each frame knows only its neighbours. Relative to those they are small.",
        score.places, score.visited
    ))
    .table(trial.name))
}
