//! Grids of traversals: "Local grid-based methods to maintain estimates of how well areas have been
//! visited or traversed". The matchers' order needs only traversals.

use alloc::collections::BTreeMap;

use tolman_geom::{Point, Vector, floor_index};

/// Record of traversals of the area around a frame's origin, in square cells. The caller gives
/// their side.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CoverageGrid {
    /// Cells that the robot was in, by their number.
    cells: BTreeMap<CellNumber, Traversals>,
}

/// Column and row.
type CellNumber = (i32, i32);

/// Number of traversals of a cell heading east, north, west and south.
type Traversals = [u32; 4];

impl CoverageGrid {
    /// Counts a straight drive between two points, m, on cells of side `cell`, m.
    pub(super) fn traverse(&mut self, from: Point, to: Point, cell: f64) {
        let heading = quadrant(to - from);
        crossed(from, to, cell, |number| {
            let count = &mut self.cells.entry(number).or_default()[heading];
            *count = count.saturating_add(1);
        });
    }

    /// Returns the number of times that the robot went between two points in this direction: the
    /// least over the cells on the way.
    #[must_use]
    pub fn traversals(&self, from: Point, to: Point, cell: f64) -> u32 {
        let heading = quadrant(to - from);
        let mut least = u32::MAX;
        crossed(from, to, cell, |number| {
            least = least.min(self.cells.get(&number).map_or(0, |cell| cell[heading]));
        });
        least
    }
}

fn number(at: Point, cell: f64) -> CellNumber {
    // The cell of the origin has it in its middle. Casts saturate, so that nothing is out of range.
    let along = |coordinate: f64| floor_index(coordinate / cell + 0.5);
    (along(at.x), along(at.y))
}

fn quadrant(way: Vector) -> usize {
    match (way.x.abs() >= way.y.abs(), way.x >= 0.0, way.y >= 0.0) {
        (true, true, _) => 0,
        (false, _, true) => 1,
        (true, false, _) => 2,
        (false, _, false) => 3,
    }
}

/// Visits the cells along a straight way. It takes two samples per cell and at most 64 in all, so
/// that the cost is bounded.
fn crossed(from: Point, to: Point, cell: f64, mut visit: impl FnMut(CellNumber)) {
    let way = to - from;
    let samples = (libm::ceil(2.0 * way.norm() / cell) as u32).clamp(1, 64);
    let mut last = None;
    for sample in 0..=samples {
        let at = number(from + way * (f64::from(sample) / f64::from(samples)), cell);
        if last != Some(at) {
            visit(at);
            last = Some(at);
        }
    }
}
