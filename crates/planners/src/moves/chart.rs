use core::cmp::Ordering;

use tolman_maze::{Cell, Direction, Walls};

use super::cell_set::CellSet;
use super::map::Wave;
use super::sides::Sides;
use super::{Leap, MoveMap};
use crate::{TooLarge, Unknown};

/// Knowledge of a maze, and bounds on the length of runs through it.
///
/// Walls can be [learned](Self::look) one by one; the maps follow, and only as far as they change.
#[derive(Clone, Debug)]
pub(super) struct Chart<const N: usize> {
    pub(super) start: Cell,
    pub(super) goals: CellSet<N>,
    /// Sides that are open or unknown.
    pub(super) hoped: Sides<N>,
    /// Sides known to be open.
    pub(super) certain: Sides<N>,
    /// Fewest steps from the start to every cell over the `hoped` sides.
    pub(super) from_start: MoveMap<N>,
    /// Fewest steps from every cell to the goal over the `hoped` sides.
    pub(super) to_goal: MoveMap<N>,
    /// Length of the paper's closed path: steps of the best run over `certain` sides.
    pub(super) closed: Option<u16>,
    /// Fingerprint of all sides [looked at](Self::look) since the chart was made.
    pub(super) learned: u64,
}

impl<const N: usize> Chart<N> {
    pub(super) fn new(walls: &impl Walls, start: Cell, goals: &[Cell]) -> Result<Self, TooLarge> {
        let hoped = Sides::new(walls, Unknown::Open)?;
        let certain = Sides::new(walls, Unknown::Closed)?;
        let goals = CellSet::of(goals.iter().copied());
        let from = CellSet::of([start]);
        Ok(Self {
            start,
            goals,
            hoped,
            certain,
            from_start: MoveMap::over(&hoped, &from),
            to_goal: MoveMap::over(&hoped, &goals),
            closed: Wave::new(from).moves_to(&goals, &certain),
            learned: 0,
        })
    }

    /// Returns the length of the paper's open path: steps of the best run over sides that are open
    /// or unknown.
    pub(super) fn open(&self) -> Option<u16> {
        self.to_goal.moves(self.start)
    }

    /// Returns the unknown sides.
    pub(super) fn unknown(&self) -> Sides<N> {
        self.hoped.minus(&self.certain)
    }

    /// Returns the unknown sides of one cell.
    pub(super) fn unknown_sides(&self, cell: Cell) -> impl Iterator<Item = Direction> {
        Direction::ALL
            .into_iter()
            .filter(move |side| self.is_unknown(cell, *side))
    }

    pub(super) fn is_unknown(&self, cell: Cell, side: Direction) -> bool {
        self.hoped.contains(cell, side) && !self.certain.contains(cell, side)
    }

    /// Returns the steps of the best run from the start to the goal that drives over the `side` of
    /// `cell`. At most six leaps cross a side, each in both directions.
    pub(super) fn run_through(&self, cell: Cell, side: Direction) -> Option<u16> {
        let mut best: Option<u16> = None;
        self.hoped.leaps_over(cell, side, |one, other| {
            for (tail, head) in [(one, other), (other, one)] {
                if let (Some(before), Some(after)) =
                    (self.from_start.moves(tail), self.to_goal.moves(head))
                {
                    let run = before + 1 + after;
                    best = Some(best.map_or(run, |best| best.min(run)));
                }
            }
        });
        best
    }

    /// Returns a way of fewest steps from `at` to `target` on known ground, or `None` if none leads
    /// there. Of equally short ways it prefers one from whose last stops many unknown sides are
    /// visible.
    pub(super) fn course(&self, target: Cell, at: Cell) -> Option<Course> {
        let mut course = Course::to(target);
        if self.leap_to(target, at).is_some() {
            return Some(course);
        }
        let here = MoveMap::between(&self.certain, at, target);
        let mut stop = target;
        course.steps = here.moves(target)?;
        for steps in (1..course.steps).rev() {
            let ends = self.certain.leaps(stop).map(|leap| leap.end);
            let ends = ends.filter(|end| here.moves(*end) == Some(steps));
            // Of equals the first.
            let seen = ends.map(|end| (self.unknown_sides(end).count(), end));
            (_, stop) = seen.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
            course.pass(stop, steps);
        }
        Some(course)
    }

    /// Returns the first leap of the way from `at` to `target`.
    pub(super) fn leap_towards(&self, target: Cell, at: Cell) -> Option<Leap> {
        let first = self.course(target, at)?.stops().next()?;
        self.leap_to(first, at)
    }

    /// Returns the leap from `at` to `end`, if one leads there.
    fn leap_to(&self, end: Cell, at: Cell) -> Option<Leap> {
        let direction = match (end.x.cmp(&at.x), end.y.cmp(&at.y)) {
            (Ordering::Equal, Ordering::Greater) => Direction::North,
            (Ordering::Greater, Ordering::Equal) => Direction::East,
            (Ordering::Equal, Ordering::Less) => Direction::South,
            (Ordering::Less, Ordering::Equal) => Direction::West,
            _ => return None,
        };
        let mut leaps = self.certain.leaps_along(at, direction);
        leaps.find(|leap| leap.end == end)
    }

    /// Drives from `at` towards `target` through a maze with the open sides `truth`, until there is
    /// something new to see.
    pub(super) fn drive(&mut self, truth: &Sides<N>, target: Cell, at: Cell) -> Option<Driven> {
        let mut driven = Driven { steps: 0, at };
        while driven.at != target {
            // As long as there is nothing new, the way onward stays the same.
            for stop in self.course(target, driven.at)?.stops() {
                driven.at = stop;
                driven.steps += 1;
                if self.look(truth, stop) {
                    return Some(driven);
                }
            }
        }
        Some(driven)
    }

    /// Returns whether a side leads into a goal or to a cell from which a way leads on. Only such a
    /// side can be part of a run.
    fn joins(&self, at: Cell, side: Direction) -> bool {
        let Some(across) = at.beyond(side) else {
            return false;
        };
        let mut onward = Direction::ALL
            .into_iter()
            .filter(|on| *on != side.opposite());
        self.goals.contains(across) || onward.any(|on| self.certain.contains(across, on))
    }

    /// Records what is visible from `from` to the four sides, each as far as the next wall. Returns
    /// whether any side was unknown before.
    fn look(&mut self, truth: &Sides<N>, from: Cell) -> bool {
        let (mut news, mut shorter) = (false, false);
        let limit = self.closed.unwrap_or(u16::MAX);
        for side in Direction::ALL {
            let mut at = from;
            while self.hoped.contains(at, side) {
                if !self.certain.contains(at, side) {
                    news = true;
                    self.learned ^= Sides::<N>::fingerprint(at, side);
                    if !truth.contains(at, side) {
                        self.hoped.remove(at, side);
                        self.from_start.side_closed(&self.hoped, at, side);
                        self.to_goal.side_closed(&self.hoped, at, side);
                        break;
                    }
                    self.certain.insert(at, side);
                    shorter |= self.joins(at, side)
                        && self.run_through(at, side).is_some_and(|run| run < limit);
                }
                match at.beyond(side) {
                    Some(next) => at = next,
                    None => break,
                }
            }
        }
        if shorter {
            let wave = Wave::new(CellSet::of([self.start]));
            self.closed = wave.moves_to(&self.goals, &self.certain);
        }
        // Only runs that are better than the best one that is certain matter.
        let limit = self.closed.unwrap_or(u16::MAX);
        self.from_start.mend(&self.hoped, limit);
        self.to_goal.mend(&self.hoped, limit);
        news
    }

    /// Returns cells by their distance from `at` on known ground, nearest first.
    pub(super) fn around(&self, at: Cell) -> impl Iterator<Item = (u16, CellSet<N>)> {
        let mut wave = Wave::new(CellSet::of([at]));
        core::iter::from_fn(move || {
            wave.advance(&self.certain);
            (!wave.front.is_empty()).then_some((wave.moves, wave.front))
        })
    }
}

/// A way, by the ends of its leaps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    stops: [Cell; Self::MOST],
    /// Number of steps of the whole way.
    steps: u16,
}

impl Course {
    /// Maximum number of stops kept.
    const MOST: usize = 32;

    /// Returns the way of one leap.
    const fn to(target: Cell) -> Self {
        Self {
            stops: [target; Self::MOST],
            steps: 1,
        }
    }

    /// Records that the way leads to `stop` after `steps` steps.
    fn pass(&mut self, stop: Cell, steps: u16) {
        if let Some(slot) = self.stops.get_mut(usize::from(steps) - 1) {
            *slot = stop;
        }
    }

    fn stops(&self) -> impl Iterator<Item = Cell> {
        let count = usize::from(self.steps).min(Self::MOST);
        self.stops.into_iter().take(count)
    }
}

/// End of a drive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Driven {
    pub(super) steps: u16,
    pub(super) at: Cell,
}

#[cfg(test)]
#[cfg(feature = "alloc")]
mod tests {
    use alloc::vec::Vec;

    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use tolman_maze::{Braided, Maze};

    use super::*;

    fn maze(seed: u64) -> Maze {
        let shape = Braided {
            width: 8,
            height: 7,
            share: 0.6,
        };
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        shape.generate(rng).unwrap()
    }

    fn chart(maze: &Maze) -> Chart<8> {
        let start = Cell::new(0, 0);
        Chart::new(maze, start, maze.goals()).unwrap()
    }

    /// Returns the fewest leaps between two cells, by adding one leap to all ways at a time.
    fn fewest(chart: &Chart<8>, from: Cell, to: Cell) -> u16 {
        let mut reached = Vec::from([from]);
        for steps in 0.. {
            if reached.contains(&to) {
                return steps;
            }
            let next = reached.iter().flat_map(|at| chart.certain.leaps(*at));
            let next: Vec<Cell> = next.map(|leap| leap.end).collect();
            reached.extend(next);
            reached.sort_unstable();
            reached.dedup();
        }
        unreachable!("all cells hang together")
    }

    #[test]
    fn a_course_is_a_shortest_way_of_leaps() {
        for seed in 0..4 {
            let maze = maze(seed);
            let chart = chart(&maze);
            let grid = maze.grid();
            for (number, at) in grid.cells().enumerate() {
                for target in grid.cells().skip(number % 5).step_by(5) {
                    let stops: Vec<Cell> = match chart.course(target, at) {
                        Some(course) => course.stops().collect(),
                        None => unreachable!("all is known"),
                    };
                    let expected = usize::from(fewest(&chart, at, target)).max(1);
                    if at == target {
                        continue;
                    }
                    assert_eq!(stops.len(), expected, "{at} to {target}");
                    assert_eq!(stops.last(), Some(&target));
                    let before = core::iter::once(&at).chain(&stops);
                    for (before, stop) in before.zip(&stops) {
                        let mut leaps = chart.certain.leaps(*before);
                        assert!(leaps.any(|leap| leap.end == *stop), "{before} to {stop}");
                        let leap = chart.leap_to(*stop, *before).map(|leap| leap.end);
                        assert_eq!(leap, Some(*stop));
                    }
                    let first = chart.leap_towards(target, at).map(|leap| leap.end);
                    assert_eq!(first, stops.first().copied());
                }
            }
        }
    }

    /// In a known maze nothing is new: a drive takes the steps of its course.
    #[test]
    fn a_drive_over_known_ground_ends_at_its_target() {
        let maze = maze(5);
        let known = chart(&maze);
        let truth = known.certain;
        for target in maze.grid().cells() {
            let at = Cell::new(3, 3);
            let driven = known.clone().drive(&truth, target, at);
            let driven = driven.map(|driven| (driven.steps, driven.at));
            assert_eq!(driven, Some((fewest(&known, at, target), target)));
        }
    }

    /// Checks that a chart kept up to date equals a new one, wherever the mouse looks.
    #[test]
    fn a_chart_that_looks_is_as_one_made_anew() {
        for seed in 0..6 {
            let maze = maze(seed);
            let truth = chart(&maze).certain;
            let mut chart = chart(&Maze::open(maze.grid()));
            chart.certain = Sides::NONE;
            chart.goals = CellSet::of([Cell::new(4, 3)]);
            chart.to_goal = MoveMap::over(&chart.hoped, &chart.goals);
            chart.closed = None;
            let mut unknown = chart.unknown().len();
            let cells: Vec<Cell> = maze.grid().cells().collect();
            // All of them, to and fro.
            for number in 0..cells.len() {
                let at = cells[number * 23 % cells.len()];
                let news = chart.look(&truth, at);
                let left = chart.unknown().len();
                assert_eq!(news, left < unknown, "there is something new at {at}");
                unknown = left;
                for side in Direction::ALL {
                    let mut seen = at;
                    while truth.contains(seen, side) {
                        assert!(chart.certain.contains(seen, side));
                        seen = match seen.beyond(side) {
                            Some(next) => next,
                            None => break,
                        };
                    }
                    assert!(!chart.is_unknown(seen, side));
                    let known = chart.unknown_sides(at).count();
                    assert_eq!(known, 0);
                }
                let wave = Wave::new(CellSet::of([chart.start]));
                let closed = wave.moves_to(&chart.goals, &chart.certain);
                assert_eq!(chart.closed, closed);
                let again = MoveMap::over(&chart.hoped, &chart.goals);
                let limit = closed.unwrap_or(u16::MAX);
                for cell in maze.grid().cells() {
                    let expected = again.moves(cell).filter(|moves| *moves < limit);
                    let found = chart.to_goal.moves(cell).filter(|moves| *moves < limit);
                    assert_eq!(found, expected, "{cell}");
                }
                assert!(chart.open() <= closed || closed.is_none());
            }
            assert_eq!(unknown, 0);
            assert_eq!(chart.hoped, truth);
        }
    }

    /// The best run over a side is the best over any leap that drives over it.
    #[test]
    fn a_run_through_a_side_is_the_best_of_all_that_drive_over_it() {
        let maze = maze(7);
        let chart = chart(&maze);
        let moves = |to: Cell| fewest(&chart, chart.start, to);
        let to_goal = |from: Cell| {
            let goals = maze.goals().iter();
            goals.map(|goal| fewest(&chart, from, *goal)).min()
        };
        for cell in maze.grid().cells().step_by(3) {
            for side in Direction::ALL {
                if !chart.certain.contains(cell, side) {
                    continue;
                }
                let mut best = None;
                for tail in maze.grid().cells() {
                    for leap in chart.certain.leaps(tail) {
                        let mut at = tail;
                        let over = (0..leap.cells).any(|_| {
                            let here = (at, leap.direction);
                            at = at.beyond(leap.direction).unwrap_or(at);
                            here == (cell, side) || (at, leap.direction.opposite()) == (cell, side)
                        });
                        if over {
                            let run = to_goal(leap.end).map(|left| moves(tail) + 1 + left);
                            best = best.into_iter().chain(run).min();
                        }
                    }
                }
                assert_eq!(chart.run_through(cell, side), best, "{cell} {side}");
            }
        }
    }

    #[test]
    fn cells_around_come_by_their_distance() {
        let maze = maze(9);
        let chart = chart(&maze);
        let at = Cell::new(2, 5);
        let mut seen = 1;
        for (moves, cells) in chart.around(at) {
            for cell in cells.iter() {
                assert_eq!(fewest(&chart, at, cell), moves);
                seen += 1;
            }
        }
        assert_eq!(seen, maze.grid().cell_count());
    }
}
