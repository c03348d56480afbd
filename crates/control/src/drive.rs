use core::ops::ControlFlow;

use rand::Rng;
use tolman_maze::Direction;
use tolman_robot::{Compass, Ranges, Ring, Robot, TurnTranslate};

use crate::{Outcome, Proposal, Stack, View};

/// Carries out high-level actions through a [`Stack`], with any robot that senses ranges and its
/// heading.
///
/// ```
/// use core::ops::ControlFlow;
/// use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
/// use tolman_control::{Drive, Outcome, Stack};
/// use tolman_geom::Heading;
/// use tolman_maze::Direction;
/// use tolman_robot::{LaserSensing, Ring, Robot, TurnTranslate};
///
/// /// A robot in the open: it turns as it is told and never meets a wall.
/// struct Top(LaserSensing);
///
/// impl Robot for Top {
///     type Command = TurnTranslate;
///     type Sensing = LaserSensing;
///     type Error = core::convert::Infallible;
///
///     fn sensing(&self) -> &LaserSensing {
///         &self.0
///     }
///
///     fn step(&mut self, command: &TurnTranslate) -> Result<(), Self::Error> {
///         let turn = command.turn * 91_f64.to_radians();
///         self.0.compass = self.0.compass.map(|heading| heading.turned(turn));
///         Ok(())
///     }
/// }
///
/// let ring = Ring::full(72, 1.25);
/// let mut top = Top(LaserSensing::silent(ring));
/// top.0.compass = Some(Heading::EAST);
/// let mut drive = Drive::new(Stack::paper(ring, 0.5, 0.95)?, ChaCha8Rng::seed_from_u64(1));
/// let outcome = drive.carry_out(&mut top, Direction::North, |_| ControlFlow::Continue(()))?;
/// assert_eq!(outcome, Some(Outcome::Completed));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Drive<G> {
    stack: Stack,
    rng: G,
    longest_action: u32,
}

/// One time step of an action, as it has just been made.
#[derive(Debug)]
pub struct Driven<'a, R> {
    /// The action to which the step belongs.
    pub action: Direction,
    /// Command of the robot.
    pub command: TurnTranslate,
    /// Outcome of the action if it ended with this step; `None` while it goes on.
    pub ends: Option<Outcome>,
    /// The robot after the step.
    pub robot: &'a R,
}

impl<G: Rng> Drive<G> {
    /// Number of time steps after which an action that no layer has ended [times
    /// out](Outcome::TimedOut), such as that of a robot without a compass. Not in the paper.
    pub const LONGEST_ACTION: u32 = 100;

    /// Returns a drive by the layers of `stack`, which draw from `rng`. An action takes at most
    /// [`LONGEST_ACTION`](Self::LONGEST_ACTION) time steps.
    #[must_use]
    pub const fn new(stack: Stack, rng: G) -> Self {
        Self {
            stack,
            rng,
            longest_action: Self::LONGEST_ACTION,
        }
    }

    /// Returns this drive, whose actions take at most `steps` time steps, at least 1. The last step
    /// of an action that no layer has ended by then ends it as [`Outcome::TimedOut`].
    #[must_use]
    pub const fn longest_action(mut self, steps: u32) -> Self {
        self.longest_action = steps;
        self
    }

    /// Returns this drive, whose layers see scans [straightened](crate::straightened): see
    /// [`Stack::straightening`].
    #[must_use]
    pub fn straightening(mut self) -> Self {
        self.stack = self.stack.straightening();
        self
    }

    /// Returns the ring whose scans its layers read.
    #[must_use]
    pub const fn ring(&self) -> Ring {
        self.stack.ring()
    }

    /// Carries out `action` with `robot` and returns how it ended, or `None` where `see` broke it
    /// off. `see` is shown every time step once it is made. O(beams) a time step.
    ///
    /// # Errors
    /// If the robot fails.
    pub fn carry_out<R>(
        &mut self,
        robot: &mut R,
        action: Direction,
        mut see: impl FnMut(&Driven<'_, R>) -> ControlFlow<()>,
    ) -> Result<Option<Outcome>, R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: Ranges + Compass,
    {
        self.stack.begin(action);
        let mut step = 0;
        loop {
            step += 1;
            let Proposal { command, ends } = self.propose(robot);
            robot.step(&command)?;
            let ends = ends.or_else(|| (step >= self.longest_action).then_some(Outcome::TimedOut));
            let driven = Driven {
                action,
                command,
                ends,
                robot: &*robot,
            };
            if see(&driven).is_break() {
                return Ok(None);
            }
            if ends.is_some() {
                return Ok(ends);
            }
        }
    }

    /// Returns the layers' proposal for this time step. A robot without a scan or a heading stands
    /// still.
    fn propose<R>(&mut self, robot: &R) -> Proposal
    where
        R: Robot,
        R::Sensing: Ranges + Compass,
    {
        let sensing = robot.sensing();
        match (sensing.scan(), sensing.heading()) {
            (Some(scan), Some(heading)) => {
                self.stack.correct(View { scan, heading }, &mut self.rng)
            }
            // Blind for a moment: stand still until the sensors are back.
            _ => Proposal::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use tolman_robot::{LaserSensing, Ring};

    use super::*;

    /// A robot without sensors that counts its steps.
    struct Blind {
        sensing: LaserSensing,
        steps: u32,
    }

    impl Robot for Blind {
        type Command = TurnTranslate;
        type Sensing = LaserSensing;
        type Error = Infallible;

        fn sensing(&self) -> &LaserSensing {
            &self.sensing
        }

        fn step(&mut self, command: &TurnTranslate) -> Result<(), Infallible> {
            assert_eq!(*command, TurnTranslate::STOP);
            self.steps += 1;
            Ok(())
        }
    }

    fn blind() -> (Blind, Drive<ChaCha8Rng>) {
        let ring = Ring::full(72, 1.25);
        let sensing = LaserSensing {
            scan: None,
            ..LaserSensing::silent(ring)
        };
        let stack = Stack::paper(ring, 0.5, 0.95).unwrap();
        let drive = Drive::new(stack, ChaCha8Rng::seed_from_u64(1));
        (Blind { sensing, steps: 0 }, drive)
    }

    #[test]
    fn an_action_that_never_ends_times_out() {
        for longest in [1, 7, Drive::<ChaCha8Rng>::LONGEST_ACTION] {
            let (mut robot, drive) = blind();
            let mut drive = drive.longest_action(longest);
            let mut ends = None;
            let outcome = drive.carry_out(&mut robot, Direction::East, |step| {
                ends = step.ends;
                ControlFlow::Continue(())
            });
            assert_eq!(outcome, Ok(Some(Outcome::TimedOut)));
            assert_eq!(ends, Some(Outcome::TimedOut));
            assert_eq!(robot.steps, longest);
        }
    }

    #[test]
    fn an_action_can_be_broken_off() {
        let (mut robot, mut drive) = blind();
        let outcome = drive.carry_out(&mut robot, Direction::East, |step| {
            if step.robot.steps == 3 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        assert_eq!(outcome, Ok(None));
        assert_eq!(robot.steps, 3);
    }
}
