use tolman_maze::Maze;

use super::fragments::TrueFragments;

/// Walks per fragment of the maze after which a robot gives up. A way through all fragments takes
/// at most two for each, there and back, and robots that find it by themselves walked 1.3 times as
/// many as the best: whoever walks four times as many no longer knows again where he was.
const WALKS: u32 = 8;

/// Returns after how many walks a robot that learns a map of this maze
/// [gives up](tolman_systems::cpm::Done::OutOfPatience): eight for each fragment that there is. The
/// robot does not know how many there are; who sends it does.
#[must_use]
pub fn patience(maze: &Maze) -> u32 {
    WALKS * TrueFragments::of(maze).count().max(1)
}
