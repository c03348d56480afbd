use std::cell::RefCell;
use std::rc::Rc;

use serde_json::json;
use tolman_arena::registry::RobotFailure;
use tolman_geom::Twist;
use tolman_robot::{
    BaseReport, Landmark, LaserSensing, Robot, SensesLandmarks, TurnTranslate, VelocityBase,
    VelocityRover,
};

use crate::link::{Link, LinkError};
use crate::messages::Text;
use crate::sightings::Sightings;

/// The link as the base of a rover.
pub(crate) struct Base(pub(crate) Rc<RefCell<Link>>);

/// The robot at the other end of the topics.
pub(crate) struct RosRobot {
    pub(crate) rover: VelocityRover<Base>,
    pub(crate) link: Rc<RefCell<Link>>,
    pub(crate) sightings: Rc<RefCell<Sightings>>,
    /// Number of motions made.
    pub(crate) motions: u64,
}

impl VelocityBase for Base {
    type Error = LinkError;

    fn drive(&mut self, velocity: Twist) -> Result<(), LinkError> {
        self.0.borrow_mut().drive(velocity)
    }

    fn report(&mut self, wait_us: u64) -> Result<Option<BaseReport>, LinkError> {
        self.0.borrow_mut().report(wait_us)
    }
}

impl Robot for RosRobot {
    type Command = TurnTranslate;
    type Sensing = LaserSensing;
    type Error = RobotFailure;

    fn sensing(&self) -> &LaserSensing {
        self.rover.sensing()
    }

    fn step(&mut self, command: &TurnTranslate) -> Result<(), RobotFailure> {
        let made = self.rover.step(command);
        made.map_err(|error| RobotFailure(Box::new(error)))?;
        self.motions += 1;
        let link = self.link.borrow();
        if let (Some(scan), Some((pose, _))) = (&self.rover.sensing().scan, link.odom) {
            self.sightings.borrow_mut().add(pose, scan.clone());
        }
        let data = json!({ "motions": self.motions }).to_string();
        // A picture that is not seen does not stop the robot.
        let _ = link.states.publish(Text { data });
        Ok(())
    }
}

impl SensesLandmarks for RosRobot {
    fn landmark(&self) -> Option<Landmark> {
        self.link.borrow().landmark
    }
}
