use alloc::collections::BTreeMap;
use core::f64::consts::FRAC_PI_2;

use tolman_geom::{Heading, Vector};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::{Arcs, costs_from};
use tolman_robot::Landmark;
use tolman_systems::cpm::Walker;

use super::covering_walk::covering_walk;
use super::robots::SimulatedEpuck;

/// The fragments that a maze really has, for scoring; no robot knows them.
#[derive(Clone, Debug)]
pub struct TrueFragments {
    ways: BTreeMap<(Cell, Direction), WayOut>,
}

/// A fragment with the direction in which a robot leaves a place by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WayOut {
    /// The fragment's number.
    pub fragment: u32,
    /// Whether the robot enters the fragment at its first end.
    pub is_forward: bool,
    /// Cell of the place at the fragment's other end.
    pub to: Cell,
    /// Length in cells.
    pub cells: u32,
}

/// Returns the landmark in a cell, or `None` if it holds neither the start nor a goal.
pub(crate) fn landmark_at(maze: &Maze, cell: Cell) -> Option<Landmark> {
    if maze.start().is_some_and(|(start, _)| start == cell) {
        return Some(Landmark::Start);
    }
    maze.goals().contains(&cell).then_some(Landmark::Goal)
}

/// Returns whether a cell is a junction, a dead end, the start or a goal.
pub(crate) fn ends_fragments(maze: &Maze, cell: Cell) -> bool {
    maze.degree(cell) != 2 || landmark_at(maze, cell).is_some()
}

/// Returns the cells of the way `out` of a place to `next` and on to the next place, and the
/// direction of arrival there.
pub(crate) fn follow(
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

/// Returns the cells of the fragment `out` of a place, the place first, and the direction of
/// arrival at its end. `None` if a wall stands there.
pub(super) fn along(maze: &Maze, from: Cell, out: Direction) -> Option<(Vec<Cell>, Direction)> {
    let (_, next) = maze.neighbours(from).find(|(way, _)| *way == out)?;
    let (mut cells, came) = follow(maze, out, next, |cell| ends_fragments(maze, cell));
    cells.insert(0, from);
    Some((cells, came))
}

/// Returns the direction in which each cell but the last is left.
pub(super) fn headings(maze: &Maze, cells: &[Cell]) -> Vec<Direction> {
    let steps = cells.windows(2);
    steps
        .filter_map(|pair| {
            let (from, to) = (pair.first()?, pair.last()?);
            let mut ways = maze.neighbours(*from);
            ways.find(|(_, next)| next == to).map(|(way, _)| way)
        })
        .collect()
}

/// Quarters of a turn, clockwise.
pub(super) type Quarters = usize;

/// Returns the turn from one direction to another.
pub(super) const fn quarters(from: Direction, to: Direction) -> Quarters {
    (to.index() + 4 - from.index()) % 4
}

/// Returns the turns between these headings.
pub(super) fn bends(headings: &[Direction]) -> Vec<Quarters> {
    let bend = |pair: &[Direction]| match pair {
        [came, on] => quarters(*came, *on),
        _ => 0,
    };
    headings.windows(2).map(bend).collect()
}

/// Returns the heading from one cell to another.
fn heading_between(from: Cell, to: Cell) -> Heading {
    let step = |from: u16, to: u16| f64::from(to) - f64::from(from);
    Heading::of(Vector::new(step(from.x, to.x), step(from.y, to.y)))
}

/// Directions counter-clockwise from a heading of 0.
pub(super) const DIRECTIONS: [Direction; 4] = [
    Direction::East,
    Direction::North,
    Direction::West,
    Direction::South,
];

/// Returns the direction that is nearest to a heading.
pub(crate) fn direction_of(heading: Heading) -> Direction {
    let quarters = libm::round(heading.radians() / FRAC_PI_2).rem_euclid(4.0) as usize;
    DIRECTIONS[quarters % DIRECTIONS.len()]
}

impl TrueFragments {
    /// Returns the fragments of a maze between its junctions, dead ends, start and goals.
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
                let way = |is_forward, to| WayOut {
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

    /// Returns the way out of a place in this heading.
    #[must_use]
    pub fn way(&self, from: Cell, heading: Heading) -> Option<WayOut> {
        self.ways.get(&(from, direction_of(heading))).copied()
    }

    /// Returns the way by which a robot left its last place; `None` if there is no way.
    #[must_use]
    pub fn taken(&self, walker: &Walker<SimulatedEpuck>) -> Option<WayOut> {
        let body = walker.body();
        let from = walker.departed_at(body.path())?;
        self.way(body.world().cell_at(from.position)?, from.heading)
    }

    /// Returns the same fragment, walked the other way.
    #[must_use]
    pub fn reversed(&self, way: WayOut) -> Option<WayOut> {
        let is_back =
            |other: &&WayOut| other.fragment == way.fragment && other.is_forward != way.is_forward;
        self.ways.values().find(is_back).copied()
    }

    /// Returns the ways of a drive over these cells, in order; `None` if it left a place where
    /// there is no way. A drive that turns back within a fragment counts as along it. One that only
    /// looks into the next cell and comes back does not.
    pub(super) fn driven(&self, cells: impl IntoIterator<Item = Cell>) -> Option<Vec<WayOut>> {
        let mut cells = cells.into_iter();
        let (Some(mut at), mut driven) = (cells.next(), Vec::new()) else {
            return Some(Vec::new());
        };
        let mut last = at;
        // The way by which it left, and how many cells of it were entered.
        let mut under_way = None::<(WayOut, u32)>;
        for cell in cells {
            if cell == last {
                continue;
            }
            last = cell;
            under_way = match under_way {
                None => Some((self.way(at, heading_between(at, cell))?, 1)),
                Some((way, entered)) if cell == at => {
                    // The end of a loop, too.
                    if entered > 1 {
                        driven.push(way);
                    }
                    None
                }
                Some((way, entered)) => Some((way, entered + 1)),
            };
            if let Some((way, _)) = under_way
                && cell == way.to
            {
                driven.push(way);
                (at, under_way) = (cell, None);
            }
        }
        Some(driven)
    }

    /// Returns a graph of the maze's cells, with an arc for each way, from place to place, that has
    /// a length.
    fn graph(&self, maze: &Maze, length: impl Fn(WayOut) -> Option<u32>) -> Arcs {
        let node = |cell: Cell| maze.grid().index(cell) as u32;
        let arc = |(from, _, way): (Cell, Direction, WayOut)| {
            Some((node(from), node(way.to), length(way)?))
        };
        let arcs: Vec<_> = self.ways().filter_map(arc).collect();
        Arcs::new(maze.grid().cell_count(), &arcs)
    }

    /// Returns the length of the shortest way from start to goal over the ways that have a length,
    /// or `None` if none leads there.
    pub fn shortest(&self, maze: &Maze, length: impl Fn(WayOut) -> Option<u32>) -> Option<u32> {
        let (start, _) = maze.start()?;
        let start = maze.grid().index(start) as u32;
        let costs = costs_from(&self.graph(maze, length), [start]);
        let goals = maze.goals().iter();
        goals
            .filter_map(|goal| costs[maze.grid().index(*goal)])
            .min()
    }

    /// Returns the number of fragments of the [shortest walk](covering_walk) from the start through
    /// all of them. `None` without a start, without a way out of it, or if the walk takes too long
    /// to find.
    #[must_use]
    pub fn covering_walk(&self, maze: &Maze) -> Option<u32> {
        let (start, _) = maze.start()?;
        let ways = self.graph(maze, |_| Some(1));
        let walk = covering_walk(&ways, maze.grid().index(start) as u32);
        walk.filter(|fragments| *fragments > 0)
    }

    /// Returns the number of fragments.
    pub fn count(&self) -> u32 {
        let forward = self.ways.values().filter(|way| way.is_forward);
        forward.count() as u32
    }

    /// Returns all ways out of all places: the place, the direction in which the way leaves it, and
    /// the way.
    pub fn ways(&self) -> impl Iterator<Item = (Cell, Direction, WayOut)> + '_ {
        let ways = self.ways.iter();
        ways.map(|((from, out), way)| (*from, *out, *way))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Three ways between two crossings.
    pub(in crate::cpm) const THREE_WAYS: &str = "\
start = 0 1 east

o---o---o---o---o---o
|   |           |   |
o---o   o---o   o---o
| S               G |
o---o   o---o   o---o
|   |           |   |
o---o---o---o---o---o
";

    /// One crossing: the start to its west, the goal to its east, and a loop from its north to its
    /// south.
    pub(crate) const LOOP: &str = "\
start = 0 1 east

o---o---o---o---o
|   |           |
o---o   o---o   o
| S       G |   |
o---o   o---o   o
|   |           |
o---o---o---o---o
";

    fn walked(text: &str, cells: &[(u16, u16)]) -> Option<Vec<u32>> {
        let maze = tolman_maze::read(text).unwrap().maze;
        let fragments = TrueFragments::of(&maze);
        let driven = fragments.driven(cells.iter().map(|(x, y)| Cell::new(*x, *y)))?;
        Some(driven.iter().map(|way| way.fragment).collect())
    }

    #[test]
    fn a_drive_round_a_loop_was_along_it() {
        let straight = walked(LOOP, &[(0, 1), (1, 1), (2, 1)]).unwrap();
        let north = [(1, 1), (1, 2), (2, 2), (3, 2)];
        let south = [(3, 1), (3, 0), (2, 0), (1, 0), (1, 1)];
        let around = [&[(0, 1)][..], &north, &south, &[(2, 1)]].concat();
        let around = walked(LOOP, &around).unwrap();
        assert_eq!((straight.len(), around.len()), (2, 3));
        assert_eq!([around[0], around[2]], straight[..]);
    }

    #[test]
    fn a_drive_that_turns_back_was_along_what_it_turned_back_in() {
        let drive = [(0, 1), (1, 1), (1, 2), (2, 2), (1, 2), (1, 1), (2, 1)];
        assert_eq!(walked(LOOP, &drive).unwrap().len(), 3);
        let look = [(0, 1), (1, 1), (1, 2), (1, 1), (1, 1), (2, 1)];
        assert_eq!(walked(LOOP, &look).unwrap().len(), 2);
        assert_eq!(walked(LOOP, &[(0, 1), (0, 2)]), None);
        assert_eq!(walked(LOOP, &[]), Some(vec![]));
    }

    #[test]
    fn the_shortest_covering_walk_goes_back_out_of_dead_ends() {
        let best = |text: &str| {
            let maze = tolman_maze::read(text).unwrap().maze;
            TrueFragments::of(&maze).covering_walk(&maze)
        };
        // From the start to the fork, into the dead end and back, to the goal.
        let fork = "\
start = 0 0 east

o---o---o---o
|   |   |   |
o---o   o---o
| S       G |
o---o---o---o
";
        assert_eq!(best(fork), Some(4));
        // All three on the way to the goal, none twice.
        assert_eq!(best(THREE_WAYS), Some(5));
    }
}
