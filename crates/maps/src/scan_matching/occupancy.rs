use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::Scan;

/// Counts of beams that passed and that ended, on a square grid of fixed bounds: the kind of map on
/// which other programs navigate.
#[derive(Clone, Debug, PartialEq)]
pub struct OccupancyGrid {
    /// Side of a cell, m.
    pub cell: f64,
    /// Position of the south-west corner, m.
    pub origin: Point,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Beams that ended in each cell and beams that passed it, row by row from the south-west.
    counts: Vec<(u16, u16)>,
}

/// Maximum number of cells of a grid along an axis.
const MOST_CELLS: f64 = 20_000.0;

impl OccupancyGrid {
    /// Returns an empty grid that holds all of the points, in cells of `cell` m. Points that are
    /// not finite, and those that would need more than 20000 cells, are left out.
    #[must_use]
    pub fn around(points: impl Iterator<Item = Point>, cell: f64) -> Self {
        let finite = points.filter(|point| point.coords.iter().all(|part| part.is_finite()));
        let bounds = finite.fold(None, |bounds: Option<(Point, Point)>, point| {
            let (low, high) = bounds.unwrap_or((point, point));
            Some((low.inf(&point), high.sup(&point)))
        });
        let (low, high) = bounds.unwrap_or((Point::origin(), Point::origin()));
        let margin = 4.0 * cell;
        let origin = [low.x, low.y].map(|low| libm::floor((low - margin) / cell) * cell);
        let origin = Point::new(origin[0], origin[1]);
        let extent = (high - origin)
            .map(|extent| libm::ceil((extent + margin) / cell).clamp(1.0, MOST_CELLS));
        let (columns, rows) = (extent.x as usize, extent.y as usize);
        Self {
            cell,
            origin,
            columns,
            rows,
            counts: vec![(0, 0); columns * rows],
        }
    }

    /// Adds a scan that was taken from the pose `map_from_laser`. Beams longer than `farthest` m
    /// pass up to there and end nowhere. O(beams · range / cell).
    pub fn add(&mut self, scan: &Scan, map_from_laser: Pose, farthest: f64) {
        let most = farthest.min(scan.ring.max_range);
        for (index, range) in (0..).zip(&scan.ranges) {
            // A beam that hit nothing may have passed through glass.
            if !(*range > 0.0 && *range < scan.ring.max_range) {
                continue;
            }
            let bearing = Heading::from_radians(scan.ring.bearing(index)).unit();
            let seen = range.min(most);
            let end = map_from_laser.transform(Point::from(bearing * seen));
            self.pass(map_from_laser.position, end, *range < most);
        }
    }

    /// Counts one beam: every cell on the line as passed, except the last, which is hit if it
    /// `ends` there.
    fn pass(&mut self, from: Point, to: Point, ends: bool) {
        let way = to - from;
        let steps = libm::ceil(way.norm() / (0.5 * self.cell)).max(1.0);
        let last = self.slot(to);
        let mut before = None;
        for step in 0..steps as u32 {
            let slot = self.slot(from + way * (f64::from(step) / steps));
            if slot != before && slot != last {
                if let Some(slot) = slot {
                    self.counts[slot].1 = self.counts[slot].1.saturating_add(1);
                }
                before = slot;
            }
        }
        if let (Some(slot), true) = (last, ends) {
            self.counts[slot].0 = self.counts[slot].0.saturating_add(1);
        }
    }

    /// Returns the number of beams of a scan that end on the map, and the number of these that end
    /// on the map's floor. Floor is a cell whose share of hits, like that of all beside it, is
    /// below `wall`. On a map that shows walls twice, many beams end on floor. O(beams).
    #[must_use]
    pub fn contradicted(
        &self,
        scan: &Scan,
        map_from_laser: Pose,
        farthest: f64,
        wall: f64,
    ) -> [usize; 2] {
        let most = farthest.min(scan.ring.max_range);
        let (mut all, mut on_floor) = (0, 0);
        for (index, range) in (0..).zip(&scan.ranges) {
            if !(*range > 0.0 && *range < most) {
                continue;
            }
            let bearing = Heading::from_radians(scan.ring.bearing(index)).unit();
            let end = map_from_laser.transform(Point::from(bearing * *range));
            all += 1;
            on_floor += usize::from(!self.is_wall_near(end, wall));
        }
        [all, on_floor]
    }

    fn is_wall_near(&self, at: Point, wall: f64) -> bool {
        let beside = [-1.0, 0.0, 1.0];
        let steps = beside.iter().flat_map(|x| beside.map(|y| [*x, y]));
        let mut cells = steps.filter_map(|[x, y]| self.slot(at + Vector::new(x, y) * self.cell));
        cells.any(|slot| {
            let (hits, passes) = self.counts[slot];
            f64::from(hits) > wall * (f64::from(hits) + f64::from(passes))
        })
    }

    fn slot(&self, at: Point) -> Option<usize> {
        let scaled = (at - self.origin) / self.cell;
        let (column, row) = (libm::floor(scaled.x), libm::floor(scaled.y));
        let inside =
            column >= 0.0 && row >= 0.0 && column < self.columns as f64 && row < self.rows as f64;
        inside.then(|| row as usize * self.columns + column as usize)
    }

    /// Returns the share of beams that ended in each cell, row by row from the south-west; `None`
    /// if none has reached it.
    pub fn occupancy(&self) -> impl Iterator<Item = Option<f64>> + '_ {
        self.counts.iter().map(|(hits, passes)| {
            let all = u32::from(*hits) + u32::from(*passes);
            (all > 0).then(|| f64::from(*hits) / f64::from(all))
        })
    }
}
