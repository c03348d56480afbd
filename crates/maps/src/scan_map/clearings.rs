use alloc::collections::VecDeque;
use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Point, Vector};

use super::WallGrid;
use super::wall_grid::{GridIndex, index_of, middle};

/// Where a robot can stand as far as a [`WallGrid`] knows, and where it has not been yet.
#[derive(Debug)]
pub struct Clearings<'a> {
    grid: &'a WallGrid,
    radius: f64,
}

/// How far it is from everywhere to the nearest place where the robot has not been, as far as it was worked out.
#[derive(Debug)]
pub struct WayToGap<'a> {
    clearings: &'a Clearings<'a>,
    /// Cells to go, by slot.
    cells: Vec<u32>,
}

const UNREACHED: u32 = u32::MAX;

/// How many cells farther than the robot the way is worked out: as far as an action may lead it astray.
const ASTRAY: u32 = 16;

impl<'a> Clearings<'a> {
    pub(super) const fn new(grid: &'a WallGrid, radius: f64) -> Self {
        Self { grid, radius }
    }

    /// Returns whether the robot can stand there.
    #[must_use]
    pub fn stands(&self, at: Point) -> bool {
        self.grid.stands(index_of(at), self.radius)
    }

    /// Returns how far the robot can go straight ahead, up to `most` m, before its body meets a wall or unknown ground.
    #[must_use]
    pub fn straight(&self, from: Point, unit: Vector, most: f64) -> f64 {
        let steps = (most / WallGrid::CELL) as u32;
        let free = (1..=steps).take_while(|step| {
            self.stands(from + unit * (f64::from(*step) * WallGrid::CELL))
        });
        free.count() as f64 * WallGrid::CELL
    }

    /// Returns the way from about `from` to the nearest ground where the robot could stand and has not been; `None` where
    /// there is none. O(cells on the way).
    #[must_use]
    pub fn way_to_gap(&self, from: Point) -> Option<WayToGap<'_>> {
        let start = self.nearest_stand(from)?;
        let (gap, _) = self.flood(start, |_, slot, _| !self.grid.was_visited(slot));
        let gap = gap?;
        let mut limit = None;
        let (_, cells) = self.flood(gap, |index, _, cells| {
            if index == start {
                limit = Some(cells + ASTRAY);
            }
            limit.is_some_and(|limit| cells > limit)
        });
        Some(WayToGap {
            clearings: self,
            cells,
        })
    }

    /// Spreads from a cell over where the robot can stand until `ends` says so; returns the cell where it ended, and the cells gone to
    /// each.
    fn flood(
        &self,
        from: GridIndex,
        mut ends: impl FnMut(GridIndex, usize, u32) -> bool,
    ) -> (Option<GridIndex>, Vec<u32>) {
        let mut cells = vec![UNREACHED; self.grid.len()];
        let mut queue = VecDeque::new();
        if let Some(slot) = self.grid.slot(from) {
            cells[slot] = 0;
            queue.push_back((from, slot));
        }
        while let Some((index, slot)) = queue.pop_front() {
            let gone = cells[slot];
            if ends(index, slot, gone) {
                return (Some(index), cells);
            }
            for next in neighbours(index) {
                if let Some(slot) = self.grid.slot(next)
                    && cells[slot] == UNREACHED
                    && self.grid.stands(next, self.radius)
                {
                    cells[slot] = gone + 1;
                    queue.push_back((next, slot));
                }
            }
        }
        (None, cells)
    }

    /// The cell nearest to a point in which the robot can stand: where it is, it stands, whatever the map says.
    fn nearest_stand(&self, at: Point) -> Option<GridIndex> {
        let centre = index_of(at);
        (0..=6_i32).find_map(|ring| {
            let cells = (-ring..=ring).flat_map(|row| {
                (-ring..=ring).map(move |column| [centre[0] + column, centre[1] + row])
            });
            let stands = cells.filter(|index| self.grid.stands(*index, self.radius));
            stands.min_by(|a, b| {
                let way = |index: GridIndex| (middle(index) - at).norm();
                way(*a).total_cmp(&way(*b))
            })
        })
    }
}

impl WayToGap<'_> {
    /// Returns how far it is from a point, m; `None` where that was not worked out.
    #[must_use]
    pub fn metres(&self, from: Point) -> Option<f64> {
        let index = self.clearings.nearest_stand(from)?;
        let cells = self.cells[self.clearings.grid.slot(index)?];
        (cells != UNREACHED).then(|| f64::from(cells) * WallGrid::CELL)
    }
}

fn neighbours([column, row]: GridIndex) -> [GridIndex; 4] {
    [
        [column + 1, row],
        [column, row + 1],
        [column - 1, row],
        [column, row - 1],
    ]
}
