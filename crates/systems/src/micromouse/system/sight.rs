//! Converts a scan to readings of the grid's walls.

use tolman_control::heading_of;
use tolman_geom::{Point, Pose};
use tolman_maps::wall_map::CellRay;
use tolman_maze::{Cell, Direction};
use tolman_robot::Scan;

use super::MazeMouseConfig;

/// A mouse's view of the walls from one cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellSight {
    /// Cell in which the mouse stands.
    pub cell: Cell,
    /// One ray for each side that the mouse sees.
    pub rays: Vec<CellRay>,
}

/// A beam that looks along the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    /// Side to which the beam looks.
    pub(super) side: Direction,
    /// Range in that direction, m.
    pub(super) along: f64,
    /// Whether the beam met something.
    pub(super) met: bool,
    /// Angle of the beam off the grid: metres to the left of `side` per metre along it.
    slope: f64,
    /// Origin of the beam, m to the left of the middle of its row of cells.
    aside: f64,
}

/// Cosine of 8°, the greatest angle off the grid: beams beyond it meet walls at the side.
const STRAIGHT: f64 = 0.99;

/// Distance from the middle of the beam's row at which the beam may meet a post, as a share of the
/// pitch.
const INTERIOR: f64 = 0.35;

/// Maximum distance of a beam's end from a wall for the beam to show that wall, as a share of the
/// pitch.
pub(super) const TOLERANCE: f64 = 0.2;

/// Returns the beams of a scan made at `pose` that look along the grid.
pub(super) fn beams(scan: &Scan, pose: Pose, pitch: f64) -> impl Iterator<Item = Beam> {
    let ranges = (0..).zip(&scan.ranges);
    let (ring, pose) = (scan.ring, pose);
    ranges.flat_map(move |(index, range)| {
        let range = *range;
        let unit = pose.heading.turned(ring.bearing(index)).unit();
        Direction::ALL.into_iter().filter_map(move |side| {
            let cosine = unit.dot(&heading_of(side).unit());
            let left = heading_of(side.left()).unit();
            (cosine > STRAIGHT && range.is_finite()).then(|| Beam {
                side,
                along: range * cosine,
                met: range < ring.max_range,
                slope: unit.dot(&left) / cosine,
                aside: (pose.position - nearest_middle(pose.position, pitch)).dot(&left),
            })
        })
    })
}

impl Beam {
    /// Returns whether the beam is well within its row of cells after `along` metres, so that it
    /// meets a wall across the row.
    pub(super) fn is_inside(&self, along: f64, pitch: f64) -> bool {
        (self.aside + along * self.slope).abs() < INTERIOR * pitch
    }
}

/// Returns the middle of a point's cell, also beyond the grid.
fn nearest_middle(point: Point, pitch: f64) -> Point {
    let middle = |along: f64| (libm::floor(along / pitch) + 0.5) * pitch;
    Point::new(middle(point.x), middle(point.y))
}

/// Returns the readings of the walls by a scan made at `pose`, seen from the cell with this
/// `middle`.
pub(super) fn rays(
    scan: &Scan,
    pose: Pose,
    middle: Point,
    config: &MazeMouseConfig,
) -> Vec<CellRay> {
    Direction::ALL
        .into_iter()
        .filter_map(|side| {
            let looking = beams(scan, pose, config.pitch).filter(|beam| beam.side == side);
            let straightest = looking.min_by(|a, b| a.slope.abs().total_cmp(&b.slope.abs()))?;
            let offset = (pose.position - middle).dot(&heading_of(side).unit());
            Some(ray(&straightest, offset, config))
        })
        .collect()
}

/// Returns the ray that a beam proves, if it begins `offset` metres beyond the middle of its cell.
fn ray(beam: &Beam, offset: f64, config: &MazeMouseConfig) -> CellRay {
    let pitch = config.pitch;
    let to_side = 0.5 * pitch - offset;
    // How far beyond the side of its cell, in cells, the wall stands that it met.
    let beyond = (beam.along + 0.5 * config.wall_thickness - to_side) / pitch;
    let line = libm::round(beyond);
    let at_wall = beam.met && (beyond - line).abs() < TOLERANCE && line >= 0.0;
    let passed = if at_wall {
        line
    } else {
        (libm::floor(beyond - TOLERANCE) + 1.0).max(0.0)
    };
    let inside = |lines: f64| beam.is_inside(to_side + lines * pitch, pitch);
    let mut open = 0;
    while f64::from(open) < passed && inside(f64::from(open)) {
        open += 1;
    }
    let ended = f64::from(open) < passed;
    if at_wall && !ended && inside(line) {
        CellRay::to_wall(beam.side, open)
    } else {
        CellRay::out_of_range(beam.side, open)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONFIG: MazeMouseConfig = MazeMouseConfig {
        pitch: 0.5,
        wall_thickness: 0.05,
        turn_per_step: 1.0,
        translate_per_step: 0.1,
    };

    #[test]
    fn a_beam_tells_of_walls_across_it_and_of_no_others() {
        let north = Direction::North;
        for (along, met, slope, expected) in [
            (0.225, true, 0.0, CellRay::to_wall(north, 0)),
            (0.725, true, 0.0, CellRay::to_wall(north, 1)),
            // Noise, and a range that ends nowhere near a wall.
            (0.76, true, 0.0, CellRay::to_wall(north, 1)),
            (0.5, true, 0.0, CellRay::out_of_range(north, 1)),
            // It reaches no farther.
            (0.725, false, 0.0, CellRay::out_of_range(north, 1)),
            (0.2, false, 0.0, CellRay::out_of_range(north, 0)),
            // Far away it meets the wall beside the corridor, or a post.
            (1.225, true, 0.1, CellRay::to_wall(north, 2)),
            (1.725, true, 0.14, CellRay::out_of_range(north, 2)),
        ] {
            let beam = Beam {
                side: north,
                along,
                met,
                slope,
                aside: 0.0,
            };
            assert_eq!(ray(&beam, 0.0, &CONFIG), expected, "{along} m");
        }
    }

    #[test]
    fn beams_across_the_grid_are_left_out() {
        let scan = Scan::clear(tolman_robot::Ring::full(72, 1.0));
        let pose = Pose::new(CONFIG.middle(Cell::new(2, 1)), heading_of(Direction::East));
        let beams: Vec<Beam> = beams(&scan, pose, CONFIG.pitch).collect();
        // 0° and 5° to both sides, four times.
        assert_eq!(beams.len(), 12);
        assert!(beams.iter().all(|beam| beam.slope.abs() < 0.09));
    }
}
