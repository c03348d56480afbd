//! Tests at which size the gates of equilibrium GNG end growth.

use proptest::prelude::*;
use tolman_quantizers::{ErrorKind, Gng, GngConfig, GrowthGate, Quantizer};

use super::streams::cube;

/// Returns the mean of what an input adds to the errors, over the last inputs, and the number of
/// units.
fn equilibrium(config: GngConfig, dimension: usize, seed: u64) -> (f64, f64) {
    let mut gng = Gng::new(dimension, config).unwrap();
    let inputs = cube(dimension, 40_000, seed);
    let (first, last) = inputs.split_at(30_000);
    for input in first {
        gng.observe(input).unwrap();
    }
    let mut sum = 0.0;
    for input in last {
        let squared = gng.observe(input).unwrap().first.squared_distance;
        sum += match config.error {
            ErrorKind::Squared => squared,
            _ => squared.sqrt(),
        };
    }
    (sum / last.len() as f64, gng.network().len() as f64)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    /// Checks MSE(N) = N · threshold · (1 − d): the law holds with the last unit, but not with one
    /// fewer.
    #[test]
    fn mean_error_ends_growth_where_the_law_says(dimension in 2..4_usize, wanted in 12..50_u32, seed: u64) {
        // A threshold that asks for about `wanted` units of an evenly filled cube.
        let units = f64::from(wanted);
        let mse = dimension as f64 / 12.0 * units.powf(-2.0 / dimension as f64);
        let decay = 0.995;
        let threshold = mse / units / (1.0 - decay);
        let gate = GrowthGate::MeanError { threshold };
        let mut config = GngConfig::fritzke();
        config.gate = gate;
        config.decay = decay;
        let (error, n) = equilibrium(config, dimension, seed);
        let ratio = error / (n * threshold * (1.0 - decay));
        // The gate sees the errors of some 200 inputs, and these scatter: growth ends a little
        // late.
        prop_assert!((0.5..1.1).contains(&ratio), "{ratio} at {n} units");
    }

    /// MSE(N) = N · threshold, for any decay.
    #[test]
    fn the_rate_ends_growth_independently_of_the_decay(decay in 0.99..0.9999_f64, seed: u64) {
        let threshold = 2.0 / 12.0 / 30.0 / 30.0;
        let gate = GrowthGate::Rate { threshold };
        let mut config = GngConfig::fritzke();
        config.gate = gate;
        config.decay = decay;
        let (error, n) = equilibrium(config, 2, seed);
        let ratio = error / (n * threshold);
        prop_assert!((0.4..1.1).contains(&ratio), "{ratio} at {n} units");
    }
}

#[test]
fn a_higher_threshold_gives_fewer_units() {
    let units = |threshold| equilibrium(GngConfig::mslst(threshold), 2, 1).1;
    assert!(units(0.1) > units(0.4));
    assert!(units(0.4) > units(4.0));
}
