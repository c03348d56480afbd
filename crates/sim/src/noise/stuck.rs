use super::{Disturbance, Past};
use crate::Draws;

/// A sensor that now and then gets stuck and repeats the reading it got stuck at.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stuck {
    /// How likely it gets stuck at each reading, 0 … 1.
    pub probability: f64,
    /// How many readings it repeats before it comes free.
    pub steps: u32,
}

impl<V: Clone> Disturbance<V> for Stuck {
    fn disturb(&self, value: &mut Option<V>, past: &mut Past<V>, draws: &mut Draws) {
        let chance = draws.uniform();
        if past.steps_left > 0 {
            past.steps_left -= 1;
            if let Some(held) = past.values.front() {
                value.clone_from(held);
            }
        } else if chance < self.probability {
            past.steps_left = self.steps;
            past.values.clear();
            past.values.push_front(value.clone());
        }
    }
}
