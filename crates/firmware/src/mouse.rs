use tolman_maps::wall_map::{CellRay, ClosedCells, TooLarge, WallMap};
use tolman_maze::{Cell, Direction, Grid, Walls};
use tolman_planners::speed_run::{Decision, RunStep, SpeedRunExplorer, SpeedRunTimes};
use tolman_planners::{Passages, PoseKnowledge, PoseSet, Unknown};

/// Columns and rows of the maze: those of the classic competition.
pub const MAZE: usize = 16;

/// How many walls can be forgotten after a crash.
const LOG: usize = 32;

/// How many observations are forgotten after a crash.
const DOUBTFUL: usize = 4;

/// How many cells a lost mouse drives before it asks for help.
const PATIENCE: u8 = 60;

/// Where the mouse is put at the start, and where it looks then.
const START: (Cell, Direction) = (Cell::new(0, 0), Direction::North);

/// The mouse: what it knows and what it is doing. Directions to and from it are its own: north is
/// ahead.
#[derive(Clone, Debug)]
pub struct Mouse<'a> {
    times: &'a SpeedRunTimes<MAZE>,
    goals: &'a [Cell],
    walls: WallMap<MAZE, LOG>,
    task: Task<'a>,
}

/// One thing at a time, so that both can have the same memory.
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
        /// How many cells it may still drive for that.
        patience: u8,
    },
}

/// What the wall sensors say: which sides of the cell are open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sides {
    /// On the left.
    pub left: bool,
    /// In front.
    pub ahead: bool,
    /// On the right.
    pub right: bool,
}

/// What the motors shall do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Turn to this side, north being ahead, drive to the next cell and look.
    Drive(Direction),
    /// Stay: the mouse is back at the start and knows the fastest run, which takes so long.
    Ready {
        /// Milliseconds.
        run_ms: u16,
    },
    /// Stay: the walls known do not say where the mouse is, or contradict what it sees. It has to
    /// be carried back to the start.
    CarryBack,
    /// Stay: no way leads to the goal as far as the walls are known.
    GiveUp,
}

impl<'a> Mouse<'a> {
    /// Returns a mouse in the start of a maze that it has never seen.
    ///
    /// # Errors
    /// Never, as the maze is as large as the map.
    pub fn new(times: &'a SpeedRunTimes<MAZE>, goals: &'a [Cell]) -> Result<Self, TooLarge> {
        let grid = Grid::new(MAZE as u16, MAZE as u16);
        Ok(Self {
            times,
            goals,
            walls: WallMap::new(grid, ClosedCells::Possible)?,
            task: explore(times, goals, START),
        })
    }

    /// Returns what to do after what is seen on arrival in a cell.
    ///
    /// # Errors
    /// Never, as the maze is as large as the map.
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

    /// Says that the mouse has crashed and lost its way. What it saw last may be wrong and is
    /// forgotten. It has to stand in some cell, with an open side behind it.
    ///
    /// # Errors
    /// Never, as the maze is as large as the map.
    pub fn crash(&mut self) -> Result<(), TooLarge> {
        self.walls.undo(DOUBTFUL);
        self.task = Task::Localize {
            poses: PoseSet::anywhere(self.walls.grid())?,
            patience: PATIENCE,
        };
        Ok(())
    }

    /// Says that the mouse was carried back to the start. What it saw last is forgotten, in case it
    /// was wrong.
    pub fn carried_back(&mut self) {
        self.walls.undo(DOUBTFUL);
        self.task = explore(self.times, self.goals, START);
    }

    /// Hands out the moves of the fastest run on the walls known to be open, once the mouse is
    /// ready.
    ///
    /// # Errors
    /// Never, as the maze is as large as the map.
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

/// Drives to where poses that are left look different.
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
