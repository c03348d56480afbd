use alloc::sync::Arc;
use alloc::vec::Vec;

use rand::{Rng, RngExt};
use tolman_geom::Point;
use tolman_quantizers::{Edge, Gng, Network, Quantizer, UnitId};
use tolman_robot::{Guess, MapLink, MapPlace, MapView, Mapper, Picture, Position};

use super::{FeatureSpace, FeatureTable, PlaceMapConfig, PlaceMapError, PlaceRecord};

/// A map of places (section 3.4, "Learning"). Its nodes are those of a growing neural gas, each the
/// prototype of what was seen, heard and rolled at some place; links join neighbours.
///
/// It learns a whole table of records ([`learn`](Self::learn)), or one record at a time as a
/// [`Mapper`].
///
/// ```
/// use rand::SeedableRng;
/// use rand_chacha::ChaCha8Rng;
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_maps::place_map::{
///     FeatureChoice, FeatureGroup, FeatureScaling, FeatureTable, ImageForm, PlaceMap, PlaceMapConfig, PlaceRecord,
/// };
/// use tolman_quantizers::GngConfig;
/// use tolman_robot::Snapshot;
///
/// // By the odometry alone, along a line of 3 m.
/// let record = |i: u32| PlaceRecord {
///     odometry: Pose::new(Point::new(0.1 * f64::from(i % 30), 0.0), Heading::EAST),
///     snapshot: Snapshot::default(),
/// };
/// let records: Vec<PlaceRecord> = (0..300).map(|i| record(7 * i)).collect();
/// let choice = FeatureChoice { groups: vec![FeatureGroup::Odometry], scaling: FeatureScaling::Group };
/// let table = FeatureTable::of(&records, &choice, ImageForm::Pixels)?;
/// let mut config = PlaceMapConfig::paper();
/// config.gng = GngConfig::fritzke();
/// config.gng.max_units = 10;
/// let map = PlaceMap::learn(&table, 0..300, config, &mut ChaCha8Rng::seed_from_u64(1))?;
/// let node = map.nearest(&record(15))?;
/// let position = map.position(node).ok_or("no odometry")?;
/// assert!((position.x - 1.5).abs() < 0.4);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "super::SavedPlaceMap", into = "super::SavedPlaceMap")
)]
pub struct PlaceMap {
    pub(super) space: Arc<FeatureSpace>,
    pub(super) config: PlaceMapConfig,
    pub(super) gng: Gng<f32>,
    /// Node nearest to the last observed record.
    here: Option<UnitId>,
}

impl PlaceMap {
    /// Returns an empty map, which [`observe`](Mapper::observe) fills. Its space must come from a
    /// table of records like those to come, since features are scaled by their variation.
    ///
    /// # Errors
    /// If a parameter or a weight is outside its range.
    pub fn new(space: Arc<FeatureSpace>, config: PlaceMapConfig) -> Result<Self, PlaceMapError> {
        let gng = Gng::weighted(&space.weights(&config.weights), config.gng)?;
        Ok(Self::of(space, config, gng))
    }

    pub(super) const fn of(
        space: Arc<FeatureSpace>,
        config: PlaceMapConfig,
        gng: Gng<f32>,
    ) -> Self {
        Self {
            space,
            config,
            gng,
            here: None,
        }
    }

    /// Learns from records of a table, by their numbers, in that order and as often as the
    /// configuration says. It begins with two different records drawn at random (step 0 of section
    /// 3.3).
    ///
    /// O(passes × records × nodes × values).
    ///
    /// # Errors
    /// If there are fewer than two records or one is not in the table, or a parameter or a weight
    /// is outside its range.
    pub fn learn(
        table: &FeatureTable,
        records: impl IntoIterator<Item = usize>,
        config: PlaceMapConfig,
        rng: &mut impl Rng,
    ) -> Result<Self, PlaceMapError> {
        let rows = records.into_iter().map(|record| table.row(record));
        let rows: Vec<&[f32]> = rows.collect::<Result<_, _>>()?;
        let mut map = Self::new(Arc::clone(table.space()), config)?;
        map.gng.begin_with(&two_of(&rows, rng)?)?;
        for _ in 0..config.passes {
            for row in &rows {
                map.gng.observe(row)?;
            }
        }
        Ok(map)
    }

    /// Returns the parameters of learning.
    #[must_use]
    pub const fn config(&self) -> &PlaceMapConfig {
        &self.config
    }

    /// Returns the space of its nodes.
    #[must_use]
    pub fn space(&self) -> &FeatureSpace {
        &self.space
    }

    /// Returns the nodes with their features and links.
    #[must_use]
    pub fn network(&self) -> &Network<f32> {
        self.gng.network()
    }

    /// Returns the memory of nodes, features and links, bytes. O(links).
    #[must_use]
    pub fn bytes(&self) -> usize {
        let network = self.network();
        let features = network.len() * network.dimension() * size_of::<f32>();
        features + network.edges().count() * size_of::<Edge>()
    }

    /// Returns the node nearest to a record: the place at which the map believes it was recorded.
    /// O(nodes × values).
    ///
    /// # Errors
    /// If the record lacks a chosen feature, or the map is empty.
    pub fn nearest(&self, record: &PlaceRecord) -> Result<UnitId, PlaceMapError> {
        self.nearest_row(&self.space.features(record)?)
    }

    /// Returns the node nearest to a vector of features, such as a row of its table. O(nodes ×
    /// values).
    ///
    /// # Errors
    /// If these are not features of its space, or the map is empty.
    pub fn nearest_row(&self, features: &[f32]) -> Result<UnitId, PlaceMapError> {
        Ok(self.gng.nearest(features)?.id)
    }

    /// Returns the node with the learned ranges nearest to the `known` ones, m, by squared
    /// differences. This serves records with ranges missing. `None` if no range is known, or if
    /// ranges are not a chosen feature. O(nodes × ranges).
    #[must_use]
    pub fn nearest_by_ranges(&self, known: &[Option<f64>]) -> Option<UnitId> {
        let count = known.iter().flatten().count();
        let off = |node: UnitId| {
            let learned = self.ranges(node)?;
            let pairs = known.iter().zip(learned);
            let squares = pairs.filter_map(|(range, learned)| Some((*range)? - learned));
            Some((squares.map(|off| off * off).sum::<f64>(), node))
        };
        let nodes = self.network().ids().filter_map(off);
        let nearest = nodes.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.filter(|_| count > 0).map(|(_, node)| node)
    }

    /// Returns the position of a node, m, in the frame of the odometry: its learned odometry
    /// (section 3.4, "Learning"). `None` if the node does not exist, or odometry is not a chosen
    /// feature.
    #[must_use]
    pub fn position(&self, node: UnitId) -> Option<Point> {
        self.space.position(&self.features(node)?)
    }

    /// Returns the image that was learned at a node, in red, green and blue. `None` if the node
    /// does not exist, or images are not a chosen feature.
    #[must_use]
    pub fn picture(&self, node: UnitId) -> Option<Picture> {
        self.space.picture(&self.features(node)?)
    }

    /// Returns the ranges that were learned at a node, m. `None` if the node does not exist, or
    /// ranges are not a chosen feature.
    #[must_use]
    pub fn ranges(&self, node: UnitId) -> Option<Vec<f64>> {
        self.space.ranges(&self.features(node)?)
    }

    fn features(&self, node: UnitId) -> Option<Vec<f32>> {
        Some(self.network().prototype(node).ok()?.collect())
    }

    /// Returns the positions of the nodes, m, in the order of their ids; empty for a map without
    /// odometry.
    pub fn positions(&self) -> impl Iterator<Item = (UnitId, Point)> + '_ {
        let nodes = self.network().ids();
        nodes.filter_map(|node| Some((node, self.position(node)?)))
    }
}

/// Returns two different rows, drawn at random. If all tries give equal rows, returns the last two.
fn two_of<'a>(rows: &[&'a [f32]], rng: &mut impl Rng) -> Result<[&'a [f32]; 2], PlaceMapError> {
    let found = rows.len();
    let count = u32::try_from(found).unwrap_or(u32::MAX);
    if count < 2 {
        return Err(PlaceMapError::TooFewRecords { found });
    }
    let mut draw = || {
        let first = rng.random_range(0..count);
        let second = (first + rng.random_range(1..count)) % count;
        [rows[first as usize], rows[second as usize]]
    };
    let mut drawn = draw();
    for _ in 0..found {
        if drawn[0] != drawn[1] {
            break;
        }
        drawn = draw();
    }
    Ok(drawn)
}

impl Mapper for PlaceMap {
    type Observation = PlaceRecord;
    type Error = PlaceMapError;

    fn observe(&mut self, seen: &PlaceRecord) -> Result<(), PlaceMapError> {
        let features = self.space.features(seen)?;
        self.here = Some(self.gng.observe(&features)?.first.id);
        Ok(())
    }

    fn map(&self) -> MapView {
        let network = self.network();
        let edges = network.edges().map(|edge| edge.ends);
        let links = edges.flat_map(|(a, b)| MapLink::both_ways(a.0, b.0));
        let place = |node: UnitId| MapPlace {
            id: node.0,
            position: self.position(node),
            landmark: None,
        };
        MapView {
            places: network.ids().map(place).collect(),
            links: links.collect(),
            ..MapView::default()
        }
    }

    fn belief(&self) -> Vec<Guess> {
        let here = self.here.filter(|node| self.network().contains(*node));
        let guess = |node: UnitId| Guess {
            at: Position::Place(node.0),
            weight: 1.0,
        };
        here.map(guess).into_iter().collect()
    }
}
