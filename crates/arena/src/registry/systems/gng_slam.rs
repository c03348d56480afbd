use serde::{Deserialize, Serialize};
use tolman_robot::{Mapper, pioneer_2dx};
use tolman_systems::gngslam::{OfflineSlam, OfflineSlamConfig};

use super::WIDE;
use crate::registry::{
    DemoWorld, DrivesBy, RobotEntry, RobotKind, Setup, SystemEntry, SystemFacts,
};
use crate::{BoxError, Outing};

/// [`OfflineSlam`], which gathers records until it has as many as it wants, and then learns a map
/// from them.
#[derive(Clone, Copy, Debug)]
pub(super) struct GngSlamEntry;

const PRESETS: [(&str, &str); 2] = [
    ("paper", "As many records as in the paper"),
    (ARENA, "As in the arena: records by the number of cells"),
];

/// Preset for contests.
const ARENA: &str = "arena";

/// Number of records per cell that it takes in the arena. They use most of the distance that it may
/// drive.
const RECORDS_A_CELL: usize = 5;

/// Settings for learning.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Gathering {
    /// Number of records from which it learns.
    records: usize,
}

impl SystemEntry for GngSlamEntry {
    fn facts(&self) -> SystemFacts {
        SystemFacts {
            title: "GNG-SLAM",
            about: "lets a neural gas learn images, sonar and odometry, after all is gathered",
            is_paper: true,
            needs: "tells places by what a camera sees",
            kinds: &[RobotKind::Pioneer2dx],
            own_robot: RobotEntry::PIONEER_2DX.name,
            presets: &PRESETS,
            arena_preset: Some(ARENA),
            why_no_log: "it tells places by what a camera sees, which a log of a laser does not have",
            // It plans ways on it.
            drives: DrivesBy::NoMap,
            // It is done when it has its records.
            claims: false,
            demo: (DemoWorld::Small, 1),
            ..SystemFacts::new("gng-slam")
        }
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        let body = pioneer_2dx::body();
        let course = setup.course(&body, WIDE)?;
        let start = setup.start_off_centre(&course, &body)?;
        let mut config = OfflineSlamConfig::paper();
        let by_size = RECORDS_A_CELL * course.maze.reachable().count();
        let presets = [config.records, by_size.max(2)].map(|records| Gathering { records });
        let gathering = setup.settings.preset(&PRESETS, presets)?;
        config.records = setup.settings.over(&gathering)?.records;
        let robot = setup.pioneer_2dx_at(&course, start)?;
        let system = OfflineSlam::new(config, setup.seed);
        let sent = setup.sent(self.name(), course, robot, system);
        // The map's origin is where the robot starts.
        Ok(Box::new(sent.lying(move |system, _| {
            let places = system.map().places.into_iter();
            let placed = places.filter_map(|place| Some((place.id, place.position?)));
            placed.map(|(id, at)| (id, start.transform(at))).collect()
        })))
    }
}
