//! Lesson 4: where am I. A robot with a map is put down somewhere, and each move rules out places.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Direction, Maze};
use tolman_systems::planners::{PoseKnowledge, PoseSet};

use super::cell_film::{CellTrack, film};
use super::{Answer, LessonMark, Task, TaskView, listed, unmarked};
use crate::session::count;
use crate::{PlaygroundError, Sketch};

const MAZE: &str = "\
o---o---o---o---o---o
|           |     G |
o---o---o   o   o---o
|       |   |       |
o   o---o   o   o   o
|           |   |   |
o   o   o---o   o   o
|       |           |
o   o   o   o---o   o
|           | S     |
o---o---o---o---o---o
";

pub(super) const TASKS: &[Task] = &[
    Task {
        maze: MAZE,
        view: view_lost,
        mark: mark_lost,
    },
    Task {
        maze: MAZE,
        view: view_plan,
        mark: mark_plan,
    },
];

/// Cells of a side of the largest maze.
const SIDE: usize = 16;

/// Least number of poses that look alike where the robot is put down: else it knows its place at
/// once.
const LEAST_ALIKE: u32 = 4;

/// Most moves of a plan.
const MOST_MOVES: usize = 6;

const LETTERS: [&str; 8] = ["A", "B", "C", "D", "E", "F", "G", "H"];

type Pose = (Cell, Direction);

/// Returns whether the sides of a robot are open: left, ahead and right.
fn sight(maze: &Maze, (cell, heading): Pose) -> [bool; 3] {
    SEEN.map(|side| maze.is_open(cell, heading.turned(side)))
}

/// Sides that the robot sees.
const SEEN: [Direction; 3] = [Direction::West, Direction::North, Direction::East];

/// A robot that was put down, and where it may be.
#[derive(Clone, Debug)]
struct Lost<'a> {
    maze: &'a Maze,
    /// True poses, from where it was put down on.
    poses: Vec<Pose>,
    possible: PoseSet<SIDE>,
    beliefs: Vec<Vec<Pose>>,
    /// Whether the last move was against a wall.
    has_bumped: bool,
}

impl<'a> Lost<'a> {
    fn new(maze: &'a Maze, pose: Pose, possible: PoseSet<SIDE>) -> Self {
        let mut lost = Self {
            maze,
            poses: vec![pose],
            possible,
            beliefs: Vec::new(),
            has_bumped: false,
        };
        lost.look();
        lost
    }

    fn pose(&self) -> Pose {
        self.poses[self.poses.len() - 1]
    }

    fn look(&mut self) {
        let seen = SEEN.into_iter().zip(sight(self.maze, self.pose()));
        for (side, is_open) in seen {
            self.possible.see(self.maze, side, is_open);
        }
        self.beliefs.push(self.possible.iter().collect());
    }

    /// Turns to a side and drives one cell. Against a wall the robot stays as it is.
    fn go(&mut self, side: Direction) {
        let (cell, heading) = self.pose();
        let turned = heading.turned(side);
        let next = self.maze.beside(cell, turned);
        self.has_bumped = next.is_none();
        if let Some(next) = next {
            self.possible.drive(self.maze, side);
            self.poses.push((next, turned));
        } else {
            self.possible.see(self.maze, side, false);
            self.poses.push((cell, heading));
        }
        self.look();
    }

    fn is_found(&self) -> bool {
        matches!(self.possible.location(), PoseKnowledge::Found { .. })
    }
}

/// Returns the poses of all cells.
fn all_poses(maze: &Maze) -> impl Iterator<Item = Pose> {
    let cells = maze.grid().cells();
    cells.flat_map(|cell| Direction::ALL.map(|heading| (cell, heading)))
}

/// Puts the robot down where the answer's seed says, and makes the answer's moves.
fn lost<'a>(maze: &'a Maze, answer: &Answer) -> Result<Lost<'a>, PlaygroundError> {
    let anywhere = PoseSet::anywhere(maze.grid())?;
    let starts = all_poses(maze).map(|pose| Lost::new(maze, pose, anywhere.clone()));
    let starts: Vec<Lost<'_>> = starts
        .filter(|lost| match lost.possible.location() {
            PoseKnowledge::Among { poses } => poses >= LEAST_ALIKE,
            _ => false,
        })
        .collect();
    let mut rng = ChaCha8Rng::seed_from_u64(answer.seed.into());
    let mut lost = starts[rng.random_range(0..starts.len() as u32) as usize].clone();
    for side in &answer.moves {
        lost.go(*side);
    }
    Ok(lost)
}

/// Returns what is seen of a maze without its start and goal.
fn bare(sketch: &Sketch) -> TaskView {
    let mut view = TaskView::of(sketch);
    view.plan.start = None;
    view.plan.goals.clear();
    view
}

fn view_lost(sketch: &Sketch, answer: &Answer) -> Result<TaskView, PlaygroundError> {
    let lost = lost(sketch.maze(), answer)?;
    let mut view = bare(sketch);
    view.sight = Some(sight(sketch.maze(), lost.pose()));
    view.facts = vec![("moves", (lost.poses.len() - 1).to_string())];
    if lost.has_bumped {
        let stayed = "against a wall: the robot did not move";
        view.facts.push(("last move", stayed.to_owned()));
    }
    Ok(view)
}

fn mark_lost(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let maze = sketch.maze();
    let lost = lost(maze, answer)?;
    let Some(chosen) = answer.cells.last() else {
        return Ok(LessonMark::new(
            false,
            "Click the cell in which the robot is now.",
        ));
    };
    let mut cells: Vec<Cell> = lost.possible.iter().map(|(cell, _)| cell).collect();
    cells.sort_unstable();
    cells.dedup();
    if !cells.contains(chosen) {
        let told = "It cannot be there: from there it would have seen other walls.";
        return Ok(LessonMark::new(false, told));
    }
    if cells.len() > 1 {
        let told = format!(
            "It may be there, but nobody can know yet: {} cells fit all that it saw. Drive on.",
            cells.len()
        );
        return Ok(LessonMark::new(false, told));
    }
    let mut mouse = Lost::new(maze, lost.poses[0], PoseSet::anywhere(maze.grid())?);
    while !mouse.is_found()
        && let Some(side) = mouse.possible.next_drive(maze)
    {
        mouse.go(side);
    }
    let told = format!(
        "There it is, after {}: this is the only cell left. A micromouse with this map needs {} \
         from there. Watch the possible places vanish.",
        count(lost.poses.len() - 1, "move"),
        count(mouse.poses.len() - 1, "move")
    );
    let track = CellTrack {
        name: "robot".to_owned(),
        poses: lost.poses,
        beliefs: lost.beliefs,
    };
    let replay = film("Where the robot may be", &unmarked(maze), &[track])?;
    Ok(LessonMark::new(true, told).showing(replay))
}

/// Returns the poses in dead ends with a wall ahead: all look alike.
fn dead_ends(maze: &Maze) -> Vec<Pose> {
    let poses = all_poses(maze).filter(|pose| sight(maze, *pose) == [false; 3]);
    poses.take(LETTERS.len()).collect()
}

fn view_plan(sketch: &Sketch, _: &Answer) -> Result<TaskView, PlaygroundError> {
    let mut view = bare(sketch);
    let robots = LETTERS.into_iter().zip(dead_ends(sketch.maze()));
    view.robots = robots
        .map(|(letter, (cell, heading))| (letter.to_owned(), cell, Some(heading)))
        .collect();
    Ok(view)
}

/// Returns a robot in each dead end after the moves of a plan.
fn planned<'a>(maze: &'a Maze, moves: &[Direction]) -> Result<Vec<Lost<'a>>, PlaygroundError> {
    let starts = dead_ends(maze);
    let possible = PoseSet::among(maze.grid(), starts.iter().copied())?;
    let robots = starts.into_iter().map(|start| {
        let mut lost = Lost::new(maze, start, possible.clone());
        moves.iter().for_each(|side| lost.go(*side));
        lost
    });
    Ok(robots.collect())
}

/// Returns the number of moves of the shortest plan, up to [`MOST_MOVES`].
fn shortest_plan(maze: &Maze) -> Result<Option<usize>, PlaygroundError> {
    let mut plans = vec![Vec::new()];
    for moves in 0..=MOST_MOVES {
        for plan in &plans {
            if planned(maze, plan)?.iter().all(Lost::is_found) {
                return Ok(Some(moves));
            }
        }
        let longer = plans.iter().flat_map(|plan| {
            Direction::ALL.into_iter().map(|side| {
                let mut longer = plan.clone();
                longer.push(side);
                longer
            })
        });
        plans = longer.collect();
    }
    Ok(None)
}

fn mark_plan(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let maze = sketch.maze();
    let moves = &answer.moves[..answer.moves.len().min(MOST_MOVES)];
    let robots = planned(maze, moves)?;
    let unknown = LETTERS.into_iter().zip(&robots);
    let unknown: Vec<&str> = unknown
        .filter(|(_, robot)| !robot.is_found())
        .map(|(letter, _)| letter)
        .collect();
    let tracks = LETTERS.into_iter().zip(&robots);
    let tracks: Vec<CellTrack> = tracks
        .map(|(letter, robot)| CellTrack::new(letter, robot.poses.clone()))
        .collect();
    let replay = film("One plan from every dead end", &unmarked(maze), &tracks)?;
    let mark = if unknown.is_empty() {
        let shortest = shortest_plan(maze)?.unwrap_or(moves.len());
        let told = format!(
            "Your plan of {} tells all {} places apart, wherever the robot was put down. The \
             shortest plan has {shortest}.",
            count(moves.len(), "move"),
            robots.len()
        );
        LessonMark::new(true, told)
    } else {
        let told = format!(
            "Put down at {}, the robot cannot tell which of them it was: it sees the same all the \
             way.",
            listed(&unknown)
        );
        LessonMark::new(false, told)
    };
    Ok(mark.showing(replay))
}
