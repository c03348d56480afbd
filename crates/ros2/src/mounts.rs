use std::collections::BTreeMap;

use tolman_geom::nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use tolman_geom::{Heading, Point, Pose};

use crate::messages::TransformStamped;

/// Where the robot's parts are mounted, by `/tf_static`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mounts {
    /// Parent of each part, and the part's pose on it.
    parts: BTreeMap<String, (String, Isometry3<f64>)>,
}

/// Where a laser is mounted on its robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mount {
    pub(crate) robot_from_laser: Pose,
    pub(crate) is_upside_down: bool,
}

impl Mounts {
    /// Takes in a part's pose on its parent.
    pub(crate) fn add(&mut self, transform: &TransformStamped) {
        let (at, turn) = (transform.translation, transform.rotation);
        let rotation = Quaternion::new(turn.w, turn.x, turn.y, turn.z);
        let pose = Isometry3::from_parts(
            Translation3::new(at.x, at.y, at.z),
            UnitQuaternion::from_quaternion(rotation),
        );
        let is_finite = pose.to_homogeneous().iter().all(|part| part.is_finite());
        if is_finite {
            let parent = bare(&transform.header.frame_id).to_owned();
            let child = bare(&transform.child_frame_id).to_owned();
            self.parts.insert(child, (parent, pose));
        }
    }

    /// Returns where `laser` is mounted on `base`; `None` if no transforms lead there.
    pub(crate) fn of(&self, laser: &str, base: &str) -> Option<Mount> {
        let (mut part, base) = (bare(laser), bare(base));
        let mut pose = Isometry3::identity();
        // More links than parts are a cycle.
        for _ in 0..=self.parts.len() {
            if part == base {
                return Some(Mount::on_floor(&pose));
            }
            let (parent, on_parent) = self.parts.get(part)?;
            pose = on_parent * pose;
            part = parent;
        }
        None
    }
}

impl Mount {
    fn on_floor(pose: &Isometry3<f64>) -> Self {
        let ahead = pose.rotation * Vector3::x();
        let at = pose.translation.vector;
        Self {
            robot_from_laser: Pose::new(
                Point::new(at.x, at.y),
                Heading::from_radians(ahead.y.atan2(ahead.x)),
            ),
            is_upside_down: (pose.rotation * Vector3::z()).z < 0.0,
        }
    }
}

/// Returns a frame's name without the leading slash of former times.
fn bare(frame: &str) -> &str {
    frame.trim_start_matches('/')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::messages::{Header, Quaternion, Vector3};

    fn link(parent: &str, child: &str, x: f64, rotation: Quaternion) -> TransformStamped {
        TransformStamped {
            header: Header {
                frame_id: parent.to_owned(),
                ..Header::default()
            },
            child_frame_id: child.to_owned(),
            translation: Vector3 { x, y: 0.0, z: 0.1 },
            rotation,
        }
    }

    #[test]
    fn a_laser_is_found_through_a_chain() -> Result<(), &'static str> {
        let rolled = Quaternion {
            x: 1.0,
            y: 0.0,
            z: 0.0,
            w: 0.0,
        };
        let mut mounts = Mounts::default();
        mounts.add(&link(
            "base_footprint",
            "base_link",
            0.01,
            Quaternion::default(),
        ));
        mounts.add(&link("/base_link", "base_scan", -0.03, rolled));
        let mount = mounts.of("base_scan", "base_footprint").ok_or("no mount")?;
        assert!((mount.robot_from_laser.position.x + 0.02).abs() < 1e-12);
        assert!(mount.is_upside_down);
        assert_eq!(mounts.of("camera", "base_footprint"), None);
        Ok(())
    }

    #[test]
    fn a_cycle_ends() {
        let mut mounts = Mounts::default();
        mounts.add(&link("a", "b", 0.0, Quaternion::default()));
        mounts.add(&link("b", "a", 0.0, Quaternion::default()));
        assert_eq!(mounts.of("a", "base"), None);
    }
}
