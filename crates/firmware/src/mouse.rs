use tolman_maps::wall_map::{CellRay, ClosedCells, TooLarge, WallMap};
use tolman_maze::{Cell, Direction, Grid, Walls};
use tolman_planners::speed_run::{Decision, RunStep, SpeedRunExplorer, SpeedRunTimes};
use tolman_planners::{Passages, PoseKnowledge, PoseSet, Unknown};

/// Number of columns and of rows of the maze, as in the classic competition.
pub const MAZE: usize = 16;

/// Maximum number of walls that can be forgotten after a crash.
const LOG: usize = 32;

/// Number of observations that are forgotten after a crash.
const DOUBTFUL: usize = 4;

/// Number of cells that a lost mouse drives before it asks for help.
const PATIENCE: u8 = 60;

/// Cell and direction in which the mouse starts.
const START: (Cell, Direction) = (Cell::new(0, 0), Direction::North);

/// The mouse: its knowledge and its task. Directions to and from it are relative to its heading:
/// north is ahead, east is to its right.
///
/// ```
/// use tolman_firmware::{Command, Mouse, Sides};
/// use tolman_maze::{Cell, Direction};
/// use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};
///
/// // Goals are told, walls are not.
/// let times = SpeedRunTimes::new(&SpeedRunConfig::classic()).unwrap();
/// let goals = [Cell::new(1, 1)];
/// let mut mouse = Mouse::new(&times, &goals)?;
/// let open = |ahead, right| Sides { left: false, ahead, right };
/// assert_eq!(mouse.arrive(open(true, false))?, Command::Drive(Direction::North));
/// assert_eq!(mouse.arrive(open(false, true))?, Command::Drive(Direction::East));
/// # Ok::<(), tolman_maps::wall_map::TooLarge>(())
/// ```
#[derive(Clone, Debug)]
pub struct Mouse<'a> {
    times: &'a SpeedRunTimes<MAZE>,
    goals: &'a [Cell],
    walls: WallMap<MAZE, LOG>,
    task: Task<'a>,
}

/// Task at present. There is only one at a time, so that all tasks can share the same memory.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "there is no heap to put it on")]
enum Task<'a> {
    Explore {
        explorer: SpeedRunExplorer<'a, MAZE>,
        cell: Cell,
        heading: Direction,
    },
    Localize {
        poses: PoseSet<MAZE>,
        /// Number of cells that the mouse may still drive to localize.
        patience: u8,
    },
}

/// Reading of the wall sensors: which sides of the cell are open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sides {
    /// Whether the left side is open.
    pub left: bool,
    /// Whether the side in front is open.
    pub ahead: bool,
    /// Whether the right side is open.
    pub right: bool,
}

/// A command to the motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Turn to this side, where north is ahead, drive to the next cell and look.
    Drive(Direction),
    /// Stay: the mouse is back at the start and knows the fastest run.
    Ready {
        /// Duration of the fastest run, ms.
        run_ms: u16,
    },
    /// Stay: the known walls do not determine the mouse's place, or contradict its readings. Carry
    /// it back to the start.
    CarryBack,
    /// Stay: by the known walls, no way leads to the goal.
    GiveUp,
}

impl<'a> Mouse<'a> {
    /// Returns a mouse at the start of a maze that it has never seen.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn new(times: &'a SpeedRunTimes<MAZE>, goals: &'a [Cell]) -> Result<Self, TooLarge> {
        let grid = Grid::new(MAZE as u16, MAZE as u16);
        Ok(Self {
            times,
            goals,
            walls: WallMap::new(grid, ClosedCells::Possible)?,
            task: explore(times, goals, START),
        })
    }

    /// Returns the next command, given the mouse's readings on arrival in a cell.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn arrive(&mut self, seen: Sides) -> Result<Command, TooLarge> {
        if let Task::Localize { poses, patience } = &mut self.task {
            for (side, is_open) in seen.all() {
                poses.see(&self.walls, side, is_open);
            }
            match poses.location() {
                PoseKnowledge::Found { cell, heading } => {
                    self.task = explore(self.times, self.goals, (cell, heading));
                }
                PoseKnowledge::Among { .. } => {
                    return Ok(look_around(poses, patience, &self.walls));
                }
                PoseKnowledge::Nowhere => return Ok(Command::CarryBack),
            }
        }
        let Task::Explore {
            explorer,
            cell,
            heading,
        } = &mut self.task
        else {
            return Ok(Command::CarryBack);
        };
        if self.walls.observe(*cell, &seen.rays(*heading)).is_err() {
            return Ok(Command::CarryBack);
        }
        Ok(match explorer.decide(&self.walls, *cell, *heading)? {
            Decision::Drive(direction) => {
                let side = direction.seen_from(*heading);
                *cell = self
                    .walls
                    .grid()
                    .neighbour(*cell, direction)
                    .unwrap_or(*cell);
                *heading = direction;
                Command::Drive(side)
            }
            Decision::Finished { run_ms } => Command::Ready { run_ms },
            Decision::Stuck => Command::GiveUp,
        })
    }

    /// Tells the mouse that it has crashed and lost its way. Its last observations may be wrong and
    /// are forgotten. It must stand in a cell, with an open side behind it.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn crash(&mut self) -> Result<(), TooLarge> {
        self.walls.undo(DOUBTFUL);
        self.task = Task::Localize {
            poses: PoseSet::anywhere(self.walls.grid())?,
            patience: PATIENCE,
        };
        Ok(())
    }

    /// Tells the mouse that it was carried back to the start. Its last observations are forgotten,
    /// because they may be wrong.
    pub fn carried_back(&mut self) {
        self.walls.undo(DOUBTFUL);
        self.task = explore(self.times, self.goals, START);
    }

    /// Calls `each` with the moves of the fastest run through walls that are known to be open. Call
    /// it when the mouse is ready.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn run(&self, each: impl FnMut(RunStep)) -> Result<(), TooLarge> {
        if let Task::Explore { explorer, .. } = &self.task {
            let known = Passages::new(&self.walls, Unknown::Closed)?;
            explorer.planner().run(&known).for_each(each);
        }
        Ok(())
    }
}

fn explore<'a>(
    times: &'a SpeedRunTimes<MAZE>,
    goals: &'a [Cell],
    (cell, heading): (Cell, Direction),
) -> Task<'a> {
    Task::Explore {
        explorer: SpeedRunExplorer::new(times, START.0, START.1, goals),
        cell,
        heading,
    }
}

/// Returns the command that leads to a place where the possible poses look different.
fn look_around(poses: &mut PoseSet<MAZE>, patience: &mut u8, walls: &impl Walls) -> Command {
    let next = patience.checked_sub(1).zip(poses.next_drive(walls));
    next.map_or(Command::CarryBack, |(left, side)| {
        *patience = left;
        poses.drive(walls, side);
        Command::Drive(side)
    })
}

impl Sides {
    fn all(self) -> [(Direction, bool); 3] {
        [
            (Direction::North, self.ahead),
            (Direction::East, self.right),
            (Direction::West, self.left),
        ]
    }

    fn rays(self, heading: Direction) -> [CellRay; 3] {
        let ray = |direction, is_open| {
            if is_open {
                CellRay::out_of_range(direction, 1)
            } else {
                CellRay::to_wall(direction, 0)
            }
        };
        self.all()
            .map(|(side, is_open)| ray(heading.turned(side), is_open))
    }
}
