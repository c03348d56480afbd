use alloc::collections::BTreeSet;

use super::world::{WorldBuilder, WorldError};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Point;
use tolman_maps::cpm::{Dictionary, theorem_1};
use tolman_maze::{Cell, Maze};
use tolman_systems::cpm::{Aim, Done};

use super::fragments::{TrueFragments, along};
use super::score::Score;
use super::trial::{Trial, TrialError};

/// A maze explored to its end: "the task is to obtain the complete map" (section 6).
#[derive(Clone, Debug, Default)]
pub struct Exploration {
    /// Why it ended; none if it broke off.
    pub done: Option<Done>,
    /// Whether each place and fragment of the maze is on the map once, and all are joined as they truly are.
    pub is_map_right: bool,
    /// Fragments walked, each as often as it was, until the robot knew that it had walked all.
    pub traversals: u32,
    /// Fragments of the maze that can be reached.
    pub fragments: u32,
    /// Fragments of the shortest walk from the start through all of them, for who knows the maze; none where that takes too long to find.
    pub best: Option<u32>,
    /// When the last fragment was walked, s; none if one was not.
    pub seconds: Option<f64>,
    /// Theorem 1's bound of that time, with the times that the robot took, s.
    pub bound: f64,
    /// Time steps in which its body touched a wall.
    pub bumps: u32,
    /// Why it broke off.
    pub trouble: Option<String>,
}

impl Trial<'_> {
    /// Explores the maze from the start until nothing is left to be walked. What goes wrong on the way is a result.
    ///
    /// # Errors
    /// [`TrialError`] if it cannot be begun.
    pub fn explore(&self) -> Result<Exploration, TrialError> {
        let walker = self.set_up()?;
        let start = *walker.body().path().first().ok_or(TrialError::NoStart)?;
        let mut found = Exploration {
            fragments: TrueFragments::of(self.maze).count(),
            best: shortest_covering_walk(self.maze)?,
            ..Exploration::default()
        };
        let mut agent = match self.begin(walker, self.mode.config()) {
            Ok(agent) => agent,
            Err(error) => {
                found.trouble = Some(error.to_string());
                return Ok(found);
            }
        };
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let mut score = Score::of(self.maze);
        score.begin(&agent, start);
        let begun_us = agent.walker().time_us();
        let mut ends_us = vec![begun_us];
        // How many fragments were known after each walk.
        let mut known = Vec::new();
        let episode = agent.pursue(Aim::Explore, &mut rng, |agent, step| {
            score.see(agent, step);
            ends_us.push(agent.walker().time_us());
            known.push(score.lengths.len() as u32);
        });
        match episode {
            Ok(episode) => found.done = Some(episode.done),
            Err(error) => found.trouble = Some(error.to_string()),
        }
        let seconds = |pair: &[u64]| (pair[1] - pair[0]) as f64 * 1e-6;
        let times: Vec<f64> = ends_us.windows(2).map(seconds).collect();
        // T₁ … of the fragments "the robot passes before detecting duplication".
        let first = (1..)
            .zip(&known)
            .take_while(|(walks, known)| walks == *known);
        let longest = times.iter().copied().fold(0.0, f64::max);
        found.bound = theorem_1(&times[..first.count()], longest, found.fragments);
        let last = known.iter().position(|known| *known == found.fragments);
        found.seconds = last.map(|last| times[..=last].iter().sum());
        found.traversals = agent.explorer().traversals();
        let walked_all = known.last() == Some(&found.fragments);
        found.is_map_right = walked_all && score.is_map_right(agent.explorer().map(), self.maze);
        found.bumps = agent.walker().body().bumps();
        Ok(found)
    }
}

/// Fragments of the shortest walk that begins at the start and has been through all of a maze.
fn shortest_covering_walk(maze: &Maze) -> Result<Option<u32>, WorldError> {
    let fragments = TrueFragments::of(maze);
    let places: BTreeSet<Cell> = fragments.ways().map(|(from, ..)| from).collect();
    let places: Vec<Cell> = places.into_iter().collect();
    let number = |cell: Cell| places.binary_search(&cell).ok().map(|place| place as u32);
    let middle = |cell: &Cell| Point::new(f64::from(cell.x), f64::from(cell.y));
    let mut drawing = WorldBuilder::new(Dictionary::new(1));
    for place in &places {
        drawing.place(middle(place), None);
    }
    for (from, out, way) in fragments.ways().filter(|(_, _, way)| way.is_forward) {
        let ends = number(from).zip(number(way.to));
        if let (Some((minus, plus)), Some((cells, _))) = (ends, along(maze, from, out)) {
            let between: Vec<Point> = cells[1..cells.len() - 1].iter().map(middle).collect();
            drawing.corridor(minus, plus, &between, &[])?;
        }
    }
    let Some(start) = maze.start().and_then(|(start, _)| number(start)) else {
        return Ok(None);
    };
    Ok(drawing.finish(start)?.shortest_covering_walk())
}

#[cfg(test)]
mod tests {
    use super::super::fragments::tests::THREE_WAYS;
    use super::*;

    #[test]
    fn the_shortest_covering_walk_goes_back_out_of_dead_ends() {
        let best = |text: &str| {
            let maze = tolman_maze::read(text).unwrap().maze;
            shortest_covering_walk(&maze).unwrap()
        };
        // From the start to the fork, into the dead end and back, to the goal.
        let fork = "\
start = 0 0 east

o---o---o---o
|   |   |   |
o---o   o---o
| S       G |
o---o---o---o
";
        assert_eq!(best(fork), Some(4));
        // All three on the way to the goal, none twice.
        assert_eq!(best(THREE_WAYS), Some(5));
    }
}
