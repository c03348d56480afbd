use alloc::vec::Vec;
use core::f64::consts::TAU;

use tolman_geom::{Point, Vector, floor_index};

use super::GroundKind;
use super::WallGrid;
use super::skeleton::by;
use super::wall_grid::{GridIndex, middle};

/// Rectangles about as wide as corridors, on whose lines the walls' faces of a neighbourhood lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Squares {
    /// Corner of the square [0, 0].
    corner: Point,
    /// Sides of a square, m.
    sides: Vector,
}

/// Distance around points within which walls count, in corridor widths.
const AROUND: f64 = 1.5;
/// Cells that share a side with a cell.
const BESIDE: [GridIndex; 4] = [[1, 0], [-1, 0], [0, 1], [0, -1]];
/// Minimum share of the walls' faces that lie on lines of one direction. Where corridors lie on a
/// grid it is about a half.
const ON_LINES: f64 = 0.15;
/// Number of pitches above and below the corridors' width that are tried. Odometry with a constant
/// error stretches the map.
const PITCHES: i32 = 10;
/// Difference of two pitches that are tried, in corridor widths.
const PITCH_STEP: f64 = 0.01;
/// Share of faces that a pitch has to have more than the corridors' width, for each width that it
/// differs. Without it, odd faces decide where the map is not stretched.
const MORE_FACES: f64 = 0.5;

impl Squares {
    /// Returns the squares on whose lines most faces of the walls around a box lie; `None` if they
    /// lie on no such lines. O(cells of the grid + faces · pitches).
    pub(super) fn of(grid: &WallGrid, [low, high]: [Point; 2], width: f64) -> Option<Self> {
        let (amid, reach) = (low + 0.5 * (high - low), Vector::repeat(AROUND * width));
        let (low, high) = (low - reach, high + reach);
        let is = |index, kind| grid.ground(index) == kind;
        let faces = grid.indices().filter(|index| {
            let mut beside = BESIDE.iter().map(|offset| by(*index, *offset));
            is(*index, GroundKind::Wall) && beside.any(|beside| is(beside, GroundKind::Floor))
        });
        let around = faces
            .map(middle)
            .filter(|at| *at == at.sup(&low).inf(&high));
        let faces: Vec<Vector> = around.map(|at| at - amid).collect();
        let lines = [0, 1].map(|axis| Lines::of(faces.iter().map(|face| face[axis]), width));
        let [x, y] = lines;
        (x.share.min(y.share) > ON_LINES).then(|| Self {
            corner: amid + Vector::new(x.first, y.first),
            sides: Vector::new(x.pitch, y.pitch),
        })
    }

    /// Returns the square that holds a point; `None` if it is less than `border` of a side from the
    /// square's edge.
    pub(super) fn inside(&self, at: Point, border: f64) -> Option<[i32; 2]> {
        let at = (at - self.corner).component_div(&self.sides);
        let square = [at.x, at.y].map(floor_index);
        let off = |axis: usize| (at[axis] - f64::from(square[axis]) - 0.5).abs();
        (off(0).max(off(1)) <= 0.5 - border).then_some(square)
    }

    /// Returns the middle of a square.
    pub(super) fn middle(&self, [column, row]: [i32; 2]) -> Point {
        let middle = Vector::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
        self.corner + middle.component_mul(&self.sides)
    }
}

/// Parallel lines across an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lines {
    pitch: f64,
    /// One of the lines, m along the axis.
    first: f64,
    /// Share of the faces that lie on the lines, 0 to 1.
    share: f64,
}

impl Lines {
    /// Returns the lines about `width` m apart on which most faces lie. O(faces · pitches).
    fn of(faces: impl Iterator<Item = f64> + Clone, width: f64) -> Self {
        let tried = (-PITCHES..=PITCHES).map(|off| {
            let off = PITCH_STEP * f64::from(off);
            let lines = Self::with_pitch(faces.clone(), width * (1.0 + off));
            (lines.share - MORE_FACES * off.abs(), lines)
        });
        let best = tried.max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or_else(|| Self::with_pitch(faces, width), |(_, lines)| lines)
    }

    /// Returns the lines on which most faces lie. A face on a line has the line's phase, and faces
    /// across the lines have all phases, which cancel out. O(faces).
    fn with_pitch(faces: impl Iterator<Item = f64>, pitch: f64) -> Self {
        let [mut sine, mut cosine, mut count] = [0.0; 3];
        for face in faces {
            let (sin, cos) = libm::sincos(TAU * face / pitch);
            sine += sin;
            cosine += cos;
            count += 1.0;
        }
        Self {
            pitch,
            first: libm::atan2(sine, cosine) / TAU * pitch,
            share: libm::hypot(sine, cosine) / f64::max(count, 1.0),
        }
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
        fn squares_lie_between_walls(first in [0..CELLS, 0..CELLS], open in prop::collection::vec(0..36, 0..3)) {
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

    /// Odometry that errs by 5 % along each axis draws squares of 21 × 19 cells.
    #[test]
    fn stretched_squares_are_found() {
        let side = 6 * CELLS;
        let lines = |index: GridIndex| index[0] % 21 == 3 || index[1] % 19 == 7;
        let is_open = |[x, y]: GridIndex| x > 50 && x < 68 && y > 27 && y < 44;
        let grid = WallGrid::of([[0, 0], [side, side]], |index| {
            match lines(index) && !is_open(index) {
                true => GroundKind::Wall,
                false => GroundKind::Floor,
            }
        });
        let box_of = [middle([40, 40]), middle([80, 80])];
        let found = Squares::of(&grid, box_of, WIDTH).unwrap();
        for (column, row) in [(1, 1), (2, 2), (3, 3)] {
            let at = middle([13 + 21 * column, 17 + 19 * row]);
            let square = found.inside(at, 0.4).unwrap();
            assert!(
                (found.middle(square) - at).norm() < 1.5 * WallGrid::CELL,
                "{found:?}"
            );
        }
    }

    #[test]
    fn slanted_walls_have_no_squares() {
        assert_eq!(squares(|[x, y]| (x + y).rem_euclid(2 * CELLS) == 0), None);
        assert_eq!(squares(|[x, _]| on_line(x, 3)), None);
        assert_eq!(squares(|_| false), None);
    }
}
