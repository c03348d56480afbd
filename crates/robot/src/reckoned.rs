use crate::{Landmark, Odometry, Robot, Rolls, SensesLandmarks};

/// A robot whose odometry is handed to an observer, step by step.
///
/// ```
/// use tolman_robot::geom::Pose;
/// use tolman_robot::{Odometry, Reckoned, Robot, Rolls};
///
/// /// A robot that rolls 0.1 m a step.
/// struct Roller;
///
/// impl Rolls for Roller {
///     fn odometry(&self) -> Option<Odometry> {
///         Some(Odometry { distance: 0.1, turn: 0.0 })
///     }
/// }
///
/// impl Robot for Roller {
///     type Command = f64;
///     type Sensing = Self;
///     type Error = core::convert::Infallible;
///
///     fn sensing(&self) -> &Self {
///         self
///     }
///
///     fn step(&mut self, _speed: &f64) -> Result<(), Self::Error> {
///         Ok(())
///     }
/// }
///
/// let mut pose = Pose::IDENTITY;
/// let mut robot = Reckoned::new(Roller, |rolled| pose = rolled.applied_to(pose));
/// robot.step(&1.0).unwrap();
/// robot.step(&1.0).unwrap();
/// assert!((pose.position.x - 0.2).abs() < 1e-12);
/// ```
#[derive(Debug)]
pub struct Reckoned<R, F> {
    robot: R,
    take: F,
}

impl<R, F> Reckoned<R, F>
where
    R: Robot<Sensing: Rolls>,
    F: FnMut(Odometry),
{
    /// Returns `robot`, whose odometry is passed to `take` after each step. The robot may be a
    /// mutable reference. Steps without odometry are left out.
    pub const fn new(robot: R, take: F) -> Self {
        Self { robot, take }
    }
}

impl<R, F> Robot for Reckoned<R, F>
where
    R: Robot<Sensing: Rolls>,
    F: FnMut(Odometry),
{
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), R::Error> {
        self.robot.step(command)?;
        if let Some(rolled) = self.robot.sensing().odometry() {
            (self.take)(rolled);
        }
        Ok(())
    }
}

impl<R, F> SensesLandmarks for Reckoned<R, F>
where
    R: SensesLandmarks<Sensing: Rolls>,
    F: FnMut(Odometry),
{
    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }
}
