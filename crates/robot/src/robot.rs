/// A robot that acts and senses in fixed time steps: the simulator's, a replayed one, or a driver's.
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
    /// What the robot is told in one time step.
    type Command;
    /// What it knows after one.
    type Sensing;
    /// Why a step can fail: a lost connection, a command that is not a number.
    type Error;

    /// What was sensed at the end of the last step (before the first: at rest).
    fn sensing(&self) -> &Self::Sensing;

    /// Carries out `command` for one time step and senses anew.
    ///
    /// # Errors
    /// Whatever keeps the robot from carrying it out; it then stands still.
    fn step(&mut self, command: &Self::Command) -> Result<(), Self::Error>;
}
