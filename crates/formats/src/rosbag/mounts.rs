use alloc::collections::BTreeMap;

use tolman_geom::Pose;

use super::messages::Transform;

/// Poses of a robot's parts on each other.
#[derive(Default)]
pub(super) struct Mounts {
    /// For each part, the part that it sits on, and its pose there.
    parents: BTreeMap<String, (String, Pose)>,
}

/// Parts that one sits on, one above the other; more are a circle.
const MOST: usize = 32;

impl Mounts {
    pub(super) fn extend(&mut self, transforms: Vec<Transform>) {
        for transform in transforms {
            let pose = transform.pose();
            if pose.is_finite() {
                let parent = transform.header.frame_id;
                self.parents
                    .insert(transform.child_frame_id, (parent, pose));
            }
        }
    }

    /// Returns the pose of `part` on `base`, or `None` if no chain of transforms joins them.
    pub(super) fn of(&self, base: &str, part: &str) -> Option<Pose> {
        let (mut pose, mut part) = (Pose::IDENTITY, part);
        for _ in 0..MOST {
            if part == base {
                return Some(pose);
            }
            let (parent, on_parent) = self.parents.get(part)?;
            pose = on_parent.compose(pose);
            part = parent;
        }
        None
    }
}
