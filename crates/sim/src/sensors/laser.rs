use thiserror::Error;
use tolman_robot::{Ring, Scan};

use super::Sensor;
use crate::casters::BeamSweep;
use crate::{Chance, Surroundings};

/// A laser ring or fan in the middle of the robot: one exact range per beam.
#[derive(Clone, Debug)]
pub struct Laser {
    sweep: BeamSweep,
}

impl Laser {
    /// Returns a laser with the beams of `ring`.
    ///
    /// # Errors
    /// If the ring has no beams or too many, sweeps more than a full circle, or has no range.
    pub fn new(ring: Ring) -> Result<Self, LaserError> {
        if ring.beams == 0 || ring.beams > 1_000_000 {
            return Err(LaserError::Beams { beams: ring.beams });
        }
        if !(ring.max_range.is_finite() && ring.max_range > 0.0) {
            return Err(LaserError::MaxRange {
                max_range: ring.max_range,
            });
        }
        let field = ring.spacing * f64::from(ring.beams - 1);
        if !(ring.first_bearing.is_finite()
            && (0.0..core::f64::consts::TAU).contains(&field)
            && (ring.spacing > 0.0 || ring.beams == 1))
        {
            return Err(LaserError::Field {
                first_bearing: ring.first_bearing,
                spacing: ring.spacing,
            });
        }
        Ok(Self {
            sweep: BeamSweep::new(ring),
        })
    }

    /// Returns the geometry of its beams.
    #[must_use]
    pub fn ring(&self) -> Ring {
        self.sweep.ring()
    }
}

impl Sensor for Laser {
    type Reading = Scan;

    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<Scan>) {
        let ring = self.ring();
        let scan = reading.get_or_insert_with(|| Scan::clear(ring));
        if scan.ring != ring {
            // A disturbance may have left the scan of another laser.
            *scan = Scan::clear(ring);
        }
        self.sweep.aim(around.truth.pose);
        around.scan(&mut self.sweep);
        for (range, read) in scan.ranges.iter_mut().zip(self.sweep.ranges()) {
            *range = read;
        }
    }
}

/// Reason why a laser cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LaserError {
    /// The number of beams is 0 or too large.
    #[error("the laser has {beams} beams; give 1 to 1,000,000")]
    Beams {
        /// Number of beams.
        beams: u32,
    },
    /// The laser's range is not positive.
    #[error("the laser's range is {max_range} m; give a positive number of metres")]
    MaxRange {
        /// The offending range, m.
        max_range: f64,
    },
    /// The laser's beams cover more than a full circle.
    #[error(
        "the laser's beams start at {first_bearing} rad and are {spacing} rad apart; give finite \
         numbers, counter-clockwise and within one circle"
    )]
    Field {
        /// Bearing of beam 0, rad.
        first_bearing: f64,
        /// Angle between neighbouring beams, rad.
        spacing: f64,
    },
}
