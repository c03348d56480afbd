//! Maps of actions and bumps, in mazes drawn for each test.

use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maps::bump_map::{BumpMap, BumpMove, BumpWay};
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
