//! Lesson 5: explore, prove, run. A run is proven to be the shortest when the shortest run that
//! surely exists is as short as the shortest that may exist.

use alloc::collections::BTreeSet;

use tolman_maze::{Cell, Direction, Grid, Knowledge, Maze, Walls};
use tolman_systems::planners::{Passages, StepMap, Unknown};

use super::cell_film::{CellTrack, film};
use super::{Answer, LessonMark, Task, TaskView, start_of};
use crate::session::count;
use crate::{PlaygroundError, Sketch};

const MAZE: &str = "\
o---o---o---o---o---o---o
|   |                   |
o   o   o---o   o---o---o
|       |       |       |
o   o   o   o   o   o   o
|   |   |     G         |
o   o   o   o   o---o   o
|       |               |
o   o---o   o---o---o   o
|   |   |   |       |   |
o   o   o   o---o   o   o
| S     |               |
o---o---o---o---o---o---o
";

pub(super) const TASKS: &[Task] = &[
    Task {
        maze: MAZE,
        view: view_exploring,
        mark: mark_exploring,
    },
    Task {
        maze: MAZE,
        view: view_proof,
        mark: mark_proof,
    },
];

/// Cells of a side of the largest maze.
const SIDE: usize = 16;

/// The walls that a mouse knows which has seen all sides of some cells.
#[derive(Clone, Debug)]
struct Seen<'a> {
    maze: &'a Maze,
    cells: BTreeSet<Cell>,
}

impl Walls for Seen<'_> {
    fn grid(&self) -> Grid {
        self.maze.grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        let Some(beside) = self.grid().neighbour(cell, direction) else {
            return Knowledge::Wall;
        };
        match self.cells.contains(&cell) || self.cells.contains(&beside) {
            true => Knowledge::of_standing(!self.maze.is_open(cell, direction)),
            false => Knowledge::Unknown,
        }
    }
}

/// The shortest runs that fit what is known.
#[derive(Clone, Debug)]
struct Runs {
    /// Cells of the shortest run that surely exists, the start included; `None` if there is none.
    sure: Option<Vec<Cell>>,
    /// Cells of the shortest run that may exist.
    hoped: Option<Vec<Cell>>,
}

impl<'a> Seen<'a> {
    fn new(maze: &'a Maze, cells: impl IntoIterator<Item = Cell>) -> Self {
        let cells = cells.into_iter().collect();
        Self { maze, cells }
    }

    fn runs(&self) -> Result<Runs, PlaygroundError> {
        let run = |unknown| self.way(start_of(self.maze).0, self.maze.goals(), unknown);
        Ok(Runs {
            sure: run(Unknown::Closed)?,
            hoped: run(Unknown::Open)?,
        })
    }

    /// Returns the cells of a shortest way, both ends included.
    fn way(
        &self,
        from: Cell,
        to: &[Cell],
        unknown: Unknown,
    ) -> Result<Option<Vec<Cell>>, PlaygroundError> {
        let passages = Passages::<SIDE>::new(self, unknown)?;
        let steps = StepMap::new(&passages, to.iter().copied());
        let Some(length) = steps.steps(from) else {
            return Ok(None);
        };
        let mut way = vec![from];
        let mut at = from;
        for _ in 0..length {
            let next = steps.descend(&passages, at, Direction::ALL);
            let Some(next) = next.and_then(|direction| at.beyond(direction)) else {
                break;
            };
            way.push(next);
            at = next;
        }
        Ok(Some(way))
    }
}

impl Runs {
    /// Returns whether no unknown wall can make a shorter run.
    fn is_proven(&self) -> bool {
        self.sure.is_some() && moves(self.sure.as_ref()) == moves(self.hoped.as_ref())
    }

    /// Returns the mark of an answer that proves nothing yet.
    fn unproven(self) -> LessonMark {
        let told = match (moves(self.sure.as_ref()), moves(self.hoped.as_ref())) {
            (None, _) => "No way to the goal is known yet.".to_owned(),
            (Some(sure), hoped) => format!(
                "Not proven. The shortest run that surely exists has {}. One of {} may still \
                 exist: see the dashed line.",
                count(sure, "move"),
                hoped.unwrap_or_default()
            ),
        };
        LessonMark {
            way: self.hoped.unwrap_or_default(),
            ..LessonMark::new(false, told)
        }
    }
}

fn moves(way: Option<&Vec<Cell>>) -> Option<usize> {
    way.map(|way| way.len() - 1)
}

fn told(way: Option<&Vec<Cell>>) -> String {
    moves(way).map_or_else(|| "none yet".to_owned(), |moves| count(moves, "move"))
}

/// Returns the cells that a mouse has entered: the start and those of the answer, up to the first
/// to which no way is open.
fn entered(maze: &Maze, answer: &Answer) -> Vec<Cell> {
    let mut cells = vec![start_of(maze).0];
    for next in &answer.cells {
        let at = cells[cells.len() - 1];
        if !maze.neighbours(at).any(|(_, beside)| beside == *next) {
            break;
        }
        cells.push(*next);
    }
    cells
}

fn view_exploring(sketch: &Sketch, answer: &Answer) -> Result<TaskView, PlaygroundError> {
    let maze = sketch.maze();
    let entered = entered(maze, answer);
    let seen = Seen::new(maze, entered.iter().copied());
    let mut view = TaskView::of(sketch);
    let sides = maze.grid().cells();
    let sides = sides.flat_map(|cell| [(cell, Direction::North), (cell, Direction::East)]);
    let is_unknown =
        |(cell, side): &(Cell, Direction)| seen.knowledge(*cell, *side) == Knowledge::Unknown;
    view.unknown = sides.filter(is_unknown).collect();
    // What is not known is not told.
    for wall in &mut view.plan.walls {
        let [x, y] = wall.cell;
        wall.stands &= !is_unknown(&(Cell::new(x, y), wall.side));
    }
    let at = entered[entered.len() - 1];
    view.robots = vec![(
        String::new(),
        at,
        Some(headings(&entered)[entered.len() - 1]),
    )];
    view.facts = vec![
        ("cells seen", seen.cells.len().to_string()),
        ("shortest run found", told(seen.runs()?.sure.as_ref())),
    ];
    Ok(view)
}

/// Returns the heading with which a mouse entered each cell of a way.
fn headings(way: &[Cell]) -> Vec<Direction> {
    let entered = way.windows(2).map(|pair| {
        let mut sides = Direction::ALL.into_iter();
        sides.find(|side| pair[0].beyond(*side) == Some(pair[1]))
    });
    let entered: Vec<Direction> = entered
        .map(|side| side.unwrap_or(Direction::North))
        .collect();
    let first = entered.first().copied().unwrap_or(Direction::North);
    core::iter::once(first).chain(entered).collect()
}

fn mark_exploring(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let maze = sketch.maze();
    let entered = entered(maze, answer);
    let runs = Seen::new(maze, entered.iter().copied()).runs()?;
    if !runs.is_proven() {
        return Ok(runs.unproven());
    }
    let mut late = 0;
    while late < entered.len() {
        let before = &entered[..entered.len() - 1 - late];
        if !Seen::new(maze, before.iter().copied()).runs()?.is_proven() {
            break;
        }
        late += 1;
    }
    if late > 0 {
        let told = format!(
            "It is proven, but it already was {} ago. Explore again, and say so at once.",
            count(late, "move")
        );
        return Ok(LessonMark::new(false, told));
    }
    let run = runs.sure.unwrap_or_default();
    let cells: BTreeSet<Cell> = entered.iter().copied().collect();
    let told = format!(
        "Proven: no run has fewer than {}, whatever stands in the cells that nobody has seen. You \
         saw {} of {} cells. A micromouse by flood fill needs {}.",
        count(run.len() - 1, "move"),
        cells.len(),
        maze.grid().cell_count(),
        flood_fill(maze)?
    );
    let mut poses: Vec<(Cell, Direction)> = zipped(&entered);
    poses.extend(zipped(&run));
    let replay = film(
        "Explored, proven, run",
        maze,
        &[CellTrack::new("mouse", poses)],
    )?;
    Ok(LessonMark::new(true, told).showing(replay))
}

fn zipped(way: &[Cell]) -> Vec<(Cell, Direction)> {
    way.iter().copied().zip(headings(way)).collect()
}

/// Returns the number of cells that a mouse sees which always drives to the nearest cell that it
/// has not seen on a shortest run that may exist, until its run is proven.
fn flood_fill(maze: &Maze) -> Result<usize, PlaygroundError> {
    let mut at = start_of(maze).0;
    let mut seen = Seen::new(maze, [at]);
    // It sees a new cell at the latest after driving through all that it has seen.
    for _ in 0..maze.grid().cell_count().pow(2) {
        let runs = seen.runs()?;
        if runs.is_proven() {
            break;
        }
        let hoped = runs.hoped.unwrap_or_default();
        let unseen: Vec<Cell> = hoped
            .into_iter()
            .filter(|cell| !seen.cells.contains(cell))
            .collect();
        let way = seen.way(at, &unseen, Unknown::Open)?;
        let Some(next) = way.and_then(|way| way.get(1).copied()) else {
            break;
        };
        at = next;
        seen.cells.insert(at);
    }
    Ok(seen.cells.len())
}

fn view_proof(sketch: &Sketch, answer: &Answer) -> Result<TaskView, PlaygroundError> {
    let runs = Seen::new(sketch.maze(), answer.cells.iter().copied()).runs()?;
    let mut view = TaskView::of(sketch);
    view.facts = vec![
        ("cells chosen", answer.cells.len().to_string()),
        ("shortest run that surely exists", told(runs.sure.as_ref())),
        ("shortest run that may exist", told(runs.hoped.as_ref())),
    ];
    Ok(view)
}

fn mark_proof(sketch: &Sketch, answer: &Answer) -> Result<LessonMark, PlaygroundError> {
    let maze = sketch.maze();
    let chosen = Seen::new(maze, answer.cells.iter().copied());
    let runs = chosen.runs()?;
    if !runs.is_proven() {
        return Ok(runs.unproven());
    }
    let mut needless = Vec::new();
    for cell in &chosen.cells {
        let mut without = chosen.clone();
        without.cells.remove(cell);
        if without.runs()?.is_proven() {
            needless.push(*cell);
        }
    }
    if let Some(cell) = needless.first() {
        let told = format!(
            "Proven, but you looked at more than you need: {} could be left out. One is marked.",
            count(needless.len(), "cell")
        );
        return Ok(LessonMark {
            way: vec![*cell],
            ..LessonMark::new(false, told)
        });
    }
    let told = format!(
        "A proof with {}, and none of them can be left out. The other {} need not be explored.",
        count(chosen.cells.len(), "cell"),
        maze.grid().cell_count() - chosen.cells.len()
    );
    Ok(LessonMark::new(true, told))
}
