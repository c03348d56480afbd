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

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use tolman_geom::{Heading, Point};

    use super::super::grid::Stamp;
    use super::*;

    const KERNEL: f64 = 0.1;

    /// Returns a corner: a wall ahead and one to the left.
    fn corner() -> ScanOutline {
        let ahead = (-50..50).map(|step| (Point::new(2.0, 0.02 * f64::from(step)), Vector::x()));
        let left = (0..75).map(|step| (Point::new(0.02 * f64::from(step), 1.0), Vector::y()));
        let points = ahead.chain(left).map(|(at, normal)| SurfacePoint {
            at,
            normal,
            goes_on: false,
        });
        ScanOutline {
            points: points.collect::<Vec<_>>(),
        }
    }

    fn drawn(outline: &ScanOutline) -> LikelihoodGrid {
        let mut grid = LikelihoodGrid::default();
        let stamp = Stamp::new(0.01, KERNEL);
        grid.draw(&stamp, [(outline, Pose::IDENTITY)].into_iter(), 1.0);
        grid
    }

    fn prior(pose: Pose, weight: f64) -> Prior {
        Prior {
            pose,
            information: Matrix3::identity() * weight,
        }
    }

    fn start() -> Pose {
        Pose::new(Point::new(0.05, -0.03), Heading::from_radians(0.02))
    }

    /// Refines the start on the corner, with a prior of this weight.
    fn at_rest(weight: f64) -> Refined {
        let outline = corner();
        let prior = prior(start(), weight);
        refine(&drawn(&outline), &outline, start(), &prior, KERNEL)
    }

    #[test]
    fn the_pose_comes_to_rest_where_the_outline_was_drawn() {
        let found = at_rest(1e-3);
        let off = difference(Pose::IDENTITY, found.pose);
        assert!(off.norm() < 5e-3, "{off}");
        assert!(found.score > 0.97 && found.score <= 1.0, "{}", found.score);
    }

    #[test]
    fn a_sure_prior_is_kept() {
        let found = at_rest(1e9);
        assert!(difference(start(), found.pose).norm() < 1e-5);
    }

    /// The search as its definition says, without any step that is too long.
    #[test]
    fn the_search_ends_at_the_first_small_step() {
        let outline = corner();
        let (grid, prior) = (drawn(&outline), prior(start(), 1e5));
        let mut pose = start();
        let mut values = Vec::new();
        for _ in 0..STEPS {
            let here = local(&grid, &outline, pose, KERNEL);
            let off = difference(prior.pose, pose);
            values.push(INDEPENDENT * here.sum - 0.5 * off.dot(&(prior.information * off)));
            let curvature = here.curvature * (INDEPENDENT / (KERNEL * KERNEL)) + prior.information;
            let uphill = here.uphill * INDEPENDENT - prior.information * off;
            let step = curvature.try_inverse().unwrap() * uphill;
            if step.norm() < SMALL {
                break;
            }
            pose = moved(pose, &step);
        }
        assert!(values.is_sorted(), "a step was too long: {values:?}");
        assert!((2..STEPS as usize).contains(&values.len()), "{values:?}");
        let found = refine(&grid, &outline, start(), &prior, KERNEL);
        let off = difference(pose, found.pose);
        assert!(off.norm() < 1e-12, "{off}");
    }

    #[test]
    fn the_information_is_that_of_points_across_their_surfaces() {
        let outline = corner();
        let grid = drawn(&outline);
        let found = refine(
            &grid,
            &outline,
            Pose::IDENTITY,
            &prior(Pose::IDENTITY, 1e9),
            KERNEL,
        );
        let mut expected = Matrix3::zeros();
        let mut sum = 0.0;
        for SurfacePoint { at, normal, .. } in &outline.points {
            let value = grid.slope(*at).0;
            let turning = normal.y * at.x - normal.x * at.y;
            let across = Vector3::new(normal.x, normal.y, turning);
            expected += across * across.transpose() * (value * INDEPENDENT / (KERNEL * KERNEL));
            sum += value;
        }
        let off = (found.information - expected).abs().max();
        assert!(off < 1e-3 * expected.abs().max(), "{off}");
        let mean = sum / outline.points.len() as f64;
        assert!((found.score - mean).abs() < 1e-6, "{}", found.score);
    }

    #[test]
    fn a_point_without_a_normal_tells_half_along_both_axes() {
        let mut outline = corner();
        outline.points.truncate(1);
        outline.points[0].normal = Vector::zeros();
        let grid = drawn(&outline);
        let found = local(&grid, &outline, Pose::IDENTITY, KERNEL);
        let at = outline.points[0].at;
        let [x, y] = [Vector3::new(1.0, 0.0, -at.y), Vector3::new(0.0, 1.0, at.x)];
        let expected = (x * x.transpose() + y * y.transpose()) * (0.5 * found.sum);
        assert!((found.curvature - expected).abs().max() < 1e-12);
        assert!((0.9..=1.0).contains(&found.sum));
    }
}
