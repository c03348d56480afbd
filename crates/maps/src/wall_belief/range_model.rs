use core::f64::consts::TAU;

use super::RangeReading;

/// Error model of a range sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeModel {
    /// Standard deviation of a range, m. > 0.
    pub absolute: f64,
    /// Standard deviation of a range as a share of the range, at least 0.
    pub relative: f64,
    /// Share of readings unrelated to the walls in the map, such as those that meet a post. Within
    /// 0 … 1.
    pub outliers: f64,
}

impl RangeModel {
    /// Returns the density of a reading whose expected value is `range`.
    #[inline]
    pub(super) fn density(&self, reading: f64, range: f64) -> f64 {
        let relative = self.relative * range;
        let sd = libm::sqrt(self.absolute * self.absolute + relative * relative);
        let off = (reading - range) / sd;
        libm::exp(-0.5 * off * off) / (sd * libm::sqrt(TAU))
    }

    /// Returns the density of a reading, given its density `met` by the walls and the rate of
    /// outliers.
    pub(super) fn mixed(&self, reading: RangeReading, met: f64) -> f64 {
        self.outliers / reading.max_range + (1.0 - self.outliers) * met
    }
}
