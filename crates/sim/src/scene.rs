use nalgebra::Isometry2;
use tolman_geom::{Point, Pose, Vector};
use tolman_robot::Body;

use crate::casters::BeamSweep;
use crate::{WallSegment, World};

/// Everything that a body can meet at one moment: the world's walls, the shut doors, and the bodies
/// of all robots.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene<'a> {
    pub(crate) world: &'a World,
    pub(crate) shut: &'a [WallSegment],
    pub(crate) bodies: &'a Crowd,
}

/// The bodies of all robots.
#[derive(Clone, Debug, Default)]
pub(crate) struct Crowd {
    bodies: Vec<Placed>,
    /// Disc round each body, stored together to find bodies out of reach quickly.
    discs: Vec<Disc>,
}

/// Centre and radius.
pub(crate) type Disc = (Point, f64);

impl Crowd {
    pub(crate) fn push(&mut self, body: Placed) {
        self.discs.push(body.disc());
        self.bodies.push(body);
    }

    /// Returns all bodies in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Placed> {
        self.bodies.iter()
    }

    pub(crate) fn body(&self, robot: usize) -> &Placed {
        &self.bodies[robot]
    }

    /// Lets `change` move or replace a body.
    pub(crate) fn change<R>(&mut self, robot: usize, change: impl FnOnce(&mut Placed) -> R) -> R {
        let result = change(&mut self.bodies[robot]);
        self.discs[robot] = self.bodies[robot].disc();
        result
    }

    /// Returns the bodies of all robots but `robot` that come within `reach` of `centre`.
    pub(crate) fn near(
        &self,
        robot: usize,
        centre: Point,
        reach: f64,
    ) -> impl Iterator<Item = &Placed> {
        let is_near = move |disc: &Disc| {
            let (x, y, reach) = (disc.0.x - centre.x, disc.0.y - centre.y, disc.1 + reach);
            x * x + y * y <= reach * reach
        };
        let near = self
            .discs
            .iter()
            .enumerate()
            .filter(move |(_, disc)| is_near(disc));
        near.filter(move |(other, _)| *other != robot)
            .map(|(other, _)| &self.bodies[other])
    }
}

/// Number of sides of a disc where it counts as a polygon.
const DISC_SIDES: u32 = 24;

/// A body somewhere.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    body: Body,
    pose: Pose,
    radius: f64,
    /// A polygon's corners in the world.
    corners: Vec<Point>,
}

impl Placed {
    pub(crate) fn new(body: Body, pose: Pose) -> Self {
        let radius = body.radius();
        let mut placed = Self {
            body,
            pose,
            radius,
            corners: Vec::new(),
        };
        placed.move_to(pose);
        placed
    }

    pub(crate) fn move_to(&mut self, pose: Pose) {
        self.pose = pose;
        if let Body::Polygon { corners } = &self.body {
            self.corners.clear();
            let world_from_robot = Isometry2::from(pose);
            let turned = corners.iter().map(|corner| world_from_robot * corner);
            self.corners.extend(turned);
        }
    }

    pub(crate) fn pose(&self) -> Pose {
        self.pose
    }

    /// Returns the smallest disc round the pose that holds the body.
    pub(crate) fn disc(&self) -> Disc {
        (self.pose.position, self.radius)
    }

    /// Returns the radius of that disc.
    pub(crate) fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns a polygon's corners in the world; none for a disc.
    pub(crate) fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// Returns a polygon's sides in the world; none for a disc.
    pub(crate) fn sides(&self) -> impl Iterator<Item = WallSegment> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners
            .iter()
            .zip(next)
            .map(|(start, end)| WallSegment::between(*start, *end))
    }

    /// Returns a polygon's sides; of a disc, those of the regular polygon round it.
    pub(crate) fn outline(&self) -> Vec<WallSegment> {
        if !self.corners.is_empty() {
            return self.sides().collect();
        }
        let step = core::f64::consts::TAU / f64::from(DISC_SIDES);
        let corner = |index: u32| {
            let (sin, cos) = libm::sincos(f64::from(index) * step);
            self.pose.position + Vector::new(cos, sin) * (self.radius / libm::cos(0.5 * step))
        };
        let sides =
            (0..DISC_SIDES).map(|index| WallSegment::between(corner(index), corner(index + 1)));
        sides.collect()
    }

    /// Returns whether `point` lies in a polygon; never in a disc, which has no sides.
    pub(crate) fn encloses(&self, point: Point) -> bool {
        !self.corners.is_empty()
            && self
                .sides()
                .all(|side| (side.end - side.start).perp(&(point - side.start)) >= 0.0)
    }

    /// Shortens the beams of `sweep` that meet the body from outside.
    pub(crate) fn shorten(&self, sweep: &mut BeamSweep) {
        if self.corners.is_empty() {
            sweep.meet_disc(self.pose.position, self.radius);
        } else {
            for side in self.sides() {
                sweep.meet_wall(&side);
            }
        }
    }

    /// Returns the distance along a ray to the body, m, from outside; infinity if it misses.
    pub(crate) fn ray(&self, origin: Point, direction: Vector) -> f64 {
        if self.corners.is_empty() {
            let to_centre = self.pose.position - origin;
            let ahead = direction.dot(&to_centre);
            let aside = direction.perp(&to_centre);
            let square = self.radius * self.radius - aside * aside;
            if square < 0.0 {
                return f64::INFINITY;
            }
            let range = ahead - square.sqrt();
            return if range >= 0.0 { range } else { f64::INFINITY };
        }
        self.sides()
            .map(|side| side.ray(origin, direction))
            .fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The outline touches the disc on every side and cuts nothing off.
    #[test]
    fn the_outline_of_a_disc_runs_round_it() {
        let centre = Point::new(1.0, -2.0);
        let pose = Pose::new(centre, tolman_geom::Heading::NORTH);
        let outline = Placed::new(Body::Circle { radius: 0.25 }, pose).outline();
        assert_eq!(outline.len(), 24);
        for side in outline {
            assert!((side.distance(centre) - 0.25).abs() < 1e-12);
            assert!((side.start - centre).norm() < 0.25 * 1.01);
        }
    }
}
