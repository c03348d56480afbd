//! Applies the rules of the paper's test program, taken literally.

use tolman_maze::{Cell, Direction, Maze};
use tolman_systems::micromouse::{Brief, Movement, Order, OrderError, Rotation, Sight};

/// Maximum number of steps of both runs together.
pub const MAX_STEPS: u32 = 1000;

/// Maximum number of cells of one movement.
const MOST_CELLS: i32 = 3;

/// Moves one mouse through one maze and keeps the time.
///
/// The rules are those of the test program that came with the paper's task; they are independent of
/// how any mouse thinks. Every order counts as a step before it is carried out, and an order beyond
/// the last step is not carried out. The maze marks the goal; in files of the paper's format it is
/// the middle 2 × 2.
///
/// ```
/// use tolman_arena::micromouse::{Referee, Ruling};
/// use tolman_systems::micromouse::Order;
///
/// let maze = tolman_maze::read("+---+---+\n| G   G |\n+   +   +\n| S |   |\n+---+---+\n")?.maze;
/// let mut referee = Referee::new(&maze)?;
/// assert_eq!(referee.sight().front, 1);
/// referee.take(Order::new(0, 1))?;
/// assert_eq!(referee.take(Order::RESET)?, Ruling::RunTwo);
/// assert_eq!(referee.take(Order::new(0, 3))?, Ruling::Finished);
/// assert_eq!(referee.verdict().score(), Some(2.0 / 30.0 + 1.0));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Referee<'a> {
    maze: &'a Maze,
    start: (Cell, Direction),
    cell: Cell,
    heading: Direction,
    /// Number of orders so far.
    steps: u32,
    stage: Stage,
    verdict: ScoreSheet,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The first run, before a movement has ended on a goal.
    Seeking,
    /// The first run, after a movement has ended on a goal.
    Exploring,
    /// The second run.
    RunTwo,
    Over,
}

/// Result of an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ruling {
    /// The mouse was moved, as far as the walls let it.
    Moved,
    /// The mouse stands at the start again: the second run begins.
    RunTwo,
    /// A reset was refused, because the goal was not reached yet or the second run has begun. The
    /// step counts.
    ResetRefused,
    /// The movement ended on a goal in the second run: the trial is over.
    Finished,
    /// The order was ignored, because no step is left or the runs are over.
    Over,
}

/// Records of the referee.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ScoreSheet {
    /// Number of steps of the first run, the reset included, or `None` before it ends.
    pub run_1: Option<u32>,
    /// Number of steps of the second run, or `None` before it ends.
    pub run_2: Option<u32>,
}

impl ScoreSheet {
    /// Returns the score, a thirtieth of the first run's steps plus the second's, or `None` if the
    /// mouse did not finish.
    #[must_use]
    pub fn score(&self) -> Option<f64> {
        Some(f64::from(self.run_1?) / 30.0 + f64::from(self.run_2?))
    }
}

/// Reason why a maze cannot be refereed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RefereeError {
    /// The maze does not say where the mouse starts.
    #[error("the maze has no start: mark a cell with S")]
    NoStart,
    /// The maze is invalid.
    #[error(transparent)]
    Maze(#[from] tolman_maze::CheckError),
}

/// Returns the mouse's initial knowledge of `maze`: its size, its start and its goals.
///
/// # Errors
/// [`RefereeError::NoStart`] if the maze has no start.
pub fn brief(maze: &Maze) -> Result<Brief, RefereeError> {
    let (start, heading) = maze.start().ok_or(RefereeError::NoStart)?;
    Ok(Brief {
        grid: maze.grid(),
        start,
        heading,
        goals: maze.goals().to_vec(),
    })
}

impl<'a> Referee<'a> {
    /// Returns a referee whose mouse is at the start and has made no step.
    ///
    /// # Errors
    /// If the maze has no start, or [`Maze::check`] refuses it.
    pub fn new(maze: &'a Maze) -> Result<Self, RefereeError> {
        maze.check()?;
        let start = maze.start().ok_or(RefereeError::NoStart)?;
        Ok(Self {
            maze,
            start,
            cell: start.0,
            heading: start.1,
            steps: 0,
            stage: Stage::Seeking,
            verdict: ScoreSheet::default(),
        })
    }

    /// Returns the reading of the sensors: the number of open cells to the left, ahead and to the
    /// right, up to the next wall.
    #[must_use]
    pub fn sight(&self) -> Sight {
        let open = |direction| {
            let mut at = self.cell;
            let mut open = 0;
            while let Some(next) = self.maze.beside(at, direction) {
                at = next;
                open += 1;
            }
            open
        };
        Sight {
            left: open(self.heading.left()),
            front: open(self.heading),
            right: open(self.heading.right()),
        }
    }

    /// Carries out one order.
    ///
    /// # Errors
    /// If the test program would have broken off; the order has no effect then.
    pub fn take(&mut self, order: Order) -> Result<Ruling, OrderError> {
        if let (Rotation::Degrees(degrees), Movement::Reset(_)) = (order.rotation, order.movement) {
            return Err(OrderError::HalfReset { degrees });
        }
        if self.is_over() {
            return Ok(Ruling::Over);
        }
        self.steps += 1;
        let cells = match order.movement {
            Movement::Reset(_) => return Ok(self.reset()),
            Movement::Cells(cells) => cells.clamp(-MOST_CELLS, MOST_CELLS),
        };
        self.heading = match order.rotation {
            Rotation::Degrees(-90) => self.heading.left(),
            Rotation::Degrees(90) => self.heading.right(),
            // Whatever else it says, the mouse does not turn, and moves.
            Rotation::Degrees(_) | Rotation::Reset(_) => self.heading,
        };
        let direction = if cells < 0 {
            self.heading.opposite()
        } else {
            self.heading
        };
        for _ in 0..cells.abs() {
            // A wall stops the mouse where it is; the rest of the movement is lost.
            let Some(next) = self.maze.beside(self.cell, direction) else {
                break;
            };
            self.cell = next;
        }
        Ok(self.arrive())
    }

    fn reset(&mut self) -> Ruling {
        if self.stage != Stage::Exploring {
            return Ruling::ResetRefused;
        }
        (self.cell, self.heading) = self.start;
        self.verdict.run_1 = Some(self.steps);
        self.stage = Stage::RunTwo;
        Ruling::RunTwo
    }

    /// Judges the end of a movement; only there does the goal count.
    fn arrive(&mut self) -> Ruling {
        if !self.maze.goals().contains(&self.cell) {
            return Ruling::Moved;
        }
        match (self.stage, self.verdict.run_1) {
            (Stage::RunTwo, Some(run_1)) => {
                self.verdict.run_2 = Some(self.steps - run_1);
                self.stage = Stage::Over;
                Ruling::Finished
            }
            _ => {
                self.stage = Stage::Exploring;
                Ruling::Moved
            }
        }
    }

    /// Returns whether the runs are over or no step is left.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.stage == Stage::Over || self.steps >= MAX_STEPS
    }

    /// Returns the cell of the mouse, and its heading.
    #[must_use]
    pub const fn pose(&self) -> (Cell, Direction) {
        (self.cell, self.heading)
    }

    /// Returns the number of orders that counted so far.
    #[must_use]
    pub const fn steps(&self) -> u32 {
        self.steps
    }

    /// Returns the score sheet so far.
    #[must_use]
    pub const fn verdict(&self) -> ScoreSheet {
        self.verdict
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tolman_maze::Grid;

    /// Returns a maze of 4 × 4 cells without inner walls; the goal is the middle 2 × 2.
    fn plain() -> Maze {
        let mut maze = Maze::open(Grid::new(4, 4));
        maze.set_start(Some((Cell::new(0, 0), Direction::North)));
        let middle = maze.grid().middle().collect();
        maze.set_goals(middle);
        maze
    }

    fn after(maze: &Maze, orders: &[Order]) -> (Cell, Direction, Vec<Ruling>) {
        let mut referee = Referee::new(maze).unwrap();
        let events = orders.iter().map(|order| referee.take(*order).unwrap());
        let events = events.collect();
        let (cell, heading) = referee.pose();
        (cell, heading, events)
    }

    #[test]
    fn the_sensors_read_left_front_right_up_to_the_wall_before_the_movement() {
        let maze = plain();
        let mut referee = Referee::new(&maze).unwrap();
        let sight = |left, front, right| Sight { left, front, right };
        assert_eq!(referee.sight(), sight(0, 3, 3));
        referee.take(Order::new(90, 1)).unwrap();
        assert_eq!(referee.sight(), sight(3, 2, 0));
        // Driving back changes the place, not the heading.
        referee.take(Order::new(0, -1)).unwrap();
        assert_eq!(referee.sight(), sight(3, 3, 0));
    }

    #[test]
    fn another_rotation_is_ignored_but_the_movement_happens() {
        for degrees in [180, -180, 45, 91, 360, i32::MIN] {
            let (cell, heading, _) = after(&plain(), &[Order::new(degrees, 2)]);
            assert_eq!((cell, heading), (Cell::new(0, 2), Direction::North));
        }
        let half = Order {
            rotation: Order::RESET.rotation,
            movement: Movement::Cells(2),
        };
        let (cell, heading, events) = after(&plain(), &[half]);
        assert_eq!((cell, heading), (Cell::new(0, 2), Direction::North));
        assert_eq!(events, [Ruling::Moved]);
    }

    #[test]
    fn a_movement_is_three_cells_at_most() {
        let mut maze = Maze::open(Grid::new(1, 9));
        maze.set_start(Some((Cell::new(0, 4), Direction::North)));
        maze.set_goals(vec![Cell::new(0, 8)]);
        for (cells, y) in [(4, 7), (99, 7), (i32::MAX, 7), (-4, 1), (i32::MIN, 1)] {
            let (cell, ..) = after(&maze, &[Order::new(0, cells)]);
            assert_eq!(cell, Cell::new(0, y), "{cells}");
        }
    }

    #[test]
    fn a_wall_stops_the_mouse_and_the_cells_already_made_are_kept() {
        let mut maze = plain();
        maze.set_wall(Cell::new(0, 1), Direction::North, true);
        let (cell, ..) = after(&maze, &[Order::new(0, 3)]);
        assert_eq!(cell, Cell::new(0, 1));
        let (cell, heading, _) = after(&maze, &[Order::new(90, 2), Order::new(0, -3)]);
        assert_eq!((cell, heading), (Cell::new(0, 0), Direction::East));
    }

    #[test]
    fn the_goal_counts_only_where_a_movement_ends() {
        // Through the goal, without a stop on it: the reset is refused and the mouse stays where it
        // is.
        let (cell, _, events) = after(
            &plain(),
            &[Order::new(0, 1), Order::new(90, 3), Order::RESET],
        );
        assert_eq!(cell, Cell::new(3, 1));
        assert_eq!(events, [Ruling::Moved, Ruling::Moved, Ruling::ResetRefused]);
        // With a stop on it, and away again: the first run may end anywhere.
        let (cell, heading, events) = after(
            &plain(),
            &[
                Order::new(0, 1),
                Order::new(90, 2),
                Order::new(0, 1),
                Order::RESET,
            ],
        );
        assert_eq!((cell, heading), (Cell::new(0, 0), Direction::North));
        assert_eq!(events[3], Ruling::RunTwo);
    }

    #[test]
    fn every_order_counts_the_reset_for_the_first_run_the_arrival_for_the_second() {
        let maze = plain();
        let mut referee = Referee::new(&maze).unwrap();
        let play = [
            (Order::RESET, Ruling::ResetRefused),
            (Order::new(0, 0), Ruling::Moved),
            (Order::new(0, 1), Ruling::Moved),
            (Order::new(90, 1), Ruling::Moved),
            (Order::RESET, Ruling::RunTwo),
            (Order::RESET, Ruling::ResetRefused),
            (Order::new(0, 2), Ruling::Moved),
            (Order::new(90, 1), Ruling::Finished),
            (Order::new(90, 1), Ruling::Over),
        ];
        for (order, event) in play {
            assert_eq!(referee.take(order), Ok(event));
        }
        let verdict = ScoreSheet {
            run_1: Some(5),
            run_2: Some(3),
        };
        assert_eq!((referee.verdict(), referee.steps()), (verdict, 8));
        assert_eq!(verdict.score(), Some(5.0 / 30.0 + 3.0));
    }

    #[test]
    fn a_turn_without_a_movement_on_the_goal_counts_as_an_arrival() {
        let maze = {
            let mut maze = plain();
            maze.set_start(Some((Cell::new(1, 1), Direction::North)));
            maze
        };
        let turn = Order::new(90, 0);
        let (.., events) = after(&maze, &[Order::RESET, turn, Order::RESET, turn]);
        let expect = [
            Ruling::ResetRefused,
            Ruling::Moved,
            Ruling::RunTwo,
            Ruling::Finished,
        ];
        assert_eq!(events, expect);
    }

    #[test]
    fn after_a_thousand_steps_nothing_counts() {
        let maze = plain();
        let mut referee = Referee::new(&maze).unwrap();
        for _ in 0..MAX_STEPS - 2 {
            referee.take(Order::new(0, 0)).unwrap();
        }
        referee.take(Order::new(0, 1)).unwrap();
        assert!(!referee.is_over());
        // The thousandth order is still carried out, the next is not.
        assert_eq!(referee.take(Order::new(90, 1)), Ok(Ruling::Moved));
        assert!(referee.is_over());
        assert_eq!(referee.take(Order::RESET), Ok(Ruling::Over));
        assert_eq!(referee.verdict().score(), None);
        assert_eq!(referee.pose().0, Cell::new(1, 1));
    }

    #[test]
    fn half_a_reset_is_an_error() {
        let maze = plain();
        let mut referee = Referee::new(&maze).unwrap();
        let half = Order {
            rotation: Rotation::Degrees(0),
            movement: Order::RESET.movement,
        };
        assert_eq!(
            referee.take(half),
            Err(OrderError::HalfReset { degrees: 0 })
        );
        assert_eq!(referee.steps(), 0);
    }

    #[test]
    fn a_maze_without_a_start_is_refused() {
        let mut maze = plain();
        maze.set_start(None);
        assert_eq!(Referee::new(&maze).unwrap_err(), RefereeError::NoStart);
    }
}
