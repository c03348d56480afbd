use alloc::sync::Arc;

use tolman_geom::{Point, Vector};

use super::sweep::{LANES, Sweep};
use super::{Caster, Lanes, WallIndex};
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
    lanes: Lanes,
}

/// The most lines of one axis that are crossed all at once.
const MOST: usize = 4;

/// The lines and walls ahead in one of the four quadrants, numbered away from the origin.
#[derive(Clone, Copy, Debug)]
struct Quadrant {
    /// Distance to the lines across x.
    columns: [f64; MOST],
    /// Distance to the lines across y.
    rows: [f64; MOST],
    vertical: [Line; MOST],
    horizontal: [Line; MOST],
}

/// Where walls are missing along a line, cell by cell: all ones where one is missing, else 0.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    /// At the cell beside the origin's.
    first: u64,
    /// At the farthest cell.
    last: u64,
    /// Which cells differ from the one before.
    changes: [u64; MOST],
}

impl Line {
    fn new(count: usize, stands: impl Fn(usize) -> bool) -> Self {
        let missing = |cell| if stands(cell) { 0 } else { u64::MAX };
        let mut changes = [0; MOST];
        for (cell, change) in changes.iter_mut().enumerate().take(count) {
            *change = missing(cell) ^ missing(cell + 1);
        }
        Self {
            first: missing(0),
            last: missing(count),
            changes,
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
            lanes,
        })
    }

    fn quadrant(
        &self,
        cell: (usize, usize),
        origin: Point,
        west: bool,
        south: bool,
        count: usize,
    ) -> Quadrant {
        let lattice = &self.lattice;
        let step = |from: usize, back: bool, by: usize| {
            if back {
                from.wrapping_sub(by)
            } else {
                from + by
            }
        };
        // The lines around cell c are c and c + 1.
        let line = |cell: usize, back: bool, by: usize| step(cell + usize::from(!back), back, by);
        let mut quadrant = Quadrant {
            columns: [0.0; MOST],
            rows: [0.0; MOST],
            vertical: [Line::default(); MOST],
            horizontal: [Line::default(); MOST],
        };
        for by in 0..count {
            let (column, row) = (line(cell.0, west, by), line(cell.1, south, by));
            quadrant.columns[by] = lattice.columns.ahead(cell.0, west, by, origin.x);
            quadrant.rows[by] = lattice.rows.ahead(cell.1, south, by, origin.y);
            quadrant.vertical[by] = Line::new(count, |other| {
                lattice.vertical(column, step(cell.1, south, other))
            });
            quadrant.horizontal[by] = Line::new(count, |other| {
                lattice.horizontal(step(cell.0, west, other), row)
            });
        }
        quadrant
    }

    /// All beams, each crossing `COUNT` lines of each axis at most.
    #[inline(always)]
    fn cross<const COUNT: usize>(&self, cell: (usize, usize), sweep: &mut Sweep) {
        let quadrants = [(false, false), (true, false), (false, true), (true, true)]
            .map(|(west, south)| self.quadrant(cell, sweep.origin, west, south, COUNT));
        let x = sweep.world.x.as_chunks::<LANES>().0;
        let y = sweep.world.y.as_chunks::<LANES>().0;
        let ranges = sweep.ranges.as_chunks_mut::<LANES>().0;
        for ((x, y), ranges) in x.iter().zip(y).zip(ranges) {
            let mut which = [0; LANES];
            for lane in 0..LANES {
                which[lane] = usize::from(x[lane] < 0.0) + 2 * usize::from(y[lane] < 0.0);
            }
            if which == [which[0]; LANES] {
                *ranges = crossed::<COUNT>(&quadrants[which[0]], x, y, ranges);
            } else {
                for lane in 0..LANES {
                    let all = crossed::<COUNT>(&quadrants[which[lane]], x, y, ranges);
                    ranges[lane] = all[lane];
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
                if lattice.horizontal(column, row + usize::from(!south)) {
                    return to_row;
                }
                rows += 1;
                to_row = lattice.rows.ahead(cell.1, south, rows, origin.y) * per_y;
            } else {
                if to_column >= max_range || column >= lattice.columns.cells {
                    return max_range;
                }
                if lattice.vertical(column + usize::from(!west), row) {
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

/// How far beams of one quadrant get.
#[inline(always)]
fn crossed<const COUNT: usize>(
    quadrant: &Quadrant,
    x: &[f64; LANES],
    y: &[f64; LANES],
    ranges: &[f64; LANES],
) -> [f64; LANES] {
    let mut result = *ranges;
    for lane in 0..LANES {
        let (per_x, per_y) = (reciprocal(x[lane]), reciprocal(y[lane]));
        let mut no_vertical = [0; COUNT];
        let mut no_horizontal = [0; COUNT];
        for line in 0..COUNT {
            no_vertical[line] = quadrant.vertical[line].first;
            no_horizontal[line] = quadrant.horizontal[line].last;
        }
        for column in 0..COUNT {
            for row in 0..COUNT {
                let row_first = quadrant.rows[row] * per_y < quadrant.columns[column] * per_x;
                let row_first = if row_first { u64::MAX } else { 0 };
                no_vertical[column] ^= row_first & quadrant.vertical[column].changes[row];
                no_horizontal[row] ^= row_first & quadrant.horizontal[row].changes[column];
            }
        }
        let mut nearest = ranges[lane];
        for line in 0..COUNT {
            // All ones make a NaN, which is nearer than nothing.
            let column = (quadrant.columns[line] * per_x).to_bits() | no_vertical[line];
            let row = (quadrant.rows[line] * per_y).to_bits() | no_horizontal[line];
            for range in [f64::from_bits(column), f64::from_bits(row)] {
                nearest = if range < nearest { range } else { nearest };
            }
        }
        result[lane] = nearest;
    }
    result
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
            0 | 1 => self.lanes.run(
                #[inline(always)]
                || self.cross::<1>(cell, sweep),
            ),
            2 => self.lanes.run(
                #[inline(always)]
                || self.cross::<2>(cell, sweep),
            ),
            3 => self.lanes.run(
                #[inline(always)]
                || self.cross::<3>(cell, sweep),
            ),
            4 => self.lanes.run(
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
