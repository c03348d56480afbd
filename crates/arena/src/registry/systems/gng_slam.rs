use serde::{Deserialize, Serialize};
use tolman_robot::pioneer_2dx;
use tolman_sim::robots::{Pioneer2dx, Pioneer2dxConfig};
use tolman_systems::gngslam::{OfflineSlam, OfflineSlamConfig};

use super::WIDE;
use crate::registry::{DemoWorld, RobotEntry, RobotKind, Setup, SystemEntry};
use crate::{BoxError, Outing, Sent};

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
    fn name(&self) -> &'static str {
        "gng-slam"
    }

    fn title(&self) -> &'static str {
        "GNG-SLAM"
    }

    fn about(&self) -> &'static str {
        "lets a neural gas learn images, sonar and odometry, after all is gathered"
    }

    fn is_paper(&self) -> bool {
        true
    }

    fn needs(&self) -> &'static str {
        "tells places by what a camera sees"
    }

    fn kinds(&self) -> &'static [RobotKind] {
        &[RobotKind::Pioneer2dx]
    }

    fn own_robot(&self) -> &'static str {
        RobotEntry::PIONEER_2DX.name
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        &PRESETS
    }

    fn arena_preset(&self) -> Option<&'static str> {
        Some(ARENA)
    }

    fn why_no_log(&self) -> &'static str {
        "it tells places by what a camera sees, which a log of a laser does not have"
    }

    /// It is done when it has its records.
    fn claims(&self) -> bool {
        false
    }

    fn demo(&self) -> (DemoWorld, u64) {
        (DemoWorld::Small, 1)
    }

    fn learner(&self, setup: &Setup<'_>) -> Result<Box<dyn Outing>, BoxError> {
        setup.anew(self.name())?;
        let body = pioneer_2dx::body();
        let course = setup.course(&body, WIDE)?;
        let start = setup.start_anywhere(&course, &body)?;
        let mut config = OfflineSlamConfig::paper();
        let by_size = RECORDS_A_CELL * course.maze.reachable().count();
        let presets = [config.records, by_size.max(2)].map(|records| Gathering { records });
        let names = PRESETS.map(|(name, _)| name);
        let gathering = setup.settings.preset(names.into_iter().zip(presets))?;
        config.records = setup.settings.over(&gathering)?.records;
        let robot = setup
            .condition
            .pioneer_2dx(Pioneer2dxConfig::paper(), setup.seed);
        let robot = course.robot_at(start, Pioneer2dx::new(robot)?, setup.seed)?;
        let steps = setup.steps.unwrap_or(u32::MAX);
        let system = OfflineSlam::new(config, setup.seed);
        let origin = setup.origin(&course);
        let sent = Sent::new(course, robot, steps, system);
        Ok(Box::new(sent.keeping_its_view(self.name(), origin)))
    }
}
