use tolman_robot::Odometry;

use super::Sensor;
use crate::{Chance, Surroundings};

/// Wheel encoders: what the wheels rolled in this step. Wheels that a contact holds do not roll.
#[derive(Clone, Copy, Debug, Default)]
pub struct WheelOdometry;

impl Sensor for WheelOdometry {
    type Reading = Odometry;

    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<Odometry>) {
        let motion = around.motion;
        *reading = Some(Odometry {
            distance: motion.distance,
            turn: motion.turn,
        });
    }
}
