use super::{Disturbance, Past};
use crate::Draws;

/// Readings that come late. There is none before the first has arrived.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Delay {
    /// By how many time steps.
    pub steps: u32,
}

impl<V> Disturbance<V> for Delay {
    fn disturb(&self, value: &mut Option<V>, past: &mut Past<V>, _: &mut Draws) {
        past.values.push_back(value.take());
        if past.values.len() > self.steps as usize {
            *value = past.values.pop_front().flatten();
        }
    }
}
