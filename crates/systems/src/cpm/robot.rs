use tolman_robot::epuck::{EpuckSensing, WheelSpeeds};
use tolman_robot::{Robot, SensesLandmarks};

/// What CPM needs of a robot: two driven wheels with encoders, proximity sensors all round, and a
/// sense for landmarks ("an additional dimension of vector is added for landmark detection").
///
/// Any e-puck has this that is [`Landmarked`](tolman_robot::Landmarked), and any robot with a laser
/// ring behind [`RingAsEpuck`](super::RingAsEpuck). Nobody implements it: it stands for its bounds.
pub trait CpmRobot: SensesLandmarks + Robot<Command = WheelSpeeds, Sensing = EpuckSensing> {}

impl<R> CpmRobot for R where
    R: SensesLandmarks + Robot<Command = WheelSpeeds, Sensing = EpuckSensing>
{
}
