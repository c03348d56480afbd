//! Maps of actions and bumps, in mazes drawn for each test.

use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maps::bump_map::{BumpMap, BumpMove, BumpMoves, BumpWay};
use tolman_maze::{Braided, Cell, Direction, Maze};

fn maze(side: u16, share: f64, seed: u64) -> Maze {
    let braided = Braided {
        width: side,
        height: side,
        share,
    };
    braided
        .generate(&mut ChaCha8Rng::seed_from_u64(seed))
        .unwrap()
}

/// Moves a robot that goes by advice, or anywhere, and returns its map, all its moves and its cell.
fn explored(
    maze: &Maze,
    moves: usize,
    mut choose: impl FnMut(&BumpMap) -> Direction,
) -> (BumpMap, Vec<BumpMove>, Cell) {
    let (mut map, mut at, mut walk) = (BumpMap::new(0), Cell::new(0, 0), Vec::new());
    for _ in 0..moves {
        let action = choose(&map);
        let next = maze.beside(at, action);
        let step = BumpMove {
            action,
            moved: next.is_some(),
            look: 0,
        };
        map.learn(step).unwrap();
        at = next.unwrap_or(at);
        walk.push(step);
    }
    (map, walk, at)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever was made one, the map still tells the whole walk.
    #[test]
    fn the_map_tells_the_whole_walk(
        (side, share) in (2_u16..=6, 0.0..=1.0),
        seed: u64,
        moves in 0_usize..1500,
    ) {
        let maze = maze(side, share, seed);
        let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 1);
        let (map, walk, _) = explored(&maze, moves, |_| Direction::ALL[rng.random_range(0..4)]);
        let mut place = map.start();
        for step in walk {
            match map.way(place, step.action) {
                BumpWay::Closed => prop_assert!(!step.moved),
                BumpWay::To(next) => {
                    prop_assert!(step.moved);
                    prop_assert_eq!(map.way(next, step.action.opposite()), BumpWay::To(place));
                    place = next;
                }
                BumpWay::Untried => prop_assert!(false, "a way that was tried"),
            }
        }
        prop_assert_eq!(place, map.here());
        prop_assert_eq!(map.places().count(), map.place_count());
    }

    /// By its advice the robot learns the maze as it is: a walk that nobody made is told, too.
    #[test]
    fn a_robot_that_takes_its_advice_learns_the_maze(
        (side, share) in (2_u16..=6, 0.0..=1.0),
        seed: u64,
    ) {
        let maze = maze(side, share, seed);
        let (map, _, mut at) = explored(&maze, 3000, BumpMap::advice);
        prop_assert!(map.is_tested());
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut place = map.here();
        for _ in 0..1000 {
            let action = Direction::ALL[rng.random_range(0..4)];
            match (map.way(place, action), maze.beside(at, action)) {
                (BumpWay::Closed, None) => {}
                (BumpWay::To(next), Some(beside)) => (place, at) = (next, beside),
                told => prop_assert!(false, "{:?} of {}, to the {}", told, at, action),
            }
        }
    }
}

/// Moves a robot by advice until its map is tested, where one in 100 moves along open ways fails,
/// and returns whether it then tells a random walk, where no move fails, as it is. `None` if the
/// map is not tested within `moves`.
fn tells_with_failures(maze: &Maze, worth: BumpMoves, moves: usize, seed: u64) -> Option<bool> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (mut map, mut at) = (BumpMap::with_moves(0, worth), Cell::new(0, 0));
    let mut made = 0;
    while !map.is_tested() {
        if made == moves {
            return None;
        }
        made += 1;
        let action = map.advice();
        let next = maze.beside(at, action);
        let fails = next.is_some() && rng.random_bool(0.01);
        if !fails {
            at = next.unwrap_or(at);
        }
        let moved = next.is_some() && (!fails || worth != BumpMoves::MayBump);
        map.learn(BumpMove {
            action,
            moved,
            look: 0,
        })
        .unwrap();
        assert_eq!(map.moves(), made);
    }
    let mut place = map.here();
    for _ in 0..1000 {
        let action = Direction::ALL[rng.random_range(0..4)];
        match (map.way(place, action), maze.beside(at, action)) {
            (BumpWay::Closed, None) => {}
            (BumpWay::To(next), Some(beside)) => (place, at) = (next, beside),
            _ => return Some(false),
        }
    }
    Some(true)
}

/// Returns how many of ten mazes are learned with failures. None may be wrongly said to be right.
fn learned_with_failures(side: u16, share: f64, worth: BumpMoves, per_cell: usize) -> usize {
    let moves = per_cell * usize::from(side * side);
    let tells = (0..10)
        .filter_map(|seed| tells_with_failures(&maze(side, share, seed), worth, moves, seed));
    tells
        .inspect(|tells| assert!(tells, "a wrong map that is said to be right"))
        .count()
}

#[test]
fn false_bumps_are_tried_again() {
    assert_eq!(learned_with_failures(6, 1.0, BumpMoves::MayBump, 60), 10);
    assert_eq!(learned_with_failures(6, 0.0, BumpMoves::MayBump, 60), 10);
}

#[test]
fn moves_that_fail_unnoticed_are_found_on_a_grid() {
    let told = BumpMoves::MayStay {
        one_in: 100,
        unit_steps: true,
    };
    assert_eq!(learned_with_failures(6, 1.0, told, 30), 10);
    assert_eq!(learned_with_failures(6, 0.0, told, 30), 10);
}

#[test]
fn moves_that_fail_unnoticed_are_found_by_evidence() {
    let harsh = BumpMoves::MayStay {
        one_in: 100,
        unit_steps: false,
    };
    assert_eq!(learned_with_failures(5, 0.0, harsh, 40), 10);
    assert!(learned_with_failures(4, 1.0, harsh, 100) >= 8);
}

/// A walk that leads nowhere known does not stop the map: it begins again.
#[test]
fn a_walk_that_nothing_explains_is_forgotten() {
    let worth = BumpMoves::MayStay {
        one_in: 1000,
        unit_steps: true,
    };
    let mut map = BumpMap::with_moves(0, worth);
    let step = |action, moved| BumpMove {
        action,
        moved,
        look: 0,
    };
    map.learn(step(Direction::North, false)).unwrap();
    assert_eq!(map.way(map.here(), Direction::North), BumpWay::Closed);
    // A bump is certain, and nobody took the robot elsewhere.
    map.learn(step(Direction::North, true)).unwrap();
    assert_eq!((map.place_count(), map.untried(), map.moves()), (1, 4, 2));
}
