use core::ops::Range;

use tolman_geom::{Point, Vector};

use super::beam_sweep::{BeamSweep, LANES, Order, Seen, bearing};
use super::{Caster, Kernels, Lanes};
use crate::{Bounds, WallSegment};

/// All walls by place: a loose grid on several levels.
///
/// A wall lies in the one cell that holds its middle, on the level whose cells are about half as
/// large as the wall. So it reaches at most a cell beyond its own. A search of a neighbourhood
/// takes, on each level, the cells around it up to that distance. No wall is found twice, and long
/// walls cost no more memory than short ones.
///
/// Building it takes O(n log n). A search costs as much as it finds plus a few cells on each level.
#[derive(Clone, Debug)]
pub struct WallIndex {
    levels: Vec<Level>,
    /// Sorted by level, row and column.
    walls: Vec<WallSegment>,
    /// Walls in the form for scans.
    traces: Vec<Trace>,
    bounds: Bounds,
    kernels: Kernels,
}

/// A wall without its material.
#[derive(Clone, Copy, Debug)]
struct Trace {
    start: Point,
    end: Point,
    /// 1 over the square of the wall's length, 1/m².
    per_square: f64,
}

#[derive(Clone, Debug)]
struct Level {
    corner: Point,
    /// Size of a cell, m.
    cell: f64,
    /// Cells per metre.
    per_metre: f64,
    columns: usize,
    rows: usize,
    /// Maximum distance from the middle of a wall of this level to its end, along either axis, with
    /// a margin for rounding.
    reach: f64,
    /// Index of each cell's first wall in the list of all; one more than there are cells.
    starts: Vec<u32>,
}

impl WallIndex {
    /// Returns the index of `walls`, all of them finite.
    #[must_use]
    pub fn new(walls: &[WallSegment], lanes: Lanes) -> Self {
        let bounds = Bounds::of(walls.iter().flat_map(|wall| [wall.start, wall.end]));
        let count = walls.len().max(1) as f64;
        // On the lowest level: most walls, but no more of them to a cell than one on average.
        let mut extents: Vec<f64> = walls.iter().map(extent).collect();
        extents.sort_by(f64::total_cmp);
        let most = 1.25 * extents.get(walls.len() * 9 / 10).copied().unwrap_or(0.0);
        let area = bounds.width() * bounds.height();
        let longest = bounds.width().max(bounds.height());
        let base = (area / count)
            .sqrt()
            .max(longest / count)
            .max(most)
            .max(1e-9);
        let (mut levels, mut sorted) = (Vec::new(), Vec::with_capacity(walls.len()));
        let (mut rest, mut cell) = (walls.to_vec(), base);
        while !rest.is_empty() {
            let (larger, fitting): (Vec<WallSegment>, _) =
                rest.into_iter().partition(|wall| extent(wall) > cell);
            if !fitting.is_empty() {
                levels.push(Level::new(fitting, cell, &mut sorted));
            }
            rest = larger;
            cell *= 2.0;
        }
        let trace = |wall: &WallSegment| Trace {
            start: wall.start,
            end: wall.end,
            per_square: (wall.end - wall.start).norm_squared().recip(),
        };
        let traces = sorted.iter().map(trace).collect();
        Self {
            levels,
            walls: sorted,
            traces,
            bounds,
            kernels: lanes.into(),
        }
    }

    /// Calls `visit` with slices of walls that contain all within `reach` of `centre`, m, and some
    /// others.
    pub(crate) fn near<'a>(
        &'a self,
        centre: Point,
        reach: f64,
        mut visit: impl FnMut(&'a [WallSegment]),
    ) {
        self.places(centre, reach, |places| visit(&self.walls[places]));
    }

    /// Visits the index ranges of such walls in the list of all.
    #[inline(always)]
    fn places(&self, centre: Point, reach: f64, mut visit: impl FnMut(Range<usize>)) {
        for level in &self.levels {
            let (x, y) = (centre.x - level.corner.x, centre.y - level.corner.y);
            let (south, north) = span(y, reach + level.reach, level.per_metre, level.rows);
            for row in south..north {
                // How far the middles of this row's walls are from the centre at least.
                let from_row = (row as f64 * level.cell - y).max(y - (row + 1) as f64 * level.cell);
                let beyond = (from_row - level.reach).max(0.0);
                let aside = (reach * reach - beyond * beyond).max(0.0).sqrt() + level.reach;
                let (west, east) = span(x, aside, level.per_metre, level.columns);
                let row = row * level.columns;
                let from = level.starts[row + west] as usize;
                let to = level.starts[row + east] as usize;
                if from < to {
                    visit(from..to);
                }
            }
        }
    }

    /// Returns the distance of `point` from the nearest wall, m; infinity if there are no walls.
    #[must_use]
    pub fn distance(&self, point: Point) -> f64 {
        if self.walls.is_empty() || !(point.x.is_finite() && point.y.is_finite()) {
            return f64::INFINITY;
        }
        let mut reach = self.clearance(point) + self.levels[0].cell;
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
    /// Returns the level of `walls` that extend no further than `largest`; appends them to `sorted`
    /// in order of cells.
    fn new(mut walls: Vec<WallSegment>, largest: f64, sorted: &mut Vec<WallSegment>) -> Self {
        let cell = 0.5 * largest;
        let middles = Bounds::of(walls.iter().map(middle));
        let columns = (middles.width() / cell) as usize + 1;
        let rows = (middles.height() / cell) as usize + 1;
        let cell_of = |wall: &WallSegment| {
            let from_corner = middle(wall) - middles.min;
            let column = ((from_corner.x / cell) as usize).min(columns - 1);
            let row = ((from_corner.y / cell) as usize).min(rows - 1);
            row * columns + column
        };
        let reach = walls.iter().map(extent).fold(0.0, f64::max) * (0.5 + 1e-9) + 1e-9;
        walls.sort_by_key(cell_of);
        let before = sorted.len();
        let start = |cell| before + walls.partition_point(|wall| cell_of(wall) < cell);
        let starts = (0..=columns * rows)
            .map(|cell| start(cell) as u32)
            .collect();
        sorted.extend(walls);
        Self {
            corner: middles.min,
            cell,
            per_metre: cell.recip(),
            columns,
            rows,
            reach,
            starts,
        }
    }
}

fn extent(wall: &WallSegment) -> f64 {
    let along = wall.end - wall.start;
    along.x.abs().max(along.y.abs())
}

fn middle(wall: &WallSegment) -> Point {
    nalgebra::center(&wall.start, &wall.end)
}

/// Returns the first and one past the last of `count` cells that lie within `reach` of `at`.
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

/// Number of walls drawn together.
const BLOCK: usize = 16 * LANES;

/// Walls as seen from the origin of a sweep, in lanes.
struct Block {
    count: usize,
    places: [usize; BLOCK],
    walls: [Walls; BLOCK / LANES],
}

#[derive(Clone, Copy, Default)]
struct Walls {
    start_x: [f64; LANES],
    start_y: [f64; LANES],
    end_x: [f64; LANES],
    end_y: [f64; LANES],
    area: [f64; LANES],
    /// The indices of the right and left ends among the beams.
    from: [f64; LANES],
    to: [f64; LANES],
}

impl Caster for WallIndex {
    /// Follows the ray piece by piece, so that a long one costs no more than what lies along it.
    /// The number of pieces is limited, so that a ray from anywhere ends.
    fn cast(&self, origin: Point, direction: Vector, max_range: f64) -> f64 {
        let Some(lowest) = self.levels.first() else {
            return max_range;
        };
        let end = max_range.min(self.farthest(origin));
        let half_piece = 4.0 * lowest.cell;
        let piece = 2.0 * half_piece;
        let first = ((self.clearance(origin) / piece).floor() - 1.0).max(0.0);
        let most = (self.bounds.max - self.bounds.min).norm() / piece + 3.0;
        let more = (end / piece - first).min(most).max(0.0) as u64;
        let mut range = max_range;
        for number in 0..=more {
            let from = (first + number as f64) * piece;
            let middle = origin + direction * (from + half_piece);
            self.near(middle, half_piece, |walls| {
                range = walls
                    .iter()
                    .map(|wall| wall.ray(origin, direction))
                    .fold(range, f64::min);
            });
            // What was met beyond this piece may have something before it in the next.
            if range <= from + piece {
                break;
            }
        }
        range
    }

    fn scan(&self, sweep: &mut BeamSweep) {
        self.kernels.run(
            #[inline(always)]
            || self.draw(sweep),
        );
    }
}

impl WallIndex {
    /// Returns a distance from `origin` within which there is no wall, by the bounds of all walls.
    fn clearance(&self, origin: Point) -> f64 {
        (self.bounds.min - origin)
            .sup(&(origin - self.bounds.max))
            .sup(&Vector::zeros())
            .norm()
    }

    /// Returns a range that reaches every wall from `origin`.
    fn farthest(&self, origin: Point) -> f64 {
        (self.bounds.min - origin)
            .abs()
            .sup(&(self.bounds.max - origin).abs())
            .norm()
    }

    #[inline(always)]
    fn draw(&self, sweep: &mut BeamSweep) {
        let max_range = sweep.ring().max_range;
        let origin = sweep.origin;
        let mut block = Block::empty();
        self.places(
            origin,
            max_range.min(self.farthest(origin)),
            #[inline(always)]
            |places| {
                for place in places {
                    block.take_if_near(&self.traces[place], place, origin, max_range);
                    if block.count == BLOCK {
                        self.draw_block(&mut block, sweep);
                    }
                }
            },
        );
        self.draw_block(&mut block, sweep);
    }

    /// Draws the walls of a block, and empties it.
    #[inline(always)]
    fn draw_block(&self, block: &mut Block, sweep: &mut BeamSweep) {
        let order = sweep.order;
        let count = block.count.min(BLOCK);
        for walls in &mut block.walls[..count.div_ceil(LANES)] {
            // What lies beyond the count is left over and harmless.
            walls.look(&order);
        }
        for (index, place) in block.places[..count].iter().enumerate() {
            let (walls, lane) = (&block.walls[index / LANES], index % LANES);
            let seen = walls.seen(lane);
            if seen.area > 0.0 {
                sweep.meet_seen(&seen, walls.from[lane], walls.to[lane]);
            } else {
                sweep.meet_edge_on(&self.walls[*place]);
            }
        }
        block.count = 0;
    }
}

impl Block {
    fn empty() -> Self {
        Self {
            count: 0,
            places: [0; BLOCK],
            walls: [Walls::default(); BLOCK / LANES],
        }
    }

    /// Adds a wall if it comes within `range` of `origin`. The block must not be full.
    #[inline(always)]
    fn take_if_near(&mut self, wall: &Trace, place: usize, origin: Point, range: f64) {
        let (start, end) = (wall.start - origin, wall.end - origin);
        let along = end - start;
        let share = -(start.x * along.x + start.y * along.y) * wall.per_square;
        let share = if share > 0.0 { share } else { 0.0 };
        let share = if share < 1.0 { share } else { 1.0 };
        let (near_x, near_y) = (start.x + along.x * share, start.y + along.y * share);
        let is_near = near_x * near_x + near_y * near_y <= range * range;
        // Written in any case, and kept by counting it: a branch here would be guessed wrong often.
        let index = self.count % BLOCK;
        self.places[index] = place;
        let (walls, lane) = (&mut self.walls[index / LANES], index % LANES);
        walls.start_x[lane] = start.x;
        walls.start_y[lane] = start.y;
        walls.end_x[lane] = end.x;
        walls.end_y[lane] = end.y;
        self.count += usize::from(is_near);
    }
}

impl Walls {
    /// Puts the ends of all walls in order and finds them among the beams.
    #[inline(always)]
    fn look(&mut self, order: &Order) {
        for lane in 0..LANES {
            let (start_x, start_y) = (self.start_x[lane], self.start_y[lane]);
            let (end_x, end_y) = (self.end_x[lane], self.end_y[lane]);
            let area = start_x * end_y - start_y * end_x;
            let swap = area < 0.0;
            let (right_x, left_x) = (pick(swap, end_x, start_x), pick(swap, start_x, end_x));
            let (right_y, left_y) = (pick(swap, end_y, start_y), pick(swap, start_y, end_y));
            self.start_x[lane] = right_x;
            self.start_y[lane] = right_y;
            self.end_x[lane] = left_x;
            self.end_y[lane] = left_y;
            self.area[lane] = area.abs();
            self.from[lane] = order.index(bearing(right_x, right_y));
            self.to[lane] = order.index(bearing(left_x, left_y));
        }
    }

    #[inline(always)]
    fn seen(&self, lane: usize) -> Seen {
        Seen {
            right: Vector::new(self.start_x[lane], self.start_y[lane]),
            left: Vector::new(self.end_x[lane], self.end_y[lane]),
            area: self.area[lane],
        }
    }
}

#[inline(always)]
fn pick(first: bool, yes: f64, no: f64) -> f64 {
    if first { yes } else { no }
}
