use alloc::collections::BTreeSet;
use alloc::sync::Arc;

use tolman_geom::{Point, Pose};
use tolman_maze::{Cell, Grid, Maze};
use tolman_robot::Body;

use crate::casters::{Caster, CasterChoice, Lanes, LatticeWalk, WallIndex};
use crate::scene::Placed;
use crate::{Door, contact};

mod bit_rows;
mod bounds;
mod error;
mod file;
mod lattice;
mod material;
mod wall_segment;
mod zone;

pub use bounds::Bounds;
pub use error::WorldError;
pub(crate) use file::Head;
pub use file::{Polyline, WorldFileError};
pub use lattice::Occupancy;
pub use material::Material;
pub use wall_segment::WallSegment;
pub use zone::{Area, Zone};

pub(crate) use bit_rows::BitRows;
pub(crate) use lattice::Lattice;

/// Scale of a grid maze.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CorridorSize {
    /// The free width between two walls, m.
    pub corridor_width: f64,
    /// Thickness of a wall, m; 0 for walls that are lines.
    pub wall_thickness: f64,
}

impl CorridorSize {
    /// Returns corridors `corridor_width` wide, m, between walls that are lines.
    #[must_use]
    pub const fn thin(corridor_width: f64) -> Self {
        Self {
            corridor_width,
            wall_thickness: 0.0,
        }
    }

    /// Returns the distance from the middle of one cell to that of the next, m.
    #[must_use]
    pub fn pitch(&self) -> f64 {
        self.corridor_width + self.wall_thickness
    }
}

/// The static parts of a world: walls, zones, and doors in their frames.
///
/// Metres; x is east, y is north. A world made from a maze has its origin in the middle of the wall
/// post at the south-west corner of cell (0, 0). So cell (x, y) covers [x, x + 1] × [y, y + 1]
/// pitches, including half the thickness of its walls.
///
/// ```
/// use tolman_sim::geom::Point;
/// use tolman_sim::maze::{Cell, Grid, Maze};
/// use tolman_sim::{CorridorSize, WallSegment, World};
///
/// // From a maze, or from walls anywhere.
/// let maze = Maze::open(Grid::new(3, 1));
/// let corridor = World::from_maze(&maze, &CorridorSize::thin(0.9))?;
/// assert!((corridor.cell_centre(Cell::new(1, 0)) - Point::new(1.35, 0.45)).norm() < 1e-12);
/// let wall = WallSegment::between(Point::new(0.0, 0.0), Point::new(4.0, 3.0));
/// let world = World::from_segments(vec![wall])?;
/// assert_eq!(world.walls().len(), 1);
/// # Ok::<(), tolman_sim::WorldError>(())
/// ```
#[derive(Clone, Debug)]
pub struct World {
    walls: Vec<WallSegment>,
    zones: Vec<Zone>,
    doors: Vec<Door>,
    bounds: Bounds,
    lattice: Option<Arc<Lattice>>,
    index: Arc<WallIndex>,
    caster: Arc<dyn Caster>,
    cells: Option<Cells>,
    /// Material that all walls share; `None` if they differ.
    common_material: Option<Material>,
}

/// The cells of a world made from a maze.
#[derive(Clone, Copy, Debug, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Cells {
    width: u16,
    height: u16,
    pitch: f64,
}

impl World {
    /// Returns a maze drawn to scale. Its goal cells become the zone `destination`, its start cell
    /// the zone `start`, and those of landmark 1 the zone `landmark 1`, if the maze marks them.
    ///
    /// Walls that continue each other in a straight line become one [`WallSegment`]. Thick walls
    /// have an outline, and a post of their thickness wherever one ends.
    ///
    /// # Errors
    /// If the corridor has no width, or a wall a negative thickness.
    pub fn from_maze(maze: &Maze, size: &CorridorSize) -> Result<Self, WorldError> {
        let CorridorSize {
            corridor_width,
            wall_thickness,
        } = *size;
        if !(corridor_width.is_finite() && corridor_width > 0.0) {
            return Err(WorldError::CorridorWidth { corridor_width });
        }
        if !(wall_thickness.is_finite() && wall_thickness >= 0.0) {
            return Err(WorldError::WallThickness { wall_thickness });
        }
        let pitch = size.pitch();
        let cells = Cells {
            width: maze.grid().width(),
            height: maze.grid().height(),
            pitch,
        };
        let lattice = Lattice::of_maze(maze, pitch, wall_thickness);
        let mut world = Self::from_lattice(lattice, Material::default())?;
        world.cells = Some(cells);
        if let Some((start, _)) = maze.start() {
            world = world.with_zone(Zone::of_cells("start", &[start], pitch))?;
        }
        if !maze.goals().is_empty() {
            world = world.with_zone(Zone::of_cells("destination", maze.goals(), pitch))?;
        }
        for number in Maze::LANDMARKS {
            let cells = maze.landmarks().iter().filter(|(_, of)| **of == number);
            let cells: Vec<Cell> = cells.map(|(cell, _)| *cell).collect();
            if !cells.is_empty() {
                let name = format!("landmark {number}");
                world = world.with_zone(Zone::of_cells(&name, &cells, pitch))?;
            }
        }
        Ok(world)
    }

    /// Returns a world of free walls.
    ///
    /// # Errors
    /// If there is no wall, or a wall has no length, or an end of one is not a number.
    pub fn from_segments(walls: Vec<WallSegment>) -> Result<Self, WorldError> {
        if walls.is_empty() {
            return Err(WorldError::NoWalls);
        }
        for (index, wall) in walls.iter().enumerate() {
            wall.check().map_err(|what| WorldError::Wall {
                index,
                wall: *wall,
                what,
            })?;
        }
        let bounds = Bounds::of(walls.iter().flat_map(|wall| [wall.start, wall.end]));
        let index = Arc::new(WallIndex::new(&walls, Lanes::Widest));
        let first = walls[0].material;
        let alike = walls.iter().all(|wall| wall.material == first);
        Ok(Self {
            common_material: alike.then_some(first),
            zones: Vec::new(),
            doors: Vec::new(),
            bounds,
            lattice: None,
            caster: CasterChoice::current()
                .made(&walls)
                .unwrap_or_else(|| Arc::clone(&index) as Arc<dyn Caster>),
            index,
            cells: None,
            walls,
        })
    }

    /// Returns the outline of the occupied cells of an occupancy grid; beyond its edge everything
    /// is occupied.
    ///
    /// # Errors
    /// If the grid is empty or wholly occupied, its resolution is not positive, or there is not one
    /// bit per cell.
    pub fn from_occupancy(occupancy: &Occupancy) -> Result<Self, WorldError> {
        Self::from_lattice(Lattice::of_occupancy(occupancy)?, Material::default())
    }

    fn from_lattice(lattice: Lattice, material: Material) -> Result<Self, WorldError> {
        let mut world = Self::from_segments(lattice.walls(material))?;
        world.bounds = lattice.bounds();
        world.lattice = Some(Arc::new(lattice));
        match LatticeWalk::new(&world, Lanes::Widest) {
            Some(caster) if CasterChoice::current() == CasterChoice::BuiltIn => {
                Ok(world.with_caster(Arc::new(caster)))
            }
            _ => Ok(world),
        }
    }

    /// Returns this world with a further zone.
    ///
    /// # Errors
    /// If there is already a zone of that name, or one of its numbers is not finite.
    pub fn with_zone(self, zone: Zone) -> Result<Self, WorldError> {
        self.with_zones([zone])
    }

    /// Returns this world with further zones. O(n log n).
    ///
    /// # Errors
    /// As [`World::with_zone`], of the first zone that does not fit.
    pub fn with_zones(mut self, zones: impl IntoIterator<Item = Zone>) -> Result<Self, WorldError> {
        let mut names: BTreeSet<String> = self
            .zones
            .iter()
            .map(|zone| zone.name().to_owned())
            .collect();
        for zone in zones {
            let name = zone.name().to_owned();
            if !names.insert(name.clone()) {
                return Err(WorldError::ZoneTwice { name });
            }
            zone.check()?;
            self.zones.push(zone);
        }
        Ok(self)
    }

    /// Returns this world with a further door.
    ///
    /// # Errors
    /// If there is already a door of that name, or the door has no length. Also if one of its
    /// numbers is invalid, or its schedule is not in order of time.
    pub fn with_door(self, door: Door) -> Result<Self, WorldError> {
        self.with_doors([door])
    }

    /// Returns this world with further doors. O(n log n).
    ///
    /// # Errors
    /// As [`World::with_door`], of the first door that does not fit.
    pub fn with_doors(mut self, doors: impl IntoIterator<Item = Door>) -> Result<Self, WorldError> {
        let mut names: BTreeSet<String> = self.doors.iter().map(|door| door.name.clone()).collect();
        for door in doors {
            if !names.insert(door.name.clone()) {
                return Err(WorldError::DoorTwice { name: door.name });
            }
            check(&door)?;
            self.doors.push(door);
        }
        Ok(self)
    }

    /// Returns this world with another ray caster, which must be made from the same walls. The
    /// built-in choice is [`LatticeWalk`] for mazes and occupancy grids, [`WallIndex`] for free
    /// walls.
    #[must_use]
    pub fn with_caster(mut self, caster: Arc<dyn Caster>) -> Self {
        self.caster = caster;
        self
    }

    /// Returns the ray caster of all sensors.
    #[must_use]
    pub fn caster(&self) -> &dyn Caster {
        &*self.caster
    }

    /// Returns the index of all walls.
    pub(crate) fn index(&self) -> &Arc<WallIndex> {
        &self.index
    }

    /// Returns the material that all walls share, or `None` if they differ.
    pub(crate) fn common_material(&self) -> Option<Material> {
        self.common_material
    }

    /// Returns the grid on which the walls stand, or `None` for free walls.
    pub(crate) fn lattice(&self) -> Option<&Arc<Lattice>> {
        self.lattice.as_ref()
    }

    /// Returns all walls, without doors.
    #[must_use]
    pub fn walls(&self) -> &[WallSegment] {
        &self.walls
    }

    /// Returns all zones.
    #[must_use]
    pub fn zones(&self) -> &[Zone] {
        &self.zones
    }

    /// Returns the zone of this name.
    #[must_use]
    pub fn zone(&self, name: &str) -> Option<&Zone> {
        self.zones.iter().find(|zone| zone.name() == name)
    }

    /// Returns all doors in their initial states.
    #[must_use]
    pub fn doors(&self) -> &[Door] {
        &self.doors
    }

    /// Returns the smallest rectangle that holds all walls.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Returns the size of the world's maze, or `None` if it was not made from one.
    #[must_use]
    pub fn grid(&self) -> Option<Grid> {
        self.cells.map(|cells| Grid::new(cells.width, cells.height))
    }

    /// Returns the middle of a cell of the maze this world was made from. In a world of another
    /// kind cells have no size, and this is the origin.
    #[must_use]
    pub fn cell_centre(&self, cell: Cell) -> Point {
        let pitch = self.cells.map_or(0.0, |cells| cells.pitch);
        Point::new(
            (f64::from(cell.x) + 0.5) * pitch,
            (f64::from(cell.y) + 0.5) * pitch,
        )
    }

    /// Returns the same world with the cells of `other`, which was made from the same maze.
    #[must_use]
    pub fn with_cells_of(self, other: &Self) -> Self {
        Self {
            cells: other.cells,
            ..self
        }
    }

    /// Returns the cell in which `point` lies, of the maze this world was made from. `None` outside
    /// the maze and in a world of another kind.
    #[must_use]
    pub fn cell_at(&self, point: Point) -> Option<Cell> {
        let Cells {
            width,
            height,
            pitch,
        } = self.cells?;
        let along = |value: f64, count: u16| {
            let index = (value / pitch).floor();
            (index >= 0.0 && index < f64::from(count)).then_some(index as u16)
        };
        Some(Cell::new(along(point.x, width)?, along(point.y, height)?))
    }

    /// Returns the distance of `point` from the nearest wall, m. Doors do not count.
    #[must_use]
    pub fn nearest_wall_distance(&self, point: Point) -> f64 {
        self.walls
            .iter()
            .map(|wall| wall.distance(point))
            .fold(f64::INFINITY, f64::min)
    }

    /// Returns whether `point` is free floor: not inside a thick wall or an occupied cell, and not
    /// outside the border of a maze.
    #[must_use]
    pub fn is_floor(&self, point: Point) -> bool {
        match &self.lattice {
            Some(lattice) => lattice.is_floor(point),
            None => point.x.is_finite() && point.y.is_finite(),
        }
    }

    /// Returns whether `body` at `pose` stands on the floor and touches no wall. Doors do not
    /// count.
    #[must_use]
    pub fn clear_for(&self, body: &Body, pose: Pose) -> bool {
        pose.is_finite()
            && self.is_floor(pose.position)
            && contact::is_clear(self, &[], &Placed::new(body.clone(), pose))
    }
}

/// Refuses an invalid door.
fn check(door: &Door) -> Result<(), WorldError> {
    if let Err(what) = door.wall().check() {
        let name = door.name.clone();
        return Err(WorldError::Door { name, what });
    }
    let mut pairs = door.schedule.windows(2);
    match pairs.find(|pair| pair[0].time_us >= pair[1].time_us) {
        Some(late) => Err(WorldError::DoorSchedule {
            time_us: late[1].time_us,
            name: door.name.clone(),
        }),
        None => Ok(()),
    }
}
