use alloc::collections::BTreeMap;
use core::f64::consts::FRAC_PI_2;

use tolman_geom::Heading;
use tolman_maze::{Cell, Direction, Maze};

/// The fragments that a maze really has, for scoring; no robot knows them.
#[derive(Clone, Debug)]
pub struct TrueFragments {
    ways: BTreeMap<(Cell, Direction), Way>,
}

/// A fragment as one leaves a place by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Way {
    /// The fragment's number.
    pub fragment: u32,
    /// Whether one enters it at its first end.
    pub is_forward: bool,
    /// Where it leads.
    pub to: Cell,
    /// How many cells on.
    pub cells: u32,
}

/// Whether a cell is a junction, a dead end, the start or a goal.
fn ends_fragments(maze: &Maze, cell: Cell) -> bool {
    let is_start = maze.start().is_some_and(|(start, _)| start == cell);
    maze.degree(cell) != 2 || maze.goals().contains(&cell) || is_start
}

/// The cells of a way that leads `out` of a place to `next` and on to the next place, and the direction in which one comes there.
fn follow(
    maze: &Maze,
    out: Direction,
    next: Cell,
    is_place: impl Fn(Cell) -> bool,
) -> (Vec<Cell>, Direction) {
    let (mut at, mut came, mut cells) = (next, out, vec![next]);
    while !is_place(at) {
        let back = came.opposite();
        let Some((on, next)) = maze.neighbours(at).find(|(on, _)| *on != back) else {
            break;
        };
        (at, came) = (next, on);
        cells.push(at);
    }
    (cells, came)
}

/// The cells of the fragment that leads `out` of a place, that one first, and the direction in which one comes to its end; none if a wall
/// stands there.
pub(super) fn along(maze: &Maze, from: Cell, out: Direction) -> Option<(Vec<Cell>, Direction)> {
    let (_, next) = maze.neighbours(from).find(|(way, _)| *way == out)?;
    let (mut cells, came) = follow(maze, out, next, |cell| ends_fragments(maze, cell));
    cells.insert(0, from);
    Some((cells, came))
}

/// Counter-clockwise from a heading of 0.
pub(super) const DIRECTIONS: [Direction; 4] = [
    Direction::East,
    Direction::North,
    Direction::West,
    Direction::South,
];

impl TrueFragments {
    /// The fragments of a maze between its junctions, dead ends, start and goals.
    #[must_use]
    pub fn of(maze: &Maze) -> Self {
        let is_place = |cell: Cell| ends_fragments(maze, cell);
        let mut ways = BTreeMap::new();
        let mut count = 0;
        for from in maze.reachable().filter(|cell| is_place(*cell)) {
            for (out, next) in maze.neighbours(from) {
                if ways.contains_key(&(from, out)) {
                    continue;
                }
                let (cells, came) = follow(maze, out, next, is_place);
                let to = cells.last().copied().unwrap_or(next);
                let way = |is_forward, to| Way {
                    fragment: count,
                    is_forward,
                    to,
                    cells: cells.len() as u32,
                };
                ways.insert((from, out), way(true, to));
                ways.insert((to, came.opposite()), way(false, from));
                count += 1;
            }
        }
        Self { ways }
    }

    /// The way by which one leaves a place that looks in this heading.
    #[must_use]
    pub fn way(&self, from: Cell, heading: Heading) -> Option<Way> {
        let nearest = libm::round(heading.radians() / FRAC_PI_2).rem_euclid(4.0) as u32;
        let direction = DIRECTIONS[nearest as usize % DIRECTIONS.len()];
        self.ways.get(&(from, direction)).copied()
    }

    /// All ways out of all places.
    pub fn ways(&self) -> impl Iterator<Item = (Cell, Way)> + '_ {
        self.ways.iter().map(|((from, _), way)| (*from, *way))
    }
}
