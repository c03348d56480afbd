use tolman_maze::{Cell, Direction};

use super::Answer;
use crate::Sketch;

/// The maze of a task with the pupil's changes.
#[derive(Clone, Debug)]
pub(super) struct Edited {
    pub(super) sketch: Sketch,
    /// Number of walls that the pupil removed.
    pub(super) removed: usize,
    /// Number of walls that the pupil built.
    pub(super) built: usize,
}

impl Edited {
    /// Changes each wall of the answer once. A wall that is named twice is as before.
    pub(super) fn new(task: &Sketch, answer: &Answer) -> Self {
        let mut sketch = task.clone();
        for &(cell, side) in &answer.walls {
            if sketch.maze().grid().contains(cell) {
                let stands = !sketch.maze().is_open(cell, side);
                sketch.set_wall(cell, side, !stands);
            }
        }
        let (before, now) = (task.maze(), sketch.maze());
        let sides = || {
            let cells = before.grid().cells();
            cells.flat_map(|cell| [(cell, Direction::North), (cell, Direction::East)])
        };
        let is_open =
            |(cell, side): (Cell, Direction)| (before.is_open(cell, side), now.is_open(cell, side));
        let (removed, built) = (
            sides()
                .filter(|side| is_open(*side) == (false, true))
                .count(),
            sides()
                .filter(|side| is_open(*side) == (true, false))
                .count(),
        );
        Self {
            sketch,
            removed,
            built,
        }
    }
}
