use alloc::collections::BTreeSet;

use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::Landmark;
use tolman_sim::Zone;

use super::floor_graph::{FloorGraph, FloorSpot};
use super::spots::Spots;
use super::whereabouts::Squares;
use crate::course::Course;
use crate::cpm::{ends_fragments, follow};

/// Rule for the cells of a drawing that are places, depending on what a system can distinguish.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaceRule {
    /// Junctions, dead ends, the start and the goals. A bend is part of a way.
    Landmarks,
    /// Junctions, dead ends and bends: all cells but those where a corridor leads straight on, even
    /// with a landmark.
    Corners,
}

/// The true places of a drawing and the ways between them.
///
/// A place is a cell that can be reached and that the [`PlaceRule`] names, or a room: all cells of
/// open squares that overlap. The first of its cells stands for a room.
#[derive(Clone, Debug)]
pub struct TrueGraph {
    places: BTreeSet<Cell>,
    ways: Vec<TrueWay>,
    landmarks: Vec<(Cell, Landmark)>,
    /// Landmarks in rooms, each once. No place of its own stands for them.
    in_rooms: BTreeSet<(Cell, Landmark)>,
    spots: Spots,
}

/// A way between two places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrueWay {
    /// The places at the way's ends, which may be the same.
    pub ends: [Cell; 2],
    /// The cells in between, from the first end to the second.
    pub between: Vec<Cell>,
}

impl TrueWay {
    /// Returns whether the way joins two places, in either order.
    #[must_use]
    pub fn joins(&self, one: Cell, other: Cell) -> bool {
        self.ends == [one, other] || self.ends == [other, one]
    }
}

impl TrueGraph {
    /// Returns the graph of a drawing. O(cells).
    #[must_use]
    pub fn of(maze: &Maze, rule: PlaceRule) -> Self {
        let start = maze.start().map(|(cell, _)| (cell, Landmark::Start));
        let goals = maze.goals().iter().map(|cell| (*cell, Landmark::Goal));
        let spots = Spots::of_maze(maze);
        let landmarks = start.into_iter().chain(goals);
        let landmarks = landmarks.map(|(cell, mark)| (spots.at(cell), mark));
        let landmarks: Vec<(Cell, Landmark)> = landmarks.collect();
        let is_place = |cell: Cell| {
            spots.is_shared(cell)
                || match rule {
                    PlaceRule::Landmarks => ends_fragments(maze, cell),
                    PlaceRule::Corners => !is_straight(maze, cell),
                }
        };
        let reachable = maze.reachable().filter(|cell| is_place(*cell));
        let ends: BTreeSet<Cell> = reachable.collect();
        let mut ways: Vec<TrueWay> = Vec::new();
        let mut left: BTreeSet<(Cell, Direction)> = BTreeSet::new();
        for from in &ends {
            for (out, next) in maze.neighbours(*from) {
                let is_inside = spots.is_shared(next) && spots.at(next) == spots.at(*from);
                if is_inside || left.contains(&(*from, out)) {
                    continue;
                }
                let (mut between, came) = follow(maze, out, next, |cell| ends.contains(&cell));
                let to = between.pop().unwrap_or(next);
                left.insert((to, came.opposite()));
                let ends = [*from, to].map(|end| spots.at(end));
                ways.push(TrueWay { ends, between });
            }
        }
        let in_rooms = landmarks.iter().copied();
        let in_rooms = in_rooms.filter(|(cell, _)| {
            rule == PlaceRule::Landmarks && spots.is_shared(*cell) && ends.contains(cell)
        });
        Self {
            in_rooms: in_rooms.collect(),
            places: ends.iter().map(|cell| spots.at(*cell)).collect(),
            ways,
            landmarks,
            spots,
        }
    }

    /// Returns the graph of a course, in which the [`PlaceRule`] holds if it is a maze. In a free
    /// world the places are those of the skeleton of its floor, and its rooms.
    #[must_use]
    pub fn of_course(course: &Course, rule: PlaceRule) -> Self {
        let Some(floor) = FloorGraph::of_course(course) else {
            return Self::of(&course.maze, rule);
        };
        let squares = Squares::of(course);
        let spots = Spots::of_floor(&floor, squares);
        let cell = |spot| spots.at(squares.cell_at(floor.middle(spot)));
        let ways = floor.ways.iter().enumerate().map(|(number, way)| TrueWay {
            ends: way.ends.map(|end| cell(FloorSpot::Place(end))),
            between: [0, 1, 2]
                .map(|third| cell(FloorSpot::Way(number, third)))
                .to_vec(),
        });
        let start = course
            .start()
            .ok()
            .map(|pose| (pose.position, Landmark::Start));
        let goals = course.destination().map(Zone::areas).unwrap_or_default();
        let goals = goals.iter().map(|area| (area.middle(), Landmark::Goal));
        let marks = start.into_iter().chain(goals);
        let marks = marks.map(|(at, mark)| (spots.at(squares.cell_at(at)), mark));
        let landmarks: Vec<(Cell, Landmark)> = marks.collect();
        let rooms = floor
            .places
            .iter()
            .enumerate()
            .filter(|(_, place)| place.is_room);
        let rooms: BTreeSet<Cell> = rooms
            .map(|(room, _)| cell(FloorSpot::Place(room)))
            .collect();
        Self {
            places: (0..floor.places.len())
                .map(|place| cell(FloorSpot::Place(place)))
                .collect(),
            ways: ways.collect(),
            in_rooms: landmarks
                .iter()
                .copied()
                .filter(|(cell, _)| rooms.contains(cell))
                .collect(),
            landmarks,
            spots,
        }
    }

    /// Returns the cells that are places.
    #[must_use]
    pub const fn places(&self) -> &BTreeSet<Cell> {
        &self.places
    }

    /// Returns the ways between places, by number.
    #[must_use]
    pub fn ways(&self) -> &[TrueWay] {
        &self.ways
    }

    /// Returns whether a landmark is at the place of a cell.
    #[must_use]
    pub fn has(&self, cell: Cell, landmark: Landmark) -> bool {
        self.landmarks.contains(&(self.spots.at(cell), landmark))
    }

    /// Returns the landmarks in rooms, with the cells of the rooms. A whole map has them, too.
    pub(super) const fn in_rooms(&self) -> &BTreeSet<(Cell, Landmark)> {
        &self.in_rooms
    }

    pub(super) const fn spots(&self) -> &Spots {
        &self.spots
    }

    /// Returns the numbers of the ways that a robot has driven from end to end, given its `cells`
    /// in order. O(cells · ways).
    #[must_use]
    pub fn gone(&self, cells: impl IntoIterator<Item = Cell>) -> BTreeSet<usize> {
        let mut gone = BTreeSet::new();
        let mut from = None;
        let mut between: Vec<Cell> = Vec::new();
        for cell in cells {
            let cell = self.spots.at(cell);
            if !self.places.contains(&cell) {
                turn_back_or_on(&mut between, cell);
                continue;
            }
            if let Some(from) = from {
                gone.extend(self.way_along(from, cell, &between));
            }
            from = Some(cell);
            between.clear();
        }
        gone
    }

    fn way_along(&self, from: Cell, to: Cell, between: &[Cell]) -> Option<usize> {
        let backward = between.iter().rev();
        self.ways.iter().position(|way| {
            let is_forward = way.ends == [from, to] && way.between == between;
            let is_backward = way.ends == [to, from] && way.between.iter().eq(backward.clone());
            // A robot that stays in a place has not driven round a loop.
            (is_forward || is_backward) && (from != to || !between.is_empty())
        })
    }
}

/// Returns whether a corridor leads straight on through a cell.
pub(crate) fn is_straight(maze: &Maze, cell: Cell) -> bool {
    let ways = Direction::ALL.map(|way| maze.is_open(cell, way));
    ways == [true, false, true, false] || ways == [false, true, false, true]
}

/// Appends a cell, or removes the last one if the way turns back.
fn turn_back_or_on(between: &mut Vec<Cell>, cell: Cell) {
    match between[..] {
        [.., last] if last == cell => {}
        [.., before, _] if before == cell => {
            between.pop();
        }
        _ => between.push(cell),
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::cpm::{LOOP, TrueFragments};
    use crate::family::Family;

    fn cells(all: &[(u16, u16)]) -> Vec<Cell> {
        all.iter().map(|(x, y)| Cell::new(*x, *y)).collect()
    }

    #[test]
    fn a_loop_is_a_way_from_a_place_to_itself() {
        let graph = TrueGraph::of(&tolman_maze::read(LOOP).unwrap().maze, PlaceRule::Landmarks);
        assert_eq!((graph.places().len(), graph.ways().len()), (3, 3));
        let crossing = Cell::new(1, 1);
        let round = graph
            .ways()
            .iter()
            .position(|way| way.joins(crossing, crossing));
        let north = [(0, 1), (1, 1), (1, 2), (2, 2), (3, 2)];
        let south = [(3, 1), (3, 0), (2, 0), (1, 0), (1, 1)];
        let half = graph.gone(cells(&north));
        assert_eq!(half.len(), 1, "the loop was not gone to its end");
        // Back and forth between two cells is not another way.
        let wavering = [(3, 2), (3, 1), (3, 2)];
        let all = cells(&[&north[..], &wavering, &south].concat());
        let whole = graph.gone(all);
        assert_eq!(whole.len(), 2);
        assert!(whole.contains(&round.unwrap()));
        assert!(graph.gone(cells(&[(1, 1), (1, 1)])).is_empty());
    }

    #[test]
    fn it_has_the_fragments_that_cpm_is_scored_by() {
        for family in Family::ARENA {
            for seed in 0..10 {
                let rng = &mut ChaCha8Rng::seed_from_u64(seed);
                let maze = (family.draw)(family.sizes[1], rng).unwrap();
                let graph = TrueGraph::of(&maze, PlaceRule::Landmarks);
                let fragments = TrueFragments::of(&maze).count() as usize;
                let has_rooms = maze.grid().cells().any(|cell| maze.is_room(cell));
                let is_same = graph.ways().len() == fragments;
                assert!(is_same || has_rooms, "{}\n{maze}", family.name);
                // A robot that has been everywhere has driven all ways.
                for way in graph.ways() {
                    let [from, to] = way.ends;
                    let there = [&[from][..], &way.between, &[to]].concat();
                    let back = there.iter().rev().copied();
                    assert_eq!(graph.gone(there.iter().copied()).len(), 1);
                    assert_eq!(graph.gone(there.iter().copied()), graph.gone(back));
                }
            }
        }
    }
}
