use super::{Disturbance, Past, Values};
use crate::Draws;

/// A resolution: every number is rounded to the nearest multiple of `step`, halves away from 0.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantization {
    /// The resolution, in the value's own unit.
    pub step: f64,
}

impl<V: Values> Disturbance<V> for Quantization {
    fn disturb(&self, value: &mut Option<V>, _: &mut Past<V>, _: &mut Draws) {
        if let Some(value) = value {
            value.change(|number| (number / self.step).round() * self.step);
        }
    }
}
