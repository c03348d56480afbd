//! Inputs a second that a growing neural gas learns from once it has all its units, and searches a
//! second.
//!
//! One iteration is one input. The table at the end gives the median in million per second of this
//! thread's processor time. It has a column for a scan with plain lanes, one for the widest lanes,
//! and one for the index where there is one.

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
use tolman_quantizers::{Gng, GngConfig, Lanes, Quantizer, UnitSearch};

/// Numbers of features and units of the networks that learn.
const SIZES: [(usize, usize); 6] = [
    (2, 100),
    (2, 1000),
    (11, 100),
    (11, 1000),
    (24, 500),
    (72, 42),
];

/// Numbers of features and units of the networks that are only searched.
const LARGE: [(usize, usize); 2] = [(2, 10_000), (3, 10_000)];

const WAYS: [(&str, UnitSearch, Lanes); 3] = [
    ("scan, plain", UnitSearch::Scan, Lanes::Baseline),
    ("scan, widest lanes", UnitSearch::Scan, Lanes::Widest),
    ("index", UnitSearch::Index, Lanes::Widest),
];

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut rows = Vec::new();
    for (dimension, units) in SIZES {
        let inputs = inputs(dimension);
        for (way, search, lanes) in WAYS {
            if dimension > 4 && search == UnitSearch::Index {
                continue;
            }
            let mut gng = grown(dimension, units, 100, &inputs);
            gng.set_search(search, lanes);
            let mut next = inputs.iter().cycle();
            let label = format!("learn/{dimension}-d/{units} units/{way}");
            let rate = per_second(&mut criterion, &label, &mut || {
                gng.observe(next.next().unwrap()).unwrap()
            });
            rows.push(row("learn", dimension, units, way, rate));
        }
    }
    for (dimension, units) in LARGE {
        let inputs = inputs(dimension);
        let mut gng = grown(dimension, units, 20, &inputs);
        for (way, search, lanes) in WAYS {
            gng.set_search(search, lanes);
            let mut next = inputs.iter().cycle();
            let label = format!("nearest two/{dimension}-d/{units} units/{way}");
            let rate = per_second(&mut criterion, &label, &mut || {
                gng.nearest_two(next.next().unwrap()).unwrap()
            });
            rows.push(row("nearest two", dimension, units, way, rate));
        }
    }
    criterion.final_summary();
    println!("| what | features | units | search | M/s |");
    println!("| --- | ---: | ---: | --- | ---: |");
    println!("{}", rows.concat());
}

/// Returns a line of the table, or nothing if the command line left it out.
fn row(what: &str, dimension: usize, units: usize, way: &str, rate: Option<f64>) -> String {
    rate.map_or_else(String::new, |rate| {
        format!(
            "| {what} | {dimension} | {units} | {way} | {:.2} |\n",
            rate / 1e6
        )
    })
}

fn grown(dimension: usize, units: usize, growth_period: u32, inputs: &[Vec<f32>]) -> Gng<f32> {
    let mut config = GngConfig::fritzke();
    config.max_units = units;
    config.growth_period = growth_period;
    let mut gng = Gng::new(dimension, config).unwrap();
    let enough = units * growth_period as usize * 5 / 4;
    for input in inputs.iter().cycle().take(enough) {
        gng.observe(input).unwrap();
    }
    gng
}

/// Returns shuffled points on a smooth surface in the space of all features, with noise, like the
/// readings of a robot's sensors. The surface has three dimensions, or two where there are only two
/// features.
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
