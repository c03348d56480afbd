//! Drives by the paper's place map.

use rand::RngExt;
use thiserror::Error;
use tolman_geom::{Point, Pose};
use tolman_maps::place_map::{
    ColourSpace, FeatureChoice, FeatureError, FeatureTable, ImageFeature, ImageForm, PlaceMap,
    PlaceMapConfig, PlaceMapError, PlaceRecord,
};
use tolman_robot::Standing;
use tolman_sim::StepError;
use tolman_systems::gngslam::{
    PlacePilot, PlacePilotConfig, PlacePilotError, Wanderer, WandererConfig,
};
use tolman_systems::stream;

use super::gather::gather_by;
use super::{GatherError, Pitch, PitchError, PutError};

/// A drive to the place of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceDrive {
    /// True position of the robot at each look, m. The first one is where the drive began.
    pub path: Vec<Point>,
    /// True position at which the record was taken, m.
    pub goal: Point,
    /// State of the drive at its end.
    pub standing: Standing,
}

impl PlaceDrive {
    /// Returns the distance of the robot from the goal at the end, m.
    #[must_use]
    pub fn error_m(&self) -> f64 {
        self.path
            .last()
            .map_or(f64::INFINITY, |end| (end - self.goal).norm())
    }

    /// Returns the distance of the robot from the goal at the start, m.
    #[must_use]
    pub fn start_m(&self) -> f64 {
        self.path
            .first()
            .map_or(f64::INFINITY, |start| (start - self.goal).norm())
    }
}

/// A place map, and drives by it.
#[derive(Clone, Debug)]
pub struct DrivenMap {
    /// Place map that was learned.
    pub map: PlaceMap,
    /// True pose of the origin of the map's odometry, in the world's frame.
    pub world_from_map: Pose,
    /// Drives in order: each begins where the one before ended.
    pub drives: Vec<PlaceDrive>,
}

/// Reason why no drives can be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DrivenMapError {
    /// No records were gathered.
    #[error(transparent)]
    Gather(#[from] GatherError),
    /// The records have no features.
    #[error(transparent)]
    Feature(#[from] FeatureError),
    /// No map was learned.
    #[error(transparent)]
    Map(#[from] PlaceMapError),
    /// The robot makes no progress.
    #[error("the robot makes no progress; choose another seed")]
    Pilot(#[from] PlacePilotError<StepError>),
}

impl From<PutError> for DrivenMapError {
    fn from(error: PutError) -> Self {
        GatherError::from(error).into()
    }
}

impl From<PitchError> for DrivenMapError {
    fn from(error: PitchError) -> Self {
        PutError::from(error).into()
    }
}

/// Maximum number of pieces of way in a drive.
const MOST_PIECES: u32 = 60;

/// Random stream of a run's seed for the map and the goals.
const DRIVES: u64 = 4;

/// Gathers `records` records and learns a place map of image and odometry by `config`. Then the
/// same robot drives on by that map to the places of `drives` random records. Returns map and
/// drives. `seed` seeds all random numbers.
///
/// # Errors
/// [`DrivenMapError`] if the robot fails or the records make no map.
pub fn drive_place_map(
    pitch: &Pitch,
    config: PlaceMapConfig,
    seed: u64,
    records: usize,
    drives: u32,
) -> Result<DrivenMap, DrivenMapError> {
    let mut robot = pitch.put(pitch.robot(seed, 0.0)?, seed)?;
    let world_from_map = robot.truth().pose;
    let mut wanderer = Wanderer::new(WandererConfig::paper(), seed);
    let data = gather_by(pitch, &mut robot, &mut wanderer, seed, records)?;
    let known = data.records.iter().map(|record| record.record.clone());
    let known: Vec<PlaceRecord> = known.collect();
    let choice = FeatureChoice::paper(ImageFeature::small(ColourSpace::Hsv));
    let table = FeatureTable::of(&known, &choice, ImageForm::Pixels)?;
    let mut rng = stream(seed, DRIVES);
    let map = PlaceMap::learn(&table, 0..known.len(), config, &mut rng)?;
    let mut driven = Vec::new();
    for _ in 0..drives {
        let wanted = rng.random_range(0..known.len() as u32) as usize;
        let goal = map.nearest(&known[wanted])?;
        let mut pilot = PlacePilot::new(&map, PlacePilotConfig::pioneer_2dx(), goal);
        let mut drive = PlaceDrive {
            path: vec![robot.truth().pose.position],
            goal: data.records[wanted].truth.position,
            standing: Standing::UnderWay,
        };
        for _ in 0..MOST_PIECES {
            drive.standing = pilot.act(&mut robot, &mut wanderer)?;
            drive.path.push(robot.truth().pose.position);
            if drive.standing != Standing::UnderWay {
                break;
            }
        }
        driven.push(drive);
    }
    Ok(DrivenMap {
        map,
        world_from_map,
        drives: driven,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_on_the_map_is_driven() {
        let pitch = Pitch::paper().unwrap();
        let mut config = PlaceMapConfig::paper();
        config.gng.growth_period = 30;
        let driven = drive_place_map(&pitch, config, 2, 200, 6).unwrap();
        let done = driven
            .drives
            .iter()
            .filter(|drive| drive.standing == Standing::Done);
        assert!(done.count() >= 5);
        let mean = |of: fn(&PlaceDrive) -> f64| driven.drives.iter().map(of).sum::<f64>() / 6.0;
        let (end, start) = (mean(PlaceDrive::error_m), mean(PlaceDrive::start_m));
        assert!(end < 0.8 * start, "{end} m of {start} m");
    }
}
