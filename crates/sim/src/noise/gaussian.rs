use crate::Draws;

/// Gaussian noise without bias: a share of the value and an amount of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gaussian {
    /// Standard deviation as a share of the value.
    pub relative_sd: f64,
    /// Standard deviation in the value's own unit.
    pub absolute_sd: f64,
}

impl Gaussian {
    /// No noise at all.
    pub const NONE: Self = Self {
        relative_sd: 0.0,
        absolute_sd: 0.0,
    };

    /// Returns noise of a fixed standard deviation, in the value's own unit.
    #[must_use]
    pub const fn absolute(sd: f64) -> Self {
        Self {
            relative_sd: 0.0,
            absolute_sd: sd,
        }
    }

    /// Returns noise whose standard deviation is a share of the value.
    #[must_use]
    pub const fn relative(sd: f64) -> Self {
        Self {
            relative_sd: sd,
            absolute_sd: 0.0,
        }
    }

    /// Returns a disturbed `value`.
    #[must_use]
    pub fn around(&self, value: f64, draws: &mut Draws) -> f64 {
        // Two independent Gaussians add up to one.
        let relative = self.relative_sd * value;
        let sd = (relative * relative + self.absolute_sd * self.absolute_sd).sqrt();
        if sd > 0.0 {
            value + sd * draws.gaussian()
        } else {
            value
        }
    }
}
