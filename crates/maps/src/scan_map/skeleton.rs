use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

use super::WallGrid;
use super::grid_area::GridArea;
use super::wall_grid::GridIndex;

/// The middle lines of the ground where a robot can stand. They remain when cells are removed from
/// the border on, except those that keep the ground connected or end a line.
#[derive(Debug)]
pub(super) struct Skeleton {
    area: GridArea,
    is_line: Vec<bool>,
    /// Distance from each cell to the border of the ground, in [`PART`]s of a cell.
    depth: Vec<u32>,
}

/// Length of a step along an axis, in [`PART`]s of a cell; a diagonal step counts 4 (Borgefors
/// 1986).
const STRAIGHT: u32 = 3;
const DIAGONAL: u32 = 4;
/// Number of distance units per cell.
const PART: f64 = STRAIGHT as f64;

/// The cells round another, in turn; every second lies along an axis.
const AROUND: [GridIndex; 8] = [
    [1, 0],
    [1, 1],
    [0, 1],
    [-1, 1],
    [-1, 0],
    [-1, -1],
    [0, -1],
    [1, -1],
];

impl Skeleton {
    /// Returns the skeleton of the cells of `grid` that are in `ground`, by slot. O(cells · log
    /// cells).
    pub(super) fn of(grid: &WallGrid, ground: Vec<bool>) -> Self {
        let mut skeleton = Self {
            area: GridArea::between(grid.bounds()),
            depth: vec![0; ground.len()],
            is_line: ground,
        };
        skeleton.measure();
        skeleton.thin();
        skeleton
    }

    /// Returns the cells of the lines, row by row.
    pub(super) fn cells(&self) -> impl Iterator<Item = GridIndex> + '_ {
        let slots = (0..self.is_line.len()).filter(|slot| self.is_line[*slot]);
        slots.map(|slot| self.area.index(slot))
    }

    /// Returns the distance of a cell from the border of the ground, m.
    pub(super) fn depth(&self, at: GridIndex) -> f64 {
        let depth = self.area.slot(at).map_or(0, |slot| self.depth[slot]);
        f64::from(depth) / PART * WallGrid::CELL
    }

    /// Returns the neighbours of a cell on its lines; a diagonal one only if no other way is as
    /// short.
    pub(super) fn beside(&self, at: GridIndex) -> impl Iterator<Item = GridIndex> + '_ {
        let around = self.around(at);
        (0..8).filter_map(move |way| {
            let has_corner = way % 2 == 1 && (around[way - 1] || around[(way + 1) % 8]);
            (around[way] && !has_corner).then(|| by(at, AROUND[way]))
        })
    }

    /// Computes the distance of each cell from the border, forwards and backwards over all rows.
    fn measure(&mut self) {
        const BEFORE: [usize; 4] = [4, 5, 6, 7];
        const AFTER: [usize; 4] = [0, 1, 2, 3];
        let slots = self.depth.len();
        for slot in 0..slots {
            self.depth[slot] = self.depth_by(slot, BEFORE, u32::MAX / 2);
        }
        for slot in (0..slots).rev() {
            self.depth[slot] = self.depth_by(slot, AFTER, self.depth[slot]);
        }
    }

    fn depth_by(&self, slot: usize, ways: [usize; 4], most: u32) -> u32 {
        if !self.is_line[slot] {
            return 0;
        }
        let at = self.area.index(slot);
        let by_way = ways.map(|way| {
            let step = if way % 2 == 0 { STRAIGHT } else { DIAGONAL };
            let beside = self.area.slot(by(at, AROUND[way]));
            beside.map_or(0, |slot| self.depth[slot]) + step
        });
        by_way.into_iter().fold(most, u32::min)
    }

    /// Removes cells, those at the border first.
    fn thin(&mut self) {
        let all = (0..self.is_line.len()).filter(|slot| self.is_line[*slot]);
        let mut left: BinaryHeap<Reverse<(u32, usize)>> =
            all.map(|slot| Reverse((self.depth[slot], slot))).collect();
        while let Some(Reverse((_, slot))) = left.pop() {
            let at = self.area.index(slot);
            let around = self.around(at);
            if !self.is_line[slot] || !is_needless(around) {
                continue;
            }
            self.is_line[slot] = false;
            for (way, _) in around.iter().enumerate().filter(|(_, is_line)| **is_line) {
                if let Some(slot) = self.area.slot(by(at, AROUND[way])) {
                    left.push(Reverse((self.depth[slot], slot)));
                }
            }
        }
    }

    fn around(&self, at: GridIndex) -> [bool; 8] {
        AROUND.map(|way| {
            self.area
                .slot(by(at, way))
                .is_some_and(|slot| self.is_line[slot])
        })
    }
}

/// Returns whether a cell with these neighbours can be removed. A removable cell connects nothing
/// (Yokoi's number of connections is 1) and ends no line (more than two cells lie beside it). At
/// the end of a line two cells wide, one cell stays; otherwise the line would be removed from its
/// end on.
fn is_needless(around: [bool; 8]) -> bool {
    let connections = [0, 2, 4, 6].into_iter().filter(|way| {
        let [a, b, c] = [0, 1, 2].map(|next| around[(way + next) % 8]);
        !a && (b || c)
    });
    let beside = around.into_iter().filter(|is_line| *is_line).count();
    connections.count() == 1 && beside > 2
}

pub(super) fn by(at: GridIndex, offset: GridIndex) -> GridIndex {
    [at[0] + offset[0], at[1] + offset[1]]
}
