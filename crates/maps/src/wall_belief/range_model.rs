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

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: RangeModel = RangeModel {
        absolute: 0.03,
        relative: 0.2,
        outliers: 0.1,
    };

    #[test]
    fn a_density_is_normal_about_the_expected_range() {
        for range in [0.0_f64, 0.1, 0.7] {
            let sd = (0.03_f64.powi(2) + (0.2 * range).powi(2)).sqrt();
            let peak = MODEL.density(range, range);
            assert!((peak - 0.398_942_280_401 / sd).abs() < 1e-6, "{range}");
            for off in [-2.0, -1.0, 1.0] {
                let share = MODEL.density(range + off * sd, range) / peak;
                assert!((share - f64::exp(-0.5 * off * off)).abs() < 1e-9, "{range}");
            }
        }
    }

    #[test]
    fn outliers_are_spread_over_all_ranges() {
        let reading = RangeReading {
            bearing: 0.0,
            range: 0.3,
            max_range: 4.0,
        };
        assert!((MODEL.mixed(reading, 0.0) - 0.025).abs() < 1e-12);
        assert!((MODEL.mixed(reading, 2.0) - 1.825).abs() < 1e-12);
    }
}
