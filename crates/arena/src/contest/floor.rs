//! Contests in worlds of free walls, such as occupancy grids.

use tolman_systems::stream;

use super::condition::Condition;
use super::play::{Bout, ContestError, ContestRecord, Measured, Moment, NO_STEPS, START_STREAM};
use crate::Outing;
use crate::course::{FreeWorld, Terrain, pick};
use crate::registry::{Registry, RobotEntry, Schooling, Settings, Setup, SystemEntry};

/// A contestant in a world of free walls, as made. It learns, localizes and drives to the goal as
/// in a [`Contest`](super::Contest); its map is compared with the true places of the floor.
#[derive(Clone, Copy, Debug)]
pub struct FloorContest<'a> {
    /// The system.
    pub contestant: &'static dyn SystemEntry,
    /// Robot that carries it; `None` for the one that it is made for.
    pub robot: Option<RobotEntry>,
    /// The world, with its destination.
    pub floor: &'a FreeWorld,
    /// Name of the world.
    pub name: &'a str,
    /// Number of times that the robot is put down to localize, and again to drive to the goal.
    pub starts: u32,
    /// Seed of all random numbers.
    pub seed: u64,
}

impl FloorContest<'_> {
    /// Holds the contest and returns its record. Calls `watch` with the contestant at every
    /// [`Moment`]. A contestant that cannot be sent into such a world, or whose robot does not fit,
    /// abstains with that reason. O(area) beside the drive.
    ///
    /// # Errors
    /// [`ContestError::PutDown`].
    pub fn play(
        &self,
        schooling: &Schooling,
        mut watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<ContestRecord, ContestError> {
        let outing = match self.enter(schooling) {
            Ok(outing) => outing,
            Err(why) => {
                return Ok(ContestRecord {
                    abstained: Some(why),
                    ..ContestRecord::default()
                });
            }
        };
        let mut bout = Bout::in_floor(self.contestant, outing);
        watch(&*bout.outing, Moment::Begun);
        let learned = bout.learn(None, &mut watch);
        let doubt = bout.outing.doubt();
        let put_error = |source| ContestError::PutDown {
            contestant: self.contestant.title(),
            world: self.name.to_owned(),
            source,
        };
        let (mut found, mut homes) = (Vec::new(), Vec::new());
        let ways = bout.outing.course().maze.ways_out();
        let mut rng = stream(self.seed, START_STREAM);
        for _ in 0..self.starts {
            let (Some(here), Some(there)) = (pick(&ways, &mut rng), pick(&ways, &mut rng)) else {
                break;
            };
            found.push(bout.locate(here, &mut watch).map_err(put_error)?);
            if !self.contestant.facts().watches {
                homes.push(bout.home(there, &mut watch).map_err(put_error)?);
            }
        }
        watch(&*bout.outing, Moment::Over);
        Ok(ContestRecord {
            abstained: None,
            learned: Some(learned),
            doubt,
            found,
            homes,
        })
    }

    /// Puts the contestant into the world, or returns why it cannot be.
    fn enter(&self, schooling: &Schooling) -> Result<Box<dyn Outing>, String> {
        if self.contestant.baseline().is_some() {
            return Err("baselines are sent into mazes alone".to_owned());
        }
        let own = || Registry::current().robot(self.contestant.facts().own_robot);
        let robot = self.robot.or_else(own).unwrap_or(RobotEntry::LASER_PIONEER);
        if let Some(why) = self.contestant.why_not(&robot) {
            return Err(why);
        }
        let terrain = Terrain::Free(self.floor.clone());
        let setup = Setup {
            world: self.name,
            terrain: &terrain,
            seed: self.seed,
            start: None,
            steps: Some(NO_STEPS),
            robot,
            from: None,
            settings: Settings {
                preset: self.contestant.facts().arena_preset,
                set: &[],
            },
            condition: Condition::AsMade,
            doors: &[],
            schooling,
        };
        let entered = self.contestant.learner(&setup);
        entered.map_err(|error| error.to_string())
    }
}
