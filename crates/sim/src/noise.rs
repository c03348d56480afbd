//! Noise and faults: what comes between a sensor and its reading, or a motor and its motion.
//!
//! A [`Fault`] changes a value after it was read or made, whatever its source. [`Faults`] apply
//! several faults to one value in turn. Every fault draws from a [`Channel`](crate::Channel) of its
//! own, so none shifts another one's numbers.
//!
//! To add a fault to the configuration, give [`Fault`] a variant. To add one from another crate,
//! implement [`Disturbance`] and give it to the robot after it was built. [`Noise`] makes one of
//! any distribution of `rand` or `rand_distr`.
//!
//! Kidnapping is not a fault of the robot: see
//! [`Simulation::place`](crate::Simulation::place).

use tolman_geom::Heading;
use tolman_robot::{ColumnImage, Picture, Scan};

mod disturbance;
mod fault;
mod faults;
mod gaussian;

pub use disturbance::{CloneDisturbance, Disturbance, Disturbances, Noise};
pub use fault::{Fault, FaultsError};
pub use faults::Faults;
pub use gaussian::Gaussian;

/// A value made of numbers that can be disturbed one by one.
pub trait Values: Clone {
    /// Replaces every number by the result of `change`.
    fn change(&mut self, change: impl FnMut(f64) -> f64);

    /// Returns whether a sensor or a motor can give this value. All its numbers must be finite, and
    /// their count and size as its type promises.
    fn is_sound(&self) -> bool {
        let mut is_sound = true;
        self.clone().change(|number| {
            is_sound &= number.is_finite();
            number
        });
        is_sound
    }
}

impl Values for f64 {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        *self = change(*self);
    }
}

impl<V: Values> Values for Option<V> {
    /// Changes the value if it is there. A missing value stays missing.
    fn change(&mut self, change: impl FnMut(f64) -> f64) {
        if let Some(value) = self {
            value.change(change);
        }
    }
}

impl<const N: usize> Values for [f64; N] {
    fn change(&mut self, change: impl FnMut(f64) -> f64) {
        *self = self.map(change);
    }
}

impl Values for Scan {
    /// Changes the ranges of beams that met something, within the range of the ring. Other beams
    /// have no echo to disturb.
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        let max_range = self.ring.max_range;
        for range in self.ranges.iter_mut().filter(|range| **range < max_range) {
            *range = change(*range).clamp(0.0, max_range);
        }
    }

    /// Returns one range per beam of the ring, each from 0 to its maximum.
    fn is_sound(&self) -> bool {
        let within = 0.0..=self.ring.max_range;
        self.ranges.len() == self.ring.beams as usize
            && self.ranges.iter().all(|range| within.contains(range))
    }
}

impl Values for ColumnImage {
    /// Changes each measurement, between darkness and full light.
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        for value in self.columns.iter_mut().flatten() {
            *value = change(*value).clamp(0.0, 1.0);
        }
    }

    /// Returns whether each measurement is from 0 to 1.
    fn is_sound(&self) -> bool {
        let mut all = self.columns.iter().flatten();
        all.all(|value| (0.0..=1.0).contains(value))
    }
}

impl Values for Picture {
    /// Changes red, green and blue of every pixel, 0 to 255, rounded.
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        for value in self.pixels.iter_mut().flatten() {
            *value = change(f64::from(*value)).round().clamp(0.0, 255.0) as u8;
        }
    }

    /// Returns whether the number of pixels agrees with its size.
    fn is_sound(&self) -> bool {
        self.pixels.len() == self.width as usize * self.height as usize
    }
}

impl Values for Heading {
    fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        *self = Self::from_radians(change(self.radians()));
    }
}
