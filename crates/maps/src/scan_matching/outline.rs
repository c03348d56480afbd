use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::Scan;

/// Points where the beams of a scan ended, in the robot's frame, with the normals of the surfaces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ScanOutline {
    pub(super) points: Vec<SurfacePoint>,
}

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SurfacePoint {
    pub(super) at: Point,
    /// Unit normal of the surface; zero if the neighbouring beams do not determine it.
    pub(super) normal: Vector,
    /// Whether the same surface continues to the next point.
    pub(super) goes_on: bool,
}

/// Distance of two neighbouring beams' ends above which they belong to two surfaces, as a multiple
/// of that on a surface at right angles.
const SLANT: f64 = 6.0;
/// Range below which a beam ends on the robot itself, m.
const NEAREST: f64 = 0.1;

/// Interval, in points, at which the axis is estimated.
const AXIS_POINTS: usize = 5;

impl ScanOutline {
    /// Returns the outline that a scan shows, of beams that end within `farthest` m. O(beams).
    pub(super) fn of(scan: &Scan, robot_from_laser: Pose, farthest: f64) -> Self {
        let most = farthest.min(scan.ring.max_range);
        let hits = (0..).zip(&scan.ranges);
        let hits = hits.filter(|(_, range)| (NEAREST..most).contains(*range));
        let ends: Vec<(u32, f64, Point)> = hits
            .map(|(index, range)| {
                let beam = Heading::from_radians(scan.ring.bearing(index)).unit();
                let end = robot_from_laser.transform(Point::from(beam * *range));
                (index, *range, end)
            })
            .collect();
        let spacing = scan.ring.spacing;
        let points = (0..ends.len()).map(|place| {
            let at = ends[place].2;
            let before = place.checked_sub(1);
            let before = before.and_then(|before| beside(&ends, place, before, spacing));
            let after = beside(&ends, place, place + 1, spacing);
            SurfacePoint {
                at,
                normal: across(before.unwrap_or(at), after.unwrap_or(at)),
                goes_on: after.is_some(),
            }
        });
        Self {
            points: points.collect(),
        }
    }

    /// Returns the sum of unit vectors at four times each surface's heading. Its direction tells
    /// how walls run, since quarter turns count as the same.
    pub(super) fn axis(&self) -> Vector {
        let told = self.points.iter().step_by(AXIS_POINTS);
        let told = told.filter(|point| point.normal != Vector::zeros());
        let four_times = told
            .map(|point| Heading::from_radians(4.0 * Heading::of(point.normal).radians()).unit());
        four_times.sum()
    }

    /// Returns at most `most` of its points, spread over all of them.
    pub(super) fn thinned(&self, most: usize) -> Self {
        let every = self.points.len().div_ceil(most.max(1)).max(1);
        Self {
            points: self.points.iter().step_by(every).copied().collect(),
        }
    }

    /// Adds another outline, seen from `from`, as seen from the robot.
    pub(super) fn add(&mut self, other: &Self, from: Pose) {
        let seen = |point: &SurfacePoint| SurfacePoint {
            at: from.transform(point.at),
            normal: from.heading.rotate(point.normal),
            goes_on: point.goes_on,
        };
        self.points.extend(other.points.iter().map(seen));
    }
}

/// Returns the end of the beam `other`, if it met the same surface as the beam `place`.
fn beside(ends: &[(u32, f64, Point)], place: usize, other: usize, spacing: f64) -> Option<Point> {
    let (index, range, at) = ends[place];
    let (other, _, end) = ends.get(other)?;
    let beams = f64::from(other.abs_diff(index));
    let near = SLANT * beams * spacing.abs() * range + 0.05;
    (beams <= 2.0 && (end - at).norm() < near).then_some(*end)
}

/// Returns the unit normal of the line from one point to another; zero if they are one.
fn across(from: Point, to: Point) -> Vector {
    let along = to - from;
    let length = along.norm();
    if length < 1e-6 {
        return Vector::zeros();
    }
    Vector::new(-along.y, along.x) / length
}
