use tolman_maps::cpm::Sighting;
use tolman_maze::Cell;
use tolman_sim::StepError;
use tolman_sim::robots::{Epuck, EpuckConfig};
use tolman_systems::cpm::{Observation, WalkError, Walker, WalkerConfig};

use super::fragments::{TrueFragments, WayOut};
use crate::BoxError;
use crate::course::Course;

/// One walk along a true fragment of a maze.
#[derive(Clone, Debug)]
pub struct SurveyedWalk {
    /// Place from which the fragment was to be walked.
    pub from: Cell,
    /// The fragment, and the direction in which it was to be walked.
    pub way: WayOut,
    /// True place to which the walk led; `None` outside the maze.
    pub to: Option<Cell>,
    /// Observations on the way.
    pub observations: Vec<Observation>,
    /// Sighting of the place to which the walk led.
    pub sighting: Sighting,
}

/// Walks every fragment of a maze both ways and returns the walks. Each begins in the middle of the
/// place at the fragment's end. All reasoning on the map rests on two differences: between walks
/// along one fragment, and between walks along two.
///
/// # Errors
/// If the robot cannot stand at a place, or a walk comes to no end.
pub fn survey(
    course: &Course,
    robot: &EpuckConfig,
    config: &WalkerConfig,
    seed: u64,
) -> Result<Vec<SurveyedWalk>, BoxError> {
    let fragments = TrueFragments::of(&course.maze);
    let mut walks = Vec::new();
    for (cell, out, way) in fragments.ways() {
        // A robot that came by this fragment looks into the place.
        let start = course.in_cell(cell, out.opposite());
        let body = course.robot_at(start, Epuck::new(robot.clone())?, seed)?;
        let mut walker = Walker::new(body, config.clone());
        walker.begin()?;
        let walk = walker.walk(0, 0, None)?;
        let end = walker.body().truth().pose.position;
        walks.push(SurveyedWalk {
            from: cell,
            way,
            to: course.world.cell_at(end),
            observations: walk.observations,
            sighting: walk.sighting.ok_or(WalkError::<StepError>::Lost)?,
        });
    }
    Ok(walks)
}
