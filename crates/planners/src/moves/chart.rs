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
    /// Sides that may be open.
    pub(super) hoped: Sides<N>,
    /// The sides known to be open.
    pub(super) certain: Sides<N>,
    /// Steps from the start, hoped for.
    pub(super) from_start: MoveMap<N>,
    /// Steps to the goal, hoped for.
    pub(super) to_goal: MoveMap<N>,
    /// The paper's close path: steps of the best run that is certain.
    pub(super) closed: Option<u16>,
    /// A fingerprint of the sides that were [looked at](Self::look) since the chart was made.
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

    /// Returns the paper's open path: steps of the best run that can be hoped for.
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
    /// `cell`. At most six leaps do, each in both directions.
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
    /// there. Of equal ways it is one with much to see at its last stops.
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

    /// Returns whether a goal is across a side, or the way leads on from there: a run over a newly
    /// known side has to continue.
    fn joins(&self, at: Cell, side: Direction) -> bool {
        let Some(across) = at.beyond(side) else {
            return false;
        };
        let mut onward = Direction::ALL
            .into_iter()
            .filter(|on| *on != side.opposite());
        self.goals.contains(across) || onward.any(|on| self.certain.contains(across, on))
    }

    /// Looks to the four sides, each as far as the next wall. Whether there was anything new.
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
    /// Number of stops that are kept.
    const MOST: usize = 32;

    /// Returns the way of one leap.
    const fn to(target: Cell) -> Self {
        Self {
            stops: [target; Self::MOST],
            steps: 1,
        }
    }

    /// Notes that the way leads to `stop` after `steps` steps.
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
