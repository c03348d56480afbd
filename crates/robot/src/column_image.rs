use alloc::vec;
use alloc::vec::Vec;

use crate::LaserSensing;

/// View of a camera that looks all round, measured column by column: an image signature.
///
/// Column `i` of `n` looks to bearing `i` · 2π / `n`, counter-clockwise from ahead, so that a turn
/// of the robot moves the columns round.
///
/// Source: S. Engelson, D. McDermott, "Maps Considered as Adaptive Planning Resources", perceptual
/// indexing ("an array of values, each computed by a measurement function from a subset of the
/// image").
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ColumnImage {
    /// The mean red, green and blue of each column, 0 (dark) … 1.
    pub columns: Vec<[f64; 3]>,
}

impl ColumnImage {
    /// Returns an image of `columns` black columns.
    #[must_use]
    pub fn black(columns: u32) -> Self {
        Self {
            columns: vec![[0.0; 3]; columns as usize],
        }
    }
}

/// Readings of a robot with a camera beside a laser ring, a compass, wheel encoders and a bumper in
/// one time step.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CameraSensing {
    /// Readings of all sensors but the camera.
    pub laser: LaserSensing,
    /// The camera's image; `None` is a drop-out.
    pub image: Option<ColumnImage>,
}

impl AsRef<LaserSensing> for CameraSensing {
    fn as_ref(&self) -> &LaserSensing {
        &self.laser
    }
}
