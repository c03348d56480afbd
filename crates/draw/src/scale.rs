//! Positions of values along an axis, and its ticks.

use super::number::{power_of_ten, tick_label};

/// An axis with known ends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    spacing: Spacing,
    low: f64,
    high: f64,
    /// Positions of labels, ascending.
    pub(super) ticks: Vec<Tick>,
}

/// Spacing of values along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spacing {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long.
    Log,
}

/// A labelled value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

impl Scale {
    /// Returns a linear axis from 0 to a round number that is at least `max`, with about `steps`
    /// steps. Without data the axis ends at 1.
    pub(super) fn up_to(max: f64, steps: f64) -> Self {
        let max = if max.is_finite() && max > 0.0 {
            max
        } else {
            1.0
        };
        let step = round_step(max / steps);
        Self::linear_with_step(0.0, (max / step).ceil() * step, step)
    }

    /// Returns a linear axis with exactly these ends and about `steps` steps. If the ends do not
    /// form an interval, it gets the length 1.
    pub(super) fn linear(low: f64, high: f64, steps: f64) -> Self {
        let (low, high) = proper(low, high);
        Self::linear_with_step(low, high, round_step((high - low) / steps))
    }

    fn linear_with_step(low: f64, high: f64, step: f64) -> Self {
        // A tick that rounding pushes just past an end still counts.
        let within = 1e-9 * (high - low);
        let first = ((low - within) / step).ceil();
        let ticks = (0_u32..)
            .map(|i| (first + f64::from(i)) * step)
            .take_while(|tick| *tick <= high + within)
            // The rounding of 0.1 × 3 − 0.3 must not show as -0.
            .map(|tick| if tick.abs() < within { 0.0 } else { tick })
            .map(|value| Tick {
                value,
                label: tick_label(value, step),
            })
            .collect();
        Self {
            spacing: Spacing::Linear,
            low,
            high,
            ticks,
        }
    }

    /// Returns a logarithmic axis with whole powers of ten at its ends, which must be positive. Few
    /// decades also have ticks at 2 and 5; many have ticks only at some powers.
    pub(super) fn log(low: f64, high: f64) -> Self {
        let (low, high) = if low > 0.0 && high >= low && high.is_finite() {
            (low, high)
        } else {
            (1.0, 10.0)
        };
        // An end within rounding of a power of ten counts as that power.
        let (first, last) = (
            (libm::log10(low) + 1e-9).floor(),
            (libm::log10(high) - 1e-9).ceil(),
        );
        let last = last.max(first + 1.0);
        let decades = last - first;
        let every = (decades / 6.0).ceil();
        let mut ticks = Vec::new();
        let mut power = first;
        while power <= last {
            let factors: &[f64] = match power < last && decades <= 2.0 {
                true => &[1.0, 2.0, 5.0],
                false => &[1.0],
            };
            for factor in factors {
                let value = factor * libm::pow(10.0, power);
                ticks.push(Tick {
                    value,
                    label: power_label(value, power),
                });
            }
            power += every;
        }
        Self {
            spacing: Spacing::Log,
            low: libm::pow(10.0, first),
            high: libm::pow(10.0, last),
            ticks,
        }
    }

    /// Returns the difference between the ends; `None` on a logarithmic axis.
    pub(super) fn length(&self) -> Option<f64> {
        (self.spacing == Spacing::Linear).then_some(self.high - self.low)
    }

    /// Returns the position of a value, from 0 at the low end to 1 at the high end. It is not
    /// finite for a value without a position, such as 0 on a logarithmic axis.
    pub(super) fn share(&self, value: f64) -> f64 {
        match self.spacing {
            Spacing::Linear => (value - self.low) / (self.high - self.low),
            Spacing::Log => libm::log10(value / self.low) / libm::log10(self.high / self.low),
        }
    }
}

/// Returns a label; powers of ten from 10⁴, and below 10⁻³, are written as such.
fn power_label(value: f64, power: f64) -> String {
    match (-3.0..4.0).contains(&power) {
        true => tick_label(value, value),
        false => power_of_ten(value, power),
    }
}

/// Returns the ends with some distance between them.
fn proper(low: f64, high: f64) -> (f64, f64) {
    match (low.is_finite() && high.is_finite(), high > low) {
        (true, true) => (low, high),
        (true, false) => (low - 0.5, low + 0.5),
        (false, _) => (0.0, 1.0),
    }
}

/// Returns the smallest of 1, 2 and 5 times a power of ten that is not below `rough`.
fn round_step(rough: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(rough).floor());
    [1.0, 2.0, 5.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|&step| step >= rough)
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: &Scale) -> Vec<&str> {
        scale.ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    #[test]
    fn round_steps_that_take_in_the_maximum() {
        for (max, expect) in [
            (200.0, vec!["0", "50", "100", "150", "200"]),
            (301.0, vec!["0", "100", "200", "300", "400"]),
            (7.0, vec!["0", "2", "4", "6", "8"]),
            (0.0, vec!["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]),
            (f64::NAN, vec!["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]),
        ] {
            let scale = Scale::up_to(max, 5.0);
            assert_eq!(labels(&scale), expect, "{max}");
            assert!((scale.share(scale.ticks.last().unwrap().value) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn ticks_of_a_linear_axis_lie_within_its_ends() {
        let scale = Scale::linear(-0.35, 0.31, 4.0);
        assert_eq!(labels(&scale), ["-0.2", "0.0", "0.2"]);
        assert!((scale.share(-0.35)).abs() < 1e-12 && (scale.share(0.31) - 1.0).abs() < 1e-12);
        for (low, high) in [
            (3.0, 3.0),
            (4.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            let scale = Scale::linear(low, high, 4.0);
            assert!(scale.share(0.5).is_finite() && !scale.ticks.is_empty());
        }
    }

    #[test]
    fn a_logarithmic_axis_ends_at_powers_of_ten() {
        let scale = Scale::log(0.02, 30.0);
        assert_eq!(labels(&scale), ["0.01", "0.1", "1", "10", "100"]);
        assert!((scale.share(1.0) - 0.5).abs() < 1e-12);
        assert_eq!(labels(&Scale::log(1.0, 10.0)), ["1", "2", "5", "10"]);
        assert_eq!(
            labels(&Scale::log(1.0, 1e12)),
            ["1", "100", "10⁴", "10⁶", "10⁸", "10¹⁰", "10¹²"]
        );
        assert!(!scale.share(0.0).is_finite());
    }
}
