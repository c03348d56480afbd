//! Finds the best of all poses in a window, by branch and bound. It misses no pose and evaluates
//! few.
//!
//! Source: E. Olson: Real-Time Correlative Scan Matching, 2009; W. Hess et al.: Real-Time Loop
//! Closure in 2D LIDAR SLAM, 2016.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;
use core::cmp::Ordering;

use tolman_geom::{Point, Pose, Vector};

use super::grid::LikelihoodGrid;
use super::outline::ScanOutline;

/// Window of poses that are tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Half-width about the expected position, along each axis, m.
    pub(super) reach: f64,
    /// Half-width about the expected heading, rad.
    pub(super) turn: f64,
    /// Loss of score of a pose at the border of the window, by position.
    pub(super) prior: f64,
    /// Loss of score of a pose at the border of the window, by heading.
    pub(super) prior_turn: f64,
}

/// Distance between the first candidates, cells.
const WIDE: i32 = 16;
/// Number of cells along each axis that make one cell of the next coarser level.
const BRANCH: i32 = 4;
/// Distance up to which points move by at most one cell from one heading to the next, m.
const TYPICAL_RANGE: f64 = 5.0;

/// Candidate poses of one heading, in a square of `width` × `width` cells.
struct Candidate {
    bound: f64,
    heading: usize,
    shift: [i32; 2],
    level: usize,
}

/// A heading that is tried, with the cells in which the points then lie.
struct Turned {
    turn: f64,
    slots: Vec<[i32; 2]>,
}

struct Search<'a> {
    window: Window,
    cell: f64,
    reach: i32,
    turned: Vec<Turned>,
    levels: Vec<(i32, &'a LikelihoodGrid)>,
}

/// Grids of upper bounds, from coarse to fine.
#[derive(Clone, Debug)]
pub(super) struct Pyramid {
    wide: Option<LikelihoodGrid>,
    middle: LikelihoodGrid,
}

impl Pyramid {
    /// Returns the grids for windows of up to `reach` m. O(cells).
    pub(super) fn of(grid: &LikelihoodGrid, reach: f64) -> Self {
        let middle = grid.pooled(BRANCH as usize);
        let wide = (reach > WIDE as f64 * grid.cell()).then(|| grid.pooled(WIDE as usize));
        Self { wide, middle }
    }
}

/// Returns the pose in the window about `expected` at which the outline fits the grid best.
/// O(headings · points · (reach / width)²) without the bounds, which save most of it.
pub(super) fn best(
    grid: &LikelihoodGrid,
    pyramid: &Pyramid,
    outline: &ScanOutline,
    expected: Pose,
    window: Window,
) -> Option<Pose> {
    if outline.points.is_empty() {
        return None;
    }
    let mut levels = Vec::new();
    if let Some(wide) = &pyramid.wide {
        levels.push((WIDE, wide));
    }
    levels.push((BRANCH, &pyramid.middle));
    levels.push((1, grid));
    let search = Search {
        window,
        cell: grid.cell(),
        reach: libm::ceil(window.reach / grid.cell()) as i32,
        turned: turned(grid, outline, expected, window.turn),
        levels,
    };
    let candidate = search.run()?;
    let shift = Vector::new(f64::from(candidate.shift[0]), f64::from(candidate.shift[1]));
    Some(Pose::new(
        expected.position + shift * grid.cell(),
        expected
            .heading
            .turned(search.turned[candidate.heading].turn),
    ))
}

fn turned(grid: &LikelihoodGrid, outline: &ScanOutline, expected: Pose, reach: f64) -> Vec<Turned> {
    let step = grid.cell() / TYPICAL_RANGE;
    let steps = libm::ceil(reach / step) as i32;
    let one = |step_count: i32| {
        let turn = f64::from(step_count) * step;
        let pose = Pose::new(expected.position, expected.heading.turned(turn));
        let unit = pose.heading.unit();
        let seen = |at: Point| {
            let [x, y] = [
                unit.x * at.x - unit.y * at.y + pose.position.x,
                unit.y * at.x + unit.x * at.y + pose.position.y,
            ];
            grid.slot_of(Point::new(x, y))
        };
        Turned {
            turn,
            slots: outline.points.iter().map(|point| seen(point.at)).collect(),
        }
    };
    (-steps..=steps).map(one).collect()
}

impl Search<'_> {
    fn run(&self) -> Option<Candidate> {
        let mut open = BinaryHeap::new();
        let width = self.levels.first()?.0;
        for heading in 0..self.turned.len() {
            let mut row = -self.reach;
            while row <= self.reach {
                let mut column = -self.reach;
                while column <= self.reach {
                    open.push(self.candidate(heading, [column, row], 0));
                    column += width;
                }
                row += width;
            }
        }
        // The first single pose is better than the rest, by their bounds.
        while let Some(candidate) = open.pop() {
            let next = candidate.level + 1;
            if next == self.levels.len() {
                return Some(candidate);
            }
            let width = self.levels[next].0;
            let count = self.levels[candidate.level].0 / width;
            for row in 0..count {
                for column in 0..count {
                    let shift = [
                        candidate.shift[0] + column * width,
                        candidate.shift[1] + row * width,
                    ];
                    if shift.iter().all(|shift| *shift <= self.reach) {
                        open.push(self.candidate(candidate.heading, shift, next));
                    }
                }
            }
        }
        None
    }

    fn candidate(&self, heading: usize, shift: [i32; 2], level: usize) -> Candidate {
        let (width, grid) = self.levels[level];
        let Turned { turn, slots } = &self.turned[heading];
        let sum: u32 = slots
            .iter()
            .map(|slot| u32::from(grid.value([slot[0] + shift[0], slot[1] + shift[1]])))
            .sum();
        let score = f64::from(sum) / (255.0 * slots.len() as f64);
        Candidate {
            bound: score - self.loss(*turn, shift, width),
            heading,
            shift,
            level,
        }
    }

    /// Returns the least loss of score by the prior among the poses of a candidate.
    fn loss(&self, turn: f64, shift: [i32; 2], width: i32) -> f64 {
        let nearest = shift.map(|low| {
            let high = low + width - 1;
            f64::from(0_i32.clamp(low, high)) * self.cell / self.window.reach.max(self.cell)
        });
        let turn = turn / self.window.turn.max(1e-9);
        self.window.prior * (nearest[0] * nearest[0] + nearest[1] * nearest[1])
            + self.window.prior_turn * turn * turn
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of equal candidates the narrower one comes first, then the one with the smaller numbers.
        let key = |one: &Self| (one.heading, one.shift);
        (self.bound.total_cmp(&other.bound))
            .then_with(|| self.level.cmp(&other.level))
            .then_with(|| key(other).cmp(&key(self)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::Heading;

    use super::super::grid::Stamp;
    use super::super::outline::SurfacePoint;
    use super::*;

    fn corner() -> ScanOutline {
        let ahead = (-10..10).map(|step| Point::new(2.0, 0.1 * f64::from(step)));
        let left = (0..15).map(|step| Point::new(0.1 * f64::from(step), 1.0));
        let points = ahead.chain(left).map(|at| SurfacePoint {
            at,
            normal: Vector::zeros(),
            goes_on: false,
        });
        ScanOutline {
            points: points.collect(),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Every pose of the window, one by one.
        #[test]
        fn no_pose_of_the_window_fits_better(
            x in -0.2..0.2, y in -0.2..0.2, angle in -0.06..0.06,
            reach in 0.05..0.5, prior in 0.0..0.6, prior_turn in 0.0..0.6,
        ) {
            let outline = corner();
            let mut grid = LikelihoodGrid::default();
            let stamp = Stamp::new(0.05, 0.08);
            grid.draw(&stamp, [(&outline, Pose::IDENTITY)].into_iter(), 1.0);
            let expected = Pose::new(Point::new(x, y), Heading::from_radians(angle));
            let window = Window { reach, turn: 0.08, prior, prior_turn };
            let cells = (reach / 0.05).ceil() as i32;
            let score = |turned: &Turned, [column, row]: [i32; 2]| {
                let values = turned.slots.iter().map(|slot| f64::from(grid.value([slot[0] + column, slot[1] + row])));
                let fit = values.sum::<f64>() / 255.0 / turned.slots.len() as f64;
                let off = [column, row].map(|shift| f64::from(shift) * 0.05 / reach.max(0.05));
                let turn = turned.turn / 0.08;
                fit - prior * (off[0] * off[0] + off[1] * off[1]) - prior_turn * turn * turn
            };
            let all = turned(&grid, &outline, expected, window.turn);
            let mut most = f64::NEG_INFINITY;
            for turned in &all {
                for (row, column) in (-cells..=cells).flat_map(|row| (-cells..=cells).map(move |column| (row, column))) {
                    most = most.max(score(turned, [column, row]));
                }
            }
            let pyramid = Pyramid::of(&grid, reach);
            let found = best(&grid, &pyramid, &outline, expected, window).unwrap();
            let shift = [found.position.x - x, found.position.y - y].map(|off| (off / 0.05).round() as i32);
            prop_assert!(shift.iter().all(|shift| shift.abs() <= cells));
            let turn = expected.heading.turn_to(found.heading);
            let chosen = all.iter().min_by(|a, b| (a.turn - turn).abs().total_cmp(&(b.turn - turn).abs())).unwrap();
            prop_assert!((chosen.turn - turn).abs() < 1e-9);
            let reached = score(chosen, shift);
            prop_assert!((reached - most).abs() < 1e-9, "{reached} of {most}");
        }
    }

    #[test]
    fn headings_are_tried_a_cell_apart_at_a_typical_range() {
        let outline = corner();
        let mut grid = LikelihoodGrid::default();
        grid.draw(
            &Stamp::new(0.05, 0.08),
            [(&outline, Pose::IDENTITY)].into_iter(),
            1.0,
        );
        let all = turned(&grid, &outline, Pose::IDENTITY, 0.08);
        let step = 0.05 / TYPICAL_RANGE;
        let count = (0.08 / step).ceil() as usize;
        assert_eq!(all.len(), 2 * count + 1);
        for (index, one) in all.iter().enumerate() {
            let turn = (index as f64 - count as f64) * step;
            assert!((one.turn - turn).abs() < 1e-12);
            for (slot, point) in one.slots.iter().zip(&outline.points) {
                let seen = Heading::from_radians(turn).rotate(point.at.coords);
                assert_eq!(*slot, grid.slot_of(Point::from(seen)));
            }
        }
    }

    #[test]
    fn nothing_seen_fits_nowhere() {
        let mut grid = LikelihoodGrid::default();
        grid.draw(
            &Stamp::new(0.05, 0.08),
            [(&corner(), Pose::IDENTITY)].into_iter(),
            1.0,
        );
        let window = Window {
            reach: 0.2,
            turn: 0.1,
            prior: 0.1,
            prior_turn: 0.1,
        };
        let found = best(
            &grid,
            &Pyramid::of(&grid, 0.2),
            &ScanOutline::default(),
            Pose::IDENTITY,
            window,
        );
        assert!(found.is_none());
    }
}
