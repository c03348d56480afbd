use core::error::Error;

use thiserror::Error as ThisError;
use tolman_geom::{Interval, PoseBox};
use tolman_maps::diktiometry::{
    Action, Config, Exits, FirstPlace, ObservedMove, ObservedMoveError, Observer, Percepts,
    Signature, StartError, StepReport, WorldKind,
};
use tolman_maze::Direction;

use super::{Arrival, Rover};

/// The map of a rover: turns the rover's arrivals into the observer's moves.
///
/// Action n of the map is direction n of [`Direction::ALL`].
#[derive(Clone, Debug)]
pub struct RoverMap {
    observer: Observer,
    exits: [bool; 4],
    /// View of the place where the rover stopped.
    look: Option<Signature>,
}

/// A move that the map has taken in.
#[derive(Clone, Debug)]
pub struct MappedMove {
    /// Measurements of the rover.
    pub arrival: Arrival,
    /// The observer's report.
    pub report: StepReport,
}

/// Reason why mapping cannot continue.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum MapError<E: Error + 'static> {
    /// The rover cannot go on.
    #[error("the robot cannot go on")]
    Robot(#[source] E),
    /// The observer cannot begin.
    #[error("the observer cannot begin")]
    Start(#[from] StartError),
    /// The observer refuses a move.
    #[error("the observer refuses a move; check what the rover reports")]
    Step(#[from] ObservedMoveError),
}

impl RoverMap {
    /// Lets `rover` look and returns a map of its place alone.
    ///
    /// # Errors
    /// [`MapError`] if the rover sees nothing or `config` is out of its bounds.
    pub fn begin<R: Rover>(rover: &mut R, config: Config) -> Result<Self, MapError<R::Error>> {
        let seen = rover.look().map_err(MapError::Robot)?;
        let start = first_place(&config, &seen);
        Ok(Self {
            observer: Observer::new(config, start)?,
            exits: seen.exits,
            look: seen.look,
        })
    }

    /// Lets `rover` look and continues an earlier map from its last place. If the rover is
    /// elsewhere, places may be made twice until the observer notices.
    ///
    /// # Errors
    /// [`MapError::Robot`] if the rover sees nothing.
    pub fn resume<R: Rover>(rover: &mut R, observer: Observer) -> Result<Self, MapError<R::Error>> {
        let mut mapping = Self::of(observer);
        mapping.look_round(rover)?;
        Ok(mapping)
    }

    /// Returns a map whose rover has not looked yet, so that it knows no exits.
    pub(super) const fn of(observer: Observer) -> Self {
        Self {
            observer,
            exits: [false; 4],
            look: None,
        }
    }

    /// Lets `rover` look for the ways that lead on from its place.
    pub(super) fn look_round<R: Rover>(&mut self, rover: &mut R) -> Result<(), MapError<R::Error>> {
        let seen = rover.look().map_err(MapError::Robot)?;
        (self.exits, self.look) = (seen.exits, seen.look);
        Ok(())
    }

    /// Lets `rover` look, and returns whether it sees the same as when it stopped. Views are
    /// compared if it has any. Ways that lead on are compared if the world is static.
    pub(super) fn is_where_it_was<R: Rover>(
        &self,
        rover: &mut R,
    ) -> Result<bool, MapError<R::Error>> {
        let seen = rover.look().map_err(MapError::Robot)?;
        let Config {
            percepts, world, ..
        } = self.observer.config();
        let has_other_exits = *world == WorldKind::Static && seen.exits != self.exits;
        Ok(!has_other_exits && percepts.are_alike(seen.look.as_ref(), self.look.as_ref()))
    }

    /// Lets `rover` go in `direction` and updates the map.
    ///
    /// # Errors
    /// [`MapError`] if the rover fails or the observer refuses the move; the map is then unchanged.
    pub fn go<R: Rover>(
        &mut self,
        rover: &mut R,
        direction: Direction,
    ) -> Result<MappedMove, MapError<R::Error>> {
        let arrival = rover.go(direction).map_err(MapError::Robot)?;
        let observed = observed(self.observer.config(), direction, &arrival);
        let report = self.observer.step(&observed)?;
        self.exits = arrival.exits;
        self.look.clone_from(&arrival.look);
        Ok(MappedMove { arrival, report })
    }

    /// Returns whether a way leads on from the rover's place in each direction, by
    /// [`Direction::index`].
    #[must_use]
    pub const fn exits(&self) -> &[bool; 4] {
        &self.exits
    }

    /// Returns the observer with its map.
    #[must_use]
    pub const fn observer(&self) -> &Observer {
        &self.observer
    }

    /// Returns the observer, to report moves that no rover of ours made.
    pub(super) const fn observer_mut(&mut self) -> &mut Observer {
        &mut self.observer
    }
}

/// Returns a move in `direction` as the input of a mapper of this configuration.
pub(super) fn observed(config: &Config, direction: Direction, arrival: &Arrival) -> ObservedMove {
    ObservedMove {
        action: Action(direction.index() as u32),
        odometry: PoseBox::new(arrival.moved, Interval::ZERO),
        percept: percept(config, arrival),
        exits: exits(arrival),
        outcome: arrival.outcome,
    }
}

/// Returns the rover's place as the input of a mapper of this configuration.
pub(super) fn first_place(config: &Config, seen: &Arrival) -> FirstPlace {
    FirstPlace {
        percept: percept(config, seen),
        exits: exits(seen),
    }
}

/// Returns the view at an arrival, or `None` if the map uses no views. For a robot that does not
/// look, the view is the ways that lead on.
fn percept(config: &Config, arrival: &Arrival) -> Option<Signature> {
    if config.percepts == Percepts::None {
        return None;
    }
    let look = arrival.look.clone();
    look.or_else(|| {
        let open = arrival.exits.map(|open| f64::from(u8::from(open)));
        Signature::new(1, open.into()).ok()
    })
}

fn exits(arrival: &Arrival) -> Exits {
    let open = (0..4).filter(|action| arrival.exits[*action as usize]);
    Exits::Seen(open.map(Action).collect())
}
