//! CPM: Λ1, Λ2 and the geometry of ports they stand for; mazes that are learned, and found again.

#[cfg(feature = "serde")]
mod files;
mod learning;
mod sequences;
mod world;

use proptest::prelude::*;
use tolman_maps::cpm::{
    CpMapper, CpMapperConfig, Dictionary, MapUpdate, PatternId, Sighting, Sign, Traversal, Turn,
    theorem_1,
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

#[test]
fn theorem_1_bounds_the_time_until_the_goal() {
    // Three fragments before one came again; of the five others, the k-th asks for k more.
    let rest: f64 = (4..=8).map(f64::from).sum();
    let bound = theorem_1(&[12.0, 8.0, 10.0], 12.5, 8);
    assert!((bound - (30.0 + 12.5 * rest)).abs() < 1e-9, "{bound}");
    assert!((theorem_1(&[], 2.0, 4) - 20.0).abs() < 1e-9);
    assert!((theorem_1(&[1.5], 1.5, 1) - 1.5).abs() < 1e-9);
}

#[test]
fn a_dictionary_knows_what_it_has() {
    let mut dictionary = Dictionary::new(2);
    assert!(dictionary.is_empty());
    dictionary.learn(&[0.0, 1.0], &[1.0, 0.0], 0.1).unwrap();
    assert!(!dictionary.is_empty());
    assert_eq!(dictionary.len(), 2);
    let pairs = |partners: [u32; 2]| {
        let [a, b] = partners.map(PatternId);
        let prototypes = [(vec![0.0, 1.0], a), (vec![1.0, 0.0], b)];
        Dictionary::from_prototypes(2, &prototypes)
    };
    assert_eq!(pairs([1, 0]).unwrap(), dictionary);
    assert_eq!(pairs([0, 1]).unwrap().len(), 2);
    assert!(pairs([1, 1]).is_err() && pairs([0, 0]).is_err() && pairs([1, 2]).is_err());
    assert_eq!(Sign::BOTH.map(|sign| sign.to_string()), ["−", "+"]);
}
