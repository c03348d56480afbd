use rand::{Rng, RngExt};
use tolman_geom::{Heading, Point, Vector};
use tolman_maps::place_map::{FeatureTable, PlaceMap, PlaceMapError};
use tolman_maze::Cell;
use tolman_quantizers::UnitId;
use tolman_sim::Bounds;

use super::point_score::middle;
use super::{DataSet, FieldFrame, FieldFromMap, Goals, Pitch, PointScore, whole_field};

/// Scores place maps by the true positions of their records (section 3.4, "Score").
#[derive(Clone, Debug)]
pub struct PlaceScorer {
    cells: Vec<Cell>,
    goals: Goals<usize>,
    field: FieldFrame,
}

/// Quality of a place map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceScore {
    /// Mean over the records that were asked about.
    pub mean: PointScore,
    /// Whether the map is a mirror image of the field, like the paper's maps. Records that lie
    /// counter-clockwise around their middle are then clockwise on the map.
    pub mirrored: bool,
}

impl PlaceScorer {
    /// Returns the paper's scorer of maps of a data set, by the cells that were written down. Maps
    /// are stretched over the field as far as its cells were visited, since "the learned positions
    /// are scaled to the manual position". Record i of the data set has to be record i of the
    /// table.
    #[must_use]
    pub fn paper(data: &DataSet, pitch: &Pitch) -> Self {
        let labels = data.records.iter().map(|record| record.label);
        let to_yellow = pitch.goals.yellow.position - pitch.goals.blue.position;
        Self::of(labels.collect(), data.goals, Heading::of(to_yellow))
    }

    /// Returns the scorer for the true cells of the records, from record 0 on. `yellow_from_blue`
    /// is the true direction from the blue goal to the yellow goal.
    #[must_use]
    pub fn of(cells: Vec<Cell>, goals: Goals<usize>, yellow_from_blue: Heading) -> Self {
        let extent = match cells.is_empty() {
            true => whole_field(),
            false => Bounds::of(cells.iter().copied().map(middle)),
        };
        Self {
            cells,
            goals,
            field: FieldFrame {
                yellow_from_blue,
                extent,
            },
        }
    }

    /// Sets the rectangle over which maps are stretched.
    #[must_use]
    pub const fn over(mut self, extent: Bounds) -> Self {
        self.field.extent = extent;
        self
    }

    /// Scores a map by a random 20 % of the records, the paper's way. `None` if both goals are
    /// nearest to one node: the paper's score of 0.
    ///
    /// # Errors
    /// If the table has fewer records than are asked about, or the map is empty or of another
    /// table.
    pub fn score(
        &self,
        map: &PlaceMap,
        table: &FeatureTable,
        rng: &mut impl Rng,
    ) -> Result<Option<PlaceScore>, PlaceMapError> {
        self.score_by(map, table, &a_fifth(self.cells.len(), rng))
    }

    /// Scores a map by some of the records, such as those it did not learn from.
    ///
    /// # Errors
    /// As [`score`](Self::score).
    pub fn score_by(
        &self,
        map: &PlaceMap,
        table: &FeatureTable,
        records: &[usize],
    ) -> Result<Option<PlaceScore>, PlaceMapError> {
        let Some(field_from_map) = self.field_from_map(map, table)? else {
            return Ok(None);
        };
        let mut pairs = Vec::with_capacity(records.len());
        for record in records {
            let position = map.position(nearest(map, table, *record)?);
            if let (Some(position), Some(cell)) = (position, self.cells.get(*record)) {
                pairs.push((*cell, field_from_map.transform(position)));
            }
        }
        Ok(mean(&pairs).map(|mean| PlaceScore {
            mean,
            mirrored: is_mirrored(&pairs),
        }))
    }

    /// Returns the nodes of the goals: step 1 of the score.
    ///
    /// # Errors
    /// As [`score`](Self::score).
    pub fn goals(
        &self,
        map: &PlaceMap,
        table: &FeatureTable,
    ) -> Result<Goals<UnitId>, PlaceMapError> {
        Ok(Goals {
            blue: nearest(map, table, self.goals.blue)?,
            yellow: nearest(map, table, self.goals.yellow)?,
        })
    }

    /// Returns a fifth of the numbers below `count`, at random and without duplicates.
    ///
    /// # Errors
    /// As [`score`](Self::score).
    pub fn field_from_map(
        &self,
        map: &PlaceMap,
        table: &FeatureTable,
    ) -> Result<Option<FieldFromMap>, PlaceMapError> {
        let Goals { blue, yellow } = self.goals(map, table)?;
        let (Some(from), Some(to)) = (map.position(blue), map.position(yellow)) else {
            return Ok(None);
        };
        let nodes = map.positions().map(|(_, position)| position);
        Ok(FieldFromMap::of(nodes, from, to, &self.field).filter(|_| blue != yellow))
    }
}

fn nearest(map: &PlaceMap, table: &FeatureTable, record: usize) -> Result<UnitId, PlaceMapError> {
    map.nearest_row(table.row(record)?)
}

/// Returns a fifth of the numbers below `count`, rounded, each at most once.
fn a_fifth(count: usize, rng: &mut impl Rng) -> Vec<usize> {
    let count = count as u32;
    let mut numbers: Vec<u32> = (0..count).collect();
    let wanted = (count + 2) / 5;
    for place in 0..wanted {
        numbers.swap(place as usize, rng.random_range(place..count) as usize);
    }
    let drawn = numbers.into_iter().take(wanted as usize);
    drawn.map(|number| number as usize).collect()
}

/// Returns the mean score of positions; `None` if there are none.
fn mean(pairs: &[(Cell, Point)]) -> Option<PointScore> {
    let scores = pairs.iter().map(|(cell, at)| PointScore::of(*cell, *at));
    let sum = scores.reduce(|a, b| PointScore {
        by_centre: a.by_centre + b.by_centre,
        by_border: a.by_border + b.by_border,
    })?;
    let count = pairs.len() as f64;
    Some(PointScore {
        by_centre: sum.by_centre / count,
        by_border: sum.by_border / count,
    })
}

/// Returns whether positions are a mirror image of the cells: the determinant of their covariance
/// is negative.
fn is_mirrored(pairs: &[(Cell, Point)]) -> bool {
    let count = pairs.len().max(1) as f64;
    let cells = pairs.iter().map(|(cell, _)| middle(*cell).coords);
    let cell_mean = cells.sum::<Vector>() / count;
    let mean = pairs.iter().map(|(_, at)| at.coords).sum::<Vector>() / count;
    let products = pairs
        .iter()
        .map(|(cell, at)| (middle(*cell).coords - cell_mean) * (at.coords - mean).transpose());
    let covariance = products.reduce(|a, b| a + b);
    covariance.is_some_and(|covariance| covariance.determinant() < 0.0)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use tolman_geom::Pose;
    use tolman_maps::place_map::{
        FeatureChoice, FeatureGroup, FeatureScaling, ImageForm, PlaceMapConfig, PlaceRecord,
    };
    use tolman_quantizers::GngConfig;
    use tolman_robot::Snapshot;

    use super::*;

    /// Returns records at random positions on the pitch with perfect odometry, and the two goals.
    fn records(seed: u64, frame: Pose) -> (Vec<PlaceRecord>, Vec<Cell>) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let record = |x: f64, y: f64| PlaceRecord {
            odometry: Pose::new(frame.inverse().transform(Point::new(x, y)), Heading::EAST),
            snapshot: Snapshot::default(),
        };
        let (mut records, mut cells) = (Vec::new(), Vec::new());
        for _ in 0..1000 {
            let (x, y) = (rng.random_range(0.0..8.0), rng.random_range(0.0..8.0));
            records.push(record(0.5 * x, 0.575 * y));
            cells.push(Cell::new(x as u16, y as u16));
        }
        records.extend([record(2.0, 0.3), record(2.0, 4.3)]);
        (records, cells)
    }

    const GOALS: Goals<usize> = Goals {
        blue: 1000,
        yellow: 1001,
    };

    fn score(records: &[PlaceRecord], cells: Vec<Cell>, units: usize) -> Option<PlaceScore> {
        let choice = FeatureChoice {
            groups: vec![FeatureGroup::Odometry],
            scaling: FeatureScaling::Group,
        };
        let table = FeatureTable::of(records, &choice, ImageForm::Pixels).unwrap();
        let mut config = PlaceMapConfig::paper();
        config.passes = 30;
        config.gng = GngConfig::fritzke();
        config.gng.max_units = units;
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let map = PlaceMap::learn(&table, 0..1000, config, &mut rng).unwrap();
        let scorer = PlaceScorer::of(cells, GOALS, Heading::NORTH);
        scorer.score(&map, &table, &mut rng).unwrap()
    }

    #[test]
    fn a_map_by_perfect_odometry_is_good_from_wherever_the_robot_began() {
        for degrees in [0.0, 123.0] {
            let frame = Pose::new(Point::new(1.0, 2.0), Heading::from_degrees(degrees));
            let (records, cells) = records(1, frame);
            let score = score(&records, cells, 200).unwrap();
            assert!(score.mean.by_centre > 0.6, "{score:?}");
            assert!(score.mean.by_border > score.mean.by_centre);
            assert!(!score.mirrored);
        }
    }

    #[test]
    fn a_mirror_image_is_found_out() {
        let (mut records, cells) = records(1, Pose::IDENTITY);
        let good = score(&records, cells.clone(), 200).unwrap();
        for record in &mut records {
            record.odometry.position.x *= -1.0;
        }
        let score = score(&records, cells, 200).unwrap();
        assert!(score.mirrored);
        assert!(
            score.mean.by_centre < 0.5 * good.mean.by_centre,
            "{score:?}"
        );
    }

    #[test]
    fn cells_that_have_nothing_to_do_with_the_map_score_as_guesses() {
        let (records, _) = records(1, Pose::IDENTITY);
        let (_, cells) = super::tests::records(2, Pose::IDENTITY);
        let score = score(&records, cells, 200).unwrap();
        assert!((score.mean.by_centre - 0.175).abs() < 0.04, "{score:?}");
        assert!((score.mean.by_border - 0.183).abs() < 0.04, "{score:?}");
    }

    #[test]
    fn both_goals_at_one_node_give_no_score() {
        let (mut records, cells) = records(1, Pose::IDENTITY);
        records[1001] = records[1000].clone();
        assert_eq!(score(&records, cells, 200), None);
    }

    #[test]
    fn a_fifth_of_the_records_is_asked_about_each_once() {
        let mut rng = ChaCha8Rng::seed_from_u64(2);
        let mut drawn = a_fifth(1006, &mut rng);
        assert_eq!(drawn.len(), 201);
        drawn.sort_unstable();
        drawn.dedup();
        assert_eq!(drawn.len(), 201);
        assert!(drawn.iter().all(|number| *number < 1006));
    }
}
