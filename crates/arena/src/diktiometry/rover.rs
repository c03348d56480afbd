//! Between any robot and the mapper: what a robot must be able to do, and how what it does becomes the mapper's moves.

use core::error::Error;

use thiserror::Error as ThisError;
use tolman_geom::{Heading, Interval, IntervalError, PointBox, PoseBox};
use tolman_maps::diktiometry::{
    Action, Config, Exits, Move, Observer, Outcome, Percepts, Signature, Start, StartError,
    StepError, StepReport,
};
use tolman_maze::Direction;

/// A robot whose control routines end at distinctive places.
///
/// [`Surveyor`](super::Surveyor) is one, in offices and in MSLST's mazes. Another robot needs no more than this to have its
/// world mapped; what its wheels and its heading say becomes a box with [`Odometer`].
pub trait Rover {
    /// Why a routine cannot be carried out.
    type Error: Error + Send + Sync + 'static;

    /// What there is to see where it stands, without moving.
    ///
    /// # Errors
    /// If its sensors give nothing.
    fn look(&mut self) -> Result<Arrival, Self::Error>;

    /// Goes in a direction to the next place.
    ///
    /// # Errors
    /// If the routine neither ends at a place nor is blocked.
    fn go(&mut self, direction: Direction) -> Result<Arrival, Self::Error>;
}

/// What a control routine ended with.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Whether the robot came to the next place, or there was no way.
    pub outcome: RoutineOutcome,
    /// How the robot moved: east and north, m. Its true way lies inside.
    pub moved: PointBox,
    /// What the place looks like, turned by the compass: column 0 looks east, the others follow counter-clockwise. None if
    /// the robot does not look.
    pub look: Option<Signature>,
    /// Which ways lead on, by [`Direction::index`].
    pub exits: [bool; 4],
}

/// How a control routine ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoutineOutcome {
    /// At the next place.
    Completed,
    /// Where it began, before a wall.
    Blocked,
}

/// Sums up what wheels and heading say of a routine, within their bounds: the paper's "reasonable bounds on relative
/// position".
#[derive(Clone, Copy, Debug)]
pub struct Odometer {
    share: f64,
    heading_bound: f64,
    gone: PointBox,
}

impl Odometer {
    /// Of wheels that may be wrong by this share of the distance, 0 … 0.5, and a heading that may be wrong by so many radians.
    #[must_use]
    pub const fn new(share: f64, heading_bound: f64) -> Self {
        Self {
            share,
            heading_bound,
            gone: PointBox::ORIGIN,
        }
    }

    /// A routine begins.
    pub const fn begin(&mut self) {
        self.gone = PointBox::ORIGIN;
    }

    /// The wheels have rolled so many metres while the heading turned from `before` to `after`, the short way round.
    ///
    /// # Errors
    /// [`IntervalError`] if a reading is no number.
    pub fn roll(
        &mut self,
        distance: f64,
        before: Heading,
        after: Heading,
    ) -> Result<(), IntervalError> {
        if distance.abs() <= 0.0 {
            return Ok(());
        }
        let turned = before.turn_to(after);
        // The chord of an arc is a little shorter than the arc.
        let chord = 1.0 - turned * turned / 20.0;
        let [near, far] = [1.0 + self.share, 1.0 - self.share].map(|scale| distance.abs() / scale);
        let way = Interval::new(near * chord.clamp(0.0, 1.0), far)?;
        let way = if distance < 0.0 { -way } else { way };
        let start = before.radians();
        let headings = Interval::new(start.min(start + turned), start.max(start + turned))?;
        let headings = headings.widened(self.heading_bound)?;
        self.gone = self.gone + PointBox::new(way, Interval::ZERO).rotated(headings);
        Ok(())
    }

    /// How the robot moved since the routine began: east and north, m.
    #[must_use]
    pub const fn moved(&self) -> PointBox {
        self.gone
    }
}

/// A robot with the map that grows as it goes.
#[derive(Debug)]
pub struct Mapped<R> {
    robot: R,
    observer: Observer,
    exits: [bool; 4],
}

/// Why a robot cannot be mapped any further.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum MapError<E: Error + 'static> {
    /// The robot cannot.
    #[error("the robot cannot go on")]
    Robot(#[source] E),
    /// The observer cannot begin.
    #[error("the observer cannot begin")]
    Start(#[from] StartError),
    /// The observer refuses a move.
    #[error("the observer refuses a move")]
    Step(#[from] StepError),
}

impl<R: Rover> Mapped<R> {
    /// A robot at a place, with a map of that place alone. Action n of the map is direction n of [`Direction::ALL`].
    ///
    /// # Errors
    /// [`MapError`] if the robot sees nothing or the configuration is none.
    pub fn new(mut robot: R, config: Config) -> Result<Self, MapError<R::Error>> {
        let seen = robot.look().map_err(MapError::Robot)?;
        let start = Start {
            percept: percept(&config, &seen),
            exits: exits(&seen),
        };
        let observer = Observer::new(config, start)?;
        Ok(Self {
            robot,
            observer,
            exits: seen.exits,
        })
    }

    /// A robot that goes on with a map it made before, from where it last was or from elsewhere: the observer finds out.
    ///
    /// # Errors
    /// [`MapError::Robot`] if the robot sees nothing.
    pub fn resumed(mut robot: R, observer: Observer) -> Result<Self, MapError<R::Error>> {
        let exits = robot.look().map_err(MapError::Robot)?.exits;
        Ok(Self {
            robot,
            observer,
            exits,
        })
    }

    /// Goes in a direction, and tells the map of it.
    ///
    /// # Errors
    /// [`MapError`] if the robot cannot or the observer will not.
    pub fn go(
        &mut self,
        direction: Direction,
    ) -> Result<(Arrival, StepReport), MapError<R::Error>> {
        let arrival = self.robot.go(direction).map_err(MapError::Robot)?;
        let report = self.observer.step(&Move {
            action: Action(direction.index() as u32),
            odometry: PoseBox::new(arrival.moved, Interval::ZERO),
            percept: percept(self.observer.config(), &arrival),
            exits: exits(&arrival),
            outcome: match arrival.outcome {
                RoutineOutcome::Completed => Outcome::Arrived,
                RoutineOutcome::Blocked => Outcome::Blocked,
            },
        })?;
        self.exits = arrival.exits;
        Ok((arrival, report))
    }

    /// Which ways lead on from where the robot is, by [`Direction::index`].
    #[must_use]
    pub const fn exits(&self) -> &[bool; 4] {
        &self.exits
    }

    /// The robot.
    #[must_use]
    pub const fn robot(&self) -> &R {
        &self.robot
    }

    /// The robot, to change its world.
    pub const fn robot_mut(&mut self) -> &mut R {
        &mut self.robot
    }

    /// The observer with its map.
    #[must_use]
    pub const fn observer(&self) -> &Observer {
        &self.observer
    }
}

/// What the robot saw, if the mapper wants to know.
fn percept(config: &Config, arrival: &Arrival) -> Option<Signature> {
    match config.percepts {
        Percepts::None => None,
        Percepts::Signatures(_) => arrival.look.clone(),
    }
}

fn exits(arrival: &Arrival) -> Exits {
    let open = (0..4).filter(|action| arrival.exits[*action as usize]);
    Exits::Seen(open.map(Action).collect())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tolman_geom::{Point, Vector};

    use super::*;

    proptest! {
        /// Whatever wheels and compass say within their bounds, the box holds where the robot is.
        #[test]
        fn the_true_way_is_inside_the_box(
            steps in prop::collection::vec((-0.1..0.1_f64, -0.2..0.2_f64, -1.0..1.0_f64, -1.0..1.0_f64), 1..60),
            start in -3.2..3.2_f64,
        ) {
            let (share, bound) = (0.1, 0.07);
            let mut odometer = Odometer::new(share, bound);
            odometer.begin();
            let (mut at, mut heading) = (Point::origin(), start);
            for (distance, turn, wrong, off) in steps {
                let radius = if turn.abs() > 1e-9 { distance / turn } else { 0.0 };
                let chord = if radius.abs() > 0.0 { 2.0 * radius * (0.5 * turn).sin() } else { distance };
                let middle = heading + 0.5 * turn;
                at += Vector::new(chord * middle.cos(), chord * middle.sin());
                // One error of the compass for both ends of a step.
                let told = |heading: f64| Heading::from_radians(heading + off * bound);
                odometer
                    .roll(distance * (1.0 + wrong * share), told(heading), told(heading + turn))
                    .unwrap();
                heading += turn;
            }
            prop_assert!(odometer.moved().contains(at), "{:?} {:?}", odometer.moved(), at);
        }
    }

    #[test]
    fn a_routine_begins_at_its_origin_and_no_number_is_refused() {
        let mut odometer = Odometer::new(0.1, 0.0);
        odometer.roll(1.0, Heading::EAST, Heading::EAST).unwrap();
        let moved = odometer.moved();
        assert!(moved.x.low() > 0.9 && moved.x.high() < 1.12, "{moved:?}");
        odometer.begin();
        assert_eq!(odometer.moved(), PointBox::ORIGIN);
        assert!(
            odometer
                .roll(f64::NAN, Heading::EAST, Heading::EAST)
                .is_err()
        );
    }
}
