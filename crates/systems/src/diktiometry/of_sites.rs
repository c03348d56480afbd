use tolman_geom::{Interval, IntervalError, Point, PointBox, PoseBox};
use tolman_maps::diktiometry::{
    Action, Apart, Config, Exits, FirstPlace, MoveOutcome, ObservedMove, Observer, StartError,
};

use super::{Diktiometer, DiktiometerConfig, NoEye, RoutineConfig};
use crate::places::{OfSites, Site, SiteWay};

/// Feeds a diktiometry with the places of a log. Its actions are the four ways along the building's
/// axes, counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DiktiometryOfSites {
    /// Configuration of the mapper.
    pub mapper: Config,
    /// Maximum error of ways, as a share of their length.
    pub share: f64,
    /// Additional maximum error, m.
    pub margin: f64,
}

impl DiktiometryOfSites {
    /// Returns the values for corridors of offices, `corridor_width` wide, m, and for matched
    /// scans.
    #[must_use]
    pub fn indoor(corridor_width: f64) -> Self {
        let mut mapper = Config::new(Config::compass_actions(), corridor_width);
        // A robot that comes from another side finds the middle of a place elsewhere.
        mapper.place_radius = 0.15 * corridor_width;
        // Two places less than a corridor's width apart, along both axes, would be one room.
        mapper.apart = Apart::Side;
        Self {
            mapper,
            share: 0.005,
            margin: 0.0,
        }
    }

    fn odometry(&self, way: &SiteWay) -> Result<PointBox, IntervalError> {
        let margin = self.share * way.length + self.margin;
        PointBox::about(Point::from(way.moved), margin)
    }
}

impl OfSites for DiktiometryOfSites {
    type Mapper = Diktiometer<NoEye>;
    type Error = StartError;

    fn begin(&self, first: &Site) -> Result<Self::Mapper, StartError> {
        let start = FirstPlace {
            percept: None,
            exits: exits(first),
        };
        let observer = Observer::new(self.mapper.clone(), start)?;
        let routines = RoutineConfig::new(1.0, 1.0, 1.0);
        let config = DiktiometerConfig::paper(routines, self.mapper.clone());
        Ok(Diktiometer::with_map(config, NoEye, observer, 0))
    }

    fn observation(&self, way: &SiteWay) -> ObservedMove {
        // Poses are finite, or the scans were refused.
        let moved = self.odometry(way).unwrap_or(PointBox::ORIGIN);
        ObservedMove {
            action: Action(way.left_by as u32),
            odometry: PoseBox::new(moved, Interval::ZERO),
            percept: None,
            exits: exits(&way.to),
            outcome: MoveOutcome::Arrived,
        }
    }
}

fn exits(site: &Site) -> Exits {
    let open = (0..).zip(site.open).filter(|(_, open)| *open);
    Exits::Seen(open.map(|(quarter, _)| Action(quarter)).collect())
}
