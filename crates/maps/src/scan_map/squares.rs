use core::f64::consts::TAU;

use tolman_geom::{Point, Vector, floor_index};

use super::GroundKind;
use super::WallGrid;
use super::skeleton::by;
use super::wall_grid::{GridIndex, middle};

/// Squares as wide as corridors, on whose lines the walls' faces of a neighbourhood lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Squares {
    /// Corner of the square [0, 0].
    corner: Point,
    width: f64,
}

/// Distance around points within which walls count, in corridor widths.
const AROUND: f64 = 1.5;
/// Cells that share a side with a cell.
const BESIDE: [GridIndex; 4] = [[1, 0], [-1, 0], [0, 1], [0, -1]];
/// Minimum share of the walls' faces that lie on lines of one direction. Where corridors lie on a
/// grid it is about a half.
const ON_LINES: f64 = 0.15;

impl Squares {
    /// Returns the squares on whose lines the faces of the walls around a box lie; `None` if they
    /// lie on no such lines. O(cells of the grid).
    ///
    /// A face along a line has one phase of the width, and a face across it has all of them, which
    /// cancel out.
    pub(super) fn of(grid: &WallGrid, [low, high]: [Point; 2], width: f64) -> Option<Self> {
        let reach = Vector::repeat(AROUND * width);
        let (low, high) = (low - reach, high + reach);
        let is = |index, kind| grid.ground(index) == kind;
        let faces = grid.indices().filter(|index| {
            let mut beside = BESIDE.iter().map(|offset| by(*index, *offset));
            is(*index, GroundKind::Wall) && beside.any(|beside| is(beside, GroundKind::Floor))
        });
        let faces = faces.map(middle);
        let around = faces.filter(|at| *at == at.sup(&low).inf(&high));
        let (mut sums, mut count) = ([[0.0; 2]; 2], 0.0);
        for face in around {
            for (axis, [sine, cosine]) in sums.iter_mut().enumerate() {
                let (sin, cos) = libm::sincos(TAU * face[axis] / width);
                *sine += sin;
                *cosine += cos;
            }
            count += 1.0;
        }
        let is_on_lines =
            |[sine, cosine]: &[f64; 2]| libm::hypot(*sine, *cosine) > ON_LINES * count;
        let phase = |[sine, cosine]: [f64; 2]| libm::atan2(sine, cosine) / TAU * width;
        let [x, y] = sums;
        sums.iter().all(is_on_lines).then(|| Self {
            corner: Point::new(phase(x), phase(y)),
            width,
        })
    }

    /// Returns the square that holds a point; `None` if it is less than `border` corridor widths
    /// from the square's edge.
    pub(super) fn inside(&self, at: Point, border: f64) -> Option<[i32; 2]> {
        let at = (at - self.corner) / self.width;
        let square = [at.x, at.y].map(floor_index);
        let off = |axis: usize| (at[axis] - f64::from(square[axis]) - 0.5).abs();
        (off(0).max(off(1)) <= 0.5 - border).then_some(square)
    }

    /// Returns the middle of a square.
    pub(super) fn middle(&self, [column, row]: [i32; 2]) -> Point {
        let middle = Vector::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
        self.corner + middle * self.width
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Number of cells in a square.
    const CELLS: i32 = 20;
    const WIDTH: f64 = CELLS as f64 * WallGrid::CELL;

    /// Returns the squares of a piece of ground with walls where `is_wall` says.
    fn squares(is_wall: impl Fn(GridIndex) -> bool) -> Option<Squares> {
        let side = 6 * CELLS;
        let grid = WallGrid::of([[0, 0], [side, side]], |index| match is_wall(index) {
            true => GroundKind::Wall,
            false => GroundKind::Floor,
        });
        let middle = middle([side / 2, side / 2]);
        Squares::of(&grid, [middle, middle], WIDTH)
    }

    /// Returns whether a cell stands on a line, counted from `first`.
    fn on_line(along: i32, first: i32) -> bool {
        (along - first).rem_euclid(CELLS) == 0
    }

    proptest! {
        #[test]
        fn squares_lie_between_walls(first in [0..CELLS, 0..CELLS], open in prop::collection::vec(0..36, 0..6)) {
            // Of the walls of some squares, the lower and the left one are missing.
            let is_open = |[x, y]: GridIndex| {
                let [column, row] = [(x - first[0]).div_euclid(CELLS), (y - first[1]).div_euclid(CELLS)];
                open.contains(&(column + 6 * row))
            };
            let found = squares(|at| {
                (on_line(at[0], first[0]) || on_line(at[1], first[1])) && !is_open(at)
            });
            let found = found.unwrap();
            let inside = [0, 1].map(|axis| first[axis] + CELLS / 2 + CELLS * 2);
            let square = found.inside(middle(inside), 0.4).unwrap();
            prop_assert!((found.middle(square) - middle(inside)).norm() < WallGrid::CELL);
            let edge = [first[0] + CELLS * 2 + 1, inside[1]];
            prop_assert_eq!(found.inside(middle(edge), 0.1), None);
            let next = [inside[0] + CELLS, inside[1] - CELLS];
            let [column, row] = square;
            prop_assert_eq!(found.inside(middle(next), 0.4), Some([column + 1, row - 1]));
        }
    }

    #[test]
    fn slanted_walls_have_no_squares() {
        assert_eq!(squares(|[x, y]| (x + y).rem_euclid(2 * CELLS) == 0), None);
        assert_eq!(squares(|[x, _]| on_line(x, 3)), None);
        assert_eq!(squares(|_| false), None);
    }
}
