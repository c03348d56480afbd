//! What a mouse has learned.

use tolman_maps::wall_map::ObserveError;
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_robot::{Guess, Landmark, MapLink, MapPlace, MapView, Mapper, Position};

use super::{CellSight, MazeMouse};
use crate::micromouse::Search;

/// Places are the cells known to be open to some side, and the start; links are the openings.
impl<S: Search> Mapper for MazeMouse<S> {
    type Observation = CellSight;
    type Error = ObserveError;

    fn observe(&mut self, seen: &CellSight) -> Result<(), ObserveError> {
        self.walls.observe(seen.cell, &seen.rays)?;
        if seen.cell != self.at {
            self.at = seen.cell;
            self.walls.visit(seen.cell);
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        let mut map = MapView::default();
        for cell in self.brief.grid.cells() {
            let links = map.links.len();
            let from = self.id(cell);
            map.links
                .extend(self.open_sides(cell).map(|beside| MapLink {
                    from,
                    to: self.id(beside),
                }));
            if map.links.len() > links || cell == self.brief.start {
                map.places.push(self.place(cell));
            }
        }
        map
    }

    fn map_bytes(&self) -> Option<usize> {
        Some(self.walls.bytes())
    }

    fn belief(&self) -> Vec<Guess> {
        let cells: Vec<Cell> = match &self.lost {
            Some(lost) => lost.poses.iter().map(|(cell, _)| cell).collect(),
            None => vec![self.at],
        };
        let guess = |cell: &Cell| Guess {
            at: Position::Place(self.id(*cell)),
            weight: 1.0 / cells.len() as f64,
        };
        cells.iter().map(guess).collect()
    }
}

impl<S: Search> MazeMouse<S> {
    fn id(&self, cell: Cell) -> u32 {
        self.brief.grid.index(cell) as u32
    }

    /// Returns what lies beyond the sides of a cell that are known to be open.
    fn open_sides(&self, cell: Cell) -> impl Iterator<Item = Cell> {
        let open = move |side| self.walls.knowledge(cell, side) == Knowledge::Open;
        let sides = Direction::ALL.into_iter().filter(move |side| open(*side));
        sides.filter_map(move |side| self.brief.grid.neighbour(cell, side))
    }

    fn place(&self, cell: Cell) -> MapPlace {
        let landmark = if cell == self.brief.start {
            Some(Landmark::Start)
        } else {
            let is_goal = self.brief.goals.contains(&cell);
            is_goal.then_some(Landmark::Goal)
        };
        MapPlace {
            id: self.id(cell),
            position: Some(self.config.middle(cell)),
            landmark,
        }
    }
}
