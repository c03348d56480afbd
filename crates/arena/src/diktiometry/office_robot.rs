use tolman_geom::Pose;
use tolman_sim::robots::CameraPioneer;

use super::{Office, SurveyorConfig};
use crate::registry::because;
use crate::{BoxError, Simulated};

/// A simulated Pioneer with a camera.
pub type OfficeRobot = Simulated<CameraPioneer>;

/// Returns a robot at `pose` in `office`. `seed` seeds all noise.
///
/// # Errors
/// If the configuration is out of its bounds or the robot cannot stand there.
pub fn office_robot(
    office: &Office,
    config: &SurveyorConfig,
    pose: Pose,
    seed: u64,
) -> Result<OfficeRobot, BoxError> {
    let robot = CameraPioneer::new(config.camera_robot());
    let what = "the robot cannot be built; correct its configuration";
    let robot = robot.map_err(|error| because(what, error))?;
    let placed = office.course.robot_at(pose, robot, seed);
    placed.map_err(|error| because("the robot cannot stand there; choose another start", error))
}
