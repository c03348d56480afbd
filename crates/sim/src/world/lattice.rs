use tolman_geom::{Point, floor_index};
use tolman_maze::{Direction, Maze};

use super::{BitRows, Bounds, Material, WallSegment, WorldError};

/// An occupancy grid as plain data.
#[derive(Clone, Debug, PartialEq)]
pub struct Occupancy {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Size of a cell, m.
    pub resolution: f64,
    /// The south-west corner of the grid, m.
    pub origin: Point,
    /// Whether each cell is occupied, row by row from the south-west.
    pub occupied: Vec<bool>,
}

/// A rectilinear grid whose walls lie on its lines: the form in which mazes and occupancy grids are
/// stored.
///
/// A maze of thin walls has a column per column of cells. With thick walls every wall gets a column
/// or row of its own, and walls proper are the edges between solid and free cells.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Lattice {
    pub(crate) columns: Axis,
    pub(crate) rows: Axis,
    /// The walls on the lines across x, cell by cell northward.
    pub(crate) vertical: BitRows,
    /// The walls on the lines across y, cell by cell eastward.
    pub(crate) horizontal: BitRows,
    /// Cells that are solid wall, row by row.
    solid: BitRows,
}

/// The lines across one axis: `cells + 1` of them.
///
/// Line k lies at `origin + k · pitch`; with a thickness, lines 2k and 2k + 1 lie half of it before
/// and after that.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Axis {
    pub(crate) cells: usize,
    origin: f64,
    pitch: f64,
    thickness: f64,
}

impl Axis {
    /// Returns lines without thickness, from 0 on.
    fn thin(cells: usize, pitch: f64) -> Self {
        Self {
            cells,
            origin: 0.0,
            pitch,
            thickness: 0.0,
        }
    }

    fn line(&self, index: usize) -> f64 {
        if self.thickness > 0.0 {
            let half = if index.is_multiple_of(2) { -0.5 } else { 0.5 } * self.thickness;
            self.origin + (index / 2) as f64 * self.pitch + half
        } else {
            self.origin + index as f64 * self.pitch
        }
    }

    /// Returns the distance from `at` in cell `cell` to the line that bounds the cell `by` cells
    /// further on, or back.
    #[inline(always)]
    pub(crate) fn ahead(&self, cell: usize, back: bool, by: usize, at: f64) -> f64 {
        // Lines before the first, which no walk reaches, are as good as the first.
        let distance = if back {
            at - self.line(cell.saturating_sub(by))
        } else {
            self.line(cell + 1 + by) - at
        };
        // A point on a line may round to the cell on its other side.
        distance.max(0.0)
    }

    /// Returns the cell that holds `value`, or `None` outside.
    fn cell(&self, value: f64) -> Option<usize> {
        if self.thickness > 0.0 {
            let from_first = value - self.origin + 0.5 * self.thickness;
            let along = from_first / self.pitch;
            let whole = floor_index(along);
            let beyond = from_first - f64::from(whole) * self.pitch >= self.thickness;
            let index = 2 * i64::from(whole) + i64::from(beyond);
            (along >= 0.0 && index < self.cells as i64).then_some(index as usize)
        } else {
            let index = (value - self.origin) / self.pitch;
            (index >= 0.0 && index < self.cells as f64).then_some(index as usize)
        }
    }
}

impl Lattice {
    pub(super) fn of_maze(maze: &Maze, pitch: f64, thickness: f64) -> Self {
        if thickness > 0.0 {
            Self::thick(maze, pitch, thickness)
        } else {
            Self::thin(maze, pitch)
        }
    }

    fn thin(maze: &Maze, pitch: f64) -> Self {
        let grid = maze.grid();
        let (width, height) = (usize::from(grid.width()), usize::from(grid.height()));
        let mut vertical = BitRows::new(width + 1, height);
        let mut horizontal = BitRows::new(height + 1, width);
        for cell in grid.cells() {
            let (x, y) = (usize::from(cell.x), usize::from(cell.y));
            let stands = |direction| !maze.is_open(cell, direction);
            vertical.set(x, y, stands(Direction::West));
            vertical.set(x + 1, y, stands(Direction::East));
            horizontal.set(y, x, stands(Direction::South));
            horizontal.set(y + 1, x, stands(Direction::North));
        }
        Self {
            columns: Axis::thin(width, pitch),
            rows: Axis::thin(height, pitch),
            vertical,
            horizontal,
            solid: BitRows::new(height, width),
        }
    }

    fn thick(maze: &Maze, pitch: f64, thickness: f64) -> Self {
        let grid = maze.grid();
        let axis = |cells: u16| Axis {
            thickness,
            ..Axis::thin(2 * usize::from(cells) + 1, pitch)
        };
        let (columns, rows) = (axis(grid.width()), axis(grid.height()));
        let mut solid = BitRows::new(rows.cells, columns.cells);
        for cell in grid.cells() {
            for direction in Direction::ALL {
                if maze.is_open(cell, direction) {
                    continue;
                }
                // The wall's own cell and the posts at both of its ends.
                let (east, north) = direction.step();
                for side in -1..=1 {
                    let x = 2 * i64::from(cell.x) + 1 + i64::from(east) + i64::from(north * side);
                    let y = 2 * i64::from(cell.y) + 1 + i64::from(north) + i64::from(east * side);
                    solid.set(y as usize, x as usize, true);
                }
            }
        }
        Self::round_solid(columns, rows, solid)
    }

    pub(super) fn of_occupancy(occupancy: &Occupancy) -> Result<Self, WorldError> {
        let &Occupancy {
            width,
            height,
            resolution,
            origin,
            ref occupied,
        } = occupancy;
        let fits = width > 0 && height > 0 && width.checked_mul(height) == Some(occupied.len());
        let finite = origin.x.is_finite() && origin.y.is_finite() && resolution.is_finite();
        if !(fits && finite && resolution > 0.0) {
            let bits = occupied.len();
            return Err(WorldError::Occupancy {
                width,
                height,
                resolution,
                bits,
            });
        }
        if occupied.iter().all(|occupied| *occupied) {
            return Err(WorldError::NoFloor);
        }
        let axis = |cells, origin| Axis {
            origin,
            ..Axis::thin(cells, resolution)
        };
        let mut solid = BitRows::new(height, width);
        for (index, occupied) in occupied.iter().enumerate() {
            solid.set(index / width, index % width, *occupied);
        }
        Ok(Self::round_solid(
            axis(width, origin.x),
            axis(height, origin.y),
            solid,
        ))
    }

    /// Returns walls between solid and free cells; everything beyond the edge is solid.
    fn round_solid(columns: Axis, rows: Axis, solid: BitRows) -> Self {
        let (width, height) = (columns.cells, rows.cells);
        let is_solid = |x: Option<usize>, y: Option<usize>| match (x, y) {
            (Some(x), Some(y)) if x < width && y < height => solid.get(y, x),
            _ => true,
        };
        let column = |x, y| is_solid(x, Some(y));
        let row = |y, x| is_solid(Some(x), y);
        Self {
            vertical: edges(width, height, column),
            horizontal: edges(height, width, row),
            columns,
            rows,
            solid,
        }
    }

    /// Returns whether the parts of a lattice that was read agree with each other.
    pub(super) fn is_sound(&self) -> bool {
        let (columns, rows) = (&self.columns, &self.rows);
        let axis = |axis: &Axis| {
            (1..usize::MAX).contains(&axis.cells)
                && axis.origin.abs() <= 1e6
                && (1e-6..=1e6).contains(&axis.pitch)
                && axis.thickness >= 0.0
                && axis.thickness < axis.pitch
        };
        axis(columns)
            && axis(rows)
            && self.vertical.has_shape(columns.cells + 1, rows.cells)
            && self.horizontal.has_shape(rows.cells + 1, columns.cells)
            && self.solid.has_shape(rows.cells, columns.cells)
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds {
            min: Point::new(self.columns.line(0), self.rows.line(0)),
            max: Point::new(
                self.columns.line(self.columns.cells),
                self.rows.line(self.rows.cells),
            ),
        }
    }

    /// Returns the column and row of the cell that holds `point`, or `None` outside.
    pub(crate) fn cell(&self, point: Point) -> Option<(usize, usize)> {
        Some((self.columns.cell(point.x)?, self.rows.cell(point.y)?))
    }

    /// Returns the maximum number of lines of one axis that a ray of length `range`, m, crosses.
    pub(crate) fn lines_within(&self, range: f64) -> usize {
        let Axis {
            pitch, thickness, ..
        } = self.columns;
        let per_pitch = if thickness > 0.0 { 2.0 } else { 1.0 };
        ((range / pitch).ceil() * per_pitch) as usize
    }

    pub(super) fn is_floor(&self, point: Point) -> bool {
        self.cell(point).is_some_and(|(x, y)| !self.solid.get(y, x))
    }

    /// Returns the walls, with adjacent ones in a row joined.
    pub(super) fn walls(&self, material: Material) -> Vec<WallSegment> {
        let corner = |x, y| Point::new(self.columns.line(x), self.rows.line(y));
        let wall = |start, end| WallSegment {
            start,
            end,
            material,
        };
        let vertical = runs(&self.vertical)
            .into_iter()
            .map(|(x, from, to)| wall(corner(x, from), corner(x, to)));
        let horizontal = runs(&self.horizontal)
            .into_iter()
            .map(|(y, from, to)| wall(corner(from, y), corner(to, y)));
        vertical.chain(horizontal).collect()
    }
}

/// Returns the walls on the lines before and after `rows` rows of cells, between solid and free
/// cells.
fn edges(rows: usize, cells: usize, is_solid: impl Fn(Option<usize>, usize) -> bool) -> BitRows {
    let mut walls = BitRows::new(rows + 1, cells);
    for line in 0..=rows {
        for cell in 0..cells {
            let stands = is_solid(line.checked_sub(1), cell) != is_solid(Some(line), cell);
            walls.set(line, cell, stands);
        }
    }
    walls
}

/// Returns the longest runs of consecutive walls on each line: the line, the first cell and one
/// past the last.
fn runs(lines: &BitRows) -> Vec<(usize, usize, usize)> {
    let mut runs = Vec::new();
    for line in 0..lines.rows() {
        let mut from = None;
        // Past the last cell nothing stands.
        for cell in 0..=lines.length() {
            match (from, lines.get(line, cell)) {
                (None, true) => from = Some(cell),
                (Some(start), false) => {
                    runs.push((line, start, cell));
                    from = None;
                }
                _ => {}
            }
        }
    }
    runs
}
