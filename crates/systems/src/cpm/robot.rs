use tolman_robot::epuck::{EpuckSensing, WheelSpeeds};
use tolman_robot::{Robot, SensesLandmarks};

/// Robots that CPM can drive. They have two driven wheels with encoders, and proximity sensors all
/// round. They also sense landmarks ("an additional dimension of vector is added for landmark
/// detection").
///
/// Any [`Landmarked`](tolman_robot::Landmarked) e-puck is one, and any robot with a laser ring
/// behind [`RingAsEpuck`](super::RingAsEpuck). The trait is implemented for all types that meet its
/// bounds.
pub trait CpmRobot: SensesLandmarks + Robot<Command = WheelSpeeds, Sensing = EpuckSensing> {}

impl<R> CpmRobot for R where
    R: SensesLandmarks + Robot<Command = WheelSpeeds, Sensing = EpuckSensing>
{
}
