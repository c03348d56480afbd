//! Makes worlds of corridors in which corners and doorways are the places: the paper's simulated
//! environments.

use alloc::collections::BTreeMap;
use core::f64::consts::PI;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_control::unit_of;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::diktiometry::Config;
use tolman_maze::{Cell, Direction, Grid, Maze};
use tolman_robot::Body;
use tolman_sim::{CorridorSize, Door, DoorState, Material, WallSegment, World};
use tolman_systems::diktiometry::DiktiometerConfig;
use tolman_systems::stream;

use super::SurveyorConfig;
use crate::BoxError;
use crate::contest::is_straight;
use crate::course::{Course, pick};
use crate::registry::because;

/// Depth of the narrow part of a doorway, in the middle of the wall, as a share of the corridor's
/// width.
const DOORWAY_DEPTH: f64 = 0.5;
/// Width of a doorway from jamb to jamb, as a share of the corridor's width.
const DOORWAY_WIDTH: f64 = 2.0 / 3.0;

/// Maximum number of colours: more than a camera tells apart, and few enough for a palette.
const MOST_COLOURS: u32 = 1 << 16;

/// Furnishing of an office.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct OfficeConfig {
    /// Width of a corridor from wall to wall, m. Adjacent openings are distinguished only if the
    /// walls between them are thick.
    pub corridor_width: f64,
    /// Thickness of walls between two parallel corridors, m; 0 for walls that are lines.
    pub wall_thickness: f64,
    /// Share of the passages between two cells that are doorways, 0 to 1; `seed` selects them.
    pub doorway_share: f64,
    /// Number of colours of the walls, at most 65536. Each piece as long as a cell has its own;
    /// with 1 all places look the same.
    pub colours: u32,
    /// Seed of the doorways and the colours.
    pub seed: u64,
}

impl OfficeConfig {
    /// Returns corridors 1.2 m wide and 4 m apart, without doorways, all of one colour.
    #[must_use]
    pub const fn bare() -> Self {
        Self {
            corridor_width: 1.2,
            wall_thickness: 2.8,
            doorway_share: 0.0,
            colours: 1,
            seed: 1,
        }
    }

    /// Returns the distance from the middle of one cell to that of the next, m.
    #[must_use]
    pub const fn pitch(&self) -> f64 {
        self.corridor_width + self.wall_thickness
    }

    /// Returns the distance from jamb to jamb of a doorway, m.
    #[must_use]
    pub const fn doorway_width(&self) -> f64 {
        DOORWAY_WIDTH * self.corridor_width
    }
}

/// A maze as a world with doorways and painted walls, with its true places and ways.
///
/// Four cells without walls between them have a pillar in their middle: all floor is corridor. If
/// the maze has a goal, only cells from which a way leads to a goal belong to the office.
#[derive(Clone, Debug)]
pub struct Office {
    /// Corridors of the office. Doorway n has two leaves, `n a` and `n b`; shut, they make a wall
    /// of the passage.
    pub course: Course,
    /// Passages that are doorways, each named from its south or west cell, in order.
    doorways: Vec<(Cell, Direction)>,
    /// Cells that belong to the office, in the order of the grid.
    cells: Vec<Cell>,
    config: OfficeConfig,
}

impl Office {
    /// Returns the office with this name for its maze.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.course.name);
        self
    }

    /// Raises the walls of a maze.
    ///
    /// # Errors
    /// If the configuration is invalid.
    pub fn new(maze: &Maze, config: &OfficeConfig) -> Result<Self, BoxError> {
        let share = config.doorway_share;
        if !(0.0..=1.0).contains(&share) {
            return Err(format!("`doorway_share` is {share}; give a number from 0 to 1").into());
        }
        if !(1..=MOST_COLOURS).contains(&config.colours) {
            let colours = config.colours;
            return Err(format!("`colours` is {colours}; give 1 to {MOST_COLOURS}").into());
        }
        let mut rng = ChaCha8Rng::seed_from_u64(config.seed);
        let cells: Vec<Cell> = match maze.goals() {
            [] => maze.grid().cells().collect(),
            _ => maze.reachable().collect(),
        };
        let passages = cells.iter().copied().flat_map(|cell| {
            let ahead = [Direction::North, Direction::East];
            ahead.map(|direction| (cell, direction))
        });
        let open = passages.filter(|(cell, direction)| maze.is_open(*cell, *direction));
        let doorways = open.filter(|_| rng.random_range(0.0..1.0) < share);
        let doorways: Vec<(Cell, Direction)> = doorways.collect();
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
            corridor_width: config.corridor_width,
            wall_thickness: config.wall_thickness,
        };
        let no_world = |error| {
            let what =
                "no world can be built from the maze; correct the maze or the office's settings";
            because(what, error)
        };
        let bare = World::from_maze(maze, &size).map_err(no_world)?;
        let pieces = bare.walls().iter().map(|wall| config.pieces(wall));
        let mut outlines: Vec<Vec<Point>> = pieces.collect();
        if config.wall_thickness > 0.0 {
            let rooms = cells.iter().filter(|cell| maze.is_room(**cell));
            outlines.extend(rooms.map(|cell| config.pillar(*cell)));
        }
        for (cell, direction) in &doorways {
            outlines.extend(config.jambs(*cell, *direction));
        }
        let stretches = outlines.iter().flat_map(|outline| outline.windows(2));
        let walls = stretches.map(|ends| WallSegment {
            start: ends[0],
            end: ends[1],
            material: paint(),
        });
        let walls = walls.collect();
        let world = World::from_segments(walls).map_err(no_world)?;
        let world = world.with_cells_of(&bare);
        let numbered = doorways.iter().enumerate();
        let doors = numbered
            .flat_map(|(number, (cell, direction))| config.doors(number, *cell, *direction));
        let world = world
            .with_zones(bare.zones().iter().cloned())
            .and_then(|world| world.with_doors(doors))
            .map_err(no_world)?;
        Ok(Self {
            course: Course::in_world("", maze.clone(), config.corridor_width, world),
            doorways,
            cells,
            config: *config,
        })
    }

    /// Returns the office's furnishing.
    #[must_use]
    pub const fn config(&self) -> &OfficeConfig {
        &self.config
    }

    /// Returns whether a position lies in a corridor, and not in the blocks between them.
    #[must_use]
    pub fn is_in_corridor(&self, position: Point) -> bool {
        let half = 0.5 * self.config.corridor_width;
        let Some(cell) = self.course.world.cell_at(position) else {
            return false;
        };
        let offset = position - self.config.middle(cell);
        let along = |way: Direction| offset.dot(&unit_of(way));
        let ways = self.course.maze.neighbours(cell).map(|(way, _)| way);
        let in_the_cell = offset.abs().max() < half;
        in_the_cell
            || ways
                .into_iter()
                .any(|way| along(way) > 0.0 && along(way.left()).abs() < half)
    }

    /// Returns a random pose for the start of a run, with any heading. It is in the corridors,
    /// outside the destination and doorways, where `body` stands clear of the walls.
    #[must_use]
    pub fn random_start(&self, body: &Body, rng: &mut impl Rng) -> Pose {
        let goals = self.course.maze.goals();
        let mut ways: Vec<(Cell, Direction)> = Vec::new();
        for cell in self.cells.iter().filter(|cell| !goals.contains(cell)) {
            let neighbours = self.course.maze.neighbours(*cell);
            ways.extend(neighbours.map(|(direction, _)| (*cell, direction)));
        }
        let heading = Heading::from_radians(rng.random_range(-PI..PI));
        let Some((cell, direction)) = pick(&ways, rng) else {
            return Pose::new(Point::origin(), heading);
        };
        let width = self.config.corridor_width;
        let play = (0.5 * width - body.radius()).max(0.0) * 0.99;
        let shut_out = if self.doorway_at(cell, direction).is_some() {
            0.5 * DOORWAY_DEPTH * width + body.radius()
        } else {
            0.0
        };
        let far = (0.5 * self.config.pitch() - shut_out).max(0.0);
        let along = unit_of(direction) * rng.random_range(0.0..=far);
        let aside = unit_of(direction.left()) * rng.random_range(-play..=play);
        Pose::new(self.config.middle(cell) + along + aside, heading)
    }

    /// Returns δ_sep, m: any two places are at least this far apart along one axis, whatever
    /// doorways are shut.
    #[must_use]
    pub fn separation(&self) -> f64 {
        match self.doorways.is_empty() {
            true => self.config.pitch(),
            false => 0.5 * self.config.pitch(),
        }
    }

    /// Returns the number of doorways.
    #[must_use]
    pub const fn doorways(&self) -> usize {
        self.doorways.len()
    }

    /// Returns the position of a doorway, m.
    ///
    /// # Panics
    /// If the office has `number` doorways or fewer.
    #[must_use]
    pub fn doorway(&self, number: usize) -> Point {
        let (cell, direction) = self.doorways[number];
        self.config.between(cell, direction)
    }

    /// Returns the true places while doorways `shut` are shut, by site. There is a place at every
    /// bend, junction and dead end of the corridors and in every open doorway. Each has the ways to
    /// the next places in the four directions.
    ///
    /// A site is the index of a cell in its grid, or, after all cells, the number of a doorway.
    /// O(cells · length of the longest corridor).
    #[must_use]
    pub fn places(&self, shut: &[usize]) -> BTreeMap<u32, TruePlace> {
        let mut maze = self.course.maze.clone();
        for (cell, direction) in shut.iter().map(|number| self.doorways[*number]) {
            maze.set_wall(cell, direction, true);
        }
        let corners = self.cells.iter().copied();
        let corners = corners.filter(|cell| is_corner(&maze, *cell));
        let corners = corners.map(|cell| TruePlace {
            site: self.site(cell),
            position: self.config.middle(cell),
            ways: Direction::ALL.map(|way| self.onward(&maze, cell, way)),
        });
        let doorways = (0..self.doorways.len()).filter(|number| !shut.contains(number));
        let doorways = doorways.map(|number| TruePlace {
            site: self.site_of_doorway(number),
            position: self.doorway(number),
            ways: Direction::ALL.map(|way| self.behind(&maze, number, way)),
        });
        let all = corners.chain(doorways);
        all.map(|place| (place.site, place)).collect()
    }

    /// Returns the configuration of a system with this mapper on a robot in the office.
    #[must_use]
    pub fn diktiometer(&self, robot: &SurveyorConfig, mapper: Config) -> DiktiometerConfig {
        let mut routines = robot.routines(self.config.corridor_width);
        routines.doorway_width = Some(self.config.doorway_width());
        DiktiometerConfig::paper(routines, mapper)
    }

    /// Returns a random place from which a run may start, by its seed.
    ///
    /// # Errors
    /// If there is none.
    pub(super) fn random_place(&self, seed: u64) -> Result<TruePlace, BoxError> {
        let places: Vec<TruePlace> = self.places(&[]).into_values().collect();
        pick(&places, &mut stream(seed, 0)).ok_or_else(|| no_way(Point::origin()))
    }

    /// Returns the place of `truth` at a position.
    ///
    /// # Errors
    /// If none is near.
    pub(super) fn place_at(&self, truth: &Places, at: Point) -> Result<TruePlace, BoxError> {
        let places = truth.values();
        let distances = places.map(|place| ((place.position - at).norm(), place));
        match distances.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((distance, place)) if distance < 0.5 * self.separation() => Ok(*place),
            _ => Err(format!(
                "the robot is at ({}, {}) m, which is not a place",
                at.x, at.y
            )
            .into()),
        }
    }

    /// Returns the names of the two leaves of a doorway's door.
    pub fn leaves(number: usize) -> [String; 2] {
        ["a", "b"].map(|leaf| format!("{number} {leaf}"))
    }

    fn site(&self, cell: Cell) -> u32 {
        self.course.maze.grid().index(cell) as u32
    }

    fn site_of_doorway(&self, number: usize) -> u32 {
        let grid = self.course.maze.grid();
        u32::from(grid.width()) * u32::from(grid.height()) + number as u32
    }

    /// Returns the number of the doorway in a direction from a cell. Doorways are named from their
    /// south or west cell.
    fn doorway_at(&self, cell: Cell, direction: Direction) -> Option<usize> {
        let passage = match direction {
            Direction::North | Direction::East => (cell, direction),
            Direction::South | Direction::West => {
                let neighbour = self.course.maze.grid().neighbour(cell, direction)?;
                (neighbour, direction.opposite())
            }
        };
        self.doorways.iter().position(|doorway| *doorway == passage)
    }

    /// Returns the site of the next place after a cell in one direction of a maze without the
    /// passages that are shut.
    fn onward(&self, maze: &Maze, mut cell: Cell, way: Direction) -> Option<u32> {
        while maze.is_open(cell, way) {
            if let Some(number) = self.doorway_at(cell, way) {
                return Some(self.site_of_doorway(number));
            }
            cell = maze.grid().neighbour(cell, way)?;
            if is_corner(maze, cell) {
                return Some(self.site(cell));
            }
        }
        None
    }

    /// Returns the site of the next place after a doorway in one direction.
    fn behind(&self, maze: &Maze, number: usize, way: Direction) -> Option<u32> {
        let (cell, along) = self.doorways[number];
        let beyond = match way {
            _ if way == along => maze.grid().neighbour(cell, along)?,
            _ if way == along.opposite() => cell,
            _ => return None,
        };
        if is_corner(maze, beyond) {
            return Some(self.site(beyond));
        }
        self.onward(maze, beyond, way)
    }
}

/// Returns the error that no way leads on from a position.
pub(super) fn no_way(at: Point) -> BoxError {
    format!(
        "no way leads on from ({}, {}) m; open a wall there",
        at.x, at.y
    )
    .into()
}

/// Returns whether a cell is a place: its corridor does not just lead straight on.
fn is_corner(maze: &Maze, cell: Cell) -> bool {
    maze.degree(cell) > 0 && !is_straight(maze, cell)
}

/// Returns corridors between blocks: a square grid with a random share of the inner walls, except
/// those that would cut a cell off.
pub fn blocks(side: u16, walls: f64, rng: &mut impl Rng) -> Maze {
    let grid = Grid::new(side, side);
    let mut maze = Maze::open(grid);
    maze.set_start(Some((Cell::new(0, 0), Direction::North)));
    for (cell, direction, _) in grid.inner_edges() {
        if rng.random_range(0.0..1.0) < walls {
            maze.set_wall(cell, direction, true);
            let steps = maze.steps_to(&[Cell::new(0, 0)]);
            if steps.contains(&None) {
                maze.set_wall(cell, direction, false);
            }
        }
    }
    maze
}

/// True places now, by site.
pub(super) type Places = BTreeMap<u32, TruePlace>;

/// A place that exists now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruePlace {
    /// Number of the place, the same whatever doorways are shut.
    pub site: u32,
    /// Position, m.
    pub position: Point,
    /// Site to which the way north, east, south and west leads, or `None` where a wall is.
    pub ways: [Option<u32>; 4],
}

impl TruePlace {
    /// Returns the number of ways that lead on.
    #[must_use]
    pub fn way_count(&self) -> usize {
        self.ways.iter().flatten().count()
    }
}

/// Returns the site to which a way truly leads, or `None` where a wall is.
pub(super) fn leads(truth: &Places, (site, direction): (u32, Direction)) -> Option<u32> {
    truth.get(&site)?.ways[direction.index()]
}

/// Returns the least distance between two places, m, or `None` if there are fewer. O(places²).
pub(super) fn least_distance(places: &Places) -> Option<f64> {
    let distances = places.values().flat_map(|one| {
        let later = places.range(one.site + 1..);
        later.map(|(_, other)| (one.position - other.position).norm())
    });
    distances.reduce(f64::min)
}

/// Positions of an office's parts.
impl OfficeConfig {
    /// Returns the middle of a cell.
    fn middle(&self, cell: Cell) -> Point {
        let along = |index: u16| (f64::from(index) + 0.5) * self.pitch();
        Point::new(along(cell.x), along(cell.y))
    }

    /// Returns the middle between a cell and the next.
    fn between(&self, cell: Cell, direction: Direction) -> Point {
        self.middle(cell) + unit_of(direction) * (0.5 * self.pitch())
    }

    /// Returns the outline of a wall in equal pieces no longer than a cell.
    fn pieces(&self, wall: &WallSegment) -> Vec<Point> {
        let along = wall.end - wall.start;
        let count = libm::ceil(along.norm() / self.pitch() - 1e-9).max(1.0) as u32;
        let at = |index: u32| wall.start + along * (f64::from(index) / f64::from(count));
        (0..=count).map(at).collect()
    }

    /// Returns the outline of a pillar at the north-east corner of a cell, which keeps the
    /// corridors beside it apart.
    fn pillar(&self, cell: Cell) -> Vec<Point> {
        let half = 0.5 * self.pitch();
        let centre = self.middle(cell) + Vector::new(half, half);
        let corner = |x: f64, y: f64| centre + Vector::new(x, y) * (0.5 * self.wall_thickness);
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let outline = corners.into_iter().cycle().take(5);
        outline.map(|(x, y)| corner(x, y)).collect()
    }

    /// Returns the outlines of the two posts, left and right, that narrow a passage to a doorway.
    fn jambs(&self, cell: Cell, direction: Direction) -> [Vec<Point>; 2] {
        let width = self.corridor_width;
        let (centre, ahead) = (self.between(cell, direction), unit_of(direction));
        [direction.left(), direction.right()].map(|side| {
            let corner = |across: f64, along: f64| {
                centre
                    + unit_of(side) * (0.5 * across)
                    + ahead * (0.5 * along * DOORWAY_DEPTH * width)
            };
            let doorway = self.doorway_width();
            let outline = [(width, -1.0), (doorway, -1.0), (doorway, 1.0), (width, 1.0)];
            outline.map(|(across, along)| corner(across, along)).into()
        })
    }

    /// Returns the two leaves of a doorway's door, one at each face of the wall. A shut door looks
    /// like a wall from both sides.
    fn doors(&self, number: usize, cell: Cell, direction: Direction) -> [Door; 2] {
        let across = unit_of(direction.left()) * (0.5 * self.corridor_width);
        let depth = unit_of(direction) * (0.5 * self.wall_thickness);
        let centre = self.between(cell, direction);
        let [a, b] = Office::leaves(number);
        [(a, centre - depth), (b, centre + depth)].map(|(name, at)| Door {
            name,
            start: at - across,
            end: at + across,
            material: Material::default(),
            state: DoorState::Open,
            schedule: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_the_passages_is_walled_up_and_nothing_is_cut_off() {
        for seed in 0..10 {
            let maze = blocks(7, 0.25, &mut ChaCha8Rng::seed_from_u64(seed));
            let all = Maze::open(maze.grid()).opening_count();
            let walled_up = all - maze.opening_count();
            assert!(
                (all / 8..all / 2).contains(&walled_up),
                "{walled_up} of {all}"
            );
            assert!(!maze.steps_to(&[Cell::new(0, 0)]).contains(&None));
        }
    }
}
