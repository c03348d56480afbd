//! The mouse with noisy sensors.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_arena::micromouse::noisy::{NoisyConfig, NoisyTrial, send};
use tolman_maze::Braided;
use tolman_systems::micromouse::noisy::PoseSource;

fn outcome(localization: PoseSource, level: f64) -> NoisyTrial {
    let braided = Braided {
        width: 12,
        height: 12,
        share: 0.5,
    };
    let mut maze = braided.generate(&mut ChaCha8Rng::seed_from_u64(1)).unwrap();
    maze.set_goals(maze.grid().middle().collect());
    send(&maze, &NoisyConfig::ordinary(localization, level), 1).unwrap()
}

#[test]
fn the_filter_copes_with_noise_that_leads_dead_reckoning_astray() {
    let quiet = outcome(PoseSource::DeadReckoning, 0.0);
    let filtered = outcome(PoseSource::ParticleFilter, 2.0);
    let reckoned = outcome(PoseSource::DeadReckoning, 2.0);
    assert!(quiet.verdict.score().is_some());
    assert_eq!(filtered.verdict, quiet.verdict, "the noise costs no step");
    assert_eq!(reckoned.verdict.score(), None);
    assert!(filtered.mean_error < 0.01 && reckoned.mean_error > 0.02);
}
