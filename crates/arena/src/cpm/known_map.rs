use alloc::collections::BTreeMap;

use tolman_maze::{Cell, Maze};
use tolman_planners::{Arcs, costs_from};

use super::fragments::{WayOut, landmark_at};

/// The map of a perfect reasoner of the paper's kind after the same walk: the baseline of a trial.
///
/// Nothing that the paper's robot perceives tells one junction from another. Two visits are known
/// to be of one place for two reasons only. Either a fragment was walked twice, so that its ends
/// coincide ("junc(𝔸₁⁺) = junc(𝔸₂⁺) and junc(𝔸₁⁻) = junc(𝔸₂⁻)", section 4.3), or start or goal were
/// seen there. A junction that was met only by different fragments stays several junctions.
/// Fragments are identified by ground truth, so this map depends on no mapper.
///
/// The inferences are complete: visits of one place that were left by one port are one fragment
/// walked twice.
#[derive(Clone, Debug)]
pub(super) struct KnownMap<'a> {
    maze: &'a Maze,
    visits: Vec<Visit>,
    /// The first walk along each fragment.
    walks: BTreeMap<u32, (u32, u32)>,
    /// Fragments from visit to visit, each with its length.
    arcs: Vec<(u32, u32, u32)>,
}

/// One visit of the robot at a place.
#[derive(Clone, Copy, Debug)]
struct Visit {
    cell: Cell,
    /// Number of an earlier visit to the same place; the visit's own number if none is known.
    same: u32,
}

impl<'a> KnownMap<'a> {
    /// Returns a robot that stands at the start.
    pub(super) fn new(maze: &'a Maze) -> Self {
        let mut known = Self {
            maze,
            visits: Vec::new(),
            walks: BTreeMap::new(),
            arcs: Vec::new(),
        };
        if let Some((start, _)) = maze.start() {
            known.visit(start);
        }
        known
    }

    /// Takes in a walk to cell `to` along the true fragment `way`, or `None` if the robot was lost.
    /// `length` is that of the walk, in any unit.
    pub(super) fn walk(&mut self, way: Option<WayOut>, to: Cell, length: u32) {
        let from = self.visits.len().saturating_sub(1) as u32;
        let to = self.visit(to);
        self.arcs.push((from, to, length));
        let Some(way) = way else {
            return;
        };
        let (first, last) = match way.is_forward {
            true => (from, to),
            false => (to, from),
        };
        let before = *self.walks.entry(way.fragment).or_insert((first, last));
        self.unify(before.0, first);
        self.unify(before.1, last);
    }

    /// Returns the length of the shortest known way from start to goal, or `None` if none is known.
    pub(super) fn shortest(&self) -> Option<u32> {
        let (start, _) = self.maze.start()?;
        let both_ways = self.arcs.iter().flat_map(|(from, to, length)| {
            let (from, to) = (self.place(*from), self.place(*to));
            [(from, to, *length), (to, from, *length)]
        });
        let arcs = Arcs::new(self.visits.len(), &both_ways.collect::<Vec<_>>());
        let costs = costs_from(&arcs, [self.place_of(start)?]);
        let goals = self.maze.goals().iter();
        let reached = goals.filter_map(|goal| costs[self.place_of(*goal)? as usize]);
        reached.min()
    }

    fn visit(&mut self, cell: Cell) -> u32 {
        let is_landmark = landmark_at(self.maze, cell).is_some();
        let before = self.place_of(cell).filter(|_| is_landmark);
        let visit = self.visits.len() as u32;
        let same = before.unwrap_or(visit);
        self.visits.push(Visit { cell, same });
        visit
    }

    /// Returns the place of the first visit of a cell.
    fn place_of(&self, cell: Cell) -> Option<u32> {
        let mut visits = self.visits.iter();
        let first = visits.position(|visit| visit.cell == cell)?;
        Some(self.place(first as u32))
    }

    /// Returns the earliest visit that is known to be of the same place.
    fn place(&self, visit: u32) -> u32 {
        let mut at = visit;
        while self.visits[at as usize].same != at {
            at = self.visits[at as usize].same;
        }
        at
    }

    fn unify(&mut self, one: u32, other: u32) {
        let (one, other) = (self.place(one), self.place(other));
        self.visits[one.max(other) as usize].same = one.min(other);
    }
}

#[cfg(test)]
mod tests {
    use super::super::fragments::TrueFragments;
    use super::super::fragments::tests::THREE_WAYS;
    use super::*;
    use Direction::{East, North, South, West};
    use tolman_control::heading_of;
    use tolman_maze::Direction;

    /// Returns the shortest known way after some walks, in a maze whose cells are all equally long.
    /// Walks and way are given by the directions in which each place is left.
    fn shortest(text: &str, directions: &[Direction]) -> Option<u32> {
        let maze = tolman_maze::read(text).unwrap().maze;
        let fragments = TrueFragments::of(&maze);
        let mut known = KnownMap::new(&maze);
        let mut at = maze.start().unwrap().0;
        for direction in directions {
            let way = fragments.way(at, heading_of(*direction)).unwrap();
            known.walk(Some(way), way.to, way.cells);
            at = way.to;
        }
        known.shortest()
    }

    #[test]
    fn a_junction_is_known_to_be_one_by_a_fragment_that_was_walked_twice() {
        // Over the top, back through the middle, over the bottom: in truth, the middle is the
        // shortest way, but no fragment was walked twice.
        let by_different_ones = [East, North, West, South, East];
        assert_eq!(shortest(THREE_WAYS, &by_different_ones), Some(12));
        // Over the top again: both crossings are those of before.
        assert_eq!(
            shortest(THREE_WAYS, &[East, North, West, North, East]),
            Some(4)
        );
        // The other way round it shows as well, and so it does where the robot turns back.
        assert_eq!(
            shortest(THREE_WAYS, &[East, North, West, South, North, South, East]),
            Some(4)
        );
        assert_eq!(
            shortest(THREE_WAYS, &[East, North, North, East, East]),
            Some(4)
        );
    }

    #[test]
    fn a_landmark_is_known_wherever_one_comes_from() {
        let ring = "\
start = 0 0 north

o---o---o---o
|           |
o   o---o   o
| S       G |
o---o---o---o
";
        assert_eq!(shortest(ring, &[North]), Some(4));
        assert_eq!(shortest(ring, &[North, West]), Some(2));
    }

    #[test]
    fn what_leads_nowhere_known_is_no_way() {
        assert_eq!(shortest(THREE_WAYS, &[East, North]), None);
        assert_eq!(shortest(THREE_WAYS, &[]), None);
    }

    #[test]
    fn a_robot_that_was_lost_is_known_to_have_come_the_way_it_came() {
        let maze = tolman_maze::read(THREE_WAYS).unwrap().maze;
        let mut known = KnownMap::new(&maze);
        known.walk(None, Cell::new(3, 1), 7);
        known.walk(None, maze.goals()[0], 1);
        assert_eq!(known.shortest(), Some(8));
    }
}
