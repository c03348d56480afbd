//! Streams in the order of a robot's way are learnt as well as shuffled ones.

use core::f64::consts::TAU;

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_quantizers::{
    Gng, GngConfig, InputError, Quantizer, QuantizerConfigError, ReplayConfig, ReplayMemory,
    ReplayQuantizer, SavedReplay,
};

const FEATURES: usize = 11;
const UNITS: usize = 100;

/// Makes a stream of some length from a seed.
type Stream = fn(usize, u64) -> Vec<Vec<f64>>;

/// Returns the readings of a robot with 11 range beams. It drives through two rooms, joined by a
/// door, and turns when it meets a wall.
fn rooms(len: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let is_free = |x: f64, y: f64| {
        let inside = (0.0..4.0).contains(&x) && (0.0..2.0).contains(&y);
        inside && !((1.95..2.05).contains(&x) && y < 1.4)
    };
    let (mut x, mut y, mut heading, mut turn) = (0.5_f64, 0.5_f64, 0.0_f64, 0.0_f64);
    let mut step = |_| {
        turn = 0.9 * turn + rng.random_range(-0.05..0.05);
        heading += turn;
        let (ahead_x, ahead_y) = (x + 0.02 * heading.cos(), y + 0.02 * heading.sin());
        if is_free(ahead_x, ahead_y) {
            (x, y) = (ahead_x, ahead_y);
        } else {
            heading += rng.random_range(0.5..2.5);
        }
        let mut beam = |beam: usize| {
            let angle = heading + beam as f64 * TAU / FEATURES as f64;
            let mut range = 0.0;
            while range < 1.5 && is_free(x + range * angle.cos(), y + range * angle.sin()) {
                range += 0.02;
            }
            range + rng.random_range(-0.02..0.02)
        };
        (0..FEATURES).map(&mut beam).collect()
    };
    (0..len).map(&mut step).collect()
}

/// Returns a random walk in three dimensions, bent into eleven.
fn surface(len: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let bends: Vec<[f64; 4]> = (0..FEATURES)
        .map(|_| core::array::from_fn(|_| rng.random_range(-2.0..2.0)))
        .collect();
    let mut at = [0.5_f64; 3];
    let mut step = |_| {
        for value in &mut at {
            *value = (*value + rng.random_range(-0.03..0.03)).clamp(0.0, 1.0);
        }
        let phase = |b: &[f64; 4]| b[0] * at[0] + b[1] * at[1] + b[2] * at[2] + b[3];
        bends.iter().map(|bend| phase(bend).sin()).collect()
    };
    (0..len).map(&mut step).collect()
}

/// Returns twenty places, one by one, none visited twice.
fn places(len: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let centres = super::streams::cube(FEATURES, 20, seed);
    let mut step = |step: usize| {
        let centre = &centres[step * centres.len() / len];
        let feature = |value: &f64| value + rng.random_range(-0.1..0.1);
        centre.iter().map(feature).collect()
    };
    (0..len).map(&mut step).collect()
}

/// Returns points once along a line that is bent into eleven dimensions.
fn sweep(len: usize, _: u64) -> Vec<Vec<f64>> {
    let feature = |step: usize, feature: usize| {
        (step as f64 / len as f64 * 2.0 * (feature as f64 + 1.0)).sin()
    };
    let input = |step| (0..FEATURES).map(|number| feature(step, number)).collect();
    (0..len).map(input).collect()
}

fn learnt<Q: Quantizer<f64>>(mut quantizer: Q, stream: &[Vec<f64>]) -> Q {
    for input in stream {
        quantizer.observe(input).unwrap();
    }
    quantizer
}

fn mse<Q: Quantizer<f64>>(quantizer: &Q, stream: &[Vec<f64>]) -> f64 {
    quantizer
        .network()
        .quantization_error(stream)
        .unwrap()
        .mean_squared
}

/// The memory of recent inputs holds the last ones, whatever came before.
#[test]
fn recent_inputs_push_out_the_oldest() {
    let mut config = ReplayConfig::measured(3);
    config.capacity = 7;
    config.per_input = 1;
    config.memory = ReplayMemory::Recent;
    let gng = Gng::<f64>::new(2, GngConfig::fritzke()).unwrap();
    let mut replay = ReplayQuantizer::new(gng, config).unwrap();
    for number in 0..40_u32 {
        let input = [f64::from(number), 0.5];
        replay.observe(&input).unwrap();
        let count = (number as usize + 1).min(7);
        assert_eq!(replay.remembered(), count);
        let saved = SavedReplay::from(replay.clone());
        let mut kept: Vec<f64> = saved.memory.chunks(2).map(|input| input[0]).collect();
        kept.sort_by(f64::total_cmp);
        let last = (0..=number).rev().take(count).map(f64::from);
        let mut last: Vec<f64> = last.collect();
        last.reverse();
        assert_eq!(kept, last);
        assert_eq!(saved.seen, u64::from(number) + 1);
    }
}

#[test]
fn the_order_of_a_stream_does_not_matter() {
    let streams: [(&str, Stream); 4] = [
        ("rooms", rooms),
        ("surface", surface),
        ("places", places),
        ("sweep", sweep),
    ];
    let mut harmed = 0;
    for (name, stream) in streams {
        for seed in 0..3 {
            let stream = stream(4000, seed);
            let mut shuffled = stream.clone();
            shuffled.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
            let mut fritzke = GngConfig::fritzke();
            fritzke.max_units = UNITS;
            fritzke.growth_period = 20;
            let mut in_order = GngConfig::in_order(UNITS);
            in_order.growth_period = 20;
            let new = |config| Gng::new(FEATURES, config).unwrap();
            // Whichever way of learning does better with the shuffled stream.
            let best = mse(&learnt(new(fritzke), &shuffled), &stream)
                .min(mse(&learnt(new(in_order), &shuffled), &stream));
            let replay = ReplayQuantizer::new(new(in_order), ReplayConfig::measured(seed)).unwrap();
            let replay = learnt(replay, &stream);
            assert!(replay.network().len() <= UNITS);
            let ratio = mse(&replay, &stream) / best;
            assert!(ratio <= 1.2, "{name}, seed {seed}: {ratio}");
            let without = mse(&learnt(new(fritzke), &stream), &stream) / best;
            harmed += u32::from(without > 1.5);
        }
    }
    // The streams are of the kind that does harm.
    assert!(harmed >= 10, "{harmed}");
}

#[test]
fn remembers_what_it_is_told_to() {
    let remembered = |memory| {
        let mut config = ReplayConfig::measured(1);
        config.capacity = 50;
        config.per_input = 1;
        config.memory = memory;
        let gng = Gng::new(1, GngConfig::fritzke()).unwrap();
        let stream: Vec<_> = (0..1000).map(|step| vec![f64::from(step)]).collect();
        let replay = learnt(ReplayQuantizer::new(gng, config).unwrap(), &stream);
        assert_eq!(replay.remembered(), 50);
        SavedReplay::from(replay).memory
    };
    let mut recent = remembered(ReplayMemory::Recent);
    recent.sort_by(f64::total_cmp);
    let last: Vec<_> = (950..1000).map(f64::from).collect();
    assert_eq!(recent, last);
    // The mean of 50 of 0 to 999 is within 4 standard deviations of 500.
    let reservoir = remembered(ReplayMemory::Reservoir);
    let mean = reservoir.iter().sum::<f64>() / 50.0;
    assert!((337.0..663.0).contains(&mean), "{mean}");
}

#[test]
fn a_resumed_memory_goes_on_as_if_nothing_were() {
    let mut config = ReplayConfig::measured(3);
    config.capacity = 100;
    let stream = rooms(600, 1);
    let gng = Gng::new(FEATURES, GngConfig::in_order(30)).unwrap();
    let replay = learnt(ReplayQuantizer::new(gng, config).unwrap(), &stream[..300]);
    let resumed = ReplayQuantizer::try_from(SavedReplay::from(replay.clone())).unwrap();
    let (went_on, resumed) = (
        learnt(replay, &stream[300..]),
        learnt(resumed, &stream[300..]),
    );
    let (went_on, resumed) = (SavedReplay::from(went_on), SavedReplay::from(resumed));
    assert_eq!(went_on.memory, resumed.memory);
    assert_eq!(went_on.words, resumed.words);
    assert_eq!(went_on.quantizer.snapshot(), resumed.quantizer.snapshot());

    let mut former = went_on.clone();
    assert_eq!(former.format, "tolman-replay-quantizer");
    former.format = "tolman-replay".to_owned();
    assert!(ReplayQuantizer::try_from(former.clone()).is_ok());
    former.version = 2;
    assert!(ReplayQuantizer::try_from(former.clone()).is_err());
    (former.format, former.version) = ("tolman-gng".to_owned(), 1);
    assert!(ReplayQuantizer::try_from(former).is_err());

    let mut spoilt = went_on.clone();
    spoilt.memory[5] = f64::NAN;
    assert!(ReplayQuantizer::try_from(spoilt).is_err());
    let mut spoilt = went_on;
    spoilt.memory.pop();
    assert!(ReplayQuantizer::try_from(spoilt).is_err());
}

#[test]
fn refuses_what_it_cannot_do() {
    let new = |capacity, per_input| {
        let gng = Gng::<f64>::new(2, GngConfig::fritzke()).unwrap();
        let mut config = ReplayConfig::measured(0);
        config.capacity = capacity;
        config.per_input = per_input;
        ReplayQuantizer::new(gng, config)
    };
    assert!(matches!(
        new(0, 1),
        Err(QuantizerConfigError::OutOfRange {
            field: "capacity",
            ..
        })
    ));
    assert!(matches!(
        new(1, 0),
        Err(QuantizerConfigError::OutOfRange {
            field: "per_input",
            ..
        })
    ));
    let mut replay = new(1, 1).unwrap();
    let error = replay.observe(&[f64::NAN, 0.0]).unwrap_err();
    assert!(matches!(error, InputError::NotFinite { feature: 0, .. }));
    assert_eq!(replay.remembered(), 0);
}
