use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Vector};
use tolman_robot::Scan;

use super::WallGrid;

/// Position at which a scan fits the walls, near where it was expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ScanFit {
    /// The position.
    pub(super) at: Point,
    /// Its variance along each axis, m²: as before along an axis on which the walls tell nothing.
    pub(super) variance: Vector,
    /// How well the compared beams meet walls, 0 to 1; 1 if none could be compared.
    pub(super) agreement: f64,
}

/// Distance from every wall beyond which a beam's end does not fit at all, m.
const ELSEWHERE: f64 = 0.15;
/// Weight of one beam: beams see the same walls, so they are not independent.
const SHARE_OF_A_BEAM: f64 = 0.3;
/// Maximum distance of a beam's expected end from a known wall for it to be compared, m. Unknown
/// ground has no influence.
const COMPARED_WITHIN: f64 = 0.08;
/// Spacing of the positions tried, m.
const STEP: f64 = 0.0125;
/// Spacing of the positions tried first, m: less than the error of a beam's end.
const COARSE: f64 = 0.05;
/// Minimum half-width of the tried positions along an axis, m.
const LEAST_WINDOW: f64 = 0.1;
/// Standard deviation, m, above which an axis tells nothing.
const TELLS: f64 = 0.05;
/// Minimum standard deviation of a position, m.
const SUREST: f64 = 0.005;
/// Fewest beams that can be compared.
const FEWEST: usize = 10;

/// Fits a scan to the walls of `grid` and returns the position. It is expected with `variance`
/// along each axis, m², and at most `farthest` m away. O(positions tried · beams).
pub(super) fn fit(
    grid: &WallGrid,
    expected: Point,
    variance: Vector,
    farthest: f64,
    heading: Heading,
    scan: &Scan,
) -> ScanFit {
    let variance = variance.map(|variance| variance.max(SUREST * SUREST));
    let ends = comparable(grid, expected, heading, scan);
    let rays = rays(expected, heading, scan);
    let as_expected = ScanFit {
        at: expected,
        variance,
        agreement: 1.0,
    };
    if ends.len() < FEWEST || farthest < 2.0 * STEP {
        return as_expected;
    }
    let score = |shift: Vector| ends_score(grid, &ends, shift) - crossings(grid, &rays, shift);
    let window = variance.map(|variance| (3.0 * libm::sqrt(variance)).clamp(2.0 * STEP, farthest));
    let total = |shift: Vector| {
        let prior = 0.5 * (shift.x * shift.x / variance.x + shift.y * shift.y / variance.y);
        SHARE_OF_A_BEAM * score(shift) - prior
    };
    // First on a wide mesh, then on a narrow one round the best.
    let coarse = best_of(Vector::zeros(), window, COARSE, total);
    let shift = best_of(coarse, Vector::new(COARSE, COARSE), STEP, total);
    let [x, y] = [0, 1].map(|axis| {
        let steps = (window[axis].max(LEAST_WINDOW) / STEP) as i32;
        along(score, shift, axis, steps, variance[axis])
    });
    ScanFit {
        at: expected + Vector::new(x.0, y.0),
        variance: Vector::new(x.1, y.1),
        agreement: ends_score(grid, &ends, shift) / ends.len() as f64,
    }
}

/// Returns the best of the shifts within `window` of `centre`, on a mesh of this width.
fn best_of(centre: Vector, window: Vector, mesh: f64, total: impl Fn(Vector) -> f64) -> Vector {
    let [columns, rows] = [window.x, window.y].map(|window| libm::ceil(window / mesh) as i32);
    let mut best = (f64::NEG_INFINITY, centre);
    for row in -rows..=rows {
        for column in -columns..=columns {
            let shift = centre + Vector::new(f64::from(column), f64::from(row)) * mesh;
            let total = total(shift);
            if total > best.0 {
                best = (total, shift);
            }
        }
    }
    best.1
}

/// Returns the shift along one axis and its variance, given the other shift: the posterior's mean,
/// or the prior's if the walls give no evidence.
fn along(
    score: impl Fn(Vector) -> f64,
    best: Vector,
    axis: usize,
    steps: i32,
    variance: f64,
) -> (f64, f64) {
    let score = |value: f64| {
        let mut shift = best;
        shift[axis] = value;
        SHARE_OF_A_BEAM * score(shift)
    };
    let top = score(best[axis]);
    let mut seen = Moments::default();
    let mut posterior = Moments::default();
    for step in -steps..=steps {
        let value = f64::from(step) * STEP;
        let log = score(value) - top;
        seen.add(value, libm::exp(log));
        let prior = 0.5 * value * value / variance;
        posterior.add(value, libm::exp(log - prior));
    }
    if seen.variance() > TELLS * TELLS || posterior.weight <= 0.0 {
        return (0.0, variance);
    }
    (posterior.mean(), posterior.variance().max(1e-4))
}

#[derive(Default)]
struct Moments {
    weight: f64,
    first: f64,
    second: f64,
}

impl Moments {
    fn add(&mut self, value: f64, weight: f64) {
        self.weight += weight;
        self.first += weight * value;
        self.second += weight * value * value;
    }

    fn mean(&self) -> f64 {
        self.first / self.weight
    }

    fn variance(&self) -> f64 {
        self.second / self.weight - self.mean() * self.mean()
    }
}

/// Returns the ends of the beams that can be compared with the walls.
fn comparable(grid: &WallGrid, expected: Point, heading: Heading, scan: &Scan) -> Vec<Point> {
    let ends = (0..).zip(&scan.ranges).filter_map(|(index, range)| {
        let bearing = heading.turned(scan.ring.bearing(index));
        let end = expected + bearing.unit() * *range;
        let compared = *range < scan.ring.max_range
            && (grid.is_known(end)
                || grid
                    .wall_distance(end)
                    .is_some_and(|wall| wall < COMPARED_WITHIN));
        compared.then_some(end)
    });
    ends.collect()
}

/// Distance before its end by which a beam must pass a known wall to contradict the position, m.
const PASSED: f64 = 0.15;
/// Spacing of the points at which beams are tried for walls, m: no wall is passed unseen but at a
/// corner.
const RAY_STEP: f64 = 0.06;

/// Returns where every other beam passes, beam by beam.
fn rays(expected: Point, heading: Heading, scan: &Scan) -> Vec<Vec<Point>> {
    let ray = |(index, range): (u32, &f64)| {
        let unit = heading.turned(scan.ring.bearing(index)).unit();
        let steps = ((range - PASSED) / RAY_STEP).max(0.0) as u32;
        (3..=steps)
            .map(|step| expected + unit * (f64::from(step) * RAY_STEP))
            .collect()
    };
    (0..).zip(&scan.ranges).step_by(2).map(ray).collect()
}

/// Returns how many beams pass through walls.
fn crossings(grid: &WallGrid, rays: &[Vec<Point>], shift: Vector) -> f64 {
    let crosses = |ray: &&Vec<Point>| ray.iter().any(|at| grid.is_wall(*at + shift));
    2.0 * rays.iter().filter(crosses).count() as f64
}

fn ends_score(grid: &WallGrid, ends: &[Point], shift: Vector) -> f64 {
    let score = |end: &Point| {
        grid.wall_distance(*end + shift).map_or(0.0, |distance| {
            // Tukey's biweight.
            let off = (distance / ELSEWHERE).min(1.0);
            (1.0 - off * off) * (1.0 - off * off)
        })
    };
    ends.iter().map(score).sum()
}
