use core::f64::consts::{FRAC_PI_2, PI, TAU};

use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::Ring;

use crate::Wall;

/// Beams are padded to a multiple of this many, so that lanes need no remainder.
pub(super) const LANES: usize = 4;

/// The beams of a ring from one point of the world, and how far each has got: a depth buffer of one
/// dimension.
///
/// [`aim`](Self::aim) makes every beam as long as the ring's range; what then is met shortens it.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_robot::Ring;
/// use tolman_sim::Wall;
/// use tolman_sim::casters::Sweep;
///
/// let mut sweep = Sweep::new(Ring::full(4, 5.0));
/// sweep.aim(Pose::new(Point::new(1.0, 1.0), Heading::NORTH));
/// sweep.meet_wall(&Wall::between(Point::new(3.0, 0.0), Point::new(3.0, 2.0)));
/// // Beam 3 looks right, and right of north is east.
/// assert!((sweep.ranges()[3] - 2.0).abs() < 1e-12);
/// assert_eq!(sweep.ranges()[0], 5.0);
/// ```
#[derive(Clone, Debug)]
pub struct Sweep {
    ring: Ring,
    /// Unit vectors in the robot's frame.
    local: Directions,
    /// Unit vectors in the world.
    pub(super) world: Directions,
    pub(super) ranges: Vec<f64>,
    pub(super) origin: Point,
    /// Bearing of beam 0 in the world, rad.
    first: f64,
    /// Beams per radian; 0 for a single beam, which everything is tried on.
    density: f64,
    /// Beams to a full circle, a whole number or not.
    circle: f64,
    /// How many beams the approximate bearings may be off.
    margin: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Directions {
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
}

/// A wall as seen from the origin of a sweep: its ends counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(super) right: Vector,
    pub(super) left: Vector,
    /// Twice the area between origin and wall.
    pub(super) area: f64,
}

impl Seen {
    #[inline(always)]
    pub(crate) fn new(start: Vector, end: Vector) -> Self {
        let area = start.perp(&end);
        if area < 0.0 {
            Self {
                right: end,
                left: start,
                area: -area,
            }
        } else {
            Self {
                right: start,
                left: end,
                area,
            }
        }
    }

    /// How far a beam goes to meet it; infinity if it does not.
    ///
    /// On which side of the beam an end lies is computed from that end alone, so two walls that
    /// share one agree on it and leave no gap.
    #[inline(always)]
    pub(crate) fn range(&self, x: f64, y: f64) -> f64 {
        let right = x * self.right.y - y * self.right.x;
        let left = x * self.left.y - y * self.left.x;
        let between = left - right;
        let range = self.area / between;
        let meets = (right <= 0.0) & (left >= 0.0) & (between > 0.0);
        if meets { range } else { f64::INFINITY }
    }
}

impl Sweep {
    /// The beams of `ring`, of which there must be one at least.
    #[must_use]
    pub fn new(ring: Ring) -> Self {
        let count = ring.beams as usize;
        let units: Vec<Vector> = (0..count.next_multiple_of(LANES))
            .map(|beam| Heading::from_radians(ring.bearing(beam.min(count - 1) as u32)).unit())
            .collect();
        let local = Directions {
            x: units.iter().map(|unit| unit.x).collect(),
            y: units.iter().map(|unit| unit.y).collect(),
        };
        let single = count == 1;
        let density = if single { 0.0 } else { ring.spacing.recip() };
        Self {
            ring,
            world: local.clone(),
            ranges: vec![ring.max_range; local.x.len()],
            local,
            origin: Point::origin(),
            first: ring.first_bearing,
            density,
            circle: if single { 1.0 } else { TAU * density },
            margin: 0.01 + 2.0 * BEARING_ERROR * density,
        }
    }

    /// Points the beams from the origin of `pose`, turned to its heading, at their full range.
    #[inline(always)]
    pub fn aim(&mut self, pose: Pose) {
        let ahead = pose.heading.unit();
        self.origin = pose.position;
        self.first = pose.heading.turned(self.ring.first_bearing).radians();
        let local = self.local.x.iter().zip(&self.local.y);
        let world = self.world.x.iter_mut().zip(&mut self.world.y);
        for ((x, y), (world_x, world_y)) in local.zip(world) {
            *world_x = ahead.x * x - ahead.y * y;
            *world_y = ahead.y * x + ahead.x * y;
        }
        self.ranges.fill(self.ring.max_range);
    }

    /// The point all beams start from.
    #[must_use]
    pub fn origin(&self) -> Point {
        self.origin
    }

    /// The ring the beams are of.
    #[must_use]
    pub fn ring(&self) -> Ring {
        self.ring
    }

    /// How many beams there are.
    #[must_use]
    pub fn beams(&self) -> usize {
        self.ring.beams as usize
    }

    /// The unit vector of a beam in the world.
    #[must_use]
    pub fn direction(&self, beam: usize) -> Vector {
        Vector::new(self.world.x[beam], self.world.y[beam])
    }

    /// How far each beam has got, m.
    #[must_use]
    pub fn ranges(&self) -> &[f64] {
        &self.ranges[..self.ring.beams as usize]
    }

    /// How far a beam has got, m.
    #[must_use]
    pub fn range(&self, beam: usize) -> f64 {
        self.ranges[beam]
    }

    /// Lets a beam end at `range` unless it ends before.
    pub fn shorten(&mut self, beam: usize, range: f64) {
        let old = &mut self.ranges[beam];
        *old = old.min(range);
    }

    /// Shortens the beams that meet `wall`.
    pub fn meet_wall(&mut self, wall: &Wall) {
        let (start, end) = (wall.start - self.origin, wall.end - self.origin);
        let seen = Seen::new(start, end);
        if seen.area <= 0.0 {
            self.meet_edge_on(wall);
            return;
        }
        let from = self.index(bearing(seen.right.x, seen.right.y));
        let to = self.index(bearing(seen.left.x, seen.left.y));
        self.meet_seen(&seen, from, to);
    }

    /// Shortens the beams between two indices that meet `seen`.
    #[inline(always)]
    pub(super) fn meet_seen(&mut self, seen: &Seen, from: f64, to: f64) {
        let span = self.span(from, to);
        for (first, past) in self.chunks(from, span) {
            let x = &self.world.x.as_chunks::<LANES>().0[first..past];
            let y = &self.world.y.as_chunks::<LANES>().0[first..past];
            let ranges = &mut self.ranges.as_chunks_mut::<LANES>().0[first..past];
            for ((x, y), ranges) in x.iter().zip(y).zip(ranges) {
                for lane in 0..LANES {
                    let range = seen.range(x[lane], y[lane]);
                    ranges[lane] = if range < ranges[lane] {
                        range
                    } else {
                        ranges[lane]
                    };
                }
            }
        }
    }

    /// A wall in line with the origin is met by beams that run along it, and by all if the origin
    /// lies on it.
    #[cold]
    pub(super) fn meet_edge_on(&mut self, wall: &Wall) {
        for beam in 0..self.ranges.len() {
            let range = wall.ray(
                self.origin,
                Vector::new(self.world.x[beam], self.world.y[beam]),
            );
            self.shorten(beam, range);
        }
    }

    /// Shortens the beams that meet a disc from outside.
    pub fn meet_disc(&mut self, centre: Point, radius: f64) {
        let to_centre = centre - self.origin;
        let farthest = self.ring.max_range + radius;
        let square = to_centre.norm_squared();
        if square > farthest * farthest || square <= radius * radius {
            return;
        }
        let distance = square.sqrt();
        let share = radius / distance;
        // A bound from above of the arc sine: its series with all later terms in the cube.
        let half = share * (1.0 + (FRAC_PI_2 - 1.0) * share * share);
        let middle = bearing(to_centre.x, to_centre.y);
        let from = self.index(middle - half);
        let span = 2.0 * half * self.density + 2.0 * self.margin;
        let apart = distance * distance - radius * radius;
        for (first, past) in self.chunks(from, span) {
            for beam in first * LANES..past * LANES {
                let (x, y) = (self.world.x[beam], self.world.y[beam]);
                let ahead = x * to_centre.x + y * to_centre.y;
                let square = ahead * ahead - apart;
                if ahead > 0.0 && square >= 0.0 {
                    // The nearer root, without cancellation.
                    self.shorten(beam, apart / (ahead + square.sqrt()));
                }
            }
        }
    }

    /// The place among the beams, in [0, circle), of a bearing in the world, less the margin.
    #[inline(always)]
    pub(super) fn index(&self, bearing: f64) -> f64 {
        let mut index = (bearing - self.first) * self.density - self.margin;
        // Two bearings are less than two circles apart.
        for _ in 0..2 {
            index += if index < 0.0 { self.circle } else { 0.0 };
        }
        index
    }

    /// The chunks that hold all beams of a quadrant (0 south-west, then counter-clockwise), and some
    /// others.
    #[inline(always)]
    pub(super) fn quadrant(&self, quadrant: u32) -> [(usize, usize); 2] {
        let from = self.index(f64::from(quadrant) * FRAC_PI_2 - PI);
        self.chunks(from, FRAC_PI_2 * self.density + 2.0 * self.margin)
    }

    /// How many beams lie between two indices, a margin on both sides included.
    #[inline(always)]
    fn span(&self, from: f64, to: f64) -> f64 {
        let span = to - from;
        let span = if span < 0.0 { span + self.circle } else { span };
        // A wall covers less than half a circle. More than that is a wall seen edge on, its ends in
        // the wrong order by the error of the bearings.
        let span = if span > 0.75 * self.circle { 0.0 } else { span };
        span + 2.0 * self.margin
    }

    /// The chunks of beams, first and one past the last, from index `from` over `span`; twice, for a span
    /// that runs across the seam of the circle.
    #[inline(always)]
    fn chunks(&self, from: f64, span: f64) -> [(usize, usize); 2] {
        let end = self.ranges.len() / LANES;
        [from, from - self.circle].map(|from| {
            // Beams before the span are tried in vain.
            let first = from.max(0.0) as u32 as usize / LANES;
            let past = ((from + span + LANES as f64).max(0.0) as u32 as usize / LANES).min(end);
            (first.min(past), past)
        })
    }
}

/// How far [`bearing`] may be off, rad.
const BEARING_ERROR: f64 = 2e-5;

/// The direction of a vector to within [`BEARING_ERROR`]: enough to choose which beams to try.
#[inline(always)]
pub(super) fn bearing(x: f64, y: f64) -> f64 {
    let (across, along) = (x.abs(), y.abs());
    let steep = along > across;
    let (small, large) = if steep {
        (across, along)
    } else {
        (along, across)
    };
    let t = small / large.max(f64::MIN_POSITIVE);
    let s = t * t;
    // Minimax polynomial of the arc tangent on [0, 1].
    let atan = t
        * (0.999_977_26
            + s * (-0.332_623_47
                + s * (0.193_543_46 + s * (-0.116_432_87 + s * (0.052_653_32 - s * 0.011_721_2)))));
    let octant = if steep { FRAC_PI_2 - atan } else { atan };
    let half = if x < 0.0 { PI - octant } else { octant };
    if y < 0.0 { -half } else { half }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn approximate_bearings_are_as_good_as_they_say() {
        for step in -100_000..=100_000 {
            let exact = f64::from(step) * PI / 100_000.0;
            let (sin, cos) = libm::sincos(exact);
            let off = (bearing(3.0 * cos, 3.0 * sin) - exact).abs();
            assert!(
                off < BEARING_ERROR || (off - TAU).abs() < BEARING_ERROR,
                "{exact}: {off}"
            );
        }
        assert!(bearing(0.0, 0.0).is_finite());
    }
}
