//! A world of corridors in which corners and doorways are the places: the paper's simulated environments.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_geom::{Point, Vector};
use tolman_maze::{Cell, Direction, Maze};
use tolman_sim::{CorridorSize, Door, DoorState, Material, Wall, World, WorldError};

/// From wall to wall of a corridor, m.
pub const CORRIDOR_WIDTH: f64 = 1.2;
/// How thick walls are: what lies between two corridors, m.
pub const WALL_THICKNESS: f64 = 1.8;
/// How deep the narrow part of a doorway is, in the middle of the wall, m.
const DOORWAY_DEPTH: f64 = 0.6;
/// From jamb to jamb of a doorway, m.
pub const DOORWAY_WIDTH: f64 = 0.8;
/// From the middle of one cell to that of the next, m.
pub const PITCH: f64 = CORRIDOR_WIDTH + WALL_THICKNESS;

/// How an office is furnished.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OfficeConfig {
    /// Which share of the passages between two cells are doorways, 0 … 1; which ones, `seed` decides.
    pub doorway_share: f64,
    /// How many colours the walls have, each piece as long as a cell its own: 1 makes all places look the same.
    pub colours: u32,
    /// Of the doorways and the colours.
    pub seed: u64,
}

/// A maze as a world with doorways and painted walls, and what is truly there: the places and the ways between them.
///
/// Where four cells make a square without walls, a pillar stands between them: all floor is corridor.
#[derive(Clone, Debug)]
pub struct Office {
    maze: Maze,
    /// Passages that are doorways, each named from its south or west cell, in order.
    doorways: Vec<(Cell, Direction)>,
    world: Arc<World>,
}

/// Why a maze makes no office.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OfficeError {
    /// The share of doorways is none.
    #[error("`doorway_share` is {share}; give a number from 0 to 1")]
    DoorwayShare {
        /// The offending share.
        share: f64,
    },
    /// There are no colours.
    #[error("`colours` is 0; give 1 or more")]
    NoColours,
    /// The world cannot be built.
    #[error("the maze makes no world")]
    World(#[from] WorldError),
}

impl Office {
    /// Raises the walls of a maze.
    ///
    /// # Errors
    /// [`OfficeError`] if the configuration has no sense.
    pub fn new(maze: &Maze, config: &OfficeConfig) -> Result<Self, OfficeError> {
        let share = config.doorway_share;
        if !(0.0..=1.0).contains(&share) {
            return Err(OfficeError::DoorwayShare { share });
        }
        if config.colours == 0 {
            return Err(OfficeError::NoColours);
        }
        let mut rng = ChaCha8Rng::seed_from_u64(config.seed);
        let passages = maze.grid().cells().flat_map(|cell| {
            let ahead = [Direction::North, Direction::East];
            ahead.map(|direction| (cell, direction))
        });
        let doorways: Vec<(Cell, Direction)> = passages
            .filter(|(cell, direction)| maze.is_open(*cell, *direction))
            .filter(|_| rng.random_range(0.0..1.0) < share)
            .collect();
        let palette: Vec<[u8; 3]> = match config.colours {
            1 => vec![Material::default().colour],
            colours => (0..colours)
                .map(|_| core::array::from_fn(|_| (rng.random_range(0_u32..256)) as u8))
                .collect(),
        };
        let mut paint = || {
            let colour = palette[rng.random_range(0..config.colours) as usize];
            Material {
                colour,
                ..Material::default()
            }
        };
        let size = CorridorSize {
            corridor_width: CORRIDOR_WIDTH,
            wall_thickness: WALL_THICKNESS,
        };
        let bare = World::from_maze(maze, &size)?;
        let mut walls = Vec::new();
        for wall in bare.walls() {
            pieces(wall, &mut paint, &mut walls);
        }
        for cell in maze.grid().cells() {
            if stands_free(maze, cell) {
                pillar(cell, &mut paint, &mut walls);
            }
        }
        for (cell, direction) in &doorways {
            jambs(*cell, *direction, &mut paint, &mut walls);
        }
        let mut world = World::from_segments(walls)?;
        for (number, (cell, direction)) in doorways.iter().enumerate() {
            for door in leaves(number, *cell, *direction) {
                world = world.with_door(door)?;
            }
        }
        Ok(Self {
            maze: maze.clone(),
            doorways,
            world: Arc::new(world),
        })
    }

    /// Its walls. Doorway n has two leaves, `n a` and `n b`; shut, they make a wall of the passage.
    #[must_use]
    pub const fn world(&self) -> &Arc<World> {
        &self.world
    }

    /// The maze it was built from.
    #[must_use]
    pub const fn maze(&self) -> &Maze {
        &self.maze
    }

    /// How many doorways there are.
    #[must_use]
    pub const fn doorways(&self) -> usize {
        self.doorways.len()
    }

    /// Where a doorway is.
    ///
    /// # Panics
    /// If there are not so many.
    #[must_use]
    pub fn doorway(&self, number: usize) -> Point {
        let (cell, direction) = self.doorways[number];
        between(cell, direction)
    }

    /// What is truly there while some doorways are shut: a place at every bend, junction and dead end of the corridors and in
    /// every open doorway, and from each the ways to the next in the four directions.
    ///
    /// O(cells · length of the longest corridor).
    #[must_use]
    pub fn places(&self, shut: &[usize]) -> Vec<TruePlace> {
        let is_shut = |number: &usize| shut.contains(number);
        let doorway = |cell: Cell, direction: Direction| {
            let wanted = self.passage(cell, direction);
            self.doorways.iter().position(|at| Some(*at) == wanted)
        };
        let open = |cell: Cell, direction: Direction| {
            self.maze.is_open(cell, direction)
                && !doorway(cell, direction).is_some_and(|number| is_shut(&number))
        };
        let mut spots = Vec::new();
        for cell in self.maze.grid().cells() {
            let ways = Direction::ALL.map(|direction| open(cell, direction));
            let straight = ways == [true, false, true, false] || ways == [false, true, false, true];
            if !straight && ways.contains(&true) {
                spots.push(Spot::Corner(cell));
            }
        }
        let doors = (0..self.doorways.len()).filter(|number| !is_shut(number));
        spots.extend(doors.map(Spot::Doorway));
        let index: BTreeMap<Spot, usize> = spots.iter().copied().zip(0..).collect();
        // From a cell on in one direction, to the next place.
        let onward = |mut cell: Cell, direction: Direction| loop {
            if !open(cell, direction) {
                return None;
            }
            if let Some(number) = doorway(cell, direction) {
                return index.get(&Spot::Doorway(number)).copied();
            }
            cell = self.maze.grid().neighbour(cell, direction)?;
            if let Some(place) = index.get(&Spot::Corner(cell)) {
                return Some(*place);
            }
        };
        let behind = |number: usize, direction: Direction| {
            let (cell, along) = self.doorways[number];
            let beyond = match direction {
                _ if direction == along => self.maze.grid().neighbour(cell, along)?,
                _ if direction == along.opposite() => cell,
                _ => return None,
            };
            let place = index.get(&Spot::Corner(beyond)).copied();
            place.or_else(|| onward(beyond, direction))
        };
        spots
            .iter()
            .map(|spot| TruePlace {
                kind: match spot {
                    Spot::Corner(_) => PlaceKind::Corner,
                    Spot::Doorway(_) => PlaceKind::Doorway,
                },
                position: match *spot {
                    Spot::Corner(cell) => middle(cell),
                    Spot::Doorway(number) => self.doorway(number),
                },
                ways: Direction::ALL.map(|direction| match *spot {
                    Spot::Corner(cell) => onward(cell, direction),
                    Spot::Doorway(number) => behind(number, direction),
                }),
            })
            .collect()
    }

    /// A passage as doorways are named.
    fn passage(&self, cell: Cell, direction: Direction) -> Option<(Cell, Direction)> {
        match direction {
            Direction::North | Direction::East => Some((cell, direction)),
            Direction::South | Direction::West => {
                let neighbour = self.maze.grid().neighbour(cell, direction)?;
                Some((neighbour, direction.opposite()))
            }
        }
    }
}

/// A place that is truly there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruePlace {
    /// What makes it one.
    pub kind: PlaceKind,
    /// Where it is, m.
    pub position: Point,
    /// The place that the way north, east, south and west leads to; none where a wall is.
    pub ways: [Option<usize>; 4],
}

/// What makes a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceKind {
    /// A bend, a junction or the end of a corridor.
    Corner,
    /// A narrow passage.
    Doorway,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Spot {
    Corner(Cell),
    Doorway(usize),
}

/// The middle of a cell.
fn middle(cell: Cell) -> Point {
    Point::new(
        (f64::from(cell.x) + 0.5) * PITCH,
        (f64::from(cell.y) + 0.5) * PITCH,
    )
}

/// The middle between a cell and the next.
fn between(cell: Cell, direction: Direction) -> Point {
    middle(cell) + unit(direction) * (0.5 * PITCH)
}

/// One metre in a direction.
pub(super) fn unit(direction: Direction) -> Vector {
    let (east, north) = direction.step();
    Vector::new(f64::from(east), f64::from(north))
}

/// Cuts a wall into pieces no longer than a cell and paints each.
fn pieces(wall: &Wall, paint: &mut impl FnMut() -> Material, walls: &mut Vec<Wall>) {
    let along = wall.end - wall.start;
    let count = libm::ceil(along.norm() / PITCH - 1e-9).max(1.0) as u32;
    for piece in 0..count {
        let at = |index: u32| wall.start + along * (f64::from(index) / f64::from(count));
        walls.push(Wall {
            start: at(piece),
            end: at(piece + 1),
            material: paint(),
        });
    }
}

/// Whether no wall ends at the north-east corner of a cell.
fn stands_free(maze: &Maze, cell: Cell) -> bool {
    let beyond = |direction: Direction| maze.grid().neighbour(cell, direction);
    let (Some(north), Some(east)) = (beyond(Direction::North), beyond(Direction::East)) else {
        return false;
    };
    maze.is_open(cell, Direction::North)
        && maze.is_open(cell, Direction::East)
        && maze.is_open(north, Direction::East)
        && maze.is_open(east, Direction::North)
}

/// A pillar at the north-east corner of a cell, which keeps the corridors beside it apart.
fn pillar(cell: Cell, paint: &mut impl FnMut() -> Material, walls: &mut Vec<Wall>) {
    let centre = middle(cell) + Vector::new(0.5 * PITCH, 0.5 * PITCH);
    let corner = |x: f64, y: f64| centre + Vector::new(x, y) * (0.5 * WALL_THICKNESS);
    let outline = [
        (-1.0, -1.0),
        (1.0, -1.0),
        (1.0, 1.0),
        (-1.0, 1.0),
        (-1.0, -1.0),
    ];
    let outline = outline.map(|(x, y)| corner(x, y));
    for ends in outline.windows(2) {
        walls.push(Wall {
            start: ends[0],
            end: ends[1],
            material: paint(),
        });
    }
}

/// What narrows a passage to a doorway: on both sides the outline of a post.
fn jambs(
    cell: Cell,
    direction: Direction,
    paint: &mut impl FnMut() -> Material,
    walls: &mut Vec<Wall>,
) {
    let (centre, ahead) = (between(cell, direction), unit(direction));
    for side in [unit(direction.left()), unit(direction.right())] {
        let corner = |across: f64, along: f64| {
            centre + side * (0.5 * across) + ahead * (0.5 * along * DOORWAY_DEPTH)
        };
        let outline = [
            corner(CORRIDOR_WIDTH, -1.0),
            corner(DOORWAY_WIDTH, -1.0),
            corner(DOORWAY_WIDTH, 1.0),
            corner(CORRIDOR_WIDTH, 1.0),
        ];
        for ends in outline.windows(2) {
            walls.push(Wall {
                start: ends[0],
                end: ends[1],
                material: paint(),
            });
        }
    }
}

/// The two leaves of a doorway's door, one at each face of the wall, so that shut it looks like a wall from both sides.
fn leaves(number: usize, cell: Cell, direction: Direction) -> [Door; 2] {
    let across = unit(direction.left()) * (0.5 * CORRIDOR_WIDTH);
    let depth = unit(direction) * (0.5 * WALL_THICKNESS);
    let centre = between(cell, direction);
    [("a", centre - depth), ("b", centre + depth)].map(|(leaf, at)| Door {
        name: format!("{number} {leaf}"),
        start: at - across,
        end: at + across,
        material: Material::default(),
        state: DoorState::Open,
        schedule: Vec::new(),
    })
}
