use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use tolman_geom::Heading;

/// The geometry of a ring or fan of range beams: which way each one looks, and how far.
///
/// Beam `i` looks to bearing `first_bearing + i · spacing`, counter-clockwise from ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ring {
    /// Number of beams.
    pub beams: u32,
    /// Bearing of beam 0, rad.
    pub first_bearing: f64,
    /// Bearing from one beam to the next, rad.
    pub spacing: f64,
    /// Reading of a beam that meets nothing, m.
    pub max_range: f64,
}

impl Ring {
    /// Returns `beams` beams spread evenly over the whole circle, beam 0 ahead.
    ///
    /// ```
    /// use tolman_robot::Ring;
    /// let ring = Ring::full(72, 1.25);
    /// assert!((ring.bearing(18).to_degrees() - 90.0).abs() < 1e-12, "beam 18 looks left");
    /// ```
    #[must_use]
    pub fn full(beams: u32, max_range: f64) -> Self {
        Self {
            beams,
            first_bearing: 0.0,
            spacing: TAU / f64::from(beams),
            max_range,
        }
    }

    /// Returns `beams` beams over a field of view of `field` rad centred ahead, both ends included;
    /// a single beam looks ahead.
    ///
    /// ```
    /// use core::f64::consts::{FRAC_PI_2, PI};
    /// use tolman_robot::Ring;
    ///
    /// let lms200 = Ring::fan(181, PI, 8.0);
    /// assert_eq!(lms200.bearing(0), -FRAC_PI_2, "beam 0 looks right");
    /// assert!(lms200.bearing(90).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn fan(beams: u32, field: f64, max_range: f64) -> Self {
        let (first_bearing, spacing) = if beams < 2 {
            (0.0, 0.0)
        } else {
            (-0.5 * field, field / f64::from(beams - 1))
        };
        Self {
            beams,
            first_bearing,
            spacing,
            max_range,
        }
    }

    /// Returns the bearing of beam `index`, rad counter-clockwise from ahead.
    #[must_use]
    pub fn bearing(&self, index: u32) -> f64 {
        self.first_bearing + f64::from(index) * self.spacing
    }
}

/// One reading of a [`Ring`]: a range in metres for each beam.
///
/// ```
/// use tolman_robot::{Ring, Scan};
///
/// // 180 beams over the half circle ahead; the middle one meets a wall.
/// let mut scan = Scan::clear(Ring::fan(181, core::f64::consts::PI, 8.0));
/// scan.ranges[90] = 1.5;
/// assert!(scan.ring.bearing(90).abs() < 1e-12);
/// assert_eq!(scan.ranges.iter().filter(|range| **range < scan.ring.max_range).count(), 1);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scan {
    /// Geometry of the beams.
    pub ring: Ring,
    /// Metres along each beam, `ring.max_range` where nothing was met; `ring.beams` of them.
    pub ranges: Vec<f64>,
}

impl Scan {
    /// Returns a scan that met nothing.
    #[must_use]
    pub fn clear(ring: Ring) -> Self {
        Self {
            ring,
            ranges: vec![ring.max_range; ring.beams as usize],
        }
    }

    /// Returns the range, m, of the `beside`-th beam counter-clockwise from the one nearest to
    /// `bearing`. The bearing is in rad, counter-clockwise from ahead. The ring counts as full;
    /// `None` if it has no beams. O(1).
    ///
    /// ```
    /// use tolman_robot::{Ring, Scan};
    ///
    /// let mut scan = Scan::clear(Ring::full(4, 5.0));
    /// scan.ranges[3] = 1.0;
    /// // A right angle to the right, and the beam before the one ahead.
    /// assert_eq!(scan.range_towards(-1.5, 0), Some(1.0));
    /// assert_eq!(scan.range_towards(0.1, -1), Some(1.0));
    /// assert_eq!(scan.range_towards(0.1, 0), Some(5.0));
    /// ```
    #[must_use]
    pub fn range_towards(&self, bearing: f64, beside: i32) -> Option<f64> {
        let ahead = bearing - self.ring.first_bearing;
        let beam = libm::round(ahead / self.ring.spacing) as i64;
        let index = beam.saturating_add(beside.into());
        let index = index.checked_rem_euclid(self.ranges.len() as i64)?;
        self.ranges.get(index as usize).copied()
    }

    /// Returns the ranges of a full ring as from a robot that faces north: turned by the compass,
    /// to the nearest beam. Beam 0 looks north, the others follow counter-clockwise. O(beams).
    #[must_use]
    pub fn northward(&self, heading: Heading) -> Vec<f64> {
        let mut turned = self.ranges.clone();
        if !turned.is_empty() {
            let ahead = heading.radians() + self.ring.first_bearing - Heading::NORTH.radians();
            let beams = libm::round(ahead / self.ring.spacing) as i64;
            turned.rotate_right(beams.rem_euclid(self.ranges.len() as i64) as usize);
        }
        turned
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-12
    }

    #[test]
    fn a_full_ring_goes_round_once() {
        for beams in [1, 2, 3, 36, 72, 360] {
            let ring = Ring::full(beams, 2.5);
            assert!(near(ring.bearing(0), 0.0));
            assert!(
                near(ring.bearing(beams), TAU),
                "one past the last is the first"
            );
        }
    }

    #[test]
    fn a_fan_is_centred_and_has_both_ends() {
        for (beams, field) in [(2, PI), (5, 1.0), (181, PI), (1081, 1.5 * PI)] {
            let ring = Ring::fan(beams, field, 8.0);
            assert!(near(ring.bearing(0), -0.5 * field));
            assert!(near(ring.bearing(beams - 1), 0.5 * field));
        }
        assert!(near(Ring::fan(1, PI, 8.0).bearing(0), 0.0));
    }

    #[test]
    fn a_clear_scan_reads_the_full_range_on_every_beam() {
        let scan = Scan::clear(Ring::full(3, 1.25));
        assert_eq!(scan.ranges, [1.25; 3]);
        assert!(Scan::clear(Ring::full(0, 1.25)).ranges.is_empty());
    }
}
