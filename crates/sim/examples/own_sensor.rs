//! A sensor of your own: a Pioneer hears a beacon, the louder the nearer, and drives to it.
use tolman_sim::geom::{Heading, Point, Pose};
use tolman_sim::maze::{Grid, Maze};
use tolman_sim::robot::{Body, Robot, TurnTranslate};
use tolman_sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_sim::sensors::Sensor;
use tolman_sim::{
    Chance, CommandError, Contact, CorridorSize, Model, Motion, Solo, Surroundings, World,
};

/// Hears what stands there.
struct Microphone(Point);
impl Sensor for Microphone {
    type Reading = f64;
    fn sense(&mut self, around: &Surroundings<'_>, _: &Chance, reading: &mut Option<f64>) {
        let distance = (self.0 - around.truth.pose.position).norm();
        *reading = Some(1.0 / (1.0 + distance * distance));
    }
}

struct Listener(LaserPioneer, Microphone);
impl Model for Listener {
    type Command = TurnTranslate;
    type Sensing = Option<f64>;
    fn body(&self) -> &Body {
        self.0.body()
    }
    fn contact(&self) -> Contact {
        self.0.contact()
    }
    fn step_us(&self) -> u64 {
        self.0.step_us()
    }
    fn check(&self, command: &TurnTranslate) -> Result<(), CommandError> {
        self.0.check(command)
    }
    fn motion(&mut self, command: &TurnTranslate, chance: &Chance) -> Motion {
        self.0.motion(command, chance)
    }
    fn silent(&self) -> Option<f64> {
        None
    }
    fn sense(&mut self, around: &Surroundings<'_>, chance: &Chance, heard: &mut Option<f64>) {
        self.1.sense(around, chance, heard);
    }
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let world = World::from_maze(&Maze::open(Grid::new(6, 1)), &CorridorSize::thin(1.0))?;
    let pioneer = LaserPioneer::new(LaserPioneerConfig::noiseless())?;
    let robot = Listener(pioneer, Microphone(Point::new(5.0, 0.5)));
    let start = Pose::new(Point::new(0.5, 0.5), Heading::EAST);
    let mut solo = Solo::new(world, robot, start, 7)?;
    let (turn, translate) = (0.0, 0.2);
    while solo.sensing().is_none_or(|loudness| loudness < 0.5) {
        solo.step(&TurnTranslate { turn, translate })?;
    }
    assert!(solo.truth().pose.position.x > 3.9);
    Ok(())
}
