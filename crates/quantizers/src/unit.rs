//! Units, and the results of a search for the nearest ones.

use core::fmt;

use crate::Scalar;

/// Permanent id of a unit. No other unit of the same network ever has it, even after the unit is
/// removed. Later units have greater ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct UnitId(pub u32);

impl fmt::Display for UnitId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

/// A unit that a search found, and how far it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<S> {
    /// Id of the unit.
    pub id: UnitId,
    /// Squared distance from the input, Σ w (x − p)², over the features that were compared.
    pub squared_distance: S,
}

impl<S: Scalar> Nearest<S> {
    /// Returns the distance of the unit from the input.
    pub fn distance(&self) -> S {
        S::from_f64(libm::sqrt(self.squared_distance.to_f64()))
    }
}

/// The two units nearest to an input. Of equally near units the one with the smaller id is nearer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestTwo<S> {
    /// Unit nearest to the input.
    pub first: Nearest<S>,
    /// Second nearest unit, if there are two.
    pub second: Option<Nearest<S>>,
}
