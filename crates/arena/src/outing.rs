use alloc::collections::BTreeMap;
use alloc::fmt;
use core::any::Any;
use core::mem;
use core::time::Duration;

use tolman_geom::{Point, Pose};
use tolman_robot::{
    Body, Clock, Guess, Landmark, MapView, Mapper, Position, Ranges, Ring, Robot, Rolls, Scan,
    SensesLandmarks, Standing, System, Task, TurnTranslate, VisitNaming,
};
use tolman_sim::robots::{CameraPioneer, Epuck, LaserPioneer, Pioneer2dx};
use tolman_sim::trace::Recordable;
use tolman_sim::{DoorState, Model};
use tolman_systems::Origin;
use tolman_systems::cpm::RingAsEpuck;

use crate::course::Course;
use crate::registry::view_file;
use crate::run::{InRun, Limited, Stopwatch};
use crate::{BoxError, Simulated};

/// A system that was sent out with its robot on a course, both of any kind.
pub trait Outing: InRun {
    /// Returns the course that the robot is on.
    fn course(&self) -> &Course;

    /// Returns the facts of its robot.
    fn robot(&self) -> RobotFacts;

    /// Returns the true pose of the robot after every time step.
    fn path(&self) -> &[Pose];

    /// Returns the time steps in which the robot touched something.
    fn bumped(&self) -> &[u32];

    /// Returns the landmark that the robot senses.
    fn landmark(&self) -> Option<Landmark>;

    /// Returns the latest scan; `None` for a robot without a laser.
    fn scan(&self) -> Option<&Scan>;

    /// Limits the robot to this many further time steps.
    fn allow(&mut self, steps: u32);

    /// Makes the next action of `task`.
    ///
    /// # Errors
    /// If the robot fails or the system cannot go on with it.
    fn act(&mut self, task: Task) -> Result<Standing, BoxError>;

    /// Returns a few words on the system's situation.
    fn words(&self) -> String;

    /// Returns the map of the system.
    fn map(&self) -> MapView;

    /// Returns the positions at which the system believes to be.
    fn belief(&self) -> Vec<Guess>;

    /// Returns when the system names a place of [`visits`](Self::visits).
    fn visit_naming(&self) -> VisitNaming;

    /// Returns the places that the system came to, in order, as it understands them now.
    fn visits(&self) -> Vec<Option<u32>>;

    /// Returns the number of places the system came to: as many as [`visits`](Self::visits) names.
    fn visit_count(&self) -> usize;

    /// Returns the probability by the system that its map is right, 0 … 1; `None` if it does not
    /// weigh that.
    fn certainty(&self) -> Option<f64>;

    /// Returns why the map may be wrong or unfinished by the system's own account; `None` if it
    /// sees no reason.
    fn doubt(&self) -> Option<String>;

    /// Returns the size of the system's map, bytes; `None` if it is unknown.
    fn map_bytes(&self) -> Option<usize>;

    /// Measures from now on how long the system thinks.
    fn measure(&mut self, stopwatch: Stopwatch);

    /// Returns the system's own computing time while it was measured, without the robot's.
    fn thinking(&self) -> Duration;

    /// Lifts the robot, puts it down at `pose` and tells the system. Returns whether the system can
    /// continue.
    ///
    /// # Errors
    /// If the robot cannot stand there.
    fn put_down(&mut self, pose: Pose) -> Result<Standing, BoxError>;

    /// Lifts the robot and puts it down at `pose`, and does not tell the system.
    ///
    /// # Errors
    /// If the robot cannot stand there.
    fn lift(&mut self, pose: Pose) -> Result<(), BoxError>;

    /// Exchanges the outing's system, with all that it has learned, for that of another outing.
    ///
    /// # Errors
    /// If they are not of one kind, on robots of one kind.
    fn exchange_systems(&mut self, other: &mut dyn Outing) -> Result<(), BoxError>;

    /// Returns the system to exchange.
    fn system_mut(&mut self) -> &mut dyn Any;

    /// Opens or shuts a door of the world.
    ///
    /// # Errors
    /// If there is no such door.
    fn set_door(&mut self, name: &str, state: DoorState) -> Result<(), BoxError>;

    /// Returns the true positions of the map's places, as far as they are known, for pictures.
    /// O(map).
    fn sites(&self) -> BTreeMap<u32, Point>;

    /// Returns the number of the map that the system chose from those it was given, counted from 0.
    fn chosen(&self) -> usize;

    /// Returns the map as a file; `None` if the system keeps none, or has none yet.
    ///
    /// # Errors
    /// If the map has no such form.
    fn map_file(&self) -> Result<Option<String>, BoxError>;

    /// Returns the trace of the run so far.
    ///
    /// # Errors
    /// If the run cannot be repeated or written.
    fn trace(&self) -> Result<Vec<u8>, BoxError>;
}

/// Facts of a simulated robot, for drawings.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotFacts {
    /// Name of the robot, as in the files of maps.
    pub name: &'static str,
    /// Outline of the robot.
    pub body: Body,
    /// Beams of the robot's laser; `None` without a laser.
    pub ring: Option<Ring>,
    /// Duration of a time step, µs.
    pub step_us: u64,
}

impl RobotFacts {
    /// Returns the facts of a simulated robot.
    pub fn of<M: Depicted>(robot: &Simulated<M>) -> Self {
        let model = robot.model();
        Self {
            name: model.name(),
            body: model.body().clone(),
            ring: model.ring(),
            step_us: model.step_us(),
        }
    }

    /// Returns the radius of the largest disc round the robot's origin that its body covers, m.
    #[must_use]
    pub fn inner_radius(&self) -> f64 {
        match &self.body {
            Body::Circle { radius } => *radius,
            Body::Polygon { corners } => {
                let next = corners.iter().cycle().skip(1);
                let sides = corners.iter().zip(next).map(|(a, b)| (a, b - a));
                let far = sides.map(|(a, side)| a.coords.perp(&side).abs() / side.norm());
                far.fold(f64::INFINITY, f64::min)
            }
        }
    }
}

/// Origin of a place of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Founding {
    /// True position of the robot, m.
    pub position: Point,
    /// Number of actions since the first place.
    pub action: u32,
}

/// A robot that is simulated, however it is dressed up.
pub trait HasSimulated {
    /// The simulated robot.
    type Model: Depicted;

    /// Returns the simulated robot.
    fn simulated(&self) -> &Simulated<Self::Model>;

    /// Returns the simulated robot, to be lifted.
    fn simulated_mut(&mut self) -> &mut Simulated<Self::Model>;
}

impl<M: Depicted> HasSimulated for Simulated<M> {
    type Model = M;

    fn simulated(&self) -> &Self {
        self
    }

    fn simulated_mut(&mut self) -> &mut Self {
        self
    }
}

impl<M> HasSimulated for RingAsEpuck<Simulated<M>>
where
    M: Depicted + Model<Command = TurnTranslate, Sensing: Ranges + Rolls + Clock>,
{
    type Model = M;

    fn simulated(&self) -> &Simulated<M> {
        self.robot()
    }

    fn simulated_mut(&mut self) -> &mut Simulated<M> {
        self.robot_mut()
    }
}

/// A model of a robot that can be drawn and written down.
pub trait Depicted: Recordable {
    /// The robot's name, as in the files of maps.
    const NAME: &'static str;

    /// Returns the robot's name; by default [`NAME`](Self::NAME).
    fn name(&self) -> &'static str {
        Self::NAME
    }

    /// Returns the same robot as before its first time step.
    ///
    /// # Errors
    /// If its configuration is out of its bounds.
    fn again(&self) -> Result<Self, BoxError>
    where
        Self: Sized,
    {
        Ok(Self::from_config(self.config().clone())?)
    }

    /// Returns the beams of the robot's laser; `None` without a laser.
    fn ring(&self) -> Option<Ring> {
        None
    }

    /// Returns the scan of its laser, or `None` if it has no laser or the scan drops out.
    fn scan(_sensing: &Self::Sensing) -> Option<&Scan> {
        None
    }
}

impl Depicted for LaserPioneer {
    const NAME: &'static str = crate::pioneer::LASER_PIONEER;

    fn ring(&self) -> Option<Ring> {
        Some(self.config().ring)
    }

    fn scan(sensing: &Self::Sensing) -> Option<&Scan> {
        sensing.scan.as_ref()
    }
}

impl Depicted for CameraPioneer {
    const NAME: &'static str = crate::pioneer::CAMERA_PIONEER;

    fn ring(&self) -> Option<Ring> {
        Some(self.config().pioneer.ring)
    }

    fn scan(sensing: &Self::Sensing) -> Option<&Scan> {
        sensing.laser.scan.as_ref()
    }
}

impl Depicted for Pioneer2dx {
    const NAME: &'static str = crate::gngslam::PIONEER_2DX;
}

impl Depicted for Epuck {
    const NAME: &'static str = "e-puck";
}

/// Returns a map whose origin is moved to `world_from_map`.
pub(crate) fn moved(mut map: MapView, world_from_map: Pose) -> MapView {
    for place in &mut map.places {
        place.position = place.position.map(|at| world_from_map.transform(at));
    }
    let trail = map.trail.iter_mut().flatten();
    for at in (map.ways.iter_mut().flatten())
        .chain(&mut map.floor)
        .chain(trail)
    {
        *at = world_from_map.transform(*at);
    }
    map
}

/// Any [`System`] with any simulated robot, as an [`Outing`].
///
/// [`keeping`](Self::keeping), [`counting`](Self::counting),
/// [`choosing`](Self::choosing) and [`lying`](Self::lying) say what it does with its map; without
/// them it keeps none.
pub struct Sent<R: Robot, S> {
    course: Course,
    robot: Limited<R>,
    system: S,
    /// Origin of each place of the map, by id.
    sites: Vec<Founding>,
    /// Number of actions made since the map has a place.
    actions: u32,
    count: Count<S>,
    keep: Keep<S>,
    lie: Lie<S>,
    choice: Count<S>,
    /// Computing time of the system, if it is not that of its actions.
    thought: Option<Thought<S>>,
    /// Name of the robot, if it differs from its model's.
    name: Option<&'static str>,
    /// True pose of the map's origin, if the map has positions of its places.
    world_from_map: Option<Pose>,
    /// Duration of all actions so far, while times are measured.
    acting: Duration,
}

type Count<S> = Box<dyn Fn(&S) -> usize>;
type Thought<S> = fn(&S) -> Duration;
type Keep<S> = Box<dyn Fn(&S, &[Founding]) -> Result<Option<String>, BoxError>>;
type Lie<S> = Box<dyn Fn(&S, &[Founding]) -> BTreeMap<u32, Point>>;

impl<R: Robot, S> fmt::Debug for Sent<R, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sent")
            .field("course", &self.course.name)
            .finish_non_exhaustive()
    }
}

impl<R: Robot, S> Sent<R, S> {
    /// Sends out `system` with `robot`, which stands on `course`, for at most `step_limit` time
    /// steps.
    pub fn new(course: Course, robot: R, step_limit: u32, system: S) -> Self {
        Self {
            course,
            robot: Limited::new(robot, step_limit),
            system,
            sites: Vec::new(),
            actions: 0,
            count: Box::new(|_| 0),
            keep: Box::new(|_, _| Ok(None)),
            lie: Box::new(|_: &S, made: &[Founding]| {
                (0..).zip(made.iter().map(|made| made.position)).collect()
            }),
            choice: Box::new(|_| 0),
            thought: None,
            name: None,
            world_from_map: None,
            acting: Duration::ZERO,
        }
    }

    /// Returns the system.
    #[must_use]
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// Notes where the robot truly is whenever `count`, the number of places on the map, has grown.
    #[must_use]
    pub fn counting(self, count: impl Fn(&S) -> usize + 'static) -> Self {
        let count = Box::new(count);
        Self { count, ..self }
    }

    /// Keeps the map as `keep` writes it. `keep` gets the origin of each place, by id.
    #[must_use]
    pub fn keeping(
        self,
        keep: impl Fn(&S, &[Founding]) -> Result<Option<String>, BoxError> + 'static,
    ) -> Self {
        let keep = Box::new(keep);
        Self { keep, ..self }
    }

    /// Keeps the places and links of the map, in the files of `system`.
    #[must_use]
    pub fn keeping_its_view(self, system: &'static str, origin: Origin) -> Self
    where
        S: Mapper,
    {
        let width = self.course.corridor_width;
        self.keeping(move |mapper, _| Ok(Some(view_file(system, &origin, width, &mapper.map())?)))
    }

    /// Lets `choice` say which of several maps the system takes for that of the maze.
    #[must_use]
    pub fn choosing(self, choice: impl Fn(&S) -> usize + 'static) -> Self {
        let choice = Box::new(choice);
        Self { choice, ..self }
    }

    /// Lets `thought` say how long the system has thought, where another drives in its actions.
    #[must_use]
    pub fn thinking_for(self, thought: fn(&S) -> Duration) -> Self {
        let thought = Some(thought);
        Self { thought, ..self }
    }

    /// Calls the robot `name`, which is simulated by a model of another name.
    #[must_use]
    pub fn called(self, name: &'static str) -> Self {
        let name = Some(name);
        Self { name, ..self }
    }

    /// Shows the map's places and the robot's believed position at their positions on the map, with
    /// its origin at `world_from_map`; not at their true positions.
    #[must_use]
    pub fn laid_at(self, world_from_map: Pose) -> Self {
        let world_from_map = Some(world_from_map);
        Self {
            world_from_map,
            ..self
        }
    }

    /// Lets `lie` say where the places of the map truly lie. `lie` gets the origins that were
    /// [counted](Self::counting); without it the places lie there.
    #[must_use]
    pub fn lying(self, lie: impl Fn(&S, &[Founding]) -> BTreeMap<u32, Point> + 'static) -> Self {
        let lie = Box::new(lie);
        Self { lie, ..self }
    }
}

impl<R: Robot, S> InRun for Sent<R, S> {
    fn steps(&self) -> u32 {
        self.robot.steps()
    }

    fn is_out_of_time(&self) -> bool {
        self.robot.is_out_of_time()
    }
}

impl<R, S> Outing for Sent<R, S>
where
    R: SensesLandmarks + HasSimulated,
    S: System<Limited<R>, Failure: Into<BoxError>> + 'static,
{
    fn course(&self) -> &Course {
        &self.course
    }

    fn robot(&self) -> RobotFacts {
        let facts = RobotFacts::of(self.robot.robot().simulated());
        let name = self.name.unwrap_or(facts.name);
        RobotFacts { name, ..facts }
    }

    fn path(&self) -> &[Pose] {
        self.robot.robot().simulated().path()
    }

    fn bumped(&self) -> &[u32] {
        self.robot.robot().simulated().bumped()
    }

    fn landmark(&self) -> Option<Landmark> {
        self.robot.landmark()
    }

    fn scan(&self) -> Option<&Scan> {
        R::Model::scan(self.robot.robot().simulated().sensing())
    }

    fn allow(&mut self, steps: u32) {
        self.robot.allow(steps);
    }

    fn act(&mut self, task: Task) -> Result<Standing, BoxError> {
        let began = self.robot.now();
        let standing = self.system.act(&mut self.robot, task);
        if let (Some(began), Some(now)) = (began, self.robot.now()) {
            self.acting += now.saturating_sub(began);
        }
        let made = Founding {
            position: self.robot.robot().simulated().truth().pose.position,
            action: self.actions,
        };
        let count = (self.count)(&self.system);
        self.sites.resize(count, made);
        self.actions += u32::from(count > 0);
        standing.map_err(Into::into)
    }

    fn words(&self) -> String {
        self.system.words()
    }

    fn map(&self) -> MapView {
        let map = self.system.map();
        match self.world_from_map {
            Some(world_from_map) => moved(map, world_from_map),
            None => map,
        }
    }

    fn belief(&self) -> Vec<Guess> {
        let mut belief = self.system.belief();
        for guess in &mut belief {
            if let (Some(world_from_map), Position::Point(at)) =
                (self.world_from_map, &mut guess.at)
            {
                *at = world_from_map.transform(*at);
            }
        }
        belief
    }

    fn visit_naming(&self) -> VisitNaming {
        self.system.visit_naming()
    }

    fn visits(&self) -> Vec<Option<u32>> {
        self.system.visits()
    }

    fn doubt(&self) -> Option<String> {
        self.system.doubt()
    }

    fn visit_count(&self) -> usize {
        self.system.visit_count()
    }

    fn certainty(&self) -> Option<f64> {
        self.system.certainty()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.system.map_bytes()
    }

    fn measure(&mut self, stopwatch: Stopwatch) {
        self.robot.measure(stopwatch);
    }

    fn thinking(&self) -> Duration {
        match self.thought {
            Some(thought) => thought(&self.system),
            None => self.acting.saturating_sub(self.robot.stepping()),
        }
    }

    fn put_down(&mut self, pose: Pose) -> Result<Standing, BoxError> {
        self.lift(pose)?;
        Ok(self.system.put_down())
    }

    fn lift(&mut self, pose: Pose) -> Result<(), BoxError> {
        Ok(self.robot.robot_mut().simulated_mut().place(pose)?)
    }

    fn exchange_systems(&mut self, other: &mut dyn Outing) -> Result<(), BoxError> {
        let system = other.system_mut().downcast_mut();
        mem::swap(
            &mut self.system,
            system.ok_or("the systems are not of one kind")?,
        );
        Ok(())
    }

    fn system_mut(&mut self) -> &mut dyn Any {
        &mut self.system
    }

    fn set_door(&mut self, name: &str, state: DoorState) -> Result<(), BoxError> {
        let robot = self.robot.robot_mut().simulated_mut();
        Ok(robot.set_door(name, state)?)
    }

    fn sites(&self) -> BTreeMap<u32, Point> {
        match self.world_from_map {
            Some(_) => BTreeMap::new(),
            None => (self.lie)(&self.system, &self.sites),
        }
    }

    fn chosen(&self) -> usize {
        (self.choice)(&self.system)
    }

    fn map_file(&self) -> Result<Option<String>, BoxError> {
        (self.keep)(&self.system, &self.sites)
    }

    fn trace(&self) -> Result<Vec<u8>, BoxError> {
        self.robot.robot().simulated().trace()
    }
}
