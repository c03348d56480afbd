//! Learns a maze by Q-learning, as the paper discusses it (section 3.2, equation 2).

use tolman_maze::{Cell, Direction, Maze};

use tolman_systems::baselines::q_learning::{LearningTask, Transition};

/// A maze as a learning task. A step is one cell in some direction and costs 1. A step against a
/// wall goes nowhere and costs 1, too. Cells are numbered by [`tolman_maze::Grid::index`].
#[derive(Clone, Debug)]
pub struct CellTask<'a> {
    maze: &'a Maze,
    cells: Vec<Cell>,
    start: usize,
}

impl<'a> CellTask<'a> {
    /// Returns the way from `start` to a goal of the maze.
    #[must_use]
    pub fn new(maze: &'a Maze, start: Cell) -> Self {
        Self {
            maze,
            cells: maze.grid().cells().collect(),
            start: maze.grid().index(start),
        }
    }
}

impl LearningTask for CellTask<'_> {
    fn start(&self) -> usize {
        self.start
    }

    fn states(&self) -> usize {
        self.cells.len()
    }

    fn actions(&self, _: usize) -> u32 {
        Direction::ALL.len() as u32
    }

    fn act(&self, state: usize, action: u32) -> Transition {
        let direction = Direction::ALL[action as usize % Direction::ALL.len()];
        let beside = self.maze.beside(self.cells[state], direction);
        Transition {
            next: beside.map_or(state, |cell| self.maze.grid().index(cell)),
            cost: 1,
        }
    }

    fn is_goal(&self, state: usize) -> bool {
        self.maze.goals().contains(&self.cells[state])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use tolman_systems::baselines::q_learning::{QLearner, QLearningConfig};

    #[test]
    fn it_learns_a_shortest_path_in_the_end() {
        let text = "\
o---o---o---o
|         G |
o   o---o   o
|   |       |
o   o   o   o
| S |       |
o---o---o---o
";
        let maze = tolman_maze::read(text).unwrap().maze;
        let task = CellTask::new(&maze, Cell::new(0, 0));
        let mut learner = QLearner::new(QLearningConfig::usual(), task);
        assert_eq!(learner.greedy_cost(), None, "it knows nothing yet");
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..2000 {
            learner.step(&mut rng);
        }
        assert_eq!(learner.greedy_cost(), Some(4));
    }
}
