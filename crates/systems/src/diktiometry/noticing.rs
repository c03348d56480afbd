use core::error::Error;

use thiserror::Error as ThisError;
use tolman_maps::diktiometry::PlaceId;
use tolman_maze::Direction;
use tolman_robot::{Goal, Landmark, Robot, SensesLandmarks, Task};

use super::{MapError, RoutineError};

/// Position of a landmark on a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LandmarkSpot {
    /// At a place.
    Place(PlaceId),
    /// On the way in a direction from a place.
    Way(PlaceId, Direction),
}

/// A robot that notices landmarks on its way, and breaks off at the one that it seeks.
#[derive(Debug)]
pub(super) struct Noticing<'a, R> {
    robot: &'a mut R,
    sought: Option<Landmark>,
    /// Last landmark that was sensed on the way.
    passed: Option<Landmark>,
}

/// Reason why a [`Noticing`] robot breaks off.
#[derive(Debug, ThisError)]
pub(super) enum BreakOff<E: Error + 'static> {
    /// It stands at the landmark that it seeks.
    #[error("it stands at the landmark")]
    Found,
    /// The robot refuses a command.
    #[error(transparent)]
    Robot(E),
}

impl<'a, R> Noticing<'a, R> {
    pub(super) const fn new(robot: &'a mut R, sought: Option<Landmark>) -> Self {
        Self {
            robot,
            sought,
            passed: None,
        }
    }

    /// Returns the last landmark that was sensed on the way, if it is at neither end.
    pub(super) fn on_the_way(&self, ends: [Option<Landmark>; 2]) -> Option<Landmark> {
        self.passed.filter(|_| !ends.contains(&self.passed))
    }
}

impl<R> Robot for Noticing<'_, R>
where
    R: SensesLandmarks<Error: Error + 'static>,
{
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = BreakOff<R::Error>;

    fn sensing(&self) -> &R::Sensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), Self::Error> {
        self.robot.step(command).map_err(BreakOff::Robot)?;
        let here = self.robot.landmark();
        self.passed = here.or(self.passed);
        match here {
            Some(_) if here == self.sought => Err(BreakOff::Found),
            _ => Ok(()),
        }
    }
}

impl<R> SensesLandmarks for Noticing<'_, R>
where
    R: SensesLandmarks<Error: Error + 'static>,
{
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}

/// Returns the landmark of a task at which a robot breaks off on its way. Where `spot_of` has it at
/// a place, the robot goes on to the place.
pub(super) fn sought(
    task: Task,
    spot_of: impl FnOnce(Landmark) -> Option<LandmarkSpot>,
) -> Option<Landmark> {
    let Task::Reach(Goal::Landmark(landmark)) = task else {
        return None;
    };
    let is_at_a_place = matches!(spot_of(landmark), Some(LandmarkSpot::Place(_)));
    (!is_at_a_place).then_some(landmark)
}

/// Returns the error of the robot, or `None` if it broke off at the landmark that it seeks.
pub(super) fn of_robot<E: Error>(error: RoutineError<BreakOff<E>>) -> Option<RoutineError<E>> {
    Some(match error {
        RoutineError::Robot(BreakOff::Found) => return None,
        RoutineError::Robot(BreakOff::Robot(error)) => RoutineError::Robot(error),
        RoutineError::Sense(error) => RoutineError::Sense(error),
        RoutineError::Reading(error) => RoutineError::Reading(error),
        RoutineError::Signature(error) => RoutineError::Signature(error),
        RoutineError::Lost { direction, steps } => RoutineError::Lost { direction, steps },
    })
}

/// Does the same as [`of_robot`] for a robot that maps.
pub(super) fn of_mapper<E: Error>(
    error: MapError<RoutineError<BreakOff<E>>>,
) -> Option<MapError<RoutineError<E>>> {
    Some(match error {
        MapError::Robot(error) => MapError::Robot(of_robot(error)?),
        MapError::Start(error) => MapError::Start(error),
        MapError::Step(error) => MapError::Step(error),
    })
}
