use tolman_geom::{Interval, PointBox};

use super::{Action, Config, Diktiometry, FrameId, Move, PlaceId, Track};

/// Where a track would be after a move, before anything is recognized: the projector "predicts new states given old state
/// estimates and control inputs".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Projection {
    /// The place that was left.
    pub(super) from: PlaceId,
    pub(super) action: Action,
    /// The frame of the place that was left.
    pub(super) frame: FrameId,
    /// The displacement between the points of the two places, m.
    pub(super) displacement: PointBox,
    /// The point of the place arrived at, in the frame, m.
    pub(super) position: PointBox,
    /// Distance since the last CONTINUE, m.
    pub(super) astray: f64,
}

pub(super) fn project(
    map: &Diktiometry,
    track: &Track,
    step: &Move,
    config: &Config,
) -> Projection {
    let (frame, position) = map.site(track.place);
    let displacement = between_places(step.odometry.position, config);
    Projection {
        from: track.place,
        action: step.action,
        frame,
        displacement,
        position: position + displacement,
        astray: track.astray + displacement.norm().middle(),
    }
}

/// The robot's displacement is the places' up to where in the places it stopped.
pub(super) fn between_places(robot: PointBox, config: &Config) -> PointBox {
    let Ok(stops) = Interval::about(0.0, 2.0 * config.place_radius) else {
        return robot; // Its radius was checked to be a number, and not negative.
    };
    robot + PointBox::new(stops, stops)
}
