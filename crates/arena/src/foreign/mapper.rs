//! Lets a foreign program watch a robot that a system of ours drives.

use core::time::Duration;

use thiserror::Error;
use tolman_robot::{
    Landmark, LaserSensing, Robot, SensesLandmarks, Standing, System, Task, TurnTranslate,
};

use super::brain::{BrainError, Foreign, Hello};
use super::talk::Talk;
use super::{Budget, Launch, LaunchError};
use crate::BoxError;
use crate::mslst::BetterDriver;

/// A program that watches a robot that MSLST Better drives.
///
/// It gets the lines of a [`ForeignBrain`](super::ForeignBrain) that
/// [learns](super::ForeignBrain::learning), and answers only what it is asked for: its belief after
/// each time step, and its map. The page `docs/brain.md` has the lines. A task ends when the driver
/// ends it. A robot that was put down is located where the mapper then believes it to be.
pub type ForeignMapper = Foreign<BetterDriver>;

/// A robot whose time steps are told to a program.
struct Watched<'a, R> {
    robot: &'a mut R,
    talk: &'a mut Talk,
    task: Task,
    /// Reason why the program is heard no more.
    fault: &'a mut Option<BrainError>,
}

/// Reason why a watched robot makes no step.
#[derive(Debug, Error)]
enum WatchedError {
    #[error(transparent)]
    Robot(BoxError),
    #[error("the mapper failed")]
    Mapper,
}

impl ForeignMapper {
    /// Starts a program to watch the robot of `hello`, which `driver` drives.
    ///
    /// # Errors
    /// As [`ForeignProgram::start`](super::ForeignProgram::start).
    pub fn watching(
        launch: &Launch<'_>,
        budget: Budget,
        hello: Hello,
        driver: BetterDriver,
    ) -> Result<Self, LaunchError> {
        Self::driven(launch, budget, hello, true, driver)
    }

    /// Returns how long the program kept us waiting.
    #[must_use]
    pub fn waited(&self) -> Duration {
        self.talk.borrow().waited()
    }
}

impl<R> System<R> for ForeignMapper
where
    R: SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing, Error: Into<BoxError>>,
{
    type Failure = BoxError;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, BoxError> {
        let talk = self.talk.get_mut();
        if let Some(why) = &talk.failed {
            return Ok(Standing::gave_up(why));
        }
        let mut fault = None;
        let is_news = talk.is_news(task);
        let mut watched = Watched {
            robot,
            talk,
            task,
            fault: &mut fault,
        };
        let driven = match is_news && watched.tell().is_err() {
            true => Ok(Standing::UnderWay),
            false => self.driver.act(&mut watched, task),
        };
        if let Some(fault) = fault {
            return Ok(self.failed(fault)?);
        }
        let is_over = driven? != Standing::UnderWay;
        let is_sure = self.talk.get_mut().is_sure();
        let is_lost = task == Task::Localize && !is_sure;
        let standing = match (is_over, is_lost) {
            (false, _) => Standing::UnderWay,
            (true, false) => Standing::Done,
            (true, true) => Standing::gave_up("it does not say where it is"),
        };
        Ok(self.ended(standing))
    }

    fn put_down(&mut self) -> Standing {
        let driver = System::<Watched<'_, R>>::put_down(&mut self.driver);
        match driver {
            Standing::UnderWay => self.goes_on(),
            other => other,
        }
    }
}

impl<R> Watched<'_, R>
where
    R: SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing>,
{
    /// Tells the program what the robot senses.
    fn tell(&mut self) -> Result<(), WatchedError> {
        let told = self
            .talk
            .tell(self.robot.sensing(), self.robot.landmark(), self.task);
        told.map(drop).map_err(|error| {
            *self.fault = Some(error);
            WatchedError::Mapper
        })
    }
}

impl<R> Robot for Watched<'_, R>
where
    R: SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing, Error: Into<BoxError>>,
{
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = WatchedError;

    fn sensing(&self) -> &LaserSensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), WatchedError> {
        let made = self.robot.step(command);
        made.map_err(|error| WatchedError::Robot(error.into()))?;
        self.talk.steps += 1;
        self.tell()
    }
}

impl<R> SensesLandmarks for Watched<'_, R>
where
    R: SensesLandmarks<Command = TurnTranslate, Sensing = LaserSensing, Error: Into<BoxError>>,
{
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}
