//! Chooses the mouse's action in a cell.

use tolman_maze::{Cell, Direction};
use tolman_planners::moves::Leap;
use tolman_planners::{Passages, TooLarge, Unknown};
use tolman_robot::{Standing, Task};

use super::MazeMouse;
use crate::micromouse::{Next, Search, SearchView};

/// Choice of a mouse in a cell.
pub(super) enum Choice {
    /// Leave this cell and the next ones by these sides, the last one first.
    Drive(Vec<Direction>),
    /// Turn right.
    Turn,
    /// Nothing more.
    End(Standing),
}

impl<S: Search> MazeMouse<S> {
    pub(super) fn choose(&mut self, task: Task) -> Choice {
        let choice = match task {
            Task::Explore => self.choose_to_explore(),
            Task::Reach(goal) => match self.brief.cells_of(goal) {
                Ok(targets) => self.choose_to_reach(&targets),
                Err(standing) => Ok(Choice::End(standing)),
            },
            // It is told where it starts, and follows its way from there.
            Task::Localize => Ok(Choice::End(Standing::Done)),
        };
        choice.unwrap_or_else(|too_large| give_up(too_large.to_string()))
    }

    fn choose_to_explore(&mut self) -> Result<Choice, TooLarge> {
        let view = SearchView {
            map: &self.walls,
            at: self.at,
            start: self.brief.start,
            goals: &self.brief.goals,
        };
        Ok(match self.search.next(&view)? {
            Next::Drive(leap) => Choice::Drive(sides(&[leap])),
            Next::Turn => Choice::Turn,
            Next::Reset => Choice::End(Standing::Done),
            Next::Stuck => give_up("no way leads to a goal"),
        })
    }

    fn choose_to_reach(&self, targets: &[Cell]) -> Result<Choice, TooLarge> {
        if targets.contains(&self.at) {
            return Ok(Choice::End(Standing::Done));
        }
        if let Some(run) = self.run(Unknown::Closed, self.at, targets)? {
            return Ok(Choice::Drive(sides(&run)));
        }
        // What it sees at the end of the first leap may change the rest.
        Ok(
            match self.run(Unknown::Open, self.at, targets)?.as_deref() {
                Some([leap, ..]) => Choice::Drive(sides(&[*leap])),
                _ => give_up("no way leads there"),
            },
        )
    }

    /// Returns the best run that is certain or can be hoped for, or `None` if there is none.
    ///
    /// # Errors
    /// If the maze has more than [`SIDE`](crate::micromouse::SIDE) columns or rows.
    pub(super) fn run(
        &self,
        unknown: Unknown,
        from: Cell,
        targets: &[Cell],
    ) -> Result<Option<Vec<Leap>>, TooLarge> {
        let passages = Passages::new(&self.walls, unknown)?;
        Ok(self.run_two.plan(&passages, from, targets))
    }
}

fn give_up(why: impl Into<String>) -> Choice {
    Choice::End(Standing::gave_up(why))
}

/// Returns the sides by which the leaps leave their cells, the first one last.
fn sides(leaps: &[Leap]) -> Vec<Direction> {
    let sides = leaps
        .iter()
        .flat_map(|leap| (0..leap.cells).map(|_| leap.direction));
    let mut sides: Vec<Direction> = sides.collect();
    sides.reverse();
    sides
}
