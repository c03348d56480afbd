//! Sequences of patterns: how similar they are, and what they recall.

use proptest::prelude::*;
use tolman_maps::cpm::{
    Alignment, CpMapper, CpMapperConfig, Dictionary, Environments, PatternId, Sighting, Sign,
    Traversal, Turn,
};

/// Patterns 0, 1, 2 … at these places of a line.
fn dictionary(places: &[f64]) -> Dictionary {
    let mut dictionary = Dictionary::new(1);
    for place in places {
        dictionary.learn(&[*place], &[*place], 0.0).unwrap();
    }
    dictionary
}

/// Returns the least cost of aligning two sequences, by trying every way.
fn cost(alignment: &Alignment, apart: &dyn Fn(u32, u32) -> f64, a: &[u32], b: &[u32]) -> f64 {
    let (Some((last_a, before_a)), Some((last_b, before_b))) = (a.split_last(), b.split_last())
    else {
        return alignment.gap * (a.len() + b.len()) as f64;
    };
    let difference = apart(*last_a, *last_b);
    let stay = alignment.gap.min(alignment.stutter + difference);
    let along = difference + cost(alignment, apart, before_a, before_b);
    let longer_a = stay + cost(alignment, apart, before_a, b);
    let longer_b = stay + cost(alignment, apart, a, before_b);
    along.min(longer_a).min(longer_b)
}

proptest! {
    #[test]
    fn the_cheapest_alignment_counts(
        a in prop::collection::vec(0..5_u32, 1..6),
        b in prop::collection::vec(0..5_u32, 1..6),
        gap in 0.2..1.0_f64,
        stutter in 0.0..0.5_f64,
    ) {
        let places = [0.0, 0.3, 1.0, 1.4, 2.0];
        let alignment = Alignment { gap, stutter, unlike: 0.6, threshold: 0.45 };
        let apart = |a: u32, b: u32| {
            let far: f64 = places[a as usize] - places[b as usize];
            (far.abs() / (0.6 * 2.0)).min(1.0)
        };
        let longest = a.len().max(b.len()) as f64;
        let expected = 1.0 - cost(&alignment, &apart, &a, &b) / longest;
        let [a, b] = [a, b].map(|all| all.into_iter().map(PatternId).collect::<Vec<_>>());
        let score = alignment.score(&dictionary(&places), &a, &b);
        prop_assert!((score - expected).abs() < 1e-9, "{score} {expected}");
    }
}

#[test]
fn an_empty_sequence_is_like_none() {
    let dictionary = dictionary(&[0.0, 1.0]);
    let alignment = Alignment::tuned();
    let one = [PatternId(1)];
    for (a, b) in [(&one[..], &[][..]), (&[], &one), (&[], &[])] {
        assert!(alignment.score(&dictionary, a, b).abs() < 1e-12);
    }
    assert!((alignment.score(&dictionary, &one, &one) - 1.0).abs() < 1e-12);
}

/// Two environments of one path each, which begin alike.
#[test]
fn a_sequence_recalls_the_rest_of_its_own_path() {
    let places: Vec<f64> = (0..12).map(f64::from).collect();
    let dictionary = dictionary(&places);
    let mut environments = Environments::new(&dictionary).unwrap();
    let paths = [
        [[0, 1, 2], [5, 4, 3], [9, 9, 11]],
        [[0, 1, 6], [8, 8, 3], [10, 2, 7]],
    ];
    let mut learned = Vec::new();
    for (environment, path) in (0..).zip(paths) {
        let start = Sighting::plain(1);
        let mut mapper = CpMapper::new(CpMapperConfig::offline(), start).unwrap();
        for (turn, patterns) in path.iter().enumerate() {
            let walk = Traversal {
                patterns: patterns.map(PatternId).to_vec(),
                motion: None,
                sighting: Sighting::plain(3),
                bearings: None,
            };
            let turn = Turn(u32::from(turn > 0));
            mapper.arrive(turn, &walk, &dictionary).unwrap();
        }
        let fragments = mapper.map().fragments();
        let ends: Vec<_> = fragments.map(|(id, _)| id.end(Sign::Minus)).collect();
        environments
            .learn(environment, mapper.map(), &ends, &dictionary)
            .unwrap();
        learned.push(ends);
    }
    for (environment, (path, ends)) in (0..).zip(paths.iter().zip(&learned)) {
        for (number, patterns) in path.iter().enumerate() {
            let seen = patterns.map(PatternId);
            let recalled = environments.recall(&seen, &dictionary).unwrap();
            assert_eq!(recalled.environment, environment);
            assert_eq!(recalled.chain, ends[number..]);
            assert!(recalled.distance.abs() < 1e-9, "{}", recalled.distance);
        }
    }
    // A step off at each place is off by one on average.
    let off = [1, 2, 3].map(PatternId);
    let recalled = environments.recall(&off, &dictionary).unwrap();
    assert_eq!(recalled.chain, learned[0]);
    assert!(
        (recalled.distance - 1.0).abs() < 1e-9,
        "{}",
        recalled.distance
    );
}
