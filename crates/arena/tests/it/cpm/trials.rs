//! What the tests of CPM on its robots begin with.

use std::sync::LazyLock;

use tolman_arena::course::Course;
use tolman_arena::cpm::{epuck_course, learn};
use tolman_systems::cpm::CommonPatterns;

/// Returns the course of a maze file.
pub(crate) fn course(text: &str) -> Course {
    epuck_course("", tolman_maze::read(text).unwrap()).unwrap()
}

/// Returns Maze 1 of the paper.
pub(crate) fn maze_1() -> Course {
    course(include_str!("../../../mazes/cpm-1.maze"))
}

/// Patterns learned in the learning maze.
pub(crate) static PATTERNS: LazyLock<CommonPatterns> = LazyLock::new(|| {
    let course = course(include_str!("../../../mazes/cpm-learning.maze"));
    learn(&course, 1).unwrap()
});
