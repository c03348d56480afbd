use core::f64::consts::FRAC_PI_2;

use tolman_control::heading_of;
use tolman_geom::{Heading, Pose};
use tolman_maps::wall_map::{ClosedCells, ObserveError, WallMap};
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_planners::Unknown;
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
/// next cell. It gives up if the robot does not reach the next cell.
///
/// - **Carried**: if the view changes while it stands, or walls contradict its map while it
///   explores, the mouse is lost. It finds its cell on the map so far, and goes on.
/// - **Doors**: walls that contradict its map while it drives to a goal have moved. The mouse
///   believes what it sees, and plans again.
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
    /// What is known of the end of each action.
    pub(super) stops: Vec<Stop>,
    /// Whether it has come to its cell without having seen it yet.
    pub(super) has_come: bool,
    /// Number of times that it was carried while it explored.
    pub(super) carried: u32,
}

/// What a mouse knows of the end of an action.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// Cell where it believes to have been; `None` if it was lost.
    pub(super) cell: Option<Cell>,
    /// Whether it learned walls before.
    has_news: bool,
}

/// Number of actions that are forgotten when walls contradict the map of an exploring mouse.
const DOUBTED: usize = 6;

impl MazeMouse<Certify> {
    /// Returns a mouse that explores until it has proven the run of fewest steps, each a turn and
    /// up to three cells.
    ///
    /// # Errors
    /// If the maze is too large or a number of `config` is out of its range.
    pub fn certify(brief: Brief, config: MazeMouseConfig) -> Result<Self, MazeMouseError> {
        let search = Certify::tuned(brief.grid, brief.start).map_err(MouseError::from)?;
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
            stops: Vec::new(),
            has_come: false,
            carried: 0,
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
        let unknown = self.walls.unknown_count();
        let standing = match self.lost.take() {
            Some(lost) => self.find_itself(lost, robot, task),
            None => self.explore_or_run(robot, task),
        };
        self.stops.push(Stop {
            cell: self.lost.is_none().then_some(self.at),
            has_news: self.walls.unknown_count() < unknown,
        });
        standing
    }

    fn put_down(&mut self) -> Standing {
        let known = self.brief.grid.cells();
        let known = known.filter(|cell| self.walls.visits(*cell) > 0);
        let known = known.collect();
        self.lose_itself(known)
    }
}

impl<S: Search> MazeMouse<S> {
    /// Makes the next action of a mouse that knows its cell.
    fn explore_or_run<R: Body>(&mut self, robot: &mut R, task: Task) -> Result<Standing, R::Error> {
        if let Some(standing) = self.look(robot, task)? {
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

    /// Takes in the walls visible from here. Returns a standing if there were no ranges, or the
    /// mouse is not where it believed to be.
    fn look<R: Body>(&mut self, robot: &mut R, task: Task) -> Result<Option<Standing>, R::Error> {
        let cell = self.at;
        let Some(view) = self.pilot.look(robot, self.config.middle(cell))? else {
            return Ok(Some(Standing::UnderWay));
        };
        if view.was_carried {
            return Ok(Some(self.was_carried()));
        }
        let seen = CellSight {
            cell,
            rays: view.rays,
        };
        let contradiction = match task {
            Task::Reach(_) => self.observe_doors(&seen).err(),
            Task::Explore | Task::Localize => self.observe(&seen).err(),
        };
        Ok(match (contradiction, task) {
            (None, _) => {
                if core::mem::take(&mut self.has_come) {
                    self.walls.visit(cell);
                }
                None
            }
            (Some(_), Task::Explore) => {
                // It was carried some cells ago, to where it looked alike.
                self.forget_lately();
                Some(self.was_carried())
            }
            (Some(error), _) => Some(Standing::gave_up(error.to_string())),
        })
    }

    /// Forgets what it saw lately, and where it was.
    fn forget_lately(&mut self) {
        let lately = self.stops.iter_mut().rev().take(DOUBTED);
        let mut news = 0;
        for stop in lately {
            news += usize::from(core::mem::take(&mut stop.has_news));
            if let Some(cell) = stop.cell.take() {
                self.walls.unvisit(cell);
            }
        }
        self.walls.undo(news);
    }

    /// Takes in what it sees in place of what it knew of the same walls.
    fn observe_doors(&mut self, seen: &CellSight) -> Result<(), ObserveError> {
        loop {
            match self.observe(seen) {
                Err(ObserveError::Contradiction {
                    cell, direction, ..
                }) if self.brief.grid.neighbour(cell, direction).is_some() => {
                    self.walls.forget(cell, direction);
                    self.route.clear();
                }
                end => return end,
            }
        }
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
        if arrival != Arrival::Carried {
            self.at = next;
            self.has_come = true;
        }
        Ok(self.standing(arrival))
    }

    pub(super) fn standing(&mut self, arrival: Arrival) -> Standing {
        match arrival {
            Arrival::Arrived => Standing::UnderWay,
            Arrival::Carried => self.was_carried(),
            Arrival::OutOfPatience => Standing::gave_up(format!(
                "the robot did not come to rest in {} in {PATIENCE} time steps",
                self.at
            )),
        }
    }
}
