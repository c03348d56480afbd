use tolman_geom::{Point, Pose, Vector, nearest_on_segment};

use crate::WallSegment;

/// A cone of sound in the plane: everything within an angle to either side of its axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    apex: Point,
    /// Unit normals of the cone's two edges, pointing inward.
    normals: [Vector; 2],
}

/// The nearest point of a wall within a [`Cone`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ConeEcho {
    /// Distance of the point from the cone's apex, m.
    pub(super) range: f64,
    /// Angle between the direction to the point and the wall's normal, rad, 0 … π/2.
    pub(super) incidence: f64,
}

impl Cone {
    /// Returns the cone that begins at `mount` and reaches `half_width` rad, below π/2, to either
    /// side.
    pub(super) fn new(mount: Pose, half_width: f64) -> Self {
        let left = mount.heading.turned(half_width).unit();
        let right = mount.heading.turned(-half_width).unit();
        Self {
            apex: mount.position,
            normals: [Vector::new(left.y, -left.x), Vector::new(-right.y, right.x)],
        }
    }

    /// Returns the echo of the nearest point of all `walls` in the cone, exact up to rounding, or
    /// `None`. O(walls).
    ///
    /// Nothing can hide it: anything before it would be nearer, and in the cone as well.
    pub(super) fn nearest(&self, walls: &[WallSegment]) -> Option<ConeEcho> {
        let parts = walls.iter().filter_map(|wall| self.part(wall));
        let nearest = parts.map(|(start, end)| (nearest_to_origin(start, end), end - start));
        let (point, along) =
            nearest.min_by(|a, b| a.0.norm_squared().total_cmp(&b.0.norm_squared()))?;
        Some(ConeEcho {
            range: point.norm(),
            incidence: incidence(point, along),
        })
    }

    /// Returns the part of a wall within the cone, seen from its apex.
    fn part(&self, wall: &WallSegment) -> Option<(Vector, Vector)> {
        let whole = (wall.start - self.apex, wall.end - self.apex);
        let [left, right] = self.normals;
        cut(whole, left).and_then(|part| cut(part, right))
    }
}

/// Returns the part of a segment on the side of a line through the origin to which `normal` points.
fn cut((start, end): (Vector, Vector), normal: Vector) -> Option<(Vector, Vector)> {
    let (from_start, from_end) = (start.dot(&normal), end.dot(&normal));
    if from_start < 0.0 && from_end < 0.0 {
        return None;
    }
    let crossing = || start + (end - start) * (from_start / (from_start - from_end));
    Some(match (from_start < 0.0, from_end < 0.0) {
        (true, _) => (crossing(), end),
        (_, true) => (start, crossing()),
        _ => (start, end),
    })
}

fn nearest_to_origin(start: Vector, end: Vector) -> Vector {
    nearest_on_segment(Point::origin(), start.into(), end.into()).coords
}

/// Returns the angle between the direction to a point of a wall and the wall's normal, rad; 0 if it
/// is undefined.
fn incidence(point: Vector, along: Vector) -> f64 {
    let product = point.norm() * along.norm();
    if product <= 0.0 {
        return 0.0;
    }
    libm::asin((point.dot(&along).abs() / product).min(1.0))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::Heading;

    use super::*;

    const HALF_WIDTH: f64 = 7.5 * core::f64::consts::PI / 180.0;
    /// Distance between two of the oracle's points on a wall, m.
    const SPACING: f64 = 1e-3;

    /// Returns the nearest of many points along the walls within the cone.
    fn brute_force(mount: Pose, walls: &[WallSegment]) -> f64 {
        let points = walls.iter().flat_map(|wall| {
            let along = wall.end - wall.start;
            let count = (along.norm() / SPACING).ceil() as u32;
            (0..=count).map(move |index| wall.start + along * (f64::from(index) / f64::from(count)))
        });
        let heard = points
            .map(|point| point - mount.position)
            .filter(|way| mount.heading.turn_to(Heading::of(*way)).abs() <= HALF_WIDTH);
        heard.map(|way| way.norm()).fold(f64::INFINITY, f64::min)
    }

    /// Returns whether the nearest point is on a wall and in the cone, so that no nonexistent echo
    /// is heard.
    fn is_there(mount: Pose, walls: &[WallSegment], echo: ConeEcho) -> bool {
        let count = 4000;
        let bearings =
            (0..=count).map(|index| HALF_WIDTH * (2.0 * f64::from(index) / f64::from(count) - 1.0));
        let mut points = bearings
            .map(|bearing| mount.position + mount.heading.turned(bearing).unit() * echo.range);
        // From one of these points to the next it is this far.
        let step = 2.0 * HALF_WIDTH * echo.range / f64::from(count);
        points.any(|point| walls.iter().any(|wall| wall.distance(point) <= step + 1e-9))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// The reading is the oracle's up to its spacing. The oracle alone may miss a piece of wall
        /// shorter than that.
        #[test]
        fn the_reading_is_that_of_brute_force(
            ends in prop::collection::vec((-3.0..3.0, -3.0..3.0, -3.0..3.0, -3.0..3.0), 1..8),
            at in (-2.0..2.0, -2.0..2.0, -3.1..3.1),
        ) {
            let walls: Vec<WallSegment> = ends.into_iter()
                .map(|(a, b, c, d)| WallSegment::between(Point::new(a, b), Point::new(c, d)))
                .filter(|wall| (wall.end - wall.start).norm() > 0.01)
                .collect();
            let mount = Pose::new(Point::new(at.0, at.1), Heading::from_radians(at.2));
            let oracle = brute_force(mount, &walls);
            match Cone::new(mount, HALF_WIDTH).nearest(&walls) {
                None => prop_assert!(oracle.is_infinite(), "unheard at {oracle} m"),
                Some(echo) => {
                    prop_assert!(echo.range <= oracle + 1e-9, "{echo:?}, {oracle}");
                    prop_assert!(oracle - echo.range <= SPACING || is_there(mount, &walls, echo));
                }
            }
        }
    }

    #[test]
    fn a_wall_aslant_is_heard_at_the_edge_of_the_cone() {
        let wall = WallSegment::between(Point::new(0.0, 1.0), Point::new(10.0, 1.0));
        let mount = Pose::new(Point::origin(), Heading::from_degrees(30.0));
        let echo = Cone::new(mount, HALF_WIDTH).nearest(&[wall]).unwrap();
        assert!((echo.range - 1.0 / libm::sin(37.5_f64.to_radians())).abs() < 1e-12);
        assert!((echo.incidence.to_degrees() - 52.5).abs() < 1e-9);
    }

    #[test]
    fn what_is_behind_or_beside_is_not_heard() {
        let walls = [
            WallSegment::between(Point::new(-1.0, -5.0), Point::new(-1.0, 5.0)),
            WallSegment::between(Point::new(1.0, 0.2), Point::new(2.0, 3.0)),
        ];
        let mount = Pose::new(Point::origin(), Heading::EAST);
        assert_eq!(Cone::new(mount, HALF_WIDTH).nearest(&walls), None);
    }
}
