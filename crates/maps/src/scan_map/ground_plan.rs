use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::Point;

use super::grid_area::GridArea;
use super::wall_grid::{GridIndex, index_of, sees};
use super::{ChartError, WallGrid};

/// Walls, floor and unknown ground, two bits per cell: what navigation needs of a [`WallGrid`].
///
/// It is only as large as the known ground, and does not grow.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroundPlan {
    /// Cells of the grid.
    area: GridArea,
    /// Walls, one bit per cell, row by row.
    walls: Vec<u64>,
    floor: Vec<u64>,
}

/// State of a cell of a [`GroundPlan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GroundKind {
    /// No beam has reached the cell.
    Unknown,
    /// Beams passed the cell.
    Floor,
    /// Beams ended in the cell.
    Wall,
}

/// Maximum distance of a cell from the origin, cells: 50 km.
const FARTHEST: i32 = 1_000_000;

impl GroundKind {
    const ALL: [Self; 3] = [Self::Unknown, Self::Floor, Self::Wall];

    /// Returns the character that stands for this kind in a file.
    const fn letter(self) -> char {
        match self {
            Self::Unknown => ' ',
            Self::Floor => '.',
            Self::Wall => '#',
        }
    }

    fn of_letter(letter: char) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|ground| ground.letter() == letter)
    }
}

impl GroundPlan {
    /// Returns the memory of walls and floor, bytes. O(1).
    pub(super) const fn bytes(&self) -> usize {
        size_of_val(self.walls.as_slice()) + size_of_val(self.floor.as_slice())
    }

    /// Returns the ground known to a grid. O(cells).
    #[must_use]
    pub fn of(grid: &WallGrid) -> Self {
        let known = || {
            grid.indices()
                .filter(|at| grid.ground(*at) != GroundKind::Unknown)
        };
        let Some(any) = known().next() else {
            return Self::unknown([0, 0], 0, 0);
        };
        let [low, high] = known().fold([any, any], |[low, high], at| {
            [
                [low[0].min(at[0]), low[1].min(at[1])],
                [high[0].max(at[0]), high[1].max(at[1])],
            ]
        });
        let mut plan = Self::unknown(low, high[0] - low[0] + 1, high[1] - low[1] + 1);
        for at in known() {
            plan.set(at, grid.ground(at));
        }
        plan
    }

    /// Returns the plan that [`rows`](Self::rows) wrote, whose first cell is `first`. O(cells).
    ///
    /// # Errors
    /// [`ChartError`] if the rows are not equally long, have other letters, or lie too far away.
    pub fn from_rows(first: [i32; 2], rows: &[String]) -> Result<Self, ChartError> {
        let columns = rows.first().map_or(0, |row| row.chars().count());
        let is_near = |axis: usize, count: usize| {
            let end =
                i64::from(first[axis]).saturating_add(i64::try_from(count).unwrap_or(i64::MAX));
            first[axis] >= -FARTHEST && end <= i64::from(FARTHEST)
        };
        if !is_near(0, columns) || !is_near(1, rows.len()) {
            return Err(ChartError::TooFar { first });
        }
        let mut plan = Self::unknown(first, columns as i32, rows.len() as i32);
        for (number, row) in (0..).zip(rows) {
            let found = row.chars().count();
            if found != columns {
                let expected = columns;
                return Err(ChartError::Row {
                    row: number,
                    found,
                    expected,
                });
            }
            for (column, letter) in (0..).zip(row.chars()) {
                let ground = GroundKind::of_letter(letter).ok_or(ChartError::Letter {
                    row: number,
                    column,
                    letter,
                })?;
                plan.set([first[0] + column as i32, first[1] + number as i32], ground);
            }
        }
        Ok(plan)
    }

    /// Returns the plan with additional walls at these points, as far as they lie within its
    /// bounds.
    pub(super) fn with_walls(&self, at: &[Point]) -> Self {
        let mut plan = self.clone();
        for slot in at.iter().filter_map(|at| self.area.slot(index_of(*at))) {
            plan.floor[slot / WORD] &= !(1 << (slot % WORD));
            plan.walls[slot / WORD] |= 1 << (slot % WORD);
        }
        plan
    }

    /// Returns column and row of the first cell; cell (0, 0) begins at the origin.
    #[must_use]
    pub const fn first(&self) -> [i32; 2] {
        self.area.bounds()[0]
    }

    /// Returns the rows from south to north, one letter per cell: `#` wall, `.` floor, a space
    /// where nothing is known. O(cells).
    pub fn rows(&self) -> impl Iterator<Item = String> + '_ {
        let [first, end] = self.bounds();
        (first[1]..end[1]).map(move |row| {
            let cells = (first[0]..end[0]).map(|column| self.at([column, row]).letter());
            cells.collect()
        })
    }

    /// Returns a grid with the same ground, each wall as seen once. O(cells).
    #[must_use]
    pub fn grid(&self) -> WallGrid {
        WallGrid::of(self.bounds(), |at| self.at(at))
    }

    /// Returns whether no wall stands on the straight line between two points. O(distance).
    #[must_use]
    pub fn sees(&self, from: Point, to: Point) -> bool {
        sees(from, to, |at| self.at(index_of(at)) == GroundKind::Wall)
    }

    /// Returns the kind of ground in a cell; unknown outside the plan.
    pub(super) fn at(&self, index: GridIndex) -> GroundKind {
        let Some(slot) = self.area.slot(index) else {
            return GroundKind::Unknown;
        };
        if is_set(&self.floor, slot) {
            GroundKind::Floor
        } else if is_set(&self.walls, slot) {
            GroundKind::Wall
        } else {
            GroundKind::Unknown
        }
    }

    /// Returns the first cell, and the cell one column and one row past the last.
    pub(super) fn bounds(&self) -> [GridIndex; 2] {
        self.area.bounds()
    }

    fn unknown(first: GridIndex, columns: i32, rows: i32) -> Self {
        let area = GridArea::new(first, columns, rows);
        let words = area.len().div_ceil(WORD);
        Self {
            area,
            walls: vec![0; words],
            floor: vec![0; words],
        }
    }

    fn set(&mut self, index: GridIndex, ground: GroundKind) {
        let Some(slot) = self.area.slot(index) else {
            return;
        };
        let bits = match ground {
            GroundKind::Unknown => return,
            GroundKind::Floor => &mut self.floor,
            GroundKind::Wall => &mut self.walls,
        };
        bits[slot / WORD] |= 1 << (slot % WORD);
    }
}

/// Number of bits in a word.
const WORD: usize = u64::BITS as usize;

fn is_set(bits: &[u64], slot: usize) -> bool {
    bits[slot / WORD] >> (slot % WORD) & 1 == 1
}
