use core::ops::ControlFlow;

use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::{Drive, Driven, Outcome, Stack};
use tolman_robot::{
    Compass, Fitted, Goal, Guess, MapView, Mapper, Ranges, Ring, Robot, RobotMeasures,
    SensesLandmarks, Standing, System, Task, TurnTranslate, VisitNaming,
};

use crate::mslst::ROBOT_UNIT;
use crate::on_robot::{CORRIDOR_WIDTH, fitted, needed};
use crate::{Brain, Doing, ForRobotError, LaserRobot, OfStep, OnRobot, stream};

/// A [`Brain`] with the layers of a body: it drives any robot that turns and translates, and senses
/// ranges, its heading and landmarks.
///
/// An action of the [`System`] is one of the brain's. It ends early if the robot senses its target
/// landmark; to the brain it then was carried out.
#[derive(Debug)]
pub struct Actor<B> {
    brain: B,
    drive: Drive<ChaCha8Rng>,
    rng: ChaCha8Rng,
    before: Before,
}

/// State before the next action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Before {
    /// The robot was put down.
    PutDown,
    /// An action ended, and the brain observed it.
    Action,
}

/// Reason why an actor cannot go on.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ActorError<R, B> {
    /// The robot failed.
    #[error("the robot failed")]
    Robot(#[source] R),
    /// The brain refuses its observation.
    #[error("the brain cannot use what the robot sensed; check the robot's sensors")]
    Brain(#[source] B),
    /// The layers cannot read the robot's scans.
    #[error(
        "the robot's ring has {} beams up to {} m, but its layers expect {} up to {} m: make the layers for the robot's ring",
        robot.beams, robot.max_range, layers.beams, layers.max_range
    )]
    Ring {
        /// The ring of the robot's scans.
        robot: Ring,
        /// Ring for which the layers are made.
        layers: Ring,
    },
}

/// Stream of an actor's seed for its layers.
const LAYERS_STREAM: u64 = 1;
const BRAIN_STREAM: u64 = 2;

impl<B: Brain> Actor<B> {
    /// Returns `brain` with the layers of `stack`. Both draw from streams of `seed`.
    #[must_use]
    pub fn seeded(brain: B, stack: Stack, seed: u64) -> Self {
        let drive = Drive::new(stack, stream(seed, LAYERS_STREAM));
        Self::new(brain, drive, stream(seed, BRAIN_STREAM))
    }

    /// Returns the brain that `made` returns for a ring and a diameter, on a robot of these
    /// measures, with the layers of the laser Pioneer. A robot that fills more of its corridors is
    /// wider to both, in the system's metres. All random numbers follow from `seed`.
    ///
    /// # Errors
    /// If the measures contradict each other, or there is no compass.
    pub fn for_robot<R: LaserRobot>(
        made: impl FnOnce(Ring, f64) -> B,
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<OnRobot<Fitted<R>, Self>, ForRobotError> {
        needed(measures.compass_error, "compass_error")?;
        let (robot, system) = Self::fitted(made, measures, robot, seed)?;
        let metre = robot.metre();
        Ok(OnRobot::new(robot, system, metre))
    }

    /// Returns the robot as the system sees it, and the system.
    pub(crate) fn fitted<R: LaserRobot>(
        made: impl FnOnce(Ring, f64) -> B,
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<(Fitted<R>, Self), ForRobotError> {
        let robot = fitted(measures, robot, CORRIDOR_WIDTH)?;
        let ring = robot.made_for().ring;
        let diameter = ROBOT_UNIT.max(measures.diameter / robot.metre());
        let layers = Stack::paper(ring, diameter, CORRIDOR_WIDTH)?;
        Ok((robot, Self::seeded(made(ring, diameter), layers, seed)))
    }

    /// Returns `brain`, whose actions `drive` carries out. The layers see [what the brain
    /// says](Brain::sees_straight). The brain draws from `rng`.
    #[must_use]
    pub fn new(brain: B, drive: Drive<ChaCha8Rng>, rng: ChaCha8Rng) -> Self {
        let drive = if brain.sees_straight() {
            drive.straightening()
        } else {
            drive
        };
        Self {
            brain,
            drive,
            rng,
            before: Before::PutDown,
        }
    }

    /// Returns the brain.
    #[must_use]
    pub const fn brain(&self) -> &B {
        &self.brain
    }

    /// Returns the brain.
    #[must_use]
    pub fn into_brain(self) -> B {
        self.brain
    }

    /// Tells the actor that its robot has been lifted and put down, perhaps elsewhere.
    pub const fn put_down(&mut self) {
        self.before = Before::PutDown;
    }

    /// Makes the next action as [`System::act`] does. `see` is shown the brain and every time step
    /// once it is made, before the brain observes it.
    ///
    /// # Errors
    /// If the robot fails, or the brain cannot use its readings.
    pub fn act_seen<R>(
        &mut self,
        robot: &mut R,
        task: Task,
        mut see: impl FnMut(&B, &Driven<'_, R>),
    ) -> Result<Standing, ActorError<R::Error, B::Error>>
    where
        R: Robot<Command = TurnTranslate> + SensesLandmarks,
        R::Sensing: Ranges + Compass,
        B::Observation: OfStep<R>,
    {
        if self.before == Before::PutDown {
            let layers = self.drive.ring();
            if let Some(scan) = robot.sensing().scan()
                && scan.ring != layers
            {
                let robot = scan.ring;
                return Err(ActorError::Ring { robot, layers });
            }
            let observed = self
                .brain
                .observe(&OfStep::of_step(&*robot, Doing::PutDown));
            observed.map_err(ActorError::Brain)?;
            self.before = Before::Action;
        }
        if has_arrived(robot, task) {
            return Ok(Standing::Done);
        }
        self.brain.aim(task);
        let standing = self.brain.standing(task);
        if standing != Standing::UnderWay {
            return Ok(standing);
        }
        let action = self.brain.choose(&mut self.rng);
        // Until it has ended, the next action does not follow from it.
        self.before = Before::PutDown;
        let Self { brain, drive, .. } = self;
        let mut observed = Ok(());
        let outcome = drive.carry_out(robot, action, |step| {
            see(brain, step);
            let doing = match has_arrived(step.robot, task) {
                true => Doing::Ended(action, Outcome::Completed),
                false => Doing::of(step),
            };
            observed = brain.observe(&OfStep::of_step(step.robot, doing));
            match observed.is_err() || has_arrived(step.robot, task) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        let outcome = outcome.map_err(ActorError::Robot)?;
        observed.map_err(ActorError::Brain)?;
        self.before = Before::Action;
        if outcome.is_none() {
            return Ok(Standing::Done);
        }
        Ok(self.brain.standing(task))
    }
}

/// Returns whether the robot senses its target landmark.
fn has_arrived<R: SensesLandmarks>(robot: &R, task: Task) -> bool {
    match task {
        Task::Reach(Goal::Landmark(goal)) => robot.landmark() == Some(goal),
        Task::Reach(Goal::Place(_) | Goal::Point(_)) | Task::Explore | Task::Localize => false,
    }
}

impl<B: Brain> Mapper for Actor<B> {
    type Observation = B::Observation;
    type Error = B::Error;

    fn observe(&mut self, seen: &B::Observation) -> Result<(), B::Error> {
        self.brain.observe(seen)
    }

    fn map(&self) -> MapView {
        self.brain.map()
    }

    fn belief(&self) -> Vec<Guess> {
        self.brain.belief()
    }

    fn visit_naming(&self) -> VisitNaming {
        self.brain.visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.brain.visits()
    }

    fn visit_count(&self) -> usize {
        self.brain.visit_count()
    }

    fn certainty(&self) -> Option<f64> {
        self.brain.certainty()
    }

    fn doubt(&self) -> Option<String> {
        self.brain.doubt()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.brain.map_bytes()
    }
}

impl<B, R> System<R> for Actor<B>
where
    B: Brain,
    R: Robot<Command = TurnTranslate> + SensesLandmarks,
    R::Sensing: Ranges + Compass,
    B::Observation: OfStep<R>,
{
    type Failure = ActorError<R::Error, B::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        self.act_seen(robot, task, |_, _| {})
    }

    fn put_down(&mut self) -> Standing {
        self.before = Before::PutDown;
        Standing::UnderWay
    }

    fn words(&self) -> String {
        self.brain.words()
    }
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use tolman_robot::{Landmark, LaserMeasures, LaserSensing};

    use super::*;
    use crate::baselines::Random;

    struct Still(LaserSensing);

    impl Robot for Still {
        type Command = TurnTranslate;
        type Sensing = LaserSensing;
        type Error = Infallible;

        fn sensing(&self) -> &LaserSensing {
            &self.0
        }

        fn step(&mut self, _: &TurnTranslate) -> Result<(), Infallible> {
            Ok(())
        }
    }

    impl SensesLandmarks for Still {
        fn landmark(&self) -> Option<Landmark> {
            None
        }
    }

    #[test]
    fn a_robot_that_fills_its_corridors_is_wide_to_its_brain() {
        for (corridor, expected) in [(1.5, 1.9 / 1.5), (1.9, 1.0), (3.0, 1.0)] {
            let laser = LaserMeasures::all_round(72, 0.0, 10.0);
            let measures = RobotMeasures::new(0.3, 0.3 * corridor, laser);
            let mut told = 0.0;
            let brain = |_, diameter| {
                told = diameter / ROBOT_UNIT;
                Random
            };
            let robot = Still(LaserSensing::silent(laser.ring()));
            Actor::for_robot(brain, &measures, robot, 1).unwrap();
            assert!((told - expected).abs() < 1e-9, "{corridor}: {told}");
        }
    }
}
