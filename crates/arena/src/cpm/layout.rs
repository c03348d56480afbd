use alloc::collections::{BTreeMap, VecDeque};

use tolman_maps::cpm::{CpMap, End, FragmentId, JunctionId, Port, PortState, Sign};
use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::Landmark;

use super::fragments::{DIRECTIONS, along};

/// Positions of a map's parts in the maze, for pictures; the map itself has no coordinates. Map and
/// maze are walked together from the start, port by port, as far as they agree.
///
/// ```
/// use tolman_arena::cpm::{epuck, epuck_course, learn, CpmTrial, Layout};
/// use tolman_systems::cpm::Mode;
/// use tolman_systems::cpm::CpmConfig;
/// use tolman_robot::Landmark;
///
/// # let text = include_str!("../../mazes/cpm-1.maze");
/// let course = epuck_course("", tolman_maze::read(text)?)?;
/// let patterns = learn(&course, 1)?;
/// let mode = Mode::Paper(CpmConfig::online());
/// let trial = CpmTrial { course: &course, patterns: &patterns, robot: epuck(), mode, seed: 3 };
/// let map = trial.play()?.map;
/// let layout = Layout::of(&map, &course.maze);
/// let goal = map.landmarks(Landmark::Goal).next().ok_or("the goal is not on the map")?;
/// assert_eq!(layout.place(goal), Some(course.maze.goals()[0]));
/// # Ok::<(), tolman_arena::BoxError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Cell and direction of port 0 of each junction.
    places: BTreeMap<JunctionId, (Cell, Direction)>,
    /// Cells in which each fragment lies.
    pub fragments: BTreeMap<FragmentId, Lie>,
    /// The unexplored ports.
    pub open: Vec<OpenPort>,
}

/// An unexplored port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpenPort {
    /// Port of the map.
    pub port: Port,
    /// The cell of the port's junction.
    pub cell: Cell,
    /// Cell to which the port leads.
    pub next: Cell,
}

/// Position of a fragment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lie {
    /// Cells from − to +, with the places at both ends.
    pub cells: Vec<Cell>,
    /// Whether the fragment's ends are where the maze has them.
    pub is_right: bool,
}

impl Layout {
    /// Lays a map over the maze it was learned in. The layout is empty if map or maze has no start.
    /// O(fragments · cells).
    #[must_use]
    pub fn of(map: &CpMap, maze: &Maze) -> Self {
        let mut layout = Self::default();
        let (Some((cell, ahead)), Some(start)) =
            (maze.start(), map.landmarks(Landmark::Start).next())
        else {
            return layout;
        };
        // Port 0 of the start is the way nearest to behind the robot.
        let behind = ahead.opposite();
        let nearest = [behind, behind.left(), behind.right(), ahead];
        let first = nearest.into_iter().find(|way| maze.is_open(cell, *way));
        let mut queue = VecDeque::new();
        if let Some(first) = first {
            layout.places.insert(start, (cell, first));
            queue.push_back((start, cell, first));
        }
        while let Some((id, cell, first)) = queue.pop_front() {
            let Some(junction) = map.junction(id) else {
                continue;
            };
            let ways = branches(maze, cell, first);
            if ways.len() != junction.ports.len() {
                continue;
            }
            for ((number, port), way) in (0..).zip(&junction.ports).zip(ways) {
                match port {
                    PortState::Open { .. } => {
                        let port = id.port(number);
                        let next = maze.beside(cell, way);
                        layout
                            .open
                            .extend(next.map(|next| OpenPort { port, cell, next }));
                    }
                    PortState::Filled(end) => {
                        queue.extend(layout.lay(map, maze, *end, cell, way));
                    }
                }
            }
        }
        layout
    }

    /// Lays a fragment that leads from one of its ends out of a cell. Returns the place at its
    /// other end, its cell and the direction of its port 0, if the place is new.
    fn lay(
        &mut self,
        map: &CpMap,
        maze: &Maze,
        end: End,
        from: Cell,
        way: Direction,
    ) -> Option<(JunctionId, Cell, Direction)> {
        if self.fragments.contains_key(&end.fragment) {
            return None;
        }
        let arrive = map.fragment(end.fragment)?.port(end.sign.opposite());
        let (mut cells, came) = along(maze, from, way)?;
        let to = *cells.last()?;
        let back = came.opposite();
        let known = self.places.get(&arrive.junction).copied();
        let is_right = known.is_none_or(|(cell, first)| {
            let ways = branches(maze, cell, first);
            cell == to && ways.get(arrive.number as usize) == Some(&back)
        });
        if end.sign == Sign::Plus {
            cells.reverse();
        }
        self.fragments.insert(end.fragment, Lie { cells, is_right });
        if known.is_some() {
            return None;
        }
        // The way back is port `arrive.number`; port 0 lies as many branches clockwise.
        let ways = branches(maze, to, back);
        let turn = arrive.number as usize % ways.len();
        let first = ways[(ways.len() - turn) % ways.len()];
        self.places.insert(arrive.junction, (to, first));
        Some((arrive.junction, to, first))
    }

    /// Returns the cell of a junction, or `None` where map and maze do not agree.
    #[must_use]
    pub fn place(&self, junction: JunctionId) -> Option<Cell> {
        self.places.get(&junction).map(|(cell, _)| *cell)
    }

    /// Returns all junctions that lie where the map has them, with their cells.
    pub fn places(&self) -> impl Iterator<Item = (JunctionId, Cell)> {
        self.places.iter().map(|(id, (cell, _))| (*id, *cell))
    }
}

/// Returns the ways out of a cell, counter-clockwise from one of them.
fn branches(maze: &Maze, cell: Cell, first: Direction) -> Vec<Direction> {
    let from = DIRECTIONS.iter().position(|way| *way == first).unwrap_or(0);
    let around = DIRECTIONS.iter().cycle().skip(from).take(DIRECTIONS.len());
    around
        .copied()
        .filter(|way| maze.is_open(cell, *way))
        .collect()
}
