use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Pose};
use tolman_maps::place_map::{
    FeatureChoice, FeatureError, FeatureTable, ImageForm, PlaceMap, PlaceMapConfig, PlaceMapError,
    PlaceRecord,
};
use tolman_maze::Cell;

use super::{CellGrid, Goals, Pitch};

/// Records of one run with the truth beside them (section 3.2).
#[derive(Clone, Debug, PartialEq)]
pub struct DataSet {
    /// Name of the arena: see [`Pitch::named`].
    pub arena: String,
    /// Seed of the run.
    pub seed: u64,
    /// The cells over the arena's floor.
    pub cells: CellGrid,
    /// The records, in the order in which they were taken.
    pub records: Vec<LabelledRecord>,
    /// Index of the record that best shows each goal, as a person would choose it (section 3.4,
    /// *Score*). It was taken in front of the goal, looking at it.
    pub goals: Goals<usize>,
}

/// A record, with the true pose and cell where it was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledRecord {
    /// Record as the robot took it.
    pub record: PlaceRecord,
    /// True pose of the robot.
    pub truth: Pose,
    /// True cell of the robot.
    pub cell: Cell,
    /// Cell that the person wrote down; a wrong one for a few records.
    pub label: Cell,
}

impl DataSet {
    /// Returns the features of all records.
    ///
    /// # Errors
    /// If a record lacks a feature that is chosen.
    pub fn table(
        &self,
        choice: &FeatureChoice,
        form: ImageForm,
    ) -> Result<FeatureTable, FeatureError> {
        let records = self.records.iter().map(|record| record.record.clone());
        FeatureTable::of(&records.collect::<Vec<_>>(), choice, form)
    }

    /// Learns a map of the paper's most accurate features from all records, and returns it with
    /// those features. It has a node more for each `growth_period` records; `None` for the middle
    /// of the paper's range.
    ///
    /// # Errors
    /// If a record lacks a feature, or there are fewer than two records.
    pub fn learn(
        &self,
        form: ImageForm,
        growth_period: Option<u32>,
        rng: &mut impl Rng,
    ) -> Result<(FeatureTable, PlaceMap), PlaceMapError> {
        let table = self.table(&FeatureChoice::default(), form)?;
        let mut config = PlaceMapConfig::paper();
        if let Some(period) = growth_period {
            config.gng.growth_period = period;
        }
        let map = PlaceMap::learn(&table, 0..self.records.len(), config, rng)?;
        Ok((table, map))
    }
}

/// Share of wrong labels. Paper: 10 of 1006.
const WRONG_LABELS: f64 = 0.01;

impl Goals<usize> {
    /// Returns the record that shows each goal best. Without records it is number 0, which does not
    /// exist.
    pub(super) fn find(pitch: &Pitch, records: &[LabelledRecord]) -> Self {
        let best = |goal| {
            let costs = records.iter().map(|record| cost(pitch, record.truth, goal));
            let best = (0..).zip(costs).min_by(|a, b| a.1.total_cmp(&b.1));
            best.map_or(0, |(index, _)| index)
        };
        Self {
            blue: best(pitch.goals.blue),
            yellow: best(pitch.goals.yellow),
        }
    }
}

/// Returns the cost of seeing a goal from a pose. It is least if the goal is straight ahead, fills
/// the picture, is not hidden, and is seen head-on.
fn cost(pitch: &Pitch, pose: Pose, goal: Pose) -> f64 {
    /// Distance at which a goal fills the picture, m: the paper's limits stop the robot there.
    const BEST: f64 = 1.3;
    /// Deviations of equal cost: from the best distance, m; to the side, rad; and from head-on,
    /// rad.
    const OFF: f64 = 0.5;
    const ASIDE: f64 = 0.1;
    const ASLANT: f64 = 0.4;
    /// Penalty of a hidden goal, which makes it worse than any visible one.
    const HIDDEN: f64 = 1e6;
    /// Distance of the goal in front of its wall, m.
    const PROUD: f64 = 0.05;
    let way = goal.position - pose.position;
    let (distance, towards) = (way.norm(), Heading::of(way));
    let off = (distance - BEST) / OFF;
    let aside = pose.heading.turn_to(towards) / ASIDE;
    let aslant = goal.heading.turn_to(towards.reversed()) / ASLANT;
    let caster = pitch.course.world.caster();
    let sight = caster.cast(pose.position, towards.unit(), distance);
    let hidden = if sight < distance - PROUD {
        HIDDEN
    } else {
        0.0
    };
    aside * aside + aslant * aslant + off * off + hidden
}

/// Replaces the labels of the paper's share of records by wrong cells.
pub(super) fn mislabel(records: &mut [LabelledRecord], rng: &mut ChaCha8Rng) {
    let count = records.len();
    let mut wrong = (WRONG_LABELS * count as f64).round() as usize;
    // Each of those that are left is as likely as any other.
    for (index, record) in records.iter_mut().enumerate() {
        let left = (count - index) as u32;
        if (rng.random_range(0..left) as usize) < wrong {
            record.label = another(record.cell, rng);
            wrong -= 1;
        }
    }
}

/// Returns a random cell other than this one.
fn another(cell: Cell, rng: &mut ChaCha8Rng) -> Cell {
    let side = u32::from(CellGrid::SIDE);
    let own = u32::from(cell.y) * side + u32::from(cell.x);
    let index = (own + rng.random_range(1..side * side)) % (side * side);
    Cell::new((index % side) as u16, (index / side) as u16)
}
