//! Tests how well similarities tell a fragment seen again from all others.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maps::cpm::{
    Alignment, Dictionary, FragmentMatching, PatternId, Sense, Similarity, Sum, Turn,
};

use super::world::{
    MazeConfig, PlaneMaze, PlaneWalker, Reckoning, WalkOutcome, WalkerNoise, WorldPort,
};

/// Number of a corridor, and the sequence of patterns seen along it.
type Seen = (u32, Vec<PatternId>);

/// Returns every corridor of a world, walked from both ends.
fn sightings(world: &PlaneMaze, noise: WalkerNoise, rng: &mut ChaCha8Rng) -> Vec<Seen> {
    let mut rover = PlaneWalker::new(world, noise, Reckoning::None);
    let mut seen = Vec::new();
    for place in 0..world.places().len() as u32 {
        for number in 0..world.sighting(place).degree {
            rover.place(WorldPort { place, number });
            let corridor = world.end_at(WorldPort { place, number }).unwrap().corridor;
            let WalkOutcome::Arrived(walk) = rover.go(Turn::BACK, None, rng).unwrap() else {
                unreachable!("it was not told to give up");
            };
            seen.push((corridor, walk.patterns));
        }
    }
    seen
}

/// Returns the area under the ROC curve: how often a pair of one corridor is more similar than a
/// pair of two.
fn auc(matching: &FragmentMatching, dictionary: &Dictionary, seen: &[Seen]) -> f64 {
    let (mut same, mut other) = (Vec::new(), Vec::new());
    for (i, (corridor, patterns)) in seen.iter().enumerate() {
        for (another, others) in &seen[..i] {
            let inverse = dictionary.inverse(others).unwrap();
            let score = matching.score(dictionary, patterns, others);
            let score = score.max(matching.score(dictionary, patterns, &inverse));
            if corridor == another {
                &mut same
            } else {
                &mut other
            }
            .push(score);
        }
    }
    let pairs = same
        .iter()
        .flat_map(|same| other.iter().map(move |other| (same, other)));
    let won: f64 = pairs
        .map(|(same, other)| match same.total_cmp(other) {
            core::cmp::Ordering::Greater => 1.0,
            core::cmp::Ordering::Equal => 0.5,
            core::cmp::Ordering::Less => 0.0,
        })
        .sum();
    won / (same.len() * other.len()) as f64
}

/// Enough that one maze in which the paper's similarity is as good does not decide.
const MAZES: u32 = 40;

#[test]
fn alignment_tells_fragments_apart_better_than_positions() {
    let matchings = [
        FragmentMatching::Positions(Similarity::literal()),
        FragmentMatching::Positions(Similarity::paper()),
        FragmentMatching::Alignment(Alignment::tuned()),
    ];
    // By how much alignment is to be better than the paper's similarity: about half of the margin
    // seen.
    for (substitution, gaps, margin) in [(0.05, 0.0, 0.0005), (0.1, 0.05, 0.006), (0.3, 0.1, 0.02)]
    {
        let noise = WalkerNoise {
            substitution,
            insertion: gaps,
            deletion: gaps,
            slip: 0.2,
            heading: 0.0,
        };
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut maze = MazeConfig::small();
        maze.columns = 6;
        maze.rows = 6;
        let mut areas = [0.0; 3];
        for _ in 0..MAZES {
            let world = PlaneMaze::random(&maze, &mut rng).unwrap();
            let seen = sightings(&world, noise, &mut rng);
            for (area, matching) in areas.iter_mut().zip(&matchings) {
                *area += auc(matching, world.dictionary(), &seen) / f64::from(MAZES);
            }
        }
        println!("{noise:?}: {areas:.4?}");
        let [literal, paper, alignment] = areas;
        assert!(paper > literal + 0.2, "{areas:?}");
        assert!(alignment > paper + margin, "{areas:?}");
        assert!(alignment > 0.8, "{areas:?}");
    }
}

fn sequences() -> impl Strategy<Value = (Vec<PatternId>, Vec<PatternId>)> {
    let sequence = || prop::collection::vec((0_u32..31).prop_map(PatternId), 0..12);
    (sequence(), sequence())
}

fn some_dictionary() -> Dictionary {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let world = PlaneMaze::random(&MazeConfig::small(), &mut rng).unwrap();
    world.dictionary().clone()
}

proptest! {
    #[test]
    fn similarity_is_symmetric_and_the_same_for_both_inverted((a, b) in sequences()) {
        let dictionary = some_dictionary();
        let inverse = |sequence: &[PatternId]| dictionary.inverse(sequence).unwrap();
        prop_assert_eq!(&inverse(&inverse(&a)), &a);
        let mut similarity = Similarity::paper();
        similarity.sum = Sum::Euclidean;
        for matching in [
            FragmentMatching::Positions(Similarity::paper()),
            FragmentMatching::Positions(similarity),
            FragmentMatching::Alignment(Alignment::tuned()),
        ] {
            let score = matching.score(&dictionary, &a, &b);
            prop_assert!(score <= 1.0);
            prop_assert!((score - matching.score(&dictionary, &b, &a)).abs() < 1e-9);
            prop_assert!((score - matching.score(&dictionary, &inverse(&a), &inverse(&b))).abs() < 1e-9);
            if !a.is_empty() {
                prop_assert!((matching.score(&dictionary, &a, &a) - 1.0).abs() < 1e-9);
                let found = matching.matches(&dictionary, &a, &inverse(&a)).unwrap();
                prop_assert!((found.score - 1.0).abs() < 1e-9);
                let symmetrical = inverse(&a) == a;
                prop_assert!(found.sense == Sense::Inverted || symmetrical);
            }
        }
    }
}
