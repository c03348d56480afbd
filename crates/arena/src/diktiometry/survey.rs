//! Runs of a diktiometer in an office, with the truth beside.

use alloc::sync::Arc;

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::diktiometry::{Apart, Config, MoveOutcome, Observer, PlaceId, WorldKind};
use tolman_maze::Direction;
use tolman_robot::{Standing, Task};
use tolman_sim::DoorState;
use tolman_systems::diktiometry::{
    Diktiometer, ExploreUntil, MappedMove, aligned_signatures, exit_signatures,
};
use tolman_systems::stream;

use super::{
    MapScore, Memory, MoveError, Office, OfficeRobot, PlaceCue, Places, SurveyorConfig, Visit,
    leads, no_way, office_robot, score,
};
use crate::course::pick;
use crate::registry::because;
use crate::run::{InRun, until_done};
use crate::{BoxError, Outing, Sent};

/// All settings of a run except the office and the seed.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct SurveyConfig {
    /// The robot and its noise.
    pub robot: SurveyorConfig,
    /// Configuration of the mapper.
    pub mapper: Config,
    /// Exploration probability: how often an applicable script is begun, 0 to 1. Paper: "generally
    /// 30% of the time".
    pub heed: f64,
    /// Number of moves.
    pub moves: u32,
    /// Number of moves after which one random doorway of the office is shut or opened; 0 for never.
    pub door_period: u32,
}

impl SurveyConfig {
    /// Returns a run of the paper in an office: random walk, no advice, no doorway that changes.
    #[must_use]
    pub fn paper(office: &Office, moves: u32) -> Self {
        Self::of(office, SurveyorConfig::paper(), moves)
    }

    /// Returns these settings with another robot.
    #[must_use]
    pub fn of(office: &Office, robot: SurveyorConfig, moves: u32) -> Self {
        Self {
            mapper: mapper(office, &robot),
            robot,
            heed: 0.0,
            moves,
            door_period: 0,
        }
    }
}

/// Returns the mapper for a robot in an office, with all that the designers know of both.
#[must_use]
pub fn mapper(office: &Office, robot: &SurveyorConfig) -> Config {
    let separation = office.separation();
    let mut config = Config::new(Config::corridor_actions(), separation);
    // The map is in metres of the odometry.
    config.shared_scale = robot.shared_share;
    config.place_radius = robot.place_radius * (1.0 + robot.shared_share);
    // Corridors follow the axes of the compass, a pitch apart, and walls never move.
    config.apart = Apart::Side;
    config.world = WorldKind::Static;
    match robot.sight {
        PlaceCue::Camera { columns, .. } if office.config().colours > 1 => {
            // A doorway has other exits than the corners beside it, and those are a pitch apart or
            // more.
            config.alike_separation = separation.max(office.config().pitch());
            config.search.width = 4.0 * config.alike_separation;
            config.percepts = aligned_signatures(3, columns as usize);
        }
        // Where all walls have one colour a camera tells nothing.
        PlaceCue::Camera { .. } => {}
        PlaceCue::Laser { columns } => config.percepts = aligned_signatures(1, columns as usize),
        PlaceCue::Exits => config.percepts = exit_signatures(),
    }
    config
}

/// A diktiometer that explores an office, with the truth of all its moves.
#[derive(Debug)]
pub struct Survey {
    outing: Sent<OfficeRobot, Diktiometer<PlaceCue>>,
    office: Arc<Office>,
    config: SurveyConfig,
    doors: ChaCha8Rng,
    shut: Vec<usize>,
    /// True places and ways now.
    truth: Places,
    /// Sites where the robot was, from the start on.
    sites: Vec<u32>,
    /// True ways that the robot went: each by its site and direction.
    gone: Vec<(u32, Direction)>,
    errors: Vec<MoveError>,
    memory: Memory,
}

/// Result of a plan to a place of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlanTrial {
    /// The place is not there now (a doorway that is shut, a junction whose branch is): no plan
    /// leads to it.
    Gone,
    /// The place is there.
    There {
        /// Whether the plan would lead to the place.
        works: bool,
        /// Whether a plan by perfect memory of the ways would lead there: each way as the robot
        /// last saw it, no places confused.
        remembered_works: bool,
    },
}

impl Survey {
    /// Sends a diktiometer without a map from a random place of an office through all its moves, at
    /// least one. `watch` sees the run after each.
    ///
    /// # Errors
    /// If the robot cannot be made or go on, and the error of `watch`.
    pub fn run(
        office: &Arc<Office>,
        config: SurveyConfig,
        seed: u64,
        mut watch: impl FnMut(&Self, &MappedMove) -> Result<(), BoxError>,
    ) -> Result<Self, BoxError> {
        let start = office.random_place(seed)?;
        let mut paper = office.diktiometer(&config.robot, config.mapper.clone());
        (paper.heed, paper.until) = (config.heed, ExploreUntil::Never);
        let system = Diktiometer::new(paper, config.robot.sight, seed);
        let pose = Pose::new(start.position, Heading::NORTH);
        let robot = office_robot(office, &config.robot, pose, seed)?;
        let mut survey = Self {
            outing: Sent::new(office.course.clone(), robot, u32::MAX, system),
            office: Arc::clone(office),
            doors: stream(seed, 2),
            shut: Vec::new(),
            truth: office.places(&[]),
            sites: vec![start.site],
            gone: Vec::new(),
            errors: Vec::new(),
            memory: Memory::default(),
            config,
        };
        survey.memory.see(&start);
        until_done(&mut survey, |survey| {
            survey.step()?;
            if let Some(moved) = survey.outing.system().last_move() {
                watch(survey, moved)?;
            }
            Ok::<_, BoxError>(match survey.moves() < survey.config.moves {
                true => Standing::UnderWay,
                false => Standing::Done,
            })
        })?;
        Ok(survey)
    }

    /// Makes one move.
    fn step(&mut self) -> Result<(), BoxError> {
        let (before, from) = (self.position(), self.site());
        let acted = match self.move_a_door() {
            Ok(()) => self.outing.act(Task::Explore),
            Err(error) => Err(error),
        };
        let at = self.position();
        let broke_off = || format!("the survey broke off at ({}, {}) m", at.x, at.y);
        let standing = acted.map_err(|error| because(broke_off(), error))?;
        let (Standing::UnderWay, Some(moved)) = (standing, self.outing.system().last_move()) else {
            return Err(no_way(at));
        };
        let here = self.office.place_at(&self.truth, at)?;
        if moved.arrival.outcome == MoveOutcome::Arrived {
            let truly = at - before;
            let way = truly.norm();
            self.memory.go(from, moved.direction, here.site, way);
            self.gone.push((from, moved.direction));
            let error = MoveError::of(&moved.report, moved.arrival.moved, truly);
            self.errors.push(error);
        }
        self.memory.see(&here);
        self.sites.push(here.site);
        Ok(())
    }

    /// Shuts or opens a doorway if one is due, but none near the robot.
    fn move_a_door(&mut self) -> Result<(), BoxError> {
        let (moves, period) = (self.gone.len(), self.config.door_period as usize);
        let doorways = self.office.doorways();
        if moves == 0 || doorways == 0 || !moves.is_multiple_of(period) {
            return Ok(());
        }
        let number = self.doors.random_range(0..doorways as u32) as usize;
        if (self.office.doorway(number) - self.position()).norm() < 3.0 {
            return Ok(());
        }
        let state = match self.shut.iter().position(|shut| *shut == number) {
            Some(at) => {
                self.shut.remove(at);
                DoorState::Open
            }
            None => {
                self.shut.push(number);
                DoorState::Shut
            }
        };
        for leaf in Office::leaves(number) {
            self.outing.set_door(&leaf, state)?;
        }
        self.truth = self.office.places(&self.shut);
        Ok(())
    }

    fn position(&self) -> Point {
        let last = self.path().last();
        last.map_or_else(Point::origin, |pose| pose.position)
    }

    /// Returns the office of the survey.
    #[must_use]
    pub const fn office(&self) -> &Arc<Office> {
        &self.office
    }

    /// Returns the true pose of the robot after every time step.
    #[must_use]
    pub fn path(&self) -> &[Pose] {
        self.outing.path()
    }

    /// Returns the observer with its map.
    #[must_use]
    pub fn observer(&self) -> Option<&Observer> {
        self.outing.system().observer()
    }

    /// Returns the number of moves so far.
    #[must_use]
    pub fn moves(&self) -> u32 {
        self.sites.len() as u32 - 1
    }

    /// Returns the true places where the robot was, from the start on, by their sites.
    #[must_use]
    pub fn sites(&self) -> &[u32] {
        &self.sites
    }

    /// Returns the true place where the robot is, by its site.
    fn site(&self) -> u32 {
        self.sites[self.sites.len() - 1]
    }

    /// Returns the true places of the robot with those of the map, from the start on.
    fn visits(&self) -> Vec<Visit> {
        Visit::all(self.outing.system(), &self.sites)
    }

    /// Returns the errors of all moves so far.
    #[must_use]
    pub fn errors(&self) -> &[MoveError] {
        &self.errors
    }

    /// Returns whether a plan from here to a random place of the map would lead there. Its actions
    /// are followed on the true ways, without moving the robot. A place without a plan counts as
    /// not reached. `None` if the map has no other place, or the robot was never at the drawn one.
    pub fn try_plan(&self, rng: &mut impl Rng) -> Option<PlanTrial> {
        let observer = self.observer()?;
        let paths = &observer.map().paths;
        let here = observer.place();
        let others = paths.places().map(|(id, _)| id);
        let others: Vec<PlaceId> = others.filter(|id| *id != here).collect();
        let to = pick(&others, rng)?;
        let is_to = |visit: &&Visit| paths.resolve(visit.place) == Some(to);
        let wanted = self.visits().iter().rev().find(is_to)?.site;
        if !self.truth.contains_key(&wanted) {
            return Some(PlanTrial::Gone);
        }
        let end = |plan: Vec<Direction>| {
            let mut directions = plan.into_iter();
            directions.try_fold(self.site(), |site, way| leads(&self.truth, (site, way)))
        };
        let plan = observer.plan(here, to);
        let plan = plan.and_then(|plan| {
            let steps = plan.iter();
            let directions = steps.map(|step| Direction::ALL.get(step.action.0 as usize).copied());
            directions.collect()
        });
        let remembered = self.memory.plan(self.site(), wanted);
        Some(PlanTrial::There {
            works: plan.and_then(end) == Some(wanted),
            remembered_works: remembered.and_then(end) == Some(wanted),
        })
    }

    /// Returns the share of remembered ways that still lead where they did when the robot last saw
    /// them. It is the baseline for a map of this run: a memory that guesses no changes.
    #[must_use]
    pub fn remembered_precision(&self) -> f64 {
        self.memory.precision(&self.truth)
    }

    /// Returns the score of the map as it is now.
    #[must_use]
    pub fn score(&self) -> MapScore {
        score(self.observer(), &self.visits(), &self.gone, &self.truth)
    }
}

impl InRun for Survey {
    fn steps(&self) -> u32 {
        self.outing.steps()
    }

    fn is_out_of_time(&self) -> bool {
        self.outing.is_out_of_time()
    }
}
