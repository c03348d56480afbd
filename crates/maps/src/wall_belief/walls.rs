use alloc::vec;
use alloc::vec::Vec;
use core::iter;

use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
use tolman_planners::TooLarge;

/// What speaks for and against every wall of a maze of at most `N` × `N` cells, drawn to scale.
///
/// A reading that meets a wall speaks for it, one that passes speaks against it. A wall is believed in, or taken for open,
/// once [`WallBelief::CONVINCED`] more readings say so than say the contrary; it is unknown before and may be again.
///
/// ```
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_maps::wall_belief::{RangeReading, WallBelief};
/// use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
///
/// let mut belief = WallBelief::<16>::new(Grid::new(4, 4), 0.18, 0.012)?;
/// let pose = Pose::new(Point::new(0.09, 0.09), Heading::EAST);
/// // Two cells on a wall stands: 0.36 + 0.09 m, less half its thickness.
/// let reading = RangeReading { bearing: 0.0, range: 0.443, max_range: 1.0 };
/// for _ in 0..WallBelief::<16>::CONVINCED {
///     belief.observe(pose, reading);
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
    /// By wall: readings for it less those against it.
    votes: Vec<i8>,
}

/// What one range sensor says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeReading {
    /// Where it looks, rad counter-clockwise from ahead.
    pub bearing: f64,
    /// How far it sees, m.
    pub range: f64,
    /// What it reads where it meets nothing, m.
    pub max_range: f64,
}

/// Where a ray may end: at a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// How far away, m.
    pub range: f64,
    /// Whether the wall is believed in; else it is unknown.
    pub known: Knowledge,
}

/// How far from a line, as a share of the pitch, a reading may end and still count as the wall on it.
const TOLERANCE: f64 = 0.25;

/// A ray that leaves the axes by more tells of walls to the side.
const STRAIGHT: f64 = 0.985;

impl<const N: usize> WallBelief<N> {
    /// How many readings more must speak for a wall than against it, or the other way round.
    pub const CONVINCED: i8 = 2;
    /// So many for an opening.
    const DOUBTED: i8 = -Self::CONVINCED;
    /// Readings beyond so many change nothing, so that a wrong belief can be given up.
    const MOST: i8 = 6;

    /// Nothing is believed but the border. `pitch` is from the middle of a cell to the next, `thickness` that of a wall, m.
    ///
    /// # Errors
    /// If the maze has more than `N` columns or rows.
    pub fn new(grid: Grid, pitch: f64, thickness: f64) -> Result<Self, TooLarge> {
        TooLarge::check(grid, N)?;
        Ok(Self {
            grid,
            pitch,
            thickness,
            votes: vec![0; grid.wall_count()],
        })
    }

    /// From the middle of a cell to the next, m.
    #[must_use]
    pub const fn pitch(&self) -> f64 {
        self.pitch
    }

    /// The middle of a cell.
    #[must_use]
    pub fn middle(&self, cell: Cell) -> Point {
        let along = |index: u16| (f64::from(index) + 0.5) * self.pitch;
        Point::new(along(cell.x), along(cell.y))
    }

    /// The cell a point lies in, none outside the maze.
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

    /// Takes in one reading made at `pose`: the walls it passes are open, and it ends at one. Where it ends between two lines of
    /// the grid it says nothing of the farther one; far from parallel to both axes it says nothing at all. One of full range
    /// met nothing. O(cells along the ray).
    pub fn observe(&mut self, pose: Pose, reading: RangeReading) {
        let heading = pose.heading.turned(reading.bearing);
        let unit = heading.unit();
        if unit.x.abs().max(unit.y.abs()) < STRAIGHT || !reading.range.is_finite() {
            return;
        }
        let met = reading.range < reading.max_range;
        let face = self.thickness / 2.0;
        for crossing in self.crossings(pose.position, heading) {
            if !crossing.along_axis {
                // It leaves its row: what it sees from there on is to the side.
                return;
            }
            let beyond = reading.range + face - crossing.line.distance;
            if beyond > TOLERANCE * self.pitch {
                self.vote(crossing.cell, crossing.line.side, -1);
            } else {
                if met && beyond > -TOLERANCE * self.pitch {
                    self.vote(crossing.cell, crossing.line.side, 1);
                }
                return;
            }
        }
    }

    fn vote(&mut self, cell: Cell, side: Direction, vote: i8) {
        if let Some(votes) = self.votes.get_mut(self.grid.wall(cell, side).0 as usize) {
            *votes = (*votes + vote).clamp(-Self::MOST, Self::MOST);
        }
    }

    /// Where a ray from `origin` may end that reaches `max_range`: at the lines of the grid that it crosses where a wall may
    /// stand, the nearest first, up to the first that is believed in.
    pub fn meetings(
        &self,
        origin: Point,
        heading: Heading,
        max_range: f64,
    ) -> impl Iterator<Item = Meeting> {
        let mut ended = false;
        let meetings = self.crossings(origin, heading).map_while(move |crossing| {
            let face = self.thickness / 2.0 / crossing.line.slope;
            let range = (crossing.line.distance - face).max(0.0);
            if ended || range >= max_range {
                return None;
            }
            let known = self.knowledge(crossing.cell, crossing.line.side);
            ended = known == Knowledge::Wall;
            Some(Meeting { range, known })
        });
        meetings.filter(|meeting| meeting.known != Knowledge::Open)
    }

    /// The sides of cells that a ray crosses, the nearest first (Amanatides and Woo, "A fast voxel traversal algorithm for
    /// ray tracing", 1987).
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
        match self.votes[self.grid.wall(cell, direction).0 as usize] {
            Self::CONVINCED.. => Knowledge::Wall,
            ..=Self::DOUBTED => Knowledge::Open,
            _ => Knowledge::Unknown,
        }
    }
}

/// The next line that a ray crosses along x or y.
#[derive(Clone, Copy)]
struct Axis {
    distance: f64,
    /// From one line to the next.
    step: f64,
    /// The side crossed there.
    side: Direction,
    /// The share of the ray that goes that way.
    slope: f64,
}

struct Crossing {
    cell: Cell,
    line: Axis,
    /// Whether the ray runs along the axis it crosses here, more than across it.
    along_axis: bool,
}
