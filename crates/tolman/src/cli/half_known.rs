//! Plans of mice in mazes with unknown walls, in words.

use std::path::Path;

use anyhow::anyhow;
use tolman_maze::{Cell, Direction, Maze, MazeFile};

use super::maze::{self, Collection};
use super::words::counted;
use super::{OrBadInput, Result};

/// Place of a mouse in a maze with unknown walls.
#[derive(clap::Args)]
pub(super) struct Whereabouts {
    /// Where the mouse is in a maze with unknown walls, if not at its start: column and row, and
    /// the side that it looks to if not north
    #[arg(long, value_name = "X,Y[,SIDE]", value_parser = maze::place)]
    at: Option<(Cell, Direction)>,
}

impl Whereabouts {
    /// Checks that the place is in a maze with unknown walls.
    ///
    /// # Errors
    /// Bad input if no maze has any, or the place is outside.
    pub(super) fn check(&self, collection: &Collection) -> Result {
        let Some((cell, _)) = self.at else {
            return Ok(());
        };
        let half_known = &collection.half_known;
        if half_known.is_empty() {
            return Err(anyhow!(
                "--at is for a maze with unknown walls, written as `.`: leave it out, or give --start"
            ))
            .or_bad_input();
        }
        let outside = half_known
            .iter()
            .find(|(_, file)| !file.maze.grid().contains(cell));
        match outside {
            Some((path, _)) => {
                let name = maze::name(path);
                Err(anyhow!("--at {cell} lies outside of {name}")).or_bad_input()
            }
            None => Ok(()),
        }
    }

    /// Returns the mouse's start in `maze`, and where it is.
    pub(super) fn in_maze(&self, maze: &Maze) -> [(Cell, Direction); 2] {
        let start = maze.start().unwrap_or((Cell::new(0, 0), Direction::North));
        [start, self.at.unwrap_or(start)]
    }
}

/// Plan of a mouse in a maze with unknown walls.
pub(super) struct Plan {
    /// Cost of the best run through known walls; `None` if there is none.
    pub(super) known: Option<u32>,
    /// Cost of the best run if all unknown walls were open; `None` if no way is left.
    pub(super) possible: Option<u32>,
    /// The best known run.
    pub(super) run: String,
    /// What the mouse does next, and where it is.
    pub(super) next: Option<(String, Cell)>,
}

impl Plan {
    /// Returns whether there is something to look for.
    pub(super) fn is_open(&self) -> bool {
        self.possible.is_some() && self.known != self.possible
    }

    /// Returns the plan in words, with costs as `amount` tells them.
    pub(super) fn told(
        &self,
        path: &Path,
        file: &MazeFile,
        amount: impl Fn(u32) -> String,
    ) -> String {
        let run = &self.run;
        let told = match (self.known, self.possible.map(&amount)) {
            (_, None) => "no way to a goal is left, whatever the unknown walls are".to_owned(),
            (None, Some(possible)) => {
                format!("no run is known; the best possible takes {possible}")
            }
            (Some(known), Some(_)) if !self.is_open() => format!(
                "the known run of {} is the best, whatever the unknown walls are: {run}",
                amount(known)
            ),
            (Some(known), Some(possible)) => format!(
                "the best known run takes {}, the best possible {possible}: {run}",
                amount(known)
            ),
        };
        let next = match &self.next {
            Some((next, at)) if self.is_open() => format!("; next, {next} from {at}"),
            _ => String::new(),
        };
        let unknown = counted(file.unknown.len(), "unknown wall");
        format!("{}: {unknown}: {told}{next}", maze::name(path))
    }
}
