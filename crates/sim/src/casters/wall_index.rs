use core::ops::Range;

use tolman_geom::{Point, Vector};

use super::sweep::{Seen, Sweep, bearing};
use super::{Caster, Kernels, Lanes};
use crate::{Bounds, Wall};

/// All walls by place: a loose grid on several levels.
///
/// A wall lies in the one cell that holds its middle, on the level whose cells are just as large as
/// the wall, so it reaches at most half a cell beyond its own. A look at a neighbourhood takes, on each
/// level, the cells half a cell around it: no wall is found twice, and long walls cost no more memory
/// than short ones.
///
/// Built in O(n log n); a look costs as much as it finds plus a few cells on each level.
#[derive(Clone, Debug)]
pub struct WallIndex {
    levels: Vec<Level>,
    /// Sorted by level, row and column.
    walls: Vec<Wall>,
    /// The same walls for lanes.
    ends: Ends,
    bounds: Bounds,
    kernels: Kernels,
}

/// The coordinates of many walls' ends.
#[derive(Clone, Debug)]
struct Ends {
    start_x: Vec<f64>,
    start_y: Vec<f64>,
    end_x: Vec<f64>,
    end_y: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Level {
    corner: Point,
    /// Cells per metre.
    per_metre: f64,
    columns: usize,
    rows: usize,
    /// How far a wall of this level reaches from its middle, along either axis.
    reach: f64,
    /// Where each cell's walls start in the list of all; one more than there are cells.
    starts: Vec<u32>,
}

impl WallIndex {
    /// The index of `walls`, all of them finite.
    #[must_use]
    pub fn new(walls: &[Wall], lanes: Lanes) -> Self {
        let bounds = Bounds::of(walls.iter().flat_map(|wall| [wall.start, wall.end]));
        let count = walls.len().max(1) as f64;
        // Cells of the lowest level: about one per wall, and not more than that along either axis.
        let area = bounds.width() * bounds.height();
        let longest = bounds.width().max(bounds.height());
        let base = (area / count).sqrt().max(longest / count).max(1e-9);
        let level_of = |wall: &Wall| {
            let mut level = 0;
            let mut cell = base;
            while extent(wall) > cell {
                level += 1;
                cell *= 2.0;
            }
            level
        };
        let mut by_level: Vec<Vec<Wall>> = Vec::new();
        for wall in walls {
            let level: usize = level_of(wall);
            if by_level.len() <= level {
                by_level.resize(level + 1, Vec::new());
            }
            by_level[level].push(*wall);
        }
        let mut sorted = Vec::with_capacity(walls.len());
        let mut levels = Vec::new();
        let mut cell = base;
        for walls in by_level {
            if !walls.is_empty() {
                levels.push(Level::new(walls, cell, &mut sorted));
            }
            cell *= 2.0;
        }
        let ends = Ends {
            start_x: sorted.iter().map(|wall| wall.start.x).collect(),
            start_y: sorted.iter().map(|wall| wall.start.y).collect(),
            end_x: sorted.iter().map(|wall| wall.end.x).collect(),
            end_y: sorted.iter().map(|wall| wall.end.y).collect(),
        };
        Self {
            levels,
            walls: sorted,
            ends,
            bounds,
            kernels: lanes.into(),
        }
    }

    /// Calls `visit` with all walls that come within `reach` of `centre` along both axes, and some that
    /// do not, in slices.
    pub(crate) fn near<'a>(&'a self, centre: Point, reach: f64, mut visit: impl FnMut(&'a [Wall])) {
        self.places(centre, reach, |places| visit(&self.walls[places]));
    }

    /// Where such walls are in the list of all.
    #[inline(always)]
    fn places(&self, centre: Point, reach: f64, mut visit: impl FnMut(Range<usize>)) {
        for level in &self.levels {
            let reach = reach + level.reach;
            let (west, east) = span(
                centre.x - level.corner.x,
                reach,
                level.per_metre,
                level.columns,
            );
            let (south, north) = span(
                centre.y - level.corner.y,
                reach,
                level.per_metre,
                level.rows,
            );
            for row in south..north {
                let row = row * level.columns;
                let from = level.starts[row + west] as usize;
                let to = level.starts[row + east] as usize;
                if from < to {
                    visit(from..to);
                }
            }
        }
    }

    /// How far `point` is from the nearest wall, m; infinity if there are no walls.
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        if self.walls.is_empty() || !(point.x.is_finite() && point.y.is_finite()) {
            return f64::INFINITY;
        }
        // Nothing is nearer than the bounds.
        let outside = (self.bounds.min - point)
            .sup(&(point - self.bounds.max))
            .sup(&Vector::zeros());
        let mut reach = outside.norm() + self.levels[0].per_metre.recip();
        loop {
            let mut nearest = f64::INFINITY;
            self.near(point, reach, |walls| {
                nearest = walls
                    .iter()
                    .map(|wall| wall.distance(point))
                    .fold(nearest, f64::min);
            });
            // A wall beyond the reach may hide a nearer one that was not looked at.
            if nearest <= reach {
                return nearest;
            }
            reach *= 2.0;
        }
    }
}

impl Level {
    /// The level of `walls` with cells of this size; appends them to `sorted` in order of cells.
    fn new(walls: Vec<Wall>, cell: f64, sorted: &mut Vec<Wall>) -> Self {
        let middles = Bounds::of(walls.iter().map(middle));
        let columns = (middles.width() / cell) as usize + 1;
        let rows = (middles.height() / cell) as usize + 1;
        let cell_of = |wall: &Wall| {
            let from_corner = middle(wall) - middles.min;
            let column = ((from_corner.x / cell) as usize).min(columns - 1);
            let row = ((from_corner.y / cell) as usize).min(rows - 1);
            row * columns + column
        };
        let reach = walls
            .iter()
            .map(|wall| 0.5 * extent(wall))
            .fold(0.0, f64::max);
        let mut placed: Vec<(usize, Wall)> = walls
            .into_iter()
            .map(|wall| (cell_of(&wall), wall))
            .collect();
        placed.sort_by_key(|(cell, _)| *cell);
        let mut starts = Vec::with_capacity(columns * rows + 1);
        let mut placed = placed.into_iter().peekable();
        for cell in 0..columns * rows {
            starts.push(sorted.len() as u32);
            while let Some((_, wall)) = placed.next_if(|(at, _)| *at == cell) {
                sorted.push(wall);
            }
        }
        starts.push(sorted.len() as u32);
        Self {
            corner: middles.min,
            per_metre: cell.recip(),
            columns,
            rows,
            reach,
            starts,
        }
    }
}

fn extent(wall: &Wall) -> f64 {
    let along = wall.end - wall.start;
    along.x.abs().max(along.y.abs())
}

fn middle(wall: &Wall) -> Point {
    nalgebra::center(&wall.start, &wall.end)
}

/// The first and one past the last of `count` cells that lie within `reach` of `at`.
#[inline(always)]
fn span(at: f64, reach: f64, per_metre: f64, count: usize) -> (usize, usize) {
    // The last cell also holds what lies on the far edge of the level.
    let last = count as f64 - 1.0;
    let (from, to) = ((at - reach) * per_metre, (at + reach) * per_metre);
    if from > last + 1.0 || to < 0.0 {
        return (0, 0);
    }
    (
        from.clamp(0.0, last) as u32 as usize,
        to.clamp(0.0, last) as u32 as usize + 1,
    )
}

/// How many walls are looked at together.
const BLOCK: usize = 32;

/// A block of walls as seen from the origin of a sweep.
struct Block {
    right_x: [f64; BLOCK],
    right_y: [f64; BLOCK],
    left_x: [f64; BLOCK],
    left_y: [f64; BLOCK],
    area: [f64; BLOCK],
    /// The indices of the right and left ends among the beams.
    from: [f64; BLOCK],
    to: [f64; BLOCK],
    /// The square of the distance from the origin.
    square: [f64; BLOCK],
}

impl Caster for WallIndex {
    /// Looks along the ray piece by piece, so that a long one costs no more than what lies along it.
    fn cast(&self, origin: Point, direction: Vector, max_range: f64) -> f64 {
        let Some(lowest) = self.levels.first() else {
            return max_range;
        };
        let end = max_range.min(self.farthest(origin));
        let half_piece = 2.0 / lowest.per_metre;
        let mut range = max_range;
        let mut from = 0.0;
        while from <= end {
            let middle = origin + direction * (from + half_piece);
            self.near(middle, half_piece, |walls| {
                range = walls
                    .iter()
                    .map(|wall| wall.ray(origin, direction))
                    .fold(range, f64::min);
            });
            from += 2.0 * half_piece;
            // What was met beyond this piece may have something before it in the next.
            if range <= from {
                break;
            }
        }
        range
    }

    fn scan(&self, sweep: &mut Sweep) {
        self.kernels.run(
            #[inline(always)]
            || self.draw(sweep),
        );
    }
}

impl WallIndex {
    /// A range that reaches every wall from `origin`.
    fn farthest(&self, origin: Point) -> f64 {
        (self.bounds.min - origin)
            .abs()
            .sup(&(self.bounds.max - origin).abs())
            .norm()
    }

    #[inline(always)]
    fn draw(&self, sweep: &mut Sweep) {
        let max_range = sweep.ring().max_range;
        let nothing = [0.0; BLOCK];
        let mut block = Block {
            right_x: nothing,
            right_y: nothing,
            left_x: nothing,
            left_y: nothing,
            area: nothing,
            from: nothing,
            to: nothing,
            square: nothing,
        };
        let reach = max_range.min(self.farthest(sweep.origin));
        self.places(
            sweep.origin,
            reach,
            #[inline(always)]
            |places| {
                for from in places.clone().step_by(BLOCK) {
                    let places = from..places.end.min(from + BLOCK);
                    block.look(&self.ends, places.clone(), sweep);
                    for (index, place) in places.enumerate() {
                        if block.square[index] > max_range * max_range {
                            continue;
                        }
                        if block.area[index] > 0.0 {
                            let seen = block.seen(index);
                            sweep.meet_seen(&seen, block.from[index], block.to[index]);
                        } else {
                            sweep.meet_edge_on(&self.walls[place]);
                        }
                    }
                }
            },
        );
    }
}

impl Block {
    /// Looks at a block of walls, in lanes over walls.
    #[inline(always)]
    fn look(&mut self, ends: &Ends, places: Range<usize>, sweep: &Sweep) {
        let (x, y) = (sweep.origin.x, sweep.origin.y);
        let count = places.len().min(BLOCK);
        let start_x = &ends.start_x[places.clone()][..count];
        let start_y = &ends.start_y[places.clone()][..count];
        let end_x = &ends.end_x[places.clone()][..count];
        let end_y = &ends.end_y[places][..count];
        for index in 0..count {
            let start = Vector::new(start_x[index] - x, start_y[index] - y);
            let end = Vector::new(end_x[index] - x, end_y[index] - y);
            let along = end - start;
            let share =
                -(start.x * along.x + start.y * along.y) / (along.x * along.x + along.y * along.y);
            let share = if share > 0.0 { share } else { 0.0 };
            let share = if share < 1.0 { share } else { 1.0 };
            let (near_x, near_y) = (start.x + along.x * share, start.y + along.y * share);
            self.square[index] = near_x * near_x + near_y * near_y;
            let seen = Seen::new(start, end);
            self.right_x[index] = seen.right.x;
            self.right_y[index] = seen.right.y;
            self.left_x[index] = seen.left.x;
            self.left_y[index] = seen.left.y;
            self.area[index] = seen.area;
            self.from[index] = sweep.index(bearing(seen.right.x, seen.right.y));
            self.to[index] = sweep.index(bearing(seen.left.x, seen.left.y));
        }
    }

    #[inline(always)]
    fn seen(&self, index: usize) -> Seen {
        Seen {
            right: Vector::new(self.right_x[index], self.right_y[index]),
            left: Vector::new(self.left_x[index], self.left_y[index]),
            area: self.area[index],
        }
    }
}
