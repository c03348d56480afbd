use alloc::collections::BTreeMap;

use tolman_geom::{Point, Vector};
use tolman_maze::Cell;
use tolman_robot::{Guess, MapView, Position};

use super::whereabouts::{Squares, offset};

/// True positions of a learned map.
#[derive(Clone, Debug, Default)]
pub(super) struct Sites {
    /// Middle of the cell that each place stands for, m, by the place's id.
    places: BTreeMap<u32, Point>,
    /// Offset of the map's frame from the world's, m; `None` if its places have no positions.
    offset: Option<Vector>,
}

impl Sites {
    /// Returns the true positions of a map whose places stand for these cells.
    pub(super) fn of(map: &MapView, cells: BTreeMap<u32, Cell>, squares: Squares) -> Self {
        let placed = map.places.iter();
        let placed = placed.filter_map(|place| Some((place, *cells.get(&place.id)?)));
        let offset = offset(placed, squares);
        let places = cells.into_iter();
        let places = places.map(|(place, cell)| (place, squares.middle(cell)));
        Self {
            places: places.collect(),
            offset,
        }
    }

    /// Returns the true position of a place, m; `None` if it is unknown.
    pub(super) fn of_place(&self, place: u32) -> Option<Point> {
        self.places.get(&place).copied()
    }

    /// Returns the probability that a belief gives to positions nearer to `here` than `near`, m.
    pub(super) fn chance(&self, belief: &[Guess], here: Point, near: f64) -> f64 {
        let site = |at: Position| match at {
            Position::Place(place) => self.of_place(place),
            Position::Point(point) => self.offset.map(|offset| point + offset),
        };
        let is_near =
            |guess: &&Guess| site(guess.at).is_some_and(|site| (site - here).norm() < near);
        let guesses = belief.iter().filter(is_near);
        // Sums of rounded probabilities may exceed 1.
        let sum = guesses.fold(0.0, |sum, guess| sum + guess.weight);
        sum.min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use tolman_maze::Grid;
    use tolman_robot::MapPlace;

    use super::*;

    #[test]
    fn a_belief_counts_what_it_gives_to_where_the_robot_is() {
        let squares = Squares {
            grid: Grid::new(4, 4),
            pitch: 2.0,
            origin: Point::origin(),
        };
        let place = |id, x| MapPlace {
            id,
            position: Some(Point::new(x, 0.0)),
            landmark: None,
        };
        let map = MapView {
            places: vec![place(0, 0.0), place(1, 4.0)],
            links: Vec::new(),
            ..MapView::default()
        };
        let cells = BTreeMap::from([(0, Cell::new(1, 1)), (1, Cell::new(3, 1))]);
        let sites = Sites::of(&map, cells, squares);
        let here = Point::new(7.2, 3.1);
        let guess = |at, weight| Guess { at, weight };
        let belief = [
            guess(Position::Place(1), 0.5),
            guess(Position::Point(Point::new(4.1, 0.0)), 0.25),
            guess(Position::Place(0), 0.125),
            guess(Position::Place(9), 0.125),
        ];
        let chance = |here| sites.chance(&belief, here, 1.5);
        assert!((chance(here) - 0.75).abs() < 1e-12);
        assert!(chance(Point::origin()) < 1e-12);
    }
}
