use std::path::{Path, PathBuf};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_arena::contest::{Condition, Contest};
use tolman_arena::family::{Family, FamilySize};
use tolman_arena::registry::{Registry, RobotEntry, SystemEntry};
use tolman_experiment::files::files_in;
use tolman_experiment::{BoxError, run_seed};
use tolman_maze::{Cell, Direction, Maze};

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
}

/// A drawing, with the seed of the contest in it.
#[derive(Clone, Debug)]
pub struct DrawnWorld {
    /// Name of the world.
    pub name: String,
    /// Maze of the drawing.
    pub maze: Maze,
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
            Self::File { name, .. } => name,
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
        let (name, maze) = match self {
            Self::Family(family) => {
                let rng = &mut ChaCha8Rng::seed_from_u64(seed);
                let maze = (family.draw)(family.size(size), rng)?;
                (format!("{} {number}", family.name), maze)
            }
            Self::File { name, maze, .. } => (name.clone(), with_start(maze, seed)),
        };
        Ok(DrawnWorld {
            name,
            maze,
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
        }
    }
}
