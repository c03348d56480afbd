use core::error::Error;

use thiserror::Error as ThisError;
use tolman_maps::diktiometry::{
    Config, FirstPlace, ObservedMove, ObservedMoveError, Observer, PlaceId, StartError,
};
use tolman_robot::{
    Compass, Guess, Landmark, MapView, Mapper, Ranges, Robot, Rolls, SensesLandmarks, Standing,
    System, Task, TurnTranslate, VisitNaming,
};

use super::noticing::{BreakOff, sought};
use super::{
    Eye, Guide, LandmarkSpot, MapError, Next, Noticing, RoutineConfig, RoutineConfigError,
    RoutineError, Surveyor, of_mapper,
};

/// The diktiometry as a system: it drives a robot from place to place, maps what it finds and goes
/// to goals.
///
/// Each action is one control routine, from a place to the next. Its tasks:
///
/// - **Explore**: the [`Planner`](super::Planner)'s walk. It ends when nothing is left to try at
///   any place that can be reached on the map. Moreover, no two places may be one, and the map must
///   not contradict itself. It gives up a map that has contradicted itself for 20 moves. It also
///   gives up a map that was not folded for five moves per place, at most 300 moves, and at once a
///   map that grows without end. If the robot was carried elsewhere, so that the view differs from
///   that at its last stop, it begins another map there. By the paper's rule of matching, or on a
///   map that it was given, it gives up.
/// - **Reach** a place: the map's plan, made again after every routine. It gives up if the map
///   knows no way.
/// - **Reach** a landmark: the plan to where it was sensed last, at a place or on the way between
///   two; on the way, the robot stops there. Until it was sensed, the robot explores.
/// - **Localize**: the planner's walk, until one hypothesis is confident and no other is. With an
///   earlier map it first makes as many moves as the mapper's `tracks.history`, on which confidence
///   rests.
///
/// A robot that starts in mid-corridor goes to a place before it maps. After a routine that broke
/// off, it goes back to the place it left. With an earlier map it continues as if the robot stood
/// where the map has it. If the robot was carried elsewhere, or a routine broke off beside a place,
/// places may be made twice.
///
/// `E` is the eye by which it tells places apart; the mapper's percepts have to fit it.
#[derive(Clone, Debug)]
pub struct Diktiometer<E> {
    config: DiktiometerConfig,
    eye: E,
    guide: Guide,
    /// Places that the robot visited, by their ids at that time; `None` for places of a dropped
    /// map.
    visited: Vec<Option<PlaceId>>,
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
}

impl DiktiometerConfig {
    /// Returns a configuration that follows advice in 30 % of the cases, as in the paper.
    #[must_use]
    pub const fn paper(routines: RoutineConfig, mapper: Config) -> Self {
        Self {
            routines,
            mapper,
            heed: 0.3,
        }
    }
}

/// Reason why a [`Diktiometer`] cannot go on.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum DiktiometerError<E: Error + 'static> {
    /// The routines' configuration is out of its bounds.
    #[error(transparent)]
    Config(#[from] RoutineConfigError),
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

impl<E> Diktiometer<E> {
    /// Returns a system without a map, which it begins at its first action. `seed` seeds its random
    /// walk.
    #[must_use]
    pub fn new(config: DiktiometerConfig, eye: E, seed: u64) -> Self {
        let guide = Guide::new(None, config.heed, seed);
        Self::guided(config, eye, guide)
    }

    /// Returns a system that continues with the map of `observer`, learned by another or read from
    /// a file. The mapper's configuration is the observer's.
    #[must_use]
    pub fn with_map(mut config: DiktiometerConfig, eye: E, observer: Observer, seed: u64) -> Self {
        config.mapper = observer.config().clone();
        let guide = Guide::new(Some(observer), config.heed, seed);
        Self::guided(config, eye, guide)
    }

    const fn guided(config: DiktiometerConfig, eye: E, guide: Guide) -> Self {
        let visited = Vec::new();
        Self {
            config,
            eye,
            guide,
            visited,
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
}

impl<E> Mapper for Diktiometer<E> {
    type Observation = ObservedMove;
    type Error = RefusedMove;

    /// Takes in a move made by another. Without a map it begins one at an unknown place, which a
    /// mapper with percepts refuses.
    fn observe(&mut self, seen: &ObservedMove) -> Result<(), RefusedMove> {
        if let Some(observer) = self.guide.observer_mut() {
            if self.visited.is_empty() {
                self.visited.push(Some(observer.place()));
            }
            observer.step(seen)?;
            self.visited.push(Some(observer.place()));
            return Ok(());
        }
        let mut observer = Observer::new(self.config.mapper.clone(), FirstPlace::default())?;
        self.visited.push(Some(observer.place()));
        observer.step(seen)?;
        self.visited.push(Some(observer.place()));
        self.guide.take_over(observer);
        Ok(())
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
        self.observer().map_or_else(Vec::new, Mapper::belief)
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
        self.visited.iter().map(now).collect()
    }
}

impl<R, E> System<R> for Diktiometer<E>
where
    R: SensesLandmarks + Robot<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    type Failure = DiktiometerError<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        let sought = sought(task, |landmark| self.guide.spot_of(landmark));
        let noticing = Noticing::new(robot, sought);
        let mut rover = Surveyor::new(noticing, &self.eye, self.config.routines)?;
        let (guide, visited) = (&mut self.guide, &mut self.visited);
        match advance(guide, visited, &self.config.mapper, &mut rover, task) {
            Ok(standing) => Ok(standing),
            Err(error) => match of_mapper(error) {
                None => {
                    if let Some(landmark) = sought {
                        self.guide.broke_off_at(landmark);
                    }
                    Ok(Standing::Done)
                }
                Some(error) => Err(error.into()),
            },
        }
    }

    fn words(&self) -> String {
        self.guide.words()
    }
}

/// Makes the next move of a task.
fn advance<R, E>(
    guide: &mut Guide,
    visited: &mut Vec<Option<PlaceId>>,
    mapper: &Config,
    rover: &mut Surveyor<Noticing<'_, R>, E>,
    task: Task,
) -> Result<Standing, MapError<RoutineError<BreakOff<R::Error>>>>
where
    R: SensesLandmarks + Robot<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    let begins_again = task == Task::Explore && guide.drops_map();
    guide.find_footing(rover, mapper)?;
    let place = guide.observer().map(Observer::place);
    if begins_again {
        visited.fill(None);
        visited.push(place);
        return Ok(Standing::UnderWay);
    }
    let before = rover.robot().landmark();
    guide.recognize(before);
    let direction = match guide.next(task, before) {
        Next::Continue(direction) => direction,
        Next::Break(standing) => return Ok(standing),
    };
    if visited.is_empty() && place.is_some() {
        visited.push(place);
    }
    if !guide.go(rover, direction)? {
        return Ok(Standing::UnderWay);
    }
    visited.push(guide.observer().map(Observer::place));
    let here = rover.robot().landmark();
    let passed = rover.robot().on_the_way([before, here]);
    guide.recognize_on_way(passed, place);
    guide.recognize(here);
    if guide.is_done(task, here) {
        return Ok(Standing::Done);
    }
    Ok(Standing::UnderWay)
}
