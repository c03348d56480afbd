//! Lesson 3: what a map needs. Places that look alike are told apart by what lies around them.

use tolman_arena::bump_walk::{BumpSight, BumpWalk};
use tolman_maze::{Cell, Direction, Maze};

use super::cell_film::{CellTrack, film};
use super::{Answer, LessonMark, Task, TaskView, unmarked};
use crate::session::count;
use crate::{PlaygroundError, Sketch};

const MAZE: &str = "\
o---o---o---o---o---o
|               |   |
o   o   o---o   o   o
| G     |   |   |   |
o---o---o   o   o   o
|           |       |
o   o   o   o---o   o
| S     |           |
o---o---o---o---o---o
";

pub(super) const TASKS: &[Task] = &[
    Task {
        maze: MAZE,
        view: |sketch, _| view(sketch, &["A"]),
        mark: mark_alike,
    },
    Task {
        maze: MAZE,
        view: |sketch, _| view(sketch, &["A", "B"]),
        mark: mark_walk,
    },
];

/// The robot knows north and sees which ways are open.
const SIGHT: BumpSight = BumpSight::OpenWays;

/// Most moves of a walk.
const MOST_MOVES: usize = 6;

/// Most moves of the robot that learns the maze with a memory.
const MOST_LEARNING: usize = 10_000;

/// Returns the places A and B: the maze's start and goal.
fn places(maze: &Maze) -> [Cell; 2] {
    let start = super::start_of(maze).0;
    [start, maze.goals().first().copied().unwrap_or(start)]
}

fn view(sketch: &Sketch, letters: &[&str]) -> Result<TaskView, PlaygroundError> {
    let mut view = TaskView::of(sketch);
    view.plan.start = None;
    view.plan.goals.clear();
    let robots = letters.iter().zip(places(sketch.maze()));
    view.robots = robots
        .map(|(letter, cell)| ((*letter).to_owned(), cell, None))
        .collect();
    Ok(view)
}

fn mark_alike(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let maze = sketch.maze();
    let [a, _] = places(maze);
    let look = |cell: Cell| SIGHT.look(maze, cell);
    let alike = |cell: &Cell| *cell != a && look(*cell) == look(a);
    let all: Vec<Cell> = maze.grid().cells().filter(alike).collect();
    let is_missing = all.iter().any(|cell| !answer.cells.contains(cell));
    // A click on A itself is not wrong.
    let wrong = answer.cells.iter().filter(|cell| look(**cell) != look(a));
    let wrong = wrong.count();
    let do_not = if wrong == 1 { "does not" } else { "do not" };
    let told = match (wrong, is_missing) {
        (0, false) => None,
        (0, true) => Some("What you chose looks like A, but there is more.".to_owned()),
        (_, false) => Some(format!(
            "All that looks like A is chosen, and also {} that {do_not}.",
            count(wrong, "place")
        )),
        (_, true) => Some(format!(
            "{} of those that you chose {do_not} look like A, and something is missing.",
            count(wrong, "place")
        )),
    };
    if let Some(told) = told {
        return Ok(LessonMark::new(false, told));
    }
    let mut looks: Vec<u32> = maze.grid().cells().map(look).collect();
    looks.sort_unstable();
    looks.dedup();
    let told = format!(
        "Right. On a map without memory these {} places are one. The maze has {} places, and such \
         a map has only {}.",
        all.len() + 1,
        maze.grid().cell_count(),
        looks.len()
    );
    Ok(LessonMark::new(true, told))
}

/// Returns the cells of a walk, the first included. A move against a wall stays.
fn walk(maze: &Maze, start: Cell, moves: &[Direction]) -> Vec<Cell> {
    let mut cells = vec![start];
    let mut at = start;
    for direction in moves {
        at = maze.beside(at, *direction).unwrap_or(at);
        cells.push(at);
    }
    cells
}

/// Returns the number of moves after which the walks first look different.
fn told_apart(maze: &Maze, places: [Cell; 2], moves: &[Direction]) -> Option<usize> {
    let [a, b] = places.map(|place| walk(maze, place, moves));
    let mut both = a.into_iter().zip(b);
    both.position(|(a, b)| SIGHT.look(maze, a) != SIGHT.look(maze, b))
}

/// Returns the number of moves of the shortest walk that tells the places apart.
fn fewest_moves(maze: &Maze, places: [Cell; 2]) -> Option<usize> {
    let mut walks = vec![Vec::new()];
    for moves in 0..=MOST_MOVES {
        let tells = |walk: &Vec<Direction>| told_apart(maze, places, walk).is_some();
        if walks.iter().any(tells) {
            return Some(moves);
        }
        let longer = walks.iter().flat_map(|walk| {
            Direction::ALL.into_iter().map(|direction| {
                let mut longer = walk.clone();
                longer.push(direction);
                longer
            })
        });
        walks = longer.collect();
    }
    None
}

fn mark_walk(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let maze = sketch.maze();
    let places = places(maze);
    let moves = &answer.moves[..answer.moves.len().min(MOST_MOVES)];
    let tracks = places.map(|place| {
        let cells = walk(maze, place, moves);
        let first = moves.first().copied().unwrap_or(Direction::North);
        let headings = core::iter::once(first).chain(moves.iter().copied());
        cells.into_iter().zip(headings).collect()
    });
    let [a, b] = tracks;
    let tracks = [CellTrack::new("from A", a), CellTrack::new("from B", b)];
    let replay = film("The same moves from A and from B", &unmarked(maze), &tracks)?;
    let Some(after) = told_apart(maze, places, moves) else {
        let told = format!(
            "After {} everything still looks the same from A as from B. Watch both robots.",
            count(moves.len(), "move")
        );
        return Ok(LessonMark::new(false, told).showing(replay));
    };
    let fewest = fewest_moves(maze, places);
    if fewest.is_some_and(|fewest| fewest < moves.len()) {
        let told = format!(
            "This tells A from B after {}, but there is a shorter walk.",
            count(after, "move")
        );
        return Ok(LessonMark::new(false, told).showing(replay));
    }
    let mut learner = BumpWalk::new(maze, places[0], SIGHT);
    let mut learned = 0;
    while !learner.is_exact() && learned < MOST_LEARNING {
        if learner.step(learner.map().advice()).is_err() {
            break;
        }
        learned += 1;
    }
    let told = format!(
        "After {} it looks different. A robot that remembers its moves just learned this maze: its \
         map has {} after {}, and {}.",
        count(after, "move"),
        count(learner.map().place_count(), "place"),
        count(learned, "move"),
        match learner.is_exact() {
            true => "every one is right",
            false => "it is not yet right",
        }
    );
    Ok(LessonMark::new(true, told).showing(replay))
}
