//! Lets a foreign program watch a robot that a system of ours drives.

use alloc::fmt;
use core::cell::RefCell;
use core::convert::Infallible;
use core::time::Duration;

use thiserror::Error;
use tolman_robot::{
    Guess, Landmark, LaserSensing, MapView, Mapper, Robot, SensesLandmarks, Standing, System, Task,
    TurnTranslate, VisitNaming,
};

use super::brain::{self, BrainError, Hello};
use super::talk::Talk;
use super::{Budget, Launch, LaunchError};
use crate::BoxError;
use crate::mslst::BetterDriver;

/// A mapper that is a program of its own, in any language. MSLST Better drives its robot.
///
/// It gets the lines of a [`ForeignBrain`](super::ForeignBrain) that
/// [learns](super::ForeignBrain::learning), and answers only what it is asked for: its belief after
/// each time step, and its map. The page `docs/brain.md` has the lines. A task ends when the driver
/// ends it. A robot that was put down is located where the mapper then believes it to be.
pub struct ForeignMapper {
    talk: RefCell<Talk>,
    driver: BetterDriver,
}

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

impl fmt::Debug for ForeignMapper {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ForeignMapper")
            .field("talk", &self.talk)
            .finish_non_exhaustive()
    }
}

impl ForeignMapper {
    /// Starts a program to watch the robot of `hello`, which `driver` drives.
    ///
    /// # Errors
    /// As [`ForeignProgram::start`](super::ForeignProgram::start).
    pub fn start(
        launch: &Launch<'_>,
        budget: Budget,
        hello: Hello,
        driver: BetterDriver,
    ) -> Result<Self, LaunchError> {
        let talk = RefCell::new(Talk::start(launch, budget, hello, true)?);
        Ok(Self { talk, driver })
    }

    /// Returns how long the program kept us waiting.
    #[must_use]
    pub fn waited(&self) -> Duration {
        self.talk.borrow().waited()
    }
}

impl Mapper for ForeignMapper {
    type Observation = ();
    type Error = Infallible;

    fn observe(&mut self, (): &()) -> Result<(), Infallible> {
        Ok(())
    }

    fn map(&self) -> MapView {
        brain::map(&self.talk)
    }

    fn belief(&self) -> Vec<Guess> {
        self.talk.borrow().belief.clone()
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachStep
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.talk.borrow().visits()
    }

    fn visit_count(&self) -> usize {
        self.talk.borrow().visit_count()
    }

    fn doubt(&self) -> Option<String> {
        brain::doubt(&self.talk)
    }

    fn certainty(&self) -> Option<f64> {
        brain::certainty(&self.talk)
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
            return Ok(brain::failed(&self.talk, fault)?);
        }
        let is_over = driven? != Standing::UnderWay;
        let is_sure = self.talk.get_mut().is_sure();
        let is_lost = task == Task::Localize && !is_sure;
        let standing = match (is_over, is_lost) {
            (false, _) => Standing::UnderWay,
            (true, false) => Standing::Done,
            (true, true) => Standing::gave_up("it does not say where it is"),
        };
        Ok(brain::ended(&self.talk, standing))
    }

    fn put_down(&mut self) -> Standing {
        let driver = System::<Watched<'_, R>>::put_down(&mut self.driver);
        match driver {
            Standing::UnderWay => brain::put_down(&self.talk),
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
