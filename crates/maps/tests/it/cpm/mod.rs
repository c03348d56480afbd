//! CPM: Λ1, Λ2 and the geometry of ports they stand for; mazes that are learned, and found again.

mod learning;
mod sequences;
mod world;

use proptest::prelude::*;
use tolman_maps::cpm::{
    CpMapper, CpMapperConfig, Dictionary, MapUpdate, Sighting, Traversal, Turn,
};

fn junction_and_ports() -> impl Strategy<Value = (u32, u32, u32, u32)> {
    (1_u32..12).prop_flat_map(|degree| (Just(degree), 0..degree, 0..degree, 0..degree))
}

proptest! {
    #[test]
    fn the_inverse_leads_back((degree, from, to, _) in junction_and_ports()) {
        let turn = Turn::between(from, to, degree).unwrap();
        prop_assert_eq!(turn.exit(from, degree), Ok(to));
        let inverse = turn.inverse(degree).unwrap();
        prop_assert_eq!(inverse, Turn::between(to, from, degree).unwrap());
        prop_assert_eq!(inverse.inverse(degree), Ok(turn));
    }

    #[test]
    fn composition_is_the_direct_turn((degree, a, b, c) in junction_and_ports()) {
        let (ab, bc) = (Turn::between(a, b, degree).unwrap(), Turn::between(b, c, degree).unwrap());
        prop_assert_eq!(ab.then(bc, degree), Turn::between(a, c, degree));
        prop_assert_eq!(ab.then(ab.inverse(degree).unwrap(), degree), Ok(Turn::BACK));
    }

    #[test]
    fn composition_round_a_junction_closes(degree in 1_u32..40) {
        let step = Turn(1 % degree);
        let round = (0..degree).try_fold(Turn::BACK, |so_far, _| so_far.then(step, degree));
        prop_assert_eq!(round, Ok(Turn::BACK));
    }
}

#[test]
fn turns_are_counted_from_the_port_of_entry() {
    // A crossing: right, straight on, left. Straight on is its own inverse, whatever way one came.
    for (turn, inverse) in [(1, 3), (2, 2), (3, 1)] {
        assert_eq!(Turn(turn).inverse(4), Ok(Turn(inverse)));
    }
    // N_w of (2) is degree − 1.
    assert_eq!(Turn(1).inverse(3), Ok(Turn(2)));
    assert!(Turn(3).inverse(3).is_err());
    assert!(Turn(0).inverse(0).is_err());
    assert!(Turn(1).then(Turn(4), 4).is_err());
    assert!(Turn::between(4, 0, 4).is_err());
    // No overflow at any degree.
    assert_eq!(Turn(u32::MAX - 1).then(Turn(2), u32::MAX), Ok(Turn(1)));
}

#[test]
fn a_place_that_is_not_what_the_map_says_is_counted_as_a_contradiction() {
    let mut dictionary = Dictionary::new(1);
    let wall = dictionary.learn(&[1.0], &[1.0], 0.1).unwrap();
    let door = dictionary.learn(&[0.0], &[0.0], 0.1).unwrap();
    let mut mapper = CpMapper::new(CpMapperConfig::online(), Sighting::plain(1)).unwrap();
    let mut walk = |patterns: [_; 3], ports| {
        let walk = Traversal {
            patterns: patterns.to_vec(),
            motion: None,
            sighting: Sighting::plain(ports),
            bearings: None,
        };
        let update = mapper.arrive(Turn::BACK, &walk, &dictionary).unwrap();
        (update, mapper.contradictions())
    };
    assert_eq!(walk([wall, wall, door], 1), (MapUpdate::New, 0));
    // It set off at a dead end.
    assert_eq!(walk([door, wall, wall], 3), (MapUpdate::Contradiction, 1));
}
