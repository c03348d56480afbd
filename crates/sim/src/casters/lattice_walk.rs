use alloc::sync::Arc;

use tolman_geom::{Point, Vector};

use super::sweep::{LANES, Sweep};
use super::{Caster, Kernels, Lanes, WallIndex};
use crate::World;
use crate::world::Lattice;

/// Walks each ray from grid line to grid line (Amanatides, Woo: *A fast voxel traversal algorithm for
/// ray tracing*, 1987) in worlds made from mazes and occupancy grids.
///
/// Short beams, which cross few lines, do not even walk: all crossings are computed at once, in
/// lanes over beams. In both ways one comparison per pair of crossings decides which line comes
/// first, and that alone says which cell the ray is in; so it enters every cell through one of its
/// edges, and no rounding lets it slip through the corner between two walls.
///
/// O(lines crossed) per ray, whatever the size of the world.
#[derive(Clone, Debug)]
pub struct LatticeWalk {
    lattice: Arc<Lattice>,
    /// For rays from outside the grid.
    index: Arc<WallIndex>,
    kernels: Kernels,
}

/// The lines and walls ahead in one of the four quadrants, numbered away from the origin.
#[derive(Clone, Copy, Debug)]
struct Quadrant<const COUNT: usize> {
    west: bool,
    south: bool,
    /// Distance to the lines across x.
    columns: [f64; COUNT],
    /// Distance to the lines across y.
    rows: [f64; COUNT],
    vertical: [Line<COUNT>; COUNT],
    horizontal: [Line<COUNT>; COUNT],
}

/// Where walls are missing along a line, cell by cell from the origin's: all ones where one is
/// missing, else 0.
#[derive(Clone, Copy, Debug)]
struct Line<const COUNT: usize> {
    first: u64,
    last: u64,
    /// Which cells differ from the one before.
    changes: [u64; COUNT],
}

impl<const COUNT: usize> Line<COUNT> {
    /// Of the walls standing along a line, a bit each.
    #[inline(always)]
    fn new(standing: u32) -> Self {
        let ones = |bits: u32, bit: usize| u64::from(bits >> bit & 1).wrapping_neg();
        let changes = standing ^ standing >> 1;
        Self {
            first: !ones(standing, 0),
            last: !ones(standing, COUNT),
            changes: core::array::from_fn(|bit| ones(changes, bit)),
        }
    }
}

impl LatticeWalk {
    /// The caster of a world made from a maze or an occupancy grid; none of other worlds.
    #[must_use]
    pub fn new(world: &World, lanes: Lanes) -> Option<Self> {
        let lattice = Arc::clone(world.lattice()?);
        Some(Self {
            lattice,
            index: Arc::clone(world.index()),
            kernels: lanes.into(),
        })
    }

    #[inline(always)]
    fn quadrant<const COUNT: usize>(
        &self,
        (column, row): (usize, usize),
        origin: Point,
        west: bool,
        south: bool,
    ) -> Quadrant<COUNT> {
        let lattice = &self.lattice;
        // The lines around cell c are c and c + 1.
        let column_lines: [usize; COUNT] =
            core::array::from_fn(|by| step(column + usize::from(!west), west, by));
        let row_lines: [usize; COUNT] =
            core::array::from_fn(|by| step(row + usize::from(!south), south, by));
        Quadrant {
            west,
            south,
            columns: core::array::from_fn(|by| lattice.columns.ahead(column, west, by, origin.x)),
            rows: core::array::from_fn(|by| lattice.rows.ahead(row, south, by, origin.y)),
            vertical: column_lines.map(|line| Line::new(lattice.vertical.along(line, row, south))),
            horizontal: row_lines
                .map(|line| Line::new(lattice.horizontal.along(line, column, west))),
        }
    }

    /// All beams, each crossing `COUNT` lines of each axis at most.
    #[inline(always)]
    fn cross<const COUNT: usize>(&self, cell: (usize, usize), sweep: &mut Sweep) {
        for (quadrant, (west, south)) in
            (0..).zip([(true, true), (false, true), (false, false), (true, false)])
        {
            let ahead = self.quadrant::<COUNT>(cell, sweep.origin, west, south);
            for (first, past) in sweep.quadrant(quadrant) {
                let x = &sweep.world.x.as_chunks::<LANES>().0[first..past];
                let y = &sweep.world.y.as_chunks::<LANES>().0[first..past];
                let ranges = &mut sweep.ranges.as_chunks_mut::<LANES>().0[first..past];
                for ((x, y), ranges) in x.iter().zip(y).zip(ranges) {
                    ahead.cross(x, y, ranges);
                }
            }
        }
    }

    /// One ray, line by line.
    fn walk(&self, cell: (usize, usize), origin: Point, direction: Vector, max_range: f64) -> f64 {
        let lattice = &self.lattice;
        let (west, south) = (direction.x < 0.0, direction.y < 0.0);
        let (per_x, per_y) = (reciprocal(direction.x), reciprocal(direction.y));
        let (mut columns, mut rows) = (0, 0);
        let mut to_column = lattice.columns.ahead(cell.0, west, 0, origin.x) * per_x;
        let mut to_row = lattice.rows.ahead(cell.1, south, 0, origin.y) * per_y;
        let step = |from: usize, back: bool, by: usize| {
            if back {
                from.wrapping_sub(by)
            } else {
                from + by
            }
        };
        loop {
            let (column, row) = (step(cell.0, west, columns), step(cell.1, south, rows));
            if to_row < to_column {
                if to_row >= max_range || row >= lattice.rows.cells {
                    return max_range;
                }
                if lattice.horizontal.stands(row + usize::from(!south), column) {
                    return to_row;
                }
                rows += 1;
                to_row = lattice.rows.ahead(cell.1, south, rows, origin.y) * per_y;
            } else {
                if to_column >= max_range || column >= lattice.columns.cells {
                    return max_range;
                }
                if lattice.vertical.stands(column + usize::from(!west), row) {
                    return to_column;
                }
                columns += 1;
                to_column = lattice.columns.ahead(cell.0, west, columns, origin.x) * per_x;
            }
        }
    }
}

/// How far a ray goes per metre across the lines, so large where it never crosses that a line at
/// distance 0 still is one.
#[inline(always)]
fn reciprocal(component: f64) -> f64 {
    let size = component.abs();
    1.0 / if size > 1e-300 { size } else { 1e-300 }
}

/// The index `by` steps on, or back; one past all others where there is none.
#[inline(always)]
fn step(from: usize, back: bool, by: usize) -> usize {
    if back {
        from.wrapping_sub(by)
    } else {
        from + by
    }
}

impl<const COUNT: usize> Quadrant<COUNT> {
    /// Shortens the beams that lie in this quadrant.
    #[inline(always)]
    fn cross(&self, x: &[f64; LANES], y: &[f64; LANES], ranges: &mut [f64; LANES]) {
        for lane in 0..LANES {
            let (per_x, per_y) = (reciprocal(x[lane]), reciprocal(y[lane]));
            let columns = self.columns.map(|distance| distance * per_x);
            let rows = self.rows.map(|distance| distance * per_y);
            let mut no_vertical = self.vertical.map(|line| line.first);
            let mut no_horizontal = self.horizontal.map(|line| line.last);
            for column in 0..COUNT {
                for row in 0..COUNT {
                    let row_first = if rows[row] < columns[column] {
                        u64::MAX
                    } else {
                        0
                    };
                    no_vertical[column] ^= row_first & self.vertical[column].changes[row];
                    no_horizontal[row] ^= row_first & self.horizontal[row].changes[column];
                }
            }
            let mut nearest = ranges[lane];
            for line in 0..COUNT {
                // All ones make a NaN, which is nearer than nothing.
                let column = f64::from_bits(columns[line].to_bits() | no_vertical[line]);
                let row = f64::from_bits(rows[line].to_bits() | no_horizontal[line]);
                nearest = if column < nearest { column } else { nearest };
                nearest = if row < nearest { row } else { nearest };
            }
            let inside = ((x[lane] < 0.0) == self.west) & ((y[lane] < 0.0) == self.south);
            ranges[lane] = if inside { nearest } else { ranges[lane] };
        }
    }
}

impl Caster for LatticeWalk {
    fn cast(&self, origin: Point, direction: Vector, max_range: f64) -> f64 {
        match self.lattice.cell(origin) {
            Some(cell) => self.walk(cell, origin, direction, max_range),
            None => self.index.cast(origin, direction, max_range),
        }
    }

    fn scan(&self, sweep: &mut Sweep) {
        let Some(cell) = self.lattice.cell(sweep.origin) else {
            return self.index.scan(sweep);
        };
        match self.lattice.lines_within(sweep.ring().max_range) {
            0 | 1 => self.kernels.run(
                #[inline(always)]
                || self.cross::<1>(cell, sweep),
            ),
            2 => self.kernels.run(
                #[inline(always)]
                || self.cross::<2>(cell, sweep),
            ),
            3 => self.kernels.run(
                #[inline(always)]
                || self.cross::<3>(cell, sweep),
            ),
            4 => self.kernels.run(
                #[inline(always)]
                || self.cross::<4>(cell, sweep),
            ),
            _ => {
                for beam in 0..sweep.beams() {
                    let range =
                        self.walk(cell, sweep.origin, sweep.direction(beam), sweep.range(beam));
                    sweep.shorten(beam, range);
                }
            }
        }
    }
}
