//! A linear axis with round ticks.

/// A linear axis from 0 to a round number that takes in all values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// The value at the far end.
    pub(super) top: f64,
    /// The distance between ticks: 1, 2 or 5 times a power of ten.
    pub(super) step: f64,
}

impl Scale {
    /// The axis for values up to `max`, with about `ticks` steps. An axis for nothing ends at 1.
    pub(super) fn up_to(max: f64, ticks: f64) -> Self {
        let max = if max.is_finite() && max > 0.0 {
            max
        } else {
            1.0
        };
        let rough = max / ticks;
        let power = libm::pow(10.0, libm::log10(rough).floor());
        let step = [1.0, 2.0, 5.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(|&step| step >= rough)
            .unwrap_or(10.0 * power);
        Self {
            top: (max / step).ceil() * step,
            step,
        }
    }

    /// The values at the ticks, from 0 to the top.
    pub(super) fn ticks(self) -> impl Iterator<Item = f64> {
        (0_u32..)
            .map(move |i| f64::from(i) * self.step)
            .take_while(move |&tick| tick <= self.top * (1.0 + 1e-9))
    }
}

#[cfg(test)]
mod tests {
    use super::Scale;

    #[test]
    fn round_steps_that_take_in_the_maximum() {
        for (max, top, step) in [
            (200.0, 200.0, 50.0),
            (500.0, 500.0, 100.0),
            (301.0, 400.0, 100.0),
            (7.0, 8.0, 2.0),
            (0.0, 1.0, 0.2),
            (f64::NAN, 1.0, 0.2),
        ] {
            let scale = Scale::up_to(max, 5.0);
            assert!(
                (scale.top - top).abs() < 1e-9 && (scale.step - step).abs() < 1e-9,
                "{max}: {scale:?}"
            );
            assert!((scale.ticks().last().unwrap() - scale.top).abs() < 1e-9);
        }
    }
}
