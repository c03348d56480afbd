use alloc::sync::Arc;

use tolman_control::heading_of;
use tolman_geom::Pose;
use tolman_maps::cpm::Sighting;
use tolman_maze::{Cell, Maze};
use tolman_sim::World;
use tolman_sim::robots::EpuckConfig;
use tolman_systems::cpm::{Observation, Walk, WalkError, WalkerConfig};

use super::fragments::{TrueFragments, Way};
use super::trial::{TrialError, walker_at, world_of};

/// One walk along a true fragment of a maze.
#[derive(Clone, Debug)]
pub struct Surveyed {
    /// The place it was to be walked from.
    pub from: Cell,
    /// The fragment, and which way it was to be walked.
    pub way: Way,
    /// The place it truly led to; none outside the maze.
    pub to: Option<Cell>,
    /// What was seen on the way.
    pub observations: Vec<Observation>,
    /// The place it led to.
    pub sighting: Sighting,
}

/// Walks every fragment of a maze both ways, each from a fresh start in the middle of the place at its end: how far two walks along one
/// fragment differ, and how far those along two, is what all reasoning on the map stands on.
///
/// # Errors
/// [`TrialError`] if the robot cannot stand at a place, or a walk comes to no end.
pub fn survey(
    maze: &Maze,
    robot: &EpuckConfig,
    config: &WalkerConfig,
    seed: u64,
) -> Result<Vec<Surveyed>, TrialError> {
    let world: Arc<World> = Arc::new(world_of(maze, config.corridor_width)?);
    let fragments = TrueFragments::of(maze);
    let mut walks = Vec::new();
    for (cell, out, way) in fragments.ways() {
        // Whoever came by this fragment looks into the place.
        let start = Pose::new(world.cell_centre(cell), heading_of(out.opposite()));
        let mut walker = walker_at(Arc::clone(&world), start, robot, config.clone(), seed)?;
        walker.begin()?;
        let Walk::Arrived {
            observations,
            sighting,
            ..
        } = walker.walk(0, 0, None)?
        else {
            return Err(WalkError::Lost.into());
        };
        let end = walker.body().truth().pose.position;
        walks.push(Surveyed {
            from: cell,
            way,
            to: world.cell_at(end),
            observations,
            sighting,
        });
    }
    Ok(walks)
}

#[cfg(test)]
mod tests {
    use tolman_robot::epuck::{EpuckSensing, PROXIMITY_SENSORS, WheelSpeeds};
    use tolman_robot::{Landmark, Robot, SensesLandmarks};
    use tolman_sim::StepError;
    use tolman_sim::robots::Epuck;
    use tolman_systems::cpm::Walker;

    use super::*;
    use crate::cpm::trial::tests::maze_1;
    use crate::cpm::{SimulatedEpuck, epuck, walker_config};

    /// An e-puck whose sensors still tell of the hand that carried it, until its next time step.
    struct Carried {
        body: SimulatedEpuck,
        sensed: Option<EpuckSensing>,
    }

    impl Robot for Carried {
        type Command = WheelSpeeds;
        type Sensing = EpuckSensing;
        type Error = StepError;

        fn sensing(&self) -> &EpuckSensing {
            self.sensed.as_ref().unwrap_or_else(|| self.body.sensing())
        }

        fn step(&mut self, command: &WheelSpeeds) -> Result<(), StepError> {
            self.sensed = None;
            self.body.step(command)
        }
    }

    impl SensesLandmarks for Carried {
        fn landmark(&self) -> Option<Landmark> {
            self.body.landmark()
        }
    }

    #[test]
    fn what_it_sensed_before_it_was_put_down_is_no_part_of_what_it_sees() {
        let maze = maze_1();
        let world = Arc::new(world_of(&maze, 0.25).unwrap());
        let config = walker_config(&epuck(), 0.25).unwrap();
        for (from, out, _) in TrueFragments::of(&maze).ways() {
            let start = Pose::new(world.cell_centre(from), heading_of(out.opposite()));
            let robot = Epuck::new(epuck()).unwrap();
            let carried = Carried {
                body: SimulatedEpuck::new(Arc::clone(&world), robot, start, 1).unwrap(),
                sensed: Some(EpuckSensing {
                    proximity: Some([3800.0; PROXIMITY_SENSORS]),
                    ..EpuckSensing::default()
                }),
            };
            let seen = Walker::new(carried, config.clone()).begin().unwrap();
            assert_eq!(seen.degree, maze.degree(from) as u32, "at {from:?}");
        }
    }

    /// Consecutive sightings of a junction are one, none is passed unseen, and each has as many branches as there are.
    #[test]
    fn every_walk_leads_to_the_next_place() {
        for text in [
            include_str!("../../mazes/cpm-1.maze"),
            include_str!("../../mazes/cpm-2.maze"),
            include_str!("../../mazes/cpm-3.maze"),
        ] {
            let maze = tolman_maze::read(text).unwrap().maze;
            let config = walker_config(&epuck(), 0.25).unwrap();
            for walk in survey(&maze, &epuck(), &config, 4).unwrap() {
                assert_eq!(walk.to, Some(walk.way.to), "from {:?}", walk.from);
                let degree = maze.degree(walk.way.to) as u32;
                assert_eq!(walk.sighting.degree, degree, "at {:?}", walk.to);
            }
        }
    }

    /// Branches are counted from the one that it came by, also where a bend lets it stand askew in a junction.
    #[test]
    fn the_first_branch_leads_back() {
        let text = "start = 0 0 north\n\n\
            o---o---o---o---o---o\n\
            |       |           |\n\
            o   o   o   o   o---o\n\
            |   |       |       |\n\
            o   o---o   o   o   o\n\
            |       |   | G |   |\n\
            o   o   o   o---o   o\n\
            |   |   |           |\n\
            o   o   o---o---o   o\n\
            | S |               |\n\
            o---o---o---o---o---o\n";
        let maze = tolman_maze::read(text).unwrap().maze;
        let config = walker_config(&epuck(), 0.25).unwrap();
        let world = Arc::new(world_of(&maze, 0.25).unwrap());
        let fragments = TrueFragments::of(&maze);
        for (from, out, way) in fragments.ways() {
            let start = Pose::new(world.cell_centre(from), heading_of(out.opposite()));
            let (here, robot) = (Arc::clone(&world), epuck());
            let mut walker = walker_at(here, start, &robot, config.clone(), 2).unwrap();
            walker.begin().unwrap();
            for to in [way.to, from] {
                walker.walk(0, 0, None).unwrap();
                let end = walker.body().truth().pose.position;
                assert_eq!(world.cell_at(end), Some(to), "{from:?} by {way:?}");
            }
        }
    }
}
