use core::time::Duration;

use thiserror::Error;
use tolman_geom::{Point, Pose, path_length};
use tolman_maze::{Cell, Direction, Maze, MazeFile};
use tolman_robot::{Goal, Landmark, Standing, Task};
use tolman_sim::DoorState;
use tolman_systems::stream;

use super::claim::Claim;
use super::condition::{Condition, door_name};
use super::evidence::{Evidence, TrueVisits};
use super::ideal::IdealObserver;
use super::judgement::MapJudgement;
use super::paint::Paint;
use super::sites::Sites;
use super::true_graph::TrueGraph;
use super::wanderers::Sender;
use super::whereabouts::{Squares, believed};
use crate::course::{Course, Terrain, pick};
use crate::registry::{Registry, RobotEntry, RobotKind, Schooling, Settings, Setup, SystemEntry};
use crate::run::{Stopwatch, TaskEnd};
use crate::{BoxError, Outing};

/// A contestant in a world.
#[derive(Clone, Copy, Debug)]
pub struct Contest<'a> {
    /// The system or baseline.
    pub contestant: &'static dyn SystemEntry,
    /// Robot that carries the contestant; `None` for the one that it is made for.
    pub robot: Option<RobotEntry>,
    /// The drawing, which marks start and goal.
    pub maze: &'a Maze,
    /// Name of the drawing.
    pub name: &'a str,
    /// Change of robot and world.
    pub condition: Condition,
    /// Number of times that the robot is put down to localize, and again to drive to the goal.
    pub starts: u32,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Clock that measures the contestant's computing time, or `None`. Nothing else depends on it.
    pub stopwatch: Option<Stopwatch>,
}

/// Reason why a contest cannot be held. A system that fails is a result, not an error.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ContestError {
    /// Robot, system and drawing do not fit together.
    #[error("{contestant} cannot be sent into {world}; choose another system or world")]
    Enter {
        /// Name of the contestant.
        contestant: &'static str,
        /// Name of the world.
        world: String,
        /// The underlying error.
        #[source]
        source: BoxError,
    },
    /// There is no room for the robot where it is put down.
    #[error("{contestant} cannot be put down in {world}; choose another place")]
    PutDown {
        /// Name of the contestant.
        contestant: &'static str,
        /// Name of the world.
        world: String,
        /// The underlying error.
        #[source]
        source: BoxError,
    },
}

/// A moment at which a contest calls its viewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// The contestant is at the start.
    Begun,
    /// The contestant has made an action.
    Acted,
    /// The robot was lifted and put down elsewhere, and the contestant was told.
    PutDown,
    /// The contest has ended.
    Over,
}

/// Result of a contest.
#[derive(Clone, Debug, Default)]
pub struct ContestRecord {
    /// Reason why the contestant abstained; `None` if it drove.
    pub abstained: Option<String>,
    /// Result of learning; `None` if the contestant abstained, or learns no map.
    pub learned: Option<LearnRecord>,
    /// Reason of the contestant to doubt its map when it had learned; `None` if it sees none.
    pub doubt: Option<String>,
    /// Results of localizing, one for each place where the robot was put down.
    pub found: Vec<Located>,
    /// Results of driving to the goal, one for each place where the robot was put down.
    pub homes: Vec<Home>,
}

/// Result of learning a world.
#[derive(Clone, Debug)]
pub struct LearnRecord {
    /// End of the learning.
    pub end: TaskEnd,
    /// The system's verdict on its own map.
    pub claim: Claim,
    /// Probability that the system's map is right, by its own estimate, 0 … 1; `None` if the system
    /// gives no estimate.
    pub certainty: Option<f64>,
    /// Quality of the system's map, compared with the truth.
    pub judgement: MapJudgement,
    /// The judge's evidence.
    pub evidence: Evidence,
    /// Driven distance over the length of all corridors.
    pub driven: f64,
    /// Number of time steps.
    pub steps: u32,
    /// Number of time steps in which the robot touched something.
    pub bumps: u32,
    /// Number of places on the system's map.
    pub places: usize,
    /// Size of the system's map, bytes; `None` if unknown.
    pub map_bytes: Option<usize>,
    /// Computing time without the simulator; `None` if it was not measured.
    pub thinking: Option<Duration>,
}

impl ContestRecord {
    /// Returns why the contestant did not do all of its tasks, in its own words: the first reason,
    /// in a sentence without a full stop; `None` if it sees none.
    #[must_use]
    pub fn complaint(&self) -> Option<&str> {
        let learned = self.complaint_of_map().into_iter();
        let lost = self.found.iter().filter_map(|found| match &found.outcome {
            LocateOutcome::Abstained { why } => Some(why.as_str()),
            LocateOutcome::Right | LocateOutcome::Wrong => None,
        });
        let homes = self.homes.iter().map(|home| home.gave_up.as_str());
        let mut whys = learned.chain(lost).chain(homes);
        whys.find(|why| !why.is_empty())
    }

    /// Returns why the contestant gave up learning or doubts its map, in a sentence without a full
    /// stop; `None` if it does neither.
    #[must_use]
    pub fn complaint_of_map(&self) -> Option<&str> {
        let why = self.learned.as_ref().map(|learned| learned.end.why());
        why.filter(|why| !why.is_empty()).or(self.doubt.as_deref())
    }

    /// Returns how good its map is, to find the worst: 0 is the worst, and a right map is above 1.
    /// `None` if it learned none.
    #[must_use]
    pub fn goodness(&self) -> Option<f64> {
        let judged = self.learned.as_ref()?.judgement;
        let both = judged.link_recall * judged.link_precision.unwrap_or(0.0);
        Some(both + if judged.is_right { 1.0 } else { 0.0 })
    }
}

impl LearnRecord {
    /// Returns the probability that the map is right by the system's own verdict, 0 … 1. It is the
    /// system's estimate if it claims something, and ½ if it is undecided.
    #[must_use]
    pub fn likelihood(&self) -> f64 {
        match self.claim {
            Claim::Right => self.certainty.unwrap_or(1.0),
            Claim::Wrong => 0.0,
            Claim::Undecided => 0.5,
        }
    }

    /// Returns the size of its map per place, bytes; `None` for a map without places or of unknown
    /// size.
    #[must_use]
    pub fn bytes_per_place(&self) -> Option<f64> {
        let bytes = self.map_bytes.filter(|_| self.places > 0)?;
        Some(bytes as f64 / self.places as f64)
    }

    /// Returns the computing time per time step without the simulator, µs; `None` if it was not
    /// measured.
    #[must_use]
    pub fn us_per_step(&self) -> Option<f64> {
        let thinking = self.thinking.filter(|_| self.steps > 0)?;
        Some(1e6 * thinking.as_secs_f64() / f64::from(self.steps))
    }
}

/// A system's answer to where it was put down.
#[derive(Clone, Debug, PartialEq)]
pub enum LocateOutcome {
    /// The system says where it is, and is right.
    Right,
    /// The system says where it is, and is wrong.
    Wrong,
    /// The system does not answer.
    Abstained {
        /// Reason, as a sentence without a full stop.
        why: String,
    },
}

/// Result of localizing after the robot was put down.
#[derive(Clone, Debug, PartialEq)]
pub struct Located {
    /// Answer of the system.
    pub outcome: LocateOutcome,
    /// Probability that an ideal observer with the true drawing would name the right cell after the
    /// same drive, 0 … 1: the passive upper bound. `None` if it did not drive.
    pub ceiling: Option<f64>,
    /// Probability that the system gave to its true place after each of its first
    /// [`WATCHED`](Self::WATCHED) actions, 0 … 1. Empty if it did not drive.
    pub chances: Vec<f64>,
    /// Result of the same system on the same robot with the true map: the active upper bound. It
    /// learned that map without errors. `None` if it learned a wrong map even so, or if its own map
    /// is wrong.
    pub with_true_map: Option<Box<Self>>,
}

impl Located {
    /// Number of actions for which [`chances`](Self::chances) are kept.
    pub const WATCHED: usize = 20;

    /// Returns whether the system says where it is, and is right.
    #[must_use]
    pub fn is_right(&self) -> bool {
        self.outcome == LocateOutcome::Right
    }

    /// Returns the probability that the system gave to its true place after `actions` actions, at
    /// least 1 and at most [`WATCHED`](Self::WATCHED). A system that ended before does not change
    /// its mind. `None` if it did not drive.
    #[must_use]
    pub fn chance_after(&self, actions: usize) -> Option<f64> {
        let kept = self.chances.get(actions.checked_sub(1)?);
        kept.or(self.chances.last()).copied()
    }

    pub(super) const fn undriven(why: String) -> Self {
        Self {
            outcome: LocateOutcome::Abstained { why },
            ceiling: None,
            chances: Vec::new(),
            with_true_map: None,
        }
    }
}

/// Result of driving to the goal.
#[derive(Clone, Debug, PartialEq)]
pub struct Home {
    /// Driven distance over that of the shortest way; `None` if it did not arrive within
    /// [`Contest::LIMIT`] times that length and the length of all corridors.
    pub over_shortest: Option<f64>,
    /// Number of time steps in which the robot touched something.
    pub bumps: u32,
    /// Reason why the system gave up before it arrived; empty if it did not give up.
    pub gave_up: String,
}

pub(super) const START_STREAM: u64 = 31;
const KIDNAPPING_STREAM: u64 = 34;

/// Initial limit of time steps, before the contest [allows](Outing::allow) more.
pub(super) const NO_STEPS: u32 = 0;

/// Share of the length of all corridors after which a robot is kidnapped.
const KIDNAPPED_AT: f64 = 0.5;

impl Contest<'_> {
    /// Maximum driven distance of a task, as a multiple of the length of all corridors, or of the
    /// shortest way to the goal.
    pub const LIMIT: f64 = 10.0;

    /// Returns the maximum distance that a robot may drive to the goal after it was put down, m:
    /// ten times the `shortest` way, and the length of all `corridors` once, because it first has
    /// to find out where it is, however near the goal is.
    pub(super) fn most_home(shortest: f64, corridors: f64) -> f64 {
        Self::LIMIT * shortest + corridors
    }

    /// Holds the contest and returns its record. Calls `watch` with the contestant at every
    /// [`Moment`]; nothing depends on it.
    ///
    /// # Errors
    /// [`ContestError`].
    pub fn play(
        &self,
        schooling: &Schooling,
        mut watch: impl FnMut(&dyn Outing, Moment),
    ) -> Result<ContestRecord, ContestError> {
        if let Some(why) = self.abstains() {
            return Ok(ContestRecord {
                abstained: Some(why),
                ..ContestRecord::default()
            });
        }
        if let Some(agent) = self.contestant.baseline() {
            let enter_error = |source| self.enter_error(source);
            let sender = Sender::new(self, agent).map_err(enter_error)?;
            return Ok(ContestRecord {
                found: sender.found().map_err(enter_error)?,
                homes: sender.homes().map_err(enter_error)?,
                ..ContestRecord::default()
            });
        }
        let mut bout = Bout::new(self, self.enter(schooling)?);
        if let Some(stopwatch) = self.stopwatch {
            bout.outing.measure(stopwatch);
        }
        watch(&*bout.outing, Moment::Begun);
        let mut learned = bout.learn(self.kidnapping(), &mut watch);
        learned.thinking = self.stopwatch.map(|_| bout.outing.thinking());
        let doubt = bout.outing.doubt();
        bout.shut_door()
            .map_err(|source| self.enter_error(source))?;
        let mut informed = match learned.judgement.is_right && self.starts > 0 {
            true => self.informed(schooling)?,
            false => None,
        };
        let (mut found, mut homes) = (Vec::new(), Vec::new());
        for [here, there] in self.put_downs() {
            let put = bout
                .locate(here, &mut watch)
                .map_err(|e| self.put_error(e))?;
            let with_true_map = match &mut informed {
                Some(informed) => {
                    let found = informed.locate(here, &mut |_, _| {});
                    let found = found.map_err(|source| self.put_error(source))?;
                    Some(Box::new(found))
                }
                None => None,
            };
            found.push(Located {
                with_true_map,
                ..put
            });
            if self.contestant.facts().watches {
                continue;
            }
            let home = bout
                .home(there, &mut watch)
                .map_err(|e| self.put_error(e))?;
            homes.push(home);
        }
        watch(&*bout.outing, Moment::Over);
        Ok(ContestRecord {
            abstained: None,
            learned: Some(learned),
            doubt,
            found,
            homes,
        })
    }

    /// Returns the robot that carries the contestant.
    #[must_use]
    pub fn robot(&self) -> RobotEntry {
        let own = || Registry::current().robot(self.contestant.facts().own_robot);
        self.robot.or_else(own).unwrap_or(RobotEntry::LASER_PIONEER)
    }

    /// Returns the reason why the contestant is not sent, in a sentence without a full stop; `None`
    /// if it is. O(cells).
    #[must_use]
    pub fn abstains(&self) -> Option<String> {
        if self.contestant.baseline().is_some() {
            return None;
        }
        let why_not = self.contestant.why_not(&self.robot());
        why_not.or_else(|| self.contestant.abstains(self.maze))
    }

    /// Puts the contestant at the start of the drawing, in corridors as wide as its robot needs.
    ///
    /// # Errors
    /// [`ContestError::Enter`] if robot and drawing do not fit together.
    pub(super) fn enter(&self, schooling: &Schooling) -> Result<Box<dyn Outing>, ContestError> {
        self.enter_by(schooling, &[])
    }

    /// Puts the contestant at the start like [`enter`](Self::enter), where further openings are
    /// doors, which stand open.
    ///
    /// # Errors
    /// As [`enter`](Self::enter).
    pub(super) fn enter_by(
        &self,
        schooling: &Schooling,
        doors: &[(Cell, Direction)],
    ) -> Result<Box<dyn Outing>, ContestError> {
        let terrain = Terrain::Maze(MazeFile::from(self.maze.clone()));
        let setup = Setup {
            world: self.name,
            terrain: &terrain,
            seed: self.seed,
            start: None,
            steps: Some(NO_STEPS),
            robot: self.robot(),
            from: None,
            settings: Settings {
                preset: self.contestant.facts().arena_preset,
                set: &[],
            },
            condition: self.condition,
            doors,
            schooling,
        };
        let outing = match self.contestant.baseline() {
            Some(_) => self.contestant.driver(&[], &setup),
            None => self.contestant.learner(&setup),
        };
        outing.map_err(|source| self.enter_error(source))
    }

    /// Returns the contestant with the true map, ready to be put down. It learned that map on a
    /// robot without errors. `None` if the map is wrong.
    fn informed(&self, schooling: &Schooling) -> Result<Option<Bout>, ContestError> {
        let sent = |contest: &Self| Ok(Bout::new(contest, contest.enter(schooling)?));
        let mut teacher = sent(&Self {
            condition: Condition::Flawless,
            ..*self
        })?;
        let learned = teacher.learn(None, &mut |_, _| {});
        if !learned.judgement.is_right {
            return Ok(None);
        }
        let mut informed = sent(self)?;
        let exchanged = informed.outing.exchange_systems(&mut *teacher.outing);
        exchanged
            .and_then(|()| informed.shut_door())
            .map_err(|source| self.enter_error(source))?;
        informed.sites = teacher.sites;
        Ok(Some(informed))
    }

    /// Returns the cells in which the robot is put down, with the direction it looks: to localize
    /// and to drive to the goal. They are random cells and ways out of them, never a goal.
    #[must_use]
    pub fn put_downs(&self) -> Vec<[(Cell, Direction); 2]> {
        let mut rng = stream(self.seed, START_STREAM);
        let ways = self.maze.ways_out();
        let mut way = || pick(&ways, &mut rng);
        let starts = (0..self.starts).filter_map(|_| Some([way()?, way()?]));
        starts.collect()
    }

    /// Returns the openings that are doors; see [`Condition::Doors`].
    pub(super) fn doors(&self) -> Vec<(Cell, Direction)> {
        self.condition.doors(self.maze, self.seed)
    }

    /// Returns the drawing as it is after the robot has learned.
    pub(super) fn maze_afterwards(&self) -> Maze {
        let mut maze = self.maze.clone();
        for (cell, way) in self.doors() {
            maze.set_wall(cell, way, true);
        }
        maze
    }

    /// Returns the cell and direction to which the robot is carried, untold, while it learns, or
    /// `None` without a kidnapping.
    fn kidnapping(&self) -> Option<(Cell, Direction)> {
        let is_kidnapped = self.condition == Condition::Kidnapping;
        let mut rng = stream(self.seed, KIDNAPPING_STREAM);
        pick(&self.maze.ways_out(), &mut rng).filter(|_| is_kidnapped)
    }

    /// Returns the ideal observer for a course of the drawing.
    pub(super) fn observer(&self, course: &Course) -> IdealObserver {
        let kind = match self.contestant.baseline() {
            Some(_) => RobotKind::Laser,
            None => self.robot().kind(),
        };
        IdealObserver {
            maze: self.maze_afterwards(),
            has_compass: kind.has_compass(),
            reach: self.contestant.sees_cells(kind),
            paint: match self.starts > 0 && kind.sees_colours() {
                true => Paint::of(course),
                false => Paint::default(),
            },
        }
    }

    pub(super) fn enter_error(&self, source: BoxError) -> ContestError {
        ContestError::Enter {
            contestant: self.contestant.title(),
            world: self.name.to_owned(),
            source,
        }
    }

    pub(super) fn put_error(&self, source: BoxError) -> ContestError {
        ContestError::PutDown {
            contestant: self.contestant.title(),
            world: self.name.to_owned(),
            source,
        }
    }
}

/// A contest in progress.
pub(super) struct Bout {
    pub(super) maze: Maze,
    /// Whether a door is shut after the robot has learned.
    has_door: bool,
    truth: TrueGraph,
    /// The passive bound of localizing; `None` in a free world.
    observer: Option<IdealObserver>,
    /// Length of all corridors, m.
    length: f64,
    /// Distance of two places of a drawing that lie next to each other, m.
    pub(super) unit: f64,
    claims: bool,
    pub(super) squares: Squares,
    pub(super) outing: Box<dyn Outing>,
    /// Whether the robot was lifted, and has made no step since.
    is_lifted: bool,
    /// True positions of the places of the map.
    sites: Sites,
}

/// A task in progress.
pub(super) struct Pursuit {
    task: Task,
    /// Distance driven after which the task ends, m.
    most: f64,
    /// Distance driven, m, after which the robot is put elsewhere without being told, and the pose
    /// there.
    kidnapping: Option<(f64, Pose)>,
    /// Index of the task's first pose in the robot's path.
    from: usize,
    /// Number of time steps before the task in which the robot touched something.
    bumped: usize,
    /// Distance driven so far, m.
    driven: f64,
    /// The last time step that was counted.
    until: usize,
    /// Distance driven when the robot last had advanced by a cell, m.
    before_last: f64,
    /// Number of actions since the robot last had advanced by a cell.
    idle: u32,
    /// Distance driven until the robot first was at the goal of the task, m; `None` before.
    arrived: Option<f64>,
    /// Position where the robot was put, and the index of the next pose of its path.
    put: Option<(Point, usize)>,
}

/// Course of a task.
pub(super) struct Driven {
    pub(super) end: TaskEnd,
    /// Index of the drive's first pose in the robot's path.
    from: usize,
    bumps: u32,
    /// Distance driven until the robot first reached the goal of the task, m; `None` if it never
    /// did.
    pub(super) arrived: Option<f64>,
    /// Distance driven in all, m.
    pub(super) metres: f64,
}

impl Bout {
    pub(super) fn new(contest: &Contest<'_>, outing: Box<dyn Outing>) -> Self {
        let squares = Squares::of(outing.course());
        Self {
            maze: contest.maze.clone(),
            has_door: !contest.doors().is_empty(),
            truth: TrueGraph::of(contest.maze, contest.contestant.facts().places),
            observer: Some(contest.observer(outing.course())),
            length: contest.maze.corridor_count() as f64 * squares.pitch,
            unit: squares.pitch,
            claims: contest.contestant.facts().claims,
            squares,
            outing,
            is_lifted: false,
            sites: Sites::default(),
        }
    }

    /// Returns a contestant in a free world.
    pub(super) fn in_floor(contestant: &dyn SystemEntry, outing: Box<dyn Outing>) -> Self {
        let (course, facts) = (outing.course(), contestant.facts());
        Self {
            maze: course.maze.clone(),
            has_door: false,
            truth: TrueGraph::of_course(course, facts.places),
            observer: None,
            length: course.corridor_metres(),
            unit: course.corridor_width,
            claims: facts.claims,
            squares: Squares::of(course),
            outing,
            is_lifted: false,
            sites: Sites::default(),
        }
    }

    pub(super) fn here(&self) -> Point {
        let last = self.outing.path().last();
        last.map_or_else(Point::origin, |pose| pose.position)
    }

    /// Begins a task, which ends at the latest after `most` metres of driving. After the distance
    /// that `kidnapping` gives, the robot is put elsewhere without being told.
    pub(super) fn set_out(
        &mut self,
        task: Task,
        most: f64,
        kidnapping: Option<(f64, Pose)>,
    ) -> Pursuit {
        // The path does not show that the robot was lifted: its last pose is where that happened.
        let from = self.outing.path().len() - usize::from(!self.is_lifted);
        self.is_lifted = false;
        let cells = match self.observer {
            Some(_) => self.maze.reachable().count() as u32,
            None => libm::ceil(self.length / self.unit) as u32,
        };
        self.outing.allow(cells.saturating_mul(STEPS_A_CELL));
        Pursuit {
            task,
            most,
            kidnapping,
            from,
            bumped: self.outing.bumped().len(),
            driven: 0.0,
            until: from,
            before_last: 0.0,
            idle: 0,
            arrived: None,
            put: None,
        }
    }

    /// Makes the next action of a task. Returns the end of the task once it has ended. `see` is
    /// shown the result of the action, and where the robot was before.
    pub(super) fn go_on(
        &mut self,
        pursuit: &mut Pursuit,
        see: impl FnOnce(&dyn Outing, Point),
    ) -> Option<TaskEnd> {
        let from = pursuit.from;
        let before = match pursuit.put {
            Some((at, next)) if next > pursuit.until => at,
            _ => self.here(),
        };
        let standing = self.outing.act(pursuit.task);
        see(&*self.outing, before);
        let path = self.outing.path();
        let last = path.len() - 1;
        let goal = match pursuit.task {
            Task::Reach(Goal::Landmark(landmark)) => self.outing.course().zone_of(landmark),
            Task::Reach(Goal::Place(_) | Goal::Point(_)) => self.outing.course().destination(),
            Task::Explore | Task::Localize => None,
        };
        for at in pursuit.until..=last {
            let step = path.get(at.max(from + 1) - 1..=at).map_or(0.0, path_length);
            let is_lifted = pursuit.put.is_some_and(|(_, next)| next == at);
            let is_new = at > pursuit.until && !is_lifted;
            pursuit.driven += if is_new { step } else { 0.0 };
            let is_there = goal.is_some_and(|zone| zone.contains(path[at].position));
            let driven = pursuit.driven;
            pursuit.arrived = pursuit.arrived.or(is_there.then_some(driven));
        }
        pursuit.until = pursuit.until.max(last);
        pursuit.idle += 1;
        if pursuit.driven - pursuit.before_last >= self.unit {
            (pursuit.before_last, pursuit.idle) = (pursuit.driven, 0);
        }
        match standing {
            Ok(Standing::UnderWay) => {}
            Ok(Standing::Done) => return Some(TaskEnd::Done),
            Ok(Standing::GaveUp { why }) => return Some(TaskEnd::GaveUp { why }),
            // It broke off in the middle of an action, as it had to.
            Err(_) if self.outing.is_out_of_time() => return Some(TaskEnd::OutOfTime),
            Err(error) => {
                let why = error.to_string();
                return Some(TaskEnd::GaveUp { why });
            }
        }
        let driven = pursuit.driven;
        if let Some((_, pose)) = pursuit.kidnapping.take_if(|(after, _)| driven > *after)
            && self.outing.lift(pose).is_ok()
        {
            pursuit.put = Some((pose.position, last + 1));
        }
        let is_over = driven > pursuit.most || pursuit.idle > IDLE || pursuit.arrived.is_some();
        (is_over || self.outing.is_out_of_time()).then_some(TaskEnd::OutOfTime)
    }

    /// Returns the record of a task that ended by `end`: its bumps, arrival and distance.
    pub(super) fn driven(&self, pursuit: &Pursuit, end: TaskEnd) -> Driven {
        Driven {
            end,
            from: pursuit.from,
            bumps: (self.outing.bumped().len() - pursuit.bumped) as u32,
            arrived: pursuit.arrived,
            metres: pursuit.driven,
        }
    }

    /// Lets the system pursue a task until it is done, gives up, or has driven too far. `see` is
    /// shown the result of each action, and where the robot was before.
    pub(super) fn pursue(
        &mut self,
        mut pursuit: Pursuit,
        mut see: impl FnMut(&dyn Outing, Point),
    ) -> Driven {
        loop {
            if let Some(end) = self.go_on(&mut pursuit, &mut see) {
                return self.driven(&pursuit, end);
            }
        }
    }

    /// Shuts the door, if there is one.
    fn shut_door(&mut self) -> Result<(), BoxError> {
        match self.has_door {
            true => self.outing.set_door(&door_name(0), DoorState::Shut),
            false => Ok(()),
        }
    }

    /// Returns the length of all corridors, m.
    pub(super) const fn corridors(&self) -> f64 {
        self.length
    }

    /// Returns the unit of [`LearnRecord::driven`], m.
    pub(super) fn scale(&self) -> f64 {
        self.corridors().max(self.unit)
    }

    pub(super) fn learn(
        &mut self,
        kidnapping: Option<(Cell, Direction)>,
        watch: &mut impl FnMut(&dyn Outing, Moment),
    ) -> LearnRecord {
        let pursuit = self.begin_to_learn(kidnapping);
        let mut been = TrueVisits::default();
        let driven = self.pursue(pursuit, |outing, before| {
            been.note(outing, before);
            watch(outing, Moment::Acted);
        });
        self.learned(driven, been)
    }

    /// Begins to learn. The robot is put elsewhere as `kidnapping` says.
    pub(super) fn begin_to_learn(&mut self, kidnapping: Option<(Cell, Direction)>) -> Pursuit {
        let kidnapping = kidnapping.map(|(cell, way)| {
            let pose = self.outing.course().in_cell(cell, way);
            (KIDNAPPED_AT * self.corridors(), pose)
        });
        let most = Contest::LIMIT * self.corridors();
        self.set_out(Task::Explore, most, kidnapping)
    }

    /// Returns the record of a learning run from its drive and the places where the robot truly
    /// was.
    pub(super) fn learned(&mut self, driven: Driven, been: TrueVisits) -> LearnRecord {
        let map = self.outing.map();
        let evidence = been.evidence(&*self.outing, driven.from);
        let mut judgement = evidence.judge(&map, &self.truth);
        if evidence.is_chart(&map, self.outing.course()) {
            (judgement.is_right, judgement.is_right_of_visited) = (true, true);
        }
        self.sites = Sites::of(&map, evidence.cells(), self.squares);
        let certainty = self.outing.certainty();
        LearnRecord {
            claim: Claim::of(&driven.end, self.claims, &*self.outing),
            certainty,
            end: driven.end,
            judgement,
            evidence,
            driven: driven.metres / self.scale(),
            steps: (self.outing.path().len() - 1 - driven.from) as u32,
            bumps: driven.bumps,
            places: map.places.len(),
            map_bytes: self.outing.map_bytes(),
            thinking: None,
        }
    }

    /// Puts the robot down in the middle of a cell and tells its system.
    pub(super) fn put_down(
        &mut self,
        (cell, way): (Cell, Direction),
    ) -> Result<Standing, BoxError> {
        let pose = self.outing.course().in_cell(cell, way);
        self.is_lifted = true;
        self.outing.put_down(pose)
    }

    /// Puts the robot back to the pose from which it was lifted.
    pub(super) fn put_back(&mut self, pose: Pose) -> Result<(), BoxError> {
        self.is_lifted = false;
        self.outing.lift(pose)
    }

    pub(super) fn locate(
        &mut self,
        start: (Cell, Direction),
        watch: &mut impl FnMut(&dyn Outing, Moment),
    ) -> Result<Located, BoxError> {
        if let Standing::GaveUp { why } = self.put_down(start)? {
            return Ok(Located::undriven(why));
        }
        watch(&*self.outing, Moment::PutDown);
        let pursuit = self.begin_to_localize();
        let (sites, near) = (self.sites.clone(), NEAR * self.unit);
        let mut chances = Vec::new();
        let driven = self.pursue(pursuit, |outing, before| {
            if chances.len() < Located::WATCHED {
                let here = outing.path().last().map_or(before, |pose| pose.position);
                chances.push(sites.chance(&outing.belief(), here, near));
            }
            watch(outing, Moment::Acted);
        });
        let path = &self.outing.path()[driven.from..];
        let observer = self.observer.as_ref();
        let ceiling = observer.map(|observer| observer.after(self.squares, start, path));
        Ok(Located {
            outcome: self.outcome(driven.end),
            ceiling,
            chances,
            with_true_map: None,
        })
    }

    /// Returns the system's answer after localizing has ended, compared with the truth.
    pub(super) fn outcome(&self, end: TaskEnd) -> LocateOutcome {
        match end {
            TaskEnd::Done => self.found(),
            TaskEnd::GaveUp { why } => LocateOutcome::Abstained { why },
            TaskEnd::OutOfTime => LocateOutcome::Abstained {
                why: "it was still looking when its time was up".to_owned(),
            },
        }
    }

    fn found(&self) -> LocateOutcome {
        let outing = &self.outing;
        let place = believed(&outing.belief(), || outing.map());
        let site = place.and_then(|place| self.sites.of_place(place));
        let off = site.map(|site| (site - self.here()).norm());
        match off {
            Some(off) if off < NEAR * self.unit => LocateOutcome::Right,
            _ => LocateOutcome::Wrong,
        }
    }

    /// Returns the length of the shortest way from a cell to the goal, m.
    fn metres_to_goal(&self, from: Cell) -> f64 {
        match &self.observer {
            Some(observer) => observer.maze.metres_to_goal(from, self.squares.pitch),
            None => self.maze.metres_to_goal(from, self.squares.pitch),
        }
    }

    pub(super) fn home(
        &mut self,
        start: (Cell, Direction),
        watch: &mut impl FnMut(&dyn Outing, Moment),
    ) -> Result<Home, BoxError> {
        let shortest = self.metres_to_goal(start.0);
        if let Standing::GaveUp { why } = self.put_down(start)? {
            return Ok(Home {
                over_shortest: None,
                bumps: 0,
                gave_up: why,
            });
        }
        watch(&*self.outing, Moment::PutDown);
        let goal = Task::Reach(Goal::Landmark(Landmark::Goal));
        let most = Contest::most_home(shortest, self.corridors());
        let pursuit = self.set_out(goal, most, None);
        let driven = self.pursue(pursuit, |outing, _| watch(outing, Moment::Acted));
        let arrived = driven.arrived;
        Ok(Home {
            over_shortest: arrived.filter(|way| *way <= most).map(|way| way / shortest),
            bumps: driven.bumps,
            gave_up: driven.end.why().to_owned(),
        })
    }
}

/// Number of actions without advancing by one cell after which a system counts as stuck. Otherwise
/// it could turn in place forever.
const IDLE: u32 = 500;

/// Maximum number of time steps of a task per cell, however little is driven in them. An e-puck,
/// the slowest, makes about 1200 in a cell, and may drive through all of them ten times.
const STEPS_A_CELL: u32 = 20_000;

/// Distance from a place within which a robot is at it, in cells.
pub(super) const NEAR: f64 = 0.75;

/// Lengths that a contest measures in a drawing.
pub(super) trait Measured {
    /// Returns the number of openings between two cells that can be reached.
    fn corridor_count(&self) -> usize;

    /// Returns all cells that can be reached but goals, with the ways out of them.
    fn ways_out(&self) -> Vec<(Cell, Direction)>;

    /// Returns the length of the shortest way from a cell to the goal, m.
    fn metres_to_goal(&self, from: Cell, pitch: f64) -> f64;
}

impl Measured for Maze {
    fn corridor_count(&self) -> usize {
        let ways = self.reachable().map(|cell| self.degree(cell));
        ways.sum::<usize>() / 2
    }

    fn ways_out(&self) -> Vec<(Cell, Direction)> {
        let cells = self.reachable().filter(|cell| !self.goals().contains(cell));
        let out_of = |cell| self.neighbours(cell).map(move |(way, _)| (cell, way));
        cells.flat_map(out_of).collect()
    }

    fn metres_to_goal(&self, from: Cell, pitch: f64) -> f64 {
        let steps = self.steps_to_goal()[self.grid().index(from)];
        f64::from(steps.unwrap_or(0)) * pitch
    }
}
