use core::f64::consts::FRAC_PI_2;

use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::{Ring, Scan};

use super::SiteKind;

/// A place as a robot sees it on arrival, whether or not it has been there before.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// Number of the keyframe in the middle of the place.
    pub keyframe: usize,
    /// Middle of the free ground around the place, which is the same from all sides.
    pub middle: Point,
    /// Kind of place.
    pub kind: SiteKind,
    /// Whether each of the four ways along the building's axes leads on, counter-clockwise from the
    /// first axis.
    pub open: [bool; 4],
    /// Ranges around the robot there. The first beam looks along the first axis.
    pub around: Scan,
    /// Quarter by which the robot came.
    pub came_by: usize,
}

/// The way from one place to the next by the scans on it. It does not depend on recognized places.
#[derive(Clone, Debug, PartialEq)]
pub struct SiteWay {
    /// The place at the beginning of the way.
    pub from: Site,
    /// Quarter by which the robot left the place before.
    pub left_by: usize,
    /// Displacement of the robot along the building's axes, m.
    pub moved: Vector,
    /// Length of the robot's way, m.
    pub length: f64,
    /// Keyframes on the way. The last one is that of the place `to`.
    pub steps: Vec<SiteStep>,
    /// The place at the end of the way.
    pub to: Site,
}

/// A keyframe on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct SiteStep {
    /// Pose relative to the keyframe before.
    pub moved: Pose,
    /// Ranges around the keyframe. The first beam looks ahead.
    pub around: Scan,
}

impl Site {
    /// Returns the number of the quarter nearest to a heading, counter-clockwise from the first
    /// axis.
    #[must_use]
    pub fn quarter(heading: Heading) -> usize {
        let quarters = libm::round(heading.radians() / FRAC_PI_2);
        (quarters as i64).rem_euclid(4) as usize
    }
}

/// Returns the ring of the scan around a place: the paper's 72 beams, with a reach that follows
/// from the corridor width.
#[must_use]
pub(super) fn ring(corridor_width: f64) -> Ring {
    Ring::full(BEAMS, REACH_WIDTHS * corridor_width)
}

const BEAMS: u32 = 72;
const REACH_WIDTHS: f64 = 4.0;

/// Returns the centroid of the free ground that a scan shows within `reach`, m, in the scan's
/// frame.
pub(super) fn middle_of(scan: &Scan, reach: f64) -> Vector {
    let (mut area, mut moment) = (0.0, Vector::zeros());
    for (beam, range) in (0..).zip(&scan.ranges) {
        let range = range.min(reach);
        let ahead = Heading::from_radians(scan.ring.bearing(beam)).unit();
        area += range * range / 2.0;
        moment += ahead * (range * range * range / 3.0);
    }
    if area > 0.0 {
        moment / area
    } else {
        Vector::zeros()
    }
}
