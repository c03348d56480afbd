use alloc::collections::BTreeMap;

use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze};
use tolman_robot::Landmark;

use super::paint::Paint;
use super::play::Measured;
use super::whereabouts::Squares;
use crate::cpm::landmark_at;

/// An observer that has the drawing and recognizes all it sees without error: the upper bound for
/// anyone who watches the same drive.
///
/// In each cell it sees the walls and the landmark. Through each opening it sees the walls of
/// several cells straight on, more than any robot does. If the robot sees colours, it sees the
/// colours of all walls around.
#[derive(Clone, Debug)]
pub(super) struct IdealObserver {
    pub(super) maze: Maze,
    /// Whether the observer knows where north is.
    pub(super) has_compass: bool,
    /// Number of cells that the observer sees through an opening.
    pub(super) reach: u32,
    /// Colours of the walls; empty if the observer sees no colours.
    pub(super) paint: Paint,
}

/// View in a cell, clockwise from one direction.
#[derive(Debug, PartialEq)]
struct CellView {
    landmark: Option<Landmark>,
    is_open: Vec<bool>,
    colours: Vec<[u8; 3]>,
}

/// A possible start of the robot, and where the robot is now if that start is right.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    /// Number of quarter turns, clockwise, from the true directions to those of this candidate.
    turned: usize,
    at: Cell,
}

impl IdealObserver {
    /// Returns the [chance](Self::chance) for a robot that drove along `path`. It was put down in
    /// the middle of a cell, and looked out of it.
    pub(super) fn after(&self, squares: Squares, start: (Cell, Direction), path: &[Pose]) -> f64 {
        let mut cells = vec![start.0];
        cells.extend(path.iter().map(|pose| squares.cell_at(pose.position)));
        cells.dedup();
        self.chance(start.1, &cells)
    }

    /// Returns the probability that its best guess of the last cell is right, 0 to 1. The drive
    /// goes through all `cells` and begins looking along `way`. All cells but goals, with all ways
    /// out of them, are equally likely starts. O(starts · cells).
    pub(super) fn chance(&self, way: Direction, cells: &[Cell]) -> f64 {
        let (Some(first), Some(last)) = (cells.first(), cells.last()) else {
            return 0.0;
        };
        let mut left = self.starts(way);
        self.see(&mut left, *first);
        for pair in cells.windows(2) {
            for direction in self.between(pair[0], pair[1]) {
                for candidate in &mut left {
                    let turned = turned(direction, candidate.turned);
                    candidate.at = self
                        .maze
                        .beside(candidate.at, turned)
                        .unwrap_or(candidate.at);
                }
            }
            self.see(&mut left, pair[1]);
        }
        let mut ends = BTreeMap::<Cell, u32>::new();
        for candidate in left {
            *ends.entry(candidate.at).or_default() += 1;
        }
        let most = ends.values().copied().max().unwrap_or(0);
        let best = ends.values().filter(|count| **count == most).count();
        match ends.get(last) {
            Some(count) if *count == most => 1.0 / best as f64,
            _ => 0.0,
        }
    }

    fn starts(&self, way: Direction) -> Vec<Candidate> {
        let ways = self.maze.ways_out().into_iter();
        let starts = ways.map(|(at, out)| Candidate {
            turned: (out.index() + 4 - way.index()) % 4,
            at,
        });
        starts
            .filter(|start| start.turned == 0 || !self.has_compass)
            .collect()
    }

    /// Removes the candidates whose view of this cell would differ.
    fn see(&self, left: &mut Vec<Candidate>, cell: Cell) {
        let seen = self.view(cell, 0);
        left.retain(|candidate| self.view(candidate.at, candidate.turned) == seen);
    }

    fn view(&self, cell: Cell, turn: usize) -> CellView {
        let mut is_open = Vec::new();
        for direction in Direction::ALL {
            let ahead = turned(direction, turn);
            let mut at = cell;
            is_open.push(self.maze.is_open(at, ahead));
            for _ in 0..self.reach {
                let Some(next) = self.maze.beside(at, ahead) else {
                    break;
                };
                at = next;
                let sides = [1, 0, 3].map(|side| self.maze.is_open(at, turned(ahead, side)));
                is_open.extend(sides);
            }
        }
        CellView {
            landmark: landmark_at(&self.maze, cell),
            is_open,
            colours: self.paint.seen(cell, turn).collect(),
        }
    }

    /// Returns the shortest way between two cells that were seen one after another. A robot may
    /// pass cells between two looks.
    fn between(&self, from: Cell, to: Cell) -> Vec<Direction> {
        let steps = self.maze.steps_to(&[to]);
        let left = |cell: Cell| steps[self.maze.grid().index(cell)];
        let (mut at, mut way) = (from, Vec::new());
        while at != to {
            let mut ways = self.maze.neighbours(at);
            let Some((direction, next)) = ways.find(|(_, next)| left(*next) < left(at)) else {
                break;
            };
            way.push(direction);
            at = next;
        }
        way
    }
}

/// Returns the direction turned clockwise by `quarters` quarter turns.
fn turned(direction: Direction, quarters: usize) -> Direction {
    Direction::ALL[(direction.index() + quarters) % 4]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpm::LOOP;

    fn chance(text: &str, has_compass: bool, way: Direction, cells: &[(u16, u16)]) -> f64 {
        let maze = tolman_maze::read(text).unwrap().maze;
        let observer = IdealObserver {
            maze,
            has_compass,
            reach: 0,
            paint: Paint::default(),
        };
        let cells: Vec<Cell> = cells.iter().map(|(x, y)| Cell::new(*x, *y)).collect();
        observer.chance(way, &cells)
    }

    #[test]
    fn a_compass_tells_one_side_of_a_loop_from_another() {
        let north = [(1, 2), (2, 2)];
        let blind = chance(LOOP, false, Direction::East, &north[..1]);
        let known = chance(LOOP, true, Direction::East, &north[..1]);
        assert!(known > 0.99 && blind < known, "{blind} {known}");
        // Driving on to a bend that has another bend on its far side cannot reduce what is known.
        assert!(chance(LOOP, false, Direction::East, &north) >= blind);
    }

    #[test]
    fn a_landmark_tells_where_one_is() {
        let drive = [(1, 2), (1, 1), (0, 1)];
        assert!(chance(LOOP, false, Direction::South, &drive) > 0.99);
    }

    #[test]
    fn a_cell_that_is_passed_between_two_looks_is_no_riddle() {
        let whole = chance(LOOP, true, Direction::North, &[(3, 0), (3, 1), (3, 2)]);
        let jumped = chance(LOOP, true, Direction::North, &[(3, 0), (3, 2)]);
        assert!(jumped <= whole && jumped > 0.0);
    }
}
