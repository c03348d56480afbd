//! The simulator: one command in, one reply out.

use tolman_maze::{Cell, Maze};
use tolman_planners::lattice::{Gate, LatticeHeading, LatticePoint, LatticePose};

use super::{Score, Unit};

/// A mouse in a maze, moved by the commands of mms.
///
/// As in mms, the mouse starts in the south-west cell and looks north, and the goal is the middle
/// of the maze. Marks of the maze are ignored.
#[derive(Clone, Debug)]
pub struct Simulator<'a> {
    maze: &'a Maze,
    goal: Vec<Cell>,
    pose: LatticePose,
    half_steps: Score,
    cells: Score,
    movements: u64,
    crashes: u64,
    invalid: u64,
    /// Number of movements after which the reset button is pressed.
    reset_after: Option<u64>,
}

/// Directions of the commands that ask for walls: eighths of a circle, clockwise from ahead.
const WALLS: [(&str, i8); 8] = [
    ("wallFront", 0),
    ("wallFrontRight", 1),
    ("wallRight", 2),
    ("wallBackRight", 3),
    ("wallBack", 4),
    ("wallBackLeft", 5),
    ("wallLeft", 6),
    ("wallFrontLeft", 7),
];

/// The turns, in eighths of a circle, clockwise.
const TURNS: [(&str, i8); 6] = [
    ("turnRight", 2),
    ("turnRight90", 2),
    ("turnRight45", 1),
    ("turnLeft", -2),
    ("turnLeft90", -2),
    ("turnLeft45", -1),
];

/// Commands that only draw; they are ignored.
const DRAWING: [&str; 8] = [
    "setWall",
    "clearWall",
    "setColor",
    "clearColor",
    "clearAllColor",
    "setText",
    "clearText",
    "clearAllText",
];

/// Returns the direction in which a wall query looks, in eighths of a circle, clockwise from ahead.
/// `None` for other commands.
pub(super) fn eighths_of(command: &str) -> Option<i8> {
    let wall = WALLS.iter().find(|(name, _)| *name == command);
    wall.map(|(_, eighths)| *eighths)
}

impl<'a> Simulator<'a> {
    /// Returns a mouse at the start of a maze.
    #[must_use]
    pub fn new(maze: &'a Maze) -> Self {
        Self {
            maze,
            goal: maze.grid().middle().collect(),
            pose: LatticePose::START,
            half_steps: Score::new(Unit::HalfSteps),
            cells: Score::new(Unit::Cells),
            movements: 0,
            crashes: 0,
            invalid: 0,
            reset_after: None,
        }
    }

    /// Presses the reset button after `movements` movements: `wasReset` is true from then on until
    /// the mouse says `ackReset`.
    pub fn reset_after(&mut self, movements: u64) {
        self.reset_after = Some(movements);
    }

    /// Carries out one line of the mouse and returns the reply. Commands that only draw, and lines
    /// that are not commands, get none.
    pub fn answer(&mut self, line: &str) -> Option<String> {
        let mut words = line.split_ascii_whitespace();
        let command = words.next()?;
        if DRAWING.contains(&command) {
            return None;
        }
        let argument = words.next();
        let reply = match words.next() {
            None => self.reply(command, argument),
            Some(_) => None,
        };
        self.invalid += u64::from(reply.is_none());
        reply
    }

    fn reply(&mut self, command: &str, argument: Option<&str>) -> Option<String> {
        // What is not a number counts as 0, what is missing as 1.
        let number = || argument.map_or(1, |text| text.parse().unwrap_or(0));
        if let Some(eighths) = eighths_of(command) {
            let heading = self.pose.heading.turned(eighths);
            return Some(self.is_wall_within(number(), heading).to_string());
        }
        match (command, argument) {
            ("moveForward", _) => return Some(self.move_on(number().saturating_mul(2))),
            ("moveForwardHalf", _) => return Some(self.move_on(number())),
            ("getStat", Some(name)) => return self.half_steps.stat(name),
            _ => {}
        }
        if argument.is_some() {
            return None;
        }
        if let Some((_, eighths)) = TURNS.iter().find(|(name, _)| *name == command) {
            self.turn(*eighths);
            return Some("ack".to_owned());
        }
        match command {
            "mazeWidth" => Some(self.maze.grid().width().to_string()),
            "mazeHeight" => Some(self.maze.grid().height().to_string()),
            "wasReset" => Some(self.was_reset().to_string()),
            "ackReset" => {
                self.reset();
                Some("ack".to_owned())
            }
            _ => None,
        }
    }

    /// Returns whether a wall stands within `half_steps` half-steps; at least one is checked.
    fn is_wall_within(&self, half_steps: i32, heading: LatticeHeading) -> bool {
        let mut place = self.pose.place;
        for _ in 0..half_steps.max(1) {
            if self.is_blocked(place, heading) {
                return true;
            }
            place = place.ahead(heading);
        }
        false
    }

    /// Returns whether a wall or a post stands half a step ahead of a place.
    fn is_blocked(&self, place: LatticePoint, heading: LatticeHeading) -> bool {
        match place.gate(heading, self.maze.grid()) {
            Gate::None => false,
            Gate::Edge(cell, side) => !self.maze.is_open(cell, side),
            Gate::Solid => true,
        }
    }

    fn move_on(&mut self, half_steps: i32) -> String {
        if half_steps < 1 || self.is_blocked(self.pose.place, self.pose.heading) {
            self.crashes += 1;
            return "crash".to_owned();
        }
        let starts = self.pose.place.cell() == LatticePoint::START.cell();
        for score in [&mut self.half_steps, &mut self.cells] {
            if starts {
                score.start_run();
            }
            // What was asked for counts, even if a wall cuts it short.
            score.move_on(half_steps);
        }
        let mut made = 0;
        while made < half_steps && !self.is_blocked(self.pose.place, self.pose.heading) {
            self.pose.place = self.pose.place.ahead(self.pose.heading);
            made += 1;
        }
        self.end_movement();
        if made < half_steps {
            self.crashes += 1;
            return "crash".to_owned();
        }
        "ack".to_owned()
    }

    fn turn(&mut self, eighths: i8) {
        self.pose.heading = self.pose.heading.turned(eighths);
        self.half_steps.turn();
        self.cells.turn();
        self.end_movement();
    }

    fn end_movement(&mut self) {
        self.movements += 1;
        let cell = self.pose.place.cell();
        for score in [&mut self.half_steps, &mut self.cells] {
            if self.goal.contains(&cell) {
                score.finish_run();
            } else if cell == LatticePoint::START.cell() {
                score.end_run();
            }
        }
    }

    fn was_reset(&self) -> bool {
        self.reset_after
            .is_some_and(|movements| self.movements >= movements)
    }

    fn reset(&mut self) {
        self.pose = LatticePose::START;
        self.half_steps.reset();
        self.cells.reset();
        if self.was_reset() {
            self.reset_after = None;
        }
    }

    /// Returns the score as the code of mms counts it, in half-steps.
    #[must_use]
    pub fn score_in_half_steps(&self) -> &Score {
        &self.half_steps
    }

    /// Returns the score as the README of mms has it, in cells.
    #[must_use]
    pub fn score_in_cells(&self) -> &Score {
        &self.cells
    }

    /// Returns the number of moves and turns made.
    #[must_use]
    pub const fn movements(&self) -> u64 {
        self.movements
    }

    /// Returns the number of times that the mouse ran against a wall, or asked for a move of no
    /// length.
    #[must_use]
    pub const fn crashes(&self) -> u64 {
        self.crashes
    }

    /// Returns the number of lines that were not commands.
    #[must_use]
    pub const fn invalid(&self) -> u64 {
        self.invalid
    }

    /// Returns the pose of the mouse.
    #[must_use]
    pub const fn pose(&self) -> LatticePose {
        self.pose
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4 × 4; a way north, then east to the middle; (2, 3) opens diagonally to (3, 2).
    const MAZE: &str = "\
+---+---+---+---+
|               |
+   +---+---+   +
|   | G   G |   |
+   +   +---+   +
|   | G   G |   |
+   +   +---+   +
| S |           |
+---+---+---+---+
";

    fn play(lines: &[&str]) -> (Vec<Option<String>>, Score, Score) {
        let maze = tolman_maze::parse(MAZE).unwrap().maze;
        let mut simulator = Simulator::new(&maze);
        let replies = lines.iter().map(|line| simulator.answer(line)).collect();
        (
            replies,
            *simulator.score_in_half_steps(),
            *simulator.score_in_cells(),
        )
    }

    #[track_caller]
    fn check(lines: &[(&str, Option<&str>)]) -> (Score, Score) {
        let asked: Vec<&str> = lines.iter().map(|(line, _)| *line).collect();
        let (replies, half_steps, cells) = play(&asked);
        for ((line, expected), reply) in lines.iter().zip(replies) {
            assert_eq!(reply.as_deref(), *expected, "{line}");
        }
        (half_steps, cells)
    }

    #[test]
    fn walls_are_seen_from_cells_and_from_walls() {
        check(&[
            ("mazeWidth", Some("4")),
            ("mazeHeight", Some("4")),
            ("wallFront", Some("false")),
            ("wallFront 7", Some("true")),
            ("wallFront 6", Some("false")),
            ("wallLeft", Some("true")),
            ("wallBack", Some("true")),
            // From the middle of a cell a diagonal meets a post.
            ("wallFrontRight", Some("true")),
            ("moveForward 3", Some("ack")),
            ("turnRight", Some("ack")),
            ("moveForwardHalf", Some("ack")),
            // On the wall between two cells: posts to both sides.
            ("wallLeft", Some("true")),
            ("wallFront", Some("false")),
            // South-east of here a wall stands, north-east the border.
            ("wallFrontRight", Some("true")),
            ("wallBackRight", Some("false")),
        ]);
    }

    #[test]
    fn diagonals_are_driven_from_wall_to_wall() {
        check(&[
            ("moveForwardHalf 5", Some("ack")),
            ("turnRight45", Some("ack")),
            ("wallFront", Some("false")),
            ("moveForwardHalf", Some("ack")),
            ("turnRight45", Some("ack")),
            ("moveForwardHalf", Some("ack")),
            ("wallLeft", Some("true")),
            ("wallRight", Some("true")),
        ]);
    }

    #[test]
    fn a_move_that_a_wall_cuts_short_counts_whole_and_crashes() {
        let (score, _) = check(&[
            ("moveForward 9", Some("crash")),
            ("wallFront", Some("true")),
        ]);
        assert_eq!(score.stat("total-distance").as_deref(), Some("18"));
        // A wall right ahead costs nothing.
        let (score, _) = check(&[("turnLeft", Some("ack")), ("moveForward", Some("crash"))]);
        assert_eq!(score.stat("total-distance").as_deref(), Some("0"));
        assert_eq!(score.stat("total-turns").as_deref(), Some("1"));
    }

    #[test]
    fn what_is_no_command_gets_no_reply() {
        check(&[
            ("", None),
            ("movefoward", None),
            ("moveForward 1 2", None),
            ("mazeWidth 3", None),
            ("getStat", None),
            ("getStat speed", None),
            ("setText 0 0 hello there", None),
            ("moveForward 0", Some("crash")),
            ("moveForward x", Some("crash")),
            ("moveForwardHalf -3", Some("crash")),
            ("moveForward 2147483647", Some("crash")),
        ]);
    }

    #[test]
    fn runs_are_scored_in_half_steps_and_in_cells() {
        // North 3, east 3, south 3, west 2 into the goal's lower row by the south.
        let way = [
            "moveForward 3",
            "turnRight",
            "moveForward 3",
            "turnRight",
            "moveForward 3",
            "turnRight",
            "moveForward 2",
            "turnRight",
            "moveForward",
        ];
        let (replies, half_steps, cells) = play(&way);
        assert!(replies.iter().all(|reply| reply.as_deref() == Some("ack")));
        assert!(half_steps.solved && cells.solved);
        // 6, 6, 6, 4 and 2 half-steps: 4 + 4 + 4 + 3 + 2 effective ones; 4 turns.
        assert!((half_steps.value() - (21.0 + 2.1)).abs() < 1e-4);
        // 3, 3, 3, 2 and 1 cells: 2.5 · 3 + 2 + 1.
        assert!((cells.value() - (14.5 + 1.45)).abs() < 1e-4);
    }

    #[test]
    fn an_unsolved_maze_scores_2000() {
        let (score, _) = check(&[("moveForward", Some("ack"))]);
        assert!((score.value() - 2000.0).abs() < 1e-6);
    }

    #[test]
    fn the_reset_button_carries_the_mouse_back_and_costs_the_next_run() {
        let maze = tolman_maze::parse(MAZE).unwrap().maze;
        let mut simulator = Simulator::new(&maze);
        simulator.reset_after(1);
        for (line, expected) in [
            ("wasReset", "false"),
            ("moveForward", "ack"),
            ("wasReset", "true"),
            ("ackReset", "ack"),
            ("wasReset", "false"),
            ("moveForward", "ack"),
            ("getStat current-run-effective-distance", "17"),
            ("getStat total-effective-distance", "19"),
        ] {
            assert_eq!(simulator.answer(line).as_deref(), Some(expected), "{line}");
        }
    }
}
