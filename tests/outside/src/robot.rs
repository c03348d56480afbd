//! A robot: a Pioneer on tracks, which turn it less far than they are told to.

use tolman_arena::Depicted;
use tolman_sim::robot::{Body, LaserSensing, TurnTranslate};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig, RobotConfigError};
use tolman_sim::{Chance, CommandError, Contact, Model, Motion, Surroundings, trace::Recordable};
pub struct Tank(LaserPioneer);

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

impl Recordable for Tank {
    type Config = LaserPioneerConfig;
    type ConfigError = RobotConfigError;
    fn config(&self) -> &LaserPioneerConfig {
        self.0.config()
    }
    fn from_config(config: LaserPioneerConfig) -> Result<Self, RobotConfigError> {
        LaserPioneer::new(config).map(Self)
    }
}

impl Depicted for Tank {
    const NAME: &'static str = "tank";
}
