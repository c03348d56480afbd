use tolman_geom::{Interval, Point, PointBox};

use super::{Action, CompassAxis, Config, FrameId, ObservedMove, Observer, PlaceId, Track};

/// Predicted position of a track after a move, before anything is recognized: the projector
/// "predicts new states given old state estimates and control inputs".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Projection {
    /// Place that was left.
    pub(super) from: PlaceId,
    pub(super) action: Action,
    /// Frame of the place that was left.
    pub(super) frame: FrameId,
    /// Displacement between the points of the two places, m.
    pub(super) displacement: PointBox,
    /// Point of the place of arrival, in the frame, m.
    pub(super) position: PointBox,
    /// Distance since the last CONTINUE, m.
    pub(super) astray: f64,
}

impl Observer {
    pub(super) fn project(&self, track: &Track, step: &ObservedMove) -> Projection {
        let (frame, position) = self.map.site(track.place);
        let displacement = self.config.way(step);
        Projection {
            from: track.place,
            action: step.action,
            frame,
            displacement,
            position: position + displacement,
            astray: track.astray + displacement.norm().middle(),
        }
    }

    /// Returns the points between which the robot went, in the frame of the place that was left.
    pub(super) fn ends(&self, projection: &Projection) -> [Point; 2] {
        let (_, start) = self.map.site(projection.from);
        [start, projection.position].map(PointBox::middle)
    }
}

impl Config {
    /// Returns the displacement between the points of the places at a move's ends, by odometry and
    /// the straightness of corridors. A robot that seems to have left its corridor was carried, and
    /// only odometry counts.
    pub(super) fn way(&self, step: &ObservedMove) -> PointBox {
        let way = self.between_places(step.odometry.position);
        let (Some(axis), Ok(line)) = (self.leads(step.action), Interval::about(0.0, self.across))
        else {
            return way;
        };
        let cut = match axis {
            CompassAxis::EastWest => PointBox::new(way.x, line),
            CompassAxis::NorthSouth => PointBox::new(line, way.y),
        };
        way.intersection(cut).unwrap_or(way)
    }

    /// Returns the displacement between places: the robot's, widened by its stopping points within
    /// the places.
    pub(super) fn between_places(&self, robot: PointBox) -> PointBox {
        let Ok(stops) = Interval::about(0.0, 2.0 * self.place_radius) else {
            return robot; // Its radius was checked to be a number, and not negative.
        };
        robot + PointBox::new(stops, stops)
    }
}
