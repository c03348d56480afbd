//! Q-learning in a maze, as the paper discusses it (section 3.2, equation 2).

use rand::{Rng, RngExt};
use tolman_maze::{Cell, Direction, Maze};

/// How to learn. The paper names none of these values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QLearningConfig {
    /// α of equation 2, 0 … 1.
    pub learning_rate: f64,
    /// γ of equation 2, 0 … 1.
    pub discount: f64,
    /// The share of actions that are chosen by chance, 0 … 1.
    pub exploration: f64,
}

impl QLearningConfig {
    /// Usual values for a world without chance in it.
    #[must_use]
    pub const fn usual() -> Self {
        Self {
            learning_rate: 1.0,
            discount: 1.0,
            exploration: 0.05,
        }
    }
}

/// A table of values *Q*(cell, direction), learned step by step: a step is one cell in some direction, against a wall
/// it is none, and each is rewarded with −1 until a goal is reached and the learner is put back to the start. It begins
/// with zeros, which nothing is worth more than, so that it tries everything.
#[derive(Clone, Debug)]
pub struct QLearner<'a> {
    config: QLearningConfig,
    maze: &'a Maze,
    start: Cell,
    /// By [`tolman_maze::Grid::index`], then [`Direction::index`].
    values: Vec<[f64; 4]>,
    at: Cell,
}

impl<'a> QLearner<'a> {
    /// A learner in `start` that knows nothing.
    #[must_use]
    pub fn new(config: QLearningConfig, maze: &'a Maze, start: Cell) -> Self {
        Self {
            config,
            maze,
            start,
            values: vec![[0.0; 4]; maze.grid().cell_count()],
            at: start,
        }
    }

    /// One step.
    pub fn step(&mut self, rng: &mut impl Rng) {
        let (state, action) = (self.maze.grid().index(self.at), self.action(rng));
        let next = self.beyond(self.at, action);
        let done = self.maze.goals().contains(&next);
        let future = if done {
            0.0
        } else {
            let values = self.values[self.maze.grid().index(next)];
            values.into_iter().fold(f64::MIN, f64::max)
        };
        let QLearningConfig {
            learning_rate,
            discount,
            ..
        } = self.config;
        let value = &mut self.values[state][action.index()];
        *value += learning_rate * (-1.0 + discount * future - *value);
        self.at = if done { self.start } else { next };
    }

    fn action(&self, rng: &mut impl Rng) -> Direction {
        if rng.random_bool(self.config.exploration) {
            return Direction::ALL[rng.random_range(0..4_u32) as usize];
        }
        self.best(self.at)
    }

    /// The action of greatest value; of equals the first.
    fn best(&self, cell: Cell) -> Direction {
        let values = self.values[self.maze.grid().index(cell)];
        let mut best = Direction::North;
        for direction in Direction::ALL {
            if values[direction.index()] > values[best.index()] {
                best = direction;
            }
        }
        best
    }

    fn beyond(&self, cell: Cell, direction: Direction) -> Cell {
        self.maze.beside(cell, direction).unwrap_or(cell)
    }

    /// The cells from the start to a goal that what is learned leads over, none if it leads to none.
    #[must_use]
    pub fn path_cells(&self) -> Option<u32> {
        let mut at = self.start;
        for cells in 0..=self.maze.grid().cell_count() as u32 {
            if self.maze.goals().contains(&at) {
                return Some(cells);
            }
            at = self.beyond(at, self.best(at));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

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
        let mut learner = QLearner::new(QLearningConfig::usual(), &maze, Cell::new(0, 0));
        assert_eq!(learner.path_cells(), None, "it knows nothing yet");
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..2000 {
            learner.step(&mut rng);
        }
        assert_eq!(learner.path_cells(), Some(4));
    }
}
