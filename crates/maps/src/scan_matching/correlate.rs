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
