//! A robot that is put down anywhere in a world of which it has a map.

use alloc::collections::BTreeMap;

use super::abstract_world::{AbstractRobot, AbstractWorld};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::diktiometry::{Action, Explained, FirstPlace, PlaceBelief, PlaceId};
use tolman_maze::Direction;

use super::walk::{ODOMETRY, Walk, alike, blocks, exits, painted, percept};

/// Returns a world of 5 × 5 places, learned, and another robot in it at place `start`.
fn learned(seed: u64, sees: bool) -> (Walk, BTreeMap<PlaceId, u32>, AbstractRobot) {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let world = AbstractWorld::from_maze(&blocks(5, 0.4, rng), 1.0);
    let config = if sees { painted() } else { alike() };
    let mut walk = Walk::new(world.clone(), ODOMETRY, config, seed);
    walk.wander(900);
    let truths = walk.truths();
    let start = rng.random_range(0_u32..25);
    let robot = AbstractRobot::new(world.into(), start, ODOMETRY, seed + 1000).unwrap();
    (walk, truths, robot)
}

#[test]
fn where_all_places_look_alike_their_ways_tell_them_apart() {
    let mut found = 0;
    for seed in 0..40 {
        let (mut walk, truths, robot) = learned(seed, false);
        let observer = walk.observer.clone();
        walk.robot = robot;
        let seen = FirstPlace {
            percept: None,
            exits: exits(&walk.robot),
        };
        let mut belief = PlaceBelief::put_down(&observer, &seen);
        let (mut moves, mut strayed) = (0, 0);
        while belief.places()[0].1 < 0.9 && moves < 40 {
            let telling = belief.telling_action(&observer);
            let told = telling.map(|Action(action)| Direction::ALL[action as usize]);
            let open = |direction: &Direction| {
                let here = walk.robot.at();
                walk.robot.world().neighbour(here, *direction).is_some()
            };
            let direction = told
                .filter(open)
                .unwrap_or_else(|| walk.robot.wander().unwrap());
            let moved = walk.robot.go(direction).unwrap();
            let step = walk.told(&moved);
            strayed += u32::from(belief.follow(&observer, &step) == Explained::NotAtAll);
            let whole: f64 = belief.places().iter().map(|(_, chance)| chance).sum();
            assert!((whole - 1.0).abs() < 1e-9, "{whole}");
            moves += 1;
        }
        // What is certain of the errors is true: the robot is never elsewhere than the map leads.
        assert_eq!(strayed, 0, "seed {seed}");
        let best = belief.places()[0].0;
        found += u32::from(truths.get(&best) == Some(&walk.robot.at()));
    }
    assert!(found >= 38, "{found} of 40");
}

#[test]
fn a_look_makes_few_places_likely_and_a_kidnapping_is_found_out() {
    for seed in 0..20 {
        let (mut walk, truths, robot) = learned(seed, true);
        let observer = walk.observer.clone();
        walk.robot = robot;
        let seen = FirstPlace {
            percept: Some(percept(walk.robot.look())),
            exits: exits(&walk.robot),
        };
        let mut belief = PlaceBelief::put_down(&observer, &seen);
        let at = |belief: &PlaceBelief| truths.get(&belief.places()[0].0).copied();
        for _ in 0..12 {
            let direction = walk.robot.wander().unwrap();
            let moved = walk.robot.go(direction).unwrap();
            belief.follow(&observer, &walk.told(&moved));
        }
        assert_eq!(at(&belief), Some(walk.robot.at()), "seed {seed}");
        let elsewhere = (walk.robot.at() + 12) % 25;
        let world = walk.robot.world().clone();
        walk.robot = AbstractRobot::new(world.into(), elsewhere, ODOMETRY, seed + 50).unwrap();
        for _ in 0..20 {
            let direction = walk.robot.wander().unwrap();
            let moved = walk.robot.go(direction).unwrap();
            belief.follow(&observer, &walk.told(&moved));
        }
        assert_eq!(at(&belief), Some(walk.robot.at()), "seed {seed}");
    }
}
