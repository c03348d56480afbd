//! The system that corrects its pose while it learns (the paper's section 6).

use core::f64::consts::PI;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_control::wander::{LegEnd, UntilNear, UntilNearConfig};
use tolman_geom::{Point, Pose};
use tolman_maps::place_graph::{PlaceGraph, PlaceGraphConfig, PlaceGraphError, SeenThere};
use tolman_robot::{
    Bumps, Goal, Guess, Landmark, MapView, Mapper, Odometry, Robot, Rolls, SensesLandmarks,
    Soundings, Standing, System, TakesSnapshots, Task, TurnTranslate,
};

use super::route::Route;
use crate::stream;

/// How an [`OnlineSlam`] moves and maps.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct OnlineSlamConfig {
    /// How it drives. A leg is one piece of the way: it looks after each.
    pub drive: UntilNearConfig,
    /// It turns by no more than this before it looks again, rad.
    pub turn_piece: f64,
    /// So many looks round where it is put down come first.
    pub first_looks: u32,
    /// It has explored all when so many looks in a row have shown no new place.
    pub quiet_looks: u32,
    /// Time steps that it stands still for a snapshot at most, at least 1.
    pub patience: u32,
    /// It has come to a place when it is this near, m.
    pub arrival: f64,
    /// How it maps.
    pub map: PlaceGraphConfig,
}

impl OnlineSlamConfig {
    /// Returns our values for the Pioneer 2-DX: it looks after each 0.4 m and each 30°, and goes on to 0.6 m before a wall.
    #[must_use]
    pub const fn pioneer_2dx() -> Self {
        let mut drive = UntilNearConfig::paper();
        drive.longest_leg = 10;
        drive.limits.ahead = 0.6;
        Self {
            drive,
            turn_piece: PI / 6.0,
            first_looks: 18,
            quiet_looks: 150,
            patience: 10,
            arrival: 0.3,
            map: PlaceGraphConfig::indoors(),
        }
    }
}

/// Why an [`OnlineSlam`] cannot go on.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OnlineSlamError<R> {
    /// No snapshot came while the robot stood still.
    #[error(
        "the robot stood still for {steps} time steps and took no snapshot; switch its camera and range sensors on, or raise `patience`"
    )]
    NoSnapshot {
        /// For how many time steps it stood.
        steps: u32,
    },
    /// What was seen cannot be mapped.
    #[error("the map cannot take in what the robot saw")]
    Map(#[from] PlaceGraphError),
    /// The robot failed.
    #[error("the robot failed")]
    Robot(#[source] R),
}

/// Drives any robot that turns, translates and takes snapshots, maps places on the way, and corrects its pose by them.
///
/// An action is a piece of the way or of a turn, and a look at where it has led.
#[derive(Debug)]
pub struct OnlineSlam {
    config: OnlineSlamConfig,
    map: PlaceGraph,
    driver: UntilNear,
    rng: ChaCha8Rng,
    /// What the wheels rolled since the last look.
    rolled: Vec<Odometry>,
    was_put_down: bool,
    /// Looks round that are still to be made.
    looks_round: u32,
    /// What is left of the turn under way, rad.
    turn: f64,
    /// Looks since the last new place.
    quiet: u32,
    /// Places from which a landmark was sensed.
    landmarks: Vec<(Landmark, u32)>,
    route: Option<Route>,
}

/// How many time steps it goes away from something that it has touched, at half its full speed.
const STEPS_FREE: u32 = 4;

/// A turn takes no more time steps than this.
const LONGEST_TURN: u32 = 60;

/// A random turn is at least so large, rad: what is near ahead is near all the same a little beside.
const LEAST_TURN: f64 = 0.5;

impl OnlineSlam {
    /// Returns a system without a map, whose robot has just been put down. `seed` is that of all its turns.
    #[must_use]
    pub fn new(config: OnlineSlamConfig, seed: u64) -> Self {
        Self::on(PlaceGraph::new(config.map), config, seed)
    }

    /// Returns a system that knows a map, and goes on with it; for a robot that may stand anywhere, take a map that was
    /// [put down](PlaceGraph::put_down).
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
            landmarks: Vec::new(),
            route: None,
            map,
            config,
        }
    }

    /// Returns the map.
    #[must_use]
    pub const fn graph(&self) -> &PlaceGraph {
        &self.map
    }

    /// Tells it that its robot has been lifted and put down, perhaps elsewhere.
    pub fn put_down(&mut self) {
        self.was_put_down = true;
        self.looks_round = self.config.first_looks;
        self.turn = 0.0;
        self.route = None;
        self.rolled.clear();
    }

    /// Goes on a little: round, or straight on until something is near and then elsewhere by chance.
    fn wander<R>(&mut self, robot: &mut R) -> Result<(), R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls + Bumps,
    {
        if self.looks_round > 0 {
            self.looks_round -= 1;
            return self.turn_by(robot, 2.0 * PI / f64::from(self.config.first_looks));
        }
        if self.turn.abs() > 0.0 {
            return self.turn_on(robot);
        }
        if self.drive(robot)? != LegEnd::TooLong {
            let angle = self.rng.random_range(LEAST_TURN..PI);
            self.turn = if self.rng.random() { angle } else { -angle };
        }
        Ok(())
    }

    /// Drives a piece of the way, as far as nothing is near.
    fn drive<R>(&mut self, robot: &mut R) -> Result<LegEnd, R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls + Bumps,
    {
        let mut robot = Counting {
            robot,
            rolled: &mut self.rolled,
        };
        let end = self.driver.drive(&mut robot)?;
        if end == LegEnd::Bumped {
            go_free(&mut robot)?;
        }
        Ok(end)
    }

    /// Makes a piece of the turn under way.
    fn turn_on<R>(&mut self, robot: &mut R) -> Result<(), R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls + Bumps,
    {
        let piece = self
            .turn
            .clamp(-self.config.turn_piece, self.config.turn_piece);
        self.turn -= piece;
        self.turn_by(robot, piece)
    }

    /// Turns in place by `angle`, rad, counter-clockwise, as far as the wheels tell. Where it touches something it goes free of that
    /// instead.
    fn turn_by<R>(&mut self, robot: &mut R, angle: f64) -> Result<(), R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls + Bumps,
    {
        let mut robot = Counting {
            robot,
            rolled: &mut self.rolled,
        };
        let (mut turned, mut per_command) = (0.0, None);
        for _ in 0..LONGEST_TURN {
            let left = angle - turned;
            if left.abs() < LEAST_PIECE || left * angle < 0.0 {
                break;
            }
            let most = self.config.drive.turn;
            // How far a full command turns it is not known before the first step.
            let wanted =
                per_command.map_or(FIRST_COMMAND, |rate: f64| (left.abs() / rate).min(most));
            let command = TurnTranslate {
                turn: wanted.min(most) * left.signum(),
                translate: 0.0,
            };
            robot.step(&command)?;
            if robot.sensing().bump() == Some(true) {
                return go_free(&mut robot);
            }
            let rolled = robot.sensing().odometry().map_or(0.0, |rolled| rolled.turn);
            turned += rolled;
            per_command = (rolled.abs() > 0.0)
                .then(|| (rolled / command.turn).abs())
                .or(per_command);
        }
        Ok(())
    }

    /// Stands still until a snapshot comes, and takes it in.
    fn look<R>(&mut self, robot: &mut R) -> Result<(), OnlineSlamError<R::Error>>
    where
        R: Robot<Command = TurnTranslate> + SensesLandmarks,
        R::Sensing: TakesSnapshots + Rolls,
    {
        for _ in 0..self.config.patience {
            let mut counting = Counting {
                robot: &mut *robot,
                rolled: &mut self.rolled,
            };
            counting
                .step(&TurnTranslate::STOP)
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

    /// Notes the place nearest to a landmark that the robot senses.
    fn remember(&mut self, landmark: Option<Landmark>) {
        let (Some(landmark), Some(here), true) =
            (landmark, self.map.here(), self.map.is_localized())
        else {
            return;
        };
        let place = self.map.nearest(here.position);
        if !self.landmarks.contains(&(landmark, place)) {
            self.landmarks.push((landmark, place));
        }
    }

    /// Where a goal lies on the map.
    fn place_of(&self, goal: Goal) -> Option<u32> {
        match goal {
            Goal::Place(place) => Some(place),
            Goal::Landmark(wanted) => {
                let mut known = self.landmarks.iter().rev();
                known
                    .find(|(landmark, _)| *landmark == wanted)
                    .map(|(_, place)| *place)
            }
        }
    }

    /// Goes a piece of the way to a place.
    fn approach<R>(&mut self, robot: &mut R, here: Pose, goal: u32) -> Result<Standing, R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls + Bumps,
    {
        if self.route.as_ref().is_none_or(|route| route.goal != goal) {
            self.route = Route::find(&self.map, here.position, goal);
        }
        let Some(route) = &mut self.route else {
            return Ok(Standing::gave_up(format!(
                "no way to place {goal} is known"
            )));
        };
        let Some(next) = route.next(here.position, self.config.arrival) else {
            return Ok(Standing::Done);
        };
        self.go_towards(robot, here, next)?;
        Ok(Standing::UnderWay)
    }

    /// Turns towards a point, or drives there where it lies ahead.
    fn go_towards<R>(&mut self, robot: &mut R, here: Pose, next: Point) -> Result<(), R::Error>
    where
        R: Robot<Command = TurnTranslate>,
        R::Sensing: TakesSnapshots + Rolls + Bumps,
    {
        let way = here.inverse().transform(next);
        let bearing = libm::atan2(way.y, way.x);
        if bearing.abs() > AHEAD {
            let piece = 2.0 * self.config.turn_piece;
            return self.turn_by(robot, bearing.clamp(-piece, piece));
        }
        // Where it has driven before it gets through, however near the walls are.
        self.driver.give_way(0.6);
        let end = self.drive(robot)?;
        self.driver.give_way(1.0);
        if end != LegEnd::TooLong {
            // Something is in the way: round it, and look for another way from there.
            self.route = None;
            self.turn = if self.rng.random() { 1.2 } else { -1.2 };
            self.turn_on(robot)?;
            self.drive(robot)?;
        }
        Ok(())
    }
}

/// Goes a little away from what is nearest: back if that lies ahead, and on if it lies behind.
fn go_free<R>(robot: &mut R) -> Result<(), R::Error>
where
    R: Robot<Command = TurnTranslate>,
    R::Sensing: TakesSnapshots,
{
    let nearest = robot
        .sensing()
        .soundings()
        .min_by(|a, b| a.range.total_cmp(&b.range));
    let ahead = nearest.is_none_or(|nearest| libm::cos(nearest.mount.heading.radians()) > 0.0);
    let command = TurnTranslate {
        turn: 0.0,
        translate: if ahead { -0.5 } else { 0.5 },
    };
    for _ in 0..STEPS_FREE {
        robot.step(&command)?;
    }
    Ok(())
}

/// The first command of a turn, as a fraction of the full rate.
const FIRST_COMMAND: f64 = 0.05;

/// A turn this near to what was wanted is done, rad.
const LEAST_PIECE: f64 = 0.02;

/// What lies within this angle lies ahead, rad.
const AHEAD: f64 = 0.25;

/// A robot whose steps are noted.
struct Counting<'a, R> {
    robot: &'a mut R,
    rolled: &'a mut Vec<Odometry>,
}

impl<R> Robot for Counting<'_, R>
where
    R: Robot<Sensing: Rolls>,
{
    type Command = R::Command;
    type Sensing = R::Sensing;
    type Error = R::Error;

    fn sensing(&self) -> &R::Sensing {
        self.robot.sensing()
    }

    fn step(&mut self, command: &R::Command) -> Result<(), R::Error> {
        self.robot.step(command)?;
        self.rolled.extend(self.robot.sensing().odometry());
        Ok(())
    }
}

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
        self.map.map()
    }

    fn belief(&self) -> Vec<Guess> {
        self.map.belief()
    }
}

impl<R> System<R> for OnlineSlam
where
    R: Robot<Command = TurnTranslate> + SensesLandmarks,
    R::Sensing: TakesSnapshots + Rolls + Bumps,
{
    type Failure = OnlineSlamError<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        if let Task::Reach(Goal::Landmark(goal)) = task
            && robot.landmark() == Some(goal)
        {
            return Ok(Standing::Done);
        }
        let here = self.map.here().filter(|_| self.map.is_localized());
        let goal = match task {
            Task::Reach(goal) => self.place_of(goal),
            Task::Explore | Task::Localize => None,
        };
        let standing = match (here, goal) {
            (Some(here), Some(goal)) => {
                let standing = self
                    .approach(robot, here, goal)
                    .map_err(OnlineSlamError::Robot)?;
                if standing != Standing::UnderWay {
                    return Ok(standing);
                }
                standing
            }
            // The first look comes before the first step.
            _ if self.map.here().is_none() => Standing::UnderWay,
            _ => {
                self.wander(robot).map_err(OnlineSlamError::Robot)?;
                Standing::UnderWay
            }
        };
        self.look(robot)?;
        Ok(match task {
            Task::Explore if self.quiet >= self.config.quiet_looks => Standing::Done,
            Task::Localize if self.map.is_localized() => Standing::Done,
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
