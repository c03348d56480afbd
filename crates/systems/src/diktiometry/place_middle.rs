//! Where the middle of a place is, as far as walls and corners around the robot tell.

use core::f64::consts::FRAC_PI_2;

use tolman_geom::Heading;

use super::{Around, RoutineConfig};

/// How far the robot stands from the middle of a place, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    /// Too far ahead.
    pub(super) along: f64,
    /// Too far to the left.
    pub(super) aside: f64,
}

/// How far to both sides of a direction a wall across it is looked for, rad.
const WALL: f64 = 0.4;

/// Returns how far a robot stands from the middle of a place for someone who looks `ahead`.
///
/// Only distances to walls and corners are used, which no error of the compass changes: two corners
/// that are equally far say that one stands between them.
pub(super) fn offset(around: Around<'_>, ahead: Heading, gauge: &RoutineConfig) -> Offset {
    let nearest =
        |quarters: f64, spread: f64| around.nearest(ahead.turned(quarters * FRAC_PI_2), spread);
    let [front, left, back, right] = [0.0, 1.0, 2.0, 3.0].map(|quarter| nearest(quarter, WALL));
    let [front_left, back_left, back_right, front_right] =
        [0.5, 1.5, 2.5, 3.5].map(|quarter| nearest(quarter, 0.5 * FRAC_PI_2));
    let beside = [
        (left, back_left, front_left),
        (right, back_right, front_right),
    ];
    let across = [
        (front, front_right, front_left),
        (back, back_right, back_left),
    ];
    Offset {
        along: axis(gauge, [front, back], beside),
        aside: axis(gauge, [left, right], across),
    }
}

/// Returns how far the robot stands towards the first of two opposite walls, from the ranges to
/// both. Of each side it takes the range to its wall and to its far and near corner.
fn axis(gauge: &RoutineConfig, [plus, minus]: [f64; 2], sides: [(f64, f64, f64); 2]) -> f64 {
    let half = gauge.half();
    // Where both ends of an axis are open, the corners beside an open side tell; a doorway has
    // none.
    let between = |far: f64, near: f64| (far * far - near * near) / (4.0 * half);
    let offset = match (gauge.is_closed(plus), gauge.is_closed(minus)) {
        (true, true) => 0.5 * (minus - plus),
        (true, false) => half - plus,
        (false, true) => minus - half,
        (false, false) => {
            let mut open = Vec::from(sides);
            open.retain(|(side, ..)| !gauge.is_closed(*side));
            let all = open.iter().map(|(_, far, near)| between(*far, *near));
            all.sum::<f64>() / open.len().max(1) as f64
        }
    };
    offset.clamp(-0.5 * half, 0.5 * half)
}
