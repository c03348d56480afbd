//! The records of the pitch and their features, gathered when they are first needed.

use std::sync::OnceLock;

use serde::Serialize;
use tolman_arena::gngslam::{DataSet, Pitch, PlaceScorer, gather, whole_field};
use tolman_experiment::BoxError;
use tolman_maps::place_map::{FeatureChoice, FeatureScaling, FeatureTable, ImageForm, PlaceRecord};
use tolman_sim::robots::Pioneer2dxConfig;

use super::sets::{IMAGES, Source, Stretch};

/// The paper's number of records.
const RECORDS: u32 = 1006;

/// Form of the images: coordinates in their span, with nothing left out.
const FORM: ImageForm = ImageForm::Span { left_out: 0.0 };

/// One data run of the robot: "for the experiments, one data run was used".
#[derive(Debug)]
pub(super) struct Places {
    seed: u64,
    source: Source,
    gathered: Once<Gathered>,
    /// Tables of features, by image.
    tables: [Once<FeatureTable>; IMAGES.len()],
}

#[derive(Debug)]
struct Gathered {
    pitch: Pitch,
    data: DataSet,
}

/// Configuration of the records, without the seed.
#[derive(Serialize)]
pub(super) struct Config {
    count: u32,
    arena: String,
    scaling: FeatureScaling,
    robot: Pioneer2dxConfig,
}

/// A value that is made once, or the reason why it could not be made.
type Once<T> = OnceLock<Result<T, String>>;

fn once<T>(cell: &Once<T>, make: impl FnOnce() -> Result<T, BoxError>) -> Result<&T, BoxError> {
    let made = cell.get_or_init(|| make().map_err(|error| error.to_string()));
    made.as_ref().map_err(|error| error.clone().into())
}

impl Places {
    pub(super) const fn new(seed: u64, source: Source) -> Self {
        Self {
            seed,
            source,
            gathered: OnceLock::new(),
            tables: [const { OnceLock::new() }; IMAGES.len()],
        }
    }

    /// Returns the settings of the records, except the seed.
    pub(super) fn config(&self) -> Result<Config, BoxError> {
        let pitch = Pitch::named("pitch")?;
        Ok(Config {
            count: RECORDS,
            robot: pitch.robot(self.seed, self.source.calibration)?,
            scaling: self.source.scaling,
            arena: pitch.course.name,
        })
    }

    fn gathered(&self) -> Result<&Gathered, BoxError> {
        once(&self.gathered, || {
            let pitch = Pitch::named("pitch")?;
            let robot = pitch.robot(self.seed, self.source.calibration)?;
            let data = gather(&pitch, robot, self.seed, RECORDS)?;
            Ok(Gathered { pitch, data })
        })
    }

    /// Returns the number of records.
    pub(super) fn count(&self) -> Result<usize, BoxError> {
        Ok(self.gathered()?.data.records.len())
    }

    /// Returns the features of all records, with the image of this index among [`IMAGES`].
    pub(super) fn table(&self, image: usize) -> Result<&FeatureTable, BoxError> {
        once(&self.tables[image], || {
            let records = self.gathered()?.data.records.iter();
            let records: Vec<PlaceRecord> = records.map(|record| record.record.clone()).collect();
            let choice = FeatureChoice::paper_with_sonar(IMAGES[image]);
            let choice = choice.scaled(self.source.scaling);
            Ok(FeatureTable::of(&records, &choice, FORM)?)
        })
    }

    /// Returns the scorer for maps of these records.
    pub(super) fn scorer(&self, stretch: Stretch) -> Result<PlaceScorer, BoxError> {
        let Gathered { pitch, data } = self.gathered()?;
        let scorer = PlaceScorer::paper(data, pitch);
        Ok(match stretch {
            Stretch::Visited => scorer,
            Stretch::Field => scorer.over(whole_field()),
        })
    }
}
