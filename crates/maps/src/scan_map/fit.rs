use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Vector};
use tolman_robot::Scan;

use super::WallGrid;

/// Position at which a scan fits the walls, near the expected one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ScanFit {
    /// Position at which the scan fits best, m.
    pub(super) at: Point,
    /// Variance of the position along each axis, m². It is unchanged along an axis on which the
    /// walls give no evidence.
    pub(super) variance: Vector,
    /// Mean score of the compared beams' ends by their distance from walls, 0 to 1; 1 if no beam
    /// could be compared.
    pub(super) agreement: f64,
}

/// Distance from all walls beyond which a beam's end does not fit at all, m.
const ELSEWHERE: f64 = 0.15;
/// Weight of one beam relative to an independent one: beams see the same walls.
const SHARE_OF_A_BEAM: f64 = 0.3;
/// Maximum distance of a beam's expected end from a known wall for it to be compared, m. Unknown
/// ground has no influence.
const COMPARED_WITHIN: f64 = 0.08;
/// Distance to either side of a beam's expected end, along one of the axes, up to which the ground
/// has to be seen for the beam to be compared, m. A wall that is seen only in part would draw
/// scans from farther on back to its end.
const BESIDE: f64 = 0.15;
/// Spacing of the tried positions, m.
const STEP: f64 = 0.0125;
/// Spacing of the positions tried first, m: less than the error of a beam's end.
const COARSE: f64 = 0.05;
/// Minimum half-width of the tried positions along an axis, m.
const LEAST_WINDOW: f64 = 0.1;
/// Standard deviation of the posterior above which an axis gives no evidence, m.
const TELLS: f64 = 0.05;
/// Minimum standard deviation of a position, m.
const SUREST: f64 = 0.005;
/// Minimum number of beams that can be compared.
const FEWEST: usize = 10;

/// Fits a scan to the walls of `grid` and returns the position. The variance of the expected
/// position along each axis is `variance`, m². The result is at most `farthest` from it, m.
/// O(positions tried · beams).
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
    // The first search uses a wide mesh, the second a narrow one round the best shift.
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

/// Returns the best of the shifts within `window` of `centre`, m, on a mesh with this spacing, m.
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

/// Returns the ends of the beams that end near known walls.
fn comparable(grid: &WallGrid, expected: Point, heading: Heading, scan: &Scan) -> Vec<Point> {
    let ends = (0..).zip(&scan.ranges).filter_map(|(index, range)| {
        let bearing = heading.turned(scan.ring.bearing(index));
        let end = expected + bearing.unit() * *range;
        let is_seen_along = |axis: Vector| {
            let beside = axis * BESIDE;
            is_seen(grid, end - beside) && is_seen(grid, end + beside)
        };
        let compared = *range < scan.ring.max_range
            && is_seen(grid, end)
            && (is_seen_along(Vector::x()) || is_seen_along(Vector::y()));
        compared.then_some(end)
    });
    ends.collect()
}

/// Returns whether a beam has reached or passed this point, or a wall near it.
fn is_seen(grid: &WallGrid, at: Point) -> bool {
    let is_near = |wall| wall < COMPARED_WITHIN;
    grid.is_known(at) || grid.wall_distance(at).is_some_and(is_near)
}

/// Distance before its end by which a beam must pass a known wall to contradict the position, m.
const PASSED: f64 = 0.15;
/// Spacing of the points at which beams are tested for walls, m: small enough to miss walls only at
/// corners.
const RAY_STEP: f64 = 0.06;

/// Returns points along every other beam before it ends, beam by beam.
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

/// Returns the number of beams that pass through walls, if the rays are shifted by `shift`, m. A
/// ray stands for two beams.
fn crossings(grid: &WallGrid, rays: &[Vec<Point>], shift: Vector) -> f64 {
    let crosses = |ray: &&Vec<Point>| ray.iter().any(|at| grid.is_wall(*at + shift));
    2.0 * rays.iter().filter(crosses).count() as f64
}

fn ends_score(grid: &WallGrid, ends: &[Point], shift: Vector) -> f64 {
    let score = |end: &Point| {
        grid.wall_distance(*end + shift).map_or(0.0, |distance| {
            // The score is Tukey's biweight.
            let off = (distance / ELSEWHERE).min(1.0);
            (1.0 - off * off) * (1.0 - off * off)
        })
    };
    ends.iter().map(score).sum()
}

#[cfg(test)]
mod tests {
    use super::super::GroundKind;
    use super::super::wall_grid::GridIndex;
    use super::*;
    use tolman_robot::Ring;

    const HERE: Point = Point::new(1.025, 1.025);

    /// Returns a room of floor whose walls are the cells for which `is_wall` is true.
    fn room(is_wall: impl Fn(GridIndex) -> bool) -> WallGrid {
        WallGrid::of([[0, 0], [41, 41]], |index| match is_wall(index) {
            true => GroundKind::Wall,
            false => GroundKind::Floor,
        })
    }

    /// Returns the scan between two walls across the robot's heading, `ahead` and `back`, m, from
    /// it. Beams to the sides meet nothing.
    fn scan(ahead: f64, back: f64) -> Scan {
        let ring = Ring::full(96, 3.0);
        let mut scan = Scan::clear(ring);
        for (index, range) in (0..).zip(&mut scan.ranges) {
            let across = ring.bearing(index);
            let (along, length) = match libm::cos(across) {
                cos if cos > 0.5 => (cos, ahead),
                cos if cos < -0.5 => (-cos, back),
                _ => continue,
            };
            *range = (length / along).min(ring.max_range);
        }
        scan
    }

    fn near(found: f64, expected: f64, off: f64) -> bool {
        (found - expected).abs() < off
    }

    /// Two walls tell the robot's position across them, and nothing along them.
    #[test]
    fn walls_tell_the_axis_across_them() {
        // Their middles are 0.8 m to either side.
        let walls = room(|[_, row]| row == 4 || row == 36);
        let fit = |expected: Point, heading| {
            let sd = Vector::new(0.04, 0.06);
            fit(
                &walls,
                expected,
                sd.component_mul(&sd),
                0.3,
                heading,
                &scan(0.8, 0.8),
            )
        };
        for off in [-0.05, 0.0, 0.0375] {
            for heading in [Heading::NORTH, Heading::SOUTH] {
                let expected = HERE + Vector::new(0.01, off);
                let found = fit(expected, heading);
                assert!(near(found.at.y, HERE.y, 0.012), "{off}: {found:?}");
                assert!(near(found.at.x, expected.x, 1e-12), "{found:?}");
                assert!(near(found.variance.x, 0.04 * 0.04, 1e-12), "{found:?}");
                assert!(found.variance.y < 0.03 * 0.03, "{found:?}");
                assert!(found.agreement > 0.97, "{found:?}");
            }
        }
        let across = room(|[column, _]| column == 4 || column == 36);
        let expected = HERE + Vector::new(0.05, 0.0);
        let variance = Vector::new(0.0036, 0.0036);
        let scan = scan(0.8, 0.8);
        let found = super::fit(&across, expected, variance, 0.3, Heading::EAST, &scan);
        assert!(near(found.at.x, HERE.x, 0.012), "{found:?}");
        assert!(near(found.at.y, expected.y, 1e-12), "{found:?}");
        assert!(near(found.variance.y, 0.0036, 1e-12), "{found:?}");
    }

    /// Walls to both sides that are known up to 0.2 m ahead of the robot, and seen farther, do not
    /// draw it back.
    #[test]
    fn a_wall_known_in_part_does_not_draw_back() {
        let seen = |index: GridIndex| match index {
            [column, _] if column > 24 => GroundKind::Unknown,
            [_, 4 | 36] => GroundKind::Wall,
            _ => GroundKind::Floor,
        };
        let walls = WallGrid::of([[0, 0], [41, 41]], seen);
        let variance = Vector::new(0.0036, 0.0036);
        let scan = scan(0.8, 0.8);
        let found = fit(&walls, HERE, variance, 0.3, Heading::NORTH, &scan);
        assert!(near(found.at.x, HERE.x, 1e-12), "{found:?}");
        assert!(near(found.variance.x, 0.0036, 1e-12), "{found:?}");
        assert!(found.variance.y < 0.03 * 0.03, "{found:?}");
    }

    /// A robot that is sure of its position does not leave it for a misplaced wall.
    #[test]
    fn who_is_sure_stays() {
        let sure = Vector::new(1e-4, 1e-4);
        for (heading, is_row) in [(Heading::NORTH, true), (Heading::EAST, false)] {
            let walls = room(|index| index[usize::from(is_row)] == 38);
            // It stands 0.9 m before the wall and sees it 0.8 m ahead, and nothing behind.
            let found = fit(&walls, HERE, sure, 0.3, heading, &scan(0.8, 3.0));
            let off = (found.at - HERE).norm();
            assert!(off < 0.04, "{found:?}");
            assert!((0.1..0.7).contains(&found.agreement), "{found:?}");
            // Unsure, it goes there.
            let unsure = Vector::new(0.04, 0.04);
            let found = fit(&walls, HERE, unsure, 0.3, heading, &scan(0.8, 3.0));
            let along = (found.at - HERE)[usize::from(is_row)];
            assert!(near(along, 0.1, 0.02), "{found:?}");
            assert!(found.agreement > 0.95, "{found:?}");
            // But no farther than it may.
            let found = fit(&walls, HERE, unsure, 0.02, heading, &scan(0.8, 3.0));
            assert_eq!((found.at, found.agreement), (HERE, 1.0));
        }
    }

    #[test]
    fn what_cannot_be_compared_says_nothing() {
        let nothing = WallGrid::default();
        let variance = Vector::new(0.01, 1e-9);
        let found = fit(
            &nothing,
            HERE,
            variance,
            0.3,
            Heading::EAST,
            &scan(0.8, 0.8),
        );
        let expected = ScanFit {
            at: HERE,
            variance: Vector::new(0.01, SUREST * SUREST),
            agreement: 1.0,
        };
        assert_eq!(found, expected);
        // Beams that meet nothing have no ends.
        let walls = room(|[_, row]| row == 4);
        let found = fit(&walls, HERE, variance, 0.3, Heading::EAST, &scan(3.0, 3.0));
        assert_eq!(found, expected);
    }

    /// The mean and the variance equal those of the added values, by definition.
    #[test]
    fn moments_are_those_of_the_weighted_values() {
        let values = [(0.5, 1.0), (-1.0, 2.0), (3.0, 0.25)];
        let mut moments = Moments::default();
        for (value, weight) in values {
            moments.add(value, weight);
        }
        let weight: f64 = values.iter().map(|(_, weight)| weight).sum();
        let mean = values.iter().map(|(v, w)| v * w).sum::<f64>() / weight;
        let squares = values.iter().map(|(v, w)| w * (v - mean) * (v - mean));
        assert!(near(moments.mean(), mean, 1e-12));
        assert!(near(
            moments.variance(),
            squares.sum::<f64>() / weight,
            1e-12
        ));
    }

    /// The posterior along an axis is the product of prior and likelihood, summed over the mesh.
    #[test]
    fn along_an_axis_the_posterior_counts() {
        let score = |shift: Vector| -200.0 * (shift.y - 0.02) * (shift.y - 0.02);
        let variance = 0.03 * 0.03;
        let (mean, found) = along(score, Vector::new(0.3, 0.01), 1, 40, variance);
        assert_eq!((mean, found), (0.0, variance), "0.09 m is too wide");
        let score = |shift: Vector| -5000.0 * (shift.y - 0.02) * (shift.y - 0.02);
        let narrow = 2.0 * 5000.0 * SHARE_OF_A_BEAM;
        let (mean, found) = along(score, Vector::new(0.3, 0.01), 1, 40, variance);
        // Both are normal: the precisions add up.
        let precision = narrow + 1.0 / variance;
        assert!(near(mean, 0.02 * narrow / precision, 1e-6), "{mean}");
        assert!(near(found, (1.0 / precision).max(1e-4), 1e-6), "{found}");
    }

    #[test]
    fn the_best_on_a_mesh_is_the_best_of_all_its_shifts() {
        let total = |shift: Vector| -(shift - Vector::new(0.11, -0.07)).norm();
        let centre = Vector::new(0.02, 0.0);
        let found = best_of(centre, Vector::new(0.12, 0.06), 0.05, total);
        // Three columns and two rows to either side.
        let expected = centre + Vector::new(2.0, -1.0) * 0.05;
        assert!((found - expected).norm() < 1e-12, "{found}");
        let far = |shift: Vector| shift.x + 2.0 * shift.y;
        let found = best_of(centre, Vector::new(0.12, 0.06), 0.05, far);
        assert!((found - (centre + Vector::new(3.0, 2.0) * 0.05)).norm() < 1e-12);
        let far = |shift: Vector| -shift.x - 2.0 * shift.y;
        let found = best_of(centre, Vector::new(0.12, 0.06), 0.05, far);
        assert!((found - (centre - Vector::new(3.0, 2.0) * 0.05)).norm() < 1e-12);
    }

    /// A beam passes points 0.06 m apart, from the third to 0.15 m before its end.
    #[test]
    fn every_other_beam_passes_what_lies_before_its_end() {
        let mut scan = Scan::clear(Ring::full(4, 3.0));
        scan.ranges = alloc::vec![0.51, 9.0, 0.1, 9.0];
        let rays = rays(HERE, Heading::EAST, &scan);
        assert_eq!(rays.len(), 2);
        let way = |at: &Point| (at - HERE).norm();
        let passed: Vec<f64> = rays[0].iter().map(way).collect();
        assert_eq!(passed.len(), 4);
        for (number, passed) in (3..).zip(passed) {
            assert!(near(passed, f64::from(number) * RAY_STEP, 1e-9), "{passed}");
        }
        assert!(rays[1].is_empty());
        // A wall across the first beam counts twice.
        let walls = room(|[column, _]| column == 27);
        assert!((crossings(&walls, &rays, Vector::zeros()) - 2.0).abs() < 1e-12);
        assert!(crossings(&walls, &rays, Vector::new(0.5, 0.0)).abs() < 1e-12);
        assert!(crossings(&walls, &rays, Vector::new(-0.5, 0.0)).abs() < 1e-12);
    }
}
