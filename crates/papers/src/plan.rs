use tolman_arena::pioneer;
use tolman_draw::{Drawing, LinePoint, PolarPlot, Series};
use tolman_stats::{ConfidenceInterval, mean, quantile};
use tolman_systems::mslst::ROBOT_UNIT;

/// Returns a scan that MSLST has learned, in robot units, as seen from the robot; `size` user units
/// wide.
pub(crate) fn model_scan(model: impl Iterator<Item = f64>, size: f64, what: String) -> Drawing {
    let ring = pioneer::ring();
    let metres: Vec<f64> = model.map(|range| range * ROBOT_UNIT).collect();
    let mut plot = PolarPlot::new(ring.max_range, size);
    plot.ranges(&ring, &metres, Series(0));
    plot.drawing(what)
}

/// Returns the mean of values as a point of a line, with their quartiles; `None` without values.
pub(crate) fn mean_with_quartiles(x: f64, values: &[f64]) -> Option<LinePoint> {
    let at = |share| quantile(values, share).ok();
    let quartiles = ConfidenceInterval::new(at(0.25)?, at(0.75)?);
    Some(LinePoint::new(x, mean(values).ok()?).spread(quartiles))
}
