//! Finds the pose of another map of the same building on this one, without prior knowledge.

use alloc::vec::Vec;
use core::f64::consts::FRAC_PI_2;

use tolman_geom::nalgebra::{Matrix3, Vector3};
use tolman_geom::{Heading, Point, Pose};

use super::ScanMatching;
use super::correlate::{self, Pyramid, Window};
use super::grid::LikelihoodGrid;
use super::outline::ScanOutline;
use super::refine::{self, Prior};

/// Placement of one map on another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapOverlay {
    /// Pose of the other map's origin on this one.
    pub pose: Pose,
    /// Mean likelihood of the other map's points on this one's surfaces, 0 to 1.
    pub score: f64,
    /// Score of the best overlay at another pose; 0 if there is none. If it is near `score`, the
    /// overlay is ambiguous.
    pub rival: f64,
}

/// Number of stretches of the other map that are searched for, one by one.
const STRETCHES: usize = 8;
/// Number of keyframes to either side of a stretch's middle.
const HALF: usize = 15;
/// Number of points of a stretch that is placed, and of the whole map that is compared with this
/// one.
const SEARCHED_POINTS: usize = 150;
const REFINED_POINTS: usize = 1500;
/// Standard deviation of the axes of buildings, rad.
const AXIS_TURN: f64 = 0.07;
/// Distance below which two overlays are one, m and rad.
const SAME: (f64, f64) = (1.0, 0.1);

impl ScanMatching {
    /// Returns the pose on this map of `other`, a map of the same building; `None` if a map is
    /// empty. Stretches of its way are placed anywhere and turned by any quarter, since both
    /// buildings' axes are known. The placement is kept on which the whole map fits best.
    ///
    /// O(stretches · cells of the grid), by branch and bound.
    #[must_use]
    pub fn overlay(&self, other: &Self) -> Option<MapOverlay> {
        let axes = other.axis()?.turn_to(self.axis()?);
        let grid = self.whole_grid();
        let (middle, reach) = self.extent()?;
        let pyramid = Pyramid::of(&grid, reach);
        let all = other.put_together(0, other.keyframes.len() - 1, 0);
        let all = all.thinned(REFINED_POINTS);
        let origin = other.graph.poses()[0];
        let window = Window {
            reach,
            turn: AXIS_TURN,
            prior: 0.0,
            prior_turn: 0.0,
        };
        let mut found: Vec<MapOverlay> = Vec::new();
        for stretch in other.middles() {
            let last = (stretch + HALF).min(other.keyframes.len() - 1);
            let outline = other.put_together(stretch.saturating_sub(HALF), last, stretch);
            let outline = outline.thinned(SEARCHED_POINTS);
            let pose = other.graph.poses()[stretch];
            for quarter in 0..4 {
                let turned = axes + f64::from(quarter) * FRAC_PI_2;
                let expected = Pose::new(middle, pose.heading.turned(turned));
                let lies = correlate::best(&grid, &pyramid, &outline, expected, window);
                let lies = lies.map(|lies| lies.compose(pose.between(origin)));
                found.extend(lies.map(|start| self.weigh_overlay(&grid, &all, start)));
            }
        }
        found.sort_by(|a, b| b.score.total_cmp(&a.score));
        let best = *found.first()?;
        let elsewhere = found.iter().find(|other| !is_same(best.pose, other.pose));
        Some(MapOverlay {
            pose: best.pose.compose(origin.inverse()),
            rival: elsewhere.map_or(0.0, |other| other.score),
            ..best
        })
    }

    /// Returns the overlay of a whole map's outline from a nearby pose, with its score.
    fn weigh_overlay(&self, grid: &LikelihoodGrid, all: &ScanOutline, start: Pose) -> MapOverlay {
        let prior = Prior {
            pose: start,
            information: Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 100.0)),
        };
        let refined = refine::refine(grid, all, start, &prior, self.config.kernel);
        MapOverlay {
            pose: refined.pose,
            score: refined.score,
            rival: 0.0,
        }
    }

    /// Returns a grid of everything that the map has seen.
    fn whole_grid(&self) -> LikelihoodGrid {
        let mut grid = LikelihoodGrid::default();
        let outlines = self.keyframes.iter().map(|keyframe| &keyframe.outline);
        let seen = outlines.zip(self.graph.poses().iter().copied());
        grid.draw(&self.stamp, seen, 0.0);
        grid
    }

    /// Returns the middle of the robot's way, and how far it reaches from there along an axis, m.
    fn extent(&self) -> Option<(Point, f64)> {
        let mut points = self.graph.poses().iter().map(|pose| pose.position);
        let first = points.next()?;
        let (low, high) = points.fold((first, first), |(low, high), point| {
            (low.inf(&point), high.sup(&point))
        });
        let half = (high - low) * 0.5;
        Some((low + half, half.max()))
    }

    /// Returns the middles of stretches, evenly along the way.
    fn middles(&self) -> impl Iterator<Item = usize> {
        let count = self.keyframes.len();
        let every = count.div_ceil(STRETCHES).max(1);
        (every / 2..count).step_by(every)
    }
}

fn is_same(one: Pose, other: Pose) -> bool {
    let off = one.between(other);
    off.position.coords.norm() < SAME.0 && Heading::radians(off.heading).abs() < SAME.1
}
