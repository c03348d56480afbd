use alloc::vec::Vec;

use tolman_geom::{Point, Pose, Vector, floor_index};

use super::outline::ScanOutline;

/// Likelihood of a beam's end at each point, by beams that ended there before: an image of
/// surfaces, blurred by the beams' errors.
#[derive(Clone, Debug, Default)]
pub(super) struct LikelihoodGrid {
    cell: f64,
    /// Column and row of the first cell.
    first: [i32; 2],
    columns: usize,
    rows: usize,
    /// Likelihood of each cell's middle in 1 / 255, row by row.
    cells: Vec<u8>,
}

/// Likelihoods round a point, for each of several positions of the point within its cell.
#[derive(Clone, Debug)]
pub(super) struct Stamp {
    cell: f64,
    reach: i32,
    bells: Vec<u8>,
}

/// Number of positions within a cell that are distinguished along each axis.
const PLACES: usize = 5;
/// Number of standard deviations at which the likelihood round a point is cut off.
const BELL: f64 = 3.0;
/// Maximum number of cells of a grid along an axis.
const MOST_CELLS: i32 = 6000;

/// Distance, in cells, up to which points of one surface are joined.
const JOINED: f64 = 1.5;

/// Adds the points of an outline, and points between those of one surface.
fn surfaces(outline: &ScanOutline, from: Pose, apart: f64, points: &mut Vec<Point>) {
    let seen: Vec<Point> = (outline.points.iter())
        .map(|point| from.transform(point.at))
        .collect();
    for (index, point) in outline.points.iter().enumerate() {
        points.push(seen[index]);
        if let (true, Some(next)) = (point.goes_on, seen.get(index + 1)) {
            let way = next - seen[index];
            let parts = libm::ceil(way.norm() / apart);
            let between = 1..parts as u32;
            points.extend(between.map(|part| seen[index] + way * (f64::from(part) / parts)));
        }
    }
}

impl Stamp {
    pub(super) fn new(cell: f64, kernel: f64) -> Self {
        let reach = libm::ceil(BELL * kernel / cell) as i32;
        let mut bells = Vec::new();
        for row in 0..PLACES {
            for column in 0..PLACES {
                let off = |place: usize| (place as f64 + 0.5) / PLACES as f64 - 0.5;
                let at = Vector::new(off(column), off(row)) * cell;
                for y in -reach..=reach {
                    for x in -reach..=reach {
                        let way = Vector::new(f64::from(x), f64::from(y)) * cell - at;
                        let bell = libm::exp(-0.5 * way.norm_squared() / (kernel * kernel));
                        bells.push(libm::round(255.0 * bell) as u8);
                    }
                }
            }
        }
        Self { cell, reach, bells }
    }

    fn side(&self) -> usize {
        2 * self.reach as usize + 1
    }

    fn bell(&self, column: usize, row: usize) -> &[u8] {
        let size = self.side() * self.side();
        &self.bells[(row * PLACES + column) * size..][..size]
    }
}

impl LikelihoodGrid {
    /// Draws outlines, each seen from its pose, and leaves `margin` m free around. O(points +
    /// cells).
    pub(super) fn draw<'a>(
        &mut self,
        stamp: &Stamp,
        outlines: impl Iterator<Item = (&'a ScanOutline, Pose)> + Clone,
        margin: f64,
    ) {
        self.cell = stamp.cell;
        let mut points: Vec<Point> = Vec::new();
        for (outline, from) in outlines {
            surfaces(outline, from, JOINED * self.cell, &mut points);
        }
        let (mut low, mut high) = ([i32::MAX; 2], [i32::MIN; 2]);
        for point in &points {
            let index = self.index(*point);
            for axis in 0..2 {
                low[axis] = low[axis].min(index[axis]);
                high[axis] = high[axis].max(index[axis]);
            }
        }
        if points.is_empty() {
            (low, high) = ([0; 2], [0; 2]);
        }
        let margin = libm::ceil(margin / self.cell) as i32 + stamp.reach + 1;
        self.first = low.map(|low| low - margin);
        let [columns, rows] = [0, 1]
            .map(|axis| (high[axis] - low[axis] + 2 * margin + 1).clamp(1, MOST_CELLS) as usize);
        (self.columns, self.rows) = (columns, rows);
        self.cells.clear();
        self.cells.resize(columns * rows, 0);
        for point in points {
            self.stamp(stamp, point);
        }
    }

    fn stamp(&mut self, stamp: &Stamp, point: Point) {
        let scaled = point.coords / self.cell;
        let corner = scaled.map(floor_index);
        let place = (scaled - corner.map(f64::from)) * PLACES as f64;
        let place = [place.x, place.y].map(|place| (place as usize).min(PLACES - 1));
        let bell = stamp.bell(place[0], place[1]);
        let [column, row] = [corner.x, corner.y].map(|index| index.wrapping_sub(stamp.reach));
        let side = stamp.side();
        let column = column.wrapping_sub(self.first[0]);
        let row = row.wrapping_sub(self.first[1]);
        let fits = |from: i32, cells: usize| from >= 0 && from as usize + side <= cells;
        if !fits(column, self.columns) || !fits(row, self.rows) {
            return;
        }
        for (line, bell) in (row as usize..).zip(bell.chunks_exact(side)) {
            let cells = &mut self.cells[line * self.columns + column as usize..][..side];
            for (cell, bell) in cells.iter_mut().zip(bell) {
                *cell = (*cell).max(*bell);
            }
        }
    }

    /// Returns the cell in which a point lies.
    fn index(&self, point: Point) -> [i32; 2] {
        [point.x, point.y].map(|value| floor_index(value / self.cell))
    }

    /// Returns the place of a point among the cells of [`Self::value`].
    pub(super) fn slot_of(&self, point: Point) -> [i32; 2] {
        let [column, row] = self.index(point);
        [column - self.first[0], row - self.first[1]]
    }

    /// Returns the likelihood in a cell, in 1 / 255; none outside.
    pub(super) fn value(&self, [column, row]: [i32; 2]) -> u8 {
        let inside = (column as u32 as usize) < self.columns && (row as u32 as usize) < self.rows;
        if inside {
            self.cells[row as usize * self.columns + column as usize]
        } else {
            0
        }
    }

    /// Returns the likelihood at a point, 0 … 1, between cells in proportion, and how it grows
    /// along the axes, 1/m.
    pub(super) fn slope(&self, at: Point) -> (f64, Vector) {
        let scaled = at.coords / self.cell - Vector::new(0.5, 0.5);
        let corner = scaled.map(floor_index);
        let part = scaled - corner.map(f64::from);
        let column = corner.x - self.first[0];
        let row = corner.y - self.first[1];
        let value = |x, y| f64::from(self.value([column + x, row + y])) / 255.0;
        let [a, b, c, d] = [value(0, 0), value(1, 0), value(0, 1), value(1, 1)];
        let below = a + (b - a) * part.x;
        let above = c + (d - c) * part.x;
        let along = (b - a) * (1.0 - part.y) + (d - c) * part.y;
        let slope = Vector::new(along, above - below) / self.cell;
        (below + (above - below) * part.y, slope)
    }

    pub(super) const fn cell(&self) -> f64 {
        self.cell
    }

    /// Returns a grid in which each cell holds the greatest value of the `width` × `width` cells
    /// that begin at it. O(cells · log width).
    pub(super) fn pooled(&self, width: usize) -> Self {
        let mut pooled = self.clone();
        // Each pass doubles the width over which a cell holds the maximum.
        let mut sees = 1;
        while sees < width {
            let step = sees.min(width - sees);
            pooled.pool_by(step);
            sees += step;
        }
        pooled
    }

    fn pool_by(&mut self, step: usize) {
        let columns = self.columns;
        let mut right = Vec::with_capacity(columns);
        for line in self.cells.chunks_exact_mut(columns) {
            right.clear();
            right.extend_from_slice(line.get(step..).unwrap_or(&[]));
            raise(line, &right);
        }
        for row in 0..self.rows.saturating_sub(step) {
            let (low, high) = self.cells.split_at_mut((row + step) * columns);
            raise(&mut low[row * columns..], &high[..columns]);
        }
    }
}

/// Sets each cell to the larger of its value and that of the other cell.
fn raise(cells: &mut [u8], others: &[u8]) {
    for (cell, other) in cells.iter_mut().zip(others) {
        *cell = (*cell).max(*other);
    }
}
