use core::error::Error;

use thiserror::Error as ThisError;
use tolman_control::RingError;
use tolman_geom::{Heading, OutOfRange};
use tolman_maps::cpm::CpmError;
use tolman_robot::{
    Fitted, Goal, Guess, LaserSensing, MadeFor, MapView, MeasuresError, Position, Ring, Robot,
    RobotMeasures, SensesLandmarks, Standing, Stopping, System, Task, TurnTranslate, VisitNaming,
};

use crate::cpm::UnfitRing;
use crate::mslst::ROBOT_UNIT;

/// A system on its robot, of whatever size: what `for_robot` of each system returns.
///
/// It works in the system's metres, and its map and belief are in the robot's. The robot stands
/// still when this goes out of scope.
#[derive(Debug)]
pub struct OnRobot<R: Robot, S> {
    robot: Stopping<R>,
    system: S,
    /// Length of the system's metre, m of the robot.
    metre: f64,
    /// Whether what the robot senses is from where it stands.
    has_looked: bool,
}

/// Reason why a system cannot be put on a robot.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum ForRobotError {
    /// The measures contradict each other, or lack one that the system needs.
    #[error(transparent)]
    Measures(#[from] MeasuresError),
    /// The layers do not fit.
    #[error(transparent)]
    Layers(#[from] RingError),
    /// A length is out of the system's bounds.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// The ring does not fit.
    #[error(transparent)]
    Ring(#[from] UnfitRing),
    /// CPM's patterns cannot be configured so.
    #[error(transparent)]
    Cpm(#[from] CpmError),
}

/// Any system on any robot.
pub trait AnyOnRobot {
    /// Makes the next action of `task`, as [`System::act`] does.
    ///
    /// # Errors
    /// If the robot fails or the system cannot go on with it. The robot stands still.
    fn act(&mut self, task: Task) -> Result<Standing, Box<dyn Error + Send + Sync>>;

    /// Tells the system that its robot was lifted and put down, as [`System::put_down`] does.
    fn put_down(&mut self) -> Standing;

    /// Returns the map, in the robot's metres. O(map).
    fn map(&self) -> MapView;

    /// Returns where the system believes the robot to be, in the robot's metres.
    fn belief(&self) -> Vec<Guess>;

    /// Returns where the system believes the robot to look, as [`System::heading`] does.
    fn heading(&self) -> Option<Heading>;

    /// Returns when the system names a place of [`visits`](Self::visits).
    fn visit_naming(&self) -> VisitNaming;

    /// Returns the places that it visited, in order, as [`tolman_robot::Mapper::visits`] does.
    fn visits(&self) -> Vec<Option<u32>>;

    /// Returns the number of visits.
    fn visit_count(&self) -> usize;

    /// Returns why the map may be wrong or unfinished, as [`tolman_robot::Mapper::doubt`] does.
    fn doubt(&self) -> Option<String>;

    /// Returns the probability that the map is right, as [`tolman_robot::Mapper::certainty`] does.
    fn certainty(&self) -> Option<f64>;

    /// Returns the system's situation in a few words.
    fn words(&self) -> String;
}

impl<R: Robot, S> OnRobot<R, S> {
    /// Puts `system` on `robot`. The system's metre is `metre` long in the robot's metres.
    pub(crate) const fn new(robot: R, system: S, metre: f64) -> Self {
        Self {
            robot: Stopping::new(robot),
            system,
            metre,
            has_looked: false,
        }
    }

    /// Returns the system.
    #[must_use]
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// Returns the robot, as the system sees it.
    #[must_use]
    pub fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, to be lifted.
    pub const fn robot_mut(&mut self) -> &mut R {
        self.robot.robot_mut()
    }
}

impl<R, S> AnyOnRobot for OnRobot<R, S>
where
    R: Robot<Error: Into<Box<dyn Error + Send + Sync>>>,
    S: System<R, Failure: Into<Box<dyn Error + Send + Sync>>>,
{
    fn act(&mut self, task: Task) -> Result<Standing, Box<dyn Error + Send + Sync>> {
        if !self.has_looked {
            self.robot.stop().map_err(Into::into)?;
            self.has_looked = true;
        }
        let task = match task {
            Task::Reach(Goal::Point(at)) => Task::Reach(Goal::Point(at / self.metre)),
            other => other,
        };
        let acted = self.system.act(self.robot.robot_mut(), task);
        acted.map_err(Into::into)
    }

    fn put_down(&mut self) -> Standing {
        self.has_looked = false;
        self.system.put_down()
    }

    fn map(&self) -> MapView {
        let mut map = self.system.map();
        for place in &mut map.places {
            place.position = place.position.map(|at| at * self.metre);
        }
        for at in map.ways.iter_mut().flatten().chain(&mut map.floor) {
            *at *= self.metre;
        }
        map
    }

    fn belief(&self) -> Vec<Guess> {
        let mut belief = self.system.belief();
        for guess in &mut belief {
            if let Position::Point(at) = &mut guess.at {
                *at *= self.metre;
            }
        }
        belief
    }

    fn heading(&self) -> Option<Heading> {
        self.system.heading()
    }

    fn visit_naming(&self) -> VisitNaming {
        self.system.visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.system.visits()
    }

    fn visit_count(&self) -> usize {
        self.system.visit_count()
    }

    fn doubt(&self) -> Option<String> {
        self.system.doubt()
    }

    fn certainty(&self) -> Option<f64> {
        self.system.certainty()
    }

    fn words(&self) -> String {
        self.system.words()
    }
}

/// A robot that `for_robot` takes.
pub trait LaserRobot:
    SensesLandmarks<
        Command = TurnTranslate,
        Sensing: AsRef<LaserSensing>,
        Error: Error + Send + Sync + 'static,
    >
{
}

impl<R> LaserRobot for R where
    R: SensesLandmarks<
            Command = TurnTranslate,
            Sensing: AsRef<LaserSensing>,
            Error: Error + Send + Sync + 'static,
        >
{
}

/// Returns the laser Pioneer, for which the systems are made, in corridors of this width, m.
pub(crate) fn pioneer(corridor_width: f64) -> MadeFor {
    MadeFor {
        corridor_width,
        ring: Ring::full(72, 2.5 * ROBOT_UNIT),
        turn_per_step: 91_f64.to_radians(),
        translate_per_step: 2.0 * ROBOT_UNIT,
        step_us: 100_000,
    }
}

/// Width of the corridors for which MSLST's layers and CPM are made, m.
pub(crate) const CORRIDOR_WIDTH: f64 = 1.9 * ROBOT_UNIT;

/// Returns `robot` as the laser Pioneer in corridors of this width, m.
pub(crate) fn fitted<R: LaserRobot>(
    measures: &RobotMeasures,
    robot: R,
    corridor_width: f64,
) -> Result<Fitted<R>, ForRobotError> {
    Ok(Fitted::new(robot, *measures, pioneer(corridor_width))?)
}

/// Returns a measure that a system needs.
pub(crate) fn needed<T>(measure: Option<T>, field: &'static str) -> Result<T, MeasuresError> {
    measure.ok_or(MeasuresError::Missing { field })
}
