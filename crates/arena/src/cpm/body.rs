use alloc::sync::Arc;

use tolman_geom::{Pose, Twist};
use tolman_maps::cpm::Landmark;
use tolman_robot::Robot;
use tolman_robot::epuck::{EpuckSensing, TRACK, WHEEL_RADIUS, WheelSpeeds};
use tolman_sim::robots::Epuck;
use tolman_sim::{PlaceError, Solo, StepError, Truth, World, Zone};

/// An e-puck that can tell whether it stands at a landmark ("an additional dimension of vector is added for landmark detection").
pub trait Body: Robot<Command = WheelSpeeds, Sensing = EpuckSensing> {
    /// The landmark it stands at.
    fn landmark(&self) -> Option<Landmark>;
}

/// The simulated e-puck. Its maze's zones `start` and `destination` are its landmarks.
#[derive(Debug)]
pub struct SimulatedEpuck {
    solo: Solo<Epuck>,
    landmarks: Vec<(Landmark, Zone)>,
    path: Vec<Pose>,
    bumps: u32,
}

impl SimulatedEpuck {
    /// Puts the robot at `start`.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn new(
        world: Arc<World>,
        robot: Epuck,
        start: Pose,
        seed: u64,
    ) -> Result<Self, PlaceError> {
        let names = [(Landmark::Start, "start"), (Landmark::Goal, "destination")];
        let landmarks = names
            .into_iter()
            .filter_map(|(landmark, name)| Some((landmark, world.zone(name)?.clone())))
            .collect();
        Ok(Self {
            solo: Solo::new(world, robot, start, seed)?,
            landmarks,
            path: vec![start],
            bumps: 0,
        })
    }

    /// What really is, for scoring.
    #[must_use]
    pub fn truth(&self) -> &Truth {
        self.solo.truth()
    }

    /// Where it was after every step.
    #[must_use]
    pub fn path(&self) -> &[Pose] {
        &self.path
    }

    /// In how many steps it touched something.
    #[must_use]
    pub const fn bumps(&self) -> u32 {
        self.bumps
    }

    /// Lifts it and sets it down elsewhere.
    ///
    /// # Errors
    /// If it cannot stand there.
    pub fn place(&mut self, pose: Pose) -> Result<(), PlaceError> {
        self.solo.place(pose)
    }

    /// The world it is in.
    #[must_use]
    pub fn world(&self) -> &World {
        self.solo.simulation().world()
    }
}

impl Robot for SimulatedEpuck {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = StepError;

    fn sensing(&self) -> &EpuckSensing {
        self.solo.sensing()
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), StepError> {
        self.solo.step(command)?;
        let truth = self.solo.truth();
        self.bumps += u32::from(truth.bump);
        self.path.push(truth.pose);
        Ok(())
    }
}

impl Body for SimulatedEpuck {
    fn landmark(&self) -> Option<Landmark> {
        let here = self.solo.truth().pose.position;
        let mut at = self
            .landmarks
            .iter()
            .filter(|(_, zone)| zone.contains(here));
        at.next().map(|(landmark, _)| *landmark)
    }
}

/// Any e-puck, and who tells whether it stands at a landmark: the real one has no sensor for that, so that a camera above the maze, a mark on the
/// floor, or whoever watches must.
#[derive(Clone, Debug)]
pub struct Landmarked<R, F> {
    robot: R,
    landmark: F,
}

impl<R, F> Landmarked<R, F>
where
    R: Robot<Command = WheelSpeeds, Sensing = EpuckSensing>,
    F: Fn(&R) -> Option<Landmark>,
{
    /// A robot whose landmark `landmark` tells. It is asked after every half second of path, while the robot stands.
    pub const fn new(robot: R, landmark: F) -> Self {
        Self { robot, landmark }
    }

    /// The robot.
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// The robot, to be driven by hand.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }

    /// Gives the robot back.
    pub fn into_robot(self) -> R {
        self.robot
    }
}

impl<R, F> Robot for Landmarked<R, F>
where
    R: Robot<Command = WheelSpeeds, Sensing = EpuckSensing>,
{
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = R::Error;

    fn sensing(&self) -> &EpuckSensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), R::Error> {
        self.robot.step(command)
    }
}

impl<R, F> Body for Landmarked<R, F>
where
    R: Robot<Command = WheelSpeeds, Sensing = EpuckSensing>,
    F: Fn(&R) -> Option<Landmark>,
{
    fn landmark(&self) -> Option<Landmark> {
        (self.landmark)(&self.robot)
    }
}

/// A body with dead reckoning by its encoders.
#[derive(Debug)]
pub struct Reckoned<B> {
    body: B,
    /// In the frame of the first pose.
    pose: Pose,
    /// Way of the robot's middle so far, m, forward or backward.
    driven: f64,
}

impl<B: Body> Reckoned<B> {
    /// A body that stands at the origin of its frame.
    pub const fn new(body: B) -> Self {
        Self {
            body,
            pose: Pose::IDENTITY,
            driven: 0.0,
        }
    }

    /// The body.
    pub const fn body(&self) -> &B {
        &self.body
    }

    /// The body, to be lifted.
    pub const fn body_mut(&mut self) -> &mut B {
        &mut self.body
    }

    /// Where it believes to be, in the frame in which it began.
    pub const fn pose(&self) -> Pose {
        self.pose
    }

    /// Its heading is known better.
    pub fn correct(&mut self, turn: f64) {
        self.pose.heading = self.pose.heading.turned(turn);
    }

    /// How far it drove so far, m.
    pub const fn driven(&self) -> f64 {
        self.driven
    }
}

impl<B: Body> Robot for Reckoned<B> {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = B::Error;

    fn sensing(&self) -> &EpuckSensing {
        self.body.sensing()
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), B::Error> {
        self.body.step(command)?;
        if let Some(turns) = self.body.sensing().encoders {
            let roll = |turn: f64| turn * WHEEL_RADIUS;
            let Twist { linear, angular } =
                Twist::of_wheels(roll(turns.left), roll(turns.right), TRACK);
            self.pose = self.pose.displaced(linear, angular);
            self.driven += linear.abs();
        }
        Ok(())
    }
}

impl<B: Body> Body for Reckoned<B> {
    fn landmark(&self) -> Option<Landmark> {
        self.body.landmark()
    }
}
