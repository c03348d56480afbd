use alloc::collections::BTreeMap;

use tolman_geom::Pose;

use super::messages::Transform;

/// Poses of a robot's parts relative to each other.
#[derive(Default)]
pub(super) struct Mounts {
    /// Parent of each part, with the part's pose relative to the parent.
    parents: BTreeMap<String, (String, Pose)>,
}

/// Maximum number of parents in a chain. A longer chain is a cycle.
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
