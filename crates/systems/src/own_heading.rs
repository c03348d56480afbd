use core::f64::consts::PI;

use tolman_control::{HeadingFilter, HeadingReadings};
use tolman_geom::Heading;
use tolman_robot::{
    Bumps, Clock, Compass, Fitted, Guess, Landmark, LaserSensing, MapView, Mapper, Ranges, Ring,
    Robot, RobotMeasures, Rolls, SensesLandmarks, Standing, System, Task, TurnTranslate,
    VisitNaming,
};

use crate::{Actor, ActorError, Brain, ForRobotError, LaserRobot, OfStep, OnRobot};

/// An [`Actor`] that needs no compass: its heading is [its own](HeadingFilter), from wheels and
/// walls. A compass or a gyro only helps.
#[derive(Debug)]
pub struct OwnHeading<B> {
    actor: Actor<B>,
    filter: HeadingFilter,
    /// Whether the filter has the readings of where the robot stands.
    has_looked: bool,
}

/// A robot whose heading is the filter's.
#[derive(Debug)]
pub struct Oriented<'a, R> {
    robot: &'a mut R,
    filter: &'a mut HeadingFilter,
    sensing: LaserSensing,
}

impl<B: Brain> OwnHeading<B> {
    /// Returns `actor` with a heading of its own. The robot's compass is off by a constant of this
    /// standard deviation, rad; π where its zero may be anywhere, or without one.
    #[must_use]
    pub fn new(actor: Actor<B>, compass_sd: f64) -> Self {
        Self {
            actor,
            filter: HeadingFilter::new(compass_sd),
            has_looked: false,
        }
    }

    /// Returns the brain that `made` returns for a ring and a diameter, on a robot of these
    /// measures, as [`Actor::for_robot`] does; but it needs no compass.
    ///
    /// # Errors
    /// If the measures contradict each other.
    pub fn for_robot<R: LaserRobot>(
        made: impl FnOnce(Ring, f64) -> B,
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<OnRobot<Fitted<R>, Self>, ForRobotError> {
        let (robot, actor) = Actor::fitted(made, measures, robot, seed)?;
        let metre = robot.metre();
        let system = Self::new(actor, measures.compass_error.unwrap_or(PI));
        Ok(OnRobot::new(robot, system, metre))
    }

    /// Returns the brain.
    #[must_use]
    pub const fn brain(&self) -> &B {
        self.actor.brain()
    }
}

impl<'a, R> Oriented<'a, R>
where
    R: Robot,
    R::Sensing: Ranges + Compass + Rolls + Bumps + Clock,
{
    fn new(robot: &'a mut R, filter: &'a mut HeadingFilter) -> Self {
        let sensing = sensed(robot.sensing(), filter);
        Self {
            robot,
            filter,
            sensing,
        }
    }
}

/// Returns what a robot senses, with the filter's heading in place of the compass's.
fn sensed<S>(sensing: &S, filter: &HeadingFilter) -> LaserSensing
where
    S: Ranges + Rolls + Bumps + Clock,
{
    LaserSensing {
        time_us: sensing.time_us(),
        scan: sensing.scan().cloned(),
        compass: Some(filter.heading()),
        odometry: sensing.odometry(),
        bump: sensing.bump(),
    }
}

fn readings<S: Ranges + Compass + Rolls>(sensing: &S) -> HeadingReadings<'_> {
    HeadingReadings {
        turn: sensing.odometry().map(|odometry| odometry.turn),
        compass: sensing.heading(),
        scan: sensing.scan(),
    }
}

impl<R> Robot for Oriented<'_, R>
where
    R: Robot<Command = TurnTranslate>,
    R::Sensing: Ranges + Compass + Rolls + Bumps + Clock,
{
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = R::Error;

    fn sensing(&self) -> &LaserSensing {
        &self.sensing
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), R::Error> {
        self.robot.step(command)?;
        let now = self.robot.sensing();
        self.filter.step(&readings(now));
        self.sensing = sensed(now, self.filter);
        Ok(())
    }
}

impl<R> SensesLandmarks for Oriented<'_, R>
where
    R: SensesLandmarks<Command = TurnTranslate>,
    R::Sensing: Ranges + Compass + Rolls + Bumps + Clock,
{
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}

impl<B, R> System<R> for OwnHeading<B>
where
    B: Brain,
    R: SensesLandmarks<Command = TurnTranslate>,
    R::Sensing: Ranges + Compass + Rolls + Bumps + Clock,
    B::Observation: for<'a> OfStep<Oriented<'a, R>>,
{
    type Failure = ActorError<R::Error, B::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        if !self.has_looked {
            let still = HeadingReadings {
                turn: Some(0.0),
                ..readings(robot.sensing())
            };
            self.filter.step(&still);
            self.has_looked = true;
        }
        let mut robot = Oriented::new(robot, &mut self.filter);
        self.actor.act(&mut robot, task)
    }

    fn put_down(&mut self) -> Standing {
        self.filter.put_down();
        self.has_looked = false;
        self.actor.put_down();
        Standing::UnderWay
    }

    fn heading(&self) -> Option<Heading> {
        Some(self.filter.heading())
    }

    fn words(&self) -> String {
        self.brain().words()
    }
}

impl<B: Brain> Mapper for OwnHeading<B> {
    type Observation = B::Observation;
    type Error = B::Error;

    fn observe(&mut self, seen: &B::Observation) -> Result<(), B::Error> {
        self.actor.observe(seen)
    }

    fn map(&self) -> MapView {
        self.actor.map()
    }

    fn belief(&self) -> Vec<Guess> {
        self.actor.belief()
    }

    fn visit_naming(&self) -> VisitNaming {
        self.actor.visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.actor.visits()
    }

    fn visit_count(&self) -> usize {
        self.actor.visit_count()
    }

    fn certainty(&self) -> Option<f64> {
        self.actor.certainty()
    }

    fn doubt(&self) -> Option<String> {
        self.actor.doubt()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.actor.map_bytes()
    }
}
