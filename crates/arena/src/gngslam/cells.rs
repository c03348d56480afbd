use tolman_geom::{Point, Vector};
use tolman_maze::{Cell, Grid};
use tolman_sim::Bounds;

/// The 8 × 8 cells by which a person labels places (section 3.2).
///
/// ```
/// use tolman_arena::gngslam::CellGrid;
/// use tolman_geom::Point;
/// use tolman_maze::Cell;
/// use tolman_sim::Bounds;
///
/// let floor = Bounds { min: Point::origin(), max: Point::new(4.6, 4.0) };
/// let cells = CellGrid::over(floor);
/// assert_eq!(cells.cell_of(Point::new(0.6, 3.9)), Cell::new(1, 7));
/// assert_eq!(cells.cell_of(Point::new(-1.0, 9.0)), Cell::new(0, 7), "the nearest");
/// assert!((cells.centre(Cell::new(0, 0)) - Point::new(0.2875, 0.25)).norm() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct CellGrid {
    bounds: Bounds,
}

impl CellGrid {
    /// Number of cells along either side.
    pub const SIDE: u16 = 8;

    /// Returns the cells over a rectangle.
    #[must_use]
    pub const fn over(bounds: Bounds) -> Self {
        Self { bounds }
    }

    /// Returns the rectangle that the cells cover.
    #[must_use]
    pub const fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Returns the grid that numbers the cells.
    #[must_use]
    pub fn grid() -> Grid {
        Grid::new(Self::SIDE, Self::SIDE)
    }

    /// Returns the extent of a cell to the east and to the north, m.
    #[must_use]
    pub fn size(&self) -> Vector {
        (self.bounds.max - self.bounds.min) / f64::from(Self::SIDE)
    }

    /// Returns the cell of a point, or the nearest cell if the point lies beyond them.
    #[must_use]
    pub fn cell_of(&self, point: Point) -> Cell {
        let (from_corner, size) = (point - self.bounds.min, self.size());
        let along = |way: f64, size: f64| {
            let most = f64::from(Self::SIDE - 1);
            (way / size).floor().clamp(0.0, most) as u16
        };
        Cell::new(along(from_corner.x, size.x), along(from_corner.y, size.y))
    }

    /// Returns the middle of a cell, m.
    #[must_use]
    pub fn centre(&self, cell: Cell) -> Point {
        let size = self.size();
        let along = |index: u16, size: f64| (f64::from(index) + 0.5) * size;
        self.bounds.min + Vector::new(along(cell.x, size.x), along(cell.y, size.y))
    }
}
