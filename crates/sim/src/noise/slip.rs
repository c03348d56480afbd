use super::{Disturbance, Past, Values};
use crate::Draws;

/// Wheels that slip: the value times a factor uniform in 1 ± `share`, as Webots has it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slip {
    /// The largest share gained or lost.
    pub share: f64,
}

impl<V: Values> Disturbance<V> for Slip {
    fn disturb(&self, value: &mut Option<V>, _: &mut Past<V>, draws: &mut Draws) {
        if let Some(value) = value {
            value.change(|number| number * (1.0 + self.share * (2.0 * draws.uniform() - 1.0)));
        }
    }
}
