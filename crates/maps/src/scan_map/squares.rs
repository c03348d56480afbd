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
