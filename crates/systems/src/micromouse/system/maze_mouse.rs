use core::f64::consts::FRAC_PI_2;

use tolman_control::heading_of;
use tolman_geom::{Heading, Pose};
use tolman_maps::wall_map::{ClosedCells, WallMap};
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_planners::Unknown;
use tolman_planners::moves::{MoveExplorerConfig, RolloutConfig};
use tolman_robot::{Compass, Mapper, Ranges, Robot, Rolls, Standing, System, Task, TurnTranslate};

use super::choice::Choice;
use super::lost::Lost;
use super::pilot::{Arrival, Body, PATIENCE, Pilot};
use super::{CellSight, MazeMouseConfig, MazeMouseError};
use crate::micromouse::{
    Brief, Certificate, Certify, MouseError, RunTwo, SIDE, Search, TargetSearch, WholeMaze,
};

/// A mouse that explores a grid maze with any robot that has a laser ring, a compass and encoders,
/// and makes runs in it.
///
/// - `Explore` drives as its search decides, until the search has its proof.
/// - `Reach` drives a best run on walls known to be open, or else on those not known to stand. The
///   landmarks are the start and the goals; a place is a cell, by
///   [`Grid::index`](tolman_maze::Grid::index).
/// - `Localize` is done when only one cell is possible. The mouse knows its cell at the start. Put
///   down elsewhere, it drives to where the possible cells differ. `Explore` and `Reach` begin with
///   that.
///
/// Every action is one cell: the mouse looks at the walls, chooses, and drives to the middle of the
/// next cell. It gives up if the walls contradict its map, or if the robot does not reach the next
/// cell.
#[derive(Clone, Debug)]
pub struct MazeMouse<S> {
    pub(super) brief: Brief,
    pub(super) config: MazeMouseConfig,
    pub(super) search: S,
    pub(super) run_two: RunTwo,
    pub(super) walls: WallMap<SIDE>,
    pub(super) at: Cell,
    pub(super) pilot: Pilot,
    /// Last task of the mouse.
    task: Option<Task>,
    /// Sides by which the mouse leaves the next cells, the next one last.
    pub(super) route: Vec<Direction>,
    /// Belief about the mouse's place after it was put down, until it has localized.
    pub(super) lost: Option<Lost>,
}

impl MazeMouse<Certify> {
    /// Returns a mouse that explores until it has proven the run of fewest steps, each a turn and
    /// up to three cells.
    ///
    /// # Errors
    /// If the maze is too large or a number of `config` is out of its range.
    pub fn certify(brief: Brief, config: MazeMouseConfig) -> Result<Self, MazeMouseError> {
        let (explorer, rollouts) = (MoveExplorerConfig::tuned(), RolloutConfig::tuned());
        let search = Certify::new(explorer, Some(rollouts), brief.grid, brief.start)?;
        Self::new(brief, config, search, RunTwo::FewestMoves)
    }
}

impl MazeMouse<WholeMaze> {
    /// Returns a mouse that explores until it has visited every cell.
    ///
    /// # Errors
    /// If the maze is too large or a number of `config` is out of its range.
    pub fn whole_maze(brief: Brief, config: MazeMouseConfig) -> Result<Self, MazeMouseError> {
        Self::new(brief, config, WholeMaze, RunTwo::FewestMoves)
    }
}

impl MazeMouse<TargetSearch> {
    /// Returns a mouse that explores until it has proven the run of fewest cells, as the paper's
    /// target search does.
    ///
    /// # Errors
    /// If the maze is too large or a number of `config` is out of its range.
    pub fn target(brief: Brief, config: MazeMouseConfig) -> Result<Self, MazeMouseError> {
        Self::new(brief, config, TargetSearch::new(), RunTwo::FewestCells)
    }
}

impl<S: Search> MazeMouse<S> {
    /// Returns a mouse in the middle of the start without observations. It explores by `search` and
    /// runs by `run_two`.
    ///
    /// # Errors
    /// If the maze is larger than [`SIDE`] or a number of `config` is out of its range.
    pub fn new(
        brief: Brief,
        config: MazeMouseConfig,
        search: S,
        run_two: RunTwo,
    ) -> Result<Self, MazeMouseError> {
        config.check()?;
        let walls = WallMap::new(brief.grid, ClosedCells::Possible);
        let mut walls = walls.map_err(MouseError::from)?;
        walls.visit(brief.start);
        let pose = Pose::new(config.middle(brief.start), heading_of(brief.heading));
        Ok(Self {
            at: brief.start,
            brief,
            config,
            search,
            run_two,
            walls,
            pilot: Pilot::new(pose, config),
            task: None,
            route: Vec::new(),
            lost: None,
        })
    }

    /// Returns the walls that the mouse knows.
    #[must_use]
    pub const fn walls(&self) -> &WallMap<SIDE> {
        &self.walls
    }

    /// Returns the mouse's believed pose, in the frame of the maze.
    #[must_use]
    pub const fn pose(&self) -> Pose {
        self.pilot.pose()
    }

    /// Returns the proof that no run from the start takes fewer steps than the best known one, once
    /// it exists. O(n) for n cells.
    #[must_use]
    pub fn certificate(&self) -> Option<Certificate> {
        let Brief { start, goals, .. } = &self.brief;
        // `new` has refused a maze that is too large.
        let run = self.run(Unknown::Closed, *start, goals).ok()??;
        Certificate::of(&self.walls, *start, goals, &run).ok()?
    }
}

impl<R, S> System<R> for MazeMouse<S>
where
    R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
    S: Search,
{
    type Failure = R::Error;

    fn act(&mut self, robot: &mut R, task: Task) -> Result<Standing, R::Error> {
        if self.task.replace(task) != Some(task) {
            self.route.clear();
        }
        if let Some(lost) = self.lost.take() {
            return self.find_itself(lost, robot, task);
        }
        if let Some(standing) = self.look(robot)? {
            return Ok(standing);
        }
        if self.route.is_empty() {
            match self.choose(task) {
                Choice::Drive(sides) => self.route = sides,
                Choice::Turn => {
                    let right = self.pose().heading.turned(-FRAC_PI_2);
                    return self.turn_to(robot, right);
                }
                Choice::End(standing) => return Ok(standing),
            }
        }
        match self.route.pop() {
            Some(side) => self.leave_by(robot, side),
            None => Ok(Standing::UnderWay),
        }
    }

    fn put_down(&mut self) -> Standing {
        self.lose_itself()
    }
}

impl<S: Search> MazeMouse<S> {
    /// Takes in the walls visible from here. Returns a standing if there were no ranges, or they
    /// contradict the map.
    fn look<R: Body>(&mut self, robot: &mut R) -> Result<Option<Standing>, R::Error> {
        let cell = self.at;
        let Some(rays) = self.pilot.look(robot, self.config.middle(cell))? else {
            return Ok(Some(Standing::UnderWay));
        };
        let lost = self.observe(&CellSight { cell, rays }).err();
        Ok(lost.map(|error| Standing::gave_up(error.to_string())))
    }

    fn turn_to<R: Body>(&mut self, robot: &mut R, heading: Heading) -> Result<Standing, R::Error> {
        let arrival = self.pilot.turn_to(robot, heading)?;
        Ok(self.standing(arrival))
    }

    fn leave_by<R: Body>(&mut self, robot: &mut R, side: Direction) -> Result<Standing, R::Error> {
        let is_open = self.walls.knowledge(self.at, side) == Knowledge::Open;
        let next = self.brief.grid.neighbour(self.at, side);
        let Some(next) = next.filter(|_| is_open) else {
            // The route was planned on hope: look there, and choose another next time.
            self.route.clear();
            return self.turn_to(robot, heading_of(side));
        };
        let target = self.config.middle(next);
        let arrival = self.pilot.drive_to(robot, target)?;
        self.at = next;
        self.walls.visit(next);
        Ok(self.standing(arrival))
    }

    pub(super) fn standing(&self, arrival: Arrival) -> Standing {
        match arrival {
            Arrival::Arrived => Standing::UnderWay,
            Arrival::OutOfPatience => Standing::gave_up(format!(
                "the robot did not come to rest in {} in {PATIENCE} time steps",
                self.at
            )),
        }
    }
}
