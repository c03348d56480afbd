use alloc::boxed::Box;

use crate::Robot;

/// A mark that distinguishes a place from similar ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Landmark {
    /// The robot's start.
    Start,
    /// The robot's goal.
    Goal,
    /// Another landmark that the robot can recognize, by a number of the caller's.
    Numbered(u32),
}

/// A robot that recognizes the landmark it stands at. A goal is a landmark, so every system that
/// can sense it can be sent to it.
pub trait SensesLandmarks: Robot {
    /// Returns the landmark at which the robot stands now, or `None` if there is none.
    fn landmark(&self) -> Option<Landmark>;
}

/// Any robot, with a function that names the landmark at its position. A robot without a sensor for
/// landmarks needs a camera above the maze, a mark on the floor, or a person who watches.
///
/// ```
/// use tolman_robot::{Landmark, Landmarked, Robot, SensesLandmarks};
///
/// /// A robot on a rail that senses how far it is along.
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
/// let mut cart = Landmarked::new(Cart(0.0), |cart| (cart.0 > 2.0).then_some(Landmark::Goal));
/// assert_eq!(cart.landmark(), None);
/// cart.step(&2.5).unwrap();
/// assert_eq!(cart.landmark(), Some(Landmark::Goal));
/// ```
#[derive(Clone, Debug)]
pub struct Landmarked<R, F> {
    robot: R,
    landmark: F,
}

impl<R: Robot, F: Fn(&R) -> Option<Landmark>> Landmarked<R, F> {
    /// Returns `robot` with the function `landmark`, which names the landmark at its position.
    pub const fn new(robot: R, landmark: F) -> Self {
        Self { robot, landmark }
    }

    /// Returns the robot.
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// Returns the robot, to be driven by hand.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }

    /// Returns the robot.
    pub fn into_robot(self) -> R {
        self.robot
    }
}

impl<R: Robot, F> Robot for Landmarked<R, F> {
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), Self::Error> {
        self.robot.step(command)
    }
}

impl<R: Robot, F: Fn(&R) -> Option<Landmark>> SensesLandmarks for Landmarked<R, F> {
    fn landmark(&self) -> Option<Landmark> {
        (self.landmark)(&self.robot)
    }
}

impl<R: SensesLandmarks + ?Sized> SensesLandmarks for Box<R> {
    fn landmark(&self) -> Option<Landmark> {
        (**self).landmark()
    }
}

impl<R: SensesLandmarks> SensesLandmarks for &mut R {
    fn landmark(&self) -> Option<Landmark> {
        (**self).landmark()
    }
}
