//! Start and goal given on the command line instead of in the maze's file.

use anyhow::anyhow;
use tolman_maze::{Cell, Direction, MazeFile};

use super::{OrBadInput, Result};

/// Start and goals that replace those of a maze.
#[derive(clap::Args)]
pub(in crate::cli) struct Marks {
    /// Start of the mouse, instead of that of the maze: column and row from the south-west, and the
    /// side that it looks to if not north, as in 0,0,east
    #[arg(long, value_name = "X,Y[,SIDE]", value_parser = place)]
    start: Option<(Cell, Direction)>,
    /// Goal cell, instead of those of the maze; may be given several times
    #[arg(long, value_name = "X,Y", value_parser = cell)]
    goal: Vec<Cell>,
}

impl Marks {
    /// Returns whether none is given.
    pub(in crate::cli) fn are_none(&self) -> bool {
        self.start.is_none() && self.goal.is_empty()
    }

    /// Puts the marks into a maze.
    ///
    /// # Errors
    /// Bad input if one lies outside.
    pub(in crate::cli) fn put(&self, file: &mut MazeFile) -> Result {
        let grid = file.maze.grid();
        let start = self.start.map(|(cell, _)| ("--start", cell));
        let goals = self.goal.iter().map(|cell| ("--goal", *cell));
        if let Some((flag, cell)) = start
            .into_iter()
            .chain(goals)
            .find(|(_, cell)| !grid.contains(*cell))
        {
            let (width, height) = (grid.width(), grid.height());
            return Err(anyhow!(
                "{flag} {cell} lies outside of the maze of {width} × {height} cells; columns and rows are counted from 0"
            ))
            .or_bad_input();
        }
        if self.start.is_some() {
            file.maze.set_start(self.start);
        }
        if !self.goal.is_empty() {
            file.maze.set_goals(self.goal.clone());
            file.goal_is_assumed = false;
        }
        Ok(())
    }
}

fn cell(text: &str) -> Result<Cell, String> {
    let number = |text: &str| text.trim().parse::<u16>().ok();
    text.split_once(',')
        .and_then(|(x, y)| Some(Cell::new(number(x)?, number(y)?)))
        .ok_or_else(|| {
            "expected a column and a row, counted from 0 in the south-west, as in 7,8".to_owned()
        })
}

/// Reads a cell, and the side that a mouse looks to there.
pub(in crate::cli) fn place(text: &str) -> Result<(Cell, Direction), String> {
    let side = |word: &str| {
        let mut sides = Direction::ALL.into_iter();
        sides.find(|side| side.to_string() == word)
    };
    match text.rsplit_once(',') {
        Some((at, word)) if word.starts_with(char::is_alphabetic) => {
            let heading =
                side(word).ok_or("expected north, east, south or west, as in 0,0,east")?;
            Ok((cell(at)?, heading))
        }
        _ => Ok((cell(text)?, Direction::North)),
    }
}
