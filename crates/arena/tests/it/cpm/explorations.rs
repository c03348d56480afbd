//! Random mazes, explored to their end.

use core::ops::ControlFlow;

use alloc::collections::BTreeSet;

use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::{
    Candidates, Dictionary, JunctionId, MapUpdate, Mapping, PatternId, theorem_1,
};
use tolman_robot::Landmark;
use tolman_systems::cpm::{Aim, CpmConfig, Done, Explorer, Leg, Onward};

use super::world::{
    Likeness, MapCheck, MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkOutcome, WalkerNoise,
};

/// Lets an explorer pursue an aim.
pub(crate) fn pursue(
    explorer: &mut Explorer,
    rover: &mut PlaneWalker<'_>,
    aim: Aim,
    rng: &mut ChaCha8Rng,
) -> Done {
    let see = |_: &PlaneWalker<'_>, _: &Explorer, leg: &Leg, arrival| {
        assert!(leg.known.is_some() || arrival != MapUpdate::Known);
    };
    rover.pursue(explorer, aim, rng, see).unwrap()
}

fn mazes() -> impl Strategy<Value = (MazeConfig, u64)> {
    (2_u32..6, 2_u32..6, 0.0..1.0, 0.0..1.0, any::<u64>()).prop_map(
        |(columns, rows, loops, diagonals, seed)| {
            let mut config = MazeConfig::small();
            config.columns = columns;
            config.rows = rows;
            config.loops = loops;
            config.diagonals = diagonals;
            (config, seed)
        },
    )
}

fn is_goal(explorer: &Explorer) -> impl Fn(JunctionId) -> bool {
    let goals: Vec<JunctionId> = explorer.mapper.map().landmarks(Landmark::Goal).collect();
    move |id| goals.contains(&id)
}

fn drawn((maze, seed): (MazeConfig, u64)) -> (PlaneMaze, ChaCha8Rng) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (PlaneMaze::random(&maze, &mut rng).unwrap(), rng)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, max_shrink_iters: 32, ..ProptestConfig::default() })]

    #[test]
    fn online_every_maze_is_explored_rightly_and_within_theorem_1(maze in mazes()) {
        let (world, rng) = drawn(maze);
        for (mut config, reckoning) in [
            (CpmConfig::online(), Reckoning::None),
            (CpmConfig::robust(), Reckoning::Bounded),
        ] {
            // Several times what any of these mazes needs: who goes round forever is told soon.
            config.most_traversals = 400;
            let mut rng = rng.clone();
            let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, reckoning);
            let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
            // How many fragments it has walked when it has walked all, whether it knows that or
            // not.
            let mut walked = BTreeSet::new();
            let mut until_all = 0;
            let done = rover.pursue(&mut explorer, Aim::Explore, &mut rng, |rover, explorer, _, _| {
                if walked.insert(world.end_at(rover.at()).unwrap().corridor) {
                    until_all = explorer.mapper.traversals();
                }
            });
            prop_assert_eq!(done.unwrap(), Done::Reached);
            prop_assert_eq!(world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at()), MapCheck::Right);
            prop_assert_eq!(explorer.mapper.map().fragments().len(), world.corridors().len());
            prop_assert!(explorer.mapper.map().is_optimized(&CpmConfig::online().matching, world.dictionary()));
            prop_assert!(explorer.mapper.map().is_complete());
            prop_assert_eq!(explorer.mapper.contradictions(), 0);
            let first = explorer.mapper.before_duplicate().unwrap_or(explorer.mapper.traversals());
            let fragments = world.corridors().len() as u32;
            let bound = theorem_1(&vec![1.0; first as usize], 1.0, fragments);
            prop_assert!(f64::from(until_all) <= bound, "{until_all} of {bound}");
            if let Some(best) = world.covering_walk() {
                prop_assert!(explorer.mapper.traversals() >= best);
            }
        }
    }

    #[test]
    fn offline_the_goal_is_found_and_the_map_is_right(maze in mazes()) {
        let (world, mut rng) = drawn(maze);
        let mut config = CpmConfig::online();
        config.mapping = Mapping::Offline { patience: 100 };
        let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
        let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
        let done = pursue(&mut explorer, &mut rover, Aim::Find(Landmark::Goal), &mut rng);
        prop_assert_eq!(done, Done::Reached);
        explorer.mapper.optimize(world.dictionary()).unwrap();
        prop_assert!(explorer.mapper.map().is_optimized(&config.matching, world.dictionary()));
        prop_assert!(explorer.mapper.map().has_goal());
        // Junctions that no fragment has shown to be the same may still be there twice.
        let check = world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at());
        prop_assert_ne!(check, MapCheck::Wrong);
        // The way from the start that the second episode drives.
        prop_assert!(explorer.mapper.plan(Landmark::Start).is_some());
    }

    #[test]
    fn the_way_back_ends_at_the_start(maze in mazes()) {
        let (world, mut rng) = drawn(maze);
        let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
        let mut explorer = Explorer::new(CpmConfig::online(), rover.sighting()).unwrap();
        let start = explorer.mapper.at();
        pursue(&mut explorer, &mut rover, Aim::Find(Landmark::Goal), &mut rng);
        // How far the goal is from the start, for a robot that is put there again.
        let mut known = vec![explorer.mapper.map().plan(start, is_goal(&explorer)).unwrap().length];
        for aim in [Aim::WayBack, Aim::Shortest, Aim::Explore] {
            prop_assert_eq!(pursue(&mut explorer, &mut rover, aim, &mut rng), Done::Reached);
            if aim == Aim::WayBack {
                prop_assert_eq!(rover.sighting().landmark, Some(Landmark::Start));
            }
            explorer.mapper.place(start).unwrap();
            rover.place(world.start());
            known.push(explorer.mapper.map().plan(start, is_goal(&explorer)).unwrap().length);
        }
        prop_assert!(known.is_sorted_by(|earlier, later| earlier >= later), "{:?}", known);
        // What was certified to be shortest is.
        prop_assert_eq!(known[2], known[3]);
    }

    #[test]
    fn nothing_runs_for_ever(kinds in 1_u32..4, symmetrical in 0.0..1.0, noise in 0.0..1.0, slip in 0.0..0.99, seed in any::<u64>()) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let likeness = Likeness::Kinds(kinds);
        let mut maze = MazeConfig::small();
        maze.likeness = likeness;
        maze.symmetrical = symmetrical;
        maze.diagonals = 0.5;
        let world = PlaneMaze::random(&maze, &mut rng).unwrap();
        let noise = WalkerNoise { substitution: noise, insertion: noise / 2.0, deletion: noise / 2.0, slip, heading: 0.1 };
        for onward in [Onward::ShortestKnownWay, Onward::GoOn] {
            let mut config = CpmConfig::online();
            config.onward = onward;
            config.most_traversals = 60;
            let mut rover = PlaneWalker::new(&world, noise, Reckoning::None);
            let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
            for aim in [Aim::Find(Landmark::Goal), Aim::WayBack, Aim::Shortest, Aim::Explore] {
                pursue(&mut explorer, &mut rover, aim, &mut rng);
            }
            prop_assert!(explorer.mapper.traversals() <= 60);
        }
    }
}

/// A beam as narrow as can be loses the truth, finds out, and looks again with a wider one.
#[test]
fn the_truth_is_found_again() {
    let mut revised = 0;
    for seed in 0..100 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut maze = MazeConfig::small();
        maze.columns = 4;
        maze.rows = 4;
        maze.loops = 0.9;
        maze.diagonals = 0.9;
        let world = PlaneMaze::random(&maze, &mut rng).unwrap();
        let mut config = CpmConfig::robust();
        config.mapping = Mapping::Hypotheses { width: 1 };
        config.most_traversals = 400;
        let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::Bounded);
        let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
        let see = |_: &PlaneWalker<'_>, _: &Explorer, _: &Leg, arrival| {
            revised += u32::from(arrival == MapUpdate::Revised);
        };
        rover
            .pursue(&mut explorer, Aim::Explore, &mut rng, see)
            .unwrap();
        let check = world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at());
        assert_eq!(check, MapCheck::Right, "seed {seed}");
        assert_eq!(explorer.mapper.contradictions(), 0, "seed {seed}");
    }
    assert!(revised > 0);
}

/// On a large map the index finds the duplicates among all fragments that share patterns.
#[test]
fn a_large_maze_needs_few_comparisons() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut maze = MazeConfig::small();
    maze.columns = 14;
    maze.rows = 14;
    maze.diagonals = 0.3;
    let world = PlaneMaze::random(&maze, &mut rng).unwrap();
    assert!(world.corridors().len() > 100);
    let explore = |candidates| {
        let mut config = CpmConfig::online();
        config.candidates = candidates;
        let mut rng = ChaCha8Rng::seed_from_u64(8);
        let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
        let mut explorer = Explorer::new(config, rover.sighting()).unwrap();
        pursue(&mut explorer, &mut rover, Aim::Explore, &mut rng);
        let check = world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at());
        (check, explorer.mapper.traversals())
    };
    let all = explore(Candidates::All);
    assert_eq!(all.0, MapCheck::Right);
    assert_eq!(explore(Candidates::Best(3)), all);
}

/// Patterns are learned on the way. "The robot … is expected to be capable of deciding if the
/// current path-fragment is best represented by the existed CP, or if a new CP is best added." What
/// was written before stays valid.
#[test]
fn patterns_are_learned_while_mapping() {
    for seed in 0..10 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let world = PlaneMaze::random(&MazeConfig::small(), &mut rng).unwrap();
        let truth = world.dictionary();
        let mut dictionary = Dictionary::new(truth.dimension());
        let mut rover = PlaneWalker::new(&world, WalkerNoise::NONE, Reckoning::None);
        let mut explorer = Explorer::new(CpmConfig::online(), rover.sighting()).unwrap();
        let mut versions = Vec::new();
        while let ControlFlow::Continue(leg) = explorer.decide(Aim::Explore, &mut rng) {
            let WalkOutcome::Arrived(mut walk) = rover.go(leg.turn, None, &mut rng).unwrap() else {
                unreachable!("it was not told to give up");
            };
            for pattern in &mut walk.patterns {
                let mut sensed = |pattern: PatternId| -> Vec<f64> {
                    let features = truth.prototype(pattern).unwrap().iter();
                    features
                        .map(|feature| feature + 0.02 * (rng.random::<f64>() - 0.5))
                        .collect()
                };
                let (ahead, behind) = (sensed(*pattern), sensed(truth.half_turned(*pattern)));
                *pattern = dictionary.learn(&ahead, &behind, 0.1).unwrap();
            }
            explorer
                .mapper
                .arrive(leg.turn, &walk, &dictionary)
                .unwrap();
            versions.push(dictionary.version());
        }
        assert_eq!(
            world.check(explorer.mapper.map(), explorer.mapper.at(), rover.at()),
            MapCheck::Right
        );
        assert!(
            versions
                .iter()
                .all(|version| dictionary.check_version(*version) == Ok(()))
        );
        assert!(versions.first() != versions.last());
        assert!(
            (20..=31).contains(&dictionary.len()),
            "{}",
            dictionary.len()
        );
    }
}
