use alloc::vec::Vec;

use tolman_geom::Heading;
use tolman_robot::Ring;

use super::wall_grid::GridIndex;
use super::{GroundKind, GroundPlan, WallGrid};

/// Cells that the beams of a ring pass from the middle of a cell, beam 0 to the north. They are the
/// same from every cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Rays {
    cells: Vec<RayCell>,
    /// Index past the last cell of each beam.
    ends: Vec<u32>,
    /// Reading of a beam that meets nothing, in [`RANGE_UNIT`]s.
    clear: u8,
}

/// A cell that a beam passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct RayCell {
    /// Columns and rows from the beam's origin.
    offset: [i8; 2],
    /// Distance of the cell along the beam, in [`RANGE_UNIT`]s.
    range: u8,
}

/// Resolution of ranges, m.
pub(super) const RANGE_UNIT: f64 = 0.01;
/// Value that stands for an unknown range.
pub(super) const UNKNOWN: u8 = u8::MAX;
/// Maximum length to which beams are followed, in [`RANGE_UNIT`]s.
const LONGEST: f64 = 254.0;
/// Length of a step along a beam, cells.
const STRIDE: f64 = 0.5;

impl Rays {
    /// Returns the rays of a ring over the full circle. O(beams · range).
    pub(super) fn of(ring: Ring) -> Self {
        let longest = (ring.max_range / RANGE_UNIT).min(LONGEST);
        let steps = (longest * RANGE_UNIT / (STRIDE * WallGrid::CELL)) as u32;
        let (mut cells, mut ends) = (Vec::new(), Vec::new());
        for beam in 0..ring.beams {
            let unit = Heading::NORTH.turned(ring.bearing(beam)).unit();
            let mut before = [0, 0];
            for step in 1..=steps {
                let gone = f64::from(step) * STRIDE;
                // Rounding is symmetric, so that beams along an axis reach equally far in both
                // directions.
                let along = |along: f64| {
                    let cells = libm::floor(0.5 + gone * along.abs()) as i8;
                    if along < 0.0 { -cells } else { cells }
                };
                let offset = [along(unit.x), along(unit.y)];
                if offset != before {
                    let range = (gone * WallGrid::CELL / RANGE_UNIT) as u8;
                    cells.push(RayCell { offset, range });
                    before = offset;
                }
            }
            ends.push(cells.len() as u32);
        }
        let clear = longest as u8;
        Self { cells, ends, clear }
    }

    /// Returns the ranges from a cell to the nearest wall, beam by beam, in [`RANGE_UNIT`]s;
    /// [`UNKNOWN`] if the beam meets unknown ground first. O(beams · range).
    pub(super) fn ranges<'a>(
        &'a self,
        ground: &'a GroundPlan,
        from: GridIndex,
    ) -> impl Iterator<Item = u8> + 'a {
        let mut first = 0;
        self.ends.iter().map(move |end| {
            let cells = &self.cells[first..*end as usize];
            first = *end as usize;
            let [column, row] = from;
            for RayCell { offset, range } in cells {
                match ground.at([column + i32::from(offset[0]), row + i32::from(offset[1])]) {
                    GroundKind::Floor => {}
                    GroundKind::Wall => return *range,
                    GroundKind::Unknown => return UNKNOWN,
                }
            }
            self.clear
        })
    }
}
