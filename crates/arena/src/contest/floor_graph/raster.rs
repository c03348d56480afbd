//! The floor as a grid of points, each with the nearest wall.

use alloc::collections::BinaryHeap;
use core::cmp::Reverse;

use tolman_geom::{Point, Vector};
use tolman_sim::World;

/// Points of a grid over a world.
#[derive(Clone, Debug)]
pub(super) struct Raster {
    /// Position of the point with index 0, m.
    origin: Point,
    /// Distance between neighbouring points, m.
    pub(super) pitch: f64,
    pub(super) columns: usize,
    /// Nearest position on a wall for each point, row by row; `None` where no wall was met.
    nearest: Vec<Option<Point>>,
}

/// Steps to the eight neighbours of a point, counter-clockwise from east.
pub(super) const AROUND: [(isize, isize); 8] = [
    (1, 0),
    (1, 1),
    (0, 1),
    (-1, 1),
    (-1, 0),
    (-1, -1),
    (0, -1),
    (1, -1),
];

impl Raster {
    /// Returns the points of `world` that are `pitch` m apart. The nearest wall spreads from point
    /// to point. O(points · log points + length of the walls).
    pub(super) fn of(world: &World, pitch: f64) -> Self {
        let bounds = world.bounds();
        // A rim of points lies outside.
        let origin = bounds.min - Vector::new(1.5 * pitch, 1.5 * pitch);
        let count = |extent: f64| (extent / pitch).ceil() as usize + 4;
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        let mut raster = Self {
            origin,
            pitch,
            columns,
            nearest: vec![None; columns * rows],
        };
        let mut least = vec![f64::INFINITY; columns * rows];
        let mut heap: BinaryHeap<Reverse<(u64, usize, usize)>> = BinaryHeap::new();
        // Distances are not negative, so that their bits are in order.
        let entry = |far: f64, point, wall| Reverse((far.to_bits(), point, wall));
        for (number, wall) in world.walls().iter().enumerate() {
            let pieces = ((wall.end - wall.start).norm() / (0.5 * pitch))
                .ceil()
                .max(1.0);
            for piece in 0..=pieces as u32 {
                let at = wall.start + (f64::from(piece) / pieces) * (wall.end - wall.start);
                let point = raster.index(at);
                let far = wall.distance(raster.position(point));
                if far < least[point] {
                    least[point] = far;
                    heap.push(entry(far, point, number));
                }
            }
        }
        let mut of_wall = vec![usize::MAX; columns * rows];
        while let Some(Reverse((far, point, wall))) = heap.pop() {
            if f64::from_bits(far) > least[point] {
                continue;
            }
            of_wall[point] = wall;
            for next in raster.around(point).into_iter().flatten() {
                let far = world.walls()[wall].distance(raster.position(next));
                if far < least[next] {
                    least[next] = far;
                    heap.push(entry(far, next, wall));
                }
            }
        }
        raster.nearest = (0..columns * rows)
            .map(|point| {
                let wall = world.walls().get(of_wall[point])?;
                Some(wall.nearest(raster.position(point)))
            })
            .collect();
        raster
    }

    pub(super) fn len(&self) -> usize {
        self.nearest.len()
    }

    pub(super) fn position(&self, point: usize) -> Point {
        let (x, y) = (point % self.columns, point / self.columns);
        self.origin + self.pitch * Vector::new(x as f64, y as f64)
    }

    /// Returns the point nearest to a position inside the world.
    pub(super) fn index(&self, at: Point) -> usize {
        let rows = self.len() / self.columns;
        let along = |metres: f64, count: usize| {
            let index = (metres / self.pitch).round();
            index.clamp(0.0, count as f64 - 1.0) as usize
        };
        let from = at - self.origin;
        along(from.y, rows) * self.columns + along(from.x, self.columns)
    }

    /// Returns the eight neighbours of a point, counter-clockwise from east.
    pub(super) fn around(&self, point: usize) -> [Option<usize>; 8] {
        let rows = self.len() / self.columns;
        let (x, y) = (point % self.columns, point / self.columns);
        AROUND.map(|(dx, dy)| {
            let (x, y) = (x.checked_add_signed(dx)?, y.checked_add_signed(dy)?);
            (x < self.columns && y < rows).then_some(y * self.columns + x)
        })
    }

    /// Returns the distance of a point from the nearest wall, m.
    pub(super) fn clearance(&self, point: usize) -> f64 {
        let nearest = self.nearest[point];
        nearest.map_or(f64::INFINITY, |wall| (self.position(point) - wall).norm())
    }

    /// Returns whether a point lies between two walls: it sees the walls that are nearest to itself
    /// and to the point on one side under at least this angle, rad, and is no nearer to its own.
    pub(super) fn is_between(&self, point: usize, angle: f64) -> bool {
        let at = self.position(point);
        let Some(own) = self.nearest[point] else {
            return false;
        };
        // Of two that are equally far but for rounding, one is in the middle.
        let parts = |far: f64| (far / self.pitch * 1024.0).round() as u64;
        let rank = |point: usize| (parts(self.clearance(point)), Reverse(point));
        let sides = self.around(point).into_iter().step_by(2).flatten();
        sides.into_iter().any(|next| {
            self.nearest[next].is_some_and(|other| {
                let (a, b) = (own - at, other - at);
                let seen = libm::atan2(a.perp(&b), a.dot(&b)).abs();
                seen >= angle && rank(point) > rank(next)
            })
        })
    }
}
