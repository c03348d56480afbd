//! Units and what a search says of them.

use core::fmt;

use crate::Scalar;

/// The name of a unit, for good: no other unit of the same network ever bears it, also after the
/// unit is gone. Later units have greater ids.
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
    /// The unit.
    pub id: UnitId,
    /// Its squared distance, Σ w (x − p)², over the features that were compared.
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
    /// The nearest unit.
    pub first: Nearest<S>,
    /// The second nearest, if there are two units.
    pub second: Option<Nearest<S>>,
}
