use tolman_geom::{Point, Vector};
use tolman_maze::{Cell, Grid};
use tolman_robot::{Guess, MapPlace, MapView, Position};

use crate::course::Course;

/// True position of a robot when it believed it was at a place of its map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlaceVisit {
    /// Id of the place.
    pub place: u32,
    /// Cell where the robot truly was.
    pub cell: Cell,
}

/// The cells of a drawing, and their size in the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Squares {
    pub(super) grid: Grid,
    /// Distance between the middles of two cells, m.
    pub(super) pitch: f64,
    /// South-west corner of the first cell, m.
    pub(super) origin: Point,
}

impl Squares {
    /// Returns the cells of a course.
    pub(super) fn of(course: &Course) -> Self {
        Self {
            grid: course.maze.grid(),
            pitch: course.pitch(),
            origin: match course.is_free() {
                true => {
                    let half = Vector::new(0.5 * course.pitch(), 0.5 * course.pitch());
                    course.cell_centre(Cell::new(0, 0)) - half
                }
                // Computed, it would be off by a rounding.
                false => Point::origin(),
            },
        }
    }

    /// Returns the cell of a point; outside the drawing, the nearest cell.
    pub(super) fn cell_at(self, point: Point) -> Cell {
        let along = |metres: f64, cells: u16| {
            let cell = libm::floor(metres / self.pitch);
            cell.clamp(0.0, f64::from(cells.saturating_sub(1))) as u16
        };
        let from = point - self.origin;
        Cell::new(
            along(from.x, self.grid.width()),
            along(from.y, self.grid.height()),
        )
    }

    pub(super) fn middle(self, cell: Cell) -> Point {
        let along = |index: u16| (f64::from(index) + 0.5) * self.pitch;
        self.origin + Vector::new(along(cell.x), along(cell.y))
    }
}

/// Returns the place that a belief names first. For a position, this is the nearest place.
pub(super) fn believed(belief: &[Guess], map: impl Fn() -> MapView) -> Option<u32> {
    match belief.first()?.at {
        Position::Place(id) => Some(id),
        Position::Point(point) => nearest(&map(), point),
    }
}

fn nearest(map: &MapView, point: Point) -> Option<u32> {
    let known = map.places.iter();
    let known = known.filter_map(|place| Some((place.id, (place.position? - point).norm())));
    let nearest = known.min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.map(|(id, _)| id)
}

/// Returns the offset of a map's frame from the world's, m, by the visited places; `None` if none
/// of them has a position. The axes are assumed to be the same.
pub(super) fn offset<'a>(
    places: impl Iterator<Item = (&'a MapPlace, Cell)>,
    squares: Squares,
) -> Option<Vector> {
    let mut count = 0.0;
    let mut sum = Vector::zeros();
    for (place, cell) in places {
        if let Some(position) = place.position {
            sum += squares.middle(cell) - position;
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum / count)
}
