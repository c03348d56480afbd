use core::f64::consts::{FRAC_PI_2, TAU};

use thiserror::Error;
use tolman_geom::Heading;
use tolman_robot::Ring;

use crate::View;

/// Reason why a ring of beams cannot be used to look for opposite walls.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RingError {
    /// The detector looks at quarters of the ring, each of two beams or more.
    #[error(
        "a ring of {beams} beams has no quarters of two beams or more: use a multiple of 4, from 8"
    )]
    Quarters {
        /// Number of beams of the ring.
        beams: u32,
    },
    /// The beams leave a gap in the circle, or do not start ahead.
    #[error(
        "the beams must cover the whole circle evenly, beam 0 ahead, but beam 0 looks to {first_bearing} rad and the spacing is {spacing} rad: use Ring::full"
    )]
    NotAFullCircle {
        /// Bearing of beam 0, rad.
        first_bearing: f64,
        /// Bearing from beam to beam, rad.
        spacing: f64,
    },
    /// The corridor's width is not a positive length.
    #[error("the corridor is {width} m wide; give a finite width above 0 m")]
    Width {
        /// Width that was given, m.
        width: f64,
    },
    /// The robot's diameter is not a positive length.
    #[error("the robot is {robot_unit} m in diameter; give a finite diameter above 0 m")]
    RobotUnit {
        /// Diameter that was given, m.
        robot_unit: f64,
    },
}

/// A corridor as its walls look from the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corridor {
    /// Angle by which the robot would have to turn to face along the corridor, in beams; positive
    /// is counter-clockwise. Between −beams/4 and beams/4: a corridor has no front.
    pub misaligned_beams: i32,
    /// Least sum of two opposite beams, m: the distance from wall to wall.
    pub narrowest: f64,
}

/// Tells a corridor from a junction by the sums of opposite beams (MSLST, "Robot operation").
///
/// In a corridor the walls are close at most angles and far only along it; in a junction they are
/// far in several directions. With 72 beams there are 36 sums; at least 14 in a row, counted round
/// the circle, must be below 1.625 corridor widths. Other rings ask for the same share of the half
/// circle. A corridor runs north–south or east–west. One that seems to run along a diagonal is the
/// inside of a bend, whose two corners look like walls. O(beams).
///
/// ```
/// use tolman_control::{CorridorDetector, View};
/// use tolman_geom::Heading;
/// use tolman_robot::{Ring, Scan};
///
/// // Walls 0.5 m to the left and right; nothing ahead and behind within 2 m.
/// let ring = Ring::full(72, 2.0);
/// let detector = CorridorDetector::new(ring, 1.0)?;
/// let range = |beam| (0.5 / ring.bearing(beam).sin().abs()).min(ring.max_range);
/// let scan = Scan { ring, ranges: (0..ring.beams).map(range).collect() };
/// let view = View { scan: &scan, heading: Heading::EAST };
/// let corridor = detector.detect(view).unwrap();
/// assert_eq!(corridor.misaligned_beams, 0);
/// assert!((corridor.narrowest - 1.0).abs() < 1e-9);
/// // Without walls there is no corridor.
/// let view = View { scan: &Scan::clear(ring), heading: Heading::EAST };
/// assert_eq!(detector.detect(view), None);
/// # Ok::<(), tolman_control::RingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorridorDetector {
    /// Ring of beams whose scans the detector reads.
    ring: Ring,
    /// Number of pairs of opposite beams in the ring.
    pairs: usize,
    /// Sum of two opposite ranges below which both walls count as near, m.
    near: f64,
    /// Number of near sums in a row that make a corridor.
    run: usize,
}

impl CorridorDetector {
    /// Sum of two opposite ranges below which both walls count as near, in corridor widths (the
    /// paper).
    const NEAR_WIDTHS: f64 = 1.625;
    /// Share of the half circle over which the sums must be near: 14 consecutive sums of 36 (the
    /// paper).
    const RUN_SHARE: f64 = 14.0 / 36.0;

    /// Returns a detector for `ring` in corridors `width` metres wide.
    ///
    /// # Errors
    /// [`RingError`] if the ring is not a full circle of quarters or the width is not a positive
    /// length.
    pub fn new(ring: Ring, width: f64) -> Result<Self, RingError> {
        if ring.beams < 8 || !ring.beams.is_multiple_of(4) {
            return Err(RingError::Quarters { beams: ring.beams });
        }
        let circle = ring.spacing * f64::from(ring.beams);
        let full = (circle - TAU).abs() < 1e-9 && ring.first_bearing.abs() < 1e-9;
        if !full {
            return Err(RingError::NotAFullCircle {
                first_bearing: ring.first_bearing,
                spacing: ring.spacing,
            });
        }
        if !(width.is_finite() && width > 0.0) {
            return Err(RingError::Width { width });
        }
        let pairs = ring.beams as usize / 2;
        Ok(Self {
            ring,
            pairs,
            // Two beams that met nothing are not near, however wide the corridor.
            near: (Self::NEAR_WIDTHS * width).min(2.0 * ring.max_range),
            run: libm::ceil(Self::RUN_SHARE * pairs as f64) as usize,
        })
    }

    /// Returns the ring whose scans it reads.
    #[must_use]
    pub const fn ring(&self) -> Ring {
        self.ring
    }

    /// Returns whether a view can be read. It needs a scan of the detector's ring with a number for
    /// every beam (infinity where nothing is met), and a heading.
    #[must_use]
    pub fn reads(&self, view: View<'_>) -> bool {
        view.heading.is_finite()
            && view.scan.ring == self.ring
            && view.scan.ranges.len() == 2 * self.pairs
            && !view.scan.ranges.iter().any(|range| range.is_nan())
    }

    /// Returns the corridor in view. `None` at a junction, a bend or an open place, or if it cannot
    /// [read](Self::reads) the view.
    #[must_use]
    pub fn detect(&self, view: View<'_>) -> Option<Corridor> {
        if !self.reads(view) {
            return None;
        }
        let (front, back) = view.scan.ranges.split_at_checked(self.pairs)?;
        let sums = front.iter().zip(back).map(|(ahead, behind)| ahead + behind);
        let (mut run, mut longest) = (0, 0);
        // Twice round, so that a run may cross the seam between the last pair and the first.
        for sum in sums.clone().chain(sums.clone()) {
            run = if sum < self.near { run + 1 } else { 0 };
            longest = longest.max(run);
        }
        let narrower = |least: (usize, f64), next: (usize, f64)| {
            if next.1 < least.1 { next } else { least }
        };
        let (narrowest, least) = sums.enumerate().reduce(narrower)?;
        // Aligned, the narrowest pair is the one that looks left and right.
        let misaligned_beams = narrowest as i32 - (self.pairs / 2) as i32;
        let axis = view
            .heading
            .turned(f64::from(misaligned_beams) * view.scan.ring.spacing);
        (longest >= self.run && runs_along_the_compass(axis)).then_some(Corridor {
            misaligned_beams,
            narrowest: least,
        })
    }
}

/// Returns whether an axis is nearer to north–south or east–west than to a diagonal.
fn runs_along_the_compass(axis: Heading) -> bool {
    let quarters = axis.radians() / FRAC_PI_2;
    (quarters - libm::round(quarters)).abs() <= 0.25
}
