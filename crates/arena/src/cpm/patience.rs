use tolman_maze::Maze;

use super::fragments::TrueFragments;

/// Number of walks per fragment of the maze after which a robot gives up. A way through all
/// fragments takes at most two for each, there and back. Robots that find it by themselves walked
/// 1.3 times as many as the best. A robot that walks four times as many no longer recognizes its
/// places.
const WALKS: u32 = 8;

/// Returns the number of walks after which a robot that learns this maze
/// [gives up](tolman_systems::cpm::Done::OutOfPatience): eight for each fragment. The robot does
/// not know the number of fragments; the caller does.
#[must_use]
pub fn patience(maze: &Maze) -> u32 {
    WALKS * TrueFragments::of(maze).count().max(1)
}
