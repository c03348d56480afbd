//! Every way to search finds the same units at the same distances, to the bit.

use proptest::prelude::*;
use tolman_quantizers::{Gng, GngConfig, Lanes, NearestTwo, Quantizer, Scalar, UnitId, UnitSearch};

use super::streams::{cube, grid, narrowed};

const WAYS: [(UnitSearch, Lanes); 4] = [
    (UnitSearch::Scan, Lanes::Baseline),
    (UnitSearch::Scan, Lanes::Widest),
    (UnitSearch::Index, Lanes::Baseline),
    (UnitSearch::Automatic, Lanes::Widest),
];

/// Distances one by one, feature after feature, and the ids of the least two.
fn by_hand<S: Scalar>(
    gng: &Gng<S>,
    input: &[S],
    mask: &[bool],
) -> (UnitId, S, Option<(UnitId, S)>) {
    let weights = gng.network().weights();
    let mut all: Vec<(UnitId, S)> = Vec::new();
    for id in gng.network().ids() {
        let mut sum = S::ZERO;
        for (feature, value) in gng.network().prototype(id).unwrap().enumerate() {
            if mask[feature] {
                let difference = input[feature] - value;
                let square = difference * difference;
                sum += weights.map_or(square, |weights| weights[feature] * square);
            }
        }
        all.push((id, sum));
    }
    // Stable, so that ties keep the order of ids.
    all.sort_by(|a, b| a.1.partial_cmp(&b.1).unwrap());
    (all[0].0, all[0].1, all.get(1).copied())
}

fn agrees<S: Scalar>(found: NearestTwo<S>, by_hand: (UnitId, S, Option<(UnitId, S)>)) -> bool {
    let second = found
        .second
        .map(|second| (second.id, second.squared_distance));
    (found.first.id, found.first.squared_distance, second) == by_hand
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    #[test]
    fn finds_what_is_nearest(
        dimension in 1..7_usize,
        len in 2..1200_usize,
        seed: u64,
        on_grid: bool,
        weighted: bool,
    ) {
        let inputs = if on_grid { grid(dimension, len, seed) } else { cube(dimension, len, seed) };
        let mut config = GngConfig::fritzke();
        config.growth_period = 2;
        config.max_age = 20;
        let weights: Vec<f64> = (0..dimension).map(|feature| 0.5 * feature as f64).collect();
        let mask: Vec<bool> = (0..dimension).map(|feature| feature % 2 == (dimension + 1) % 2).collect();
        for (search, lanes) in WAYS {
            let mut gng = if weighted && dimension > 1 {
                Gng::weighted(&weights, config).unwrap()
            } else {
                Gng::new(dimension, config).unwrap()
            };
            gng.set_search(search, lanes);
            let everything = vec![true; dimension];
            for (step, input) in inputs.iter().enumerate() {
                gng.observe(input).unwrap();
                if step % 37 == 0 {
                    let query = &inputs[step / 2];
                    let found = gng.nearest_two(query).unwrap();
                    prop_assert!(agrees(found, by_hand(&gng, query, &everything)));
                    let found = gng.network().nearest_two_masked(query, &mask).unwrap();
                    prop_assert!(agrees(found, by_hand(&gng, query, &mask)));
                }
            }
        }
    }

    #[test]
    fn learns_the_same_by_every_search(dimension in 1..6_usize, seed: u64, on_grid: bool) {
        let inputs = if on_grid { grid(dimension, 2500, seed) } else { cube(dimension, 2500, seed) };
        let inputs = narrowed(&inputs);
        let mut results = WAYS.iter().map(|(search, lanes)| {
            let mut config = GngConfig::fritzke();
            config.growth_period = 5;
            config.max_age = 15;
            let mut gng = Gng::<f32>::new(dimension, config).unwrap();
            gng.set_search(*search, *lanes);
            for input in &inputs {
                gng.observe(input).unwrap();
            }
            gng.snapshot()
        });
        let first = results.next().unwrap();
        for other in results {
            prop_assert_eq!(&other, &first);
        }
    }
}

#[test]
fn one_point_many_times_is_found_by_its_smallest_id() {
    for (search, lanes) in WAYS {
        let mut gng = Gng::new(2, GngConfig::fritzke()).unwrap();
        gng.set_search(search, lanes);
        gng.begin_with(&vec![[0.25, 0.5]; 2000]).unwrap();
        let found = gng.nearest_two(&[0.0, 0.0]).unwrap();
        assert_eq!(
            (found.first.id, found.second.unwrap().id),
            (UnitId(0), UnitId(1))
        );
    }
}

#[test]
fn many_features_are_no_matter() {
    for dimension in [16, 63, 64, 65, 200] {
        let inputs = cube(dimension, 400, 1);
        let everything = vec![true; dimension];
        for (search, lanes) in WAYS {
            let mut config = GngConfig::fritzke();
            config.growth_period = 5;
            let mut gng = Gng::new(dimension, config).unwrap();
            gng.set_search(search, lanes);
            for input in &inputs {
                gng.observe(input).unwrap();
            }
            let found = gng.nearest_two(&inputs[7]).unwrap();
            assert!(agrees(found, by_hand(&gng, &inputs[7], &everything)));
        }
    }
}
