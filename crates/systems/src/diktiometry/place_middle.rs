//! Computes the middle of a place from the walls and corners around the robot.

use core::f64::consts::FRAC_PI_2;

use tolman_geom::Heading;

use super::{Around, RoutineConfig};

/// Offset of the robot from the middle of a place, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    /// Too far ahead.
    pub(super) along: f64,
    /// Distance to the left of the middle, m.
    pub(super) aside: f64,
}

/// Angle on both sides of a direction within which a wall across it is searched, rad.
const WALL: f64 = 0.4;

/// Returns the robot's offset from the middle of a place, in the frame that looks `ahead`.
///
/// It uses only distances to walls and corners, which an error of the compass does not change. A
/// robot equally far from two corners stands between them.
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

/// Returns the offset of the robot towards the first of two opposite walls, m, from the ranges to
/// both. `sides` are, for each side, the ranges to its wall, its far and its near corner.
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
