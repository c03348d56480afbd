use tolman_geom::Heading;
use tolman_robot::Scan;

use crate::TimeStep;

/// Robot unit in which MSLST measures: the diameter of the calibrated robot, m. Another robot's
/// lengths are scaled to it by [`for_robot`](super::Mslst::for_robot).
pub const ROBOT_UNIT: f64 = 0.5;

/// Returns a scan for MSLST's quantizer: in robot units, and turned by the compass to the nearest
/// beam. So "a particular location is distinct no matter which way the robot is facing".
///
/// Beam 0 looks north, the others follow counter-clockwise.
///
/// ```
/// use tolman_geom::Heading;
/// use tolman_robot::{Ring, Scan};
/// use tolman_systems::mslst::heading_free;
///
/// let mut scan = Scan::clear(Ring::full(72, 1.25));
/// scan.ranges[0] = 0.5;
/// let facing_west = heading_free(&scan, Heading::from_degrees(180.0));
/// assert_eq!((facing_west[18], facing_west[0]), (1.0, 2.5));
/// ```
#[must_use]
pub fn heading_free(scan: &Scan, heading: Heading) -> Vec<f64> {
    let ranges = scan.northward(heading).into_iter();
    ranges.map(|range| range / ROBOT_UNIT).collect()
}

/// Returns the quantizer's input in a time step; `None` while ranges or heading drop out.
pub(super) fn north_scan(seen: &TimeStep) -> Option<Vec<f64>> {
    Some(heading_free(seen.scan.as_ref()?, seen.heading?))
}
