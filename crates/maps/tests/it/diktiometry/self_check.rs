//! What a map says of itself is true while the bounds hold.

use alloc::collections::BTreeSet;

use super::abstract_world::AbstractWorld;
use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Interval, Point};
use tolman_maps::diktiometry::{Action, Apart, Config, MapState, PlaceId, WorldKind};

use super::walk::{ODOMETRY, Scripted, Walk, alike, blocks, painted};

/// Number of moves between two questions.
const ASKED: usize = 10;

/// Returns a mapper of corridors that nobody changes.
fn corridors(mut config: Config) -> Config {
    config.actions = Config::corridor_actions();
    config.world = WorldKind::Static;
    config.apart = Apart::Side;
    config
}

/// Returns a square of four places `side` apart, m, that all look alike but for their ways.
fn square(side: f64) -> AbstractWorld {
    let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)];
    let places = corners.map(|(x, y)| Point::new(side * x, side * y));
    let ways = [
        [Some(1), Some(3), None, None],
        [None, Some(2), Some(0), None],
        [None, None, Some(3), Some(1)],
        [Some(2), None, None, Some(0)],
    ];
    AbstractWorld::of_places(places.into(), ways.into()).unwrap()
}

/// Returns a robot in random corridors between blocks.
fn among_blocks(config: Config, seed: u64) -> Walk {
    let maze = blocks(5, 0.25, &mut ChaCha8Rng::seed_from_u64(seed));
    Walk::new(AbstractWorld::from_maze(&maze, 1.0), ODOMETRY, config, seed)
}

/// Returns a robot in a square whose sides are far too long to tell where they end.
fn round_and_round(seed: u64) -> Walk {
    Walk::new(square(60.0), ODOMETRY, corridors(alike()), seed)
}

#[test]
fn a_map_that_grows_without_end_says_so_before_long() {
    for seed in 0..10 {
        let mut walk = round_and_round(seed);
        let mut planner = Scripted::new(1.0, seed);
        let mut moves = 0;
        while !walk.observer.grows_without_end() {
            moves += 1;
            assert!(moves < 400, "seed {seed}: {:?}", walk.observer.self_check());
            planner.go(&mut walk);
        }
        let check = walk.observer.self_check();
        assert_eq!((check.state(), check.different()), (MapState::Endless, 4));
        let told = check.complaint().unwrap();
        assert!(told.contains("only 4 of its"), "{told}");
    }
}

#[test]
fn places_nearer_than_was_told_contradict_the_map() {
    let mut config = corridors(alike());
    (config.separation, config.alike_separation) = (2.0, 2.0);
    let mut walk = among_blocks(config, 1);
    walk.heed(0.3, 5);
    let check = walk.observer.self_check();
    assert_eq!(check.state(), MapState::Contradictory, "{check:?}");
    let told = check.complaint().unwrap();
    assert!(told.contains("`separation`"), "{told}");
}

/// A straight way cannot lead to where it begins, even if odometry says so.
#[test]
fn a_straight_way_back_to_where_it_begins_contradicts_the_map() {
    let ways = [1, 0].map(|other| [Some(other), None, Some(other), None]);
    let ends = [0.0, 1.0].map(|y| Point::new(0.0, y));
    let world = AbstractWorld::of_places(ends.into(), ways.into()).unwrap();
    let mut walk = Walk::new(world, ODOMETRY, corridors(alike()), 1);
    for _ in 0..20 {
        let direction = walk.robot.wander().unwrap();
        let moved = walk.robot.go(direction).unwrap();
        let mut step = walk.told(&moved);
        step.odometry.position.y = Interval::new(-0.1, 0.1).unwrap();
        walk.observer.step(&step).unwrap();
    }
    let check = walk.observer.self_check();
    assert_eq!((check.places, check.torn), (1, 1));
    assert_eq!(check.state(), MapState::Contradictory);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Where the bounds hold, no map contradicts itself or grows without end in corridors that can
    /// be told apart, and the world has as many places as the map calls different.
    #[test]
    fn no_map_objects_in_vain(seed in any::<u64>(), is_painted in any::<bool>(), heed in 0_u32..=3) {
        let config = corridors(if is_painted { painted() } else { alike() });
        let mut walk = among_blocks(config, seed);
        for _ in 0..20 {
            walk.heed(f64::from(heed) / 3.0, ASKED);
            let check = walk.observer.self_check();
            prop_assert_eq!((check.torn, check.crowded), (0, 0));
            prop_assert!(!walk.observer.grows_without_end(), "{:?}", check);
            prop_assert!(check.different() <= walk.score().visited, "{:?}", check);
        }
    }

    /// Even a map that grows without end has no more different places than the world.
    #[test]
    fn different_places_are_different(seed in any::<u64>(), heed in 0_u32..=3) {
        let mut walk = round_and_round(seed);
        for _ in 0..20 {
            walk.heed(f64::from(heed) / 3.0, ASKED);
            let check = walk.observer.self_check();
            prop_assert!(check.different() <= walk.score().visited, "{:?}", check);
            prop_assert_eq!(walk.observer.grows_without_end(), check.state() == MapState::Endless);
        }
    }

    /// All places that are truly one are open pairs, and a walk that would decide goes beyond what
    /// the map knows from one of them.
    #[test]
    fn places_that_are_one_are_open_pairs(seed in any::<u64>(), heed in 0_u32..=3, side in 3.0..60.0) {
        let mut walk = Walk::new(square(side), ODOMETRY, corridors(alike()), seed);
        walk.heed(f64::from(heed) / 3.0, 60);
        let truths = walk.truths();
        let paths = &walk.observer.map().paths;
        let open = walk.observer.open_pairs();
        let newer: BTreeSet<PlaceId> = open.iter().map(|pair| pair.newer).collect();
        prop_assert_eq!(newer.len(), walk.observer.self_check().repeated);
        let places: Vec<PlaceId> = paths.places().map(|(id, _)| id).collect();
        for (older, newer) in places.iter().flat_map(|a| places.iter().map(move |b| (*a, *b))) {
            if older < newer && truths[&older] == truths[&newer] {
                prop_assert!(open.iter().any(|pair| (pair.older, pair.newer) == (older, newer)));
            }
        }
        for pair in &open {
            prop_assert!(pair.offset.is_none_or(|offset| offset.contains(Point::origin())));
            let Some(walk_on) = &pair.walk else { continue };
            let other = if walk_on.from == pair.older { pair.newer } else { pair.older };
            let end = |from: PlaceId, actions: &[Action]| {
                actions.iter().try_fold(from, |at, action| {
                    Some(paths.link(paths.likeliest(at, *action)?)?.to)
                })
            };
            let (last, known) = walk_on.actions.split_last().unwrap();
            let here = end(walk_on.from, known).unwrap();
            prop_assert!(walk.observer.untried(here).contains(last));
            prop_assert!(end(other, &walk_on.actions).is_some());
        }
    }
}
