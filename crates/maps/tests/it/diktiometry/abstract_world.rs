//! A world without bodies and time: places, and moves that lead from one to the next.
//!
//! It gives a mapper of places the input that a robot would give, some thousand times faster than
//! the raycast world. Each move ends at the next place, and its odometry is wrong within known
//! bounds. The truth is recorded for scoring.

use alloc::sync::Arc;
use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Interval, IntervalError, Point, PointBox, PoseBox, Vector};
use tolman_maze::{Cell, Direction, Maze};
use tolman_sim::{Chance, Channel, Draws};

/// Places, and the place to which each direction leads from them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AbstractWorld {
    places: Vec<Point>,
    /// Per place, in the order of [`Direction::ALL`].
    neighbours: Vec<[Option<u32>; 4]>,
    /// Look of each place in each direction.
    looks: Vec<[f64; 4]>,
}

impl AbstractWorld {
    /// Returns a world with one place per cell, `spacing` m apart, numbered like the grid's cells.
    /// A move leads to the next cell if no wall stands between. All places look alike.
    pub(crate) fn from_maze(maze: &Maze, spacing: f64) -> Self {
        let cells: Vec<_> = maze.grid().cells().collect();
        let number = |cell| maze.grid().index(cell) as u32;
        Self::of_cells(&cells, spacing, |cell, direction| {
            maze.beside(cell, direction).map(number)
        })
    }

    /// Returns the corridors of a maze whose cells are `spacing` m apart. There is a place at every
    /// bend, junction and dead end, numbered in the order of their cells. A move leads straight on
    /// to the next. All places look alike.
    pub(crate) fn from_corridors(maze: &Maze, spacing: f64) -> Self {
        let ways = |cell| Direction::ALL.map(|direction| maze.is_open(cell, direction));
        let no_place = [
            [true, false, true, false],
            [false, true, false, true],
            [false; 4], // enclosed
        ];
        let is_place = |cell| !no_place.contains(&ways(cell));
        let cells: Vec<_> = maze.grid().cells().filter(|cell| is_place(*cell)).collect();
        let number = |cell| cells.iter().position(|other| *other == cell);
        let next = |cell, direction| {
            let mut along = core::iter::successors(maze.beside(cell, direction), |cell| {
                maze.beside(*cell, direction)
            });
            let place = along.find(|cell| is_place(*cell)).and_then(number);
            place.map(|place| place as u32)
        };
        Self::of_cells(&cells, spacing, next)
    }

    /// Returns a world with one place per cell, `spacing` apart, m. `next` gives the cell to which
    /// each direction leads.
    fn of_cells(
        cells: &[Cell],
        spacing: f64,
        next: impl Fn(Cell, Direction) -> Option<u32>,
    ) -> Self {
        let point = |x: u16, y: u16| Point::new(f64::from(x) * spacing, f64::from(y) * spacing);
        let ways = |cell| Direction::ALL.map(|direction| next(cell, direction));
        Self {
            places: cells.iter().map(|cell| point(cell.x, cell.y)).collect(),
            neighbours: cells.iter().copied().map(ways).collect(),
            looks: vec![[0.0; 4]; cells.len()],
        }
    }

    /// Returns a world of any places, m, with the numbers of the places to the north, east, south
    /// and west of each. `None` if the numbers of entries differ, or a way leads to a place that
    /// does not exist. All places look alike.
    pub(crate) fn of_places(places: Vec<Point>, neighbours: Vec<[Option<u32>; 4]>) -> Option<Self> {
        let known = |place: &u32| (*place as usize) < places.len();
        let closed = neighbours.iter().flatten().flatten().all(known);
        (places.len() == neighbours.len() && closed).then(|| Self {
            looks: vec![[0.0; 4]; places.len()],
            places,
            neighbours,
        })
    }

    /// Paints every wall around a place in one of `colours` colours, drawn evenly from `seed`: 0,
    /// 1, …
    pub(crate) fn painted(mut self, colours: u32, seed: u64) -> Self {
        let mut draws = Chance::of_run(seed).draws(Channel::named("abstract paint"));
        for look in self.looks.iter_mut().flatten() {
            *look = (draws.uniform() * f64::from(colours)).floor();
        }
        self
    }

    /// Gives every place the look of the place with the number that `of` returns, as in rooms that
    /// are furnished alike. Numbers of no place change nothing.
    pub(crate) fn looking_like(mut self, of: impl Fn(u32) -> u32) -> Self {
        let looks = self.looks.clone();
        for (place, look) in (0..).zip(&mut self.looks) {
            if let Some(other) = looks.get(of(place) as usize) {
                *look = *other;
            }
        }
        self
    }

    /// Paints the walls around one place again, each in another colour, if there are two or more.
    pub(crate) fn repainted(mut self, place: u32, colours: u32) -> Self {
        if let Some(look) = self.looks.get_mut(place as usize) {
            *look = look.map(|colour| (colour + 1.0) % f64::from(colours.max(1)));
        }
        self
    }

    /// Returns the world with another way from a place in a direction: opened, leading elsewhere or
    /// shut, like a door. If it leads to a place, the way back changes too. Places that do not
    /// exist change nothing.
    pub(crate) fn with_way(mut self, place: u32, direction: Direction, to: Option<u32>) -> Self {
        let back = direction.opposite() as usize;
        let count = self.places.len();
        if (place as usize) >= count || to.is_some_and(|to| (to as usize) >= count) {
            return self;
        }
        // What led here from where the way led before, and what led to `to` from elsewhere, leads
        // nowhere now.
        let before = self.neighbour(place, direction);
        let origin = to.and_then(|to| self.neighbour(to, direction.opposite()));
        let ends = [
            (before, back, Some(place)),
            (origin, direction as usize, to),
        ];
        for (end, side, led_to) in ends {
            if let Some(end) = end {
                let way = &mut self.neighbours[end as usize][side];
                if *way == led_to {
                    *way = None;
                }
            }
        }
        self.neighbours[place as usize][direction as usize] = to;
        if let Some(to) = to {
            self.neighbours[to as usize][back] = Some(place);
        }
        self
    }

    /// Returns the positions of the places, m, by number.
    pub(crate) fn places(&self) -> &[Point] {
        &self.places
    }

    /// Returns the place to which a direction leads from a place. `None` if it is blocked or the
    /// place does not exist.
    pub(crate) fn neighbour(&self, place: u32, direction: Direction) -> Option<u32> {
        self.neighbours.get(place as usize)?[direction as usize]
    }

    /// Returns the directions that lead somewhere, in the order of [`Direction::ALL`].
    pub(crate) fn exits(&self, place: u32) -> impl Iterator<Item = Direction> + '_ {
        let all = Direction::ALL.into_iter();
        all.filter(move |&direction| self.neighbour(place, direction).is_some())
    }
}

/// Errors of the measured moves, drawn uniformly within their bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MoveNoise {
    /// Bound of the error of each distance, as a share of it, 0 ≤ … < 1.
    pub(crate) distance: f64,
    /// Bound of the error of each heading of the compass, rad.
    pub(crate) compass: f64,
    /// Bound of an error of scale, as a share of the distance, that is drawn once and shared by all
    /// moves. The reported bounds do not include it.
    pub(crate) shared_scale: f64,
    /// Maximum distance from the place's point at which the robot stops, m, along each axis.
    pub(crate) stop: f64,
    /// Share of moves whose errors are `outlier_factor` times as large and break the bounds.
    pub(crate) outliers: f64,
    /// Factor of an outlier's error.
    pub(crate) outlier_factor: f64,
    /// Bound of the error of a look, in its own unit.
    pub(crate) look: f64,
}

impl MoveNoise {
    /// No errors at all.
    pub(crate) const NONE: Self = Self {
        distance: 0.0,
        compass: 0.0,
        shared_scale: 0.0,
        stop: 0.0,
        outliers: 0.0,
        outlier_factor: 1.0,
        look: 0.0,
    };
}

/// A robot in an [`AbstractWorld`].
#[derive(Clone, Debug)]
pub(crate) struct AbstractRobot {
    world: Arc<AbstractWorld>,
    errors: MoveNoise,
    chance: Chance,
    scale: f64,
    at: u32,
    /// Displacement of the robot from the point of its place where it stopped, m.
    stop: Vector,
    moves: u64,
}

/// A move with its truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AbstractMove {
    /// Place where the move began.
    pub(crate) from: u32,
    /// Direction of the move.
    pub(crate) direction: Direction,
    /// Place where the move ended.
    pub(crate) to: u32,
    /// True displacement of the robot, m.
    pub(crate) truth: Vector,
    /// Displacement by odometry, m, along the axes of the robot's compass.
    pub(crate) measured: Vector,
    /// Bounds of the move by its measurement, without the shared scale and outliers: the
    /// displacement along the true axes, m, and the heading.
    pub(crate) odometry: PoseBox,
    /// Looks of the place in each direction, in the order of [`Direction::ALL`].
    pub(crate) look: [f64; 4],
}

impl AbstractRobot {
    /// Returns a robot at a place; `seed` seeds all its random numbers.
    ///
    /// # Errors
    /// If an error's bound is negative or not a number.
    pub(crate) fn new(
        world: Arc<AbstractWorld>,
        at: u32,
        errors: MoveNoise,
        seed: u64,
    ) -> Result<Self, IntervalError> {
        for bound in [errors.distance, errors.compass, errors.stop, errors.look] {
            Interval::about(0.0, bound)?;
        }
        let chance = Chance::of_run(seed);
        let mut draws = chance.draws(Channel::named("abstract scale"));
        let scale = 1.0 + errors.shared_scale * (2.0 * draws.uniform() - 1.0);
        Ok(Self {
            world,
            errors,
            chance,
            scale,
            at,
            stop: Vector::zeros(),
            moves: 0,
        })
    }

    /// Returns the world.
    pub(crate) fn world(&self) -> &AbstractWorld {
        &self.world
    }

    /// Returns the number of the place where the robot is.
    pub(crate) const fn at(&self) -> u32 {
        self.at
    }

    /// Puts the robot at another place without telling it. Does nothing if the place does not
    /// exist.
    pub(crate) fn kidnap(&mut self, to: u32) {
        if (to as usize) < self.world.places.len() {
            self.at = to;
        }
    }

    /// Changes the world round the robot, which keeps its place: doors shut and open. Does nothing
    /// if the new world lacks that place.
    pub(crate) fn find_itself_in(&mut self, world: Arc<AbstractWorld>) {
        if (self.at as usize) < world.places.len() {
            self.world = world;
        }
    }

    /// Returns the numbers of a channel since the last move.
    fn draws(&self, channel: &str) -> Draws {
        let chance = self.chance.at(0, self.moves);
        chance.draws(Channel::named(channel))
    }

    /// Returns the view of the robot now.
    pub(crate) fn look(&self) -> [f64; 4] {
        let mut draws = self.draws("abstract look");
        let look = self.world.looks.get(self.at as usize).copied();
        look.unwrap_or_default()
            .map(|value| value + self.errors.look * (2.0 * draws.uniform() - 1.0))
    }

    /// Returns one of the open directions, all equally likely, or `None` if there are none.
    pub(crate) fn wander(&self) -> Option<Direction> {
        let mut draws = self.draws("abstract walk");
        let exits: Vec<Direction> = self.world.exits(self.at).collect();
        let drawn = (draws.uniform() * exits.len() as f64) as usize;
        exits.get(drawn).copied()
    }

    /// Goes to the next place. Returns `None` and stays if the direction is blocked.
    pub(crate) fn go(&mut self, direction: Direction) -> Option<AbstractMove> {
        let from = self.at;
        let to = self.world.neighbour(from, direction)?;
        self.moves += 1;
        self.at = to;
        let mut draws = self.draws("abstract odometry");
        let mut within = |bound: f64| bound * (2.0 * draws.uniform() - 1.0);
        let stop = Vector::new(within(self.errors.stop), within(self.errors.stop));
        let points = [from, to].map(|place| self.world.places[place as usize]);
        let truth = (points[1] + stop) - (points[0] + self.stop);
        self.stop = stop;

        let longer = within(self.errors.distance);
        let turned = within(self.errors.compass);
        let factor = if within(0.5) + 0.5 < self.errors.outliers {
            self.errors.outlier_factor
        } else {
            1.0
        };
        let distance = truth.norm() * self.scale * (1.0 + factor * longer);
        let heading = libm::atan2(truth.y, truth.x) + factor * turned;
        let measured = Vector::new(distance * libm::cos(heading), distance * libm::sin(heading));
        Some(AbstractMove {
            from,
            direction,
            to,
            truth,
            measured,
            odometry: self.bounds(measured, heading)?,
            look: self.look(),
        })
    }

    /// Returns bounds on all moves that could give this measurement.
    fn bounds(&self, measured: Vector, heading: f64) -> Option<PoseBox> {
        let MoveNoise {
            distance, compass, ..
        } = self.errors;
        let factor = Interval::of(1.0).ok()? + Interval::about(0.0, distance).ok()?;
        // The rounding of the measurement itself is less than this.
        let rounding = Interval::about(0.0, 1e-12 * (1.0 + measured.norm())).ok()?;
        // The length in the frame of the measured heading, then turned by the compass's error.
        let length = Interval::of(measured.norm()).ok()?.checked_div(factor)?;
        let heading = Interval::about(heading, compass).ok()?;
        let position = PointBox::new(length, Interval::ZERO).rotated(heading);
        Some(PoseBox::new(
            PointBox::new(position.x + rounding, position.y + rounding),
            heading,
        ))
    }
}
