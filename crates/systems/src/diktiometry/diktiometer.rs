use core::error::Error;

use thiserror::Error as ThisError;
use tolman_geom::OutOfRange;
use tolman_maps::diktiometry::{
    Apart, Config, JournalLength, ObservedMove, ObservedMoveError, Observer, PlaceBelief, PlaceId,
    StartError, WorldKind,
};
use tolman_robot::{
    Compass, Fitted, Guess, Landmark, MapView, Mapper, Position, Ranges, RobotMeasures, Rolls,
    SensesLandmarks, Standing, System, Task, TurnTranslate, VisitNaming,
};

use super::{
    Eye, Guide, LandmarkSpot, LaserEye, MapError, MappedMove, RouteFinder, Routine, RoutineConfig,
    RoutineError, Rover, Surveyor, aligned_signatures, sought,
};
use crate::on_robot::{fitted, needed};
use crate::{ForRobotError, LaserRobot, OnRobot};

/// The diktiometry as a system: it drives a robot from place to place, maps what it finds and goes
/// to goals.
///
/// Each action is one control routine, from a place to the next. Its tasks:
///
/// - **Explore**: a random walk that heeds the map's advice. By [`ExploreUntil::Whole`] it ends
///   when nothing is left to try at any place that can be reached on the map. Moreover, no two
///   places may be one, and the map must not contradict itself. It gives up a map that has
///   contradicted itself for 20 moves. It also gives up a map that was not folded for five
///   moves per place, at most 300 moves, and at once a map that grows without end. If the robot
///   was carried elsewhere, so that the view differs from that at its last stop, it begins
///   another map there. By the paper's rule of matching, or on a map that it was given, it
///   gives up.
/// - **Reach** a place: the map's plan, made again after every routine. It gives up if the map
///   knows no way.
/// - **Reach** a landmark: the plan to the nearest spot where it was sensed, at a place or on the
///   way between two; on the way, the robot stops there. Until it was sensed, the robot explores.
/// - **Localize**: the planner's walk, until one hypothesis is confident and no other is. With an
///   earlier map it first makes as many moves as the mapper's `tracks.history`, on which confidence
///   rests.
///
/// Once it was [put down](Self::put_down) anywhere on its map, it never changes the map:
///
/// - **Localize**: it keeps a [`PlaceBelief`] and makes the moves that tell the likeliest places
///   apart. It ends when one place has 90 % of the belief, or the map tells no more of them apart.
/// - **Reach** a place or a landmark: it localizes and follows the shortest way on the map. If that
///   leads elsewhere than on the map, it localizes again. A way that differed from the map is
///   avoided as long as there are others. At a landmark on the way between two places it stops. It
///   gives up if the map does not have the landmark, or if its moves do not fit the map for long.
/// - **Explore**: it gives up.
///
/// A robot that starts in mid-corridor goes to a place before it maps. A routine that broke off
/// goes on at the next action, or turns back to where it began if that is nearer to the goal. With
/// an earlier map it continues as if the robot stood where the map has it. If the robot was carried
/// elsewhere, places may be made twice.
///
/// `E` is the eye by which it tells places apart; the mapper's percepts have to fit it.
#[derive(Clone, Debug)]
pub struct Diktiometer<E> {
    config: DiktiometerConfig,
    eye: E,
    guide: Guide,
    /// Finder of the way since the robot was put down; `None` before.
    finder: Option<RouteFinder>,
    /// Routine that broke off between two places.
    broken_off: Option<Routine>,
    seed: u64,
}

/// When a [`Diktiometer`] has explored enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExploreUntil {
    /// When its map is whole. The robot may begin anywhere and be carried elsewhere, and gives up a
    /// doubtful map.
    Whole,
    /// After this many moves, on its own map or on one that it was given. The robot begins at a
    /// place, and nobody carries it. It gives up a map that grows without end.
    Moves(u32),
    /// Never, as the paper's robot, whatever becomes of its map. The caller ends the run.
    /// It begins at a place, and nobody carries it.
    Never,
}

/// Parts of a [`Diktiometer`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DiktiometerConfig {
    /// Corridors and robot.
    pub routines: RoutineConfig,
    /// The mapper; its actions are the four directions.
    pub mapper: Config,
    /// Probability that a script is begun when one is applicable, 0 … 1. Paper: "generally 30% of
    /// the time".
    pub heed: f64,
    /// When it has explored enough.
    pub until: ExploreUntil,
}

impl DiktiometerConfig {
    /// Returns a configuration that follows advice in 30 % of the cases, as in the paper, until the
    /// map is whole.
    #[must_use]
    pub const fn paper(routines: RoutineConfig, mapper: Config) -> Self {
        Self {
            routines,
            mapper,
            heed: 0.3,
            until: ExploreUntil::Whole,
        }
    }
}

/// Width of the corridors of its office, m.
const CORRIDOR_WIDTH: f64 = 1.2;

/// Largest distance from the middle of a place at which a routine stops there, m.
const PLACE_RADIUS: f64 = 0.1;

/// Number of columns to which the beams of a laser are averaged.
const COLUMNS: u32 = 24;

/// Reason why a [`Diktiometer`] cannot go on.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum DiktiometerError<E: Error + 'static> {
    /// The routines' configuration is out of its bounds.
    #[error(transparent)]
    Config(#[from] OutOfRange),
    /// Robot or observer cannot go on.
    #[error(transparent)]
    Map(#[from] MapError<RoutineError<E>>),
}

/// Reason why a [`Diktiometer`] refuses a move of a log.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum RefusedMove {
    /// There is no map yet, and none can begin with an unknown place.
    #[error("begin with an observer of the log's first place")]
    Start(#[from] StartError),
    /// The observer refuses the move.
    #[error(transparent)]
    Step(#[from] ObservedMoveError),
}

impl Diktiometer<LaserEye> {
    /// Returns a system without a map on a robot of these measures, whose corridors all have the
    /// same width and distance. It keeps a journal of all its moves, and merges places by their
    /// looks and by turns, too; `paper` leaves both out.
    ///
    /// # Errors
    /// If the measures contradict each other, or there is no compass, no odometry or no
    /// `corridor_spacing`.
    pub fn for_robot<R: LaserRobot>(
        measures: &RobotMeasures,
        robot: R,
        paper: bool,
        seed: u64,
    ) -> Result<OnRobot<Fitted<R>, Self>, ForRobotError> {
        let robot = fitted(measures, robot, CORRIDOR_WIDTH)?;
        let made_for = robot.made_for();
        let spacing = needed(measures.corridor_spacing, "corridor_spacing")?;
        let mut routines = RoutineConfig::new(
            made_for.corridor_width,
            made_for.turn_per_step,
            made_for.translate_per_step,
        );
        // A bound is twice the error that odometry makes on the whole.
        routines.odometry_share = 2.0 * needed(measures.odometry_error, "odometry_error")?;
        routines.compass_bound = needed(measures.compass_error, "compass_error")?;
        let metre = robot.metre();
        let mut mapper = Config::new(Config::corridor_actions(), spacing / metre);
        mapper.place_radius = PLACE_RADIUS;
        mapper.apart = Apart::Side;
        mapper.world = WorldKind::Static;
        mapper.percepts = aligned_signatures(1, COLUMNS as usize);
        if !paper {
            mapper.journal = JournalLength::All;
            mapper.restructuring.merge_by_looks_and_turns();
        }
        let config = DiktiometerConfig::paper(routines, mapper);
        let system = Self::new(config, LaserEye { columns: COLUMNS }, seed);
        Ok(OnRobot::new(robot, system, metre))
    }
}

impl<E> Diktiometer<E> {
    /// Returns a system without a map, which it begins at its first action. `seed` seeds its random
    /// walk.
    #[must_use]
    pub fn new(config: DiktiometerConfig, eye: E, seed: u64) -> Self {
        Self::beginning(None, config, eye, seed)
    }

    /// Returns a system that continues with the map of `observer`, learned by another or read from
    /// a file. The mapper's configuration is the observer's.
    #[must_use]
    pub fn with_map(mut config: DiktiometerConfig, eye: E, observer: Observer, seed: u64) -> Self {
        config.mapper = observer.config().clone();
        Self::beginning(Some(observer), config, eye, seed)
    }

    fn beginning(observer: Option<Observer>, config: DiktiometerConfig, eye: E, seed: u64) -> Self {
        Self {
            guide: Guide::new(observer, config.until, config.heed, seed),
            finder: None,
            broken_off: None,
            config,
            eye,
            seed,
        }
    }

    /// Returns the system's configuration.
    #[must_use]
    pub const fn config(&self) -> &DiktiometerConfig {
        &self.config
    }

    /// Notes where on the map a landmark was sensed before.
    pub fn remember(&mut self, landmark: Landmark, spot: LandmarkSpot) {
        self.guide.remember(landmark, spot);
    }

    /// Returns where on the map a landmark was sensed last, or `None` if it was not. O(1).
    #[must_use]
    pub fn spot_of(&self, landmark: Landmark) -> Option<LandmarkSpot> {
        self.guide.spot_of(landmark)
    }

    /// Returns the observer with its map, or `None` before the first action.
    #[must_use]
    pub fn observer(&self) -> Option<&Observer> {
        self.guide.observer()
    }

    /// Returns the last move; `None` before the first one on the map.
    #[must_use]
    pub const fn last_move(&self) -> Option<&MappedMove> {
        self.guide.last()
    }

    /// Returns the places that the robot visited, from the first on, by their ids at that time;
    /// `None` for places of a dropped map.
    #[must_use]
    pub fn visited(&self) -> &[Option<PlaceId>] {
        self.guide.visited()
    }

    /// Takes in that the robot was put down anywhere, and returns whether it can go on: if it has a
    /// map. It knows where landmarks are, but not its place.
    pub fn put_down(&mut self) -> Standing {
        let Some(map) = self.observer() else {
            return Standing::gave_up("it has no map to find itself on");
        };
        let goal = self.spot_of(Landmark::Goal);
        self.finder = Some(RouteFinder::new(map.clone(), goal, self.seed));
        self.broken_off = None;
        Standing::UnderWay
    }

    /// Makes the next move of `task` with a robot that has routines of its own. Eye and routines of
    /// this system are not used.
    ///
    /// # Errors
    /// [`MapError`] if robot or observer cannot go on.
    pub fn act_with<V: Rover>(
        &mut self,
        rover: &mut V,
        task: Task,
    ) -> Result<Standing, MapError<V::Error>> {
        self.guide.act(rover, &self.config.mapper, task)
    }
}

impl<E> Mapper for Diktiometer<E> {
    type Observation = ObservedMove;
    type Error = RefusedMove;

    /// Takes in a move made by another. Without a map it begins one at an unknown place, which a
    /// mapper with percepts refuses.
    fn observe(&mut self, seen: &ObservedMove) -> Result<(), RefusedMove> {
        if let Some(finder) = &mut self.finder {
            finder.take_in(seen);
            return Ok(());
        }
        self.guide.observe(seen, &self.config.mapper)
    }

    fn map(&self) -> MapView {
        let mut view = self.observer().map_or_else(MapView::default, Mapper::map);
        for (landmark, place) in self.guide.landmarks() {
            let mut places = view.places.iter_mut();
            if let Some(place) = places.find(|known| known.id == place.0) {
                place.landmark.get_or_insert(landmark);
            }
        }
        view
    }

    fn belief(&self) -> Vec<Guess> {
        let Some(finder) = &self.finder else {
            return self.observer().map_or_else(Vec::new, Mapper::belief);
        };
        let places = finder.belief().into_iter().flat_map(PlaceBelief::places);
        let guess = |(place, weight): (PlaceId, f64)| Guess {
            at: Position::Place(place.0),
            weight,
        };
        places.map(guess).collect()
    }

    fn certainty(&self) -> Option<f64> {
        self.observer()?.certainty()
    }

    fn doubt(&self) -> Option<String> {
        self.observer()?.self_check().complaint()
    }

    fn map_bytes(&self) -> Option<usize> {
        self.observer()?.map_bytes()
    }

    fn visit_naming(&self) -> VisitNaming {
        VisitNaming::EachArrival
    }

    fn visits(&self) -> Vec<Option<u32>> {
        let paths = self.observer().map(|observer| &observer.map().paths);
        let now = |place: &Option<PlaceId>| Some(paths?.resolve((*place)?)?.0);
        self.visited().iter().map(now).collect()
    }
}

impl<R, E> System<R> for Diktiometer<E>
where
    R: SensesLandmarks<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    type Failure = DiktiometerError<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        let sought = sought(task, |landmark| self.guide.spot_of(landmark));
        let rover = Surveyor::new(robot, &self.eye, self.config.routines)?;
        let mut rover = rover.seeking(sought).going_on(self.broken_off.take());
        let acted = match &mut self.finder {
            Some(finder) => finder.act(&mut rover, task).map_err(MapError::Robot),
            None => self.guide.act(&mut rover, &self.config.mapper, task),
        };
        self.broken_off = rover.broken_off();
        match acted {
            Err(MapError::Robot(RoutineError::Found)) => {
                if let (Some(landmark), None) = (sought, &self.finder) {
                    self.guide.broke_off_at(landmark);
                }
                Ok(Standing::Done)
            }
            acted => Ok(acted?),
        }
    }

    fn put_down(&mut self) -> Standing {
        Self::put_down(self)
    }

    fn words(&self) -> String {
        let finder = self.finder.as_ref();
        finder.map_or_else(|| self.guide.words(), RouteFinder::words)
    }
}
