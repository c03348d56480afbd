use super::{Disturbance, Past, Values};
use crate::Draws;

/// An error of which nothing but its bounds is known: `(1 + a) · value + b`, `a` uniform in ± `share` and `b` in
/// ± `offset`, drawn anew after every `steps` readings and for all numbers of a reading alike.
///
/// Unlike those of [`Slip`](super::Slip), these errors do not average out while they hold: with many steps they are
/// a calibration that is wrong all along.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bounded {
    /// The largest share gained or lost.
    pub share: f64,
    /// The largest amount gained or lost, in the value's own unit.
    pub offset: f64,
    /// For how many readings one draw holds, at least 1.
    pub steps: u32,
}

impl<V: Values> Disturbance<V> for Bounded {
    fn disturb(&self, value: &mut Option<V>, past: &mut Past<V>, draws: &mut Draws) {
        if past.steps_left == 0 {
            past.drawn = [draws.uniform(), draws.uniform()].map(|draw| 2.0 * draw - 1.0);
            past.steps_left = self.steps;
        }
        past.steps_left = past.steps_left.saturating_sub(1);
        let [share, offset] = past.drawn;
        if let Some(value) = value {
            value.change(|number| number * (1.0 + self.share * share) + self.offset * offset);
        }
    }
}
