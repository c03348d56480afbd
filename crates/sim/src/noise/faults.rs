use super::fault::Past;
use super::{Disturbance, Disturbances, Fault, Values};
use crate::{Chance, Channel};

/// Faults of one value, in order, each with its memory and its channel; then the disturbances from
/// outside.
#[derive(Clone, Debug)]
pub struct Faults<V> {
    each: Vec<(Fault, Past<V>)>,
    channel: Channel,
    outside: Disturbances<V>,
    outside_channel: Channel,
}

impl<V: Values> Faults<V> {
    /// Returns these faults, the first nearest to the truth. No other value of the robot may have
    /// the same `name`. A fault added at the end leaves those before it as they are.
    #[must_use]
    pub fn new(name: &str, faults: impl IntoIterator<Item = Fault>) -> Self {
        let each = faults
            .into_iter()
            .map(|fault| (fault, Past::default()))
            .collect();
        let channel = Channel::named(name);
        Self {
            each,
            channel,
            outside: Vec::new(),
            // Of its own, so that a further fault shifts no disturbance.
            outside_channel: channel.joined(" from outside"),
        }
    }

    /// Adds disturbances, which act after all earlier faults and disturbances.
    pub fn add(&mut self, disturbances: impl IntoIterator<Item = Box<dyn Disturbance<V>>>) {
        self.outside.extend(disturbances);
    }

    /// Returns the disturbances from outside, in order.
    #[must_use]
    pub fn disturbances(&self) -> &[Box<dyn Disturbance<V>>] {
        &self.outside
    }

    /// Applies all faults and disturbances to `value`. A value that a disturbance leaves
    /// [broken](Values::is_sound) is removed.
    pub fn disturb(&mut self, value: &mut Option<V>, chance: &Chance) {
        for (index, (fault, past)) in (0..).zip(&mut self.each) {
            fault.disturb(value, past, &mut chance.draws(self.channel.nth(index)));
        }
        for (index, disturbance) in (0..).zip(&mut self.outside) {
            let mut draws = chance.draws(self.outside_channel.nth(index));
            disturbance.disturb(value, &mut draws);
            if value.as_ref().is_some_and(|value| !value.is_sound()) {
                *value = None;
            }
        }
    }
}
