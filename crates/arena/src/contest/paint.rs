use alloc::collections::BTreeMap;
use core::f64::consts::TAU;

use tolman_geom::{Point, Vector};
use tolman_maze::Cell;
use tolman_sim::World;

use crate::course::Course;

/// Colours of the walls around the middle of each cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Paint(BTreeMap<Cell, Vec<[u8; 3]>>);

/// Number of colours seen in a quarter turn.
const A_QUARTER: usize = 18;

impl Paint {
    /// Returns the colours seen from each cell that can be reached. O(cells · walls).
    pub(super) fn of(course: &Course) -> Self {
        let cells = course.maze.reachable();
        let seen = |cell| (cell, around(&course.world, course.cell_centre(cell)));
        Self(cells.map(seen).collect())
    }

    /// Returns the colours around a cell, clockwise from `quarters` quarter turns clockwise of
    /// north; empty if colours are not recorded.
    pub(super) fn seen(&self, cell: Cell, quarters: usize) -> impl Iterator<Item = [u8; 3]> + '_ {
        let colours = self.0.get(&cell).map_or(&[][..], Vec::as_slice);
        let turned = colours.iter().cycle().skip(quarters * A_QUARTER);
        turned.take(colours.len()).copied()
    }
}

/// Returns the colours of the walls that rays meet. The rays are evenly spread over the full
/// circle, clockwise from north.
fn around(world: &World, here: Point) -> Vec<[u8; 3]> {
    let rays = (0..4 * A_QUARTER).map(|ray| {
        let bearing = (ray as f64 + 0.5) / (4 * A_QUARTER) as f64 * TAU;
        let (east, north) = libm::sincos(bearing);
        Vector::new(east, north)
    });
    rays.filter_map(|ray| colour(world, here, ray)).collect()
}

fn colour(world: &World, here: Point, ray: Vector) -> Option<[u8; 3]> {
    let walls = world.walls().iter();
    let met = walls.map(|wall| (wall.ray(here, ray), wall.material.colour));
    let nearest = met.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, colour)| colour)
}

#[cfg(test)]
mod tests {
    use tolman_maze::Direction;

    use super::*;
    use crate::diktiometry::{Office, OfficeConfig};

    /// Returns a maze with a cell whose way leads north; east of the next cell there is another
    /// way.
    const BEND: &str = "\
o---o---o
|     G |
o   o---o
| S |   |
o---o---o
";

    fn paint(colours: u32, seed: u64) -> (Paint, [Cell; 3]) {
        let maze = tolman_maze::parse(BEND).unwrap().maze;
        let furniture = OfficeConfig {
            colours,
            seed,
            ..OfficeConfig::bare()
        };
        let office = Office::new(&maze, &furniture).unwrap();
        let start = Cell::new(0, 0);
        let bend = maze.beside(start, Direction::North).unwrap();
        let end = maze.beside(bend, Direction::East).unwrap();
        (Paint::of(&office.course), [start, bend, end])
    }

    #[test]
    fn walls_of_many_colours_tell_cells_apart_and_those_of_one_do_not() {
        let seen = |paint: &Paint, cell| paint.seen(cell, 0).collect::<Vec<_>>();
        let (painted, cells) = paint(8, 1);
        let (plain, _) = paint(1, 1);
        for (one, other) in [(0, 1), (1, 2), (0, 2)] {
            let [one, other] = [cells[one], cells[other]];
            assert_ne!(seen(&painted, one), seen(&painted, other));
            assert_eq!(seen(&plain, one), seen(&plain, other));
        }
    }

    #[test]
    fn who_is_turned_sees_the_same_colours_from_another_side_on() {
        let (paint, [start, ..]) = paint(8, 2);
        let seen: Vec<_> = paint.seen(start, 0).collect();
        let turned: Vec<_> = paint.seen(start, 1).collect();
        assert_eq!(turned[..3 * A_QUARTER], seen[A_QUARTER..]);
        assert_eq!(turned[3 * A_QUARTER..], seen[..A_QUARTER]);
    }
}
