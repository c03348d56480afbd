use alloc::boxed::Box;

/// A robot that acts and senses in fixed time steps: the simulator's, a replayed one, or a
/// driver's.
///
/// ```
/// use tolman_robot::Robot;
///
/// /// A robot on a rail: told how far to roll, it senses where it is.
/// struct Cart(f64);
///
/// impl Robot for Cart {
///     type Command = f64;
///     type Sensing = f64;
///     type Error = core::convert::Infallible;
///
///     fn sensing(&self) -> &f64 {
///         &self.0
///     }
///
///     fn step(&mut self, command: &f64) -> Result<(), Self::Error> {
///         self.0 += command;
///         Ok(())
///     }
/// }
///
/// let mut cart = Cart(0.0);
/// cart.step(&1.5).unwrap();
/// assert_eq!(*cart.sensing(), 1.5);
/// ```
pub trait Robot {
    /// Command for one time step.
    type Command: Standstill;
    /// Readings after a time step.
    type Sensing;
    /// Reason why a step can fail: a lost connection, a command that is not a number.
    type Error;

    /// Returns the readings at the end of the last step, or at rest before the first step.
    fn sensing(&self) -> &Self::Sensing;

    /// Carries out `command` for one time step and senses again.
    ///
    /// # Errors
    /// The reason why the robot does not carry out the command. It then stands still.
    fn step(&mut self, command: &Self::Command) -> Result<(), Self::Error>;

    /// Commands the robot to stand still for one time step.
    ///
    /// # Errors
    /// As [`Self::step`].
    fn stop(&mut self) -> Result<(), Self::Error> {
        self.step(&Self::Command::STOP)
    }
}

/// A command that makes a robot stand still.
pub trait Standstill {
    /// Command for standing still.
    const STOP: Self;
}

/// Standing still does not count as a change.
impl Standstill for f64 {
    const STOP: Self = 0.0;
}

impl<R: Robot + ?Sized> Robot for Box<R> {
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        (**self).sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), R::Error> {
        (**self).step(command)
    }
}

impl<R: Robot> Robot for &mut R {
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        (**self).sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), R::Error> {
        (**self).step(command)
    }
}
