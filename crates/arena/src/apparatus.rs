//! Mazes in which E. C. Tolman and others watched rats, as drawings of cells.
//!
//! Each [`Apparatus`] is drawn from a random number generator, so that no claim rests on one
//! drawing. [`Apparatus::usual`] is the drawing in `mazes/tolman`, whose `README.md` names the
//! sources and what a grid changes.

use alloc::collections::BTreeMap;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Direction, Grid, Maze};

/// An opening between two cells: a cell and the side on which it is left.
pub type Opening = (Cell, Direction);

/// Kinds of apparatus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ApparatusKind {
    /// Three paths of growing length to the food, of which the first two share their last stretch
    /// (Tolman and Honzik 1930).
    Detour,
    /// Arms on a corridor in place of paths on a round table; the learned way winds to the food
    /// (Tolman, Ritchie and Kalish 1946).
    Sunburst,
    /// Fourteen forks in a row, each with one blind alley (Tolman and Honzik 1930).
    Forks,
}

/// A maze for a rat, with what its experimenter can shut.
///
/// ```
/// use tolman_arena::apparatus::{Apparatus, ApparatusKind};
///
/// let detour = Apparatus::usual(ApparatusKind::Detour);
/// assert_eq!(detour.ways.len(), 3);
/// assert_eq!(detour.maze.check(), Ok(()));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Apparatus {
    /// The drawing. It marks start and food, and as landmark [`BOX`](Self::BOX) the start box.
    pub maze: Maze,
    /// Openings by which a rat enters the ways that it chooses from. A detour has its three paths,
    /// the shortest first. A sunburst has its arms but the learned one, from west to east. Forks
    /// have their blind alleys.
    pub ways: Vec<Opening>,
    /// Index of the way that the rats are said to have chosen; `None` if it depends on the door, or
    /// for forks.
    pub chosen: Option<usize>,
    /// Openings that are doors. A detour has its blocks A and B. A sunburst has the block on the
    /// learned way, and the doors from the table to the arms in the west and in the east.
    pub doors: Vec<Opening>,
}

/// Number of forks of the maze of the experiment on latent learning.
const FORKS: u16 = 14;

/// Arms of a sunburst, and cells from one to the next.
const ARMS: u16 = 5;
const APART: u16 = 2;

impl Apparatus {
    /// Number of the landmark that marks the start box.
    pub const BOX: u32 = 1;

    /// Block of a detour that only path 1 leads through.
    pub const BLOCK_A: usize = 0;
    /// Block of a detour on the stretch that paths 1 and 2 share.
    pub const BLOCK_B: usize = 1;
    /// Block of a sunburst, on the learned way.
    pub const BLOCK: usize = 0;
    /// Doors of a sunburst, from the table to the arms.
    pub const TO_ARMS: [usize; 2] = [1, 2];

    /// Returns the drawing of the project.
    #[must_use]
    pub fn usual(kind: ApparatusKind) -> Self {
        match kind {
            ApparatusKind::Detour => detour(3, 2, [1, 2]),
            ApparatusKind::Sunburst => sunburst(ARMS - 1),
            ApparatusKind::Forks => {
                const USUAL: [bool; FORKS as usize] = [
                    true, false, false, true, false, true, true, false, true, false, true, true,
                    false, false,
                ];
                forks(&USUAL)
            }
        }
    }

    /// Returns a random drawing.
    ///
    /// - A detour has paths of other lengths, still in the same order, and may be mirrored.
    /// - A sunburst may be mirrored, and its food lies beyond the last arm or the one before.
    /// - Forks have their blind alleys on the left or on the right, each as likely.
    pub fn drawn(kind: ApparatusKind, rng: &mut ChaCha8Rng) -> Self {
        let drawn = match kind {
            ApparatusKind::Detour => {
                let near = between(1, 2, rng);
                let far = between(near + 1, near + 2, rng);
                detour(between(2, 4, rng), between(2, 3, rng), [near, far])
            }
            ApparatusKind::Sunburst => sunburst(between(ARMS - 2, ARMS - 1, rng)),
            ApparatusKind::Forks => {
                let turns: Vec<bool> = (0..FORKS).map(|_| between(0, 1, rng) == 1).collect();
                forks(&turns)
            }
        };
        match between(0, 1, rng) {
            0 => drawn,
            _ => drawn.mirrored(),
        }
    }

    /// Returns it with east and west exchanged. The ways keep their order.
    fn mirrored(self) -> Self {
        let width = self.maze.grid().width();
        let mirror = |(cell, way): Opening| {
            let way = match way {
                Direction::East | Direction::West => way.opposite(),
                Direction::North | Direction::South => way,
            };
            (Cell::new(width - 1 - cell.x, cell.y), way)
        };
        Self {
            maze: self.maze.mirrored(),
            ways: self.ways.into_iter().map(mirror).collect(),
            chosen: self.chosen,
            doors: self.doors.into_iter().map(mirror).collect(),
        }
    }
}

/// Returns a random number from `least` to `most`, both included.
fn between(least: u16, most: u16, rng: &mut ChaCha8Rng) -> u16 {
    rng.random_range(u32::from(least)..=u32::from(most)) as u16
}

/// Opens a corridor of `cells` cells onward from a cell and returns its last cell.
fn line(maze: &mut Maze, from: Cell, way: Direction, cells: u16) -> Cell {
    (0..cells).fold(from, |at, _| {
        maze.set_wall(at, way, false);
        maze.grid().neighbour(at, way).unwrap_or(at)
    })
}

/// Marks start box, start and food. The start is the cell north of the box, looking north.
fn mark(mut maze: Maze, start_box: Cell, food: Cell) -> Maze {
    let start = line(&mut maze, start_box, Direction::North, 1);
    maze.set_start(Some((start, Direction::North)));
    maze.set_goals(vec![food]);
    maze.set_landmarks(BTreeMap::from([(start_box, Apparatus::BOX)]));
    maze
}

/// Returns a detour. Path 1 leads `first` cells north to where path 2 joins it, and `shared` cells
/// more to where path 3 does. Paths 2 and 3 lie as many cells to the sides as `aside` says.
fn detour(first: u16, shared: u16, aside: [u16; 2]) -> Apparatus {
    let [near, far] = aside;
    let mut maze = Maze::solid(Grid::new(near + 1 + far, 4 + first + shared));
    let start_box = Cell::new(near, 0);
    let choice = line(&mut maze, start_box, Direction::North, 2);
    let joins = line(&mut maze, choice, Direction::North, first);
    let end = line(&mut maze, joins, Direction::North, shared);
    let food = line(&mut maze, end, Direction::North, 1);
    for (side, aside, along) in [
        (Direction::West, near, first),
        (Direction::East, far, first + shared),
    ] {
        let corner = line(&mut maze, choice, side, aside);
        let corner = line(&mut maze, corner, Direction::North, along);
        line(&mut maze, corner, side.opposite(), aside);
    }
    let before = Cell::new(near, joins.y - 1);
    Apparatus {
        maze: mark(maze, start_box, food),
        ways: [Direction::North, Direction::West, Direction::East]
            .map(|way| (choice, way))
            .into(),
        chosen: None,
        doors: vec![(before, Direction::North), (joins, Direction::North)],
    }
}

/// Returns a sunburst whose food lies beyond an arm, counted from the west.
///
/// The learned way is the arm in the middle. It leads on to the north, turns left and right twice,
/// and comes to the food from the west.
fn sunburst(arm: u16) -> Apparatus {
    const LONG: u16 = 3;
    let middle = ARMS / 2 * APART;
    let mut maze = Maze::solid(Grid::new((ARMS - 1) * APART + 1, 10));
    let start_box = Cell::new(middle, 0);
    let table = line(&mut maze, start_box, Direction::North, 2);
    for side in [Direction::West, Direction::East] {
        line(&mut maze, table, side, middle);
    }
    let foot = |arm: u16| Cell::new(arm * APART, table.y);
    for arm in 0..ARMS {
        line(&mut maze, foot(arm), Direction::North, LONG);
    }
    let turn = line(&mut maze, table, Direction::North, LONG + 2);
    let turn = line(&mut maze, turn, Direction::West, APART);
    let turn = line(&mut maze, turn, Direction::North, 2);
    let food = line(&mut maze, turn, Direction::East, arm * APART - turn.x);
    let others = (0..ARMS).filter(|arm| *arm != ARMS / 2);
    Apparatus {
        maze: mark(maze, start_box, food),
        ways: others.map(|arm| (foot(arm), Direction::North)).collect(),
        // The learned arm is not among the ways.
        chosen: Some(usize::from(arm) - 1),
        doors: vec![
            (Cell::new(middle, table.y + 1), Direction::North),
            (table, Direction::West),
            (table, Direction::East),
        ],
    }
}

/// Returns forks in a row; `turns` says for each whether the way on is to the east.
///
/// From its fork, a blind alley looks as the way on does: both turn to the north after a cell.
fn forks(turns: &[bool]) -> Apparatus {
    let aside = |east: &bool| if *east { 1_i32 } else { -1 };
    let mut at = 0;
    let columns: Vec<i32> = turns
        .iter()
        .map(|east| {
            let fork = at;
            at += aside(east);
            fork
        })
        .collect();
    // A fork is as wide as its two sides.
    let west = columns.iter().min().map_or(0, |least| least - 1);
    let east = columns.iter().max().map_or(0, |most| most + 1);
    let rows = 2 + 2 * turns.len() as u16;
    let mut maze = Maze::solid(Grid::new((east - west + 1) as u16, rows));
    let start_box = Cell::new((-west) as u16, 0);
    let mut fork = line(&mut maze, start_box, Direction::North, 2);
    let (mut ways, mut food) = (Vec::new(), fork);
    for (number, east) in turns.iter().enumerate() {
        let on = if *east {
            Direction::East
        } else {
            Direction::West
        };
        for side in [on, on.opposite()] {
            let bend = line(&mut maze, fork, side, 1);
            line(&mut maze, bend, Direction::North, 1);
        }
        ways.push((fork, on.opposite()));
        let bend = fork.beyond(on).unwrap_or(fork);
        food = bend.beyond(Direction::North).unwrap_or(bend);
        if number + 1 < turns.len() {
            fork = line(&mut maze, food, Direction::North, 1);
        }
    }
    Apparatus {
        maze: mark(maze, start_box, food),
        ways,
        chosen: None,
        doors: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;

    use super::*;

    const KINDS: [ApparatusKind; 3] = [
        ApparatusKind::Detour,
        ApparatusKind::Sunburst,
        ApparatusKind::Forks,
    ];

    fn steps(maze: &Maze, from: Cell) -> Option<u32> {
        maze.steps_to_goal()[maze.grid().index(from)]
    }

    /// Returns the maze with some doors shut.
    fn shut(apparatus: &Apparatus, doors: &[usize]) -> Maze {
        let mut maze = apparatus.maze.clone();
        for door in doors {
            let (cell, way) = apparatus.doors[*door];
            maze.set_wall(cell, way, true);
        }
        maze
    }

    /// Returns which way of a detour a shortest way to the food takes.
    fn shortest(maze: &Maze, ways: &[Opening]) -> usize {
        let beyond = |(cell, way): &Opening| steps(maze, maze.beside(*cell, *way).unwrap());
        let costs = ways.iter().map(|way| beyond(way).unwrap_or(u32::MAX));
        costs.enumerate().min_by_key(|(_, cost)| *cost).unwrap().0
    }

    #[test]
    fn the_usual_drawings_are_those_of_the_folder() {
        for (kind, text) in KINDS.into_iter().zip([
            include_str!("../mazes/tolman/detour.maze"),
            include_str!("../mazes/tolman/sunburst.maze"),
            include_str!("../mazes/tolman/forks.maze"),
        ]) {
            let read = tolman_maze::read(text).unwrap().maze;
            let drawn = Apparatus::usual(kind).maze;
            assert_eq!(read, drawn, "{kind:?}\n{drawn}");
        }
    }

    proptest! {
        #[test]
        fn a_drawing_can_be_run_in(kind in 0..KINDS.len(), seed: u64) {
            let drawn = Apparatus::drawn(KINDS[kind], &mut ChaCha8Rng::seed_from_u64(seed));
            prop_assert_eq!(drawn.maze.check(), Ok(()), "{}", drawn.maze);
            for (cell, way) in drawn.ways.iter().chain(&drawn.doors) {
                prop_assert!(drawn.maze.is_open(*cell, *way), "{}", drawn.maze);
            }
            // Corridors alone, so that no system abstains.
            prop_assert!(!drawn.maze.reachable().any(|cell| drawn.maze.is_room(cell)));
        }

        #[test]
        fn a_block_of_a_detour_leaves_the_path_that_rats_took(seed: u64) {
            let rng = &mut ChaCha8Rng::seed_from_u64(seed);
            let detour = Apparatus::drawn(ApparatusKind::Detour, rng);
            for (doors, way) in [
                (&[][..], 0),
                (&[Apparatus::BLOCK_A], 1),
                (&[Apparatus::BLOCK_B], 2),
            ] {
                prop_assert_eq!(shortest(&shut(&detour, doors), &detour.ways), way);
            }
        }

        #[test]
        fn arms_of_a_sunburst_are_shut_while_it_is_learned_and_blind_afterwards(seed: u64) {
            let rng = &mut ChaCha8Rng::seed_from_u64(seed);
            let sunburst = Apparatus::drawn(ApparatusKind::Sunburst, rng);
            let learned = shut(&sunburst, &Apparatus::TO_ARMS);
            let (start, _) = learned.start().unwrap();
            prop_assert!(steps(&learned, start).is_some());
            let reached: Vec<Cell> = learned.reachable().collect();
            prop_assert!(sunburst.ways.iter().all(|(foot, _)| !reached.contains(foot)));
            let tested = shut(&sunburst, &[Apparatus::BLOCK]);
            prop_assert_eq!(steps(&tested, start), None);
            let (foot, _) = sunburst.ways[sunburst.chosen.unwrap()];
            prop_assert_eq!(foot.x, tested.goals()[0].x);
        }

        #[test]
        fn every_fork_has_one_blind_alley(seed: u64) {
            let rng = &mut ChaCha8Rng::seed_from_u64(seed);
            let Apparatus { maze, ways, .. } = Apparatus::drawn(ApparatusKind::Forks, rng);
            prop_assert_eq!(maze.junctions().count(), ways.len());
            // The start box and the food are dead ends, too.
            prop_assert_eq!(maze.dead_ends().count(), ways.len() + 2);
            for (fork, side) in ways {
                let bend = maze.beside(fork, side).unwrap();
                prop_assert!(steps(&maze, bend) > steps(&maze, fork));
            }
        }
    }
}
