//! The worked examples of the figures.

use tolman_maps::cpm::{
    CpmConfig, Dictionary, End, Explorer, FragmentId, Landmark, Mapping, PatternId, Sighting, Sign,
    Traversal, Turn,
};

/// Patterns far from each other; each seen the other way is the next or the one before.
pub(crate) fn dictionary() -> Dictionary {
    let mut dictionary = Dictionary::new(40);
    for pair in 0..20 {
        let mut features = [[0.0; 40]; 2];
        features[0][2 * pair] = 1.0;
        features[1][2 * pair + 1] = 1.0;
        let [one, other] = features;
        dictionary.learn(&one, &other, 0.0).unwrap();
    }
    dictionary
}

/// Fragment A is 0 2 4 6, B is 8 10 12 14, and so on: each with patterns of its own.
fn fragment(name: u32, length: u32) -> Vec<PatternId> {
    (0..length)
        .map(|place| PatternId((8 * name + 2 * (place % 4)) % 40))
        .collect()
}

fn walk(patterns: &[PatternId], degree: u32) -> Traversal {
    Traversal {
        patterns: patterns.to_vec(),
        motion: None,
        sighting: Sighting::plain(degree),
    }
}

fn end(fragment: u32, sign: Sign) -> End {
    End {
        fragment: FragmentId(fragment),
        sign,
    }
}

/// Figure 1: A → B → C → D → A closes a loop round a junction of four ports, B between two, C round the corner, D from
/// a third; the drawing gives Δ_AB, Δ_BC, Δ_CD, Δ_DA, reasoning the rest.
#[test]
fn figure_1() {
    use Sign::{Minus, Plus};
    let dictionary = dictionary();
    let [a, b, c, d] =
        [(0, 5), (1, 10), (2, 4), (3, 3)].map(|(name, length)| fragment(name, length));
    // A ends at a fork with B and D; C lies between the far ends of B and D, in a fork each.
    let config = CpmConfig {
        mapping: Mapping::Offline { patience: u32::MAX },
        ..CpmConfig::online()
    };
    let start = Sighting {
        degree: 1,
        landmark: Some(Landmark::Start),
    };
    let mut explorer = Explorer::new(config, start).unwrap();
    explorer
        .arrive(Turn::BACK, &walk(&a, 3), &dictionary)
        .unwrap();
    explorer.arrive(Turn(1), &walk(&b, 3), &dictionary).unwrap();
    explorer.arrive(Turn(2), &walk(&c, 3), &dictionary).unwrap();
    explorer.arrive(Turn(2), &walk(&d, 3), &dictionary).unwrap();
    // Back in A, from its far end.
    let mut back = walk(&dictionary.inverse(&a).unwrap(), 1);
    back.sighting = start;
    explorer.arrive(Turn(1), &back, &dictionary).unwrap();
    assert_eq!(explorer.map().fragments().len(), 5);
    assert_eq!(explorer.optimize(&dictionary), Ok(1));
    let map = explorer.map();
    assert_eq!(map.fragments().len(), 4);
    let [a, b, c, d] = [0, 1, 2, 3];
    let turn = |from, to| map.transition(from, to).map(|turn| turn.0);
    // Δ_AB, Δ_BC, Δ_CD, Δ_DA: walked.
    assert_eq!(turn(end(a, Plus), end(b, Minus)), Some(1));
    assert_eq!(turn(end(b, Plus), end(c, Minus)), Some(2));
    assert_eq!(turn(end(c, Plus), end(d, Minus)), Some(2));
    assert_eq!(turn(end(d, Plus), end(a, Plus)), Some(1));
    // Δ_BA, Δ_CB, Δ_DC, Δ_AD: inverted.
    assert_eq!(turn(end(b, Minus), end(a, Plus)), Some(2));
    assert_eq!(turn(end(c, Minus), end(b, Plus)), Some(1));
    assert_eq!(turn(end(d, Minus), end(c, Plus)), Some(1));
    assert_eq!(turn(end(a, Plus), end(d, Plus)), Some(2));
    // Δ_DB, Δ_BD: composed, (1 + 1) mod 3 and its inverse.
    assert_eq!(turn(end(d, Plus), end(b, Minus)), Some(2));
    assert_eq!(turn(end(b, Minus), end(d, Plus)), Some(1));
    // Not at one junction.
    assert_eq!(turn(end(a, Plus), end(c, Minus)), None);
    // "C → D → A" is shorter than "C → B → A".
    let from_c = map.fragment(FragmentId(c)).unwrap().plus;
    let plan = map
        .plan(from_c, |id| map.junction(id).unwrap().landmark.is_some())
        .unwrap();
    let enters: Vec<End> = plan.legs.iter().map(|leg| leg.enter).collect();
    assert_eq!(enters, [end(d, Minus), end(a, Plus)]);
    assert_eq!(
        (plan.legs[0].skip, plan.legs[1].skip, plan.length),
        (3, 0, 8)
    );
    assert!(!explorer.map().is_complete());
}
