use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

use thiserror::Error;

/// Directions of the ways out of a place, seen from its middle: rad, counter-clockwise, the first
/// at 0.
///
/// Where a side way leaves a corridor, they tell by which of the three ways the robot entered.
///
/// Ours; the paper's junctions number their branches and forget their directions.
///
/// ```
/// use core::f64::consts::{FRAC_PI_2, PI};
/// use tolman_maps::cpm::Bearings;
///
/// // A robot that looks along a corridor: the way behind it, the one ahead, one to the left.
/// let seen = Bearings::of_directions(&[PI, 0.0, FRAC_PI_2])?;
/// assert_eq!(seen.radians(), [0.0, PI, 1.5 * PI]);
/// // The same place, entered by the side way.
/// assert_eq!(seen.counted_from(2).radians(), [0.0, FRAC_PI_2, 1.5 * PI]);
/// # Ok::<(), tolman_maps::cpm::BearingsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Bearings(Vec<f64>);

/// Reason why numbers are not bearings.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BearingsError {
    /// The list has no bearing; a place has at least the way by which it is entered.
    #[error("the place has no ways; give at least the direction of the way of entry")]
    Empty,
    /// A direction is not a number.
    #[error("the direction of way {way} is {value}; give finite radians")]
    NotFinite {
        /// Counted from 0.
        way: usize,
        /// The value given.
        value: f64,
    },
    /// The directions are not in counter-clockwise order.
    #[error("way {way} does not lie between its neighbours: give the ways counter-clockwise")]
    NotInOrder {
        /// Counted from 0.
        way: usize,
    },
}

impl Bearings {
    /// Returns bearings from `directions` in any frame, rad, counter-clockwise. The list may cross
    /// the direction at which angles wrap.
    ///
    /// # Errors
    /// [`BearingsError`].
    pub fn of_directions(directions: &[f64]) -> Result<Self, BearingsError> {
        let first = *directions.first().ok_or(BearingsError::Empty)?;
        let mut bearings: Vec<f64> = Vec::with_capacity(directions.len());
        for (way, value) in directions.iter().copied().enumerate() {
            if !value.is_finite() {
                return Err(BearingsError::NotFinite { way, value });
            }
            let bearing = if way == 0 {
                0.0
            } else {
                wrapped(value - first)
            };
            if bearings.last().is_some_and(|before| bearing <= *before) {
                return Err(BearingsError::NotInOrder { way });
            }
            bearings.push(bearing);
        }
        Ok(Self(bearings))
    }

    /// Returns the bearings, ascending from 0 to less than 2π.
    #[must_use]
    pub fn radians(&self) -> &[f64] {
        &self.0
    }

    /// Returns the number of ways; at least 1.
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.0.len() as u32
    }

    /// Returns the same ways, counted from `way`.
    #[must_use]
    pub fn counted_from(&self, way: u32) -> Self {
        let count = self.0.len();
        let first = way as usize % count;
        let turned = (first..first + count).map(|index| {
            let bearing = self.0[index % count] - self.0[first];
            if index < count {
                bearing
            } else {
                bearing + TAU
            }
        });
        Self(turned.collect())
    }

    /// Returns the greatest angle between the ways of equal number, rad, or `None` if the numbers
    /// of ways differ.
    #[must_use]
    pub fn apart(&self, other: &Self) -> Option<f64> {
        let pairs = self.0.iter().zip(&other.0);
        let most = pairs.map(|(a, b)| between(*a, *b)).fold(0.0, f64::max);
        (self.0.len() == other.0.len()).then_some(most)
    }

    /// Returns the ways ahead: all but the first.
    pub(super) fn onward(&self) -> &[f64] {
        self.0.get(1..).unwrap_or_default()
    }
}

/// Standard deviation of directions seen from the middle of a place, rad.
pub(super) const SHARP: f64 = 0.35;

/// Returns the angle between two directions, rad, 0 to π.
pub(super) fn between(a: f64, b: f64) -> f64 {
    let angle = wrapped(a - b);
    if angle > PI { TAU - angle } else { angle }
}

/// Returns an angle wrapped to [0, 2π).
pub(super) fn wrapped(angle: f64) -> f64 {
    let wrapped = angle - TAU * libm::floor(angle / TAU);
    // A hair below 0 is rounded to the full circle.
    if wrapped < TAU { wrapped } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_place_is_refused() {
        let refused = |directions: &[f64]| Bearings::of_directions(directions).err();
        assert_eq!(refused(&[]), Some(BearingsError::Empty));
        assert!(matches!(
            refused(&[0.0, f64::NAN]),
            Some(BearingsError::NotFinite { way: 1, .. })
        ));
        let clockwise = refused(&[0.0, 4.0, 2.0]);
        assert_eq!(clockwise, Some(BearingsError::NotInOrder { way: 2 }));
        let twice = refused(&[1.0, 1.0]);
        assert_eq!(twice, Some(BearingsError::NotInOrder { way: 1 }));
    }

    #[test]
    fn counted_from_each_way_in_turn_it_is_itself_again() {
        let place = Bearings::of_directions(&[-3.0, -1.0, 0.5, 2.0]).unwrap();
        let mut turned = place.clone();
        for _ in 0..4 {
            turned = turned.counted_from(1);
        }
        assert!(turned.apart(&place).unwrap() < 1e-12);
        let back = place.counted_from(3).counted_from(1);
        assert!(back.apart(&place).unwrap() < 1e-12);
        assert!(place.counted_from(1).apart(&place).unwrap() > 0.4);
        let fewer = Bearings::of_directions(&[0.0, 1.0]).unwrap();
        assert_eq!(fewer.apart(&place), None);
    }
}
