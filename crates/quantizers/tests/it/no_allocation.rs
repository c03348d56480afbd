//! Once a network has grown, an input allocates nothing.

use core::hint::black_box;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_quantizers::{Gng, GngConfig, Quantizer, Removal, Soinn, SoinnConfig, Utility};

/// Allocations of 20,000 inputs after the network has had 60,000.
fn allocations(dimension: usize, config: GngConfig) -> u64 {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut gng = Gng::<f32>::new(dimension, config).unwrap();
    let mut input = vec![0.0; dimension];
    let mut feed = |inputs: u32| {
        for _ in 0..inputs {
            for value in &mut input {
                *value = rng.random_range(0.0..1.0_f32);
            }
            gng.observe(&input).unwrap();
        }
    };
    feed(60_000);
    allocation_counter::measure(|| feed(20_000)).count_total
}

#[test]
fn a_grown_network_allocates_nothing() {
    let mut config = GngConfig::fritzke();
    config.growth_period = 20;
    config.max_age = 30;
    for (dimension, max_units) in [(2, 100), (2, 1000), (11, 100)] {
        let mut bounded = config;
        bounded.max_units = max_units;
        assert_eq!(allocations(dimension, bounded), 0, "{dimension} features");
        let mut forgetful = bounded;
        forgetful.utility = Some(Utility {
            threshold: 10.0,
            removal: Removal::EveryInput,
        });
        assert_eq!(
            allocations(dimension, forgetful),
            0,
            "{dimension} features, GNG-U"
        );
    }
    // The counter counts.
    assert!(allocation_counter::measure(|| drop(black_box(vec![1_u8; 10]))).count_total > 0);
}

/// A SOINN has as many units as its data justify; here it stops growing.
#[test]
fn a_grown_soinn_allocates_nothing() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut soinn = Soinn::<f32>::new(2, SoinnConfig::shen_hasegawa()).unwrap();
    let mut feed = |inputs: u32| {
        for _ in 0..inputs {
            let input: [f32; 2] = core::array::from_fn(|_| rng.random_range(0.0..1.0_f32));
            soinn.observe(&input).unwrap();
        }
    };
    feed(200_000);
    assert_eq!(allocation_counter::measure(|| feed(1000)).count_total, 0);
}
