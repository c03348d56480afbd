//! Noise and faults, each a wrapper round a sensor or a motor.
//!
//! A [`Disturbance`] changes a value after it was read or made; it knows nothing of where the value
//! came from. What it draws, it draws from a [`Channel`](crate::Channel) of its own.

use tolman_geom::Heading;
use tolman_robot::{Odometry, Scan};

use crate::{Draws, Motion};

mod gaussian;

pub use gaussian::Gaussian;

/// Something that happens to a value.
pub trait Disturbance<V> {
    /// Changes `value`, or takes it away.
    fn disturb(&mut self, value: &mut Option<V>, draws: &mut Draws);
}

/// A value made of numbers that can be disturbed one by one.
pub trait Values {
    /// Replaces every number by what `change` makes of it.
    fn change(&mut self, change: impl FnMut(f64) -> f64);
}

impl Values for f64 {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        *self = change(*self);
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

impl Values for Heading {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        *self = Self::from_radians(change(self.radians()));
    }
}

impl Values for Odometry {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        self.distance = change(self.distance);
        self.turn = change(self.turn);
    }
}

impl Values for Motion {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        self.distance = change(self.distance);
        self.turn = change(self.turn);
    }
}
