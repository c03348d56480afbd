use core::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::Vector;

/// A direction in the plane, kept in (−π, π] radians: 0 is east (or ahead), counter-clockwise.
///
/// Arithmetic wraps: `b.turn_to(a)` is the signed smallest turn that takes `b` to `a`.
///
/// A heading built from NaN or an infinity is NaN. Check with [`Heading::is_finite`].
///
/// ```
/// use tolman_geom::Heading;
///
/// let a = Heading::from_degrees(170.0);
/// let b = Heading::from_degrees(-170.0);
/// assert!((a.turn_to(b).to_degrees() - 20.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "f64", into = "f64"))]
pub struct Heading(f64);

impl Heading {
    /// 0 rad: along the x axis.
    pub const EAST: Self = Self(0.0);
    /// π/2 rad: along the y axis.
    pub const NORTH: Self = Self(FRAC_PI_2);
    /// West, π rad.
    pub const WEST: Self = Self(PI);
    /// South, −π/2 rad.
    pub const SOUTH: Self = Self(-FRAC_PI_2);

    /// Wraps any angle in radians into (−π, π].
    ///
    /// ```
    /// use core::f64::consts::{FRAC_PI_2, PI};
    /// use tolman_geom::Heading;
    ///
    /// assert!((Heading::from_radians(2.5 * PI).radians() - FRAC_PI_2).abs() < 1e-12);
    /// assert_eq!(Heading::from_radians(-PI), Heading::WEST);
    /// ```
    #[inline]
    #[must_use]
    pub fn from_radians(radians: f64) -> Self {
        if radians > -PI && radians <= PI {
            Self(radians)
        } else {
            Self::wrapped(radians)
        }
    }

    fn wrapped(radians: f64) -> Self {
        // fmod is exact, so wrapping loses nothing beyond the addition that follows it.
        let turned = libm::fmod(radians, TAU);
        let wrapped = if turned > PI {
            turned - TAU
        } else if turned <= -PI {
            turned + TAU
        } else {
            turned
        };
        // Adding τ to a value a rounding error above −2π gives −π's neighbour; keep the interval
        // half-open.
        Self(if wrapped <= -PI { PI } else { wrapped })
    }

    /// Wraps any angle in degrees.
    #[must_use]
    pub fn from_degrees(degrees: f64) -> Self {
        Self::from_radians(degrees.to_radians())
    }

    /// Returns the direction of a vector; east for the zero vector.
    ///
    /// ```
    /// use tolman_geom::{Heading, Vector};
    ///
    /// assert_eq!(Heading::of(Vector::new(0.0, -2.0)), Heading::SOUTH);
    /// ```
    #[inline]
    #[must_use]
    pub fn of(vector: Vector) -> Self {
        Self::from_radians(libm::atan2(vector.y, vector.x))
    }

    /// Returns the angle in (−π, π].
    #[must_use]
    pub const fn radians(self) -> f64 {
        self.0
    }

    /// Returns the angle in (−180, 180].
    #[must_use]
    pub fn degrees(self) -> f64 {
        self.0.to_degrees()
    }

    /// Returns the unit vector in this direction.
    #[inline]
    #[must_use]
    pub fn unit(self) -> Vector {
        let (sin, cos) = libm::sincos(self.0);
        Vector::new(cos, sin)
    }

    /// Returns `vector` turned by this heading.
    ///
    /// ```
    /// use tolman_geom::{Heading, Vector};
    /// let north = Heading::NORTH.rotate(Vector::new(2.0, 0.0));
    /// assert!((north - Vector::new(0.0, 2.0)).norm() < 1e-12);
    /// ```
    #[inline]
    #[must_use]
    pub fn rotate(self, vector: Vector) -> Vector {
        let unit = self.unit();
        Vector::new(
            unit.x * vector.x - unit.y * vector.y,
            unit.y * vector.x + unit.x * vector.y,
        )
    }

    /// Returns the signed smallest turn, in (−π, π] radians, that takes this heading to `target`.
    #[inline]
    #[must_use]
    pub fn turn_to(self, target: Self) -> f64 {
        Self::from_radians(target.0 - self.0).0
    }

    /// Returns this heading turned counter-clockwise by `radians`.
    #[inline]
    #[must_use]
    pub fn turned(self, radians: f64) -> Self {
        Self::from_radians(self.0 + radians)
    }

    /// Returns the opposite direction.
    #[inline]
    #[must_use]
    pub fn reversed(self) -> Self {
        self.turned(PI)
    }

    /// Returns whether the heading is a finite angle, not one made from NaN or an infinity.
    #[must_use]
    pub const fn is_finite(self) -> bool {
        self.0.is_finite()
    }
}

impl From<f64> for Heading {
    /// Returns the heading of `radians`, wrapped.
    fn from(radians: f64) -> Self {
        Self::from_radians(radians)
    }
}

impl From<Heading> for f64 {
    /// Returns the heading in radians.
    fn from(heading: Heading) -> Self {
        heading.0
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn any_angle_wraps_into_the_half_open_circle(radians in -1e6_f64..1e6) {
            let heading = Heading::from_radians(radians).radians();
            prop_assert!(heading > -PI && heading <= PI);
            let turns = (radians - heading) / TAU;
            prop_assert!((turns - libm::round(turns)).abs() < 1e-6);
            prop_assert_eq!(Heading::from_radians(heading).radians().to_bits(), heading.to_bits());
        }

        #[test]
        fn turning_by_the_turn_to_a_target_arrives_there(from in -4.0_f64..4.0, to in -4.0_f64..4.0) {
            let (from, to) = (Heading::from_radians(from), Heading::from_radians(to));
            prop_assert!(from.turned(from.turn_to(to)).turn_to(to).abs() < 1e-12);
            prop_assert!(from.turn_to(to).abs() <= PI);
        }

        #[test]
        fn a_heading_is_the_direction_of_its_unit_vector(radians in -PI..PI) {
            let heading = Heading::from_radians(radians);
            prop_assert!(Heading::of(heading.unit()).turn_to(heading).abs() < 1e-12);
        }
    }

    #[test]
    fn the_seam_belongs_to_plus_pi() {
        for radians in [PI, -PI, 3.0 * PI, -3.0 * PI] {
            assert!(
                (Heading::from_radians(radians).radians() - PI).abs() < 1e-9,
                "{radians}"
            );
            assert!(Heading::from_radians(radians).radians() > 0.0);
        }
        assert!((Heading::EAST.reversed().radians() - PI).abs() < 1e-15);
    }

    #[test]
    fn nan_stays_visible() {
        assert!(!Heading::from_radians(f64::NAN).is_finite());
        assert!(!Heading::from_radians(f64::INFINITY).is_finite());
    }
}
