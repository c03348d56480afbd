use alloc::vec::Vec;

use tolman_geom::{Heading, Point};
use tolman_robot::{Ring, Scan};

use super::evidence::{Misfit, ends_before};
use super::grid_area::GridArea;
use super::ranked_bits::RankedBits;
use super::rays::{RANGE_UNIT, Rays, UNKNOWN};
use super::wall_grid::{GridIndex, corner_of, index_of, middle};
use super::{Clearings, ScanChart, WallGrid};

/// A lattice of positions where a robot can stand on a map, and the ranges of its beams from each.
///
/// It takes about two bits for each position on the lattice. The view from a position is computed
/// when needed.
#[derive(Clone, Debug)]
pub struct Standpoints {
    chart: ScanChart,
    ring: Ring,
    rays: Rays,
    /// Cells of the lattice, in which the standpoints are.
    lattice: GridArea,
    /// The lattice cells that have a standpoint, in rows.
    stands: RankedBits,
    /// Numbers of the standpoints where the landmark of the goal is sensed, in order.
    goals: Vec<u32>,
    /// Numbers of the standpoints near a point where the goal was sensed. A robot senses the goal
    /// there too.
    sensing_goal: Vec<u32>,
}

/// Stored views from all standpoints, for callers that need all of them often. One byte per beam.
#[derive(Clone, Debug)]
pub struct StandpointViews {
    ring: Ring,
    /// Ranges from each standpoint, beam 0 to the north, in [`RANGE_UNIT`]s; [`UNKNOWN`] where the
    /// map has no range.
    ranges: Vec<u8>,
}

/// Number of cells of the grid from one standpoint to the next.
const EVERY: i32 = 2;
/// Distance by which the goal reaches beyond the points where its landmark was sensed, m.
const GOAL_MARGIN: f64 = 0.05;
/// Distance from a point where the goal was sensed within which it is sensed too, m.
const SENSES_GOAL: f64 = 0.12;

impl Standpoints {
    /// Distance between neighbouring standpoints, m.
    pub const SPACING: f64 = EVERY as f64 * WallGrid::CELL;

    /// Returns the standpoints of a map that lead to where its robot has been, for scans by `ring`.
    /// O(cells).
    #[must_use]
    pub fn of(chart: ScanChart, ring: Ring) -> Self {
        let grid = chart.ground().grid();
        let lattice = lattice_over(grid.bounds());
        let stands = stands(&chart, &chart.clearings(&grid), &lattice);
        let ring = Ring::full(ring.beams, ring.max_range);
        let mut standpoints = Self {
            chart,
            ring,
            rays: Rays::of(ring),
            lattice,
            stands,
            goals: Vec::new(),
            sensing_goal: Vec::new(),
        };
        standpoints.mark_goal();
        standpoints
    }

    /// Returns the map.
    #[must_use]
    pub const fn chart(&self) -> &ScanChart {
        &self.chart
    }

    /// Returns the ring of the scans that it compares.
    #[must_use]
    pub const fn ring(&self) -> Ring {
        self.ring
    }

    /// Returns the number of standpoints.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.stands.len()
    }

    /// Returns whether there are no standpoints.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the positions of the standpoints, m, by number.
    pub fn positions(&self) -> impl Iterator<Item = Point> + '_ {
        self.stands.slots().map(|slot| middle(self.index(slot)))
    }

    /// Returns the position of standpoint `number`, m, or `None` if it does not exist. O(log
    /// cells).
    #[must_use]
    pub fn position(&self, number: u32) -> Option<Point> {
        let slot = self.stands.slot(number)?;
        Some(middle(self.index(slot)))
    }

    /// Returns the numbers of the standpoints where the landmark of the goal is sensed, in order.
    #[must_use]
    pub fn goals(&self) -> &[u32] {
        &self.goals
    }

    /// Returns the standpoint whose cell of the lattice contains a point.
    #[must_use]
    pub fn at(&self, point: Point) -> Option<u32> {
        self.number(lattice_of(index_of(point)))
    }

    /// Returns the view from each standpoint. O(standpoints · beams · range).
    #[must_use]
    pub fn views(&self) -> StandpointViews {
        let seen = |slot| self.rays.ranges(self.chart.ground(), self.index(slot));
        StandpointViews {
            ring: self.ring,
            ranges: self.stands.slots().flat_map(seen).collect(),
        }
    }

    /// Returns the walls in a scan from a standpoint that the map lacks, as adjacent points. Empty
    /// if the scan fits, or differs for other reasons. O(beams · range).
    #[must_use]
    pub fn new_walls(&self, number: u32, heading: Heading, scan: &Scan) -> Vec<Point> {
        let slot = self.stands.slot(number);
        let (Some(slot), Some(north)) = (slot, self.northward(scan, heading)) else {
            return Vec::new();
        };
        let cell = self.index(slot);
        if !self.misfit(cell, &north).fits_but_for_new_walls() {
            return Vec::new();
        }
        let shown = self.rays.ranges(self.chart.ground(), cell);
        let beams = (0..).zip(north.iter().zip(shown));
        let new = beams.filter(|(_, (seen, shown))| ends_before(**seen, *shown));
        // Each beam counts as wide as its distance from the next, so that no gap remains between
        // them.
        new.flat_map(|(beam, (seen, _))| {
            [-0.25, 0.25].map(|aside| {
                let bearing = self.ring.bearing(beam) + aside * self.ring.spacing;
                middle(cell) + Heading::NORTH.turned(bearing).unit() * *seen
            })
        })
        .collect()
    }

    /// Returns the four standpoints round a point, each with its weight in bilinear interpolation.
    pub(super) fn around(&self, point: Point) -> [(Option<u32>, f64); 4] {
        let scaled = (point - middle([0, 0])) / Self::SPACING;
        let (corner, [right, up]) = corner_of(scaled);
        let number = |column: i32, row: i32| self.number([corner[0] + column, corner[1] + row]);
        [
            (number(0, 0), (1.0 - right) * (1.0 - up)),
            (number(1, 0), right * (1.0 - up)),
            (number(0, 1), (1.0 - right) * up),
            (number(1, 1), right * up),
        ]
    }

    /// Returns the numbers of the standpoints near a point where the goal's landmark was sensed, at
    /// which it is sensed too.
    pub(super) fn sensing_goal(&self) -> &[u32] {
        &self.sensing_goal
    }

    /// Returns the cells of the standpoints, by number.
    pub(super) fn cells(&self) -> impl Iterator<Item = GridIndex> + '_ {
        self.stands.slots().map(|slot| self.index(slot))
    }

    /// Returns the misfit of a scan with the view from a cell. `north` is the scan, beam 0 to the
    /// north. O(beams · range).
    pub(super) fn misfit(&self, cell: GridIndex, north: &[f64]) -> Misfit {
        Misfit::of(north, self.rays.ranges(self.chart.ground(), cell))
    }

    /// Returns a scan's ranges, beam 0 to the north; `None` if another ring made them.
    pub(super) fn northward(&self, scan: &Scan, heading: Heading) -> Option<Vec<f64>> {
        let is_read = !scan.ranges.is_empty() && scan.ranges.len() == self.ring.beams as usize;
        is_read.then(|| scan.northward(heading))
    }

    /// Marks the standpoints where the landmark of the goal is sensed.
    fn mark_goal(&mut self) {
        let points = self.chart.goal();
        let bounds = bounds(points);
        let is_within = |at: Point| {
            bounds.is_some_and(|[low, high]| {
                (low.x..=high.x).contains(&at.x) && (low.y..=high.y).contains(&at.y)
            })
        };
        let is_near = |at: Point| {
            let near = |goal: &Point| (goal - at).norm() < SENSES_GOAL;
            points.iter().any(near)
        };
        let numbered = || (0..).zip(self.positions());
        let goals = numbered().filter(|(_, at)| is_within(*at));
        let sensing = numbered().filter(|(_, at)| is_near(*at));
        let goals = goals.map(|(number, _)| number).collect();
        let sensing = sensing.map(|(number, _)| number).collect();
        (self.goals, self.sensing_goal) = (goals, sensing);
    }

    fn number(&self, lattice: [i32; 2]) -> Option<u32> {
        self.stands.number(self.lattice.slot(lattice)?)
    }

    /// Returns the cell of the grid in which the standpoint of a slot lies.
    fn index(&self, slot: usize) -> GridIndex {
        self.lattice.index(slot).map(|along| along * EVERY)
    }
}

impl StandpointViews {
    /// Writes the view of a robot at a standpoint into `scan`, facing along `heading`. Beams with
    /// unknown ranges read nothing in reach. The scan's ring must be a full circle of the same
    /// number of beams.
    pub fn scan(&self, number: u32, heading: Heading, scan: &mut Scan) {
        let beams = self.ring.beams as usize;
        let expected = &self.ranges[number as usize * beams..][..beams];
        let ahead = heading.radians() + scan.ring.first_bearing - Heading::NORTH.radians();
        let first = libm::round(ahead / self.ring.spacing) as i64;
        let first = first.rem_euclid(beams.max(1) as i64) as usize;
        let turned = expected[first..].iter().chain(&expected[..first]);
        for (range, expected) in scan.ranges.iter_mut().zip(turned) {
            *range = match *expected {
                UNKNOWN => self.ring.max_range,
                units => (f64::from(units) * RANGE_UNIT).min(self.ring.max_range),
            };
        }
    }
}

/// Returns the lattice over a grid. Its position does not depend on the grid's extent.
fn lattice_over([first, end]: [GridIndex; 2]) -> GridArea {
    let first = lattice_of(first);
    let size = |axis: usize| (end[axis] - first[axis] * EVERY).max(0) / EVERY + 1;
    GridArea::new(first, size(0), size(1))
}

/// Returns the set of lattice cells that the robot can reach from places where it has been.
fn stands(chart: &ScanChart, clearings: &Clearings<'_>, lattice: &GridArea) -> RankedBits {
    let reached = clearings.reached(chart.places().iter().map(|place| place.position));
    RankedBits::new(lattice.len(), |slot| {
        let index = lattice.index(slot).map(|along| along * EVERY);
        clearings
            .grid()
            .slot(index)
            .is_some_and(|slot| reached[slot])
    })
}

/// Returns the cell of the lattice in which a cell of the grid lies.
fn lattice_of(index: GridIndex) -> [i32; 2] {
    index.map(|along| along.div_euclid(EVERY))
}

/// Returns the bounding box of the points where the goal was sensed, low and high corner.
fn bounds(points: &[Point]) -> Option<[Point; 2]> {
    let first = *points.first()?;
    let margin = tolman_geom::Vector::new(GOAL_MARGIN, GOAL_MARGIN);
    let [low, high] = points.iter().fold([first, first], |[low, high], point| {
        [low.inf(point), high.sup(point)]
    });
    Some([low - margin, high + margin])
}
