//! Five lessons that mark themselves.
//!
//! A lesson has one or two tasks. A task has a maze and a check: [`view`] returns what the pupil
//! sees, [`mark`] lets robots run with the pupil's [`Answer`] and returns the result. No answer is
//! stored. The words of the tasks are in the page's `lessons.js`.

mod aliasing;
mod cell_film;
mod edits;
mod islands;
mod proof;
mod rule_run;
mod wall_follower;
mod whereabouts;

use serde::{Deserialize, Serialize};
use tolman_maze::{Cell, Direction, Maze};

use crate::{PlaygroundError, Sketch, SketchPlan};

/// A pupil's answer to a task. Each task uses some of the fields and ignores the others.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(default)]
pub struct Answer {
    /// Lines of a rule: sides of the robot, north is ahead. The robot goes to the first open one.
    pub rule: Vec<Direction>,
    /// Walls that the pupil built or removed: a cell and its side.
    pub walls: Vec<(Cell, Direction)>,
    /// Cells that the pupil chose, or entered in this order.
    pub cells: Vec<Cell>,
    /// Moves of a robot. Sides of the robot, north is ahead, or directions of the compass.
    pub moves: Vec<Direction>,
    /// Seed of what the task draws, such as the place where a robot is put down.
    pub seed: u32,
}

/// What a pupil sees of a task.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskView {
    /// The maze.
    pub plan: SketchPlan,
    /// Walls of which the pupil knows nothing yet: a cell and its side.
    pub unknown: Vec<(Cell, Direction)>,
    /// Robots that are seen: letter, cell, and heading if it is known.
    pub robots: Vec<(String, Cell, Option<Direction>)>,
    /// Which sides of the robot are open: left, ahead and right. Only if the robot's place is not
    /// seen.
    pub sight: Option<[bool; 3]>,
    /// Facts about the answer so far, each with its name.
    pub facts: Vec<(&'static str, String)>,
}

impl TaskView {
    fn of(sketch: &Sketch) -> Self {
        Self {
            plan: sketch.plan(),
            unknown: Vec::new(),
            robots: Vec::new(),
            sight: None,
            facts: Vec::new(),
        }
    }
}

/// Result of an answer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LessonMark {
    /// Whether the answer is right.
    pub passed: bool,
    /// What happened, in a few sentences.
    pub told: String,
    /// The run that decided, in the replay player's form; `None` if nothing ran.
    pub replay: Option<String>,
    /// Cells of a way to show in the maze; empty for none.
    pub way: Vec<Cell>,
}

impl LessonMark {
    fn new(passed: bool, told: impl Into<String>) -> Self {
        Self {
            passed,
            told: told.into(),
            replay: None,
            way: Vec::new(),
        }
    }

    fn showing(self, replay: String) -> Self {
        Self {
            replay: Some(replay),
            ..self
        }
    }
}

/// A task: its maze, what is seen of it, and its check.
struct Task {
    maze: &'static str,
    view: fn(&Sketch, &Answer) -> Result<TaskView, PlaygroundError>,
    mark: fn(&Sketch, &Answer) -> Result<LessonMark, PlaygroundError>,
}

/// Tasks of each lesson, in the order of the lessons.
const LESSONS: &[&[Task]] = &[
    wall_follower::TASKS,
    islands::TASKS,
    aliasing::TASKS,
    whereabouts::TASKS,
    proof::TASKS,
];

/// Returns the number of tasks of each lesson.
#[must_use]
pub fn task_counts() -> Vec<usize> {
    LESSONS.iter().map(|tasks| tasks.len()).collect()
}

fn task(lesson: usize, task: usize) -> Result<(&'static Task, Sketch), PlaygroundError> {
    let tasks = lesson.checked_sub(1).and_then(|number| LESSONS.get(number));
    let found = tasks.zip(task.checked_sub(1));
    let found = found.and_then(|(tasks, number)| tasks.get(number));
    let found = found.ok_or(PlaygroundError::Task { lesson, task })?;
    Ok((found, Sketch::read(found.maze)?))
}

/// Returns what a pupil sees of a task after an answer. Lessons and their tasks count from 1.
///
/// # Errors
/// [`PlaygroundError::Task`] if there is no such task.
pub fn view(lesson: usize, number: usize, answer: &Answer) -> Result<TaskView, PlaygroundError> {
    let (task, sketch) = task(lesson, number)?;
    (task.view)(&sketch, answer)
}

/// Marks an answer to a task. Lessons and their tasks count from 1.
///
/// # Errors
/// [`PlaygroundError`] if there is no such task, or a robot cannot run in the pupil's maze.
pub fn mark(lesson: usize, number: usize, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let (task, sketch) = task(lesson, number)?;
    (task.mark)(&sketch, answer)
}

/// Returns the start of a lesson's maze, which every one of them has.
fn start_of(maze: &Maze) -> (Cell, Direction) {
    maze.start().unwrap_or((Cell::new(0, 0), Direction::North))
}

/// Returns a maze without marks, for tasks in which they mean nothing to the pupil.
fn unmarked(maze: &Maze) -> Maze {
    let mut bare = maze.clone();
    bare.set_start(None);
    bare.set_goals(Vec::new());
    bare
}

/// Returns the names of several things: "A", "A and B", "A, B and C".
fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [only] => (*only).to_owned(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}
