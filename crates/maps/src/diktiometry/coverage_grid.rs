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

#[cfg(test)]
mod tests {
    use alloc::vec;
    use alloc::vec::Vec;

    use proptest::prelude::*;

    use super::*;

    /// Returns the cells along a way, from points much closer together than cells are wide.
    fn cells(from: Point, to: Point, cell: f64) -> Vec<CellNumber> {
        let at = |step: i32| from + (to - from) * (f64::from(step) / 1000.0);
        let nearest = |at: Point| {
            let along = |coordinate: f64| (coordinate / cell).round() as i32;
            (along(at.x), along(at.y))
        };
        let mut all: Vec<CellNumber> = (0..=1000).map(|step| nearest(at(step))).collect();
        all.dedup();
        all
    }

    proptest! {
        #[test]
        fn what_was_traversed_is_counted_in_its_direction(
            x in -3.0..3.0, y in -3.0..3.0, east in -2.0..2.0, north in -2.0..2.0,
            cell in prop::sample::select(vec![0.3, 0.5, 2.0]), times in 1_u32..4,
        ) {
            let (from, to) = (Point::new(x, y), Point::new(x + east, y + north));
            let mut grid = CoverageGrid::default();
            prop_assert_eq!(grid.traversals(from, to, cell), 0);
            for _ in 0..times {
                grid.traverse(from, to, cell);
            }
            prop_assert_eq!(grid.traversals(from, to, cell), times);
            let back = if quadrant(to - from) == quadrant(from - to) { times } else { 0 };
            prop_assert_eq!(grid.traversals(to, from, cell), back);
            let passed = cells(from, to, cell);
            let mut met = Vec::new();
            crossed(from, to, cell, |number| met.push(number));
            prop_assert_eq!(met.first(), passed.first());
            prop_assert_eq!(met.last(), passed.last());
            // Two samples a cell may miss a corner, but nothing else.
            // Of corners that the way only touches, either side will do.
            let beside = [(3e-3, 3e-3), (3e-3, -3e-3), (-3e-3, 3e-3), (-3e-3, -3e-3)];
            let beside = beside.map(|(x, y)| Vector::new(x, y));
            let near: Vec<CellNumber> = beside.iter().flat_map(|aside| cells(from + aside, to + aside, cell)).collect();
            prop_assert!(met.iter().all(|number| near.contains(number)), "{met:?} {passed:?}");
            for pair in met.windows(2) {
                let apart = (pair[0].0 - pair[1].0).abs().max((pair[0].1 - pair[1].1).abs());
                prop_assert_eq!(apart, 1, "{:?}", met);
            }
            let beyond = to + (to - from).normalize() * (2.0 * cell);
            prop_assert_eq!(grid.traversals(from, beyond, cell), 0);
        }
    }

    #[test]
    fn directions_are_four() {
        for (x, y, expected) in [
            (1.0, 0.5, 0),
            (1.0, -1.0, 0),
            (0.5, 1.0, 1),
            (-0.5, 1.0, 1),
            (-1.0, 0.5, 2),
            (-1.0, -1.0, 2),
            (0.5, -1.0, 3),
            (-0.5, -1.0, 3),
        ] {
            assert_eq!(quadrant(Vector::new(x, y)), expected, "{x} {y}");
        }
    }
}
