use super::{Disturbance, Past};
use crate::Draws;

/// Readings that do not come.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DropOut {
    /// How likely each reading is missing, 0 … 1.
    pub probability: f64,
}

impl<V> Disturbance<V> for DropOut {
    fn disturb(&self, value: &mut Option<V>, _: &mut Past<V>, draws: &mut Draws) {
        if draws.uniform() < self.probability {
            *value = None;
        }
    }
}
