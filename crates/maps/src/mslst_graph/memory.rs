use alloc::collections::VecDeque;

use tolman_maze::Direction;

/// "It stores its current state and the action that got it there into a list."
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Experience {
    /// The action that led to the state, or `None` for the state the robot began in.
    pub action: Option<Direction>,
    /// Number of the quantizer's state.
    pub state: u32,
}

/// The robot's last experiences, "leaving out failed actions and the states they resulted in".
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Memory {
    length: usize,
    experiences: VecDeque<Experience>,
}

impl Memory {
    /// Returns a memory of the last `length` pairs of state and action, at least one. The paper
    /// uses eight in the Large maze and six in the J maze.
    #[must_use]
    pub fn new(length: usize) -> Self {
        let length = length.max(1);
        Self {
            length,
            experiences: VecDeque::with_capacity(length + 1),
        }
    }

    /// Forgets everything: the robot has been put somewhere, and finds itself in `state`.
    pub fn start(&mut self, state: u32) {
        self.experiences.clear();
        self.experiences.push_back(Experience {
            action: None,
            state,
        });
    }

    /// Takes in a successful action that led to `state`. Failed actions are not remembered.
    pub fn moved(&mut self, action: Direction, state: u32) {
        self.experiences.push_back(Experience {
            action: Some(action),
            state,
        });
        if self.experiences.len() > self.length {
            self.experiences.pop_front();
        }
    }

    /// Returns the experiences, the newest first; at most the memory's length.
    pub fn newest_first(&self) -> impl Iterator<Item = Experience> {
        self.experiences.iter().rev().copied()
    }
}
