use alloc::sync::Arc;
use core::array;

use tolman_geom::{Point, Vector};

use super::beam_sweep::{BeamSweep, Chunk, LANES};
use super::{Caster, Kernels, Lanes, WallIndex};
use crate::World;
use crate::world::{BitRows, Lattice};

/// Walks each ray from grid line to grid line in worlds made from mazes and occupancy grids.
/// Source: Amanatides and Woo, *A fast voxel traversal algorithm for ray tracing* (1987).
///
/// For short beams, which cross few lines, all crossings are computed at once, in lanes over beams.
/// Either way, one comparison per pair of crossings decides which line comes first, and thus which
/// cell the ray is in. So a ray enters every cell through one of its edges, and no rounding lets it
/// slip through the corner between two walls.
///
/// O(lines crossed) per ray, whatever the size of the world.
#[derive(Clone, Debug)]
pub struct LatticeWalk {
    lattice: Arc<Lattice>,
    vertical: Edges,
    horizontal: Edges,
    /// Index for rays from outside the grid.
    index: Arc<WallIndex>,
    kernels: Kernels,
}

/// Maximum number of lines of one axis that are crossed all at once.
const MOST: usize = 3;

/// Walls on the edges of one line of the grid. The low four bits are the present and the next three
/// cells, the high four the present and the last three.
#[derive(Clone, Debug)]
struct Edges {
    cells: usize,
    /// Walls line by line, with empty lines before the first and after the last.
    walls: Vec<u8>,
}

impl Edges {
    fn new(lines: &BitRows) -> Self {
        let (count, cells) = (lines.rows(), lines.length());
        let mut walls = vec![0; (count + 2 * MOST) * cells];
        for line in 0..count {
            for cell in 0..cells {
                for by in 0..=MOST {
                    let on = u8::from(lines.get(line, cell + by)) << by;
                    let back = u8::from(lines.get(line, cell.wrapping_sub(by))) << by;
                    walls[(line + MOST) * cells + cell] |= on | back << 4;
                }
            }
        }
        Self { cells, walls }
    }

    /// Returns the walls from `cell` on, or back, on the line `by` lines beyond the one that bounds
    /// cell `from`.
    #[inline(always)]
    fn along<const COUNT: usize>(
        &self,
        (from, before): (usize, bool),
        by: usize,
        (cell, back): (usize, bool),
    ) -> &'static Line<COUNT> {
        // The lines around cell c are c and c + 1.
        let line = if before {
            from + MOST - by
        } else {
            from + 1 + MOST + by
        };
        let walls = self.walls[line * self.cells + cell];
        &Line::TABLE[usize::from(if back { walls >> 4 } else { walls & 15 })]
    }
}

/// Gaps along a line, cell by cell from the origin's: the bits of infinity for a gap, of 0 for a
/// wall.
#[derive(Clone, Copy, Debug)]
struct Line<const COUNT: usize> {
    first: u64,
    last: u64,
    /// Bits of the cells that differ from the one before.
    changes: [u64; COUNT],
}

impl<const COUNT: usize> Line<COUNT> {
    /// Gaps for each pattern of walls, one bit per wall.
    const TABLE: [Self; 16] = {
        let mut table = [Self {
            first: 0,
            last: 0,
            changes: [0; COUNT],
        }; 16];
        let mut walls = 0;
        while walls < 16 {
            let line = &mut table[walls];
            line.first = infinite(!walls, 0);
            line.last = infinite(!walls, COUNT);
            let mut cell = 0;
            while cell < COUNT {
                line.changes[cell] = infinite(walls ^ walls >> 1, cell);
                cell += 1;
            }
            walls += 1;
        }
        table
    };
}

/// Returns infinity's bits if `bit` is set, else 0. Added to a distance, infinity takes it out of
/// the comparison.
const fn infinite(bits: usize, bit: usize) -> u64 {
    if bits >> bit & 1 == 1 {
        f64::INFINITY.to_bits()
    } else {
        0
    }
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
    vertical: [&'static Line<COUNT>; COUNT],
    horizontal: [&'static Line<COUNT>; COUNT],
}

impl LatticeWalk {
    /// Returns the caster of a world made from a maze or an occupancy grid, or `None` for other
    /// worlds.
    #[must_use]
    pub fn new(world: &World, lanes: Lanes) -> Option<Self> {
        let lattice = Arc::clone(world.lattice()?);
        Some(Self {
            vertical: Edges::new(&lattice.vertical),
            horizontal: Edges::new(&lattice.horizontal),
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
        let (along_x, along_y) = ((column, west), (row, south));
        Quadrant {
            west,
            south,
            columns: array::from_fn(|by| lattice.columns.ahead(column, west, by, origin.x)),
            rows: array::from_fn(|by| lattice.rows.ahead(row, south, by, origin.y)),
            vertical: array::from_fn(|by| self.vertical.along(along_x, by, along_y)),
            horizontal: array::from_fn(|by| self.horizontal.along(along_y, by, along_x)),
        }
    }

    /// Computes all beams, each crossing at most `COUNT` lines of each axis.
    #[inline(always)]
    fn cross<const COUNT: usize>(&self, cell: (usize, usize), sweep: &mut BeamSweep) {
        for (quadrant, (west, south)) in
            (0..).zip([(true, true), (false, true), (false, false), (true, false)])
        {
            let ahead = self.quadrant::<COUNT>(cell, sweep.origin, west, south);
            for (first, past) in sweep.order.quadrant(quadrant) {
                for chunk in &mut sweep.chunks[first..past] {
                    ahead.cross(chunk);
                }
            }
        }
    }

    /// Returns the range of one ray, line by line.
    fn walk(&self, cell: (usize, usize), origin: Point, direction: Vector, max_range: f64) -> f64 {
        let lattice = &self.lattice;
        let (west, south) = (direction.x < 0.0, direction.y < 0.0);
        let (per_x, per_y) = (reciprocal(direction.x), reciprocal(direction.y));
        let (mut columns, mut rows) = (0, 0);
        let mut to_column = lattice.columns.ahead(cell.0, west, 0, origin.x) * per_x;
        let mut to_row = lattice.rows.ahead(cell.1, south, 0, origin.y) * per_y;

        loop {
            let (column, row) = (step(cell.0, west, columns), step(cell.1, south, rows));
            if to_row < to_column {
                if to_row >= max_range || row >= lattice.rows.cells {
                    return max_range;
                }
                if lattice.horizontal.get(row + usize::from(!south), column) {
                    return to_row;
                }
                rows += 1;
                to_row = lattice.rows.ahead(cell.1, south, rows, origin.y) * per_y;
            } else {
                if to_column >= max_range || column >= lattice.columns.cells {
                    return max_range;
                }
                if lattice.vertical.get(column + usize::from(!west), row) {
                    return to_column;
                }
                columns += 1;
                to_column = lattice.columns.ahead(cell.0, west, columns, origin.x) * per_x;
            }
        }
    }
}

/// Returns the length of a ray per metre across the lines. For a ray that never crosses them the
/// value is very large, so that a line at distance 0 still counts as one.
#[inline(always)]
fn reciprocal(component: f64) -> f64 {
    let size = component.abs();
    1.0 / if size > 1e-300 { size } else { 1e-300 }
}

/// Returns the index `by` steps on, or back; an index past all others if that does not exist.
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
    fn cross(&self, chunk: &mut Chunk) {
        for lane in 0..LANES {
            let (per_x, per_y) = (reciprocal(chunk.x[lane]), reciprocal(chunk.y[lane]));
            let mut columns = [0.0; COUNT];
            let mut rows = [0.0; COUNT];
            let mut no_vertical = [0; COUNT];
            let mut no_horizontal = [0; COUNT];
            for line in 0..COUNT {
                columns[line] = self.columns[line] * per_x;
                rows[line] = self.rows[line] * per_y;
                no_vertical[line] = self.vertical[line].first;
                no_horizontal[line] = self.horizontal[line].last;
            }
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
            let mut nearest = chunk.range[lane];
            for line in 0..COUNT {
                let column = columns[line] + f64::from_bits(no_vertical[line]);
                let row = rows[line] + f64::from_bits(no_horizontal[line]);
                let first = if column < row { column } else { row };
                nearest = if first < nearest { first } else { nearest };
            }
            let inside =
                ((chunk.x[lane] < 0.0) == self.west) & ((chunk.y[lane] < 0.0) == self.south);
            chunk.range[lane] = if inside { nearest } else { chunk.range[lane] };
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

    fn scan(&self, sweep: &mut BeamSweep) {
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
            _ => {
                let origin = sweep.origin;
                sweep.shorten_each(|direction, range| self.walk(cell, origin, direction, range));
            }
        }
    }
}
