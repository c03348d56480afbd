//! Shows what a mouse has learned as a map.

use tolman_maps::wall_map::ObserveError;
use tolman_maze::Cell;
use tolman_robot::{Guess, MapView, Mapper, Position, VisitNaming};

use super::maze_mouse::Stop;
use super::{CellSight, MazeMouse};
use crate::micromouse::Search;
use crate::micromouse::grid_map::{grid_map, place_of};

/// The map's places are the cells known to be open to some side, and the start; its links are the
/// openings.
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
        grid_map(&self.walls, &self.brief, |cell| self.config.middle(cell))
    }

    fn map_bytes(&self) -> Option<usize> {
        Some(self.walls.bytes())
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        let place = |stop: &Stop| Some(place_of(&self.brief, stop.cell?));
        self.stops.iter().map(place).collect()
    }

    fn visit_count(&self) -> usize {
        self.stops.len()
    }

    fn belief(&self) -> Vec<Guess> {
        let cells: Vec<Cell> = match &self.lost {
            Some(lost) => lost.poses.iter().map(|(cell, _)| cell).collect(),
            None => vec![self.at],
        };
        let guess = |cell: &Cell| Guess {
            at: Position::Place(place_of(&self.brief, *cell)),
            weight: 1.0 / cells.len() as f64,
        };
        cells.iter().map(guess).collect()
    }
}
