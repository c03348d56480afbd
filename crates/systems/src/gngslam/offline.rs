//! Gathers records first and then learns a map from all of them: the paper's system.

use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_maps::place_map::{
    FeatureChoice, FeatureError, FeatureTable, ImageForm, PlaceMap, PlaceMapConfig, PlaceMapError,
    PlaceRecord,
};
use tolman_robot::{Guess, MapView, Mapper, Position, Standing, System, Task, VisitNaming};

use super::{SnapshotRobot, Wanderer, WandererConfig, WandererError};
use crate::stream;

/// Parameters by which an [`OfflineSlam`] gathers its records and learns.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct OfflineSlamConfig {
    /// Parameters of the system's wandering.
    pub wanderer: WandererConfig,
    /// Number of records from which the system learns, at least 2. Paper: 1006.
    pub records: usize,
    /// Features that describe a place.
    pub features: FeatureChoice,
    /// Parameters of the map's learning.
    pub map: PlaceMapConfig,
}

impl OfflineSlamConfig {
    /// Returns the paper's values (sections 3.2 and 3.4, set 1 of Table 4.1, the middle of Table
    /// 3.1).
    #[must_use]
    pub fn paper() -> Self {
        Self {
            wanderer: WandererConfig::paper(),
            records: 1006,
            features: FeatureChoice::default(),
            map: PlaceMapConfig::paper(),
        }
    }
}

/// Reason why no map can be learned from the records.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OfflineSlamError {
    /// The records have no features.
    #[error("the records lack a feature that describes places; gather them with it")]
    Features(#[from] FeatureError),
    /// The records cannot be learned.
    #[error("no map can be learned from the records; gather more, or change the configuration")]
    Map(#[from] PlaceMapError),
}

/// Reason why an [`OfflineSlam`] cannot go on.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OfflineSlamFailure<R> {
    /// No record came, or the robot failed.
    #[error(transparent)]
    Robot(#[from] WandererError<R>),
    /// No map can be learned from the records.
    #[error(transparent)]
    Map(#[from] OfflineSlamError),
}

/// The paper's system: it wanders until it has its records (section 3.2), and then learns a map of
/// all of them at once (section 3.4).
///
/// An action of [`Task::Explore`] is a leg and the record at its end. Places are described by the
/// odometry's position, so a robot that was lifted cannot find itself. The paper plans ways on its
/// map but drives none, so this system goes nowhere; a [`PlacePilot`](super::PlacePilot) does.
#[derive(Clone, Debug)]
pub struct OfflineSlam {
    config: OfflineSlamConfig,
    wanderer: Wanderer,
    rng: ChaCha8Rng,
    records: Vec<PlaceRecord>,
    learned: Option<Learned>,
}

/// A map, and the nearest node of each record.
#[derive(Clone, Debug)]
struct Learned {
    map: PlaceMap,
    nodes: Vec<u32>,
}

/// Random stream of a run's seed for the map; that of the wanderer is 0.
const MAP_STREAM: u64 = 1;

impl OfflineSlam {
    /// Returns a system without a map, whose robot has just been put down. `seed` seeds all random
    /// numbers.
    #[must_use]
    pub fn new(config: OfflineSlamConfig, seed: u64) -> Self {
        Self {
            wanderer: Wanderer::new(config.wanderer, seed),
            rng: stream(seed, MAP_STREAM),
            records: Vec::with_capacity(config.records),
            learned: None,
            config,
        }
    }

    /// Returns the map; `None` before the system has all its records.
    #[must_use]
    pub fn learned(&self) -> Option<&PlaceMap> {
        self.learned.as_ref().map(|learned| &learned.map)
    }

    fn learn(&mut self) -> Result<(), OfflineSlamError> {
        let records = &self.records;
        let table = FeatureTable::of(records, &self.config.features, ImageForm::Pixels)?;
        let map = PlaceMap::learn(&table, 0..records.len(), self.config.map, &mut self.rng)?;
        let nearest = |record| Ok(map.nearest(record)?.0);
        let nodes: Result<Vec<u32>, PlaceMapError> = records.iter().map(nearest).collect();
        let nodes = nodes?;
        self.learned = Some(Learned { map, nodes });
        Ok(())
    }
}

impl Mapper for OfflineSlam {
    type Observation = PlaceRecord;
    type Error = OfflineSlamError;

    fn observe(&mut self, seen: &PlaceRecord) -> Result<(), OfflineSlamError> {
        if self.learned.is_some() {
            return Ok(());
        }
        self.records.push(seen.clone());
        match self.records.len() < self.config.records {
            true => Ok(()),
            false => self.learn(),
        }
    }

    fn map(&self) -> MapView {
        self.learned().map(Mapper::map).unwrap_or_default()
    }

    fn belief(&self) -> Vec<Guess> {
        let here = self
            .learned
            .as_ref()
            .and_then(|learned| learned.nodes.last());
        let guess = |node: &u32| Guess {
            at: Position::Place(*node),
            weight: 1.0,
        };
        here.map(guess).into_iter().collect()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.learned().map(PlaceMap::bytes)
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        match &self.learned {
            None => vec![None; self.records.len()],
            Some(learned) => learned.nodes.iter().copied().map(Some).collect(),
        }
    }
}

impl<R: SnapshotRobot> System<R> for OfflineSlam {
    type Failure = OfflineSlamFailure<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        match task {
            Task::Explore if self.learned.is_some() => Ok(Standing::Done),
            Task::Explore => {
                let record = self.wanderer.leg(robot)?;
                self.observe(&record)?;
                Ok(match self.learned {
                    None => Standing::UnderWay,
                    Some(_) => Standing::Done,
                })
            }
            Task::Reach(_) => Ok(Standing::gave_up(
                "it plans ways on its map and does not drive them",
            )),
            Task::Localize => Ok(match self.learned {
                Some(_) => Standing::Done,
                None => Standing::gave_up("it has no map to find itself on"),
            }),
        }
    }

    fn words(&self) -> String {
        match &self.learned {
            None => format!("{} records", self.records.len()),
            Some(learned) => format!("{} nodes", learned.map.network().ids().count()),
        }
    }
}
