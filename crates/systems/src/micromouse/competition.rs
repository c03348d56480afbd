//! Explores as a competition micromouse: explore, prove, and run as fast as possible.
//!
//! [`speed_run`](tolman_planners::speed_run) explains how the mouse decides. Here it keeps its map
//! and its place, and answers each reading of its wall sensors with a direction to drive.
//!
//! ```
//! use tolman_maze::{Cell, Direction, Grid};
//! use tolman_planners::speed_run::{SpeedRunConfig, SpeedRunTimes};
//! use tolman_systems::micromouse::{Brief, competition::{CompetitionMouse, CompetitionNext}};
//!
//! let brief = Brief {
//!     grid: Grid::new(1, 2),
//!     start: Cell::new(0, 0),
//!     heading: Direction::North,
//!     goals: vec![Cell::new(0, 1)],
//! };
//! let config = SpeedRunConfig::classic();
//! let times = SpeedRunTimes::<16>::new(&config)?;
//! let mut mouse = CompetitionMouse::new(&brief, &config, &times)?;
//! let open = |at| Direction::ALL.map(|side| side == at);
//! assert_eq!(mouse.next(open(Direction::North))?, CompetitionNext::Drive(Direction::North));
//! assert_eq!(mouse.next(open(Direction::South))?, CompetitionNext::Drive(Direction::South));
//! let CompetitionNext::Finished(exploration) = mouse.next(open(Direction::North))? else {
//!     return Err("it is home and knows all".into());
//! };
//! assert_eq!((exploration.cells, exploration.verdict), (2, Ok(())));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

use thiserror::Error;
use tolman_maps::wall_map::{CellRay, ClosedCells, ObserveError, TooLarge, WallMap};
use tolman_maze::{Cell, Direction, Knowledge, Walls};
use tolman_planners::speed_run::{
    Decision, ExploreStage, RunStep, SpeedRunCertificate, SpeedRunCertificateError, SpeedRunConfig,
    SpeedRunConfigError, SpeedRunExplorer, SpeedRunTimes,
};
use tolman_planners::{Passages, Unknown};

use super::Brief;

/// Result of an exploration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpeedRunExploration {
    /// Number of moves from cell to cell: from the start to the goal, during the proof, and back to
    /// the start.
    pub cells: u32,
    /// Number of these cells until the mouse was first at a goal.
    pub search_cells: u32,
    /// Number of these cells from the goal until the run was known to be the fastest. The rest is
    /// the way home.
    pub proof_cells: u32,
    /// The run that the mouse found. If no run leads ahead from the start, its heading differs from
    /// that of the [`Brief`]. The mouse then turns clockwise to the next side from which a run
    /// leads to a goal.
    pub certificate: SpeedRunCertificate,
    /// Moves of the found run, each with its beginning and its duration.
    pub run: Vec<RunLeg>,
    /// Verdict of the checker, which sees only the walls that the mouse knows.
    pub verdict: Result<(), SpeedRunCertificateError>,
}

/// A move of a speed run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunLeg {
    /// Move, with the state of the mouse before it.
    pub step: RunStep,
    /// Duration of the move, ms.
    pub time_ms: u32,
}

/// Reason why a maze cannot be explored.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ExploreError {
    /// The mouse's driving parameters are invalid.
    #[error("the configuration of the mouse is invalid; correct this value")]
    Config(#[from] SpeedRunConfigError),
    /// The maze has more than 32 columns or rows.
    #[error("the maze does not fit into the mouse's map; give a smaller one")]
    TooLarge(#[from] TooLarge),
    /// The reading contradicts the map.
    #[error("the reading contradicts the mouse's map")]
    Observation(#[from] ObserveError),
    /// The mouse knows no way to a goal.
    #[error("the mouse's map has no way from {at} to a goal: open a wall")]
    NoWay {
        /// Cell where the mouse is.
        at: Cell,
    },
}

/// Next action of a mouse.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CompetitionNext {
    /// The mouse drives to the next cell on this side.
    Drive(Direction),
    /// The mouse is back at the start, and no run is faster than the one it found.
    Finished(SpeedRunExploration),
}

/// A mouse that looks at the walls of its cell and remembers them all.
#[derive(Clone, Debug)]
pub struct CompetitionMouse<'a, const N: usize> {
    brief: &'a Brief,
    config: &'a SpeedRunConfig,
    times: &'a SpeedRunTimes<N>,
    explorer: SpeedRunExplorer<'a, N>,
    /// Heading of the mouse at the start of its speed run.
    run_heading: Direction,
    walls: WallMap<N>,
    at: Cell,
    heading: Direction,
    cells: u32,
    goal_after: Option<u32>,
    proof_after: Option<u32>,
}

impl<'a, const N: usize> CompetitionMouse<'a, N> {
    /// Returns a mouse at the start without observations. `times` are those of `config`.
    ///
    /// # Errors
    /// If the maze is larger than `N` × `N`.
    pub fn new(
        brief: &'a Brief,
        config: &'a SpeedRunConfig,
        times: &'a SpeedRunTimes<N>,
    ) -> Result<Self, TooLarge> {
        let (at, heading) = (brief.start, brief.heading);
        Ok(Self {
            brief,
            config,
            times,
            explorer: SpeedRunExplorer::new(times, at, heading, &brief.goals),
            run_heading: heading,
            walls: WallMap::new(brief.grid, ClosedCells::Possible)?,
            at,
            heading,
            cells: 0,
            goal_after: None,
            proof_after: None,
        })
    }

    /// Returns the next action in the cell where the mouse stands. `open` says which of its sides
    /// no wall closes, in the order of [`Direction::ALL`]. O(n) for n cells, and a search if the
    /// run hoped for is closed.
    ///
    /// # Errors
    /// If the walls contradict earlier observations, or no way leads to a goal.
    pub fn next(&mut self, open: [bool; 4]) -> Result<CompetitionNext, ExploreError> {
        self.walls.observe(self.at, &rays(open))?;
        loop {
            let decision = self.explorer.decide(&self.walls, self.at, self.heading)?;
            self.note_stage();
            match decision {
                Decision::Drive(side) => return self.drive(side),
                Decision::Finished { run_ms } => {
                    return Ok(CompetitionNext::Finished(self.exploration(run_ms)?));
                }
                Decision::Stuck => self.turn_round()?,
            }
        }
    }

    /// Records the moments at which the mouse was first at a goal, and first knew its run to be the
    /// fastest.
    fn note_stage(&mut self) {
        let stage = self.explorer.stage();
        if stage != ExploreStage::Search {
            self.goal_after.get_or_insert(self.cells);
        }
        if stage == ExploreStage::Home {
            self.proof_after.get_or_insert(self.cells);
        }
    }

    /// Turns to the next side that may be open, clockwise, because no run leads ahead from the
    /// start. A person puts the mouse down in that direction.
    fn turn_round(&mut self) -> Result<(), ExploreError> {
        let start = self.brief.start;
        let mut next = self.run_heading.right();
        while next != self.brief.heading && self.walls.knowledge(start, next) == Knowledge::Wall {
            next = next.right();
        }
        if next == self.brief.heading {
            return Err(ExploreError::NoWay { at: self.at });
        }
        self.run_heading = next;
        self.explorer = SpeedRunExplorer::new(self.times, start, next, &self.brief.goals);
        Ok(())
    }

    fn drive(&mut self, side: Direction) -> Result<CompetitionNext, ExploreError> {
        let next = self.walls.grid().neighbour(self.at, side);
        self.at = next.ok_or(ExploreError::NoWay { at: self.at })?;
        self.heading = side;
        self.cells += 1;
        Ok(CompetitionNext::Drive(side))
    }

    fn exploration(&self, run_ms: u32) -> Result<SpeedRunExploration, TooLarge> {
        let Brief {
            start, ref goals, ..
        } = *self.brief;
        let known = Passages::new(&self.walls, Unknown::Closed)?;
        let run: Vec<RunLeg> = self
            .explorer
            .planner()
            .run(&known)
            .map(|step| RunLeg {
                step,
                time_ms: self.times.of(step.run_move).unwrap_or(0),
            })
            .collect();
        let certificate = SpeedRunCertificate {
            start,
            heading: self.run_heading,
            moves: run.iter().map(|leg| leg.step.run_move).collect(),
            time_ms: run_ms,
        };
        let proof_after = self.proof_after.unwrap_or(self.cells);
        Ok(SpeedRunExploration {
            cells: self.cells,
            search_cells: self.goal_after.unwrap_or(proof_after),
            proof_cells: proof_after - self.goal_after.unwrap_or(proof_after),
            verdict: certificate.check(&self.walls, self.config, goals),
            certificate,
            run,
        })
    }
}

/// Returns the rays of sensors that look no farther than the walls of their own cell.
fn rays(open: [bool; 4]) -> [CellRay; 4] {
    Direction::ALL.map(|side| match open[side.index()] {
        true => CellRay::out_of_range(side, 1),
        false => CellRay::to_wall(side, 0),
    })
}
