use core::ops::Deref;

use crate::{Landmark, Robot, SensesLandmarks};

/// A robot that is commanded to stand still when this is dropped: at the end of a run, or after an
/// error.
///
/// A signal such as Ctrl-C ends a program without dropping anything. Catch it and leave the loop
/// that drives.
///
/// ```
/// use tolman_robot::{Robot, Stopping, TurnTranslate};
///
/// /// A robot that remembers what it was told.
/// #[derive(Default)]
/// struct Diary(Vec<TurnTranslate>);
///
/// impl Robot for Diary {
///     type Command = TurnTranslate;
///     type Sensing = ();
///     type Error = core::convert::Infallible;
///
///     fn sensing(&self) -> &() {
///         &()
///     }
///
///     fn step(&mut self, command: &TurnTranslate) -> Result<(), Self::Error> {
///         self.0.push(*command);
///         Ok(())
///     }
/// }
///
/// let mut diary = Diary::default();
/// let ahead = TurnTranslate { turn: 0.0, translate: 1.0 };
/// Stopping::new(&mut diary).step(&ahead).unwrap();
/// assert_eq!(diary.0, [ahead, TurnTranslate::STOP]);
/// ```
#[derive(Debug)]
pub struct Stopping<R: Robot>(R);

impl<R: Robot> Stopping<R> {
    /// Takes charge of `robot`, which may be a mutable reference.
    pub const fn new(robot: R) -> Self {
        Self(robot)
    }

    /// Returns the robot, to be lifted.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.0
    }
}

impl<R: Robot> Deref for Stopping<R> {
    type Target = R;

    fn deref(&self) -> &R {
        &self.0
    }
}

impl<R: Robot> Robot for Stopping<R> {
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        self.0.sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), Self::Error> {
        self.0.step(command)
    }
}

impl<R: SensesLandmarks> SensesLandmarks for Stopping<R> {
    fn landmark(&self) -> Option<Landmark> {
        self.0.landmark()
    }
}

impl<R: Robot> Drop for Stopping<R> {
    fn drop(&mut self) {
        // If the robot no longer obeys, there is no one to report it to.
        let _ = self.0.stop();
    }
}
