use core::f64::consts::FRAC_PI_2;

use tolman_geom::{Heading, Point, Pose};
use tolman_maps::place_graph::{PlaceGraph, PlaceGraphConfig, PlaceGraphError, SeenThere};
use tolman_robot::{Mapper, Odometry, Scan, Snapshot, Sounding};

use crate::places::{OfSites, Site, SiteStep, SiteWay};

/// Feeds a place graph with the places of a log: the scan at each, and the way to it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlaceGraphOfSites {
    /// Parameters of the map.
    pub map: PlaceGraphConfig,
}

impl PlaceGraphOfSites {
    /// Returns the values for offices and matched scans.
    #[must_use]
    pub const fn indoor() -> Self {
        let mut config = PlaceGraphConfig::indoors();
        config.place_distance = 1.5;
        config.scale_deviation = 0.005;
        config.curvature_deviation = 0.002;
        Self { map: config }
    }
}

impl OfSites for PlaceGraphOfSites {
    type Mapper = PlaceGraph;
    type Error = PlaceGraphError;

    fn begin(&self, first: &Site) -> Result<PlaceGraph, PlaceGraphError> {
        let mut map = PlaceGraph::new(self.map);
        // The first beam is to look ahead, which is away from where the robot came.
        let ahead = Heading::from_radians((first.came_by + 2) as f64 * FRAC_PI_2);
        map.observe(&SeenThere {
            snapshot: snapshot(&first.around, -ahead.radians()),
            ..SeenThere::default()
        })?;
        Ok(map)
    }

    fn observation(&self, way: &SiteWay) -> SeenThere {
        let last = way.steps.last();
        SeenThere {
            rolled: way.steps.iter().flat_map(rolled).collect(),
            snapshot: last.map_or_else(Snapshot::default, |step| snapshot(&step.around, 0.0)),
            put_down: false,
        }
    }
}

/// Returns the odometry of a robot that made a step: a turn, a straight way, a turn.
fn rolled(step: &SiteStep) -> [Odometry; 3] {
    let Pose { position, heading } = step.moved;
    let distance = position.coords.norm();
    // Backward, if it lies behind.
    let (sign, along) = match position.x < 0.0 {
        true => (-1.0, -position.coords),
        false => (1.0, position.coords),
    };
    let first = if distance > 0.0 {
        Heading::of(along).radians()
    } else {
        0.0
    };
    let turn = |turn| Odometry {
        distance: 0.0,
        turn,
    };
    let straight = Odometry {
        distance: sign * distance,
        turn: 0.0,
    };
    let last = Heading::from_radians(first).turn_to(heading);
    [turn(first), straight, turn(last)]
}

/// Returns the snapshot of a laser that looks all round, turned against the robot by `turned`, rad.
fn snapshot(around: &Scan, turned: f64) -> Snapshot {
    let sounding = |(beam, range): (u32, &f64)| Sounding {
        mount: Pose::new(
            Point::origin(),
            Heading::from_radians(around.ring.bearing(beam) + turned),
        ),
        half_width: 0.0,
        range: *range,
        max_range: around.ring.max_range,
    };
    Snapshot {
        soundings: (0..).zip(&around.ranges).map(sounding).collect(),
        picture: None,
    }
}
