use tolman_maps::diktiometry::{Percepts, SignatureKind, ViewRotation};
use tolman_robot::{Ranges, Sees};

use super::{SenseError, round_scan};

/// Converts a robot's readings to the columns of a view, by which it tells places apart.
pub trait Eye<S> {
    /// Returns the columns of the view in `sensing`. Column 0 looks ahead; the others follow
    /// counter-clockwise, evenly spread over the full circle. `None` if it does not look.
    ///
    /// # Errors
    /// [`SenseError`] if the sensor gave nothing.
    fn columns(&self, sensing: &S) -> Result<Option<Vec<Vec<f64>>>, SenseError>;
}

/// Does not look: all places look alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoEye;

/// Looks by a camera that sees all round: three colour values per column.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CameraEye;

/// Looks by the laser: the mean range of neighbouring beams, as a share of its reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LaserEye {
    /// Number of columns, ≥ 1; divides the number of beams.
    pub columns: u32,
}

impl<S> Eye<S> for NoEye {
    fn columns(&self, _sensing: &S) -> Result<Option<Vec<Vec<f64>>>, SenseError> {
        Ok(None)
    }
}

impl<S: Sees> Eye<S> for CameraEye {
    fn columns(&self, sensing: &S) -> Result<Option<Vec<Vec<f64>>>, SenseError> {
        let image = sensing.image();
        let image = image.ok_or(SenseError::Blind { sensor: "camera" })?;
        let columns = image.columns.iter().map(|column| column.to_vec());
        Ok(Some(columns.collect()))
    }
}

impl<S: Ranges> Eye<S> for LaserEye {
    fn columns(&self, sensing: &S) -> Result<Option<Vec<Vec<f64>>>, SenseError> {
        let scan = round_scan(sensing)?;
        let beams = scan.ranges.len();
        let ahead = libm::round(-scan.ring.first_bearing / scan.ring.spacing);
        let mut ranges = scan.ranges.clone();
        ranges.rotate_left(ahead.rem_euclid(beams as f64) as usize);
        let mean = |beams: &[f64]| {
            let sum: f64 = beams.iter().sum();
            vec![sum / (beams.len() as f64 * scan.ring.max_range)]
        };
        let width = beams / self.columns.max(1) as usize;
        Ok(Some(ranges.chunks(width.max(1)).map(mean).collect()))
    }
}

impl<S, E: Eye<S>> Eye<S> for &E {
    fn columns(&self, sensing: &S) -> Result<Option<Vec<Vec<f64>>>, SenseError> {
        (**self).columns(sensing)
    }
}

/// Returns the percepts of a mapper whose robot has [`NoEye`]: which of the four ways lead on.
#[must_use]
pub const fn exit_signatures() -> Percepts {
    Percepts::Signatures(SignatureKind {
        rows: 1,
        columns: 4,
        tolerance: 0.5,
        share: 1.0,
        rotation: ViewRotation::Aligned,
        views: 2,
    })
}

/// Share of a laser's columns in which two looks of a place agree. Crossing and dead end, or corner
/// and junction, differ in a quarter of all columns.
const LASER_SHARE: f64 = 0.8;

/// Returns the percepts of a mapper whose robot turns its signatures of `rows` × `columns` values
/// by its compass. A [`CameraEye`] has 3 rows, a [`LaserEye`] 1.
#[must_use]
pub const fn aligned_signatures(rows: usize, columns: usize) -> Percepts {
    Percepts::Signatures(SignatureKind {
        rows,
        columns,
        tolerance: 0.15,
        share: if rows == 1 { LASER_SHARE } else { 0.6 },
        rotation: ViewRotation::Aligned,
        views: 4,
    })
}

#[cfg(test)]
mod tests {
    use tolman_robot::{LaserSensing, Ring, Scan};

    use super::*;

    /// Column 0 looks ahead whatever the direction of the ring's first beam.
    #[test]
    fn a_laser_eye_begins_ahead() {
        let look = |first_bearing: f64, ranges: &[f64]| {
            let ring = Ring {
                first_bearing,
                ..Ring::full(4, 2.0)
            };
            let mut sensing = LaserSensing::silent(ring);
            let ranges = ranges.to_vec();
            sensing.scan = Some(Scan { ring, ranges });
            LaserEye { columns: 4 }.columns(&sensing)
        };
        let expected = Ok(Some(vec![vec![0.5], vec![1.0], vec![0.25], vec![0.0]]));
        assert_eq!(look(0.0, &[1.0, 2.0, 0.5, 0.0]), expected);
        let half = core::f64::consts::PI;
        assert_eq!(look(-half, &[0.5, 0.0, 1.0, 2.0]), expected);
        assert!(look(0.0, &[1.0, 2.0]).is_err(), "two ranges of four beams");
    }
}
