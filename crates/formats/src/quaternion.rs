use tolman_geom::Heading;

/// Returns the heading on the floor of a body turned by a unit quaternion x, y, z, w. The body may
/// lean.
pub(crate) fn heading([x, y, z, w]: [f64; 4]) -> Heading {
    let yaw = libm::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
    Heading::from_radians(yaw)
}
