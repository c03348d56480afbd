use alloc::collections::{BTreeMap, BTreeSet};

use thiserror::Error;
use tolman_geom::{Point, Vector};
use tolman_maps::scan_matching::{ScanMatching, ScanStep};
use tolman_robot::{Guess, MapView, Mapper, Position, VisitNaming};

use super::{PlacesConfig, PlacesError, PlacesMapper, Site, SiteWay};

/// Feeds a mapper with the places to which another drove, such as the robot of a log.
pub trait OfSites {
    /// The mapper that learns.
    type Mapper: Mapper;
    /// Reason why the mapper cannot begin.
    type Error;

    /// Returns a map of the first place.
    ///
    /// # Errors
    /// If the mapper cannot begin there.
    fn begin(&self, first: &Site) -> Result<Self::Mapper, Self::Error>;

    /// Returns the mapper's input for the way to the next place.
    fn observation(&self, way: &SiteWay) -> <Self::Mapper as Mapper>::Observation;
}

/// Reason why a mapper of places cannot go on with a log.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SiteMapperError<B, M> {
    /// A scan is invalid.
    #[error(transparent)]
    Places(#[from] PlacesError),
    /// The mapper cannot begin.
    #[error("the mapper cannot begin at the first place")]
    Begin(#[source] B),
    /// The mapper refuses a way between two places.
    #[error("the mapper refuses the way to place {visit} of the log")]
    Way {
        /// Counted from 0.
        visit: usize,
        /// The underlying error.
        source: M,
    },
}

/// A mapper of moves between places that learns from the scans of a log. Junctions, bends, dead
/// ends and rooms are detected, and the mapper gets the ways between them. Only the mapper
/// recognizes places. If the scans match there, too, the poses are corrected.
#[derive(Debug)]
pub struct SiteMapper<O: OfSites> {
    places: PlacesMapper,
    of_sites: O,
    mapper: Option<O::Mapper>,
    /// Place at which the mapper believed to be, visit by visit.
    believed: Vec<Option<u32>>,
}

type Outcome<T, O> =
    Result<T, SiteMapperError<<O as OfSites>::Error, <<O as OfSites>::Mapper as Mapper>::Error>>;

impl<O: OfSites> SiteMapper<O> {
    /// Returns a mapper without observations.
    ///
    /// # Errors
    /// If the corridors' width is not a positive length.
    pub fn new(config: PlacesConfig, of_sites: O) -> Result<Self, PlacesError> {
        Ok(Self {
            places: PlacesMapper::new(config.unrecognized())?,
            of_sites,
            mapper: None,
            believed: Vec::new(),
        })
    }

    /// Returns the mapper; `None` before the first place.
    #[must_use]
    pub const fn mapper(&self) -> Option<&O::Mapper> {
        self.mapper.as_ref()
    }

    /// Returns the scans matched, and the poses.
    #[must_use]
    pub const fn matching(&self) -> &ScanMatching {
        self.places.matching()
    }

    /// Returns the keyframe of each visit with the mapper's place for it. O(visits · log map).
    #[must_use]
    pub fn keyframes_of_visits(&self) -> Vec<(usize, Option<u32>)> {
        let keyframes = self.places.sites().into_iter().map(|site| site.keyframe);
        keyframes.zip(self.visits()).collect()
    }

    /// Passes the mapper the new places before number `end`.
    fn tell(&mut self, end: usize) -> Outcome<(), O> {
        for visit in self.believed.len()..end {
            let Some(site) = self.places.site(visit) else {
                break;
            };
            match (&mut self.mapper, self.places.way_to(visit)) {
                (Some(mapper), Some(way)) => mapper
                    .observe(&self.of_sites.observation(&way))
                    .map_err(|source| SiteMapperError::Way { visit, source })?,
                _ => {
                    let begun = self.of_sites.begin(&site);
                    self.mapper = Some(begun.map_err(SiteMapperError::Begin)?);
                }
            }
            self.believed.push(self.best_guess());
        }
        Ok(())
    }

    fn best_guess(&self) -> Option<u32> {
        let mapper = self.mapper.as_ref()?;
        match mapper.belief().first()?.at {
            Position::Place(place) => Some(place),
            Position::Point(here) => nearest(&mapper.map(), here),
        }
    }

    /// Passes the mapper the remaining places, and makes the poses agree with the places that it
    /// recognized.
    ///
    /// # Errors
    /// If the mapper refuses a way, or a measurement does not fit.
    pub fn finish(&mut self) -> Outcome<(), O> {
        self.places.come_to_rest()?;
        self.tell(self.places.visit_count())?;
        let mut last = BTreeMap::new();
        for (visit, place) in self.visits().into_iter().enumerate() {
            let Some(place) = place else { continue };
            if let Some(before) = last.insert(place, visit) {
                self.places.recognize(visit, before)?;
            }
        }
        Ok(self.places.finish()?)
    }
}

impl<O: OfSites> Mapper for SiteMapper<O> {
    type Observation = ScanStep;
    type Error = SiteMapperError<O::Error, <O::Mapper as Mapper>::Error>;

    fn observe(&mut self, step: &ScanStep) -> Outcome<(), O> {
        self.places.observe(step)?;
        // By which way the robot leaves the last one is not known yet.
        self.tell(self.places.visit_count().saturating_sub(1))
    }

    /// Returns the mapper's map. A place lies in the middle of the robot's positions when it came
    /// to the place.
    fn map(&self) -> MapView {
        let mut stood: BTreeMap<u32, Vec<Point>> = BTreeMap::new();
        for (keyframe, place) in self.keyframes_of_visits() {
            let pose = self.matching().graph().poses().get(keyframe);
            if let (Some(place), Some(pose)) = (place, pose) {
                stood.entry(place).or_default().push(pose.position);
            }
        }
        let mut view = (self.mapper.as_ref()).map_or_else(MapView::default, Mapper::map);
        view.places.retain(|place| stood.contains_key(&place.id));
        for place in &mut view.places {
            place.position = stood.get(&place.id).map(|points| middle(points));
        }
        // A way whose end has not been visited leads nowhere yet.
        let known: BTreeSet<u32> = view.places.iter().map(|place| place.id).collect();
        view.links
            .retain(|link| known.contains(&link.from) && known.contains(&link.to));
        view
    }

    fn belief(&self) -> Vec<Guess> {
        (self.mapper.as_ref()).map_or_else(Vec::new, Mapper::belief)
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        let told = (self.mapper.as_ref()).map_or_else(Vec::new, Mapper::visits);
        if told.len() == self.believed.len() {
            return told;
        }
        self.believed.clone()
    }

    fn certainty(&self) -> Option<f64> {
        self.mapper.as_ref()?.certainty()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.mapper.as_ref()?.map_bytes()
    }
}

/// Returns the place of a map that lies nearest to a point.
fn nearest(map: &MapView, point: Point) -> Option<u32> {
    let places = map.places.iter();
    let off = places.filter_map(|place| Some(((place.position? - point).norm(), place.id)));
    off.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, id)| id)
}

fn middle(points: &[Point]) -> Point {
    let sum: Vector = points.iter().map(|point| point.coords).sum();
    Point::from(sum / points.len().max(1) as f64)
}
