//! What is asked of the robust explorer.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::cpm::world::{Likeness, MapCheck, MazeConfig, Noise, Reckoning, Rover, World};
use tolman_systems::cpm::{Aim, CpmConfig, Done, Explorer};

use super::explorations::pursue;

#[derive(Debug, Default)]
struct Tally {
    runs: u32,
    /// Explored to the end, and the map is the maze.
    right: u32,
    /// Fragments walked, over those of the best covering walk; summed.
    ratio: f64,
    /// How many runs that is of: where the best walk is known.
    measured: u32,
}

impl Tally {
    fn explore(
        &mut self,
        maze: &MazeConfig,
        noise: Noise,
        reckoning: Reckoning,
        config: CpmConfig,
        rng: &mut ChaCha8Rng,
    ) {
        let world = World::random(maze, rng).unwrap();
        let mut rover = Rover::new(&world, noise, reckoning);
        let most_traversals = 8 * world.corridors().len() as u32;
        let config = CpmConfig {
            most_traversals,
            ..config
        };
        let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
        let done = pursue(&mut explorer, &mut rover, &world, Aim::Explore, rng);
        let check = world.check(explorer.map(), explorer.at(), rover.at());
        self.runs += 1;
        self.right += u32::from((done, check) == (Done::Reached, MapCheck::Right));
        if let Some(best) = world.shortest_covering_walk() {
            self.ratio += f64::from(explorer.traversals()) / f64::from(best);
            self.measured += 1;
        }
    }

    fn mean_ratio(&self) -> f64 {
        self.ratio / f64::from(self.measured)
    }
}

/// What the paper's robot has and more: 10 % slip, one observation in ten mistaken.
const NOISY: Noise = Noise {
    substitution: 0.1,
    insertion: 0.03,
    deletion: 0.03,
    slip: 0.1,
    heading: 0.1,
};

/// The mazes of all sorts: from trees to all loops there may be, ports in four directions or in eight.
fn any_maze(number: u32) -> MazeConfig {
    MazeConfig {
        columns: 3 + number % 2,
        rows: 3 + number / 2 % 2,
        loops: f64::from(number % 5) / 4.0,
        diagonals: f64::from(number % 3) / 2.0,
        ..MazeConfig::small()
    }
}

#[test]
fn aliased_and_symmetrical_mazes_are_mapped_rightly() {
    let mut rng = ChaCha8Rng::seed_from_u64(20);
    let mut tally = Tally::default();
    for number in 0..200 {
        let likeness = Likeness::Kinds(1 + number % 3);
        let symmetrical = f64::from(number % 4) / 3.0;
        let maze = MazeConfig {
            likeness,
            symmetrical,
            ..any_maze(number)
        };
        tally.explore(
            &maze,
            NOISY,
            Reckoning::Bounded,
            CpmConfig::robust(),
            &mut rng,
        );
    }
    println!("{tally:?}: {:.3}", tally.mean_ratio());
    assert!(tally.right >= 190, "{tally:?}");
    assert!(tally.mean_ratio() <= 1.5, "{}", tally.mean_ratio());
}

#[test]
fn online_walks_little_more_than_it_has_to() {
    for (config, reckoning) in [
        (CpmConfig::online(), Reckoning::None),
        (CpmConfig::robust(), Reckoning::Bounded),
    ] {
        let mut rng = ChaCha8Rng::seed_from_u64(21);
        let mut tally = Tally::default();
        for number in 0..200 {
            tally.explore(&any_maze(number), Noise::NONE, reckoning, config, &mut rng);
        }
        println!("{tally:?}: {:.3}", tally.mean_ratio());
        assert_eq!(tally.right, 200, "{tally:?}");
        assert!(tally.mean_ratio() <= 1.5, "{}", tally.mean_ratio());
    }
}
