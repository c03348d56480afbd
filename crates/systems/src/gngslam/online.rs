//! Learns and corrects the robot's pose at the same time (the paper's section 6).

use core::f64::consts::PI;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::wander::{LegEnd, TurnByEnd, UntilNear, UntilNearConfig};
use tolman_geom::{Point, Pose};
use tolman_maps::place_graph::{PlaceGraph, PlaceGraphConfig, PlaceGraphError, SeenThere};
use tolman_robot::{
    Fitted, Goal, Guess, Landmark, MadeFor, MapView, Mapper, Odometry, Reckoned, Ring, Robot,
    RobotMeasures, SensesLandmarks, Soundings, Standing, System, TakesSnapshots, Task,
};

use super::frontier::{Lane, frontiers, ways_on};
use super::route::{Obstacles, Route, Target};
use super::sighting::amid;
use super::{LandmarkSighting, SnapshotRobot};
use crate::on_robot::{needed, pioneer};
use crate::{ForRobotError, LaserRobot, OnRobot, stream};

/// Parameters by which an [`OnlineSlam`] moves and maps.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct OnlineSlamConfig {
    /// Parameters of driving. A leg is one piece of the way; the robot looks after each.
    pub drive: UntilNearConfig,
    /// Maximum turn before the robot looks again, rad.
    pub turn_piece: f64,
    /// Number of looks round the first place, before the robot drives.
    pub first_looks: u32,
    /// Choice of the next goal while exploring.
    pub explore: ExplorationPolicy,
    /// Number of looks in a row without a new place after which all is explored. It counts only if
    /// no place is left from which the floor goes on.
    pub quiet_looks: u32,
    /// Half-width of the lane in which nothing may stand where the floor goes on, m. It is narrower
    /// than the robot, since places are seldom in the middle of a corridor.
    pub lane: f64,
    /// Maximum number of time steps to stand still for a snapshot, at least 1.
    pub patience: u32,
    /// Distance within which the robot is at a place, m.
    pub arrival: f64,
    /// Factor on the limits of a leg along ways that the robot has driven before, 0 to 1. It fits
    /// through there, however near the walls are.
    pub give_way: f64,
    /// Parameters of mapping.
    pub map: PlaceGraphConfig,
}

impl OnlineSlamConfig {
    /// Returns our values for the Pioneer 2-DX: it looks after each 0.4 m and each 30°, and goes on
    /// to 0.6 m before a wall.
    #[must_use]
    pub const fn pioneer_2dx() -> Self {
        let mut drive = UntilNearConfig::paper();
        drive.longest_leg = 10;
        drive.limits.ahead = 0.6;
        Self {
            drive,
            turn_piece: PI / 6.0,
            first_looks: 18,
            explore: ExplorationPolicy::ByChance,
            quiet_looks: 150,
            lane: 0.25,
            patience: 10,
            arrival: 0.3,
            give_way: 0.8,
            map: PlaceGraphConfig::indoors(),
        }
    }

    /// Returns our values for a robot with a laser that rolls `translate_per_step` metres in a time
    /// step by the command `translate: 1.0`. It moves as far in a step as the Pioneer 2-DX.
    #[must_use]
    pub const fn laser(translate_per_step: f64) -> Self {
        let mut config = Self::pioneer_2dx();
        config.drive.translate = 0.04 / translate_per_step;
        config.drive.turn = 0.1;
        config
    }
}

/// Choice of the next goal while an [`OnlineSlam`] explores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExplorationPolicy {
    /// Goes straight on until something is near, then in a random direction, as in the paper.
    ByChance,
    /// Goes to the nearest point where the floor goes on beyond the map, as long as there are any;
    /// then wanders at random.
    ToTheUnknown,
}

/// Reason why an [`OnlineSlam`] cannot go on.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OnlineSlamError<R> {
    /// No snapshot came while the robot stood still.
    #[error(
        "the robot stood still for {steps} time steps and took no snapshot; switch its camera and range sensors on, or raise `patience`"
    )]
    NoSnapshot {
        /// Number of time steps for which the robot stood.
        steps: u32,
    },
    /// The look cannot be mapped.
    #[error("the map cannot take in what the robot saw")]
    Map(#[from] PlaceGraphError),
    /// The robot failed.
    #[error("the robot failed")]
    Robot(#[source] R),
}

/// Drives any robot that turns, translates and takes snapshots, maps places on the way, and
/// corrects its pose by them.
///
/// An action is a piece of the way or of a turn, and a look at where it has led.
#[derive(Debug)]
pub struct OnlineSlam {
    config: OnlineSlamConfig,
    map: PlaceGraph,
    driver: UntilNear,
    rng: ChaCha8Rng,
    /// Odometry since the last look.
    rolled: Vec<Odometry>,
    was_put_down: bool,
    /// Number of looks round that are still to be made.
    looks_round: u32,
    /// Remaining angle of the turn under way, rad.
    turn: f64,
    /// Number of looks since the last new place.
    quiet: u32,
    /// Positions where landmarks were sensed.
    sightings: Vec<LandmarkSighting>,
    /// Places where the robot came back and did not sense the goal.
    tried: Vec<u32>,
    route: Option<Route>,
    obstacles: Obstacles,
    /// Frontier to which the robot goes.
    frontier: Option<Frontier>,
    /// Whether no frontier is left, as far as the robot knows.
    ends_here: bool,
    /// Points that the robot reached, or could not reach, m, in the map's frame.
    explored: Vec<Point>,
    /// Whether the robot touched something in the action in progress.
    has_touched: bool,
    /// Number of times that the system may still forget the points in `explored` and go there
    /// again.
    retries: u32,
}

/// A point to explore.
#[derive(Clone, Copy, Debug)]
struct Frontier {
    target: Target,
    /// Remaining number of pieces of the way before the robot gives the point up.
    patience: u32,
}

/// Initial number of pieces of the way after which a point to explore is given up.
const PATIENCE: u32 = 60;

/// Number of times that unreachable points are tried again.
const RETRIES: u32 = 2;

/// Pieces that a blocked way counts as.
const BLOCKED: u32 = 20;

/// Extra distance that a lane extends beyond a place, m.
const BEYOND: f64 = 0.05;

/// Number of time steps that the robot drives away from something that it has touched.
const STEPS_FREE: u32 = 4;

/// Minimum random turn, rad: what is near ahead is also near at smaller angles.
const LEAST_TURN: f64 = 0.5;

/// Width of the corridors for which the system is made, m.
const CORRIDOR_WIDTH: f64 = 1.5;

/// Beams of its laser, and how far they reach at the most, m.
const LASER: (u32, f64) = (90, 4.0);

impl OnlineSlam {
    /// Returns a system without a map on a robot of these measures. All random numbers follow from
    /// `seed`.
    ///
    /// # Errors
    /// If the measures contradict each other, or there is no odometry.
    pub fn for_robot<R: LaserRobot>(
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<OnRobot<Fitted<R>, Self>, ForRobotError> {
        needed(measures.odometry_error, "odometry_error")?;
        let reach = measures.laser.max_range * CORRIDOR_WIDTH / measures.corridor_width;
        let made_for = MadeFor {
            ring: Ring::full(LASER.0, LASER.1.min(reach)),
            ..pioneer(CORRIDOR_WIDTH)
        };
        let config = OnlineSlamConfig::laser(made_for.translate_per_step);
        let robot = Fitted::new(robot, *measures, made_for)?;
        let metre = robot.metre();
        Ok(OnRobot::new(robot, Self::new(config, seed), metre))
    }

    /// Returns a system without a map, whose robot has just been put down. `seed` seeds all its
    /// turns.
    #[must_use]
    pub fn new(config: OnlineSlamConfig, seed: u64) -> Self {
        Self::on(PlaceGraph::new(config.map), config, seed)
    }

    /// Returns a system that continues a known map. For a robot that may stand anywhere, pass a map
    /// that was [put down](PlaceGraph::put_down).
    #[must_use]
    pub fn on(map: PlaceGraph, config: OnlineSlamConfig, seed: u64) -> Self {
        Self {
            driver: UntilNear::new(config.drive),
            rng: stream(seed, 0),
            rolled: Vec::new(),
            was_put_down: false,
            looks_round: config.first_looks,
            turn: 0.0,
            quiet: 0,
            sightings: Vec::new(),
            tried: Vec::new(),
            route: None,
            obstacles: Obstacles::default(),
            frontier: None,
            ends_here: false,
            explored: Vec::new(),
            has_touched: false,
            retries: RETRIES,
            map,
            config,
        }
    }

    /// Adds the positions where landmarks were sensed on its map. Those beside an unknown place are
    /// left out.
    #[must_use]
    pub fn with_sightings(mut self, sightings: Vec<LandmarkSighting>) -> Self {
        let places = self.map.places().len();
        self.sightings = sightings;
        self.sightings
            .retain(|sighting| (sighting.place as usize) < places);
        self
    }

    /// Returns the sightings of landmarks.
    #[must_use]
    pub fn sightings(&self) -> &[LandmarkSighting] {
        &self.sightings
    }

    /// Returns the places on the shortest way between two places, both included; `None` if there is
    /// no way, or a place does not exist. O(links log places).
    #[must_use]
    pub fn plan(&self, from: u32, to: u32) -> Option<Vec<u32>> {
        let poses = self.map.poses().poses();
        let [from, point] = [from, to].map(|place| poses.get(place as usize));
        let target = Target {
            place: to,
            point: point?.position,
        };
        let route = Route::find(&self.map, from?.position, target, &Obstacles::default())?;
        Some(route.places().collect())
    }

    /// Returns the place where a landmark should be sensed; `None` if no such place is known.
    #[must_use]
    pub fn place_with(&self, landmark: Landmark) -> Option<u32> {
        amid(&self.sightings, landmark, &[], &self.map).map(|target| target.place)
    }

    /// Returns the map.
    #[must_use]
    pub const fn graph(&self) -> &PlaceGraph {
        &self.map
    }

    /// Takes in that the robot has been lifted and put down, perhaps elsewhere.
    pub fn put_down(&mut self) {
        self.was_put_down = true;
        self.looks_round = self.config.first_looks;
        self.turn = 0.0;
        self.route = None;
        self.rolled.clear();
    }

    /// Returns whether the robot goes to frontiers: once it has looked round.
    fn goes_beyond(&self) -> bool {
        self.config.explore == ExplorationPolicy::ToTheUnknown && self.looks_round == 0
    }

    /// Returns whether the system has found no place for many looks, and no frontier is left.
    fn has_explored(&self) -> bool {
        let is_quiet = self.quiet >= self.config.quiet_looks;
        is_quiet && (self.ends_here || self.config.explore == ExplorationPolicy::ByChance)
    }

    /// Wanders a little: looks round, or drives straight on until something is near and then turns.
    fn wander<R: SnapshotRobot>(&mut self, robot: &mut R) -> Result<(), R::Error> {
        if self.looks_round > 0 {
            self.looks_round -= 1;
            return self.turn_by(robot, 2.0 * PI / f64::from(self.config.first_looks));
        }
        if self.turn.abs() > 0.0 {
            return self.turn_on(robot);
        }
        if self.drive(robot)? != LegEnd::TooLong {
            self.turn = self.turn_elsewhere(robot.sensing());
        }
        Ok(())
    }

    /// Returns the angle to turn by when something is near, rad: random, or into any direction in
    /// which nothing is near.
    fn turn_elsewhere(&mut self, sensing: &impl Soundings) -> f64 {
        if self.config.explore == ExplorationPolicy::ToTheUnknown {
            let ways = ways_on(sensing, self.lane());
            if !ways.is_empty() {
                return ways[self.rng.random_range(0..ways.len() as u32) as usize];
            }
        }
        let angle = self.rng.random_range(LEAST_TURN..PI);
        if self.rng.random() { angle } else { -angle }
    }

    /// Returns the room that the robot needs to go on beyond a place.
    fn lane(&self) -> Lane {
        let apart = self.config.map.place_distance;
        Lane {
            half_width: self.config.lane,
            reach: apart + self.config.arrival + BEYOND,
            apart,
        }
    }

    /// Drives a piece of the way, up to where something is near.
    fn drive<R: SnapshotRobot>(&mut self, robot: &mut R) -> Result<LegEnd, R::Error> {
        let mut robot = Reckoned::new(robot, |rolled| self.rolled.push(rolled));
        let end = self.driver.drive(&mut robot)?;
        if end == LegEnd::Bumped {
            self.has_touched = true;
            self.driver.go_free(&mut robot, STEPS_FREE)?;
        }
        Ok(end)
    }

    /// Makes a piece of the turn in progress.
    fn turn_on<R: SnapshotRobot>(&mut self, robot: &mut R) -> Result<(), R::Error> {
        let piece = self
            .turn
            .clamp(-self.config.turn_piece, self.config.turn_piece);
        self.turn -= piece;
        self.turn_by(robot, piece)
    }

    /// Turns in place by `angle`, rad, counter-clockwise, by odometry. If the robot touches
    /// something, it drives free instead.
    fn turn_by<R: SnapshotRobot>(&mut self, robot: &mut R, angle: f64) -> Result<(), R::Error> {
        let mut robot = Reckoned::new(robot, |rolled| self.rolled.push(rolled));
        self.has_touched |= self.driver.turn_by(&mut robot, angle)? == TurnByEnd::Touched;
        Ok(())
    }

    /// Stands still until a snapshot comes, and takes it in.
    fn look<R: SnapshotRobot + SensesLandmarks>(
        &mut self,
        robot: &mut R,
    ) -> Result<(), OnlineSlamError<R::Error>> {
        for _ in 0..self.config.patience {
            Reckoned::new(&mut *robot, |rolled| self.rolled.push(rolled))
                .stop()
                .map_err(OnlineSlamError::Robot)?;
            if let Some(snapshot) = robot.sensing().snapshot() {
                let seen = SeenThere {
                    rolled: core::mem::take(&mut self.rolled),
                    snapshot,
                    put_down: core::mem::take(&mut self.was_put_down),
                };
                self.observe(&seen)?;
                self.remember(robot.landmark());
                return Ok(());
            }
        }
        let steps = self.config.patience;
        Err(OnlineSlamError::NoSnapshot { steps })
    }

    /// Records the place nearest to a landmark that the robot senses.
    fn remember(&mut self, landmark: Option<Landmark>) {
        let (Some(landmark), Some(here), true) =
            (landmark, self.map.here(), self.map.is_localized())
        else {
            return;
        };
        let place = self.map.nearest(here.position);
        let is_known =
            |known: &LandmarkSighting| (known.landmark, known.place) == (landmark, place);
        if !self.sightings.iter().any(is_known) {
            let pose = self.map.poses().poses()[place as usize];
            self.sightings.push(LandmarkSighting {
                landmark,
                place,
                at: pose.inverse().transform(here.position),
            });
        }
    }

    /// Returns the target of a goal on the map, or `None` if the map does not have it.
    fn target(&self, goal: Goal) -> Option<Target> {
        match goal {
            Goal::Place(place) => {
                let pose = self.map.poses().poses().get(place as usize)?;
                let point = pose.position;
                Some(Target { place, point })
            }
            Goal::Point(_) => None,
            Goal::Landmark(wanted) => amid(&self.sightings, wanted, &self.tried, &self.map),
        }
    }

    /// Handles a goal that is not sensed where it should be. The robot goes to the next position
    /// where the goal was sensed. After the last one its pose must be wrong, and it localizes
    /// again.
    fn miss(&mut self, goal: Goal, place: u32) {
        self.route = None;
        self.tried.push(place);
        if self.target(goal).is_none() {
            self.tried.clear();
            self.put_down();
        }
    }

    /// Goes a piece of the way to a frontier. Returns `false` if there is none.
    fn go_beyond<R: SnapshotRobot>(&mut self, robot: &mut R, here: Pose) -> Result<bool, R::Error> {
        if self.frontier.is_none() {
            self.frontier = self.next_frontier(here.position);
            if self.frontier.is_none() && self.retries > 0 {
                // What was in the way of some may be so no more.
                self.retries -= 1;
                self.explored.clear();
                self.frontier = self.next_frontier(here.position);
            }
            self.ends_here = self.frontier.is_none();
        }
        let Some(Frontier { target, patience }) = self.frontier else {
            return Ok(false);
        };
        self.has_touched = false;
        let standing = self.approach(robot, here, target)?;
        let costs = match (self.has_touched, self.route.is_none()) {
            (true, _) => PATIENCE,
            (false, true) => BLOCKED,
            (false, false) => 1,
        };
        if standing != Standing::UnderWay || patience <= costs {
            // Whatever there was to be seen from there has been seen.
            self.explored.push(target.point);
            self.frontier = None;
            self.route = None;
        } else {
            let patience = patience - costs;
            self.frontier = Some(Frontier { target, patience });
        }
        Ok(true)
    }

    fn next_frontier(&self, here: Point) -> Option<Frontier> {
        let targets = frontiers(&self.map, self.lane(), &self.explored);
        let target = self.obstacles.nearest(&self.map, here, targets)?;
        let patience = PATIENCE;
        Some(Frontier { target, patience })
    }

    /// Goes a piece of the way to a target.
    fn approach<R: SnapshotRobot>(
        &mut self,
        robot: &mut R,
        here: Pose,
        target: Target,
    ) -> Result<Standing, R::Error> {
        let arrival = self.config.arrival;
        let is_other = |route: &Route| {
            let apart = (route.target.point - target.point).norm();
            route.target.place != target.place || apart > arrival
        };
        if self.route.as_ref().is_none_or(is_other) {
            self.route = Route::find(&self.map, here.position, target, &self.obstacles);
        }
        let Some(route) = &mut self.route else {
            let place = target.place;
            return Ok(Standing::gave_up(format!(
                "no way to place {place} is known"
            )));
        };
        let Some(next) = route.next(here.position, arrival) else {
            return Ok(Standing::Done);
        };
        self.go_towards(robot, here, next)?;
        Ok(Standing::UnderWay)
    }

    /// Turns towards a point, or drives there where it lies ahead.
    fn go_towards<R: SnapshotRobot>(
        &mut self,
        robot: &mut R,
        here: Pose,
        next: Point,
    ) -> Result<(), R::Error> {
        let way = here.inverse().transform(next);
        let bearing = libm::atan2(way.y, way.x);
        if bearing.abs() > AHEAD {
            let piece = 2.0 * self.config.turn_piece;
            return self.turn_by(robot, bearing.clamp(-piece, piece));
        }
        // Where it has driven before it gets through, however near the walls are.
        self.driver.give_way(self.config.give_way);
        let end = self.drive(robot)?;
        self.driver.give_way(1.0);
        if end != LegEnd::TooLong {
            // Something is in the way: round it, and look for another way from there.
            let route = self.route.take();
            if let Some(link) = route.and_then(|route| route.link()) {
                self.obstacles.note(link);
            }
            self.turn = if self.rng.random() { 1.2 } else { -1.2 };
            self.turn_on(robot)?;
            self.drive(robot)?;
        }
        Ok(())
    }
}

/// Angle on both sides of straight ahead that counts as ahead, rad.
const AHEAD: f64 = 0.25;

impl Mapper for OnlineSlam {
    type Observation = SeenThere;
    type Error = PlaceGraphError;

    fn observe(&mut self, seen: &SeenThere) -> Result<(), PlaceGraphError> {
        let before = self.map.places().len();
        self.map.observe(seen)?;
        self.quiet = if self.map.places().len() > before {
            0
        } else {
            self.quiet + 1
        };
        Ok(())
    }

    fn map(&self) -> MapView {
        let mut view = self.map.map();
        for sighting in &self.sightings {
            if let Some(place) = view.places.get_mut(sighting.place as usize) {
                place.landmark = Some(sighting.landmark);
            }
        }
        view
    }

    fn belief(&self) -> Vec<Guess> {
        self.map.belief()
    }

    fn doubt(&self) -> Option<String> {
        let is_goal = |sighting: &LandmarkSighting| sighting.landmark == Landmark::Goal;
        match (self.map.is_localized(), self.sightings.iter().any(is_goal)) {
            (false, _) => Some("the robot does not know where it is on it".to_owned()),
            (true, false) => Some("the robot never sensed the goal".to_owned()),
            (true, true) => None,
        }
    }

    fn map_bytes(&self) -> Option<usize> {
        Some(self.map.bytes())
    }
}

impl<R: SnapshotRobot + SensesLandmarks> System<R> for OnlineSlam {
    type Failure = OnlineSlamError<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        if let Task::Reach(Goal::Landmark(goal)) = task
            && robot.landmark() == Some(goal)
        {
            return Ok(Standing::Done);
        }
        let here = self.map.here().filter(|_| self.map.is_localized());
        if here.is_none() {
            // Whatever way it was on, it was not there.
            self.route = None;
        }
        let goal = match task {
            Task::Reach(goal) => Some(goal),
            Task::Explore | Task::Localize => None,
        };
        let target = goal.and_then(|goal| Some((goal, self.target(goal)?)));
        if let (Some(_), None, Some(Goal::Place(place))) = (here, target, goal) {
            return Ok(Standing::gave_up(format!(
                "there is no place {place} on the map"
            )));
        }
        let standing = match (here, target) {
            (Some(here), Some((goal, target))) => {
                let standing = self
                    .approach(robot, here, target)
                    .map_err(OnlineSlamError::Robot)?;
                match (standing, goal) {
                    (Standing::UnderWay, _) => {}
                    (Standing::Done, Goal::Landmark(_)) => self.miss(goal, target.place),
                    (standing, _) => return Ok(standing),
                }
                Standing::UnderWay
            }
            // The first look comes before the first step.
            _ if self.map.here().is_none() => Standing::UnderWay,
            (Some(here), None) if self.goes_beyond() => {
                let went = self
                    .go_beyond(robot, here)
                    .map_err(OnlineSlamError::Robot)?;
                if !went {
                    self.wander(robot).map_err(OnlineSlamError::Robot)?;
                }
                Standing::UnderWay
            }
            _ => {
                self.wander(robot).map_err(OnlineSlamError::Robot)?;
                Standing::UnderWay
            }
        };
        self.look(robot)?;
        let is_localized = self.map.is_localized();
        Ok(match task {
            Task::Explore if is_localized && self.has_explored() => Standing::Done,
            Task::Localize if is_localized => Standing::Done,
            _ => standing,
        })
    }

    fn put_down(&mut self) -> Standing {
        Self::put_down(self);
        Standing::UnderWay
    }

    fn words(&self) -> String {
        match self.map.is_localized() {
            true => String::new(),
            false => format!("lost: {} guesses", self.map.belief().len()),
        }
    }
}
