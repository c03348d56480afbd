//! The floor of a free world, cut into squares.

use tolman_geom::{Point, Pose, Vector};
use tolman_maze::{Cell, Direction, Grid, Maze};
use tolman_robot::Body;
use tolman_sim::{Material, WallSegment, World, Zone};

use super::CourseError;

/// Squares that pave a free world, as cells of a maze. A wall stands where the body cannot pass
/// from the middle of one square to that of the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Paving {
    /// The south-west corner of cell (0, 0), m.
    origin: Point,
    /// Distance between the middles of neighbouring cells, m.
    pub(super) pitch: f64,
    grid: Grid,
    /// Minimum distance of the body's centre from a wall, m.
    pub(super) radius: f64,
}

/// Side of a square, in radii of the body. Any passage that is wider than the body by half a radius
/// has squares in it.
const PITCH: f64 = 0.5;

/// Maximum number of squares; more would take a gigabyte and a minute.
const MOST_SQUARES: f64 = 4e6;

impl Paving {
    /// Returns squares over all that the walls of `world` enclose.
    ///
    /// # Errors
    /// [`CourseError::TooVast`] if these are too many.
    pub(super) fn of(world: &World, body: &Body) -> Result<Self, CourseError> {
        let radius = body.radius();
        let pitch = PITCH * radius;
        let bounds = world.bounds();
        let count = |extent: f64| (extent / pitch).ceil().max(1.0);
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        if columns * rows > MOST_SQUARES || columns.max(rows) > f64::from(u16::MAX) {
            return Err(CourseError::TooVast {
                width: bounds.width(),
                height: bounds.height(),
                diameter: 2.0 * radius,
            });
        }
        // The squares stand out evenly on both sides.
        let over = Vector::new(
            columns * pitch - bounds.width(),
            rows * pitch - bounds.height(),
        );
        Ok(Self {
            origin: bounds.min - 0.5 * over,
            pitch,
            grid: Grid::new(columns as u16, rows as u16),
            radius,
        })
    }

    /// Returns the squares as a maze, with those of the destination as its goals. Doors do not
    /// count. O(squares), and O(squares near it) for each wall.
    pub(super) fn maze(&self, world: &World) -> Maze {
        let mut maze = Maze::open(self.grid);
        for cell in self.grid.cells() {
            if !world.is_floor(self.centre(cell)) {
                wall_up(&mut maze, cell);
            }
        }
        for wall in world.walls() {
            self.put_up(&mut maze, wall);
        }
        let goals = world.zone("destination").map(|zone| self.cells_of(zone));
        maze.set_goals(goals.unwrap_or_default());
        maze
    }

    /// Adds to the maze the walls that one wall of the world makes.
    fn put_up(&self, maze: &mut Maze, wall: &WallSegment) {
        for cell in self.near(wall) {
            let centre = self.centre(cell);
            if wall.distance(centre) <= self.radius {
                wall_up(maze, cell);
                continue;
            }
            for direction in [Direction::North, Direction::East] {
                if let Some(next) = self.grid.neighbour(cell, direction)
                    && self.stops(wall, centre, self.centre(next))
                {
                    maze.set_wall(cell, direction, true);
                }
            }
        }
    }

    /// Returns whether an end of a wall stops the body between two middles that are clear of it.
    /// The wall itself does not pass between them, since they lie closer together than the body is
    /// wide.
    fn stops(&self, wall: &WallSegment, start: Point, end: Point) -> bool {
        let way = WallSegment {
            start,
            end,
            material: Material::default(),
        };
        way.distance(wall.start) <= self.radius || way.distance(wall.end) <= self.radius
    }

    /// Returns the squares from which a wall may be touched.
    fn near(&self, wall: &WallSegment) -> impl Iterator<Item = Cell> + use<> {
        let reach = self.radius + 2.0 * self.pitch;
        let across = |start: f64, end: f64, origin: f64, count: u16| {
            let index = |value: f64| ((value - origin) / self.pitch).floor();
            let first = index(start.min(end) - reach).max(0.0) as u16;
            let last = index(start.max(end) + reach).min(f64::from(count) - 1.0);
            first..=last.max(0.0) as u16
        };
        let columns = across(wall.start.x, wall.end.x, self.origin.x, self.grid.width());
        let rows = across(wall.start.y, wall.end.y, self.origin.y, self.grid.height());
        rows.flat_map(move |y| columns.clone().map(move |x| Cell::new(x, y)))
    }

    /// Returns the squares whose middles lie in a zone, and those that hold the middles of its
    /// areas.
    fn cells_of(&self, zone: &Zone) -> Vec<Cell> {
        let all = self.grid.cells();
        let inside = all.filter(|cell| zone.contains(self.centre(*cell)));
        let middles = zone
            .areas()
            .iter()
            .filter_map(|area| self.cell_at(area.middle()));
        inside.chain(middles).collect()
    }

    /// Returns the middle of a square.
    pub(super) fn centre(&self, cell: Cell) -> Point {
        let offset = Vector::new(f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5);
        self.origin + self.pitch * offset
    }

    /// Returns the square in which `point` lies.
    pub(super) fn cell_at(&self, point: Point) -> Option<Cell> {
        let along = |value: f64, count: u16| {
            let index = (value / self.pitch).floor();
            (index >= 0.0 && index < f64::from(count)).then_some(index as u16)
        };
        let offset = point - self.origin;
        let x = along(offset.x, self.grid.width())?;
        Some(Cell::new(x, along(offset.y, self.grid.height())?))
    }

    /// Returns the square in which `point` lies, and those around it: a body that stands there
    /// touches no wall between them.
    pub(super) fn around(&self, point: Point) -> impl Iterator<Item = Cell> + '_ {
        let steps =
            (-1..=1).flat_map(|x| (-1..=1).map(move |y| Vector::new(f64::from(x), f64::from(y))));
        steps.filter_map(move |step| self.cell_at(point + self.pitch * step))
    }

    /// Returns the length of corridor that a square stands for, m. The corridor is as wide as the
    /// body leaves room for its centre.
    pub(super) fn metres_per_cell(&self, corridor_width: f64) -> f64 {
        let left = (corridor_width - 2.0 * self.radius).max(self.pitch);
        self.pitch * self.pitch / left
    }

    /// Returns the middle of the zone `start`, looking along the longest way that is clear there.
    pub(super) fn start(&self, maze: &Maze, world: &World) -> Option<Pose> {
        let position = world.zone("start")?.areas().first()?.middle();
        let cell = self.cell_at(position)?;
        let clear = |direction: &Direction| core::cmp::Reverse(run(maze, cell, *direction));
        let direction = Direction::ALL.into_iter().min_by_key(clear)?;
        Some(Pose::new(position, tolman_control::heading_of(direction)))
    }

    /// Returns the middle between the obstacles to the left and to the right of a square, for a
    /// body that looks along `direction`.
    pub(super) fn amid(&self, maze: &Maze, cell: Cell, direction: Direction) -> Point {
        let to = |side| f64::from(run(maze, cell, side));
        let (left, right) = (direction.left(), direction.right());
        self.centre(cell)
            + 0.5 * self.pitch * (to(left) - to(right)) * tolman_control::unit_of(left)
    }
}

/// Returns the number of squares that the body can go straight ahead from `cell`.
fn run(maze: &Maze, cell: Cell, direction: Direction) -> u32 {
    let ahead = core::iter::successors(Some(cell), |cell| maze.beside(*cell, direction));
    ahead.skip(1).count() as u32
}

fn wall_up(maze: &mut Maze, cell: Cell) {
    for direction in Direction::ALL {
        maze.set_wall(cell, direction, true);
    }
}
