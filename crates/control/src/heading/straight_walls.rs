use alloc::vec::Vec;
use core::ops::Range;

use tolman_geom::Vector;
use tolman_robot::Scan;

/// The direction of a straight wall in a robot's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StraightWall {
    /// Bearing along the wall, either way, rad.
    pub(super) along: f64,
    /// Variance of the bearing, rad².
    pub(super) variance: f64,
}

/// Standard deviation of a range, as a share of it: that of a laser that errs by 2 %.
const RANGE_SD: f64 = 0.02;
/// Maximum distance of a beam's end from a straight wall, in standard deviations of its range.
const OFF: f64 = 2.5;
/// Minimum number of beams on a straight wall: two points are always on one, and three by chance.
const FEWEST: usize = 5;

/// Returns the straight walls that the beams show together: runs of neighbouring ends near one
/// line. O(beams · log beams).
///
/// Source: T. Pavlidis and S. L. Horowitz, *Segmentation of Plane Curves*, 1974 (split); the line
/// of a run is that of total least squares.
pub(super) fn straight_walls(scan: &Scan) -> Vec<StraightWall> {
    let beams = scan.ranges.len();
    let mut ends: Vec<Option<End>> = (0..)
        .zip(&scan.ranges)
        .map(|beam| end(scan, beam))
        .collect();
    // A full ring goes on from its last beam to its first. It begins where no wall goes on: at a
    // beam that met nothing, else at the farthest corner.
    let farthest = (0..beams).max_by(|a, b| scan.ranges[*a].total_cmp(&scan.ranges[*b]));
    ends.rotate_left(farthest.unwrap_or(0));
    let mut walls = Vec::new();
    let mut first = 0;
    for beam in 0..=beams {
        if ends.get(beam).is_none_or(Option::is_none) {
            let run: Vec<End> = ends[first..beam].iter().flatten().copied().collect();
            split(&run, 0..run.len(), &mut walls);
            first = beam + 1;
        }
    }
    walls
}

/// Where a beam ends.
#[derive(Clone, Copy)]
struct End {
    at: Vector,
    /// Standard deviation of the range, m.
    sd: f64,
}

/// Returns the end of a beam; `None` if it met nothing.
fn end(scan: &Scan, (beam, range): (u32, &f64)) -> Option<End> {
    let bearing = scan.ring.bearing(beam);
    let unit = Vector::new(libm::cos(bearing), libm::sin(bearing));
    (*range > 0.0 && *range < scan.ring.max_range).then(|| End {
        at: unit * *range,
        sd: RANGE_SD * range,
    })
}

/// Adds the straight walls of a run of ends: splits it at the end farthest from its line until all
/// are near it.
fn split(ends: &[End], run: Range<usize>, walls: &mut Vec<StraightWall>) {
    if run.len() < FEWEST {
        return;
    }
    let (first, last) = (ends[run.start].at, ends[run.end - 1].at);
    let chord = last - first;
    let off = |index: &usize| {
        let end = ends[*index];
        let across = chord.perp(&(end.at - first)).abs() / chord.norm().max(f64::MIN_POSITIVE);
        across / end.sd
    };
    let farthest = run.clone().max_by(|a, b| off(a).total_cmp(&off(b)));
    match farthest.filter(|index| off(index) > OFF) {
        Some(corner) => {
            split(ends, run.start..corner, walls);
            split(ends, corner..run.end, walls);
        }
        None => walls.extend(line(&ends[run])),
    }
}

/// Returns the line of total least squares through ends; `None` if they are one point.
fn line(ends: &[End]) -> Option<StraightWall> {
    let count = ends.len() as f64;
    let middle = ends.iter().map(|end| end.at).sum::<Vector>() / count;
    let [mut xx, mut xy, mut yy, mut noise] = [0.0; 4];
    for end in ends {
        let off = end.at - middle;
        xx += off.x * off.x;
        xy += off.x * off.y;
        yy += off.y * off.y;
        noise += end.sd * end.sd / count;
    }
    let along = 0.5 * libm::atan2(2.0 * xy, xx - yy);
    let spread = 0.5 * (xx + yy + libm::hypot(xx - yy, 2.0 * xy));
    (spread > 0.0).then(|| StraightWall {
        along,
        variance: noise / spread,
    })
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_2;

    use tolman_geom::{Heading, Point, Pose};
    use tolman_robot::Ring;

    use super::*;
    use crate::heading::tests::{room, scan};

    #[test]
    fn a_room_has_four_straight_walls() {
        for degrees in [0.0, 20.0, 45.0, 77.0, 170.0] {
            let pose = Pose::new(Point::new(0.1, -0.05), Heading::from_degrees(degrees));
            let walls = straight_walls(&scan(&room(), pose));
            assert!(walls.len() >= 4, "{degrees}: {walls:?}");
            for wall in walls {
                let turned = wall.along + degrees.to_radians();
                let off = libm::remainder(turned, FRAC_PI_2);
                assert!(off * off < 9.0 * wall.variance, "{degrees}: {off} {wall:?}");
            }
        }
    }

    #[test]
    fn what_is_round_has_no_straight_wall_that_is_sure() {
        let mut round = Scan::clear(Ring::full(72, 1.25));
        round.ranges.fill(0.5);
        for wall in straight_walls(&round) {
            assert!(libm::sqrt(wall.variance) > 0.03, "{wall:?}");
        }
        assert!(straight_walls(&Scan::clear(Ring::full(72, 1.25))).is_empty());
        let none = Scan {
            ring: Ring::full(0, 1.0),
            ranges: Vec::new(),
        };
        assert!(straight_walls(&none).is_empty());
    }
}
