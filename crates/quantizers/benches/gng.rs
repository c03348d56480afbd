//! Inputs a second that a growing neural gas learns from once it has all its units.
//!
//! One iteration is one input. The table at the end gives the median in million inputs per second of this thread's
//! processor time, with plain and with the widest lanes.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

mod measure;

use criterion::Criterion;
use measure::per_second;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_quantizers::{Gng, GngConfig, Lanes, Quantizer, Search};

/// Features and units.
const SIZES: [(usize, usize); 6] = [
    (2, 100),
    (2, 1000),
    (11, 100),
    (11, 1000),
    (24, 500),
    (72, 42),
];

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    println!("| features | units | lanes | M inputs/s |");
    println!("| ---: | ---: | --- | ---: |");
    let mut rows = Vec::new();
    for (dimension, units) in SIZES {
        let inputs = inputs(dimension);
        for lanes in [Lanes::Baseline, Lanes::Widest] {
            let mut gng = grown(dimension, units, &inputs, lanes);
            let mut next = inputs.iter().cycle();
            let label = format!("observe/{dimension}-d/{units} units/{lanes:?}");
            let rate = per_second(&mut criterion, &label, &mut || {
                gng.observe(next.next().unwrap()).unwrap()
            });
            if let Some(rate) = rate {
                let rate = rate / 1e6;
                rows.push(format!("| {dimension} | {units} | {lanes:?} | {rate:.2} |"));
            }
        }
    }
    criterion.final_summary();
    println!("{}", rows.join("\n"));
}

fn grown(dimension: usize, units: usize, inputs: &[Vec<f32>], lanes: Lanes) -> Gng<f32> {
    let config = GngConfig {
        max_units: units,
        ..GngConfig::fritzke()
    };
    let mut gng = Gng::new(dimension, config).unwrap();
    gng.set_search(Search::Automatic, lanes);
    for input in inputs.iter().cycle().take(units * 150) {
        gng.observe(input).unwrap();
    }
    gng
}

/// Points on a smooth surface of three dimensions (of two where there are only two features), bent into the space of all
/// features, with noise: what sensors of a robot give, shuffled.
fn inputs(dimension: usize) -> Vec<Vec<f32>> {
    let mut rng = ChaCha8Rng::seed_from_u64(dimension as u64);
    let bends: Vec<[f64; 4]> = (0..dimension)
        .map(|_| core::array::from_fn(|_| rng.random_range(-2.0..2.0)))
        .collect();
    let input = |_| {
        let at: [f64; 3] = core::array::from_fn(|_| rng.random_range(0.0..1.0));
        if dimension == 2 {
            return vec![at[0] as f32, at[1] as f32];
        }
        let feature = |bend: &[f64; 4]| {
            let phase = bend[0] * at[0] + bend[1] * at[1] + bend[2] * at[2] + bend[3];
            (phase.sin() + rng.random_range(-0.05..0.05)) as f32
        };
        bends.iter().map(feature).collect()
    };
    (0..20_000).map(input).collect()
}
