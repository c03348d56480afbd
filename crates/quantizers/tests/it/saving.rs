//! To save, resume and go on is to go on.

use proptest::prelude::*;
use tolman_quantizers::{Gng, Quantizer, QuantizerConfigError, SavedGng, SnapshotError};

use super::gng::{configs, streams};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_resumed_network_goes_on_as_if_nothing_were(
        config in configs(),
        inputs in streams(),
        when in 0.0..1.0,
    ) {
        let mut gng = Gng::new(inputs[0].len(), config).unwrap();
        let (before, after) = inputs.split_at((when * inputs.len() as f64) as usize);
        for input in before {
            gng.observe(input).unwrap();
        }
        let mut resumed = through_text(&SavedGng::from(gng.clone()));
        for input in after {
            prop_assert_eq!(gng.observe(input).unwrap(), resumed.observe(input).unwrap());
        }
        prop_assert_eq!(SavedGng::from(gng), SavedGng::from(resumed));
    }
}

#[cfg(not(feature = "serde"))]
fn through_text(saved: &SavedGng<f64>) -> Gng<f64> {
    saved.clone().try_into().unwrap()
}

#[cfg(feature = "serde")]
fn through_text(saved: &SavedGng<f64>) -> Gng<f64> {
    serde_json::from_str(&serde_json::to_string(saved).unwrap()).unwrap()
}

fn saved() -> SavedGng<f64> {
    let mut gng = Gng::new(2, tolman_quantizers::GngConfig::fritzke()).unwrap();
    for input in super::streams::cube(2, 500, 1) {
        gng.observe(&input).unwrap();
    }
    gng.into()
}

/// Checks that every invalid saved network is refused.
#[test]
fn refuses_what_is_no_network() {
    let refused = |spoil: &dyn Fn(&mut SavedGng<f64>)| {
        let mut saved = saved();
        spoil(&mut saved);
        Gng::try_from(saved).unwrap_err()
    };
    assert!(Gng::try_from(saved()).is_ok());
    use SnapshotError as E;
    let error = refused(&|saved| saved.format = "gng".into());
    assert!(matches!(error, E::WrongFormat { .. }));
    let error = refused(&|saved| saved.version = 2);
    assert!(matches!(
        error,
        E::WrongVersion {
            newest: 1,
            found: 2
        }
    ));
    let error = refused(&|saved| saved.config.decay = f64::NAN);
    assert!(matches!(error, E::Config(_)));
    let error = refused(&|saved| saved.network.dimension = 0);
    assert!(matches!(error, E::Config(_)));
    let error = refused(&|saved| saved.network.weights = Some(vec![1.0]));
    assert!(matches!(error, E::WrongCount { .. }));
    for bad in [vec![0.0], vec![0.0, f64::NAN], vec![0.0, 1e200]] {
        let error = refused(&|saved| saved.network.units[1].prototype = bad.clone());
        assert!(matches!(error, E::BadPrototype { .. }));
    }
    let error = refused(&|saved| saved.network.units[1].id = saved.network.units[0].id);
    assert!(matches!(error, E::BadId { .. }));
    let error = refused(&|saved| saved.network.next_id = 1);
    assert!(matches!(error, E::BadId { .. }));
    let error = refused(&|saved| saved.network.edges.push(saved.network.edges[0]));
    assert!(matches!(error, E::BadEdge { .. }));
    let error = refused(&|saved| saved.network.edges[0].ends.1 = saved.network.edges[0].ends.0);
    assert!(matches!(error, E::BadEdge { .. }));
    let error = refused(&|saved| saved.network.edges[0].ends.1.0 = 77);
    assert!(matches!(error, E::BadEdge { .. }));
    let error = refused(&|saved| saved.sums.truncate(1));
    assert!(matches!(error, E::WrongCount { .. }));
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&|saved| saved.sums[0].0 = bad);
        assert!(matches!(
            error,
            E::Config(QuantizerConfigError::OutOfRange { .. })
        ));
    }
    let error = refused(&|saved| saved.factor = 0.0);
    assert!(matches!(
        error,
        E::Config(QuantizerConfigError::OutOfRange { .. })
    ));
}

#[cfg(feature = "serde")]
#[test]
fn single_precision_survives_text() {
    let mut gng = Gng::<f32>::new(3, tolman_quantizers::GngConfig::fritzke()).unwrap();
    for input in super::streams::narrowed(&super::streams::cube(3, 3000, 1)) {
        gng.observe(&input).unwrap();
    }
    let text = serde_json::to_string(&gng).unwrap();
    let resumed: Gng<f32> = serde_json::from_str(&text).unwrap();
    assert_eq!(SavedGng::from(resumed), SavedGng::from(gng));
}
