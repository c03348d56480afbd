use super::{Disturbance, Past, Values};
use crate::Draws;

/// Numbers that have nothing to do with the truth: uniform between `low` and `high`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outliers {
    /// How likely each number is one, 0 … 1.
    pub probability: f64,
    /// The least of them, in the value's own unit.
    pub low: f64,
    /// The greatest, in the value's own unit.
    pub high: f64,
}

impl<V: Values> Disturbance<V> for Outliers {
    fn disturb(&self, value: &mut Option<V>, _: &mut Past<V>, draws: &mut Draws) {
        if let Some(value) = value {
            value.change(|number| {
                let (chance, place) = (draws.uniform(), draws.uniform());
                if chance < self.probability {
                    self.low + place * (self.high - self.low)
                } else {
                    number
                }
            });
        }
    }
}
