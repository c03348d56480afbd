use super::{Disturbance, Past, Values};
use crate::Draws;

/// A constant error: `scale · value + offset`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bias {
    /// What the value is multiplied by; 1 for none.
    pub scale: f64,
    /// What is added then, in the value's own unit.
    pub offset: f64,
}

impl<V: Values> Disturbance<V> for Bias {
    fn disturb(&self, value: &mut Option<V>, _: &mut Past<V>, _: &mut Draws) {
        if let Some(value) = value {
            value.change(|number| self.scale * number + self.offset);
        }
    }
}
