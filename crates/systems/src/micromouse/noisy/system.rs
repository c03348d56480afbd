//! Makes a noisy mouse a system: it learns the whole maze, localizes, and goes to goals.

use core::convert::Infallible;

use rand::RngExt;
use tolman_control::heading_of;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::wall_belief::RangeReading;
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_planners::Unknown;
use tolman_planners::moves::Leap;
use tolman_robot::{Guess, MapView, Mapper, Position, Standing, System, Task, TurnTranslate};

use super::mouse::readings;
use super::{NoisyBody, NoisyMouse, PoseSource};
use crate::micromouse::grid_map::{grid_map, place_of};

/// Number of particles per cell and direction when the mouse may be anywhere.
const SCATTERED: u32 = 8;
/// Maximum offset of a particle from the middle of its cell along an axis, as a share of the pitch;
/// and from the axis, rad.
const SCATTER: (f64, f64) = (0.15, 0.15);
/// Minimum share of the particles' weight in one cell at which the mouse is sure of its place.
const SURE: f64 = 0.95;

/// The next thing to do.
pub(super) enum Choice {
    Drive(Leap),
    Turn(Direction),
    End(Standing),
}

/// - `Explore` goes to the nearest cell with an unknown side, until none can be reached.
/// - `Reach` plans again at every stop: through walls believed open, or else through those not
///   believed to stand. If a way turns out to be shut, it finds another.
/// - `Localize` is done when 95 % of the particles' weight lie in one cell. Until then the mouse
///   drives to the goal from its likeliest place.
impl<R: NoisyBody> System<R> for NoisyMouse {
    type Failure = R::Error;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, R::Error> {
        self.look(robot)?;
        let choice = self.choose(task);
        self.carry_out(robot, choice)
    }

    fn put_down(&mut self) -> Standing {
        if self.config.localization == PoseSource::DeadReckoning {
            return Standing::gave_up("it reckons by its wheels alone and cannot find itself");
        }
        self.is_lost = true;
        let cells = self.brief.grid.cells();
        let on_map: Vec<Cell> = cells.filter(|cell| self.is_on_map(*cell)).collect();
        // The offsets are the same in all cells, so that cells that look alike stay equally likely.
        let offsets: Vec<Pose> = (0..SCATTERED).map(|_| self.scattered()).collect();
        let mut poses = Vec::new();
        for cell in on_map {
            for side in Direction::ALL {
                let middle = Pose::new(self.belief.middle(cell), heading_of(side));
                poses.extend(offsets.iter().map(|offset| middle.compose(*offset)));
            }
        }
        self.filter.spread(poses);
        Standing::UnderWay
    }
}

impl NoisyMouse {
    /// Returns whether a cell is known to be open on some side.
    fn is_on_map(&self, cell: Cell) -> bool {
        let open = |side| self.belief.knowledge(cell, side) == Knowledge::Open;
        cell == self.brief.start || Direction::ALL.into_iter().any(open)
    }

    /// Draws a random pose near the middle of a cell, relative to that middle.
    fn scattered(&mut self) -> Pose {
        let [x, y, turn] = [0; 3].map(|_| self.rng.random_range(-1.0..=1.0));
        let off = Vector::new(x, y) * (SCATTER.0 * self.config.pitch);
        Pose::new(Point::from(off), Heading::from_radians(SCATTER.1 * turn))
    }

    /// Looks once, and assumes its likeliest place. It has localized if it is sure of that place.
    pub(super) fn look_for_itself<R: NoisyBody>(&mut self, robot: &mut R) -> Result<(), R::Error> {
        self.time_step(robot, TurnTranslate::STOP)?;
        let readings = readings(robot.sensing());
        self.filter.sense(&self.belief, &readings, &mut self.rng);
        let (pose, weight) = self.filter.likeliest(self.config.pitch);
        self.reckoned = pose;
        if weight >= SURE {
            self.filter.gather(&mut self.rng);
            self.is_lost = false;
        }
        Ok(())
    }

    fn choose(&mut self, task: Task) -> Choice {
        match task {
            Task::Localize if !self.is_lost => Choice::End(Standing::Done),
            _ if self.is_lost => self.choose_to_find_itself(),
            Task::Explore | Task::Localize => self.choose_to_explore(),
            Task::Reach(goal) => match self.brief.cells_of(goal) {
                Ok(cells) => self.choose_to_reach(&cells, "no way leads there"),
                Err(standing) => Choice::End(standing),
            },
        }
    }

    fn choose_to_explore(&self) -> Choice {
        if let Some(side) = self.unknown_side(self.cell()) {
            return Choice::Turn(side);
        }
        let cells = self.brief.grid.cells();
        let new = cells.filter(|cell| self.unknown_side(*cell).is_some());
        let leap = self.first_leap(Unknown::Closed, new);
        leap.map_or(Choice::End(Standing::Done), Choice::Drive)
    }

    /// Chooses to drive a cell ahead while it is lost, and to turn if there is no way.
    fn choose_to_find_itself(&self) -> Choice {
        let at = self.cell();
        let targets = match self.brief.goals.contains(&at) {
            true => vec![self.brief.start],
            false => self.brief.goals.clone(),
        };
        let leap = self.first_leap(Unknown::Closed, targets);
        let next = leap.and_then(|leap| {
            let end = self.brief.grid.neighbour(at, leap.direction)?;
            Some(Leap {
                cells: 1,
                end,
                ..leap
            })
        });
        next.map_or_else(|| Choice::Turn(self.looks_to().right()), Choice::Drive)
    }

    /// Returns a side of a cell whose wall is not known, or `None` if all are known.
    fn unknown_side(&self, cell: Cell) -> Option<Direction> {
        let is_unknown = |side: &Direction| !self.belief.knowledge(cell, *side).is_known();
        Direction::ALL.into_iter().find(is_unknown)
    }
}

impl Mapper for NoisyMouse {
    /// A reading, and the pose at which it was made.
    type Observation = (Pose, RangeReading);
    type Error = Infallible;

    fn observe(&mut self, (pose, reading): &(Pose, RangeReading)) -> Result<(), Infallible> {
        self.belief
            .observe(*pose, *reading, &self.config.filter.sensor);
        Ok(())
    }

    fn map(&self) -> MapView {
        grid_map(&self.belief, &self.brief, |cell| self.belief.middle(cell))
    }

    fn belief(&self) -> Vec<Guess> {
        let weight = match self.is_lost {
            true => self.filter.likeliest(self.config.pitch).1,
            false => 1.0,
        };
        let at = Position::Place(place_of(&self.brief, self.cell()));
        vec![Guess { at, weight }]
    }

    fn map_bytes(&self) -> Option<usize> {
        Some(self.brief.grid.wall_count() * size_of::<f64>())
    }
}

pub(super) fn give_up(why: &str) -> Choice {
    Choice::End(Standing::gave_up(why))
}
