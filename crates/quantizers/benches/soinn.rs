//! Inputs a second that a SOINN learns from once it has grown, beside a GNG of as many units and
//! the bare search.
//!
//! One iteration is one input. The table at the end gives the median in million inputs per second
//! of this thread's processor time. The search alone, which looks at all units, is the floor of
//! both.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

mod measure;

use core::f32::consts::TAU;

use criterion::Criterion;
use measure::per_second;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_quantizers::{Gng, GngConfig, Quantizer, Soinn, SoinnConfig};

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let inputs = rings_in_noise();
    let mut rows = Vec::new();
    for (name, config) in [
        ("λ = age_dead = 100", SoinnConfig::shen_hasegawa()),
        ("λ = 500, age_dead = 50", SoinnConfig::noisy()),
    ] {
        let mut soinn = Soinn::<f32>::new(2, config).unwrap();
        let units = grow(&mut soinn, &inputs);
        let mut fritzke = GngConfig::fritzke();
        fritzke.max_units = units;
        let mut gng = Gng::new(2, fritzke).unwrap();
        grow(&mut gng, &inputs);
        let floor = soinn.clone();
        let mut rate = |what: &str, work: &mut dyn FnMut(&[f32; 2])| {
            let mut next = inputs.iter().cycle();
            let label = format!("observe/2-d/{what}/{units} units");
            per_second(&mut criterion, &label, &mut || work(next.next().unwrap()))
        };
        let learned = rate("SOINN", &mut |input| {
            soinn.observe(input).unwrap();
        });
        let gng = rate("GNG", &mut |input| {
            gng.observe(input).unwrap();
        });
        let searched = rate("search", &mut |input| {
            core::hint::black_box(floor.nearest_two(input).unwrap());
        });
        if let (Some(learned), Some(gng), Some(searched)) = (learned, gng, searched) {
            let [learned, gng, searched] = [learned, gng, searched].map(|rate| rate / 1e6);
            rows.push(format!(
                "| {name} | {units} | {learned:.2} | {gng:.2} | {searched:.2} |"
            ));
        }
    }
    criterion.final_summary();
    println!("| SOINN | units | SOINN, M inputs/s | GNG | search alone |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    println!("{}", rows.join("\n"));
}

fn grow(quantizer: &mut impl Quantizer<f32>, inputs: &[[f32; 2]]) -> usize {
    for input in inputs {
        quantizer.observe(input).unwrap();
    }
    quantizer.network().len()
}

/// Returns two concentric rings in 10 % noise.
fn rings_in_noise() -> Vec<[f32; 2]> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let input = |_| {
        if rng.random_range(0..10_u32) == 0 {
            return [0.0; 2].map(|_: f32| rng.random_range(-3.0..3.0));
        }
        let angle = rng.random_range(0.0..TAU);
        let radius = rng.random_range(-0.15..0.15) + if rng.random() { 1.0 } else { 2.4 };
        [radius * angle.cos(), radius * angle.sin()]
    };
    (0..100_000).map(input).collect()
}
