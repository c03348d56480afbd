//! The systems of this project, each with the robots that can carry it.

mod baseline;
mod cpm;
mod diktiometry;
mod gng_slam;
mod gng_slam_better;
mod logs;
mod micromouse;
mod mslst;
mod mslst_better;
mod wall_belief;

use super::SystemEntry;
use crate::cast::Agent;

/// All systems in the order of the tables.
pub(super) const ALL: &[&dyn SystemEntry] = &[
    &mslst::MslstEntry,
    &mslst_better::MslstBetterEntry,
    &cpm::CpmEntry::PAPER,
    &cpm::CpmEntry::BETTER,
    &diktiometry::DiktiometryEntry::PAPER,
    &diktiometry::DiktiometryEntry::BETTER,
    &gng_slam::GngSlamEntry,
    &gng_slam_better::GngSlamBetterEntry,
    &micromouse::MicromouseEntry,
    &wall_belief::WallBeliefEntry,
    &baseline::BaselineEntry(Agent::Random, "random"),
    &baseline::BaselineEntry(Agent::Avoid, "avoid"),
    &baseline::BaselineEntry(Agent::WallFollow, "wall-follow"),
    &baseline::BaselineEntry(Agent::Oracle, "oracle"),
    &baseline::BaselineEntry(Agent::UnlocalizedOracle, "unlocalized-oracle"),
    &logs::SCAN_MATCHING,
    &logs::PLACES,
    &logs::MATCHING,
    &logs::ODOMETRY,
];

/// Corridor width for robots that keep away from what is near, such as GNG-SLAM's, m.
const WIDE: f64 = 1.5;
