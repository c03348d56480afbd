use super::fault::Past;
use super::{Fault, Values};
use crate::{Chance, Channel};

/// Faults of one value, one after the other, each with its memory and its channel.
#[derive(Clone, Debug)]
pub struct Faults<V> {
    each: Vec<(Fault, Past<V>)>,
    channel: Channel,
}

impl<V: Values> Faults<V> {
    /// These faults, the first nearest to the truth. No other value of the robot may have the same
    /// `name`; a fault added at the end leaves those before it as they are.
    #[must_use]
    pub fn new(name: &str, faults: impl IntoIterator<Item = Fault>) -> Self {
        let each = faults
            .into_iter()
            .map(|fault| (fault, Past::default()))
            .collect();
        Self {
            each,
            channel: Channel::named(name),
        }
    }

    /// Lets all of them happen to `value`.
    pub fn disturb(&mut self, value: &mut Option<V>, chance: &Chance) {
        for (index, (fault, past)) in (0..).zip(&mut self.each) {
            fault.disturb(value, past, &mut chance.draws(self.channel.nth(index)));
        }
    }
}
