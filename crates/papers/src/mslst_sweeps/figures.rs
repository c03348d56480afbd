//! A curve for each sweep: how often MSLST arrives, with the spread between maps.

use super::SweepRun;
use super::settings::Sweep;
use crate::plan::mean_with_quartiles;
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{Record, Run};

pub(super) fn of(sweeps: &[Sweep], runs: &[Run]) -> Vec<Figure> {
    let drawn = sweeps
        .iter()
        .filter_map(|sweep| Some(figure(sweep, sweep.axis?, runs)));
    drawn.collect()
}

fn figure(sweep: &Sweep, axis: &str, runs: &[Run]) -> Figure {
    let success = Axis::linear("MSLST arrives, %").between(0.0, 100.0);
    let mut chart = Chart::new(Axis::linear(axis), success);
    chart.line(Line::new("", Series(0), curve(sweep, runs)));
    let drawing = chart.drawing(format!("How often MSLST arrives, by {axis}."));
    Figure::new(format!("curve-{}", sweep.name), sweep.title, drawing)
        .caption("Mean over maps; the band holds their quartiles.")
        .table(sweep.name)
}

fn curve(sweep: &Sweep, runs: &[Run]) -> Vec<LinePoint> {
    sweep
        .settings
        .iter()
        .filter_map(|setting| {
            let of_row = SweepRun::of_row(runs, sweep.name, &setting.row).ok()?;
            let percents: Vec<f64> = of_row.iter().map(|run| run.success_percent).collect();
            mean_with_quartiles(setting.value, &percents)
        })
        .collect()
}
