use core::f64::consts::{FRAC_PI_2, PI, TAU};

use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::Ring;

use crate::WallSegment;

/// Multiple to which the number of beams is padded, so that lanes need no remainder.
pub(super) const LANES: usize = 4;

/// The beams of a ring from one point of the world, and their ranges so far: a depth buffer of one
/// dimension.
///
/// [`aim`](Self::aim) gives every beam the ring's range; obstacles then shorten it.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_robot::Ring;
/// use tolman_sim::WallSegment;
/// use tolman_sim::casters::BeamSweep;
///
/// let mut sweep = BeamSweep::new(Ring::full(4, 5.0));
/// sweep.aim(Pose::new(Point::new(1.0, 1.0), Heading::NORTH));
/// sweep.meet_wall(&WallSegment::between(Point::new(3.0, 0.0), Point::new(3.0, 2.0)));
/// // Beam 3 looks right, and right of north is east.
/// assert!((sweep.range(3) - 2.0).abs() < 1e-12);
/// assert_eq!(sweep.range(0), 5.0);
/// ```
#[derive(Clone, Debug)]
pub struct BeamSweep {
    ring: Ring,
    /// The beams in the robot's frame, at their full range.
    local: Vec<Chunk>,
    pub(super) chunks: Vec<Chunk>,
    pub(super) origin: Point,
    pub(super) order: Order,
}

/// A few beams: unit vectors in the world, and their lengths so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chunk {
    pub(super) x: [f64; LANES],
    pub(super) y: [f64; LANES],
    pub(super) range: [f64; LANES],
}

impl Chunk {
    /// Shortens the beams that meet a wall.
    #[inline(always)]
    fn meet(&mut self, seen: &Seen) {
        for lane in 0..LANES {
            let range = seen.range(self.x[lane], self.y[lane]);
            let nearest = self.range[lane];
            self.range[lane] = if range < nearest { range } else { nearest };
        }
    }
}

/// Order of the beams by direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Order {
    /// Bearing of beam 0 in the world, rad.
    first: f64,
    /// Number of beams per radian; 0 for a single beam, which is compared with everything.
    density: f64,
    /// Beams to a full circle, a whole number or not.
    circle: f64,
    /// Maximum error of the approximate bearings, in beams.
    margin: f64,
    /// Number of chunks.
    chunks: usize,
}

impl Order {
    /// Returns the position of a bearing among the beams, in [0, circle), less the margin. The
    /// bearing is in the world.
    #[inline(always)]
    pub(super) fn index(&self, bearing: f64) -> f64 {
        let index = (bearing - self.first) * self.density - self.margin;
        // Two bearings are less than two circles apart.
        let index = index + if index < 0.0 { self.circle } else { 0.0 };
        index + if index < 0.0 { self.circle } else { 0.0 }
    }

    /// Returns the chunks of beams between the indices of a wall's ends, first and one past the
    /// last. There are two ranges for a wall across the seam of the circle.
    #[inline(always)]
    pub(super) fn between(&self, from: f64, to: f64) -> [(usize, usize); 2] {
        let span = to - from;
        let span = if span < 0.0 { span + self.circle } else { span };
        // A wall covers less than half a circle. More than that is a wall seen edge on, its ends in
        // the wrong order by the error of the bearings.
        let span = if span > 0.75 * self.circle { 0.0 } else { span };
        self.over(from, span + 2.0 * self.margin)
    }

    /// Returns the chunks of beams from index `from` over `span`.
    #[inline(always)]
    fn over(&self, from: f64, span: f64) -> [(usize, usize); 2] {
        [from, from - self.circle].map(|from| {
            // Beams before the span are tried in vain.
            let first = from.max(0.0) as u32 as usize / LANES;
            let past = (from + span + LANES as f64).max(0.0) as u32 as usize / LANES;
            let past = past.min(self.chunks);
            (first.min(past), past)
        })
    }

    /// Returns the chunks that hold all beams of a quadrant (0 south-west, then counter-clockwise),
    /// and some others.
    #[inline(always)]
    pub(super) fn quadrant(&self, quadrant: u32) -> [(usize, usize); 2] {
        let from = self.index(f64::from(quadrant) * FRAC_PI_2 - PI);
        self.over(from, FRAC_PI_2 * self.density + 2.0 * self.margin)
    }
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

    /// Returns the distance at which a beam meets the wall, m; infinity if it does not.
    ///
    /// The side of the beam on which an end lies is computed from that end alone. So two walls that
    /// share an end agree on it and leave no gap.
    #[inline(always)]
    pub(crate) fn range(&self, x: f64, y: f64) -> f64 {
        let right = x * self.right.y - y * self.right.x;
        let left = x * self.left.y - y * self.left.x;
        let between = left - right;
        let range = self.area / between;
        // A beam through both ends meets them nowhere in particular: infinitely far, says the
        // quotient.
        let meets = (right <= 0.0) & (left >= 0.0);
        if meets { range } else { f64::INFINITY }
    }
}

impl BeamSweep {
    /// Returns the beams of `ring`, which must have at least one.
    #[must_use]
    pub fn new(ring: Ring) -> Self {
        let count = ring.beams as usize;
        // The last beam once more for every lane that is left over.
        let unit =
            |beam: usize| Heading::from_radians(ring.bearing(beam.min(count - 1) as u32)).unit();
        let local: Vec<Chunk> = (0..count.div_ceil(LANES))
            .map(|chunk| Chunk {
                x: core::array::from_fn(|lane| unit(chunk * LANES + lane).x),
                y: core::array::from_fn(|lane| unit(chunk * LANES + lane).y),
                range: [ring.max_range; LANES],
            })
            .collect();
        let single = count == 1;
        let density = if single { 0.0 } else { ring.spacing.recip() };
        let order = Order {
            first: ring.first_bearing,
            density,
            circle: if single { 1.0 } else { TAU * density },
            margin: 0.01 + 2.0 * BEARING_ERROR * density,
            chunks: local.len(),
        };
        Self {
            ring,
            chunks: local.clone(),
            local,
            origin: Point::origin(),
            order,
        }
    }

    /// Points the beams from the origin of `pose`, turned to its heading, at their full range.
    pub fn aim(&mut self, pose: Pose) {
        let ahead = pose.heading.unit();
        self.origin = pose.position;
        self.order.first = pose.heading.turned(self.ring.first_bearing).radians();
        for (local, chunk) in self.local.iter().zip(&mut self.chunks) {
            for lane in 0..LANES {
                let (x, y) = (local.x[lane], local.y[lane]);
                chunk.x[lane] = ahead.x * x - ahead.y * y;
                chunk.y[lane] = ahead.y * x + ahead.x * y;
            }
            chunk.range = local.range;
        }
    }

    /// Returns the point all beams start from.
    #[must_use]
    pub fn origin(&self) -> Point {
        self.origin
    }

    /// Returns the ring the beams are of.
    #[must_use]
    pub fn ring(&self) -> Ring {
        self.ring
    }

    /// Returns the number of beams.
    #[must_use]
    pub fn beams(&self) -> usize {
        self.ring.beams as usize
    }

    /// Returns the unit vector of a beam in the world.
    #[must_use]
    pub fn direction(&self, beam: usize) -> Vector {
        let chunk = &self.chunks[beam / LANES];
        Vector::new(chunk.x[beam % LANES], chunk.y[beam % LANES])
    }

    /// Returns the range of each beam so far, m.
    pub fn ranges(&self) -> impl Iterator<Item = f64> + '_ {
        self.chunks
            .iter()
            .flat_map(|chunk| chunk.range)
            .take(self.beams())
    }

    /// Returns the range of a beam so far, m.
    #[must_use]
    pub fn range(&self, beam: usize) -> f64 {
        self.chunks[beam / LANES].range[beam % LANES]
    }

    /// Lets a beam end at `range` unless it ends before.
    pub fn shorten(&mut self, beam: usize, range: f64) {
        let old = &mut self.chunks[beam / LANES].range[beam % LANES];
        *old = old.min(range);
    }

    /// Shortens every beam to the range that `meets` returns for its direction and its range so
    /// far.
    pub fn shorten_each(&mut self, meets: impl Fn(Vector, f64) -> f64) {
        for beam in 0..self.beams() {
            let range = meets(self.direction(beam), self.range(beam));
            self.shorten(beam, range);
        }
    }

    /// Shortens the beams that meet `wall`.
    pub fn meet_wall(&mut self, wall: &WallSegment) {
        let seen = Seen::new(wall.start - self.origin, wall.end - self.origin);
        if seen.area <= 0.0 {
            self.meet_edge_on(wall);
            return;
        }
        let from = self.order.index(bearing(seen.right.x, seen.right.y));
        let to = self.order.index(bearing(seen.left.x, seen.left.y));
        self.meet_seen(&seen, from, to);
    }

    /// Shortens the beams between two indices that meet `seen`.
    #[inline(always)]
    pub(super) fn meet_seen(&mut self, seen: &Seen, from: f64, to: f64) {
        for (first, past) in self.order.between(from, to) {
            for chunk in &mut self.chunks[first..past] {
                chunk.meet(seen);
            }
        }
    }

    /// Shortens the beams for a wall in line with the origin: those that run along it, or all if
    /// the origin lies on it.
    #[cold]
    pub(super) fn meet_edge_on(&mut self, wall: &WallSegment) {
        let origin = self.origin;
        self.shorten_each(|direction, _| wall.ray(origin, direction));
    }

    /// Shortens the beams that meet a disc from outside.
    pub fn meet_disc(&mut self, centre: Point, radius: f64) {
        let to_centre = centre - self.origin;
        let farthest = self.ring.max_range + radius;
        let square = to_centre.norm_squared();
        if square > farthest * farthest || square <= radius * radius {
            return;
        }
        let share = radius / square.sqrt();
        // A bound from above of the arc sine: its series with all later terms in the cube.
        let half = share * (1.0 + (FRAC_PI_2 - 1.0) * share * share);
        let from = self.order.index(bearing(to_centre.x, to_centre.y) - half);
        let span = 2.0 * (half * self.order.density + self.order.margin);
        let apart = square - radius * radius;
        for (first, past) in self.order.over(from, span) {
            for chunk in &mut self.chunks[first..past] {
                for lane in 0..LANES {
                    let ahead = chunk.x[lane] * to_centre.x + chunk.y[lane] * to_centre.y;
                    let root = ahead * ahead - apart;
                    if ahead > 0.0 && root >= 0.0 {
                        // The nearer root, without cancellation.
                        let range = apart / (ahead + root.sqrt());
                        chunk.range[lane] = chunk.range[lane].min(range);
                    }
                }
            }
        }
    }
}

/// Maximum error of [`bearing`], rad.
const BEARING_ERROR: f64 = 2e-5;

/// Returns the direction of a vector to within [`BEARING_ERROR`]: enough to choose which beams to
/// try.
#[inline(always)]
pub(super) fn bearing(x: f64, y: f64) -> f64 {
    let (across, along) = (x.abs(), y.abs());
    let small = if along < across { along } else { across };
    let large = if along < across { across } else { along };
    let t = small / (large + f64::MIN_POSITIVE);
    let s = t * t;
    // Minimax polynomial of the arc tangent on [0, 1].
    let atan = t
        * (0.999_977_26
            + s * (-0.332_623_47
                + s * (0.193_543_46 + s * (-0.116_432_87 + s * (0.052_653_32 - s * 0.011_721_2)))));
    // The other octants by reflection; choosing between constants leaves lanes together.
    let steep = along > across;
    let octant = if steep { FRAC_PI_2 } else { 0.0 } + if steep { -1.0 } else { 1.0 } * atan;
    let behind = x < 0.0;
    let half = if behind { PI } else { 0.0 } + if behind { -1.0 } else { 1.0 } * octant;
    half.copysign(y)
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
