use core::error::Error;

use thiserror::Error as ThisError;
use tolman_maps::diktiometry::{ObservedMove, ObservedMoveError, Observer, PlaceBelief, PlaceId};
use tolman_robot::{
    Compass, Guess, Landmark, MapView, Mapper, Position, Ranges, Robot, Rolls, SensesLandmarks,
    Standing, System, Task, TurnTranslate,
};

use super::noticing::{BreakOff, sought};
use super::{
    Eye, LandmarkSpot, Next, Noticing, RouteFinder, RoutineConfig, RoutineConfigError,
    RoutineError, Surveyor, of_robot,
};

/// A robot that was put down anywhere on a learned diktiometry: it localizes and goes to goals. It
/// never changes the map.
///
/// Its tasks:
///
/// - **Localize**: it keeps a [`PlaceBelief`] and makes the moves that tell the likeliest places
///   apart. It ends when one place has 90 % of the belief, or the map tells no more of them apart.
/// - **Reach** a place or a landmark: it localizes and follows the shortest way on the map. If that
///   leads elsewhere than on the map, it localizes again. A way that differed from the map is
///   avoided as long as there are others. At a landmark on the way between two places it stops. It
///   gives up if the map does not have the landmark, or if its moves do not fit the map for long.
/// - **Explore**: it gives up. A [`Diktiometer`](super::Diktiometer) learns maps.
///
/// `E` is the eye by which it tells places apart; the map's percepts have to fit it.
#[derive(Clone, Debug)]
pub struct Wayfinder<E> {
    routines: RoutineConfig,
    eye: E,
    finder: RouteFinder,
}

/// Reason why a [`Wayfinder`] cannot go on.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum WayfinderError<E: Error + 'static> {
    /// The routines' configuration is out of its bounds.
    #[error(transparent)]
    Config(#[from] RoutineConfigError),
    /// The robot cannot go on.
    #[error("the robot cannot go on")]
    Robot(#[from] RoutineError<E>),
}

impl<E> Wayfinder<E> {
    /// Returns a robot that knows the map of `observer`, but not its place on it. `goal` is where
    /// the landmark [`Goal`](Landmark::Goal) was sensed. `seed` seeds its random walk.
    #[must_use]
    pub fn new(
        routines: RoutineConfig,
        eye: E,
        map: Observer,
        goal: Option<LandmarkSpot>,
        seed: u64,
    ) -> Self {
        let finder = RouteFinder::new(map, goal, seed);
        Self {
            routines,
            eye,
            finder,
        }
    }

    /// Returns the belief about the robot's place; `None` before the robot stands at a place for
    /// the first time.
    #[must_use]
    pub const fn place_belief(&self) -> Option<&PlaceBelief> {
        self.finder.belief()
    }
}

impl<E> Mapper for Wayfinder<E> {
    type Observation = ObservedMove;
    type Error = ObservedMoveError;

    /// Takes in a move made by another, if it stands at a place already.
    fn observe(&mut self, seen: &ObservedMove) -> Result<(), ObservedMoveError> {
        self.finder.take_in(seen);
        Ok(())
    }

    fn map(&self) -> MapView {
        let mut view = Mapper::map(self.finder.map());
        let mut places = view.places.iter_mut();
        let at = |id| Some(LandmarkSpot::Place(PlaceId(id))) == self.finder.goal();
        if let Some(place) = places.find(|known| at(known.id)) {
            place.landmark = Some(Landmark::Goal);
        }
        view
    }

    fn belief(&self) -> Vec<Guess> {
        let places = self
            .place_belief()
            .into_iter()
            .flat_map(PlaceBelief::places);
        let guess = |(place, weight): (PlaceId, f64)| Guess {
            at: Position::Place(place.0),
            weight,
        };
        places.map(guess).collect()
    }
}

impl<R, E> System<R> for Wayfinder<E>
where
    R: SensesLandmarks + Robot<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    type Failure = WayfinderError<R::Error>;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, Self::Failure> {
        let sought = sought(task, |_| self.finder.goal());
        let noticing = Noticing::new(robot, sought);
        let mut rover = Surveyor::new(noticing, &self.eye, self.routines)?;
        match advance(&mut self.finder, &mut rover, task) {
            Ok(standing) => Ok(standing),
            Err(error) => match of_robot(error) {
                None => {
                    self.finder.lose_footing();
                    Ok(Standing::Done)
                }
                Some(error) => Err(error.into()),
            },
        }
    }

    fn words(&self) -> String {
        self.finder.words()
    }
}

/// Makes the next move of a task.
fn advance<R, E>(
    finder: &mut RouteFinder,
    rover: &mut Surveyor<Noticing<'_, R>, E>,
    task: Task,
) -> Result<Standing, RoutineError<BreakOff<R::Error>>>
where
    R: SensesLandmarks + Robot<Command = TurnTranslate, Error: Error + Send + Sync + 'static>,
    R::Sensing: Ranges + Compass + Rolls,
    E: Eye<R::Sensing>,
{
    if finder.belief().is_none() {
        finder.find_footing(rover)?;
    }
    let here = rover.robot().landmark();
    let direction = match finder.next(task, here) {
        Next::Continue(direction) => direction,
        Next::Break(standing) => return Ok(standing),
    };
    finder.go(rover, direction)?;
    let here = rover.robot().landmark();
    finder.recognize(here);
    if finder.is_done(task, here) {
        return Ok(Standing::Done);
    }
    Ok(Standing::UnderWay)
}
