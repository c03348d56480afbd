use tolman_geom::Pose;
use tolman_robot::{Robot, Rolls};

/// A robot with dead reckoning: every step it makes is added to a pose.
#[derive(Debug)]
pub(super) struct DeadReckoned<'a, R> {
    pub(super) robot: &'a mut R,
    /// Where the wheels have it, from where it was put down.
    pub(super) pose: &'a mut Pose,
}

impl<R> Robot for DeadReckoned<'_, R>
where
    R: Robot<Sensing: Rolls>,
{
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        self.robot.sensing()
    }

    /// A step whose odometry dropped out moves the pose by nothing.
    fn step(&mut self, command: &R::Command) -> Result<(), R::Error> {
        self.robot.step(command)?;
        if let Some(rolled) = self.robot.sensing().odometry() {
            *self.pose = rolled.applied_to(*self.pose);
        }
        Ok(())
    }
}
