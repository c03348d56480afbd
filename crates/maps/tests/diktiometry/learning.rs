//! What is learned of worlds in which every place looks the same.

use tolman_maps::diktiometry::Config;

use super::walk::{ODOMETRY, Score, Walk, open};

#[test]
fn a_random_walk_teaches_a_world_of_alike_places() {
    for seed in 0..5 {
        let config = Config::new(Config::compass_actions(), 1.0);
        let mut walk = Walk::new(open(5), ODOMETRY, config, seed);
        walk.wander(700);
        let score = walk.score();
        let perfect = Score {
            purity: 1.0,
            places: 25,
            visited: 25,
            link_precision: 1.0,
            link_recall: 1.0,
        };
        assert_eq!(score, perfect, "seed {seed}");
        assert_eq!(walk.observer.map().check(4), None);
    }
}
