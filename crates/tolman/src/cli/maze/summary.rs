//! The figures printed beside a maze's drawing.

use core::fmt;

use serde::Serialize;
use tolman_maze::{Cell, MazeFile};

use crate::cli::words::counted;

/// Figures of a maze, displayed as one line.
#[derive(Serialize)]
pub(super) struct Summary {
    file: String,
    name: Option<String>,
    columns: u16,
    rows: u16,
    corridor_width_m: Option<f64>,
    start: Option<Start>,
    goals: Vec<[u16; 2]>,
    /// Whether no goal is marked, and the middle was taken.
    goal_is_assumed: bool,
    /// Number of walls that may stand or not.
    unknown_walls: usize,
    dead_ends: usize,
    junctions: usize,
    /// Number of cells that are open to some side but have no way to a goal.
    sealed: usize,
    /// Number of cells from the start to the nearest goal; `None` if there is no start or no way.
    shortest_way: Option<u32>,
}

#[derive(Serialize)]
struct Start {
    cell: [u16; 2],
    heading: String,
}

impl Summary {
    pub(super) fn of(file: String, read: &MazeFile) -> Self {
        let maze = &read.maze;
        let grid = maze.grid();
        let steps = maze.steps_to_goal();
        let of_degree = |wanted: fn(usize) -> bool| {
            let in_use = maze.reachable();
            in_use.filter(|cell| wanted(maze.degree(*cell))).count()
        };
        let pair = |cell: Cell| [cell.x, cell.y];
        Self {
            file,
            name: read.name.clone(),
            columns: grid.width(),
            rows: grid.height(),
            corridor_width_m: read.corridor_width,
            start: maze.start().map(|(cell, heading)| Start {
                cell: pair(cell),
                heading: heading.to_string(),
            }),
            goals: maze.goals().iter().copied().map(pair).collect(),
            goal_is_assumed: read.goal_is_assumed,
            unknown_walls: read.unknown.len(),
            dead_ends: of_degree(|ways| ways == 1),
            junctions: of_degree(|ways| ways > 2),
            sealed: maze.sealed().count(),
            shortest_way: maze.start().and_then(|(start, _)| steps[grid.index(start)]),
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            formatter,
            "{}: {} × {} cells",
            self.file, self.columns, self.rows
        )?;
        if let Some(width) = self.corridor_width_m {
            write!(formatter, " of {width} m")?;
        }
        match &self.start {
            Some(Start {
                cell: [x, y],
                heading,
            }) => {
                write!(formatter, ", start ({x}, {y}) {heading}")?;
            }
            None => write!(formatter, ", no start")?,
        }
        let (goals, dead_ends, junctions) = (self.goals.len(), self.dead_ends, self.junctions);
        write!(
            formatter,
            ", {}{}, {}, {}",
            counted(goals, "goal cell"),
            if self.goal_is_assumed {
                " (the middle: none is marked)"
            } else {
                ""
            },
            counted(dead_ends, "dead end"),
            counted(junctions, "junction")
        )?;
        if self.unknown_walls > 0 {
            write!(
                formatter,
                ", {}",
                counted(self.unknown_walls, "unknown wall")
            )?;
        }
        if self.sealed > 0 {
            write!(formatter, ", {} sealed off", counted(self.sealed, "cell"))?;
        }
        match self.shortest_way {
            Some(steps) => write!(
                formatter,
                ", shortest way {}",
                counted(steps as usize, "cell")
            ),
            None => Ok(()),
        }
    }
}
