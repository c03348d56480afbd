//! Sequences of patterns: how similar they are, and what they recall.

use proptest::prelude::*;
use tolman_maps::cpm::{
    Alignment, Bearings, CpMapper, CpMapperConfig, CpmError, Dictionary, End, Environments,
    FragmentMatching, PatternId, RecallError, Sense, Sighting, Sign, Similarity, Sum, Traversal,
    Turn,
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

/// Whether two sequences agree is a question of one sense; whether they match, of the better one.
#[test]
fn sequences_agree_above_the_threshold_in_the_sense_asked_for() {
    // Seen the other way, 0 is 5, 1 is 4 and 2 is 3: patterns 0 and 1, 2 and 3, 4 and 5.
    let mut dictionary = Dictionary::new(1);
    for place in 0..3 {
        let place = f64::from(place);
        dictionary.learn(&[place], &[5.0 - place], 0.1).unwrap();
    }
    let of = |patterns: &[u32]| patterns.iter().copied().map(PatternId).collect::<Vec<_>>();
    let a = of(&[0, 0, 0, 2]);
    let inverse = dictionary.inverse(&a).unwrap();
    let far = of(&[4, 5, 4, 5]);
    for matching in [
        FragmentMatching::Positions(Similarity::paper()),
        FragmentMatching::Alignment(Alignment::tuned()),
    ] {
        let agrees = |b: &[PatternId], sense| matching.agrees(&dictionary, &a, b, sense);
        assert!(agrees(&a, Sense::Same) && !agrees(&a, Sense::Inverted));
        assert!(agrees(&inverse, Sense::Inverted) && !agrees(&inverse, Sense::Same));
        assert!(!agrees(&far, Sense::Same) && !agrees(&far, Sense::Inverted));
        let sense = |b: &[PatternId]| matching.matches(&dictionary, &a, b).map(|one| one.sense);
        assert_eq!(sense(&a), Some(Sense::Same));
        assert_eq!(sense(&inverse), Some(Sense::Inverted));
        assert_eq!(sense(&far), None);
        // What is its own inverse is walked the same.
        let palindrome = of(&[0, 0, 1, 1]);
        let found = matching
            .matches(&dictionary, &palindrome, &palindrome)
            .unwrap();
        assert_eq!(found.sense, Sense::Same);
        let found = matching.matches(&dictionary, &a, &inverse).unwrap();
        assert!((found.score - 1.0).abs() < 1e-12);
    }
}

/// A path of two fragments is the shortest that can be learned.
#[test]
fn two_fragments_are_a_path_and_one_is_none() {
    let dictionary = dictionary(&[0.0, 1.0, 2.0, 3.0]);
    let mut environments = Environments::new(&dictionary).unwrap();
    let start = Sighting::plain(1);
    let mut mapper = CpMapper::new(CpMapperConfig::offline(), start).unwrap();
    for (turn, patterns) in [(0, [0, 1, 0]), (1, [2, 3, 3])] {
        let walk = Traversal {
            patterns: patterns.map(PatternId).to_vec(),
            motion: None,
            sighting: Sighting::plain(3),
            bearings: None,
        };
        mapper.arrive(Turn(turn), &walk, &dictionary).unwrap();
    }
    let fragments = mapper.map().fragments();
    let path: Vec<_> = fragments.map(|(id, _)| id.end(Sign::Minus)).collect();
    let mut learn = |path: &[End]| environments.learn(3, mapper.map(), path, &dictionary);
    assert_eq!(learn(&path[..1]), Err(RecallError::TooShort));
    assert_eq!(learn(&[]), Err(RecallError::TooShort));
    assert_eq!(learn(&path), Ok(()));
    let recalled = environments.recall(&[0, 1, 0].map(PatternId), &dictionary);
    let recalled = recalled.unwrap();
    assert_eq!((recalled.environment, recalled.chain), (3, path));
    assert_eq!(
        environments.recall(&[], &dictionary),
        Err(RecallError::TooShort)
    );
    let empty = Environments::new(&dictionary).unwrap();
    let nothing = empty.recall(&[PatternId(0)], &dictionary);
    assert_eq!(nothing, Err(RecallError::NothingLearned));
}

/// Walks a path without junctions, learns it as this environment, and returns its chain.
fn learn_path(
    environments: &mut Environments,
    environment: u32,
    walks: &[Vec<PatternId>],
    dictionary: &Dictionary,
) -> Vec<End> {
    let start = Sighting::plain(1);
    let mut mapper = CpMapper::new(CpMapperConfig::offline(), start).unwrap();
    for (number, patterns) in walks.iter().enumerate() {
        let walk = Traversal {
            patterns: patterns.clone(),
            motion: None,
            sighting: Sighting::plain(3),
            bearings: None,
        };
        let turn = Turn(u32::from(number > 0));
        mapper.arrive(turn, &walk, dictionary).unwrap();
    }
    let fragments = mapper.map().fragments();
    let ends: Vec<_> = fragments.map(|(id, _)| id.end(Sign::Minus)).collect();
    environments
        .learn(environment, mapper.map(), &ends, dictionary)
        .unwrap();
    ends
}

/// A fragment that looks like the second of one path begins another, and a third path returns to
/// where it began.
#[test]
fn a_chain_ends_where_it_would_leave_its_path_or_repeat_itself() {
    let places: Vec<f64> = (0..8).map(f64::from).collect();
    let dictionary = dictionary(&places);
    let mut environments = Environments::new(&dictionary).unwrap();
    let paths: [&[u32]; 3] = [&[0, 1], &[1, 2], &[4, 5, 4]];
    let mut learned = Vec::new();
    for (environment, path) in (0..).zip(paths) {
        let walks: Vec<_> = path
            .iter()
            .map(|pattern| vec![PatternId(*pattern); 3])
            .collect();
        let ends = learn_path(&mut environments, environment, &walks, &dictionary);
        learned.push(ends);
    }
    let chain = |pattern: u32| {
        let seen = [PatternId(pattern); 3];
        environments.recall(&seen, &dictionary).unwrap()
    };
    assert_eq!(
        (chain(0).environment, chain(0).chain),
        (0, learned[0].clone())
    );
    let back = chain(4);
    assert_eq!(back.environment, 2);
    assert_eq!(back.chain, learned[2][..2]);
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
        let walks = path.map(|patterns| patterns.map(PatternId).to_vec());
        let ends = learn_path(&mut environments, environment, &walks, &dictionary);
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

/// A place has a port at least, a thousand at most, and as many bearings as ports.
#[test]
fn places_that_cannot_be_are_refused() {
    let new = |degree, bearings: Option<&[f64]>| {
        let mut sighting = Sighting::plain(degree);
        sighting.landmark = None;
        let config = CpMapperConfig::robust();
        let mut mapper = CpMapper::new(config, Sighting::plain(2)).unwrap();
        let walk = Traversal {
            patterns: vec![PatternId(0)],
            motion: None,
            sighting,
            bearings: bearings.map(|all| Bearings::of_directions(all).unwrap()),
        };
        mapper
            .arrive(Turn(1), &walk, &dictionary(&[0.0, 1.0]))
            .map(|_| ())
    };
    assert_eq!(new(0, None), Err(CpmError::NoPorts));
    assert_eq!(new(1000, None), Ok(()));
    let (degree, most) = (1001, 1000);
    assert_eq!(
        new(1001, None),
        Err(CpmError::TooManyPorts { degree, most })
    );
    let round = [0.0, 1.0, 2.5];
    assert_eq!(new(3, Some(&round)), Ok(()));
    let (bearings, degree) = (3, 2);
    assert_eq!(
        new(2, Some(&round)),
        Err(CpmError::Bearings { bearings, degree })
    );
    assert_eq!(
        CpMapper::new(CpMapperConfig::robust(), Sighting::plain(0)).err(),
        Some(CpmError::NoPorts)
    );
}

/// The mean difference of the prototypes in distances of the farthest two, and the literal reading.
#[test]
fn similarity_is_one_minus_the_mean_difference() {
    let dictionary = dictionary(&[0.0, 1.0, 2.5, 7.0]);
    let of = |patterns: &[u32]| patterns.iter().copied().map(PatternId).collect::<Vec<_>>();
    let (a, b) = (of(&[0, 1, 3, 2]), of(&[0, 2, 3, 3]));
    let mut similarity = Similarity::paper();
    let mean = (0.0 + 1.5 + 0.0 + 4.5) / 4.0;
    assert!((similarity.score(&dictionary, &a, &b) - (1.0 - mean / 7.0)).abs() < 1e-12);
    // Stretched to four, a shorter sequence counts twice at each place.
    let mean = (0.0 + 1.0 + 4.5 + 0.0) / 4.0;
    let short = of(&[0, 2]);
    assert!((similarity.score(&dictionary, &a, &short) - (1.0 - mean / 7.0)).abs() < 1e-12);
    similarity.sum = Sum::Euclidean;
    let root = f64::sqrt(1.5 * 1.5 + 4.5 * 4.5);
    assert!((similarity.score(&dictionary, &a, &b) - (1.0 - root / 7.0)).abs() < 1e-12);
    // By numbers, up to the end of the shorter one: 0 and 1 differ by 0 and 1, of 3 at most.
    let literal = Similarity::literal();
    assert!((literal.score(&dictionary, &a, &short) - (1.0 - 1.0 / 3.0)).abs() < 1e-12);
    for similarity in [similarity, literal, Similarity::paper()] {
        assert!(similarity.score(&dictionary, &a, &[]).abs() < 1e-12);
        assert!((similarity.score(&dictionary, &a, &a) - 1.0).abs() < 1e-12);
    }
}
