//! The records of the pitch and their features, gathered when they are needed first.

use std::sync::OnceLock;

use tolman_arena::gngslam::{GoalRecords, PlaceScorer};
use tolman_experiment::BoxError;
use tolman_maps::place_map::{FeatureTable, ImageForm, PlaceRecord};
use tolman_maze::Cell;

use super::sets::{IMAGES, choice};
use super::synthetic;

/// Images are told by coordinates of their span, of which nothing is left out.
const FORM: ImageForm = ImageForm::Span { left_out: 0.0 };

/// One data run of the robot: "for the experiments, one data run was used".
#[derive(Debug)]
pub(super) struct Places {
    seed: u64,
    records: Once<Gathered>,
    /// By image.
    tables: [Once<FeatureTable>; IMAGES.len()],
}

/// What the robot gathered and what is true of it.
#[derive(Clone, Debug)]
pub(super) struct Gathered {
    /// The records of places, then those of the goals.
    pub(super) records: Vec<PlaceRecord>,
    /// The cells of the records of places.
    pub(super) cells: Vec<Cell>,
    pub(super) goals: GoalRecords,
}

/// What is made once, or why it could not be.
type Once<T> = OnceLock<Result<T, String>>;

fn once<T>(cell: &Once<T>, make: impl FnOnce() -> Result<T, BoxError>) -> Result<&T, BoxError> {
    let made = cell.get_or_init(|| make().map_err(|error| error.to_string()));
    made.as_ref().map_err(|error| error.clone().into())
}

impl Places {
    pub(super) const fn new(seed: u64) -> Self {
        Self {
            seed,
            records: OnceLock::new(),
            tables: [const { OnceLock::new() }; IMAGES.len()],
        }
    }

    /// What the records depend on but the seed.
    pub(super) fn config() -> Result<toml::Table, BoxError> {
        Ok(toml::Table::new())
    }

    fn gathered(&self) -> Result<&Gathered, BoxError> {
        once(&self.records, || Ok(synthetic::gather(self.seed)))
    }

    /// Returns the number of records of places.
    pub(super) fn count(&self) -> Result<usize, BoxError> {
        Ok(self.gathered()?.cells.len())
    }

    /// Returns the features of all records with the image of a place among [`IMAGES`].
    pub(super) fn table(&self, image: usize) -> Result<&FeatureTable, BoxError> {
        once(&self.tables[image], || {
            let records = &self.gathered()?.records;
            let t = std::time::Instant::now();
            let table = FeatureTable::of(records, &choice(IMAGES[image]), FORM)?;
            eprintln!(
                "table {image}: {:?} {}",
                t.elapsed(),
                table.space().dimension()
            );
            Ok(table)
        })
    }

    /// Returns who scores maps of these records.
    pub(super) fn scorer(&self) -> Result<PlaceScorer, BoxError> {
        let Gathered { cells, goals, .. } = self.gathered()?;
        Ok(PlaceScorer::paper(cells.clone(), *goals, tolman_geom::Heading::NORTH))
    }
}
