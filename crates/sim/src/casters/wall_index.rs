use tolman_geom::{Point, Vector};
use tolman_robot::Ring;

use super::sweep::{Seen, Sweep, bearing};
use super::{Caster, Lanes};
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
    bounds: Bounds,
    lanes: Lanes,
}

#[derive(Clone, Debug)]
struct Level {
    corner: Point,
    cell: f64,
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
        Self {
            levels,
            walls: sorted,
            bounds,
            lanes,
        }
    }

    /// Calls `visit` with all walls that come within `reach` of `centre` along both axes, and some that
    /// do not, in slices.
    #[inline(always)]
    pub(crate) fn near<'a>(&'a self, centre: Point, reach: f64, mut visit: impl FnMut(&'a [Wall])) {
        for level in &self.levels {
            let reach = reach + level.reach;
            let (Some((west, east)), Some((south, north))) = (
                span(centre.x - level.corner.x, reach, level.cell, level.columns),
                span(centre.y - level.corner.y, reach, level.cell, level.rows),
            ) else {
                continue;
            };
            for row in south..=north {
                let from = level.starts[row * level.columns + west] as usize;
                let to = level.starts[row * level.columns + east + 1] as usize;
                if from < to {
                    visit(&self.walls[from..to]);
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
        let mut reach = outside.norm() + self.levels[0].cell;
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
            cell,
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

/// The first and last of `count` cells that lie within `reach` of `at`, if any does.
#[inline(always)]
fn span(at: f64, reach: f64, cell: f64, count: usize) -> Option<(usize, usize)> {
    // The last cell also holds what lies on the far edge of the level.
    let (first, last) = ((at - reach) / cell, (at + reach) / cell);
    (first <= count as f64 && last >= 0.0).then(|| {
        (
            (first.max(0.0) as usize).min(count - 1),
            (last as usize).min(count - 1),
        )
    })
}

/// How many walls are looked at together.
const BLOCK: usize = 32;

/// A block of walls as seen from the origin of a sweep.
struct Block {
    seen: [Seen; BLOCK],
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
        let half_piece = 2.0 * lowest.cell;
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
        self.lanes.run(
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
        let Ring { max_range, .. } = sweep.ring();
        let origin = sweep.origin();
        let nothing = Seen {
            right: Vector::zeros(),
            left: Vector::zeros(),
            area: 0.0,
        };
        let mut block = Block {
            seen: [nothing; BLOCK],
            from: [0.0; BLOCK],
            to: [0.0; BLOCK],
            square: [0.0; BLOCK],
        };
        self.near(origin, max_range.min(self.farthest(origin)), |walls| {
            for walls in walls.chunks(BLOCK) {
                for (index, wall) in walls.iter().enumerate() {
                    let (start, end) = (wall.start - origin, wall.end - origin);
                    let along = end - start;
                    let share = (-start.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                    let seen = Seen::new(start, end);
                    block.square[index] = (start + along * share).norm_squared();
                    block.from[index] = sweep.index(bearing(seen.right.x, seen.right.y));
                    block.to[index] = sweep.index(bearing(seen.left.x, seen.left.y));
                    block.seen[index] = seen;
                }
                for (index, wall) in walls.iter().enumerate() {
                    if block.square[index] > max_range * max_range {
                        continue;
                    }
                    let seen = &block.seen[index];
                    if seen.area > 0.0 {
                        sweep.meet_seen(seen, block.from[index], block.to[index]);
                    } else {
                        sweep.meet_edge_on(wall);
                    }
                }
            }
        });
    }
}
