//! Refines the pose from the best cell: Newton's steps up the likelihood of all points.

use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Pose, Vector};

use super::grid::LikelihoodGrid;
use super::outline::{ScanOutline, SurfacePoint};
use crate::tangent::{difference, moved};

/// Refined pose of an outline on a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refined {
    pub(super) pose: Pose,
    /// Mean likelihood of the points, 0 … 1.
    pub(super) score: f64,
    /// Information of the points alone on the pose: ahead, left, heading.
    pub(super) information: Matrix3<f64>,
}

/// Prior knowledge of the pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prior {
    pub(super) pose: Pose,
    pub(super) information: Matrix3<f64>,
}

/// Maximum number of Newton's steps.
const STEPS: u32 = 12;
/// Size of a step at which the search ends, m and rad.
const SMALL: f64 = 1e-5;
/// Weight of each point of a scan relative to an independent one: points of one scan err together.
const INDEPENDENT: f64 = 0.1;

/// Sum of the points' likelihoods near a pose, to second order.
struct Local {
    sum: f64,
    uphill: Vector3<f64>,
    curvature: Matrix3<f64>,
}

/// Returns the pose near `start` at which the outline fits the grid best, whose surfaces are
/// `kernel` wide, m. O(points).
pub(super) fn refine(
    grid: &LikelihoodGrid,
    outline: &ScanOutline,
    start: Pose,
    prior: &Prior,
    kernel: f64,
) -> Refined {
    let mut pose = start;
    let mut best: Option<(f64, Pose)> = None;
    let weight = INDEPENDENT / (kernel * kernel);
    for _ in 0..STEPS {
        let local = local(grid, outline, pose, kernel);
        let off = difference(prior.pose, pose);
        let value = INDEPENDENT * local.sum - 0.5 * (prior.information * off).dot(&off);
        match best {
            // The step was too long; half of it is tried.
            Some((before, there)) if value < before => {
                let back = difference(there, pose) * 0.5;
                if back.norm() < SMALL {
                    break;
                }
                pose = moved(there, &back);
                continue;
            }
            _ => best = Some((value, pose)),
        }
        let uphill = local.uphill * INDEPENDENT - prior.information * off;
        let curvature = local.curvature * weight + prior.information;
        let Some(inverse) = curvature.try_inverse() else {
            break;
        };
        let step = inverse * uphill;
        pose = moved(pose, &step);
        if step.norm() < SMALL {
            break;
        }
    }
    let pose = best.map_or(start, |(_, pose)| pose);
    let local = local_about(grid, outline, pose, kernel);
    Refined {
        pose,
        score: local.sum / outline.points.len().max(1) as f64,
        information: local.curvature * weight,
    }
}

fn local_about(grid: &LikelihoodGrid, outline: &ScanOutline, pose: Pose, kernel: f64) -> Local {
    local(grid, outline, pose, kernel)
}

fn local(grid: &LikelihoodGrid, outline: &ScanOutline, pose: Pose, kernel: f64) -> Local {
    let mut local = Local {
        sum: 0.0,
        uphill: Vector3::zeros(),
        curvature: Matrix3::zeros(),
    };
    let back = tolman_geom::Heading::from_radians(-pose.heading.radians());
    let _ = kernel;
    for point in &outline.points {
        let (value, slope) = grid.slope(pose.transform(point.at));
        if value <= 0.0 {
            continue;
        }
        local.sum += value;
        let slope = back.rotate(slope);
        local.uphill += by_pose(point, slope);
        if point.normal == Vector::zeros() {
            for axis in [Vector::x(), Vector::y()] {
                let across = by_pose(point, axis);
                local.curvature += across * across.transpose() * (0.5 * value);
            }
        } else {
            let across = by_pose(point, point.normal);
            local.curvature += across * across.transpose() * value;
        }
    }
    local
}

/// Returns the derivative of a point's coordinate along `direction` by the robot's motion: ahead,
/// left, turn.
fn by_pose(point: &SurfacePoint, direction: Vector) -> Vector3<f64> {
    let turning = Vector::new(-point.at.y, point.at.x);
    Vector3::new(direction.x, direction.y, direction.dot(&turning))
}
