use alloc::collections::BTreeMap;

use tolman_geom::nalgebra::{Isometry3, Vector3};
use tolman_geom::{Heading, Point, Pose};

use super::message::{Times, Transform};

/// Poses of a robot's parts relative to each other, by `/tf` and `/tf_static`.
#[derive(Default)]
pub(super) struct Frames {
    /// Link from each part to its parent.
    links: BTreeMap<String, Link>,
}

/// A part's poses relative to its parent.
struct Link {
    parent: String,
    poses: Vec<(Times, Isometry3<f64>)>,
}

/// Pose of a laser on its robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mount {
    pub(super) robot_from_laser: Pose,
    /// Cosine of the angle between the laser's axis and the vertical: −1 if it hangs upside down.
    pub(super) upright: f64,
}

/// Maximum number of parents in a chain. A longer chain is a cycle.
const MOST: usize = 32;

/// Distance, m, and turn, rad, above which a part moves.
const MOVES: f64 = 0.1;

impl Frames {
    pub(super) fn add(&mut self, transform: Transform, received: f64) {
        let Transform {
            header,
            child,
            pose,
        } = transform;
        if !pose.to_homogeneous().iter().all(|part| part.is_finite()) {
            return;
        }
        let times = Times {
            header: header.time,
            received,
        };
        let link = self.links.entry(child).or_insert_with(|| Link {
            parent: header.frame.clone(),
            poses: Vec::new(),
        });
        // A part that gets another parent keeps the first.
        let is_still = link.poses.last().is_some_and(|(_, last)| *last == pose);
        if link.parent == header.frame && !(is_still && link.poses.len() == 1) {
            link.poses.push((times, pose));
        }
    }

    /// Returns the part's ancestors, the part first, with the pose of the part on each.
    fn ancestors(&self, part: &str) -> Vec<(&str, Isometry3<f64>)> {
        let mut pose = Isometry3::identity();
        let mut ancestors: Vec<(&str, Isometry3<f64>)> = Vec::new();
        let mut part = self
            .links
            .get_key_value(part)
            .map(|(name, _)| name.as_str());
        while let (Some(name), true) = (part, ancestors.len() < MOST) {
            ancestors.push((name, pose));
            part = self.links.get(name).and_then(|link| {
                let (_, on_parent) = link.poses.last()?;
                pose = on_parent * pose;
                Some(link.parent.as_str())
            });
        }
        ancestors
    }

    /// Returns the pose of the laser `part` on the part `base`, or `None` if no transforms join
    /// them.
    pub(super) fn mount(&self, base: &str, part: &str) -> Option<Mount> {
        if base == part {
            return Some(Mount::of(&Isometry3::identity()));
        }
        let of_part = self.ancestors(part);
        let of_base = self.ancestors(base);
        let mut joined = of_part.iter().filter_map(|(ancestor, pose)| {
            let is_it = |(other, _): &&(&str, Isometry3<f64>)| other == ancestor;
            let (_, base) = of_base.iter().find(is_it)?;
            Some(base.inverse() * pose)
        });
        let through = joined.next();
        let alone = of_part.iter().find(|(ancestor, _)| *ancestor == base);
        through
            .or(alone.map(|(_, pose)| *pose))
            .map(|pose| Mount::of(&pose))
    }

    /// Returns the robot that carries the laser `part`, and the robot's poses in the frame in which
    /// it moves: the first moving link above the laser.
    pub(super) fn odometry(&self, part: &str) -> Option<(&str, Vec<(Times, Pose)>)> {
        self.ancestors(part).into_iter().find_map(|(base, _)| {
            let link = self.links.get(base)?;
            let poses = link.poses.iter();
            let poses: Vec<(Times, Pose)> = poses.map(|(at, pose)| (*at, on_floor(pose))).collect();
            moves(poses.iter().map(|(_, pose)| pose)).then_some((base, poses))
        })
    }
}

impl Mount {
    fn of(pose: &Isometry3<f64>) -> Self {
        Self {
            robot_from_laser: on_floor(pose),
            upright: (pose.rotation * Vector3::z()).z,
        }
    }
}

/// Returns the pose on the floor of a pose in space: its position, and where its x axis points.
pub(super) fn on_floor(pose: &Isometry3<f64>) -> Pose {
    let ahead = pose.rotation * Vector3::x();
    let at = pose.translation.vector;
    let heading = Heading::from_radians(libm::atan2(ahead.y, ahead.x));
    Pose::new(Point::new(at.x, at.y), heading)
}

/// Returns whether any pose lies more than 0.1 m or 0.1 rad from the first.
pub(super) fn moves<'a>(mut poses: impl Iterator<Item = &'a Pose>) -> bool {
    let Some(first) = poses.next() else {
        return false;
    };
    poses.any(|pose| {
        let step = first.between(*pose);
        step.position.coords.norm() > MOVES || step.heading.radians().abs() > MOVES
    })
}
