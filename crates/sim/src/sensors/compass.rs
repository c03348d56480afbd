use tolman_geom::Heading;

use super::Sensor;
use crate::{Chance, Surroundings};

/// Tells the heading: 0 is east.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compass;

impl Sensor for Compass {
    type Reading = Heading;

    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<Heading>) {
        *reading = Some(around.truth.pose.heading);
    }
}
