use alloc::collections::{BTreeMap, BTreeSet};

use tolman_maze::{Cell, Direction, Maze};

use super::floor_graph::FloorGraph;
use super::whereabouts::Squares;
use crate::course::Course;

/// The cells that are one place.
///
/// In corridors each cell is a spot of its own. Where four cells around a post without a wall are
/// open to each other, they and all that overlap them are a room, with the cells that lead only
/// from it back into it. A room is one spot. In a free world the
/// spots are those of its [`FloorGraph`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Spots {
    /// The cell that stands for each cell of a spot with more than one.
    spots: BTreeMap<Cell, Cell>,
}

impl Spots {
    /// Returns the spots of a course. O(cells · rooms).
    pub(super) fn of(course: &Course) -> Self {
        match FloorGraph::of_course(course) {
            Some(floor) => Self::of_floor(&floor, Squares::of(course)),
            None => Self::of_maze(&course.maze),
        }
    }

    /// Returns the spots of a floor that squares pave. O(squares).
    pub(super) fn of_floor(floor: &FloorGraph, squares: Squares) -> Self {
        let spots = squares.grid.cells().filter_map(|cell| {
            let spot = floor.spot_at(squares.middle(cell))?;
            Some((cell, squares.cell_at(floor.middle(spot))))
        });
        Self {
            spots: spots.collect(),
        }
    }

    /// Returns the spots of a drawing. O(cells · rooms).
    pub(super) fn of_maze(maze: &Maze) -> Self {
        let mut rooms: BTreeMap<Cell, Cell> = BTreeMap::new();
        let corners = maze.grid().cells().filter(|cell| maze.is_room(*cell));
        let square = |corner: Cell| {
            let north = maze.beside(corner, Direction::North);
            let east = maze.beside(corner, Direction::East);
            let across = north.and_then(|north| maze.beside(north, Direction::East));
            [Some(corner), north, east, across].into_iter().flatten()
        };
        for corner in corners {
            let new: Vec<Cell> = square(corner).collect();
            // A square that overlaps several rooms joins them.
            let overlapped: BTreeSet<Cell> = new
                .iter()
                .filter_map(|cell| rooms.get(cell).copied())
                .collect();
            let first = overlapped.first().copied().unwrap_or(corner);
            for room in rooms.values_mut().filter(|room| overlapped.contains(room)) {
                *room = first;
            }
            rooms.extend(new.into_iter().map(|cell| (cell, first)));
        }
        // A cell that leads from a room only back into it belongs to the room.
        let room = |cell: Cell| rooms.get(&cell).copied();
        let gaps = maze.grid().cells().filter(|cell| room(*cell).is_none());
        let gaps: Vec<(Cell, Cell)> = gaps
            .filter_map(|cell| {
                let beside: Vec<Option<Cell>> =
                    maze.neighbours(cell).map(|(_, next)| room(next)).collect();
                let first = beside.first().copied().flatten()?;
                let is_gap = beside.len() > 1 && beside.iter().all(|room| *room == Some(first));
                is_gap.then_some((cell, first))
            })
            .collect();
        rooms.extend(gaps);
        Self { spots: rooms }
    }

    /// Returns the cell that stands for the spot of a cell.
    pub(super) fn at(&self, cell: Cell) -> Cell {
        self.spots.get(&cell).copied().unwrap_or(cell)
    }

    /// Returns whether a cell shares its spot with others.
    pub(super) fn is_shared(&self, cell: Cell) -> bool {
        self.spots.contains_key(&cell)
    }
}
