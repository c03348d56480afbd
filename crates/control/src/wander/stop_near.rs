use tolman_robot::Soundings;

use super::{LegEnd, LegStep, NearLimits, RunningMean};

/// The layer that stops before near things: "near collision" is where the running mean of a sensor
/// falls below its threshold (section 3.2).
#[derive(Clone, Debug)]
pub struct StopNear {
    limits: NearLimits,
    /// Factor of all thresholds, 0 to 1; below 1 to get out of a narrow place.
    give_way: f64,
    mean: RunningMean,
}

impl StopNear {
    /// Returns a layer without readings.
    #[must_use]
    pub fn new(limits: NearLimits) -> Self {
        Self {
            limits,
            give_way: 1.0,
            mean: RunningMean::default(),
        }
    }

    /// Multiplies all thresholds by `share`, 0 … 1, from now on; 1 for the thresholds themselves.
    pub const fn give_way(&mut self, share: f64) {
        self.give_way = share;
    }

    /// Changes the limits from now on.
    pub const fn limit(&mut self, limits: NearLimits) {
        self.limits = limits;
    }

    /// Takes in the readings of a time step without driving: while turning.
    pub fn take_in(&mut self, sensing: &impl Soundings) {
        self.mean.take_in(sensing);
    }

    /// Returns whether nothing is nearer than `margin` times its threshold.
    #[must_use]
    pub fn is_clear(&self, margin: f64) -> bool {
        let factor = margin * self.give_way;
        let mut means = self.mean.means();
        // No reading exceeds a sensor's maximum.
        means.all(|mean| {
            let threshold = factor * self.limits.threshold(&mean);
            mean.range >= threshold.min(mean.max_range)
        })
    }

    /// Corrects the proposal of the layer above for this time step.
    pub fn correct(&mut self, proposal: LegStep, sensing: &impl Soundings) -> LegStep {
        self.take_in(sensing);
        if self.is_clear(1.0) {
            proposal
        } else {
            LegStep::end(LegEnd::Near)
        }
    }
}

#[cfg(test)]
mod tests {
    use tolman_robot::pioneer_2dx::{Pioneer2dxSensing, SONARS};

    use super::*;
    use crate::wander::GoAhead;

    fn reading(sonar: usize, range: f64) -> Pioneer2dxSensing {
        let mut ranges = [5.0; SONARS];
        ranges[sonar] = range;
        Pioneer2dxSensing {
            sonars: Some(ranges),
            ..Pioneer2dxSensing::SILENT
        }
    }

    fn ends(sonar: usize, ranges: &[f64], give_way: f64) -> Option<LegEnd> {
        let mut layer = StopNear::new(NearLimits::paper());
        layer.give_way(give_way);
        let ahead = GoAhead { translate: 1.0 }.propose();
        let mut last = ahead;
        for range in ranges {
            last = layer.correct(ahead, &reading(sonar, *range));
        }
        last.ends
    }

    #[test]
    fn it_stops_by_the_mean_and_by_where_the_sensor_looks() {
        assert_eq!(ends(3, &[1.0], 1.0), Some(LegEnd::Near));
        assert_eq!(ends(3, &[1.2, 1.2, 1.0], 1.0), None, "1.13 on the mean");
        assert_eq!(ends(3, &[1.2, 1.0, 1.0], 1.0), Some(LegEnd::Near));
        assert_eq!(ends(3, &[1.0, 1.0, 1.0], 0.5), None, "it gives way");
        assert_eq!(ends(0, &[0.2, 0.2, 0.2], 1.0), None, "beside");
        assert_eq!(ends(0, &[0.14, 0.14, 0.14], 1.0), Some(LegEnd::Near));
        assert_eq!(ends(12, &[0.1, 0.1, 0.1], 1.0), None, "behind");
    }
}
