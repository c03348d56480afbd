//! Lines of graphs in space, as far as these lie in the plane.

use tolman_geom::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use tolman_geom::{Heading, Point, Pose};

use super::line::{Entry, ends, exactly, id, numbers, row_by_row};
use super::{G2oEdge, G2oFaultKind};

pub(super) const POSE: &str = "VERTEX_SE3:QUAT";
pub(super) const EDGE: &str = "EDGE_SE3:QUAT";

/// Greatest height, m, of what lies in the plane, and greatest lean, rad.
const HEIGHT: f64 = 0.05;
const LEAN: f64 = 0.02;

pub(super) fn pose(words: &[&str]) -> Result<Entry, G2oFaultKind> {
    let [named, at @ ..] = exactly::<8>(POSE, words)?;
    let id = id(named)?;
    Ok(Entry::Pose(id, planar(numbers(at)?, f64::INFINITY)?))
}

pub(super) fn edge(line: usize, words: &[&str]) -> Result<Entry, G2oFaultKind> {
    let [from, to, x, y, z, qx, qy, qz, qw, information @ ..] = exactly::<30>(EDGE, words)?;
    let (from, to) = ends(from, to)?;
    let measured = planar(numbers([x, y, z, qx, qy, qz, qw])?, HEIGHT)?;
    // Row by row, of x, y, z and the turns about them: those of x, y and the turn about z.
    let [xx, xy, _, _, _, xt, yy, _, _, _, yt, .., tt] = numbers::<21>(information)?;
    Ok(Entry::Edge(G2oEdge {
        from,
        to,
        measured,
        information: row_by_row([xx, xy, xt, yy, yt, tt])?,
        line,
    }))
}

/// Returns the pose on the floor of a pose in space that is level and at most `highest` m high.
fn planar([x, y, z, q @ ..]: [f64; 7], highest: f64) -> Result<Pose, G2oFaultKind> {
    let not = |why| Err(G2oFaultKind::NotPlanar { why });
    let [qx, qy, qz, qw] = q;
    let turned = Quaternion::new(qw, qx, qy, qz);
    if turned.norm() < 1e-6 {
        return not("its orientation is no rotation");
    }
    let turned = UnitQuaternion::new_normalize(turned);
    if (turned * Vector3::z()).xy().norm() > LEAN {
        return not("it leans");
    }
    if z.abs() > highest {
        return not("it leads up or down");
    }
    let ahead = turned * Vector3::x();
    let heading = Heading::from_radians(libm::atan2(ahead.y, ahead.x));
    Ok(Pose::new(Point::new(x, y), heading))
}
