use super::Sensor;
use crate::{Chance, Surroundings};

/// Tells whether the body touched something in this step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bumper;

impl Sensor for Bumper {
    type Reading = bool;

    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<bool>) {
        *reading = Some(around.bump);
    }
}
