//! A robot: a Pioneer on tracks, which turn it less far than they are told to.

use tolman::registry::RobotEntry;
use tolman_arena::pioneer::calibrated;
use tolman_sim::robot::{Body, LaserSensing, TurnTranslate};
use tolman_sim::robots::LaserPioneer;
use tolman_sim::{Chance, CommandError, Contact, Model, Motion, Surroundings};

struct Tank(LaserPioneer);

impl Model for Tank {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    fn body(&self) -> &Body {
        self.0.body()
    }
    fn contact(&self) -> Contact {
        Contact::Slide
    }
    fn step_us(&self) -> u64 {
        self.0.step_us()
    }
    fn check(&self, command: &TurnTranslate) -> Result<(), CommandError> {
        self.0.check(command)
    }
    fn motion(&mut self, command: &TurnTranslate, chance: &Chance) -> Motion {
        let Motion { distance, turn } = self.0.motion(command, chance);
        Motion {
            distance,
            turn: 0.9 * turn,
        }
    }
    fn silent(&self) -> LaserSensing {
        self.0.silent()
    }
    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, sensing: &mut LaserSensing) {
        self.0.sense(around, chance, sensing);
    }
}

pub const TANK: RobotEntry = RobotEntry::laser("tank", "tank", "a laser Pioneer on tracks")
    .made_by(calibrated, |config| {
        Ok(Box::new(Tank(LaserPioneer::new(config)?)))
    });
