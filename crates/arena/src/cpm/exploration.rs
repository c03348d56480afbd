use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::theorem_1;
use tolman_maze::Maze;
use tolman_systems::cpm::{Aim, Done, FragmentStep, Layer3, Walker};

use super::covering_walk::covering_walk;
use super::fragments::TrueFragments;
use super::pursue::pursue;
use super::robots::SimulatedEpuck;
use super::score::Score;
use super::trial::{CpmTrial, CpmTrialError};

/// A maze explored to its end: "the task is to obtain the complete map" (section 6).
#[derive(Clone, Debug, Default)]
pub struct Exploration {
    /// Reason why the exploration ended, or `None` if it broke off.
    pub done: Option<Done>,
    /// Whether each place and fragment of the maze is on the map once, and all are joined as in the
    /// maze.
    pub is_map_right: bool,
    /// Number of walks along fragments until the robot knew that it had walked all.
    pub traversals: u32,
    /// Number of fragments of the maze that can be reached.
    pub fragments: u32,
    /// Number of fragments of the shortest walk from the start through all of them, with full
    /// knowledge of the maze. `None` if it takes too long to find.
    pub best: Option<u32>,
    /// Time when the last fragment was walked, s; `None` if one was not.
    pub seconds: Option<f64>,
    /// Theorem 1's bound of that time, with the robot's own durations, s.
    pub bound: f64,
    /// Number of time steps in which the robot's body touched a wall.
    pub bumps: u32,
    /// Reason why the exploration broke off.
    pub trouble: Option<String>,
}

impl CpmTrial<'_> {
    /// Explores the maze from the start until all is walked, and returns the result. Failures on
    /// the way are part of the result.
    ///
    /// # Errors
    /// [`CpmTrialError`] if it cannot be begun.
    pub fn explore(&self) -> Result<Exploration, CpmTrialError> {
        let maze = &self.course.maze;
        let mut walker = self.walker_at(self.course.start()?)?;
        let mut found = Exploration {
            fragments: TrueFragments::of(maze).count(),
            best: best_walk(maze),
            ..Exploration::default()
        };
        let mut layer = match self.begin(&mut walker, self.mode.config()) {
            Ok(layer) => layer,
            Err(error) => {
                found.trouble = Some(error.to_string());
                return Ok(found);
            }
        };
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let mut score = Score::of(maze);
        score.begin(&layer, &walker);
        let mut ends_us = vec![walker.time_us()];
        // How many fragments were known after each walk.
        let mut known = Vec::new();
        let see = |layer: &Layer3, walker: &Walker<SimulatedEpuck>, step: &FragmentStep| {
            score.see(layer, walker, step);
            ends_us.push(walker.time_us());
            known.push(score.lengths.len() as u32);
        };
        match pursue(&mut layer, &mut walker, Aim::Explore, &mut rng, see) {
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
        found.traversals = layer.explorer().mapper.traversals();
        let walked_all = known.last() == Some(&found.fragments);
        found.is_map_right = walked_all && score.is_map_right(layer.map(), maze);
        found.bumps = walker.body().bumps();
        Ok(found)
    }
}

/// Returns the number of fragments of the shortest walk from the start through all of a maze.
fn best_walk(maze: &Maze) -> Option<u32> {
    let (start, _) = maze.start()?;
    let ways = TrueFragments::of(maze).graph(maze, |_| Some(1));
    let best = covering_walk(&ways, maze.grid().index(start) as u32);
    // No walk leads out of a start that is walled in.
    best.filter(|fragments| *fragments > 0)
}

#[cfg(test)]
mod tests {
    use super::super::fragments::tests::THREE_WAYS;
    use super::*;

    #[test]
    fn the_shortest_covering_walk_goes_back_out_of_dead_ends() {
        let best = |text: &str| {
            let maze = tolman_maze::read(text).unwrap().maze;
            best_walk(&maze)
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
