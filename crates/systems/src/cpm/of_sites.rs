use core::f64::consts::FRAC_PI_2;

use tolman_control::epuck::Profile;
use tolman_geom::{Interval, IntervalError, Point, PointBox};
use tolman_maps::cpm::{Bearings, DeadReckoning, Sighting, Turn};
use tolman_robot::epuck::BODY_RADIUS;
use tolman_robot::{Mapper, Scan};

use super::{
    Cpm, CpmConfig, CpmObservation, CpmObserveError, Observation, RingMeasures, Walked,
    WalkerConfig,
};
use crate::places::{OfSites, Site, SiteWay};

/// Feeds CPM with the places of a log, at the e-puck's scale. The robot's surroundings on its way
/// become common patterns.
#[derive(Clone, Debug)]
pub struct CpmOfSites {
    measures: RingMeasures,
    walker: WalkerConfig,
    config: CpmConfig,
}

/// Maximum error of a way, as a share of its length.
const SHARE: f64 = 0.01;
/// Distance between the stopping points, in one place, of robots from different sides, as a share
/// of a corridor's width.
const PLACE: f64 = 0.75;
/// Maximum error of a heading along the building's axes, rad.
const HEADING: f64 = 0.35;

impl CpmOfSites {
    /// Returns the values for corridors of width `corridor_width`, m.
    #[must_use]
    pub fn indoor(corridor_width: f64) -> Self {
        let measures = RingMeasures {
            corridor_width,
            body_radius: 0.125 * corridor_width,
            turn_per_step: 0.1,
            translate_per_step: 0.1,
            step_us: 100_000,
            turn_tolerance: 0.1,
        };
        Self {
            walker: measures.walker_config(),
            measures,
            config: CpmConfig::robust(),
        }
    }

    fn motion(&self, way: &SiteWay) -> Result<DeadReckoning, IntervalError> {
        let scale = self.measures.scale();
        let margin = SHARE * way.length + PLACE * self.measures.corridor_width;
        let about = |quarter: usize| Interval::about(quarter as f64 * FRAC_PI_2, HEADING);
        Ok(DeadReckoning {
            displacement: PointBox::about(Point::from(way.moved / scale), margin / scale)?,
            departure: about(way.left_by)?,
            arrival: about(way.to.came_by + 2)?,
        })
    }

    /// Returns the observation that becomes a common pattern; `None` if fewer than two ways are
    /// seen.
    fn seen(&self, around: &Scan) -> Option<Observation> {
        let curve = &self.walker.pilot.curve;
        let value = |range: &f64| curve.value(range / self.measures.scale() - BODY_RADIUS);
        let round = Profile::from_values(around.ranges.iter().map(value).collect()).ok()?;
        Observation::of(&round, &self.walker.features).ok()?
    }
}

impl OfSites for CpmOfSites {
    type Mapper = Cpm;
    type Error = CpmObserveError;

    fn begin(&self, first: &Site) -> Result<Cpm, CpmObserveError> {
        let mut cpm = Cpm::unlearned(self.walker.clone(), self.config, 0)?;
        cpm.observe(&CpmObservation::Began(sighting(first)))?;
        Ok(cpm)
    }

    fn observation(&self, way: &SiteWay) -> CpmObservation {
        let steps = way.steps.iter();
        CpmObservation::Walked(Walked {
            turn: turn(&way.from, way.left_by),
            observations: steps.filter_map(|step| self.seen(&step.around)).collect(),
            sighting: Some(sighting(&way.to)),
            motion: self.motion(way).ok(),
            bearings: bearings(&way.to),
        })
    }
}

/// Returns the ways out of a place, counter-clockwise from the one by which the robot came.
fn ways(site: &Site) -> impl Iterator<Item = usize> + '_ {
    let quarters = (0..4).map(|turned| (site.came_by + turned) % 4);
    quarters.filter(|quarter| site.open[*quarter])
}

fn sighting(site: &Site) -> Sighting {
    Sighting::plain(ways(site).count() as u32)
}

fn turn(site: &Site, left_by: usize) -> Turn {
    let number = ways(site).position(|quarter| quarter == left_by);
    number.map_or(Turn::BACK, |number| Turn(number as u32))
}

fn bearings(site: &Site) -> Option<Bearings> {
    let directions = ways(site).map(|quarter| quarter as f64 * FRAC_PI_2);
    Bearings::of_directions(&directions.collect::<Vec<_>>()).ok()
}
