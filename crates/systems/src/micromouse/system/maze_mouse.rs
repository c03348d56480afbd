use core::f64::consts::FRAC_PI_2;

use tolman_control::heading_of;
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::wall_map::{ClosedCells, ObserveError, WallMap};
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_planners::moves::{Leap, MoveExplorerConfig, RolloutConfig};
use tolman_planners::{Passages, Unknown};
use tolman_robot::{
    Compass, Goal, Guess, Landmark, MapLink, MapPlace, MapView, Mapper, Position, Ranges, Robot,
    Rolls, Standing, System, Task, TurnTranslate,
};

use super::drive::{self, Arrival, PATIENCE};
use super::sight;
use super::whereabouts::Whereabouts;
use super::{CellSight, MazeMouseConfig, MazeMouseError};
use crate::micromouse::{
    Brief, Certificate, Certify, MouseError, Next, RunTwo, SIDE, Search, TargetSearch, View,
};

/// A mouse that explores a grid maze with any robot that has a laser ring, a compass and encoders, and runs in it.
///
/// - `Explore` drives as its search says, until that has its proof.
/// - `Reach` drives a best run: on walls known to be open, or else on those not known to stand. A place is a cell, by
///   [`Grid::index`](tolman_maze::Grid::index); the landmarks are the start and the goals.
/// - `Localize` is given up: the mouse is told where it starts.
///
/// Every action is one cell: it looks at the walls, decides, and drives to the middle of the next cell.
#[derive(Clone, Debug)]
pub struct MazeMouse<S> {
    brief: Brief,
    config: MazeMouseConfig,
    search: S,
    run_two: RunTwo,
    walls: WallMap<SIDE>,
    at: Cell,
    whereabouts: Whereabouts,
    /// What it was last asked to do.
    task: Option<Task>,
    /// The sides to leave the next cells by, the next one last.
    route: Vec<Direction>,
}

/// What to do in a cell.
enum Choice {
    /// Leave it, and the next ones.
    Drive(Vec<Direction>),
    /// Turn right.
    Turn,
    /// Nothing more.
    End(Standing),
}

/// What came of looking at the walls.
enum Look {
    /// They are in the map.
    Seen,
    /// There were no ranges.
    Blind,
    /// They contradict the map.
    Lost(ObserveError),
}

/// Time steps in which the mouse waits for ranges.
const LOOKS: u32 = 10;

impl MazeMouse<Certify> {
    /// Returns a mouse that explores until it has proven the run of fewest steps, each a turn and up to three cells.
    ///
    /// # Errors
    /// If the maze is too large or a number of `config` is out of its range.
    pub fn certify(brief: Brief, config: MazeMouseConfig) -> Result<Self, MazeMouseError> {
        let (explorer, rollouts) = (MoveExplorerConfig::tuned(), RolloutConfig::tuned());
        let search = Certify::new(explorer, Some(rollouts), brief.grid, brief.start)?;
        Self::new(brief, config, search, RunTwo::FewestMoves)
    }
}

impl MazeMouse<TargetSearch> {
    /// Returns a mouse that explores until it has proven the run of fewest cells, as the paper's target search does.
    ///
    /// # Errors
    /// If the maze is too large or a number of `config` is out of its range.
    pub fn target(brief: Brief, config: MazeMouseConfig) -> Result<Self, MazeMouseError> {
        Self::new(brief, config, TargetSearch::new(), RunTwo::FewestCells)
    }
}

impl<S: Search> MazeMouse<S> {
    /// Returns a mouse in the middle of the start that has seen nothing; it explores by `search` and runs by `run_two`.
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
        let mut walls =
            WallMap::new(brief.grid, ClosedCells::Possible).map_err(MouseError::from)?;
        walls.visit(brief.start);
        let pose = Pose::new(middle(brief.start, config.pitch), heading_of(brief.heading));
        Ok(Self {
            at: brief.start,
            brief,
            config,
            search,
            run_two,
            walls,
            whereabouts: Whereabouts(pose),
            task: None,
            route: Vec::new(),
        })
    }

    /// Returns the walls it knows.
    #[must_use]
    pub const fn walls(&self) -> &WallMap<SIDE> {
        &self.walls
    }

    /// Returns the pose in which it believes to be, in the frame of the maze.
    #[must_use]
    pub const fn pose(&self) -> Pose {
        self.whereabouts.0
    }

    /// Returns the proof that no run from the start takes fewer steps than the best known one, if it is one.
    #[must_use]
    pub fn certificate(&self) -> Option<Certificate> {
        let Brief { start, goals, .. } = &self.brief;
        let run = self.run(Unknown::Closed, *start, goals)?;
        Certificate::of(&self.walls, *start, goals, &run)
    }

    fn run(&self, unknown: Unknown, from: Cell, targets: &[Cell]) -> Option<Vec<Leap>> {
        let passages = Passages::new(&self.walls, unknown);
        self.run_two.plan(&passages, from, targets)
    }

    fn choose(&mut self, task: Task) -> Choice {
        match task {
            Task::Explore => self.choose_to_explore(),
            Task::Reach(goal) => match self.cells_of(goal) {
                Some(targets) => self.choose_to_reach(&targets),
                None => give_up("the mouse knows the start, the goals, and cells of the maze"),
            },
            Task::Localize => give_up("the mouse is told where it starts, and cannot find out"),
        }
    }

    fn choose_to_explore(&mut self) -> Choice {
        let view = View {
            map: &self.walls,
            at: self.at,
            start: self.brief.start,
            goals: &self.brief.goals,
        };
        match self.search.next(&view) {
            Next::Drive(leap) => Choice::Drive(sides(&[leap])),
            Next::Turn => Choice::Turn,
            Next::Reset => Choice::End(Standing::Done),
            Next::Stuck => give_up("no way leads to a goal"),
        }
    }

    fn choose_to_reach(&self, targets: &[Cell]) -> Choice {
        if targets.contains(&self.at) {
            return Choice::End(Standing::Done);
        }
        if let Some(run) = self.run(Unknown::Closed, self.at, targets) {
            return Choice::Drive(sides(&run));
        }
        // What it sees at the end of the first leap may change the rest.
        match self.run(Unknown::Open, self.at, targets).as_deref() {
            Some([leap, ..]) => Choice::Drive(sides(&[*leap])),
            _ => give_up("no way leads there"),
        }
    }

    /// The cells where a goal is reached, if there are any.
    fn cells_of(&self, goal: Goal) -> Option<Vec<Cell>> {
        match goal {
            Goal::Landmark(Landmark::Start) => Some(vec![self.brief.start]),
            Goal::Landmark(Landmark::Goal) => Some(self.brief.goals.clone()),
            Goal::Landmark(Landmark::Numbered(_)) => None,
            Goal::Place(id) => {
                let cell = self.brief.grid.cells().nth(id as usize)?;
                Some(vec![cell])
            }
        }
    }

    fn id(&self, cell: Cell) -> u32 {
        self.brief.grid.index(cell) as u32
    }

    /// The sides of a cell that are known to be open, and what lies there.
    fn open_sides(&self, cell: Cell) -> impl Iterator<Item = Cell> {
        let open = move |side| self.walls.knowledge(cell, side) == Knowledge::Open;
        let sides = Direction::ALL.into_iter().filter(move |side| open(*side));
        sides.filter_map(move |side| self.brief.grid.neighbour(cell, side))
    }

    fn place(&self, cell: Cell) -> MapPlace {
        let landmark = if cell == self.brief.start {
            Some(Landmark::Start)
        } else {
            let is_goal = self.brief.goals.contains(&cell);
            is_goal.then_some(Landmark::Goal)
        };
        MapPlace {
            id: self.id(cell),
            position: Some(middle(cell, self.config.pitch)),
            landmark,
        }
    }
}

/// Places are the cells known to be open to some side, and the start; links are the openings.
impl<S: Search> Mapper for MazeMouse<S> {
    type Observation = CellSight;
    type Error = ObserveError;

    fn observe(&mut self, seen: &CellSight) -> Result<(), ObserveError> {
        self.walls.observe(seen.cell, &seen.rays)?;
        if seen.cell != self.at {
            self.at = seen.cell;
            self.walls.visit(seen.cell);
        }
        Ok(())
    }

    fn map(&self) -> MapView {
        let cells = self.brief.grid.cells();
        let known = cells
            .filter(|cell| *cell == self.brief.start || self.open_sides(*cell).next().is_some());
        let mut map = MapView::default();
        for cell in known {
            map.places.push(self.place(cell));
            let from = self.id(cell);
            let links = self.open_sides(cell).map(|beside| MapLink {
                from,
                to: self.id(beside),
            });
            map.links.extend(links);
        }
        map
    }

    fn belief(&self) -> Vec<Guess> {
        let at = Position::Place(self.id(self.at));
        vec![Guess { at, weight: 1.0 }]
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
        match self.look(robot)? {
            Look::Seen => {}
            Look::Blind => return Ok(Standing::UnderWay),
            Look::Lost(error) => {
                let why = error.to_string();
                return Ok(Standing::GaveUp { why });
            }
        }
        if self.route.is_empty() {
            match self.choose(task) {
                Choice::Drive(sides) => self.route = sides,
                Choice::Turn => {
                    let right = self.whereabouts.0.heading.turned(-FRAC_PI_2);
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
}

impl<S: Search> MazeMouse<S> {
    /// Takes in the walls that are seen from here, once the ranges have not dropped out.
    fn look<R>(&mut self, robot: &mut R) -> Result<Look, R::Error>
    where
        R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
    {
        let cell = self.at;
        for _ in 0..LOOKS {
            drive::look(robot, &mut self.whereabouts, &self.config)?;
            if let Some(scan) = robot.sensing().scan() {
                let middle = middle(cell, self.config.pitch);
                let rays = sight::rays(scan, self.whereabouts.0, middle, &self.config);
                let seen = self.observe(&CellSight { cell, rays });
                return Ok(seen.map_or_else(Look::Lost, |()| Look::Seen));
            }
        }
        Ok(Look::Blind)
    }

    fn turn_to<R>(&mut self, robot: &mut R, heading: Heading) -> Result<Standing, R::Error>
    where
        R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
    {
        let arrival = drive::turn_to(robot, heading, &mut self.whereabouts, &self.config)?;
        Ok(self.standing(arrival, self.at))
    }

    fn leave_by<R>(&mut self, robot: &mut R, side: Direction) -> Result<Standing, R::Error>
    where
        R: Robot<Command = TurnTranslate, Sensing: Ranges + Compass + Rolls>,
    {
        let is_open = self.walls.knowledge(self.at, side) == Knowledge::Open;
        let Some(next) = self.brief.grid.neighbour(self.at, side).filter(|_| is_open) else {
            // The route was planned on hope: look there, and choose another next time.
            self.route.clear();
            return self.turn_to(robot, heading_of(side));
        };
        let target = middle(next, self.config.pitch);
        let arrival = drive::drive_to(robot, target, &mut self.whereabouts, &self.config)?;
        self.at = next;
        self.walls.visit(next);
        Ok(self.standing(arrival, next))
    }

    fn standing(&self, arrival: Arrival, target: Cell) -> Standing {
        match arrival {
            Arrival::Arrived => Standing::UnderWay,
            Arrival::OutOfPatience => Standing::GaveUp {
                why: format!("the robot was not in {target} after {PATIENCE} time steps"),
            },
        }
    }
}

fn give_up(why: &str) -> Choice {
    let why = why.to_owned();
    Choice::End(Standing::GaveUp { why })
}

/// The sides by which some leaps leave their cells, the first last.
fn sides(leaps: &[Leap]) -> Vec<Direction> {
    let sides = leaps
        .iter()
        .flat_map(|leap| (0..leap.cells).map(|_| leap.direction));
    let mut sides: Vec<Direction> = sides.collect();
    sides.reverse();
    sides
}

fn middle(cell: Cell, pitch: f64) -> Point {
    let along = |index: u16| (f64::from(index) + 0.5) * pitch;
    Point::new(along(cell.x), along(cell.y))
}
