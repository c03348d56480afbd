use alloc::vec;
use alloc::vec::Vec;
use core::iter;

use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
use tolman_planners::TooLarge;

use super::RangeModel;

/// Evidence for and against every wall of a maze of at most `N` × `N` cells, drawn to scale.
///
/// Every wall has log-odds that it stands. A reading that meets a wall raises them, and one that
/// passes lowers them. The change depends on how far the sensor can be trusted at that range.
/// Beyond [`WallBelief::CONVINCED`] a wall counts as standing or open. It is unknown before, and
/// may become unknown again.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_maps::wall_belief::{RangeModel, RangeReading, WallBelief};
/// use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
///
/// let sensor = RangeModel { absolute: 0.005, relative: 0.02, outliers: 0.1 };
/// let mut belief = WallBelief::<16>::new(Grid::new(4, 4), 0.18, 0.012)?;
/// let pose = Pose::new(Point::new(0.09, 0.09), Heading::EAST);
/// // Two cells on a wall stands: 0.36 + 0.09 m, less half its thickness.
/// let reading = RangeReading { bearing: 0.0, range: 0.443, max_range: 1.0 };
/// for _ in 0..2 {
///     belief.observe(pose, reading, &sensor);
/// }
/// assert_eq!(belief.knowledge(Cell::new(1, 0), Direction::East), Knowledge::Open);
/// assert_eq!(belief.knowledge(Cell::new(2, 0), Direction::East), Knowledge::Wall);
/// assert_eq!(belief.knowledge(Cell::new(0, 0), Direction::North), Knowledge::Unknown);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WallBelief<const N: usize> {
    grid: Grid,
    pitch: f64,
    thickness: f64,
    /// Log-odds that each wall stands.
    odds: Vec<f64>,
}

/// A reading of one range sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeReading {
    /// Direction of the beam, rad counter-clockwise from ahead.
    pub bearing: f64,
    /// Distance of the thing that the beam met, m.
    pub range: f64,
    /// Reading of a beam that meets nothing, m.
    pub max_range: f64,
}

/// A wall at which a ray may end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Distance of the wall from the origin of the ray, m.
    pub range: f64,
    /// Knowledge of the wall: believed to stand, or unknown.
    pub known: Knowledge,
}

/// Cosine of the angle to the axis below which a reading is ignored: it is about walls at the side.
const STRAIGHT: f64 = 0.985;

impl<const N: usize> WallBelief<N> {
    /// Log-odds from which a wall is believed to stand; below the negative value it is believed to
    /// be open.
    pub const CONVINCED: f64 = 3.0;
    /// Maximum magnitude of the log-odds, so that a wrong belief can be given up.
    const MOST: f64 = 9.0;
    /// Factor on the log-odds of a wall that is doubted.
    const DOUBT: f64 = 0.8;
    /// Maximum change of log-odds by a single reading: two readings at one stop share the pose's
    /// error.
    const MOST_AT_ONCE: f64 = 1.6;

    /// Returns a belief in the border only. `pitch` is the distance from the middle of a cell to
    /// the next, `thickness` that of a wall, m.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn new(grid: Grid, pitch: f64, thickness: f64) -> Result<Self, TooLarge> {
        TooLarge::check(grid, N)?;
        Ok(Self {
            grid,
            pitch,
            thickness,
            odds: vec![0.0; grid.wall_count()],
        })
    }

    /// Returns the distance from the middle of a cell to the next, m.
    #[must_use]
    pub const fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Returns the position of the middle of a cell, m.
    #[must_use]
    pub fn middle(&self, cell: Cell) -> Point {
        let along = |index: u16| (f64::from(index) + 0.5) * self.pitch;
        Point::new(along(cell.x), along(cell.y))
    }

    /// Returns the cell in which a point lies, or `None` outside the maze.
    #[must_use]
    pub fn cell_at(&self, point: Point) -> Option<Cell> {
        let index = |along: f64| {
            let index = libm::floor(along / self.pitch);
            (0.0..f64::from(u16::MAX))
                .contains(&index)
                .then_some(index as u16)
        };
        let cell = Cell::new(index(point.x)?, index(point.y)?);
        self.grid.contains(cell).then_some(cell)
    }

    /// Updates the walls by one reading that `sensor` made at `pose`. A beam that is far from
    /// parallel to both axes is ignored. O(n²) for n cells along the ray.
    ///
    /// Applies Bayes' rule to each wall on the ray separately. It compares the likelihoods of the
    /// reading with and without the wall, given the present belief about the other walls.
    pub fn observe(&mut self, pose: Pose, reading: RangeReading, sensor: &RangeModel) {
        let heading = pose.heading.turned(reading.bearing);
        let unit = heading.unit();
        if unit.x.abs().max(unit.y.abs()) < STRAIGHT || !reading.range.is_finite() {
            return;
        }
        let ray: Vec<Chance> = self
            .chances(pose.position, heading, reading, sensor)
            .collect();
        let nothing = sensor.density(reading.range, reading.max_range);
        for (number, chance) in ray.iter().enumerate() {
            let without = ray.iter().enumerate();
            let density = |stands: f64| {
                let of = |(other, chance): (usize, &Chance)| match other == number {
                    true => Chance { stands, ..*chance },
                    false => *chance,
                };
                sensor.mixed(reading, Chance::met(without.clone().map(of), nothing))
            };
            let says = libm::log(density(1.0) / density(0.0));
            let says = says.clamp(-Self::MOST_AT_ONCE, Self::MOST_AT_ONCE);
            if let Some(odds) = chance.wall.and_then(|wall| self.odds.get_mut(wall)) {
                *odds = (*odds + says).clamp(-Self::MOST, Self::MOST);
            }
        }
    }

    /// Updates the belief by a touch at the `side` of `cell`, where a wall may stand.
    pub fn bump(&mut self, cell: Cell, side: Direction) {
        if let Some(odds) = self.odds.get_mut(self.grid.wall(cell, side).0 as usize) {
            *odds = (*odds + Self::MOST_AT_ONCE).min(Self::MOST);
        }
    }

    /// Reduces the certainty of every wall that is more likely to stand than not, after an error of
    /// unknown cause.
    pub fn doubt_walls(&mut self) {
        for odds in self.odds.iter_mut().filter(|odds| **odds > 0.0) {
            *odds *= Self::DOUBT;
        }
    }

    /// Returns the walls that a reading may have ended at, while the ray stays in its row or
    /// column.
    fn chances(
        &self,
        origin: Point,
        heading: Heading,
        reading: RangeReading,
        sensor: &RangeModel,
    ) -> impl Iterator<Item = Chance> {
        let along = self
            .crossings(origin, heading)
            .take_while(|crossing| crossing.along_axis);
        let ranges = along.map(move |crossing| (self.face(crossing.line), crossing));
        let within = ranges.take_while(move |(range, _)| *range < reading.max_range);
        within.map(move |(range, crossing)| {
            let side = crossing.line.side;
            let wall = self.grid.wall(crossing.cell, side).0 as usize;
            let is_border = self.grid.neighbour(crossing.cell, side).is_none();
            let odds = self.odds.get(wall).copied().unwrap_or(0.0);
            Chance {
                wall: (!is_border).then_some(wall),
                stands: if is_border {
                    1.0
                } else {
                    1.0 / (1.0 + libm::exp(-odds))
                },
                density: sensor.density(reading.range, range),
            }
        })
    }

    /// Returns the distance to the face of a wall on a line, m.
    fn face(&self, line: Axis) -> f64 {
        (line.distance - self.thickness / 2.0 / line.slope).max(0.0)
    }

    /// Returns the points at which a ray from `origin` that reaches `max_range`, m, may end. These
    /// are crossed grid lines where a wall may stand, the nearest first, up to the first wall
    /// believed in.
    pub fn meetings(
        &self,
        origin: Point,
        heading: Heading,
        max_range: f64,
    ) -> impl Iterator<Item = Meeting> {
        let mut ended = false;
        let meetings = self.crossings(origin, heading).map_while(move |crossing| {
            let range = self.face(crossing.line);
            if ended || range >= max_range {
                return None;
            }
            let known = self.knowledge(crossing.cell, crossing.line.side);
            ended = known == Knowledge::Wall;
            Some(Meeting { range, known })
        });
        meetings.filter(|meeting| meeting.known != Knowledge::Open)
    }

    /// Returns the sides of cells that a ray crosses, the nearest first (Amanatides and Woo, "A
    /// fast voxel traversal algorithm for ray tracing", 1987).
    #[inline]
    fn crossings(
        &self,
        origin: Point,
        heading: Heading,
    ) -> impl Iterator<Item = Crossing> + use<N> {
        let (grid, pitch, unit) = (self.grid, self.pitch, heading.unit());
        let axis = |at: f64, slope: f64, ahead: Direction, back: Direction| {
            let line = if slope > 0.0 {
                libm::floor(at / pitch) + 1.0
            } else {
                libm::floor(at / pitch)
            };
            let steep = slope.abs().max(1e-12);
            Axis {
                distance: (line * pitch - at).abs() / steep,
                step: pitch / steep,
                side: if slope > 0.0 { ahead } else { back },
                slope: steep,
            }
        };
        let mut x = axis(origin.x, unit.x, Direction::East, Direction::West);
        let mut y = axis(origin.y, unit.y, Direction::North, Direction::South);
        let mut ahead = self.cell_at(origin);
        iter::from_fn(move || {
            let cell = ahead?;
            let (axis, other) = if x.distance <= y.distance {
                (&mut x, y)
            } else {
                (&mut y, x)
            };
            let line = *axis;
            axis.distance += axis.step;
            ahead = grid.neighbour(cell, line.side);
            let along_axis = line.slope > other.slope;
            Some(Crossing {
                cell,
                line,
                along_axis,
            })
        })
    }
}

impl<const N: usize> Walls for WallBelief<N> {
    fn grid(&self) -> Grid {
        self.grid
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        let beyond = self.grid.neighbour(cell, direction);
        if beyond.is_none() || !self.grid.contains(cell) {
            return Knowledge::Wall;
        }
        match self.odds[self.grid.wall(cell, direction).0 as usize] {
            odds if odds >= Self::CONVINCED => Knowledge::Wall,
            odds if odds <= -Self::CONVINCED => Knowledge::Open,
            _ => Knowledge::Unknown,
        }
    }
}

/// The next line that a ray crosses along x or y.
#[derive(Clone, Copy)]
struct Axis {
    distance: f64,
    /// Distance along the ray between neighbouring lines, m.
    step: f64,
    /// Side of the cell that the ray crosses there.
    side: Direction,
    /// Component of the ray's direction along this axis.
    slope: f64,
}

/// A wall that a reading may have ended at.
#[derive(Clone, Copy)]
struct Chance {
    /// Number of the wall, or `None` at the border, which is known.
    wall: Option<usize>,
    /// Probability that the wall stands.
    stands: f64,
    /// Density of the reading if the beam ended at the wall.
    density: f64,
}

impl Chance {
    /// Returns the density of a reading that ends at the first standing wall; `nothing` is its
    /// density without one.
    fn met(ray: impl Iterator<Item = Self>, nothing: f64) -> f64 {
        let (density, passes) = ray.fold((0.0, 1.0), |(density, passes), wall| {
            let ends = passes * wall.stands;
            (density + ends * wall.density, passes - ends)
        });
        density + passes * nothing
    }
}

struct Crossing {
    cell: Cell,
    line: Axis,
    /// Whether the ray runs along the axis it crosses here, more than across it.
    along_axis: bool,
}
