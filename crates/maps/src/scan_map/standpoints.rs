use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Heading, Point};
use tolman_robot::{Ring, Scan};

use super::wall_grid::{GridIndex, GridRange, index_of, middle};
use super::{ScanMap, WallGrid};

/// A lattice of positions where a robot can stand on a map, and what its beams would meet from each.
#[derive(Clone, Debug)]
pub struct Standpoints {
    ring: Ring,
    first: GridIndex,
    columns: i32,
    /// The number of the standpoint of each lattice cell, in rows.
    numbers: Vec<u32>,
    positions: Vec<Point>,
    is_goal: Vec<bool>,
    senses_goal: Vec<bool>,
    /// Ranges from each, beam 0 to the north, in [`RANGE_UNIT`]s; [`UNKNOWN`] where the map does not say.
    ranges: Vec<u8>,
}

/// Cells of the grid from one standpoint to the next.
const EVERY: i32 = 2;
/// Steps in which ranges are kept, m.
const RANGE_UNIT: f64 = 0.01;
/// No range.
const UNKNOWN: u8 = u8::MAX;
/// No standpoint.
const NOWHERE: u32 = u32::MAX;
/// By how much the goal reaches beyond where its landmark was sensed, m.
const GOAL_MARGIN: f64 = 0.05;
/// Nearer than that to where the goal was sensed it is sensed, too, m.
const SENSES_GOAL: f64 = 0.12;

impl Standpoints {
    /// From one to the next, m.
    pub const SPACING: f64 = EVERY as f64 * WallGrid::CELL;

    /// Returns those of a map that lead to where its robot has been, for scans by `ring`. O(cells + standpoints · beams).
    #[must_use]
    pub fn of(map: &ScanMap, ring: Ring) -> Self {
        let grid = map.grid();
        let [first, end] = grid.bounds();
        let columns = (end[0] - first[0]) / EVERY + 1;
        let rows = (end[1] - first[1]) / EVERY + 1;
        let mut lattice = Self {
            ring: Ring::full(ring.beams, ring.max_range),
            first,
            columns,
            numbers: vec![NOWHERE; (columns * rows) as usize],
            positions: Vec::new(),
            is_goal: Vec::new(),
            senses_goal: Vec::new(),
            ranges: Vec::new(),
        };
        let places = map.places().iter().map(|place| place.position);
        let reached = map.clearings().reached(places);
        let goal = bounds(map.goal());
        for row in (first[1]..end[1]).step_by(EVERY as usize) {
            for column in (first[0]..end[0]).step_by(EVERY as usize) {
                let index = [column, row];
                if grid.slot(index).is_some_and(|slot| reached[slot])
                    && let Some(slot) = lattice.slot(index)
                {
                    lattice.numbers[slot] = lattice.positions.len() as u32;
                    lattice.add(grid, middle(index), goal);
                    let sensed = |at: &Point| (at - middle(index)).norm() < SENSES_GOAL;
                    lattice.senses_goal.push(map.goal().iter().any(sensed));
                }
            }
        }
        lattice
    }

    /// Returns how many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Returns whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Returns where they lie, by number.
    #[must_use]
    pub fn positions(&self) -> &[Point] {
        &self.positions
    }

    /// Returns whether one lies where the landmark of the goal is sensed.
    #[must_use]
    pub fn is_goal(&self, number: u32) -> bool {
        self.is_goal[number as usize]
    }

    /// Returns whether the landmark of the goal was sensed so near to one that it is sensed there, too.
    #[must_use]
    pub fn senses_goal(&self, number: u32) -> bool {
        self.senses_goal[number as usize]
    }

    /// Returns the one whose cell of the lattice a point lies in.
    #[must_use]
    pub fn at(&self, point: Point) -> Option<u32> {
        let [column, row] = index_of(point);
        self.number([column, row])
    }

    /// Writes into `scan` what a robot at one would see that faces along `heading`: nothing in reach where the map does not say.
    /// The scan's ring must be a full circle of as many beams.
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

    /// Returns those that lie round a point, with the share that each has of it.
    pub(super) fn around(&self, point: Point) -> [(Option<u32>, f64); 4] {
        let origin = middle(self.first);
        let scaled = (point - origin) / Self::SPACING;
        let corner = [libm::floor(scaled.x), libm::floor(scaled.y)];
        let [right, up] = [scaled.x - corner[0], scaled.y - corner[1]];
        let number = |column: i32, row: i32| {
            let cell = [corner[0] as i32 + column, corner[1] as i32 + row];
            self.number([0, 1].map(|axis| self.first[axis] + cell[axis] * EVERY))
        };
        [
            (number(0, 0), (1.0 - right) * (1.0 - up)),
            (number(1, 0), right * (1.0 - up)),
            (number(0, 1), (1.0 - right) * up),
            (number(1, 1), right * up),
        ]
    }

    /// Returns the mean square of how far a scan's ranges differ from those expected at one, each in `sd`s and at most
    /// `outlier` of them; `None` where the map does not say what is seen there. `north` is the scan, beam 0 to the north.
    pub(super) fn misfit(&self, number: u32, north: &[f64], sd: f64, outlier: f64) -> Option<f64> {
        let beams = self.ring.beams as usize;
        let expected = &self.ranges[number as usize * beams..][..beams];
        let (mut sum, mut known) = (0.0, 0_u32);
        for (seen, expected) in north.iter().zip(expected) {
            if *expected == UNKNOWN {
                continue;
            }
            let off = ((seen - f64::from(*expected) * RANGE_UNIT).abs() / sd).min(outlier);
            sum += off * off;
            known += 1;
        }
        (2 * known as usize >= beams).then(|| sum / f64::from(known))
    }

    /// Returns a scan's ranges, beam 0 to the north; `None` if another ring made them.
    pub(super) fn northward(&self, scan: &Scan, heading: Heading) -> Option<Vec<f64>> {
        let is_read = !scan.ranges.is_empty() && scan.ranges.len() == self.ring.beams as usize;
        is_read.then(|| scan.northward(heading))
    }

    fn add(&mut self, grid: &WallGrid, at: Point, goal: Option<[Point; 2]>) {
        self.positions.push(at);
        self.is_goal.push(goal.is_some_and(|[low, high]| {
            (low.x..=high.x).contains(&at.x) && (low.y..=high.y).contains(&at.y)
        }));
        for beam in 0..self.ring.beams {
            let bearing = Heading::NORTH.turned(self.ring.bearing(beam));
            let range = match grid.range(at, bearing, self.ring.max_range) {
                GridRange::Wall(range) => (range / RANGE_UNIT) as u8,
                GridRange::Clear => (self.ring.max_range / RANGE_UNIT).min(254.0) as u8,
                GridRange::Unknown => UNKNOWN,
            };
            self.ranges.push(range);
        }
    }

    fn number(&self, index: GridIndex) -> Option<u32> {
        let number = *self.numbers.get(self.slot(index)?)?;
        (number != NOWHERE).then_some(number)
    }

    fn slot(&self, index: GridIndex) -> Option<usize> {
        let [column, row] = [0, 1].map(|axis| (index[axis] - self.first[axis]).div_euclid(EVERY));
        let inside = (0..self.columns).contains(&column) && row >= 0;
        inside.then(|| (row * self.columns + column) as usize)
    }
}

/// The box round where the goal was sensed, low and high corner.
fn bounds(points: &[Point]) -> Option<[Point; 2]> {
    let first = *points.first()?;
    let margin = tolman_geom::Vector::new(GOAL_MARGIN, GOAL_MARGIN);
    let [low, high] = points.iter().fold([first, first], |[low, high], point| {
        [low.inf(point), high.sup(point)]
    });
    Some([low - margin, high + margin])
}
