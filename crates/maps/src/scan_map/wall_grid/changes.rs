//! Walls that came or went since they were drawn.

use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Heading, Point};
use tolman_robot::Scan;

use super::{ELSEWHERE, GridCell, GridIndex, WallGrid, index_of, reach_of_wall};
use crate::scan_map::evidence::BEAMS_OF_A_WALL;

/// Number of half cells before a wall that may be unknown.
const LAST_CELL: u32 = 4;

impl WallGrid {
    /// Forgets what a scan contradicts, and draws what it shows instead: a wall that has come, or
    /// floor where one stood. Single beams err; a change is as many adjacent ones as a wall has
    /// that a [belief](crate::scan_map::StandpointBelief) notices. Returns the cells of walls that
    /// have come. O(beams · range, and cells within the range if a wall has gone).
    pub(in crate::scan_map) fn renew(
        &mut self,
        from: Point,
        heading: Heading,
        scan: &Scan,
    ) -> Vec<GridIndex> {
        let off: Vec<f64> = (0..)
            .zip(&scan.ranges)
            .map(|(beam, range)| {
                let unit = heading.turned(scan.ring.bearing(beam)).unit();
                let expected = self.range(from, unit, scan.ring.max_range, LAST_CELL);
                expected.map_or(0.0, |expected| range - expected)
            })
            .collect();
        let gone = of_long_runs(&off, |off| off > ELSEWHERE);
        if gone.contains(&true) {
            let mut seen = scan.clone();
            for (range, gone) in seen.ranges.iter_mut().zip(&gone) {
                *range = if *gone { *range } else { 0.0 };
            }
            self.between_beams(from, heading, &seen, |grid, index, slot| {
                if grid.cells[slot].is_wall() {
                    (grid.cells[slot].hits, grid.cells[slot].passes) = (0, 1);
                    grid.measure_again(index);
                }
            });
        }
        let come = of_long_runs(&off, |off| off < -ELSEWHERE);
        let ends = (0..).zip(&scan.ranges).zip(&come);
        let ends = ends.filter(|((_, range), come)| **come && **range < scan.ring.max_range);
        let ends = ends.map(|((beam, range), _)| {
            let unit = heading.turned(scan.ring.bearing(beam)).unit();
            index_of(from + unit * *range)
        });
        let ends: Vec<GridIndex> = ends.collect();
        let reach = reach_of_wall();
        for index in &ends {
            if let Some(slot) = self.slot(*index) {
                (self.cells[slot].hits, self.cells[slot].passes) = (1, 0);
                self.stamp(*index, &reach);
            }
        }
        ends
    }

    /// Takes walls away again that were [drawn later](Self::renew). O(cells).
    pub(in crate::scan_map) fn reopen(&mut self, walls: impl IntoIterator<Item = GridIndex>) {
        for index in walls {
            if let Some(slot) = self.slot(index)
                && self.cell(index).is_some_and(GridCell::is_wall)
            {
                (self.cells[slot].hits, self.cells[slot].passes) = (0, 1);
                self.measure_again(index);
            }
        }
    }
}

/// Returns, beam by beam, whether it belongs to a run of beams round the ring that all have
/// something in common, and that is long enough for a wall. O(beams).
fn of_long_runs(off: &[f64], has: impl Fn(f64) -> bool) -> Vec<bool> {
    let beams = off.len();
    let mut belongs = vec![false; beams];
    // A run that goes on past the last beam begins at the first beam that lacks it.
    let Some(lacks) = off.iter().position(|off| !has(*off)) else {
        return vec![true; beams];
    };
    let mut run = Vec::new();
    for beam in (lacks..=lacks + beams).map(|beam| beam % beams) {
        if has(off[beam]) {
            run.push(beam);
            continue;
        }
        if run.len() >= BEAMS_OF_A_WALL as usize {
            for beam in &run {
                belongs[*beam] = true;
            }
        }
        run.clear();
    }
    belongs
}

#[cfg(test)]
mod tests {
    use tolman_robot::Ring;

    use super::*;

    /// Returns the scan of a robot in the middle of a square room, 1 m from its walls; to the east
    /// another wall stands so far off.
    fn room(east: f64) -> Scan {
        let ring = Ring::full(72, 2.0);
        let range = |beam| {
            let unit = Heading::EAST.turned(ring.bearing(beam)).unit();
            let wall = 1.0 / unit.x.abs().max(unit.y.abs());
            let is_east = unit.x > 0.5 && unit.y.abs() < 0.5;
            if is_east { wall * east } else { wall }
        };
        Scan {
            ring,
            ranges: (0..ring.beams).map(range).collect(),
        }
    }

    fn seen(scans: &[f64]) -> WallGrid {
        let mut grid = WallGrid::default();
        for _ in 0..3 {
            grid.add(Point::origin(), Heading::EAST, &room(1.0));
        }
        for east in scans {
            grid.renew(Point::origin(), Heading::EAST, &room(*east));
        }
        grid
    }

    #[test]
    fn a_wall_that_comes_is_drawn_and_one_that_goes_is_taken_away_by_one_scan() {
        let at = |x: f64| Point::new(x, 0.02);
        let walls = |scans: &[f64]| {
            let grid = seen(scans);
            [0.5, 1.0].map(|x| (-2..=2).any(|off| grid.is_wall(at(x + 0.05 * f64::from(off)))))
        };
        assert_eq!(walls(&[]), [false, true]);
        assert_eq!(walls(&[1.05]), [false, true]);
        assert_eq!(walls(&[0.5]), [true, true]);
        assert_eq!(walls(&[1.5]), [false, false]);
        assert_eq!(walls(&[0.5, 1.0]), [false, true]);
        assert!(seen(&[0.5, 1.0]).stands(index_of(at(0.5)), 0.2));
    }

    #[test]
    fn single_beams_change_nothing() {
        let mut grid = seen(&[]);
        let mut scan = room(1.0);
        for beam in [0, 1, 2, 20, 71] {
            scan.ranges[beam] = 0.4;
        }
        assert!(grid.renew(Point::origin(), Heading::EAST, &scan).is_empty());
    }

    #[test]
    fn walls_that_were_drawn_later_can_be_taken_away() {
        let mut grid = seen(&[]);
        let come = grid.renew(Point::origin(), Heading::EAST, &room(0.5));
        assert!(
            !come.is_empty()
                && come
                    .iter()
                    .all(|index| grid.cell(*index).is_some_and(GridCell::is_wall))
        );
        grid.reopen(come.iter().copied());
        assert!(
            !come
                .iter()
                .any(|index| grid.cell(*index).is_some_and(GridCell::is_wall))
        );
    }
}
