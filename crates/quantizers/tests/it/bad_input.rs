//! Whatever comes in, a typed error or a sensible result comes out.

use proptest::prelude::*;
use tolman_quantizers::{
    ErrorKind, Gng, GngConfig, InputError, Quantizer, QuantizerConfigError, SavedGng, UnitId,
};

use super::streams::cube;

#[test]
fn refuses_bad_inputs_and_stays_as_it_was() {
    let mut gng = Gng::<f32>::new(2, GngConfig::fritzke()).unwrap();
    assert_eq!(gng.nearest(&[0.0, 0.0]), Err(InputError::NoUnits));
    for input in cube(2, 1000, 1) {
        gng.observe(&[input[0] as f32, input[1] as f32]).unwrap();
    }
    let before = SavedGng::from(gng.clone());
    let bad: [&[f32]; 8] = [
        &[],
        &[0.0],
        &[0.0, 0.0, 0.0],
        &[f32::NAN, 0.0],
        &[0.0, f32::INFINITY],
        &[f32::NEG_INFINITY, 0.0],
        &[0.0, 1e19],
        &[-f32::MAX, 0.0],
    ];
    for input in bad {
        let error = gng.observe(input).unwrap_err();
        // NaN is not equal to itself, but its text is.
        let error = error.to_string();
        assert_eq!(gng.nearest(input).unwrap_err().to_string(), error);
        assert_eq!(gng.nearest_two(input).unwrap_err().to_string(), error);
        assert_eq!(SavedGng::from(gng.clone()), before);
    }
    let error = gng.observe(&[0.0, f32::INFINITY]).unwrap_err();
    assert_eq!(
        error,
        InputError::NotFinite {
            feature: 1,
            value: f64::INFINITY
        }
    );
    assert!(matches!(
        gng.observe(&[1e30, 0.0]),
        Err(InputError::TooLarge { feature: 0, .. })
    ));

    let network = gng.network();
    assert_eq!(
        network.nearest_two_masked(&[0.0, 0.0], &[false, false]),
        Err(InputError::NothingCompared)
    );
    assert!(matches!(
        network.nearest_two_masked(&[0.0, 0.0], &[true]),
        Err(InputError::WrongMask { .. })
    ));
    assert!(matches!(
        network.nearest_two_masked(&[f32::NAN, 0.0], &[true, true]),
        Err(InputError::NotFinite { .. })
    ));
    // What is not compared is not read.
    assert!(
        network
            .nearest_two_masked(&[f32::NAN, 0.0], &[false, true])
            .is_ok()
    );
    assert_eq!(
        network.quantization_error::<[[f32; 2]; 0]>([]),
        Err(InputError::NoInputs)
    );
    assert!(network.prototype(UnitId(u32::MAX)).is_err());
}

#[test]
fn refuses_bad_configurations() {
    let refused = |change: &dyn Fn(&mut GngConfig)| {
        let mut config = GngConfig::fritzke();
        change(&mut config);
        Gng::<f64>::new(2, config).unwrap_err()
    };
    let field = |error| match error {
        QuantizerConfigError::OutOfRange { field, .. } => field,
        other => panic!("{other}"),
    };
    assert_eq!(field(refused(&|config| config.max_units = 0)), "max_units");
    assert_eq!(field(refused(&|config| config.max_units = 1)), "max_units");
    assert_eq!(
        field(refused(&|config| config.winner_rate = 1.5)),
        "winner_rate"
    );
    assert_eq!(
        field(refused(&|config| config.neighbour_rate = f64::NAN)),
        "neighbour_rate"
    );
    assert_eq!(
        field(refused(&|config| config.growth_period = 0)),
        "growth_period"
    );
    assert_eq!(field(refused(&|config| config.max_age = 0)), "max_age");
    assert_eq!(field(refused(&|config| config.decay = 0.0)), "decay");
    assert_eq!(
        field(refused(&|config| config.split_factor = -0.1)),
        "split_factor"
    );

    let weighted = |weights: &[f64]| Gng::weighted(weights, GngConfig::fritzke()).unwrap_err();
    assert_eq!(weighted(&[]), QuantizerConfigError::NoFeatures);
    assert_eq!(weighted(&[0.0, 0.0]), QuantizerConfigError::NoWeight);
    assert!(matches!(
        weighted(&[1.0, -1.0]),
        QuantizerConfigError::BadWeight { feature: 1, .. }
    ));
    assert!(matches!(
        weighted(&[f64::NAN]),
        QuantizerConfigError::BadWeight { feature: 0, .. }
    ));
    assert_eq!(
        Gng::<f64>::new(0, GngConfig::fritzke()).unwrap_err(),
        QuantizerConfigError::NoFeatures
    );

    let mut gng = Gng::<f64>::new(1, GngConfig::fritzke()).unwrap();
    assert!(gng.begin_with(&[[1.0]]).is_err());
    assert!(gng.begin_with(&[[1.0], [f64::NAN]]).is_err());
    assert!(gng.network().is_empty());
}

#[test]
fn one_point_stays_one_unit() {
    let mut gng = Gng::<f64>::new(3, GngConfig::fritzke()).unwrap();
    for _ in 0..10_000 {
        let observation = gng.observe(&[1.0, 2.0, 3.0]).unwrap();
        assert!(observation.first.squared_distance <= 0.0);
    }
    assert_eq!(gng.network().len(), 1);
    assert_eq!(gng.nearest_two(&[0.0, 0.0, 0.0]).unwrap().second, None);
}

#[test]
fn a_stream_that_becomes_constant_stays_sound() {
    for error in [ErrorKind::Squared, ErrorKind::Absolute, ErrorKind::Relative] {
        let mut config = GngConfig::fritzke();
        config.error = error;
        config.max_units = 50;
        let mut gng = Gng::<f32>::new(2, config).unwrap();
        gng.observe(&[1.0, 0.0]).unwrap();
        for _ in 0..100_000 {
            gng.observe(&[0.0, 0.0]).unwrap();
        }
        assert!(gng.network().len() >= 2);
        assert!(gng.mean_error().is_finite());
        assert!(gng.nearest(&[0.0, 0.0]).unwrap().squared_distance < 1e-6);
    }
}

#[test]
fn a_million_units() {
    let count = 1_000_000_u32;
    let mut config = GngConfig::fritzke();
    config.growth_period = 500;
    let mut gng = Gng::<f32>::new(2, config).unwrap();
    let at = |unit: u32| [(unit % 1000) as f32, (unit / 1000) as f32];
    gng.begin_with(&(0..count).map(at).collect::<Vec<_>>())
        .unwrap();
    for step in 0..1000 {
        gng.observe(&at(step * 997)).unwrap();
    }
    assert!(gng.network().len() > 999_000);
    // Far from what was learnt, so that the unit has stayed.
    let found = gng.nearest(&at(count - 1)).unwrap();
    assert_eq!(found.id, UnitId(count - 1));
}

proptest! {
    /// Inputs of any bits are refused, or learned without harm.
    #[test]
    fn no_number_poisons_it(inputs in prop::collection::vec(any::<[f32; 2]>(), 1..200), decay in 0.5..=1.0) {
        let mut config = GngConfig::fritzke();
        config.growth_period = 3;
        config.decay = decay;
        let mut gng = Gng::<f32>::new(2, config).unwrap();
        for input in &inputs {
            let _ = gng.observe(input);
            for id in gng.network().ids() {
                prop_assert!(gng.network().prototype(id).unwrap().all(f32::is_finite));
                prop_assert!(gng.error(id).unwrap().is_finite());
            }
        }
        prop_assert!(gng.mean_error().is_finite());
        prop_assert!(Gng::try_from(SavedGng::from(gng)).is_ok());
    }
}

/// A feature whose weight is zero tells nothing, even if it is the only one compared.
#[test]
fn only_features_that_weigh_are_compared() {
    let mut gng = Gng::<f64>::weighted(&[0.0, 2.0], GngConfig::fritzke()).unwrap();
    for input in [[0.0, 0.0], [1.0, 1.0]] {
        gng.observe(&input).unwrap();
    }
    let nearest = |mask: [bool; 2]| gng.network().nearest_two_masked(&[0.0, 0.9], &mask);
    assert_eq!(nearest([true, false]), Err(InputError::NothingCompared));
    for mask in [[false, true], [true, true]] {
        assert_eq!(nearest(mask).unwrap().first.id, UnitId(1));
    }
}
