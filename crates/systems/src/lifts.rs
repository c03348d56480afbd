//! Signs that a robot was carried: two scans that cannot be of one place.

use tolman_geom::{Heading, Vector};
use tolman_robot::Scan;

/// Distance by which a wall has to be nearer than an earlier clear beam, m: errors of ranges and
/// wheels stay below it.
const NEARER: f64 = 0.3;

/// [`contradiction`] above which the robot was carried.
pub(crate) const CONTRADICTING: f64 = 0.2;

/// Returns the share of the beams of one scan that end where the other sees through, for the scan
/// with more of them. `moved` leads from where the robot was at `before` to where it is `now`, m.
/// O(beams).
pub(crate) fn contradiction(now: (&Scan, Heading), before: (&Scan, Heading), moved: Vector) -> f64 {
    contradicting(now, before, moved).max(contradicting(before, now, -moved))
}

/// Returns the share of the beams of one scan that end where the other sees through. `offset` leads
/// from the other's position to the one's.
fn contradicting(one: (&Scan, Heading), other: (&Scan, Heading), offset: Vector) -> f64 {
    let (scan, heading) = one;
    let ends = (0..)
        .zip(&scan.ranges)
        .filter(|(_, range)| **range < scan.ring.max_range);
    let beams = scan.ranges.len().max(1) as f64;
    let contradict = ends.filter(|(beam, range)| {
        let end = offset + heading.turned(scan.ring.bearing(*beam)).unit() * **range;
        sees_through(other, end)
    });
    contradict.count() as f64 / beams
}

/// Returns whether all beams near the direction of a point reach beyond it. The point is relative
/// to the scan's position.
fn sees_through((scan, heading): (&Scan, Heading), at: Vector) -> bool {
    let bearing = heading.turn_to(Heading::of(at));
    [-1, 0, 1].into_iter().all(|beside| {
        let range = scan.range_towards(bearing, beside);
        range.is_some_and(|range| range > at.norm() + NEARER)
    })
}
