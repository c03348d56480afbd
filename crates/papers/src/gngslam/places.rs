//! The records of the pitch and their features, gathered when they are first needed.

use alloc::sync::Arc;

use serde::Serialize;
use tolman_arena::gngslam::{DataSet, Pitch, PlaceScorer, gather, whole_field};
use tolman_experiment::BoxError;
use tolman_maps::place_map::{FeatureChoice, FeatureScaling, FeatureTable, ImageForm};
use tolman_sim::robots::Pioneer2dxConfig;

use super::sets::{IMAGES, Source, Stretch};
use crate::kept::Kept;

/// The paper's number of records.
const RECORDS: u32 = 1006;

/// Form of the images: coordinates in their span, with nothing left out.
const FORM: ImageForm = ImageForm::Span { left_out: 0.0 };

/// One data run of the robot: "for the experiments, one data run was used".
#[derive(Debug)]
pub(super) struct Places {
    seed: u64,
    source: Source,
    gathered: Kept<(), Gathered>,
    /// Tables of features, by image.
    tables: Kept<usize, FeatureTable>,
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

impl Places {
    pub(super) fn new(seed: u64, source: Source) -> Self {
        Self {
            seed,
            source,
            gathered: Kept::default(),
            tables: Kept::default(),
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

    fn gathered(&self) -> Result<Arc<Gathered>, BoxError> {
        self.gathered.get((), || {
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
    pub(super) fn table(&self, image: usize) -> Result<Arc<FeatureTable>, BoxError> {
        self.tables.get(image, || {
            let choice = FeatureChoice::paper_with_sonar(IMAGES[image]);
            let choice = choice.scaled(self.source.scaling);
            Ok(self.gathered()?.data.table(&choice, FORM)?)
        })
    }

    /// Returns the scorer for maps of these records.
    pub(super) fn scorer(&self, stretch: Stretch) -> Result<PlaceScorer, BoxError> {
        let Gathered { pitch, data } = &*self.gathered()?;
        let scorer = PlaceScorer::paper(data, pitch);
        Ok(match stretch {
            Stretch::Visited => scorer,
            Stretch::Field => scorer.over(whole_field()),
        })
    }
}
