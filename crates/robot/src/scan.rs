use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

/// The geometry of a ring or fan of range beams: which way each one looks, and how far.
///
/// Beam `i` looks to bearing `first_bearing + i · spacing`, counter-clockwise from ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ring {
    /// How many beams.
    pub beams: u32,
    /// Bearing of beam 0, rad.
    pub first_bearing: f64,
    /// Bearing from one beam to the next, rad.
    pub spacing: f64,
    /// What a beam reads where it meets nothing, m.
    pub max_range: f64,
}

impl Ring {
    /// `beams` beams spread evenly over the whole circle, beam 0 ahead.
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

    /// `beams` beams over a field of view of `field` rad centred ahead, both ends included: a SICK
    /// LMS200 is `Ring::fan(181, π, 8.0)`.
    #[must_use]
    pub fn fan(beams: u32, field: f64, max_range: f64) -> Self {
        let gaps = f64::from(beams.max(2) - 1);
        Self {
            beams,
            first_bearing: -0.5 * field,
            spacing: field / gaps,
            max_range,
        }
    }

    /// The bearing of beam `index`, rad counter-clockwise from ahead.
    #[must_use]
    pub fn bearing(&self, index: u32) -> f64 {
        self.first_bearing + f64::from(index) * self.spacing
    }
}

/// One reading of a [`Ring`]: a range in metres for each beam.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scan {
    /// Which way each beam looked.
    pub ring: Ring,
    /// Metres along each beam, `ring.max_range` where nothing was met; `ring.beams` of them.
    pub ranges: Vec<f64>,
}

impl Scan {
    /// A scan that met nothing.
    #[must_use]
    pub fn clear(ring: Ring) -> Self {
        Self {
            ring,
            ranges: vec![ring.max_range; ring.beams as usize],
        }
    }
}
