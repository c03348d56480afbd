//! Targets of the robust explorer.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_systems::cpm::{Aim, CpmConfig, Done, Explorer};

use super::explorations::pursue;
use super::world::{MapCheck, MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkerNoise};

#[derive(Debug, Default)]
struct Tally {
    runs: u32,
    /// Number of runs that explored the maze to the end, with a map that equals the maze.
    right: u32,
    /// Sum of ratios over the measured runs: fragments walked over those of the best covering walk.
    ratio: f64,
    /// Number of measured runs: those in mazes whose best covering walk is known.
    measured: u32,
}

impl Tally {
    fn explore(
        &mut self,
        maze: &MazeConfig,
        noise: WalkerNoise,
        reckoning: Reckoning,
        mut config: CpmConfig,
        rng: &mut ChaCha8Rng,
    ) {
        let world = PlaneMaze::random(maze, rng).unwrap();
        let mut rover = PlaneWalker::new(&world, noise, reckoning);
        config.most_traversals = 8 * world.corridors().len() as u32;
        let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
        let done = pursue(&mut explorer, &mut rover, Aim::Explore, rng);
        let check = world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at());
        self.runs += 1;
        self.right += u32::from((done, check) == (Done::Reached, MapCheck::Right));
        if let Some(best) = world.covering_walk() {
            self.ratio += f64::from(explorer.mapper.traversals()) / f64::from(best);
            self.measured += 1;
        }
    }

    fn mean_ratio(&self) -> f64 {
        self.ratio / f64::from(self.measured)
    }
}

#[test]
fn aliased_and_symmetrical_mazes_are_mapped_rightly() {
    let mut rng = ChaCha8Rng::seed_from_u64(20);
    let mut tally = Tally::default();
    for number in 0..200 {
        let maze = MazeConfig::any_alike(number);
        tally.explore(
            &maze,
            WalkerNoise::NOISY,
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
            tally.explore(
                &MazeConfig::any(number),
                WalkerNoise::NONE,
                reckoning,
                config,
                &mut rng,
            );
        }
        println!("{tally:?}: {:.3}", tally.mean_ratio());
        assert_eq!(tally.right, 200, "{tally:?}");
        assert!(tally.mean_ratio() <= 1.5, "{}", tally.mean_ratio());
    }
}
