use std::path::{Path, PathBuf};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::Outing;
use tolman_arena::contest::{
    Condition, Contest, ContestError, ContestRecord, FloorContest, Moment,
};
use tolman_arena::course::{FreeWorld, Terrain};
use tolman_arena::family::{Family, FamilySize};
use tolman_arena::pioneer::body;
use tolman_arena::registry::{Registry, RobotEntry, Schooling, SystemEntry};
use tolman_experiment::files::files_in;
use tolman_experiment::{BoxError, run_seed};
use tolman_formats::{MapCell, RosMap, input};
use tolman_maze::{Cell, Direction, Maze};
use tolman_sim::{Occupancy, World, WorldError};

use crate::maze_file;

/// Returns a drawing of the family of this name.
pub(crate) fn drawn(
    family: &str,
    size: FamilySize,
    rng: &mut ChaCha8Rng,
) -> Result<Maze, BoxError> {
    let family = family_of(family)?;
    (family.draw)(family.size(size), rng)
}

/// Draws a world of the family with `size` columns and rows.
///
/// # Errors
/// If there is no such family, or it has no world of this size.
pub(crate) fn drawn_sized(
    family: &str,
    size: (u16, u16),
    rng: &mut ChaCha8Rng,
) -> Result<Maze, BoxError> {
    (family_of(family)?.draw)(size, rng)
}

fn family_of(name: &str) -> Result<Family, BoxError> {
    let families = Family::all();
    let family = Family::named(&families, name);
    Ok(*family.ok_or_else(|| format!("there is no family {name:?}"))?)
}

/// Returns a maze with its start, or else with a random one, at which all systems begin.
fn with_start(maze: &Maze, seed: u64) -> Maze {
    let mut maze = maze.clone();
    let ways = maze.reachable().filter(|cell| !maze.goals().contains(cell));
    let ways = ways.filter_map(|cell| Some((cell, maze.neighbours(cell).next()?.0)));
    let ways: Vec<(Cell, Direction)> = ways.collect();
    if maze.start().is_none() && !ways.is_empty() {
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        maze.set_start(Some(ways[rng.random_range(0..ways.len() as u32) as usize]));
    }
    maze
}

/// A kind of world that contests are held in.
#[derive(Clone, Debug)]
pub enum ArenaWorld {
    /// Drawings of a family, small and middle-sized ones in turn.
    Family(Family),
    /// The single drawing of a file.
    File {
        /// Name of the maze, or of the file if the maze has none.
        name: String,
        /// Maze that was read.
        maze: Maze,
        /// Width of its corridors by the file, m. The arena does not use it: its corridors are as
        /// wide as a robot needs.
        width: Option<f64>,
    },
    /// A world of free walls of a file, such as an occupancy grid.
    Floor {
        /// Name of the file.
        name: String,
        /// The world, perhaps without a destination.
        floor: FreeWorld,
    },
}

/// Worlds of files, and what is wrong with other files.
#[derive(Debug, Default)]
pub struct OthersWorlds {
    /// The worlds, in the order of the files.
    pub worlds: Vec<ArenaWorld>,
    /// Why a file of a folder is no world, one error for each.
    pub refused: Vec<BoxError>,
}

/// A drawing, with the seed of the contest in it.
#[derive(Clone, Debug)]
pub struct DrawnWorld {
    /// Name of the world.
    pub name: String,
    /// Maze of the drawing; of a floor, its squares for the laser Pioneer.
    pub maze: Maze,
    /// The world of free walls that takes the place of the drawing; `None` for a maze.
    pub floor: Option<FreeWorld>,
    /// Seed of all random numbers of the contest.
    pub seed: u64,
    /// Number of times that a robot is put down in the drawing for each task.
    pub starts: u32,
}

impl DrawnWorld {
    /// Returns the contest of a contestant in it.
    #[must_use]
    pub fn contest(
        &self,
        contestant: &'static dyn SystemEntry,
        robot: Option<RobotEntry>,
    ) -> Contest<'_> {
        Contest {
            contestant,
            robot,
            maze: &self.maze,
            name: &self.name,
            condition: Condition::AsMade,
            starts: self.starts,
            seed: self.seed,
            stopwatch: None,
        }
    }

    /// Holds a [contest](Self::contest) in it, or the same in its floor.
    ///
    /// # Errors
    /// [`ContestError`].
    pub fn hold(
        &self,
        contest: &Contest<'_>,
        schooling: &Schooling,
        watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<ContestRecord, ContestError> {
        let Some(floor) = &self.floor else {
            return contest.play(schooling, watch);
        };
        let contest = FloorContest {
            contestant: contest.contestant,
            robot: contest.robot,
            floor,
            name: contest.name,
            starts: contest.starts,
            seed: contest.seed,
        };
        contest.play(schooling, watch)
    }
}

impl ArenaWorld {
    /// Returns the families of the arena, then those that others have registered.
    #[must_use]
    pub fn families() -> Vec<Self> {
        let families = Registry::current().arena_families();
        families.map(Self::Family).collect()
    }

    /// Returns the mazes of files, and of all files in folders.
    ///
    /// # Errors
    /// If one cannot be read.
    pub fn of_files(paths: &[PathBuf]) -> Result<Vec<Self>, BoxError> {
        let mut worlds: Vec<Self> = Vec::new();
        for path in paths {
            let files = match path.is_dir() {
                true => files_in(path).map_err(|error| maze_file::in_file(path, error))?,
                false => vec![path.clone()],
            };
            for file in files {
                let world = Self::of_file(&file, &worlds)?;
                worlds.push(world);
            }
        }
        Ok(worlds)
    }

    /// Returns the mazes and floors of files, and of all files in folders. A floor is a
    /// tolman-world (`.json`), or the `.yaml` of an occupancy grid. The pictures of grids and
    /// other files of a folder, which are no worlds, are no errors.
    ///
    /// # Errors
    /// If a folder cannot be read, or a file that is named is no world.
    pub fn of_others(paths: &[PathBuf]) -> Result<OthersWorlds, BoxError> {
        let mut others = OthersWorlds::default();
        for path in paths {
            if !path.is_dir() {
                let world = Self::of_any(path, &others.worlds)?;
                others.worlds.push(world);
                continue;
            }
            let files = files_in(path).map_err(|error| maze_file::in_file(path, error))?;
            for file in files.iter().filter(|file| !is_picture(file, &files)) {
                match Self::of_any(file, &others.worlds) {
                    Ok(world) => others.worlds.push(world),
                    Err(error) => others.refused.push(error),
                }
            }
        }
        Ok(others)
    }

    fn of_any(path: &Path, before: &[Self]) -> Result<Self, BoxError> {
        let world = match extension(path) {
            "yaml" | "yml" => RosMap::read(path)
                .map_err(BoxError::from)
                .and_then(|map| Ok(world_of_map(map)?)),
            "json" => input::text(path)
                .map_err(BoxError::from)
                .and_then(|text| Ok(World::from_json(&text)?)),
            _ => return Self::of_file(path, before),
        };
        let world = world.map_err(|error| maze_file::in_file(path, error))?;
        let is_taken = |name: &str| name == "all" || before.iter().any(|one| one.name() == name);
        Ok(Self::Floor {
            name: maze_file::told_apart(&maze_file::stem(path), is_taken),
            floor: FreeWorld {
                world,
                corridor_width: None,
            },
        })
    }

    fn of_file(path: &Path, before: &[Self]) -> Result<Self, BoxError> {
        let file = maze_file::read(path)?;
        let name = file.name.clone().unwrap_or_else(|| maze_file::stem(path));
        let is_taken = |name: &str| name == "all" || before.iter().any(|one| one.name() == name);
        Ok(Self::File {
            name: maze_file::told_apart(&name, is_taken),
            maze: file.maze,
            width: file.corridor_width,
        })
    }

    /// Returns its name in the rows of tables.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Family(family) => family.name,
            Self::File { name, .. } | Self::Floor { name, .. } => name,
        }
    }

    /// Returns drawing `number` under a master seed. Drawings of a family are small for even
    /// numbers and middle-sized for odd ones.
    ///
    /// # Errors
    /// If the family cannot draw it.
    pub fn draw(&self, master_seed: u64, number: u32) -> Result<DrawnWorld, BoxError> {
        let size = match number.is_multiple_of(2) {
            true => FamilySize::Small,
            false => FamilySize::Middle,
        };
        let seed = run_seed(master_seed, self.name(), number);
        self.draw_sized(seed, number, size)
    }

    /// Returns drawing `number` of a given size by `seed`; a file's drawing has its own size.
    pub(super) fn draw_sized(
        &self,
        seed: u64,
        number: u32,
        size: FamilySize,
    ) -> Result<DrawnWorld, BoxError> {
        let mut floor_of_it = None;
        let (name, maze) = match self {
            Self::Family(family) => {
                let rng = &mut ChaCha8Rng::seed_from_u64(seed);
                let maze = (family.draw)(family.size(size), rng)?;
                (format!("{} {number}", family.name), maze)
            }
            Self::File { name, maze, .. } => (name.clone(), with_start(maze, seed)),
            Self::Floor { name, floor } => {
                let rng = &mut ChaCha8Rng::seed_from_u64(seed);
                let floor = floor.with_destination(&body(), rng);
                let floor = floor.map_err(|error| maze_file::in_file(Path::new(name), error))?;
                let terrain = Terrain::Free(floor);
                let course = terrain.course(name, &body());
                let course = course.map_err(|error| maze_file::in_file(Path::new(name), error))?;
                if let Terrain::Free(floor) = terrain {
                    floor_of_it = Some(floor);
                }
                (name.clone(), course.maze)
            }
        };
        Ok(DrawnWorld {
            name,
            maze,
            floor: floor_of_it,
            seed,
            starts: 1,
        })
    }

    /// Returns the configuration that results depend on.
    pub(super) fn config(&self) -> toml::Value {
        match self {
            Self::Family(Family { name, sizes, .. }) => {
                let sizes = sizes.map(|(width, height)| format!("{width}x{height}"));
                format!("{name}: {}", sizes.join(", ")).into()
            }
            Self::File { name, maze, .. } => format!("{name}\n{maze}").into(),
            Self::Floor { name, .. } => name.clone().into(),
        }
    }
}

/// Returns the world of a ROS map. Unknown cells count as occupied.
///
/// # Errors
/// If there are no walls in it, or too many.
pub fn world_of_map(map: RosMap) -> Result<World, WorldError> {
    let cells = map.cells.into_iter();
    World::from_occupancy(&Occupancy {
        width: map.width,
        height: map.height,
        resolution: map.resolution,
        origin: map.origin,
        occupied: cells.map(|cell| cell != MapCell::Free).collect(),
    })
}

fn extension(path: &Path) -> &str {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.unwrap_or_default()
}

/// Returns whether a file is the picture of an occupancy grid among `files`.
fn is_picture(path: &Path, files: &[PathBuf]) -> bool {
    let of_map = |map: &PathBuf| matches!(extension(map), "yaml" | "yml");
    let pictures = files.iter().filter(|map| of_map(map));
    let mut pictures = pictures.filter_map(|map| Some(RosMap::header(map).ok()?.1));
    pictures.any(|picture| picture.file_name() == path.file_name())
}
