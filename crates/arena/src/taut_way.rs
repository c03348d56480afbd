//! Shortest ways of a point over any floor.

use alloc::collections::{BTreeMap, BinaryHeap};
use core::cmp::Reverse;

use tolman_geom::Point;

type Cell = (i32, i32);

/// Lengths of a step to the next cell, straight and diagonally, in tenths of a cell.
const STEPS: [u32; 2] = [10, 14];

/// Returns the corners of a shortest way from a position over the floor, with its ends, as a taut
/// string has them. `None` if there is no way.
///
/// The way is searched on a grid of cells with sides of `pitch` m, and then pulled taut.
/// `is_floor` tells the floor. `left` estimates how far it still is to the goal, m: 0 there, and
/// nowhere more than it is. O(cells · log cells).
///
/// ```
/// use tolman_arena::taut_way;
/// use tolman_geom::Point;
///
/// // Round a wall that ends at (1, 1).
/// let is_floor = |at: Point| at.y.abs() < 2.0 && ((at.x - 1.0).abs() > 0.1 || at.y > 1.0);
/// let goal = Point::new(2.0, 0.0);
/// let left = |at: Point| if (at - goal).norm() < 0.1 { 0.0 } else { (at - goal).norm() };
/// let way = taut_way(Point::new(0.0, 0.0), 0.1, is_floor, left).unwrap();
/// let length: f64 = way.windows(2).map(|piece| (piece[1] - piece[0]).norm()).sum();
/// assert!((length - 2.0 * f64::hypot(1.0, 1.0)).abs() < 0.2);
/// ```
pub fn taut_way(
    from: Point,
    pitch: f64,
    is_floor: impl Fn(Point) -> bool,
    left: impl Fn(Point) -> f64,
) -> Option<Vec<Point>> {
    let grid = FineGrid { pitch };
    let middles = grid.way(grid.cell(from), &is_floor, &left)?;
    let way: Vec<Point> = [from]
        .into_iter()
        .chain(middles.into_iter().skip(1))
        .collect();
    let mut corners = vec![from];
    let mut at = 0;
    while at + 1 < way.len() {
        let mut beyond = (at + 2..way.len()).rev();
        at = (beyond.find(|to| grid.is_clear(way[at], way[*to], &is_floor))).unwrap_or(at + 1);
        corners.push(way[at]);
    }
    Some(corners)
}

/// Returns whether the straight line between two positions lies on the floor, as far as positions
/// half of `pitch` m apart tell.
pub fn is_clear(a: Point, b: Point, pitch: f64, is_floor: impl Fn(Point) -> bool) -> bool {
    FineGrid { pitch }.is_clear(a, b, &is_floor)
}

struct FineGrid {
    pitch: f64,
}

impl FineGrid {
    fn cell(&self, at: Point) -> Cell {
        let along = |metres: f64| libm::floor(metres / self.pitch) as i32;
        (along(at.x), along(at.y))
    }

    fn middle(&self, (x, y): Cell) -> Point {
        let along = |cell: i32| (f64::from(cell) + 0.5) * self.pitch;
        Point::new(along(x), along(y))
    }

    fn is_clear(&self, a: Point, b: Point, is_floor: &impl Fn(Point) -> bool) -> bool {
        let pieces = libm::ceil((b - a).norm() / (0.5 * self.pitch)).max(1.0);
        (0..=pieces as u32).all(|piece| is_floor(a + (f64::from(piece) / pieces) * (b - a)))
    }

    /// Returns the middles of the cells of a shortest way.
    fn way(
        &self,
        from: Cell,
        is_floor: &impl Fn(Point) -> bool,
        left: &impl Fn(Point) -> f64,
    ) -> Option<Vec<Point>> {
        let estimated = |cell| (10.0 * left(self.middle(cell)) / self.pitch) as u32;
        let mut before: BTreeMap<Cell, (u32, Cell)> = BTreeMap::from([(from, (0, from))]);
        let mut open = BinaryHeap::from([Reverse((estimated(from), 0, from))]);
        while let Some(Reverse((_, gone, cell))) = open.pop() {
            if left(self.middle(cell)) <= 0.0 {
                let mut way = vec![self.middle(cell)];
                let mut at = cell;
                while let Some((_, earlier)) = before.get(&at).filter(|(_, earlier)| *earlier != at)
                {
                    at = *earlier;
                    way.push(self.middle(at));
                }
                way.reverse();
                return Some(way);
            }
            if before.get(&cell).is_some_and(|(best, _)| *best < gone) {
                continue;
            }
            for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                let next = (cell.0 + dx, cell.1 + dy);
                let gone = gone + STEPS[usize::from(dx != 0 && dy != 0)];
                let is_better = before.get(&next).is_none_or(|(best, _)| gone < *best);
                if is_better && is_floor(self.middle(next)) {
                    before.insert(next, (gone, cell));
                    open.push(Reverse((gone + estimated(next), gone, next)));
                }
            }
        }
        None
    }
}
