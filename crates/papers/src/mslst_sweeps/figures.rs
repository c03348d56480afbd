//! One curve for each sweep: how often MSLST arrives, with the spread between maps.

use super::SweepRun;
use super::settings::Sweep;
use tolman_draw::{Axis, Chart, Figure, Line, LinePoint, Series};
use tolman_experiment::{Record, Run};
use tolman_stats::Interval;

pub(super) fn of(sweeps: &[Sweep], runs: &[Run]) -> Vec<Figure> {
    let drawn = |sweep: &Sweep| Some((sweep.axis?, curve(sweep, runs)));
    sweeps
        .iter()
        .filter_map(|sweep| {
            let (axis, points) = drawn(sweep)?;
            let mut chart = Chart::new(
                Axis::linear(axis),
                Axis::linear("MSLST arrives, %").between(0.0, 100.0),
            );
            chart.line(Line::new("", Series(0), points));
            let drawing = chart.drawing(format!("How often MSLST arrives, by {axis}."));
            let figure = Figure::new(format!("curve-{}", sweep.name), sweep.title, drawing);
            Some(
                figure
                    .caption("Mean over maps; the band holds their quartiles.")
                    .table(sweep.name),
            )
        })
        .collect()
}

fn curve(sweep: &Sweep, runs: &[Run]) -> Vec<LinePoint> {
    sweep
        .settings
        .iter()
        .filter_map(|setting| {
            let of_row = SweepRun::of_row(runs, sweep.name, &setting.row).ok()?;
            let percents: Vec<f64> = of_row.iter().map(|run| run.success_percent).collect();
            let quartiles = Interval {
                low: tolman_stats::quantile(&percents, 0.25).ok()?,
                high: tolman_stats::quantile(&percents, 0.75).ok()?,
            };
            let mean = tolman_stats::mean(&percents).ok()?;
            Some(LinePoint::new(setting.value, mean).spread(quartiles))
        })
        .collect()
}
