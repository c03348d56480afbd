use alloc::collections::{BTreeMap, BTreeSet};
use core::ops::RangeInclusive;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_maze::{Cell, Direction, Maze};
use tolman_systems::stream;

use crate::course::pick;

/// Reason why no errands can be run in a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoLandmarks {
    /// It marks some landmarks, and not enough of them.
    #[error(
        "it marks {marked} landmark, and errands lead from one to another: mark at least {} cells from 1 to 8, or none, so that they are placed by seed",
        LANDMARKS.start()
    )]
    TooFew {
        /// Number of landmarks that it marks.
        marked: usize,
    },
    /// A landmark is walled off.
    #[error(
        "no way leads from landmark {number} to the goal: open one, or mark the landmark elsewhere"
    )]
    CutOff {
        /// Number of the landmark.
        number: u32,
    },
    /// There is no room for landmarks.
    #[error(
        "it has {cells} cells besides start and goal, and errands need landmarks in {}: mark 1 to 8 in a larger drawing",
        PLACED.start()
    )]
    NoRoom {
        /// Number of cells that could have one.
        cells: usize,
    },
}

/// Number of landmarks that are placed by seed.
const PLACED: RangeInclusive<usize> = 4..=8;

/// Number of landmarks that errands need.
const LANDMARKS: RangeInclusive<usize> = 2..=8;

/// Number of cells to a landmark that is placed by seed.
const CELLS_A_LANDMARK: usize = 8;

/// Number of steps between two landmarks that are placed by seed, if the drawing has room: the way
/// of an errand should not be lost in the size of a landmark.
const APART: u32 = 3;

/// Number of errands from one move of a door to the next.
const ERRANDS_A_DOOR: u32 = 5;

const LANDMARK_STREAM: u64 = 35;
const ERRAND_STREAM: u64 = 36;

/// Returns a drawing with landmarks: its own, or one for eight cells, four at least and eight at
/// most. They stand in random cells but start and goals, three steps apart where there is room.
pub(super) fn placed(maze: &Maze, seed: u64) -> Result<Maze, NoLandmarks> {
    let reached: Vec<Cell> = maze.reachable().collect();
    let marked = numbers(maze);
    if !marked.is_empty() {
        let cut_off = maze
            .landmarks()
            .iter()
            .find(|(cell, _)| !reached.contains(cell));
        if let Some((_, number)) = cut_off {
            return Err(NoLandmarks::CutOff { number: *number });
        }
        return match marked.len() < *LANDMARKS.start() {
            true => Err(NoLandmarks::TooFew {
                marked: marked.len(),
            }),
            false => Ok(maze.clone()),
        };
    }
    let is_start = |cell: &Cell| maze.start().is_some_and(|(start, _)| start == *cell);
    let mut left = reached;
    left.retain(|cell| !is_start(cell) && !maze.goals().contains(cell));
    let cells = left.len();
    let wanted = (cells / CELLS_A_LANDMARK).clamp(*PLACED.start(), *PLACED.end());
    if cells < wanted {
        return Err(NoLandmarks::NoRoom { cells });
    }
    let rng = &mut stream(seed, LANDMARK_STREAM);
    let mut landmarks = BTreeMap::new();
    for number in 1..=wanted as u32 {
        let placed: Vec<Cell> = landmarks.keys().copied().collect();
        let steps = maze.steps_to(&placed);
        let apart = |cell: &Cell| steps[maze.grid().index(*cell)].unwrap_or(APART).min(APART);
        let most = left.iter().map(apart).max();
        let farthest: Vec<Cell> = left
            .iter()
            .copied()
            .filter(|cell| Some(apart(cell)) == most)
            .collect();
        if let Some(cell) = pick(&farthest, rng) {
            left.retain(|other| *other != cell);
            landmarks.insert(cell, number);
        }
    }
    let mut placed = maze.clone();
    placed.set_landmarks(landmarks);
    Ok(placed)
}

/// Returns the numbers of a drawing's landmarks, each once and in order.
fn numbers(maze: &Maze) -> Vec<u32> {
    let numbers: BTreeSet<u32> = maze.landmarks().values().copied().collect();
    numbers.into_iter().collect()
}

/// An errand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Errand {
    /// Number of the landmark to go to.
    pub(super) to: u32,
    /// Door that moves before.
    pub(super) door: Option<DoorMove>,
}

/// A door that shuts or opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DoorMove {
    /// Number of the door, from 0.
    pub(super) door: usize,
    pub(super) is_shut: bool,
}

/// The errands of a world, drawn one after another. Robots and the oracle are given the same.
#[derive(Clone, Debug)]
pub(super) struct ErrandPlan {
    /// The drawing as it is now, with a wall for each door that is shut.
    maze: Maze,
    landmarks: Vec<u32>,
    doors: Vec<((Cell, Direction), bool)>,
    last: Option<u32>,
    drawn: u32,
    rng: ChaCha8Rng,
}

impl ErrandPlan {
    /// Returns the errands in a drawing that marks landmarks, with these openings as doors.
    pub(super) fn new(maze: &Maze, doors: Vec<(Cell, Direction)>, seed: u64) -> Self {
        Self {
            maze: maze.clone(),
            landmarks: numbers(maze),
            doors: doors.into_iter().map(|door| (door, false)).collect(),
            last: None,
            drawn: 0,
            rng: stream(seed, ERRAND_STREAM),
        }
    }

    /// Returns the drawing as it is now.
    pub(super) const fn maze(&self) -> &Maze {
        &self.maze
    }

    /// Draws the next errand: to another landmark than the last one. Every fifth errand a door
    /// moves.
    pub(super) fn next(&mut self) -> Errand {
        let others = self.landmarks.iter().copied();
        let others: Vec<u32> = others.filter(|of| Some(*of) != self.last).collect();
        let to = pick(&others, &mut self.rng).unwrap_or(0);
        self.last = Some(to);
        self.drawn += 1;
        let moves = self.drawn.is_multiple_of(ERRANDS_A_DOOR) && !self.doors.is_empty();
        let door = moves.then(|| self.move_a_door()).flatten();
        Errand { to, door }
    }

    /// Moves the first door from a random one on that cuts nothing off.
    fn move_a_door(&mut self) -> Option<DoorMove> {
        let count = joined(&self.maze);
        let doors = self.doors.len();
        let first = self.rng.random_range(0..doors as u32) as usize;
        for door in (first..first + doors).map(|door| door % doors) {
            let ((cell, way), was_shut) = self.doors[door];
            let mut moved = self.maze.clone();
            moved.set_wall(cell, way, !was_shut);
            if joined(&moved) == count {
                self.maze = moved;
                self.doors[door].1 = !was_shut;
                let is_shut = !was_shut;
                return Some(DoorMove { door, is_shut });
            }
        }
        None
    }
}

/// Returns the number of cells from which a way leads to the first landmark.
fn joined(maze: &Maze) -> usize {
    let first: Vec<Cell> = maze.landmarks().keys().take(1).copied().collect();
    maze.steps_to(&first).iter().flatten().count()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use rand::SeedableRng;

    use super::*;
    use crate::contest::Condition;
    use crate::family::Family;

    fn drawn(family: usize, seed: u64) -> Maze {
        let family = Family::ARENA[family];
        let rng = &mut ChaCha8Rng::seed_from_u64(seed);
        (family.draw)(family.sizes[0], rng).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn landmarks_stand_apart_and_can_be_reached(family in 0..Family::ARENA.len(), seed: u64) {
            let maze = drawn(family, seed);
            let placed = placed(&maze, seed).unwrap();
            let reached: Vec<Cell> = maze.reachable().collect();
            prop_assert!(PLACED.contains(&placed.landmarks().len()));
            let mut numbers: Vec<u32> = placed.landmarks().values().copied().collect();
            numbers.sort_unstable();
            prop_assert!(numbers.iter().copied().eq(1..=numbers.len() as u32));
            for cell in placed.landmarks().keys() {
                prop_assert!(reached.contains(cell) && !maze.goals().contains(cell));
                prop_assert!(maze.start().is_none_or(|(start, _)| start != *cell));
            }
        }

        #[test]
        fn doors_move_every_fifth_errand_and_cut_nothing_off(family in 0..Family::ARENA.len(), seed: u64) {
            let maze = placed(&drawn(family, seed), seed).unwrap();
            let doors = Condition::MovingDoors.doors(&maze, seed);
            let mut plan = ErrandPlan::new(&maze, doors.clone(), seed);
            let (mut last, mut moves) = (None, 0);
            for number in 1..=60 {
                let errand = plan.next();
                prop_assert!(Some(errand.to) != last);
                last = Some(errand.to);
                prop_assert_eq!(errand.door.is_some(), number % 5 == 0 && !doors.is_empty());
                if let Some(DoorMove { door, is_shut }) = errand.door {
                    let (cell, way) = doors[door];
                    prop_assert_eq!(plan.maze().is_open(cell, way), !is_shut);
                    moves += 1;
                }
                prop_assert_eq!(joined(plan.maze()), maze.reachable().count());
            }
            prop_assert_eq!(moves, if doors.is_empty() { 0 } else { 12 });
        }
    }

    #[test]
    fn a_drawing_that_marks_one_landmark_says_what_to_do() {
        let text = "o---o---o---o\n| S   1   G |\no---o---o---o\n";
        let maze = tolman_maze::read(text).unwrap().maze;
        let error = placed(&maze, 1).unwrap_err();
        assert_eq!(error, NoLandmarks::TooFew { marked: 1 });
        assert!(error.to_string().contains("mark at least 2 cells"));
        let text = "o---o---o---o\n| S       G |\no---o---o---o\n";
        let maze = tolman_maze::read(text).unwrap().maze;
        assert_eq!(placed(&maze, 1), Err(NoLandmarks::NoRoom { cells: 1 }));
        let text = "o---o---o---o\n| S 2 1 G | 1 |\n";
        assert!(tolman_maze::read(text).is_err());
    }
}
