use core::borrow::BorrowMut;

use tolman_maps::wall_map::{CellRay, ClosedCells, ObserveError, TooLarge, WallMap};
use tolman_maze::{Cell, Direction, Grid, Knowledge, Walls};
use tolman_planners::speed_run::{
    CellTimes, Decision, RunStep, SpeedRunExplorer, SpeedRunMap, SpeedRunTimes,
};
use tolman_planners::{Passages, PoseKnowledge, PoseSet, Unknown};

/// Number of columns and of rows of a classic maze.
pub const MAZE: usize = 16;

/// Maximum number of walls that a lost mouse can forget.
const LOG: usize = 16;

/// Number of last observations that a lost mouse forgets, because it may have been lost already.
const DOUBTFUL: usize = 4;

/// Number of cells that a lost mouse drives before it begins a new map.
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
/// let mut mouse = Mouse::new(&times, &goals);
/// let open = |ahead, right| Sides { left: false, ahead, right };
/// assert_eq!(mouse.arrive(open(true, false))?, Command::Drive(Direction::North));
/// assert_eq!(mouse.arrive(open(false, true))?, Command::Drive(Direction::East));
/// # Ok::<(), tolman_maps::wall_map::TooLarge>(())
/// ```
#[derive(Clone, Debug)]
pub struct Mouse<'a, const N: usize = MAZE, C: CellTimes = [u16; 12], M = SpeedRunMap<N, C>> {
    walls: WallMap<N, LOG>,
    /// Whether walls may be wrong: this is the first map, or the mouse was lost since it began it.
    is_doubtful: bool,
    explorer: SpeedRunExplorer<'a, N, C, M>,
    place: Place<N>,
}

/// Knowledge of where the mouse is.
#[derive(Clone, Debug)]
enum Place<const N: usize> {
    Known {
        cell: Cell,
        heading: Direction,
    },
    Lost {
        poses: PoseSet<N>,
        /// Number of cells that the mouse may still drive to find its place.
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
        run_ms: u32,
    },
    /// Stay: the known walls do not determine the mouse's place, or fit its readings nowhere. Carry
    /// it back to the start, where it begins a new map.
    CarryBack,
    /// Stay: no way leads to the goal. A mouse that may have been lost says so only if it finds the
    /// same in a second map.
    GiveUp,
}

impl<'a> Mouse<'a> {
    /// Returns a mouse at the start of a classic maze that it has never seen.
    #[must_use]
    pub const fn new(times: &'a SpeedRunTimes<MAZE>, goals: &'a [Cell]) -> Self {
        Self::with_map(times, goals, SpeedRunMap::new())
    }
}

impl<'a, const N: usize, C: CellTimes, M: BorrowMut<SpeedRunMap<N, C>>> Mouse<'a, N, C, M> {
    /// The map of a maze that the mouse has never seen.
    const UNSEEN: WallMap<N, LOG> =
        match WallMap::new(Grid::new(N as u16, N as u16), ClosedCells::Possible) {
            Ok(map) => map,
            Err(_) => panic!("the map is as large as the maze"),
        };

    /// Returns a mouse at the start of a maze of `N` × `N` cells that it has never seen. The map
    /// of its runs is its own or lent, [new](SpeedRunMap::new) or [cleared](SpeedRunMap::clear).
    #[must_use]
    pub const fn with_map(times: &'a SpeedRunTimes<N>, goals: &'a [Cell], map: M) -> Self {
        Self {
            walls: Self::UNSEEN,
            is_doubtful: true,
            explorer: SpeedRunExplorer::with_map(times, START.0, START.1, goals, map),
            place: Place::Known {
                cell: START.0,
                heading: START.1,
            },
        }
    }

    /// Returns the next command, given the mouse's readings on arrival in a cell. If they
    /// contradict its map, the mouse is elsewhere or a wall is wrong: it forgets its last
    /// observations and looks for its place.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn arrive(&mut self, seen: Sides) -> Result<Command, TooLarge> {
        if self.contradicts(seen) {
            self.crash()?;
        }
        if let Place::Lost { poses, patience } = &mut self.place {
            for (side, is_open) in seen.all() {
                poses.see(&self.walls, side, is_open);
            }
            match poses.location() {
                PoseKnowledge::Found { cell, heading } => self.found_at(cell, heading),
                PoseKnowledge::Among { .. } => {
                    let side = look_around(poses, patience, &self.walls);
                    return Ok(side.map_or_else(|| self.begin_again(), Command::Drive));
                }
                PoseKnowledge::Nowhere => return Ok(self.begin_again()),
            }
        }
        let Place::Known { cell, heading } = &mut self.place else {
            return Ok(self.begin_again());
        };
        if self.walls.observe(*cell, &seen.rays(*heading)).is_err() {
            return Ok(self.begin_again());
        }
        Ok(match self.explorer.decide(&self.walls, *cell, *heading)? {
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
            // Every maze has a way to its goal, so the mouse doubts its map first.
            Decision::Stuck if self.is_doubtful => self.begin_again(),
            Decision::Stuck => Command::GiveUp,
        })
    }

    /// Returns whether a mouse that believes to know its place and sees this is elsewhere, or has
    /// a wrong map.
    fn contradicts(&self, seen: Sides) -> bool {
        let Place::Known { cell, heading } = self.place else {
            return false;
        };
        let differs = |(side, is_open): (Direction, bool)| {
            let known = self.walls.knowledge(cell, heading.turned(side));
            known == Knowledge::of_standing(is_open)
        };
        seen.all().into_iter().any(differs)
    }

    /// Takes up the exploration. The mouse may never have been where it believed to be, so it goes
    /// to the goal once more.
    const fn found_at(&mut self, cell: Cell, heading: Direction) {
        self.place = Place::Known { cell, heading };
        self.explorer.restart();
    }

    /// Forgets all walls, because some are wrong or do not tell where the mouse is.
    fn begin_again(&mut self) -> Command {
        self.walls = Self::UNSEEN;
        self.is_doubtful = false;
        self.found_at(START.0, START.1);
        Command::CarryBack
    }

    /// Tells the mouse that it has crashed and lost its way. Its last observations may be wrong and
    /// are forgotten. It must stand in a cell, with an open side behind it.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn crash(&mut self) -> Result<(), TooLarge> {
        self.walls.undo(DOUBTFUL);
        self.is_doubtful = true;
        let patience = match self.place {
            Place::Known { .. } => PATIENCE,
            Place::Lost { patience, .. } => patience.saturating_sub(1),
        };
        let poses = PoseSet::anywhere(self.walls.grid())?;
        self.place = Place::Lost { poses, patience };
        Ok(())
    }

    /// Tells the mouse that it was carried back to the start. Its last observations are forgotten,
    /// because they may be wrong.
    pub fn carried_back(&mut self) {
        self.walls.undo(DOUBTFUL);
        self.found_at(START.0, START.1);
    }

    /// Returns the mouse's map, to be saved.
    #[must_use]
    pub const fn walls(&self) -> &impl Walls {
        &self.walls
    }

    /// Puts the mouse back to the start with a map that was saved: each wall as `known` says.
    ///
    /// # Errors
    /// If the map contradicts itself, which leaves a mouse with no map.
    pub fn restore(
        &mut self,
        known: impl Fn(Cell, Direction) -> Knowledge,
    ) -> Result<(), ObserveError> {
        self.walls = Self::UNSEEN;
        self.is_doubtful = true;
        self.found_at(START.0, START.1);
        for cell in self.walls.grid().cells() {
            for side in Direction::ALL {
                let ray = match known(cell, side) {
                    Knowledge::Unknown => continue,
                    Knowledge::Open => CellRay::out_of_range(side, 1),
                    Knowledge::Wall => CellRay::to_wall(side, 0),
                };
                if let Err(error) = self.walls.observe(cell, &[ray]) {
                    self.walls = Self::UNSEEN;
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    /// Returns whether the mouse looks for its place.
    #[must_use]
    pub const fn is_lost(&self) -> bool {
        matches!(self.place, Place::Lost { .. })
    }

    /// Calls `each` with the moves of the fastest run through walls that are known to be open. Call
    /// it when the mouse is ready.
    ///
    /// # Errors
    /// Never, because the map has room for the maze.
    pub fn run(&self, each: impl FnMut(RunStep)) -> Result<(), TooLarge> {
        let known = Passages::new(&self.walls, Unknown::Closed)?;
        self.explorer.planner().run(&known).for_each(each);
        Ok(())
    }
}

/// Returns the side by which the mouse leaves for a place where the possible poses look different.
fn look_around<const N: usize>(
    poses: &mut PoseSet<N>,
    patience: &mut u8,
    walls: &impl Walls,
) -> Option<Direction> {
    *patience = patience.checked_sub(1)?;
    let side = poses.next_drive(walls)?;
    poses.drive(walls, side);
    Some(side)
}

impl Sides {
    /// Returns the reading of sensors that say of a side whether it is open; north is ahead.
    pub fn read(is_open: impl Fn(Direction) -> bool) -> Self {
        Self {
            left: is_open(Direction::West),
            ahead: is_open(Direction::North),
            right: is_open(Direction::East),
        }
    }

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
