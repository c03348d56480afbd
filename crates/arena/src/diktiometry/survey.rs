//! Runs one survey: a robot walks an office, its observer maps it, and the truth is kept beside.

use alloc::sync::Arc;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_geom::{Point, PointBox, Vector};
use tolman_maps::diktiometry::{
    Apart, Config, MoveOutcome, Observer, PlaceId, StepReport, WorldKind,
};
use tolman_maze::Direction;
use tolman_sim::robots::CameraPioneerError;
use tolman_sim::{Bounds, DoorError, DoorState, PlaceError, StepError};
use tolman_systems::diktiometry::{
    Arrival, MapError, MappedMove, PlannedMove, Planner, RoutineConfigError, RoutineError,
    RoverMap, aligned_signatures, exit_signatures,
};

use super::{
    MapScore, Memory, MoveError, Office, OfficeRobot, OfficeSurveyor, PlaceCue, Places,
    SurveyorConfig, Visit, leads, office_robot::set_doorway, score, surveyor,
};
use tolman_systems::stream;

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

/// Truth of a run so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Past {
    /// True start of the robot, m.
    pub start: Point,
    /// True position of the robot, m.
    pub at: Point,
    /// True places where the robot was, each with the map's place at the time, from the start on.
    pub visits: Vec<Visit>,
    /// True ways that the robot went: each by its site and direction.
    pub gone: Vec<(u32, Direction)>,
}

/// A run under way, or ended.
#[derive(Debug)]
pub struct Survey {
    office: Arc<Office>,
    config: SurveyConfig,
    rover: OfficeSurveyor,
    mapping: RoverMap,
    planner: Planner,
    walk: ChaCha8Rng,
    doors: ChaCha8Rng,
    plans: ChaCha8Rng,
    shut: Vec<usize>,
    /// True places and ways now.
    truth: Places,
    site: u32,
    past: Past,
    errors: Vec<MoveError>,
    memory: Memory,
}

/// A place of a learned map where it is drawn over the world.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceMark {
    /// Id of the place on the map.
    pub id: u32,
    /// Box that holds the place for certain, as seen from the start, m.
    pub bounds: Bounds,
    /// Label in words.
    pub label: String,
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

/// Result of one move.
#[derive(Debug)]
pub struct SurveyedMove {
    /// Decision of the planner.
    pub decision: PlannedMove,
    /// Measurements of the robot.
    pub arrival: Arrival,
    /// The observer's report.
    pub report: StepReport,
}

/// Reason why a run cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
    /// The configuration is out of its bounds.
    #[error(transparent)]
    Config(#[from] RoutineConfigError),
    /// The robot cannot be built.
    #[error("the robot cannot be built; correct its configuration")]
    Robot(#[from] CameraPioneerError),
    /// The robot cannot stand where it is put.
    #[error("the robot cannot stand there; choose another start")]
    Place(#[from] PlaceError),
    /// The world has no such door.
    #[error("the door cannot be moved; name a door of the world")]
    Door(#[from] DoorError),
    /// Robot or observer cannot begin.
    #[error(transparent)]
    Map(#[from] MapError<RoutineError<StepError>>),
    /// Robot or observer cannot go on.
    #[error("the survey broke off at ({}, {}) m", at.x, at.y)]
    BrokeOff {
        /// Position of the robot.
        at: Point,
        /// Reason why the robot or the observer cannot continue.
        source: MapError<RoutineError<StepError>>,
    },
    /// The robot is at no place.
    #[error("the robot is at ({}, {}) m, which is not a place; lower the noise", at.x, at.y)]
    OffPlace {
        /// Position of the robot.
        at: Point,
    },
    /// No way leads on.
    #[error("no way leads on from ({}, {}) m; open a wall there", at.x, at.y)]
    NoWay {
        /// Position of the robot.
        at: Point,
    },
}

impl Survey {
    /// Returns a robot at a random place of an office, with a map of that place alone.
    ///
    /// # Errors
    /// [`RunError`] if robot or observer cannot be made.
    pub fn new(office: &Arc<Office>, config: SurveyConfig, seed: u64) -> Result<Self, RunError> {
        let truth = office.places(&[]);
        let first = stream(seed, 0).random_range(0..truth.len().max(1) as u32) as usize;
        let start = truth.values().nth(first).copied();
        let start = start.ok_or(RunError::NoWay {
            at: Point::origin(),
        })?;
        let mut rover = surveyor(office, &config.robot, start.position, seed)?;
        let mapping = RoverMap::begin(&mut rover, config.mapper.clone())?;
        let past = Past {
            start: start.position,
            at: start.position,
            visits: vec![Visit {
                site: start.site,
                place: mapping.observer().place(),
            }],
            gone: Vec::new(),
        };
        Self::after(past, office, config, rover, mapping, seed)
    }

    /// Returns a run that continues where another ended. `seed` seeds all random numbers from now
    /// on; doorways are open.
    ///
    /// # Errors
    /// [`RunError`] if the robot cannot stand where the other ended, or no place is there.
    pub fn resumed(
        office: &Arc<Office>,
        config: SurveyConfig,
        past: Past,
        observer: Observer,
        seed: u64,
    ) -> Result<Self, RunError> {
        let mut rover = surveyor(office, &config.robot, past.at, seed)?;
        let mapping = RoverMap::resume(&mut rover, observer)?;
        Self::after(past, office, config, rover, mapping, seed)
    }

    /// Returns the run that continues from the truth `past`.
    fn after(
        past: Past,
        office: &Arc<Office>,
        config: SurveyConfig,
        rover: OfficeSurveyor,
        mapping: RoverMap,
        seed: u64,
    ) -> Result<Self, RunError> {
        let mut survey = Self {
            office: Arc::clone(office),
            planner: Planner::new(config.heed),
            rover,
            mapping,
            walk: stream(seed, 1),
            doors: stream(seed, 2),
            plans: stream(seed, 3),
            shut: Vec::new(),
            truth: office.places(&[]),
            site: 0,
            past,
            errors: Vec::new(),
            memory: Memory::default(),
            config,
        };
        survey.site = survey.true_site(survey.past.at)?;
        survey.memory.see(survey.site, survey.mapping.exits());
        Ok(survey)
    }

    /// Makes all moves.
    ///
    /// # Errors
    /// [`RunError`] if robot or observer cannot go on.
    pub fn finish(mut self) -> Result<Self, RunError> {
        for _ in 0..self.config.moves {
            self.step()?;
        }
        Ok(self)
    }

    /// Makes one move.
    ///
    /// # Errors
    /// [`RunError`] if robot or observer cannot go on.
    pub fn step(&mut self) -> Result<SurveyedMove, RunError> {
        self.move_a_door()?;
        let (observer, exits) = (self.mapping.observer(), self.mapping.exits());
        let decision = self.planner.choose(observer, exits, &mut self.walk);
        let at = self.position();
        self.go(decision.ok_or(RunError::NoWay { at })?)
    }

    fn go(&mut self, decision: PlannedMove) -> Result<SurveyedMove, RunError> {
        let before = self.position();
        let gone = self.mapping.go(&mut self.rover, decision.direction);
        let here = self.position();
        let MappedMove { arrival, report } =
            gone.map_err(|source| RunError::BrokeOff { at: here, source })?;
        let from = self.site;
        self.site = self.true_site(here)?;
        if arrival.outcome == MoveOutcome::Arrived {
            let way = (here - before).norm();
            self.memory.go(from, decision.direction, self.site, way);
            self.past.gone.push((from, decision.direction));
            let error = MoveError::of(&report, arrival.moved, here - before);
            self.errors.push(error);
        }
        self.memory.see(self.site, self.mapping.exits());
        let place = self.observer().place();
        let site = self.site;
        self.past.visits.push(Visit { site, place });
        Ok(SurveyedMove {
            decision,
            arrival,
            report,
        })
    }

    /// Shuts or opens a doorway if one is due, but none near the robot.
    fn move_a_door(&mut self) -> Result<(), RunError> {
        let (moves, period) = (self.past.gone.len(), self.config.door_period as usize);
        let doorways = self.office.doorways();
        if moves == 0 || doorways == 0 || !moves.is_multiple_of(period) {
            return Ok(());
        }
        let number = self.doors.random_range(0..doorways as u32) as usize;
        if (self.office.doorway(number) - self.position()).norm() < 3.0 {
            return Ok(());
        }
        let robot = self.rover.robot_mut();
        if let Some(at) = self.shut.iter().position(|shut| *shut == number) {
            set_doorway(robot, number, DoorState::Open)?;
            self.shut.remove(at);
        } else {
            set_doorway(robot, number, DoorState::Shut)?;
            self.shut.push(number);
        }
        self.truth = self.office.places(&self.shut);
        Ok(())
    }

    fn position(&self) -> Point {
        self.robot().truth().pose.position
    }

    /// Returns the site of the robot's true place.
    fn true_site(&self, here: Point) -> Result<u32, RunError> {
        let places = self.truth.values();
        let distances = places.map(|place| ((place.position - here).norm(), place.site));
        match distances.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((distance, site)) if distance < 0.5 * self.office.separation() => Ok(site),
            _ => Err(RunError::OffPlace { at: here }),
        }
    }

    /// Returns the office of the survey.
    #[must_use]
    pub const fn office(&self) -> &Arc<Office> {
        &self.office
    }

    /// Returns the settings of the survey.
    #[must_use]
    pub const fn config(&self) -> &SurveyConfig {
        &self.config
    }

    /// Returns the truth so far.
    #[must_use]
    pub fn past(&self) -> Past {
        Past {
            at: self.position(),
            ..self.past.clone()
        }
    }

    /// Returns the observer with its map.
    #[must_use]
    pub const fn observer(&self) -> &Observer {
        self.mapping.observer()
    }

    /// Returns the robot.
    #[must_use]
    pub const fn robot(&self) -> &OfficeRobot {
        self.rover.robot()
    }

    /// Returns the doorways that are shut now.
    #[must_use]
    pub fn shut(&self) -> &[usize] {
        &self.shut
    }

    /// Returns the true places of the robot with those of the map, from the start on.
    #[must_use]
    pub fn visits(&self) -> &[Visit] {
        &self.past.visits
    }

    /// Returns the errors of all moves so far.
    #[must_use]
    pub fn errors(&self) -> &[MoveError] {
        &self.errors
    }

    /// Returns whether a plan from here to a random place of the map would lead there. Its actions
    /// are followed on the true ways, without moving the robot. A place without a plan counts as
    /// not reached. `None` if the map has no other place, or the robot was never at the drawn one.
    pub fn try_plan(&mut self) -> Option<PlanTrial> {
        let paths = &self.mapping.observer().map().paths;
        let here = self.observer().place();
        let others = paths.places().map(|(id, _)| id);
        let others: Vec<PlaceId> = others.filter(|id| *id != here).collect();
        if others.is_empty() {
            return None;
        }
        let to = others[self.plans.random_range(0..others.len() as u32) as usize];
        let is_to = |visit: &&Visit| paths.resolve(visit.place) == Some(to);
        let wanted = self.visits().iter().rev().find(is_to)?.site;
        if !self.truth.contains_key(&wanted) {
            return Some(PlanTrial::Gone);
        }
        let end = |plan: Vec<Direction>| {
            let mut directions = plan.into_iter();
            directions.try_fold(self.site, |site, way| leads(&self.truth, (site, way)))
        };
        let plan = self.observer().plan(here, to);
        let plan = plan.and_then(|plan| {
            let steps = plan.iter();
            let directions = steps.map(|step| Direction::ALL.get(step.action.0 as usize).copied());
            directions.collect()
        });
        let remembered = self.memory.plan(self.site, wanted);
        Some(PlanTrial::There {
            works: plan.and_then(end) == Some(wanted),
            remembered_works: remembered.and_then(end) == Some(wanted),
        })
    }

    /// Returns the share of remembered ways that still lead where they did when the robot last saw
    /// them. It is the baseline for a map of this run: a memory that guesses no changes. A resumed
    /// run remembers only what it saw since it was resumed, because [`Past`] does not hold earlier
    /// ways.
    #[must_use]
    pub fn remembered_precision(&self) -> f64 {
        self.memory.precision(&self.truth)
    }

    /// Returns the places of the map, moved so that the first lies where the run truly began.
    #[must_use]
    pub fn drawn(&self) -> Vec<PlaceMark> {
        let map = self.observer().map();
        let Some(home) = self.visits().first().map(|visit| visit.place) else {
            return Vec::new();
        };
        let places = map.layout(home).into_iter().map(|drawn| {
            let PointBox { x, y } = drawn.bounds;
            let corner = |x: f64, y: f64| self.past.start + Vector::new(x, y);
            let visits = map.paths.place(drawn.place).map_or(0, |place| place.visits);
            PlaceMark {
                id: drawn.place.0,
                bounds: Bounds {
                    min: corner(x.low(), y.low()),
                    max: corner(x.high(), y.high()),
                },
                label: format!("place {}, {visits} visits", drawn.place.0),
            }
        });
        places.collect()
    }

    /// Returns the links of the map, by the ids of the places at their ends.
    #[must_use]
    pub fn links(&self) -> Vec<(u32, u32)> {
        let links = self.observer().map().paths.links();
        links.map(|(_, link)| (link.from.0, link.to.0)).collect()
    }

    /// Returns the score of the map as it is now.
    #[must_use]
    pub fn score(&self) -> MapScore {
        let paths = &self.observer().map().paths;
        score(paths, self.visits(), &self.past.gone, &self.truth)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::super::{OfficeConfig, blocks};
    use super::*;

    fn office(side: u16, doorway_share: f64, colours: u32) -> Arc<Office> {
        let maze = blocks(side, 0.3, &mut ChaCha8Rng::seed_from_u64(1));
        let config = OfficeConfig {
            doorway_share,
            colours,
            ..OfficeConfig::bare()
        };
        Arc::new(Office::new(&maze, &config).unwrap())
    }

    #[test]
    fn what_is_certain_is_never_confused_where_all_places_look_alike() {
        let office = office(4, 0.0, 1);
        let config = SurveyConfig {
            heed: 0.3,
            ..SurveyConfig::paper(&office, 150)
        };
        for seed in 0..3 {
            let run = Survey::new(&office, config.clone(), seed).unwrap();
            let run = run.finish().unwrap();
            let score = run.score();
            assert!((score.purity - 1.0).abs() < 1e-12, "{score:?}");
            assert!((score.link_precision - 1.0).abs() < 1e-12, "{score:?}");
            assert!((score.gone_recall - 1.0).abs() < 1e-12, "{score:?}");
            assert!(2 * score.places < run.visits().len(), "{score:?}");
        }
    }

    /// Without this knowledge the walk ends with many places for each true one.
    #[test]
    fn straight_corridors_and_walls_that_stay_fold_a_map_in_which_all_places_look_alike() {
        let maze = blocks(5, 0.25, &mut stream(1002, 20));
        let office = Arc::new(Office::new(&maze, &OfficeConfig::bare()).unwrap());
        let mut config = SurveyConfig::paper(&office, 700);
        config.heed = 0.3;
        let run = Survey::new(&office, config.clone(), 1002).unwrap();
        let score = run.finish().unwrap().score();
        assert!(score.is_isomorphic, "{score:?}");
        config.mapper.actions = Config::compass_actions();
        config.mapper.apart = Apart::Distance;
        config.mapper.world = WorldKind::Changing;
        let run = Survey::new(&office, config, 1002).unwrap();
        let score = run.finish().unwrap().score();
        assert!(score.places > 3 * score.visited, "{score:?}");
    }

    #[test]
    fn places_may_be_far_apart_and_walls_painted() {
        let file = tolman_maze::read(include_str!("../../mazes/j-long.maze")).unwrap();
        let furniture = OfficeConfig {
            colours: 6,
            ..OfficeConfig::bare()
        };
        let office = Arc::new(Office::new(&file.maze, &furniture).unwrap());
        let config = SurveyConfig::paper(&office, 30);
        let run = Survey::new(&office, config, 1).unwrap().finish().unwrap();
        let score = run.score();
        assert_eq!((score.places, score.visited), (5, 5), "{score:?}");
    }

    #[test]
    fn the_same_seed_makes_the_same_run_and_the_moves_of_doors_are_part_of_it() {
        let office = office(4, 0.5, 6);
        let mut config = SurveyConfig::paper(&office, 120);
        config.door_period = 10;
        let run = |seed| {
            Survey::new(&office, config.clone(), seed)
                .unwrap()
                .finish()
                .unwrap()
        };
        let (one, again, other) = (run(1), run(1), run(2));
        assert!(!one.shut().is_empty(), "some doorway is shut by now");
        assert_eq!(one.visits(), again.visits());
        assert_eq!(one.observer(), again.observer());
        assert_ne!(one.visits(), other.visits());
    }
}
