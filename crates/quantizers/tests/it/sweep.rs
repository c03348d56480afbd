//! Many inputs at once: the same nearest units, and nearly the same learning.

use tolman_quantizers::{Gng, GngConfig, InputError, Lanes, Quantizer, Scalar, UnitSearch};

use super::streams::{cube, narrowed};

/// Returns a network that has grown, and lost units, on `inputs`.
fn grown<S: Scalar>(inputs: &[Vec<S>], weights: Option<&[S]>, max_units: usize) -> Gng<S> {
    let mut config = GngConfig::fritzke();
    (config.growth_period, config.max_age, config.max_units) = (3, 10, max_units);
    let mut gng = match weights {
        None => Gng::new(inputs[0].len(), config).unwrap(),
        Some(weights) => Gng::weighted(weights, config).unwrap(),
    };
    for input in inputs {
        gng.observe(input).unwrap();
    }
    gng
}

fn check<S: Scalar>(inputs: &[Vec<S>], weights: Option<&[S]>) {
    let mut gng = grown(inputs, weights, usize::MAX);
    let rows: Vec<S> = inputs.concat();
    for lanes in [Lanes::Baseline, Lanes::Widest] {
        gng.set_search(UnitSearch::Automatic, lanes);
        // Neither a whole tile nor a whole group of rows.
        for count in [0, 1, 67, inputs.len()] {
            let mut found = Vec::new();
            let rows = &rows[..count * inputs[0].len()];
            gng.network().nearest_rows(rows, &mut found).unwrap();
            assert_eq!(found.len(), count);
            for (input, found) in inputs.iter().zip(&found) {
                assert_eq!(gng.nearest(input).unwrap(), *found);
            }
        }
    }
}

#[test]
fn the_nearest_of_many_are_those_of_each() {
    for dimension in [1, 3, 5, 31, 128, 129, 300] {
        let inputs = cube(dimension, 501, dimension as u64);
        let weights: Vec<f64> = (0..dimension).map(|feature| feature as f64 + 0.5).collect();
        check(&inputs, None);
        check(&inputs, Some(&weights));
        check(&narrowed(&inputs), None);
    }
}

#[test]
fn wrong_rows_are_refused_whole() {
    let mut gng = grown(&cube(3, 50, 1), None, 10);
    let before = gng.snapshot();
    let mut found = Vec::new();
    for (rows, error) in [
        (
            vec![0.0; 5],
            InputError::WrongDimension {
                expected: 3,
                found: 2,
            },
        ),
        (
            vec![0.0, 0.0, 0.0, 0.0, f64::INFINITY, 0.0],
            InputError::NotFinite {
                feature: 1,
                value: f64::INFINITY,
            },
        ),
    ] {
        assert_eq!(gng.network().nearest_rows(&rows, &mut found), Err(error));
        assert_eq!(gng.observe_batch(&rows, 4), Err(error));
    }
    assert!(found.is_empty());
    assert_eq!(gng.snapshot(), before);
    let empty = Gng::<f64>::new(3, GngConfig::fritzke()).unwrap();
    let asked = empty.network().nearest_rows(&[0.0; 3], &mut found);
    assert_eq!(asked, Err(InputError::NoUnits));
}

/// Returns the mean squared error after learning all inputs, `batch` at once or one by one.
fn error<S: Scalar>(inputs: &[Vec<S>], batch: Option<usize>, lanes: Lanes) -> (f64, Gng<S>) {
    let mut config = GngConfig::fritzke();
    (config.growth_period, config.max_units) = (20, 60);
    let mut gng = Gng::new(inputs[0].len(), config).unwrap();
    gng.set_search(UnitSearch::Automatic, lanes);
    match batch {
        Some(batch) => gng.observe_batch(&inputs.concat(), batch).unwrap(),
        None => {
            for input in inputs {
                gng.observe(input).unwrap();
            }
        }
    }
    assert_eq!(gng.network().len(), 60);
    let error = gng.network().quantization_error(inputs).unwrap();
    (error.mean_squared, gng)
}

#[test]
fn batches_learn_nearly_the_same() {
    for dimension in [2, 6, 40, 200] {
        // Far from the origin, where products alone would hide the distances.
        let inputs: Vec<Vec<f64>> = cube(dimension, 6000, 7)
            .into_iter()
            .map(|input| input.into_iter().map(|value| value + 1e6).collect())
            .collect();
        let (exact, _) = error(&inputs, None, Lanes::Widest);
        let (batched, gng) = error(&inputs, Some(128), Lanes::Widest);
        assert!(batched < 1.02 * exact, "{dimension}: {batched} {exact}");
        let (_, plain) = error(&inputs, Some(128), Lanes::Baseline);
        assert_eq!(plain.snapshot(), gng.snapshot(), "{dimension}");
    }
}

/// Units that go within a batch are nobody's winners any more.
#[test]
fn units_may_go_within_a_batch() {
    let mut config = GngConfig::fritzke();
    (config.max_age, config.growth_period) = (1, 3);
    config.utility = Some(tolman_quantizers::Utility {
        threshold: 1.5,
        removal: tolman_quantizers::Removal::EveryInput,
    });
    let inputs = cube(8, 3000, 3);
    let mut gng = Gng::<f64>::new(8, config).unwrap();
    gng.observe_batch(&inputs.concat(), 64).unwrap();
    assert_eq!(gng.steps(), 2998);
    assert!(gng.network().len() >= 2);
}
