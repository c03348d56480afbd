use core::ops::ControlFlow;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use thiserror::Error;
use tolman_maps::cpm::{
    CpMap, CpmError, Junction, JunctionId, Location, MapDoubt, Plan, Port, Sign,
};
use tolman_robot::{
    Fitted, Goal, Guess, MapLink, MapPlace, MapView, Mapper, Position, RobotMeasures, Standing,
    System, Task, VisitNaming,
};

use super::common_patterns::CommonPatterns;
use super::config::CpmConfig;
use super::decision::{Aim, Done};
use super::explorer::Explorer;
use super::failure::{CpmFailure, CpmResult};
use super::layer3::{CpmObservation, Layer3};
use super::mode::Mode;
use super::relocalization::Relocalization;
use super::ring_as_epuck::{RingAsEpuck, RingMeasures};
use super::robot::CpmRobot;
use super::trail::Trail;
use super::walker::{RestingWalker, Walker};
use super::walker_config::WalkerConfig;
use super::whereabouts::Approach;
use crate::brain::NO_POINTS;
use crate::on_robot::{CORRIDOR_WIDTH, fitted, needed};
use crate::{ForRobotError, LaserRobot, OnRobot};

/// CPM as a system: it learns a map of any maze with any [`CpmRobot`], and goes to goals.
///
/// An action is one fragment, from one place to the next. It holds no robot between two actions. If
/// the robot is moved then, call [`carried`](Self::carried).
///
/// - [`Task::Explore`] ends when all ways on the map were walked.
/// - [`Task::Reach`] drives the shortest known way, skipping observations. If none is known, it
///   explores.
/// - [`Task::Localize`] finds the robot's place on its map.
#[derive(Clone, Debug)]
pub struct Cpm {
    walker: WalkerConfig,
    config: CpmConfig,
    /// Maps that the robot may be on; empty if the system learns its own.
    known: Vec<CpMap>,
    /// Index of the map that the robot is on.
    on: usize,
    /// Patterns that the system learned before its first map.
    patterns: CommonPatterns,
    novelty: Option<f64>,
    layer: Option<Layer3>,
    /// Walks on the present map.
    trail: Trail,
    standing: Stance,
    /// Number of maps that the system gave up because they were impossible.
    given_up: u32,
    /// Number of walks in a row after which the map was impossible.
    doubtful: u32,
    /// Number of walks since the map had no unknown port left.
    checked: u32,
    rng: ChaCha8Rng,
}

/// Knowledge of the robot's place in the world.
#[derive(Clone, Debug)]
enum Stance {
    /// None: the robot has just been switched on, or was carried.
    Anywhere,
    /// The robot is localizing.
    Searching(Box<(RestingWalker, Relocalization)>),
    /// The robot is at the place where its map has it.
    AtPlace(Box<RestingWalker>),
}

/// Number of places after which a lost robot stops localizing. It then continues from its likeliest
/// place.
const MOST_PLACES: u32 = 12;

/// Minimum distance of two places, in corridor widths.
const APART: f64 = 0.5;

/// Number of walks in a row that contradict a map before it is given up.
const MOST_DOUBTFUL: u32 = 50;

/// Error to which a robot controls a turn, rad.
const TURN_TOLERANCE: f64 = 0.01;

/// Maximum number of walks that check a map, as a multiple of its fragments.
const MOST_CHECKS: u32 = 3;

/// Number of maps that are given up before the robot gives up.
const MOST_MAPS: u32 = 2;

impl Cpm {
    /// Returns a robot without a map that knows these `patterns` from a learning maze (section
    /// 4.1). `seed` seeds all its random numbers.
    #[must_use]
    pub fn new(
        walker: WalkerConfig,
        patterns: CommonPatterns,
        config: CpmConfig,
        seed: u64,
    ) -> Self {
        Self {
            walker,
            config,
            known: Vec::new(),
            on: 0,
            patterns,
            novelty: None,
            layer: None,
            trail: Trail::default(),
            standing: Stance::Anywhere,
            given_up: 0,
            doubtful: 0,
            checked: 0,
            rng: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Returns a robot without observations. Observations far from all known patterns become
    /// patterns (section 8, "the CPs must be learned incrementally"). Dead reckoning takes its
    /// headings from the walls.
    ///
    /// # Errors
    /// [`CpmError::Dictionary`], which no configuration causes.
    pub fn unlearned(walker: WalkerConfig, config: CpmConfig, seed: u64) -> Result<Self, CpmError> {
        let mode = Mode::Unlearned(config);
        let walker = WalkerConfig {
            heading: mode.heading(),
            ..walker
        };
        Ok(Self {
            novelty: mode.novelty(),
            ..Self::new(walker, CommonPatterns::none()?, config, seed)
        })
    }

    /// Returns a system without observations on a robot of these measures. It learns its patterns
    /// on the way. All random numbers follow from `seed`.
    ///
    /// # Errors
    /// If the measures contradict each other, or there is no odometry.
    pub fn for_robot<R: LaserRobot>(
        measures: &RobotMeasures,
        robot: R,
        seed: u64,
    ) -> Result<OnRobot<RingAsEpuck<Fitted<R>>, Self>, ForRobotError> {
        needed(measures.odometry_error, "odometry_error")?;
        let robot = fitted(measures, robot, CORRIDOR_WIDTH)?;
        let (made_for, metre) = (robot.made_for(), robot.metre());
        let ring = RingMeasures {
            corridor_width: made_for.corridor_width,
            body_radius: 0.5 * measures.diameter / metre,
            turn_per_step: made_for.turn_per_step,
            translate_per_step: made_for.translate_per_step,
            step_us: made_for.step_us,
            turn_tolerance: TURN_TOLERANCE,
        };
        let system = Self::unlearned(ring.walker_config(), CpmConfig::robust(), seed)?;
        Ok(OnRobot::new(RingAsEpuck::new(robot, ring)?, system, metre))
    }

    /// Returns a robot at an unknown place of one of several maps in these `patterns`. It first
    /// finds the map and the place.
    ///
    /// # Errors
    /// [`CpmError`] if the first map has no place.
    pub fn with_maps(
        walker: WalkerConfig,
        patterns: CommonPatterns,
        config: CpmConfig,
        maps: Vec<CpMap>,
        seed: u64,
    ) -> Result<Self, CpmError> {
        let map = maps.first().cloned().unwrap_or_default();
        let somewhere = map.junctions().next().map_or(JunctionId(0), |(id, _)| id);
        let layer = Layer3::resume_at(patterns.clone(), config, map, somewhere.port(0))?;
        Ok(Self {
            layer: Some(layer),
            known: maps,
            ..Self::new(walker, patterns, config, seed)
        })
    }

    /// Takes in that the robot was carried elsewhere, so that it localizes first.
    pub fn carried(&mut self) {
        self.standing = Stance::Anywhere;
    }

    /// Returns the index of the map on which it believes it is.
    #[must_use]
    pub const fn on(&self) -> usize {
        self.on
    }

    /// Returns the system's explorer with the map; `None` before the first action.
    #[must_use]
    pub fn explorer(&self) -> Option<&Explorer> {
        self.layer.as_ref().map(|layer| &layer.explorer)
    }

    /// Returns the common patterns, including those learned on the way.
    #[must_use]
    pub fn patterns(&self) -> &CommonPatterns {
        let layer = self.layer.as_ref();
        layer.map_or(&self.patterns, |layer| &layer.patterns)
    }

    /// Lets the robot look round and begins the map there.
    fn begin<R: CpmRobot>(&mut self, robot: &mut R) -> CpmResult<Standing, R> {
        let mut walker = Walker::new(robot, self.walker.clone());
        let patterns = self.patterns.clone();
        let layer = Layer3::begin(&mut walker, patterns, self.novelty, self.config)?;
        self.trail.begin(layer.explorer.mapper.at());
        (self.doubtful, self.checked) = (0, 0);
        self.layer = Some(layer);
        self.standing = Stance::AtPlace(Box::new(walker.rest()));
        Ok(Standing::UnderWay)
    }

    /// Drives to the next place while it localizes.
    fn localize<R: CpmRobot>(&mut self, robot: &mut R) -> CpmResult<Standing, R> {
        let Some(layer) = &mut self.layer else {
            return Ok(Standing::gave_up("it has no map to find itself on"));
        };
        let standing = core::mem::replace(&mut self.standing, Stance::Anywhere);
        let (mut walker, mut search) = match standing {
            Stance::Searching(searching) => {
                let (resting, search) = *searching;
                (Walker::wake(robot, self.walker.clone(), resting), search)
            }
            Stance::Anywhere | Stance::AtPlace(_) => {
                let here = layer.map().clone();
                let mut maps = self.known.clone();
                // The map may have grown since.
                match maps.get_mut(self.on) {
                    Some(known) => *known = here,
                    None => maps = vec![here],
                }
                (
                    Walker::new(robot, self.walker.clone()),
                    Relocalization::new(&maps, &layer.patterns, Approach::ToAndFro, MOST_PLACES)?,
                )
            }
        };
        let flow = search.advance(&mut walker, &mut self.rng)?;
        let ways = walker.branches().len();
        let (walker, here) = (walker.rest(), search.found().here());
        match (flow, here) {
            (ControlFlow::Break(()), Some(here)) => {
                let is_sure = search.found().is_sure();
                let other = self.known.get(here.map).filter(|_| here.map != self.on);
                let map = other.unwrap_or(layer.map());
                let is_like = map.degree(here.ahead.junction) as usize == ways;
                match other {
                    None => layer.explorer.mapper.place(here.ahead)?,
                    Some(map) => {
                        let (patterns, map) = (self.patterns.clone(), map.clone());
                        *layer = Layer3::resume_at(patterns, self.config, map, here.ahead)?;
                        self.on = here.map;
                    }
                }
                self.standing = Stance::AtPlace(Box::new(walker));
                Ok(if is_sure && is_like {
                    Standing::Done
                } else {
                    self.standing = Stance::Anywhere;
                    Standing::gave_up(format!(
                        "it is not sure where it is after {MOST_PLACES} places"
                    ))
                })
            }
            _ => {
                self.standing = Stance::Searching(Box::new((walker, search)));
                Ok(Standing::UnderWay)
            }
        }
    }

    /// Walks one fragment towards an aim.
    fn pursue<R: CpmRobot>(
        &mut self,
        robot: &mut R,
        resting: RestingWalker,
        aim: Aim,
    ) -> CpmResult<Standing, R> {
        let Some(layer) = &mut self.layer else {
            return self.begin(robot);
        };
        let mut walker = Walker::wake(robot, self.walker.clone(), resting);
        if self.config.heeds_lifts && walker.was_moved()? {
            return Ok(self.moved());
        }
        let flow = layer.advance(&mut walker, aim, &mut self.rng)?;
        self.standing = Stance::AtPlace(Box::new(walker.rest()));
        let done = match flow {
            ControlFlow::Break(done) => done,
            ControlFlow::Continue(step) => {
                if let Some(arrival) = step.arrival {
                    let at = layer.explorer.mapper.at();
                    self.trail.walked(step.leg.turn, at, arrival);
                }
                return Ok(self.heed());
            }
        };
        layer.optimize()?;
        let walked = layer.explorer.mapper.traversals();
        let is_found = done == Done::Reached && !matches!(aim, Aim::Explore | Aim::Check);
        if let Some(doubt) = self.map_doubt().filter(|_| !is_found) {
            return Ok(self.begin_anew(doubt));
        }
        Ok(match done {
            Done::Reached => Standing::Done,
            Done::NotThere => {
                Standing::gave_up("it has been everywhere, and the landmark is not there")
            }
            Done::OutOfPatience => Standing::gave_up(format!(
                "it has walked {walked} fragments, as many as it may"
            )),
        })
    }

    /// Returns the aim of exploration. A finished map is checked with at most [`MOST_CHECKS`] times
    /// as many walks as it has fragments.
    fn exploration_aim(&mut self) -> Aim {
        let explorer = self.explorer().filter(|_| self.config.checks > 0);
        let Some(Explorer { mapper, .. }) = explorer else {
            return Aim::Explore;
        };
        let most = MOST_CHECKS * mapper.map().fragments().len() as u32;
        if self.checked >= most {
            return Aim::Explore;
        }
        let is_open = |place: &Junction| place.open_ports().next().is_some();
        let is_whole = !mapper.map().junctions().any(|(_, place)| is_open(place));
        // A doubtful map need not be checked.
        if is_whole && self.map_doubt().is_some() {
            return Aim::Explore;
        }
        self.checked += u32::from(is_whole);
        Aim::Check
    }

    /// Returns the reason to doubt its map, or `None` if it finds none.
    fn map_doubt(&self) -> Option<MapDoubt> {
        self.explorer()?.mapper.doubt(self.apart())
    }

    /// Returns the minimum distance of two places, m.
    fn apart(&self) -> f64 {
        APART * self.walker.corridor_width
    }

    /// Counts the walks in a row after which the map is impossible. After [`MOST_DOUBTFUL`] of them
    /// the robot begins another map, or gives up.
    fn heed(&mut self) -> Standing {
        let doubt = self.explorer().and_then(|Explorer { mapper, .. }| {
            mapper.map().twice_at(mapper.at().junction, self.apart())
        });
        let Some(doubt) = doubt else {
            self.doubtful = 0;
            return Standing::UnderWay;
        };
        self.doubtful += 1;
        match self.doubtful < MOST_DOUBTFUL {
            true => Standing::UnderWay,
            false => self.begin_anew(doubt),
        }
    }

    /// Drops an impossible map, and begins another at the robot's place. Gives up after
    /// [`MOST_MAPS`] of them, or on a given map.
    fn begin_anew(&mut self, doubt: MapDoubt) -> Standing {
        if self.given_up >= MOST_MAPS || !self.known.is_empty() {
            return Standing::gave_up(format!("its map is doubtful: {doubt}"));
        }
        self.given_up += 1;
        self.begin_elsewhere()
    }

    /// Takes in that the robot was moved during an exploration. It begins another map there, or
    /// localizes on the map that it was given.
    fn moved(&mut self) -> Standing {
        match self.known.is_empty() {
            true => self.begin_elsewhere(),
            false => Standing::UnderWay,
        }
    }

    /// Drops the map and begins another at the robot's place, with the patterns learned so far.
    fn begin_elsewhere(&mut self) -> Standing {
        if let Some(layer) = self.layer.take() {
            self.patterns = layer.patterns;
        }
        self.standing = Stance::Anywhere;
        Standing::UnderWay
    }

    /// Drives one fragment of a plan. If the robot arrives at another place than its map says, it
    /// is lost.
    fn drive<R: CpmRobot>(
        &mut self,
        robot: &mut R,
        resting: RestingWalker,
        plan: &Plan,
        goal: Goal,
    ) -> CpmResult<Standing, R> {
        let (Some(layer), Some(leg)) = (&mut self.layer, plan.legs.first()) else {
            self.standing = Stance::AtPlace(Box::new(resting));
            return Ok(Standing::Done);
        };
        let mut walker = Walker::wake(robot, self.walker.clone(), resting);
        if self.config.heeds_lifts && walker.was_moved()? {
            return Ok(Standing::UnderWay);
        }
        let sighting = Layer3::drive(&mut walker, leg)?;
        if layer.expected(leg) == Some(sighting) {
            layer.explorer.mapper.place(leg.arrive)?;
            self.standing = Stance::AtPlace(Box::new(walker.rest()));
        } else if sighting.landmark.map(Goal::Landmark) == Some(goal) {
            // It is not where it thought, but where it was sent.
            return Ok(Standing::Done);
        }
        Ok(Standing::UnderWay)
    }

    /// Returns the place with an unknown port by which the way to a goal may be shorter.
    fn detour(&self, goal: Goal) -> Option<JunctionId> {
        match goal {
            Goal::Landmark(landmark) => self.explorer()?.detour(landmark),
            Goal::Place(_) | Goal::Point(_) => None,
        }
    }

    /// Returns the shortest known way to a goal, or to a place from where it may be shorter; `None`
    /// if none is known.
    fn plan(&self, goal: Goal) -> Option<Plan> {
        let mapper = &self.explorer()?.mapper;
        match goal {
            Goal::Landmark(landmark) => match self.detour(goal) {
                Some(detour) => mapper.map().plan(mapper.at(), |id| id == detour),
                None => mapper.plan(landmark),
            },
            Goal::Place(place) => mapper.map().plan(mapper.at(), |id| id == JunctionId(place)),
            Goal::Point(_) => None,
        }
    }

    /// Drives on towards a goal from a place of the map.
    fn reach<R: CpmRobot>(
        &mut self,
        robot: &mut R,
        resting: RestingWalker,
        goal: Goal,
    ) -> CpmResult<Standing, R> {
        let here = self
            .explorer()
            .map(|explorer| explorer.mapper.at().junction);
        match (self.plan(goal), goal) {
            // An unknown port here may shorten the way.
            (_, Goal::Landmark(landmark)) if here.is_some() && self.detour(goal) == here => {
                self.pursue(robot, resting, Aim::Find(landmark))
            }
            (Some(plan), _) => self.drive(robot, resting, &plan, goal),
            (None, Goal::Landmark(landmark)) => self.pursue(robot, resting, Aim::Find(landmark)),
            (None, Goal::Place(place)) => {
                self.standing = Stance::AtPlace(Box::new(resting));
                Ok(Standing::gave_up(format!(
                    "it knows no way to place {place}"
                )))
            }
            (None, Goal::Point(_)) => {
                self.standing = Stance::AtPlace(Box::new(resting));
                Ok(Standing::gave_up(NO_POINTS))
            }
        }
    }
}

impl Mapper for Cpm {
    type Observation = CpmObservation;
    type Error = CpmObserveError;

    fn observe(&mut self, seen: &CpmObservation) -> Result<(), CpmObserveError> {
        match (seen, &mut self.layer) {
            (CpmObservation::Began(start), _) => {
                let explorer = Explorer::new(self.config, *start)?;
                let patterns = self.patterns.clone();
                self.trail.begin(explorer.mapper.at());
                self.layer = Some(Layer3 {
                    patterns,
                    novelty: self.novelty,
                    explorer,
                });
            }
            (CpmObservation::Walked(walked), Some(layer)) => {
                if let Some(arrival) = layer.take_in(walked)? {
                    let at = layer.explorer.mapper.at();
                    self.trail.walked(walked.turn, at, arrival);
                }
            }
            (CpmObservation::Walked(_), None) => return Err(CpmObserveError::NotBegun),
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        let layer = self.layer.as_ref();
        layer.map_or_else(MapView::default, |layer| view(layer.map()))
    }

    fn belief(&self) -> Vec<Guess> {
        let believed = match (&self.standing, self.explorer()) {
            (Stance::Searching(resting), _) => {
                let here: Option<Location> = resting.1.found().here();
                here.map(|here| (here.ahead, here.probability))
            }
            (Stance::AtPlace(_), Some(explorer)) => Some((explorer.mapper.at(), 1.0)),
            (Stance::Anywhere, _) | (_, None) => None,
        };
        let guess = |(at, weight): (Port, f64)| Guess {
            at: Position::Place(at.junction.0),
            weight,
        };
        believed.map(guess).into_iter().collect()
    }

    fn certainty(&self) -> Option<f64> {
        self.explorer()?.mapper.certainty(self.apart())
    }

    fn doubt(&self) -> Option<String> {
        let open = self.explorer()?.mapper.map().open_ports().count();
        (open > 0).then(|| format!("{open} of its ports are unexplored"))
    }

    fn map_bytes(&self) -> Option<usize> {
        self.layer.as_ref().map(|layer| layer.map().bytes())
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        let layer = self.layer.as_ref();
        layer.map_or_else(Vec::new, |layer| self.trail.places(layer.map()))
    }
}

/// Returns a map as places and links; a fragment leads both ways. O(map).
#[must_use]
pub fn view(map: &CpMap) -> MapView {
    let place = |(id, junction): (JunctionId, &Junction)| MapPlace {
        id: id.0,
        position: None,
        landmark: junction.landmark,
    };
    let links = map.fragments().flat_map(|(_, fragment)| {
        let [minus, plus] = Sign::BOTH.map(|sign| fragment.port(sign).junction.0);
        MapLink::both_ways(minus, plus)
    });
    MapView {
        places: map.junctions().map(place).collect(),
        links: links.collect(),
        ..MapView::default()
    }
}

impl<R: CpmRobot> System<R> for Cpm {
    type Failure = CpmFailure<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        let standing = core::mem::replace(&mut self.standing, Stance::Anywhere);
        match (standing, task) {
            (Stance::AtPlace(resting), Task::Localize) => {
                self.standing = Stance::AtPlace(resting);
                Ok(Standing::Done)
            }
            (Stance::AtPlace(resting), Task::Explore) => {
                let aim = self.exploration_aim();
                self.pursue(robot, *resting, aim)
            }
            (Stance::AtPlace(resting), Task::Reach(goal)) => self.reach(robot, *resting, goal),
            (lost, task) => {
                self.standing = lost;
                if self.layer.is_none() && task != Task::Localize {
                    return self.begin(robot);
                }
                match (self.localize(robot)?, task) {
                    (Standing::Done, Task::Explore | Task::Reach(_)) => Ok(Standing::UnderWay),
                    (standing, _) => Ok(standing),
                }
            }
        }
    }

    fn put_down(&mut self) -> Standing {
        self.carried();
        Standing::UnderWay
    }

    fn words(&self) -> String {
        match &self.standing {
            Stance::Searching(_) => "lost".to_owned(),
            Stance::Anywhere | Stance::AtPlace(_) => String::new(),
        }
    }
}

/// Reason why CPM refuses an observation.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CpmObserveError {
    /// No map was begun.
    #[error("the walk has no beginning: observe `CpmObservation::Began` first")]
    NotBegun,
    /// The map refuses an input.
    #[error(transparent)]
    Map(#[from] CpmError),
}
