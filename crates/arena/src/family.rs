//! Families of worlds: drawings of one kind, each from its size and its seed.

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use tolman_maze::drawings::{
    blocks, comb, eight, ladder, office, pillars, ring, spiral, star, wings,
};
use tolman_maze::{Braided, Cell, Direction, Maze, Perfect, Rooms};

use crate::BoxError;

/// Worlds of one kind, each drawn from its size and a seed.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Name as in `tolman maze generate NAME`.
    pub name: &'static str,
    /// Common features of the family's drawings, in one line.
    pub about: &'static str,
    /// Difficulty of the family's drawings for a system, in a few words.
    pub hard: &'static str,
    /// Kinds of places, beside dead ends, the start and the goal.
    pub places: &'static str,
    /// Columns and rows of a small, a middle and a large drawing.
    pub sizes: [(u16, u16); 3],
    /// Function that makes a drawing from its columns, rows and seed.
    pub draw: Draw,
}

/// Generator of a world.
pub type Draw = fn((u16, u16), &mut ChaCha8Rng) -> Result<Maze, BoxError>;

/// Size of a family's world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FamilySize {
    /// A few cells, for a first look.
    Small,
    /// The size of the papers' mazes.
    Middle,
    /// Larger than any paper's.
    Large,
}

/// Description of the places of most families.
const JUNCTIONS: &str = "junctions";

const SQUARE: [(u16, u16); 3] = [(5, 5), (8, 8), (16, 16)];

impl Family {
    /// Returns a family without further description, with square worlds of 5, 8 and 16 cells a
    /// side.
    #[must_use]
    pub const fn new(name: &'static str, about: &'static str, draw: Draw) -> Self {
        Self {
            name,
            about,
            hard: "",
            places: JUNCTIONS,
            sizes: SQUARE,
            draw,
        }
    }

    const fn hard(self, hard: &'static str) -> Self {
        Self { hard, ..self }
    }

    const fn sizes(self, sizes: [(u16, u16); 3]) -> Self {
        Self { sizes, ..self }
    }

    const fn places(self, places: &'static str) -> Self {
        Self { places, ..self }
    }

    /// Returns the columns and rows of a world of this size.
    #[must_use]
    pub const fn size(&self, size: FamilySize) -> (u16, u16) {
        self.sizes[size as usize]
    }

    /// Returns the family of this name; `braided-rooms` is `braided rooms`. `None` if there is
    /// none.
    #[must_use]
    pub fn named<'a>(families: &'a [Self], name: &str) -> Option<&'a Self> {
        let typed = name.to_lowercase().replace('-', " ");
        families.iter().find(|family| family.name == typed)
    }

    /// Families in which every system is tested.
    pub const ARENA: [Self; 14] = [
        Self::new(
            "perfect",
            "Exactly one way between any two cells",
            |(width, height), rng| Ok(Perfect { width, height }.generate(rng)?),
        )
        .hard("long winding corridors"),
        Self::new(
            "braided",
            "Loops in place of dead ends, of corridors alone",
            |size, rng| Ok(whole(size).generate_corridors(rng)?),
        )
        .hard("many loops"),
        Self::new(
            "braided rooms",
            "Loops in place of dead ends, with open squares of 2 × 2 cells",
            braided_rooms,
        )
        .hard("openness: no corridor leads through an open square")
        .places("junctions, and the cells of open squares"),
        Self::new(
            "office",
            "Corridors with rooms on both sides",
            |size, rng| Ok(office(size, rng)?),
        )
        .hard("aliasing: doorway after doorway looks the same")
        .places("doorways of the corridors, their crossings")
        .sizes([(6, 6), (8, 9), (16, 15)]),
        Self::new(
            "blocks",
            "City blocks, a quarter of the ways walled up",
            |size, rng| Ok(blocks(size, rng)?),
        )
        .hard("aliasing: crossings and streets look the same")
        .sizes([(5, 5), (9, 9), (17, 17)]),
        Self::new(
            "ladder",
            "Two equal loops side by side, with corridors of 1 to 15 cells",
            |size, rng| Ok(ladder(size, rng)?),
        )
        .hard("symmetry and length")
        .sizes([(7, 4), (15, 8), (33, 17)]),
        Self::new("eight", "Two loops that share one crossing", |size, rng| {
            Ok(eight(size, rng)?)
        })
        .hard("loops that come back to the same crossing"),
        Self::new("ring", "One loop of four equal sides", |size, rng| {
            Ok(ring(size, rng)?)
        })
        .hard("symmetry: nothing but start and goal tells one side from another")
        .places("none"),
        Self::new(
            "wings",
            "Two or four identical wings on a spine",
            |size, rng| Ok(wings(size, rng)?),
        )
        .hard("aliasing: all of a wing is there twice")
        .sizes([(7, 7), (11, 9), (17, 17)]),
        Self::new("comb", "A spine with teeth of any length", |size, rng| {
            Ok(comb(size, rng)?)
        })
        .hard("aliasing: fork after fork looks the same")
        .sizes([(7, 4), (13, 6), (25, 10)]),
        Self::new("spiral", "One corridor that winds inwards", |size, rng| {
            Ok(spiral(size, rng)?)
        })
        .hard("length: bend after bend and no fork")
        .places("none"),
        Self::new("star", "Four arms of any length from a hub", |size, rng| {
            Ok(star(size, rng)?)
        })
        .hard("nothing: a tree with one crossing")
        .sizes([(5, 5), (9, 9), (17, 17)]),
        Self::new("pillars", "An open room with pillars", |size, rng| {
            Ok(pillars(size, rng)?)
        })
        .hard("openness: there is no corridor")
        .places("all cells"),
        Self::new("papers", "The papers' mazes", |_, rng| papers(rng))
            .hard("what their systems were made for"),
    ];

    /// Returns all known families: those of the arena, then the others.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let rooms = Self::new(
            "rooms",
            "Rooms with winding corridors between them",
            |(width, height), rng| {
                let rooms = Rooms {
                    width,
                    height,
                    attempts: 20,
                    smallest: 2,
                    largest: 4.min(width).min(height),
                    extra_doors: 2,
                };
                Ok(rooms.generate(rng)?)
            },
        );
        Self::ARENA.into_iter().chain([rooms]).collect()
    }
}

const fn whole((width, height): (u16, u16)) -> Braided {
    Braided {
        width,
        height,
        share: 1.0,
    }
}

/// Returns a braided maze, with an open square added if it has none.
fn braided_rooms(size: (u16, u16), rng: &mut ChaCha8Rng) -> Result<Maze, BoxError> {
    let mut maze = whole(size).generate(rng)?;
    let grid = maze.grid();
    if size.0 > 2 && size.1 > 2 && !grid.cells().any(|cell| maze.is_room(cell)) {
        // Not at the start, which keeps its walls.
        let side = |cells: u16, rng: &mut ChaCha8Rng| rng.random_range(1..u32::from(cells) - 1);
        let (x, y) = (side(size.0, rng) as u16, side(size.1, rng) as u16);
        let corner = Cell::new(x, y);
        for (cell, way) in [
            (corner, Direction::North),
            (corner, Direction::East),
            (Cell::new(x + 1, y), Direction::North),
            (Cell::new(x, y + 1), Direction::East),
        ] {
            maze.set_wall(cell, way, false);
        }
    }
    Ok(maze)
}

/// The papers' mazes.
const PAPERS: [&str; 5] = [
    include_str!("../mazes/j.maze"),
    include_str!("../mazes/large.maze"),
    include_str!("../mazes/cpm-1.maze"),
    include_str!("../mazes/cpm-2.maze"),
    include_str!("../mazes/cpm-3.maze"),
];

/// Returns one of the papers' mazes at random. If it marks no start, the start is the cell farthest
/// from its goal.
fn papers(rng: &mut impl Rng) -> Result<Maze, BoxError> {
    let text = PAPERS[rng.random_range(0..PAPERS.len() as u32) as usize];
    let mut maze = tolman_maze::read(text)?.maze;
    if maze.start().is_none() {
        let steps = maze.steps_to_goal();
        let far = |cell: &Cell| steps[maze.grid().index(*cell)];
        let farthest = maze.grid().cells().max_by_key(far);
        let start = farthest.and_then(|cell| {
            let (heading, _) = maze.neighbours(cell).next()?;
            Some((cell, heading))
        });
        maze.set_start(start);
    }
    Ok(maze)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    #[test]
    fn all_of_all_sizes_can_be_run_in() {
        for family in Family::all() {
            for size in family.sizes {
                for seed in 0..20 {
                    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
                    let maze = (family.draw)(size, rng).unwrap();
                    let name = family.name;
                    assert_eq!(maze.check(), Ok(()), "{name}\n{maze}");
                    // Inside the J there is floor that cannot be reached.
                    assert!(
                        name == "papers" || maze.sealed().count() == 0,
                        "{name}\n{maze}"
                    );
                    let (start, _) = maze.start().unwrap();
                    assert!(!maze.goals().contains(&start), "{name}\n{maze}");
                    let has_room = maze.reachable().any(|cell| maze.is_room(cell));
                    let is_open = ["braided rooms", "pillars", "rooms"].contains(&name);
                    assert!(name == "rooms" || has_room == is_open, "{name}\n{maze}");
                }
            }
        }
    }

    #[test]
    fn a_family_is_found_as_it_is_typed() {
        let all = Family::all();
        for name in ["braided rooms", "braided-rooms", "Braided Rooms"] {
            assert_eq!(Family::named(&all, name).unwrap().name, "braided rooms");
        }
        assert!(Family::named(&all, "hexagons").is_none());
    }
}
