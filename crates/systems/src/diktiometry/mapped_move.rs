use core::error::Error;

use thiserror::Error as ThisError;
use tolman_geom::{Interval, PoseBox};
use tolman_maps::diktiometry::{
    Action, Config, Exits, FirstPlace, ObservedMove, ObservedMoveError, Percepts, Signature,
    StartError, StepReport,
};
use tolman_maze::Direction;

use super::{Arrival, Reason};

/// A move that the map has taken in.
#[derive(Clone, Debug)]
pub struct MappedMove {
    /// Direction in which the rover went.
    pub direction: Direction,
    /// Reason of the walk for this direction; `None` on a plan to a goal.
    pub reason: Option<Reason>,
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
