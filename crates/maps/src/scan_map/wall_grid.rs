use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;

use tolman_geom::{Heading, Point, Vector, floor_index};
use tolman_robot::Scan;

use super::GroundKind;
use super::grid_area::GridArea;

mod changes;

/// Counts of beams that ended and that passed, on a square grid that grows.
///
/// A cell is a wall while enough beams ended in it, relative to those that passed. Each cell stores
/// the distance of the nearest wall, up to [`REACH`](Self::REACH). A robot's clearance and the fit
/// of a scan are therefore look-ups.
#[derive(Clone, Debug, Default)]
pub struct WallGrid {
    /// Cells of the grid.
    area: GridArea,
    cells: Vec<GridCell>,
}

/// Column and row of a cell of a [`WallGrid`].
pub(super) type GridIndex = [i32; 2];

#[derive(Clone, Copy, Debug)]
struct GridCell {
    hits: u8,
    passes: u8,
    /// Distance from the middle of the nearest wall cell, in [`DISTANCE_UNIT`]s; [`FAR`] beyond the
    /// reach.
    wall: u8,
    /// Whether the robot has been in the cell, or near it and in sight of it.
    been: bool,
}

/// Unit in which distances to walls are stored, m.
const DISTANCE_UNIT: f64 = 0.005;
/// Value of a cell that is beyond the reach of every wall.
const FAR: u8 = u8::MAX;
/// Number of cells added at once on a side that the grid outgrows.
const MARGIN: i32 = 48;
/// Error of a beam's end above which it did not end on the known wall, m.
const ELSEWHERE: f64 = 0.2;
/// Maximum number of beams that reached a cell, per beam that ended there, for a wall to stand.
const PASSES_A_HIT: u32 = 3;

impl WallGrid {
    /// Side of a cell, m.
    pub const CELL: f64 = 0.05;
    /// Greatest known distance from a wall, m.
    pub const REACH: f64 = 0.35;

    /// Returns the size of the grid's cells, bytes. O(1).
    #[must_use]
    pub const fn bytes(&self) -> usize {
        size_of_val(self.cells.as_slice())
    }

    /// Adds a scan from a position, its beams turned by `heading`. A beam that met nothing passed
    /// all cells in its range. O(cells within the ring's range).
    pub fn add(&mut self, from: Point, heading: Heading, scan: &Scan) {
        let range = scan.ring.max_range;
        self.cover(from, range + Self::REACH);
        self.pass(from, heading, scan);
        for (index, length) in (0..).zip(&scan.ranges) {
            if *length < range {
                let bearing = heading.turned(scan.ring.bearing(index));
                self.hit(index_of(from + bearing.unit() * *length));
            }
        }
    }

    /// Returns the distance of `at` from the nearest wall, m, interpolated between cells; `None` if
    /// none stands within [`REACH`](Self::REACH).
    #[must_use]
    pub fn wall_distance(&self, at: Point) -> Option<f64> {
        let scaled = at.coords / Self::CELL - Vector::new(0.5, 0.5);
        let (corner, [right, up]) = corner_of(scaled);
        let near = |column: i32, row: i32| {
            let wall = self
                .cell([corner[0] + column, corner[1] + row])
                .map_or(FAR, |cell| cell.wall);
            f64::from(wall)
        };
        let below = near(0, 0) * (1.0 - right) + near(1, 0) * right;
        let above = near(0, 1) * (1.0 - right) + near(1, 1) * right;
        let distance = (below * (1.0 - up) + above * up) * DISTANCE_UNIT;
        (distance <= Self::REACH).then_some(distance)
    }

    /// Returns whether a point lies in a wall's cell.
    #[must_use]
    pub fn is_wall(&self, at: Point) -> bool {
        self.cell(index_of(at)).is_some_and(|cell| cell.wall == 0)
    }

    /// Returns whether a beam has ever reached or passed this point.
    #[must_use]
    pub fn is_known(&self, at: Point) -> bool {
        self.cell(index_of(at))
            .is_some_and(|cell| cell.hits > 0 || cell.passes > 0)
    }

    /// Returns whether no wall stands on the straight line between two points. O(distance).
    #[must_use]
    pub fn sees(&self, from: Point, to: Point) -> bool {
        sees(from, to, |at| self.is_wall(at))
    }

    /// Returns the share of beams that end elsewhere, among those whose ends the grid knows. `None`
    /// if it knows fewer than `fewest`. O(beams · range).
    pub(super) fn contradiction(
        &self,
        from: Point,
        heading: Heading,
        scan: &Scan,
        fewest: u32,
    ) -> Option<f64> {
        let (mut known, mut elsewhere) = (0, 0);
        for (index, range) in (0..).zip(&scan.ranges) {
            let unit = heading.turned(scan.ring.bearing(index)).unit();
            if let Some(expected) = self.range(from, unit, scan.ring.max_range, 0) {
                known += 1;
                elsewhere += u32::from((range - expected).abs() > ELSEWHERE);
            }
        }
        (known >= fewest).then(|| f64::from(elsewhere) / f64::from(known))
    }

    /// Returns the distance to the first wall, up to `most` m; `None` if unknown ground lies before
    /// it, longer than `unknown` half cells. From one position alone the last cell before a wall
    /// stays unknown.
    fn range(&self, from: Point, unit: Vector, most: f64, unknown: u32) -> Option<f64> {
        let steps = (most / (0.5 * Self::CELL)) as u32;
        let mut left = unknown;
        for step in 1..=steps {
            let range = f64::from(step) * 0.5 * Self::CELL;
            match self.ground(index_of(from + unit * range)) {
                GroundKind::Floor => left = unknown,
                GroundKind::Wall => return Some(range),
                GroundKind::Unknown => left = left.checked_sub(1)?,
            }
        }
        Some(most)
    }

    /// Returns a grid of cells between these bounds with the contents that `ground` gives, each
    /// wall as seen once. O(cells).
    pub(super) fn of(bounds: [GridIndex; 2], ground: impl Fn(GridIndex) -> GroundKind) -> Self {
        let mut grid = Self::unseen(bounds);
        let reach = reach_of_wall();
        for index in grid.indices() {
            let Some(slot) = grid.slot(index) else {
                continue;
            };
            match ground(index) {
                GroundKind::Unknown => {}
                GroundKind::Floor => grid.cells[slot].passes = 1,
                GroundKind::Wall => {
                    grid.cells[slot].hits = 1;
                    grid.stamp(index, &reach);
                }
            }
        }
        grid
    }

    /// Returns all cells, in rows.
    pub(super) fn indices(&self) -> impl Iterator<Item = GridIndex> + use<> {
        self.area.indices()
    }

    /// Returns the kind of ground in a cell; unknown if no beam met or passed it.
    pub(super) fn ground(&self, index: GridIndex) -> GroundKind {
        match self.cell(index) {
            Some(cell) if cell.is_wall() => GroundKind::Wall,
            Some(cell) if cell.passes > 0 => GroundKind::Floor,
            _ => GroundKind::Unknown,
        }
    }

    /// Marks the ground as visited that lies within `reach` m of a point and in sight of it.
    pub(super) fn visit(&mut self, at: Point, reach: f64) {
        let [low, high] = [-reach, reach].map(|offset| index_of(at + Vector::new(offset, offset)));
        for row in low[1]..=high[1] {
            for column in low[0]..=high[0] {
                let ground = middle([column, row]);
                if (ground - at).norm() <= reach
                    && let Some(slot) = self.slot([column, row])
                    && !self.cells[slot].been
                    && self.sees(at, ground)
                {
                    self.cells[slot].been = true;
                }
            }
        }
    }

    /// Returns whether the robot has been at a cell: see [`Self::visit`].
    pub(super) fn was_visited(&self, slot: usize) -> bool {
        self.cells[slot].been
    }

    /// Returns whether a body of this radius, m, fits with its middle in the cell. A beam must have
    /// passed the cell, and known walls must leave room.
    pub(super) fn stands(&self, index: GridIndex, radius: f64) -> bool {
        self.cell(index)
            .is_some_and(|cell| cell.passes > 0 && f64::from(cell.wall) * DISTANCE_UNIT >= radius)
    }

    /// Returns whether a body of this radius, m, could fit with its middle in the cell if that were
    /// floor: nothing is known of it, and known walls leave room.
    pub(super) fn may_stand(&self, index: GridIndex, radius: f64) -> bool {
        self.ground(index) == GroundKind::Unknown
            && self
                .cell(index)
                .is_some_and(|cell| f64::from(cell.wall) * DISTANCE_UNIT >= radius)
    }

    /// Returns the first cell, and the cell one column and one row past the last.
    pub(super) fn bounds(&self) -> [GridIndex; 2] {
        self.area.bounds()
    }

    /// Returns the place of a cell among all, in rows; `None` outside.
    pub(super) fn slot(&self, index: GridIndex) -> Option<usize> {
        self.area.slot(index)
    }

    /// Returns the number of cells.
    pub(super) fn len(&self) -> usize {
        self.cells.len()
    }

    /// Returns a grid of cells that were never seen.
    fn unseen(bounds: [GridIndex; 2]) -> Self {
        let area = GridArea::between(bounds);
        let cells = vec![GridCell::UNSEEN; area.len()];
        Self { area, cells }
    }

    fn cell(&self, index: GridIndex) -> Option<&GridCell> {
        self.cells.get(self.slot(index)?)
    }

    /// Counts a pass for every cell between two beams that lies nearer than both of them reached.
    fn pass(&mut self, from: Point, heading: Heading, scan: &Scan) {
        self.between_beams(from, heading, scan, |grid, index, slot| {
            let was_wall = grid.cells[slot].is_wall();
            grid.cells[slot].passes = grid.cells[slot].passes.saturating_add(1);
            if was_wall && !grid.cells[slot].is_wall() {
                grid.measure_again(index);
            }
        });
    }

    /// Calls `visit` with every cell between two beams that lies nearer than both of them reached,
    /// and its slot. O(cells within the range).
    fn between_beams(
        &mut self,
        from: Point,
        heading: Heading,
        scan: &Scan,
        mut visit: impl FnMut(&mut Self, GridIndex, usize),
    ) {
        let ring = scan.ring;
        let beams = scan.ranges.len();
        let [low, high] = [-ring.max_range, ring.max_range]
            .map(|offset| index_of(from + Vector::new(offset, offset)));
        for row in low[1]..=high[1] {
            for column in low[0]..=high[0] {
                let way = middle([column, row]) - from;
                let distance = way.norm();
                if distance > ring.max_range || beams == 0 {
                    continue;
                }
                let bearing = libm::atan2(way.y, way.x) - heading.radians() - ring.first_bearing;
                let turns = libm::floor(bearing / TAU);
                let beam = ((bearing - turns * TAU) / ring.spacing) as usize;
                let shorter = scan.ranges[beam % beams].min(scan.ranges[(beam + 1) % beams]);
                if distance < shorter - Self::CELL
                    && let Some(slot) = self.slot([column, row])
                {
                    visit(self, [column, row], slot);
                }
            }
        }
    }

    fn hit(&mut self, index: GridIndex) {
        let Some(slot) = self.slot(index) else { return };
        let was_wall = self.cells[slot].is_wall();
        self.cells[slot].hits = self.cells[slot].hits.saturating_add(1);
        if !was_wall && self.cells[slot].is_wall() {
            self.stamp(index, &reach_of_wall());
        }
    }

    /// Updates the distances of the cells round a new wall.
    fn stamp(&mut self, wall: GridIndex, reach: &[([i32; 2], u8)]) {
        for ([column, row], distance) in reach {
            if let Some(slot) = self.slot([wall[0] + column, wall[1] + row]) {
                let cell = &mut self.cells[slot];
                cell.wall = cell.wall.min(*distance);
            }
        }
    }

    /// Measures the distances round a cell that is no longer a wall.
    fn measure_again(&mut self, gone: GridIndex) {
        let reach = (Self::REACH / Self::CELL) as i32;
        for index in around(gone, reach) {
            if let Some(slot) = self.slot(index) {
                self.cells[slot].wall = FAR;
            }
        }
        let distances = reach_of_wall();
        for index in around(gone, 2 * reach) {
            if self.cell(index).is_some_and(GridCell::is_wall) {
                self.stamp(index, &distances);
            }
        }
    }

    /// Grows the grid so that it covers everything within `radius` of a point, m.
    fn cover(&mut self, at: Point, radius: f64) {
        let [low, high] =
            [-radius, radius].map(|offset| index_of(at + Vector::new(offset, offset)));
        if self.slot(low).is_some() && self.slot(high).is_some() {
            return;
        }
        let [first, end] = if self.cells.is_empty() {
            [low, high]
        } else {
            self.bounds()
        };
        let first = [0, 1].map(|axis| first[axis].min(low[axis] - MARGIN));
        let end = [0, 1].map(|axis| end[axis].max(high[axis] + MARGIN));
        let mut grown = Self::unseen([first, end]);
        for (index, cell) in self.indices().zip(&self.cells) {
            if let Some(slot) = grown.slot(index) {
                grown.cells[slot] = *cell;
            }
        }
        *self = grown;
    }
}

impl GridCell {
    const UNSEEN: Self = Self {
        hits: 0,
        passes: 0,
        wall: FAR,
        been: false,
    };

    const fn is_wall(&self) -> bool {
        self.hits > 0 && self.hits as u32 * PASSES_A_HIT >= self.passes as u32
    }
}

/// Returns the offsets of the cells round a wall, with their distances from it.
fn reach_of_wall() -> Vec<([i32; 2], u8)> {
    let reach = (WallGrid::REACH / WallGrid::CELL) as i32;
    let near = around([0, 0], reach).filter_map(|offset| {
        let [column, row] = offset.map(f64::from);
        let distance = libm::hypot(column, row) * WallGrid::CELL;
        (distance <= WallGrid::REACH).then_some((offset, (distance / DISTANCE_UNIT) as u8))
    });
    near.collect()
}

/// Returns whether no wall stands on the straight line between two points, sampled twice a cell.
pub(super) fn sees(from: Point, to: Point, is_wall: impl Fn(Point) -> bool) -> bool {
    let way = to - from;
    let steps = libm::ceil(way.norm() / (0.5 * WallGrid::CELL)).max(1.0);
    (0..=steps as u32).all(|step| !is_wall(from + way * (f64::from(step) / steps)))
}

/// Returns the cells at most `reach` columns and rows from one, in rows.
pub(super) fn around(
    [column, row]: GridIndex,
    reach: i32,
) -> impl Iterator<Item = GridIndex> + use<> {
    let columns = column - reach..=column + reach;
    let row_of = move |row| columns.clone().map(move |column| [column, row]);
    (row - reach..=row + reach).flat_map(row_of)
}

/// Returns the corner of a square grid before a position, which is in units of the grid, and how
/// far beyond it the position lies.
pub(super) fn corner_of(scaled: Vector) -> (GridIndex, [f64; 2]) {
    let corner = [scaled.x, scaled.y].map(floor_index);
    let [x, y] = corner.map(f64::from);
    (corner, [scaled.x - x, scaled.y - y])
}

/// Returns the cell in which a point lies.
pub(super) fn index_of(at: Point) -> GridIndex {
    let index = |value: f64| floor_index(value / WallGrid::CELL);
    [index(at.x), index(at.y)]
}

/// Returns the middle of a cell.
pub(super) fn middle([column, row]: GridIndex) -> Point {
    let at = |index: i32| (f64::from(index) + 0.5) * WallGrid::CELL;
    Point::new(at(column), at(row))
}

#[cfg(test)]
mod tests;
