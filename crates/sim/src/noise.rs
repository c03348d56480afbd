//! Noise and faults: what comes between a sensor and its reading, or a motor and its motion.
//!
//! A [`Fault`] changes a value after it was read or made and knows nothing of where it came from;
//! [`Faulty`] wraps a sensor in several, one after the other. Every fault draws from a
//! [`Channel`](crate::Channel) of its own, so none shifts another one's numbers.
//!
//! To add one: write a file with a type that implements [`Disturbance`], and give [`Fault`] a variant
//! for it. Kidnapping is no fault of the robot: see [`Simulation::place`](crate::Simulation::place).

use alloc::collections::VecDeque;

use tolman_geom::Heading;
use tolman_robot::{ColumnImage, Scan};

use crate::Draws;

mod bias;
mod bounded;
mod delay;
mod drop_out;
mod fault;
mod faulty;
mod gaussian;
mod outliers;
mod quantization;
mod slip;
mod stuck;

pub use bias::Bias;
pub use bounded::Bounded;
pub use delay::Delay;
pub use drop_out::DropOut;
pub use fault::{Fault, FaultError};
pub use faulty::{Faults, Faulty};
pub use gaussian::Gaussian;
pub use outliers::Outliers;
pub use quantization::Quantization;
pub use slip::Slip;
pub use stuck::Stuck;

/// Something that happens to a value each time it is read.
pub trait Disturbance<V> {
    /// Changes `value`, or takes it away. `past` is this disturbance's own, to remember by.
    fn disturb(&self, value: &mut Option<V>, past: &mut Past<V>, draws: &mut Draws);
}

/// What a disturbance remembers from one reading to the next; empty before the first.
#[derive(Clone, Debug)]
pub struct Past<V> {
    /// Earlier values, the oldest first.
    pub values: VecDeque<Option<V>>,
    /// For how many more readings something goes on.
    pub steps_left: u32,
    /// What was drawn for that long.
    pub drawn: [f64; 2],
}

impl<V> Default for Past<V> {
    fn default() -> Self {
        Self {
            values: VecDeque::new(),
            steps_left: 0,
            drawn: [0.0; 2],
        }
    }
}

/// A value made of numbers that can be disturbed one by one.
pub trait Values: Clone {
    /// Replaces every number by what `change` makes of it.
    fn change(&mut self, change: impl FnMut(f64) -> f64);
}

impl Values for f64 {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        *self = change(*self);
    }
}

impl<const N: usize> Values for [f64; N] {
    fn change(&mut self, change: impl FnMut(f64) -> f64) {
        *self = self.map(change);
    }
}

impl Values for Scan {
    /// Beams that met nothing have no echo to disturb; the others stay within the range of the ring.
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        let max_range = self.ring.max_range;
        for range in self.ranges.iter_mut().filter(|range| **range < max_range) {
            *range = change(*range).clamp(0.0, max_range);
        }
    }
}

impl Values for ColumnImage {
    /// No measurement falls below darkness or rises above full light.
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        for value in self.columns.iter_mut().flatten() {
            *value = change(*value).clamp(0.0, 1.0);
        }
    }
}

impl Values for Heading {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        *self = Self::from_radians(change(self.radians()));
    }
}
