//! SOINN and SOINN-AM, seen from outside.
#![expect(clippy::panic, reason = "a test may fail")]

use alloc::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_quantizers::{
    AssociativeMemory, Denoising, ErrorInsertion, Event, InputError, Quantizer,
    QuantizerConfigError, Recall, SavedSoinn, SecondLayerConfig, SecondLayerError, SecondThreshold,
    SimilarityThreshold, SnapshotError, Soinn, SoinnConfig, UnitId,
};

/// Algorithm 3.1 word for word: every unit a struct, every edge a map entry, every sum a loop.
#[derive(Clone, Debug, Default)]
struct Literal {
    units: BTreeMap<u32, LiteralUnit>,
    /// The smaller id first.
    ages: BTreeMap<(u32, u32), u32>,
    next: u32,
    inputs: u32,
}

#[derive(Clone, Debug)]
struct LiteralUnit {
    weights: Vec<f64>,
    error: f64,
    wins: f64,
    since: u32,
    radius: f64,
}

fn squared(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

impl Literal {
    fn add(&mut self, weights: &[f64]) -> u32 {
        let unit = LiteralUnit {
            weights: weights.to_vec(),
            error: 0.0,
            wins: 1.0,
            since: self.inputs,
            radius: f64::INFINITY,
        };
        self.units.insert(self.next, unit);
        self.next += 1;
        self.next - 1
    }

    fn neighbours(&self, id: u32) -> Vec<u32> {
        let ends = self.ages.keys().filter_map(|&(a, b)| match id {
            id if id == a => Some(b),
            id if id == b => Some(a),
            _ => None,
        });
        ends.collect()
    }

    fn squared_threshold(&self, id: u32, constant: Option<f64>) -> f64 {
        if let Some(distance) = constant {
            return distance * distance;
        }
        let to = |other: &u32| squared(&self.units[&id].weights, &self.units[other].weights);
        let neighbours = self.neighbours(id);
        if neighbours.is_empty() {
            let others = self.units.keys().filter(|other| **other != id);
            others.map(to).fold(f64::INFINITY, f64::min)
        } else {
            neighbours.iter().map(to).fold(0.0, f64::max)
        }
    }

    fn observe(&mut self, input: &[f64], config: &SoinnConfig) {
        if self.units.len() < 2 {
            self.add(input);
            return;
        }
        self.inputs += 1;
        let mut order: Vec<u32> = self.units.keys().copied().collect();
        let distance = |id: &u32| squared(&self.units[id].weights, input);
        order.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
        let (first, second) = (order[0], order[1]);
        let (d1, d2) = (distance(&first), distance(&second));
        let constant = match config.threshold {
            SimilarityThreshold::Constant(distance) => Some(distance),
            _ => None,
        };
        if d1 > self.squared_threshold(first, constant)
            || d2 > self.squared_threshold(second, constant)
        {
            self.add(input);
        } else {
            self.ages.insert((first.min(second), first.max(second)), 0);
            for (ends, age) in &mut self.ages {
                *age += u32::from(ends.0 == first || ends.1 == first);
            }
            let winner = self.units.get_mut(&first).unwrap();
            winner.error += d1.sqrt();
            winner.wins += 1.0;
            let rate = 1.0 / winner.wins;
            pull(&mut winner.weights, input, rate);
            for id in self.neighbours(first) {
                let unit = self.units.get_mut(&id).unwrap();
                let rate = 1.0 / (100.0 * unit.wins);
                pull(&mut unit.weights, input, rate);
            }
            self.ages.retain(|_, age| *age <= config.max_age);
        }
        if self.inputs.is_multiple_of(config.period) {
            self.insert(config.insertion);
            self.denoise(config.denoising);
        }
    }

    fn insert(&mut self, insertion: ErrorInsertion) {
        let worst = |ids: Vec<u32>| {
            ids.into_iter().reduce(|worst, id| {
                if self.units[&id].error > self.units[&worst].error {
                    id
                } else {
                    worst
                }
            })
        };
        let Some(q) = worst(self.units.keys().copied().collect()) else {
            return;
        };
        let Some(f) = worst(self.neighbours(q)) else {
            return;
        };
        let before = self.clone();
        let (uq, uf) = (self.units[&q].clone(), self.units[&f].clone());
        let middle: Vec<f64> = uq
            .weights
            .iter()
            .zip(&uf.weights)
            .map(|(a, b)| 0.5 * (a + b))
            .collect();
        let r = self.add(&middle);
        let unit = self.units.get_mut(&r).unwrap();
        unit.error = (uq.error + uf.error) / 6.0;
        unit.wins = (uq.wins + uf.wins) / 4.0;
        unit.radius = (uq.radius + uf.radius) / 4.0;
        unit.since = uq.since.min(uf.since);
        for id in [q, f] {
            let unit = self.units.get_mut(&id).unwrap();
            unit.error *= 2.0;
            unit.error /= 3.0;
            unit.wins *= 0.75;
        }
        let grew = [q, f, r].map(|id| {
            let unit = &self.units[&id];
            unit.error / unit.wins > unit.radius
        });
        let undone = match insertion {
            ErrorInsertion::UnlessOneGrew => grew.contains(&true),
            ErrorInsertion::UnlessAllGrew => !grew.contains(&false),
            _ => true,
        };
        if undone {
            *self = before;
            return;
        }
        for id in [q, f, r] {
            let unit = self.units.get_mut(&id).unwrap();
            unit.radius = unit.error / unit.wins;
        }
        self.ages.remove(&(q.min(f), q.max(f)));
        self.ages.insert((q, r), 0);
        self.ages.insert((f, r), 0);
    }

    fn denoise(&mut self, denoising: Denoising) {
        let mean = self.units.values().map(|unit| unit.wins).sum::<f64>() / self.units.len() as f64;
        let noise = |id: &u32| {
            let (unit, neighbours) = (&self.units[id], self.neighbours(*id).len());
            let age = f64::from(self.inputs - unit.since);
            match denoising {
                Denoising::FewWins { c } => {
                    neighbours == 0 || neighbours == 1 && unit.wins < c * mean
                }
                Denoising::LowRate { c } => {
                    let share = age / self.units.len() as f64;
                    neighbours == 0 || neighbours == 1 && unit.wins < c * share
                }
                _ => false,
            }
        };
        let doomed: Vec<u32> = self.units.keys().copied().filter(noise).collect();
        for id in doomed {
            if self.units.len() > 2 {
                self.units.remove(&id);
                self.ages.retain(|ends, _| ends.0 != id && ends.1 != id);
            }
        }
    }

    fn assert_same(&self, soinn: &Soinn<f64>) {
        let network = soinn.network();
        let ids: Vec<u32> = network.ids().map(|id| id.0).collect();
        assert_eq!(ids, self.units.keys().copied().collect::<Vec<_>>());
        let edges: BTreeMap<(u32, u32), u32> = network
            .edges()
            .map(|edge| ((edge.ends.0.0, edge.ends.1.0), edge.age))
            .collect();
        assert_eq!(edges, self.ages);
        for (id, unit) in &self.units {
            let prototype: Vec<f64> = network.prototype(UnitId(*id)).unwrap().collect();
            assert!(squared(&prototype, &unit.weights) < 1e-18, "unit {id}");
            assert!((soinn.wins(UnitId(*id)).unwrap() - unit.wins).abs() < 1e-9);
            assert!((soinn.error(UnitId(*id)).unwrap() - unit.error).abs() < 1e-9);
        }
    }
}

fn pull(weights: &mut [f64], input: &[f64], rate: f64) {
    for (weight, value) in weights.iter_mut().zip(input) {
        *weight += rate * (value - *weight);
    }
}

/// Points of two clouds and some noise.
fn clouds(seed: u64, inputs: usize) -> Vec<[f64; 3]> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let points = (0..inputs).map(|_| {
        let centre = f64::from(rng.random_range(0..3_u32));
        let spread = if rng.random_range(0..10_u32) == 0 {
            3.0
        } else {
            0.4
        };
        [0; 3].map(|_| centre + spread * (rng.random::<f64>() - 0.5))
    });
    points.collect()
}

fn configs() -> impl Strategy<Value = SoinnConfig> {
    let insertion = prop_oneof![
        Just(ErrorInsertion::UnlessOneGrew),
        Just(ErrorInsertion::UnlessAllGrew),
        Just(ErrorInsertion::Off)
    ];
    let denoising = prop_oneof![
        (0.0..=1.0).prop_map(|c| Denoising::FewWins { c }),
        (0.0..=1.0).prop_map(|c| Denoising::LowRate { c }),
        Just(Denoising::Off)
    ];
    let threshold = prop_oneof![
        3 => Just(SimilarityThreshold::Adaptive),
        1 => (0.05..0.5).prop_map(SimilarityThreshold::Constant)
    ];
    (2_u32..40, 5_u32..60, insertion, denoising, threshold).prop_map(
        |(max_age, period, insertion, denoising, threshold)| {
            let mut config = SoinnConfig::shen_hasegawa();
            (config.max_age, config.period) = (max_age, period);
            (config.insertion, config.denoising) = (insertion, denoising);
            config.threshold = threshold;
            config
        },
    )
}

/// The graph that the events tell.
#[derive(Default)]
struct Replay {
    units: BTreeSet<UnitId>,
    edges: BTreeSet<(UnitId, UnitId)>,
    ever: BTreeSet<UnitId>,
}

impl Replay {
    fn play(&mut self, event: Event) {
        match event {
            Event::Inserted { id, .. } => {
                assert!(self.ever.insert(id), "{id} was there before");
                self.units.insert(id);
            }
            Event::Removed { id } => assert!(self.units.remove(&id)),
            Event::Linked(a, b) => assert!(self.edges.insert((a, b))),
            Event::Unlinked(a, b) => assert!(self.edges.remove(&(a, b))),
            other => panic!("a SOINN does not do that: {other:?}"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn it_is_the_paper_s_algorithm(seed in any::<u64>(), config in configs()) {
        let mut soinn = Soinn::<f64>::new(3, config).unwrap();
        let mut literal = Literal::default();
        for input in clouds(seed, 400) {
            soinn.observe(&input).unwrap();
            literal.observe(&input, &config);
        }
        literal.assert_same(&soinn);
    }

    #[test]
    fn the_graph_stays_sound(seed in any::<u64>(), config in configs()) {
        let mut soinn = Soinn::<f32>::new(3, config).unwrap();
        soinn.events().listen();
        let mut replay = Replay::default();
        for input in clouds(seed, 500) {
            let input = input.map(|value| value as f32);
            let observation = soinn.observe(&input).unwrap();
            for event in soinn.events().drain() {
                replay.play(event);
            }
            let network = soinn.network();
            prop_assert!(network.contains(observation.first.id));
            prop_assert!(network.edges().all(|edge| edge.age <= config.max_age && edge.ends.0 < edge.ends.1));
        }
        let network = soinn.network();
        prop_assert!(network.ids().eq(replay.units.iter().copied()));
        prop_assert!(network.edges().map(|edge| edge.ends).eq(replay.edges.iter().copied()));
        for id in network.ids() {
            for other in network.neighbours(id).unwrap() {
                prop_assert!(network.neighbours(other).unwrap().any(|back| back == id));
            }
            prop_assert!(soinn.error(id).unwrap().is_finite() && soinn.wins(id).unwrap() > 0.0);
            prop_assert!(network.prototype(id).unwrap().all(f32::is_finite));
        }
    }

    #[test]
    fn a_resumed_network_goes_on_as_if_nothing_were(
        seed in any::<u64>(), config in configs(), when in 0_usize..400,
    ) {
        let mut soinn = Soinn::<f64>::new(3, config).unwrap();
        let inputs = clouds(seed, 400);
        for input in &inputs[..when] {
            soinn.observe(input).unwrap();
        }
        let mut resumed = through_text(&SavedSoinn::from(soinn.clone()));
        for input in &inputs[when..] {
            prop_assert_eq!(soinn.observe(input).unwrap(), resumed.observe(input).unwrap());
        }
        prop_assert_eq!(SavedSoinn::from(soinn), SavedSoinn::from(resumed));
    }

    #[test]
    fn bad_inputs_change_nothing(seed in any::<u64>(), bad in prop_oneof![
        Just(vec![f64::NAN, 0.0, 0.0]), Just(vec![0.0, f64::INFINITY, 0.0]), Just(vec![0.0, 0.0, -1e200]),
        Just(vec![]), Just(vec![0.0; 4]),
    ]) {
        let mut soinn = Soinn::<f64>::new(3, SoinnConfig::default()).unwrap();
        for input in clouds(seed, 250) {
            soinn.observe(&input).unwrap();
        }
        let before = format!("{soinn:?}");
        prop_assert!(soinn.observe(&bad).is_err());
        prop_assert_eq!(format!("{soinn:?}"), before);
    }
}

#[cfg(not(feature = "serde"))]
fn through_text(saved: &SavedSoinn<f64>) -> Soinn<f64> {
    saved.clone().try_into().unwrap()
}

#[cfg(feature = "serde")]
fn through_text(saved: &SavedSoinn<f64>) -> Soinn<f64> {
    serde_json::from_str(&serde_json::to_string(saved).unwrap()).unwrap()
}

#[test]
fn refuses_what_is_no_network() {
    let saved = || {
        let mut soinn = Soinn::<f64>::new(3, SoinnConfig::default()).unwrap();
        for input in clouds(1, 500) {
            soinn.observe(&input).unwrap();
        }
        SavedSoinn::from(soinn)
    };
    let refused = |spoil: &dyn Fn(&mut SavedSoinn<f64>)| {
        let mut saved = saved();
        spoil(&mut saved);
        Soinn::try_from(saved).map(|_| ()).unwrap_err()
    };
    use SnapshotError as E;
    assert!(Soinn::try_from(saved()).is_ok());
    let error = refused(&|saved| saved.format = "tolman-gng".into());
    assert!(matches!(error, E::WrongFormat { .. }));
    let error = refused(&|saved| saved.version = 2);
    assert!(matches!(error, E::WrongVersion { .. }));
    let error = refused(&|saved| saved.config.period = 0);
    assert!(matches!(error, E::Config(_)));
    let error = refused(&|saved| saved.tallies.truncate(1));
    assert!(matches!(error, E::WrongCount { .. }));
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let error = refused(&|saved| saved.tallies[0].error = bad);
        assert!(matches!(
            error,
            E::Config(QuantizerConfigError::OutOfRange { .. })
        ));
        let error = refused(&|saved| saved.tallies[0].radius = Some(bad));
        assert!(matches!(
            error,
            E::Config(QuantizerConfigError::OutOfRange { .. })
        ));
    }
    let error = refused(&|saved| saved.tallies[0].since = saved.steps + 1);
    assert!(matches!(
        error,
        E::Config(QuantizerConfigError::OutOfRange { .. })
    ));
    let error = refused(&|saved| saved.tallies[0].wins = 0.0);
    assert!(matches!(
        error,
        E::Config(QuantizerConfigError::OutOfRange { .. })
    ));
}

#[test]
fn configurations_out_of_range_are_refused() {
    let paper = SoinnConfig::default();
    let refused = |config| Soinn::<f64>::new(2, config).map(|_| ()).unwrap_err();
    let field = |error| match error {
        QuantizerConfigError::OutOfRange { field, .. } => field,
        other => panic!("{other}"),
    };
    let mut max_age = paper;
    max_age.max_age = 0;
    assert_eq!(field(refused(max_age)), "max_age");
    let mut period = paper;
    period.period = 0;
    assert_eq!(field(refused(period)), "period");
    for c in [-0.1, 1.1, f64::NAN] {
        let mut denoising = paper;
        denoising.denoising = Denoising::FewWins { c };
        assert_eq!(field(refused(denoising)), "denoising.c");
    }
    for distance in [-1.0, f64::NAN, f64::INFINITY] {
        let mut threshold = paper;
        threshold.threshold = SimilarityThreshold::Constant(distance);
        assert_eq!(field(refused(threshold)), "threshold");
    }
    assert_eq!(
        Soinn::<f64>::new(0, paper).map(|_| ()),
        Err(QuantizerConfigError::NoFeatures)
    );
}

/// A point seen again before there are two units is a win of the first.
#[test]
fn one_point_wins_as_often_as_it_is_seen() {
    let mut soinn = Soinn::<f64>::new(2, SoinnConfig::noisy()).unwrap();
    for _ in 0..5 {
        soinn.observe(&[1.0, 2.0]).unwrap();
    }
    assert_eq!(soinn.network().len(), 1);
    let id = soinn.network().ids().next().unwrap();
    assert!((soinn.wins(id).unwrap() - 5.0).abs() < 1e-12);
    assert!(soinn.error(id).unwrap().abs() < 1e-12);
    assert_eq!(soinn.steps(), 0);
}

/// Four squares at growing distances, or one: the threshold is the least gap that is no shorter
/// than a mean edge, and the longest edge where there is no gap.
#[test]
fn the_least_of_several_gaps_is_the_threshold() {
    for places in [&[0.0, 20.0, 52.0, 97.0][..], &[0.0]] {
        let mut first = Soinn::<f64>::new(2, SoinnConfig::noisy()).unwrap();
        let mut chance = ChaCha8Rng::seed_from_u64(4);
        for step in 0..12_000_usize {
            let x = places[step % places.len()] + 5.0 * chance.random::<f64>();
            first.observe(&[x, 5.0 * chance.random::<f64>()]).unwrap();
        }
        first.remove_noise();
        let network = first.network();
        assert_eq!(network.clusters().count(), places.len());
        let at = |id| network.prototype(id).unwrap().collect::<Vec<f64>>();
        let square = |place: &[f64]| places.iter().rposition(|begin| place[0] >= begin - 1.0);
        let units: Vec<Vec<f64>> = network.ids().map(at).collect();
        let pairs = units.iter().flat_map(|a| units.iter().map(move |b| (a, b)));
        let gaps = pairs.filter(|(a, b)| square(a) != square(b));
        let gap = gaps
            .map(|(a, b)| squared(a, b).sqrt())
            .fold(f64::INFINITY, f64::min);
        let lengths = network
            .edges()
            .map(|edge| squared(&at(edge.ends.0), &at(edge.ends.1)).sqrt());
        let longest = lengths.fold(0.0, f64::max);
        let expected = if places.len() > 1 { gap } else { longest };
        let mut config = SecondLayerConfig::shen_hasegawa();
        config.threshold = SecondThreshold::BetweenClusters;
        let layer = first
            .second_layer(&config, &mut ChaCha8Rng::seed_from_u64(0))
            .unwrap();
        match layer.config().threshold {
            SimilarityThreshold::Constant(distance) => {
                assert!((distance - expected).abs() < 1e-9, "{distance} {expected}");
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn the_second_layer_s_threshold_is_the_gap_between_clusters() {
    // Two squares, 15 apart.
    let mut first = Soinn::<f64>::new(2, SoinnConfig::noisy()).unwrap();
    let mut chance = ChaCha8Rng::seed_from_u64(1);
    for step in 0..20_000_u32 {
        let x = 20.0 * f64::from(step % 2) + 5.0 * chance.random::<f64>();
        first.observe(&[x, 5.0 * chance.random::<f64>()]).unwrap();
    }
    first.remove_noise();
    let network = first.network();
    assert_eq!(network.clusters().count(), 2);
    let rng = || ChaCha8Rng::seed_from_u64(0);
    let second = |threshold| {
        let mut config = SecondLayerConfig::shen_hasegawa();
        config.threshold = threshold;
        first.second_layer(&config, &mut rng())
    };
    let at = |id| network.prototype(id).unwrap().collect::<Vec<f64>>();
    let (left, right): (Vec<_>, Vec<_>) = network.ids().map(at).partition(|place| place[0] < 10.0);
    let gap = left
        .iter()
        .flat_map(|a| right.iter().map(|b| squared(a, b).sqrt()))
        .fold(f64::INFINITY, f64::min);
    let layer = second(SecondThreshold::BetweenClusters).unwrap();
    match layer.config().threshold {
        SimilarityThreshold::Constant(distance) => assert!((distance - gap).abs() < 1e-9),
        other => panic!("{other:?}"),
    }
    let lengths: Vec<f64> = network
        .edges()
        .map(|edge| squared(&at(edge.ends.0), &at(edge.ends.1)).sqrt())
        .collect();
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let layer = second(SecondThreshold::WithinClusters { factor: 3.0 }).unwrap();
    match layer.config().threshold {
        SimilarityThreshold::Constant(distance) => assert!((distance - 3.0 * mean).abs() < 1e-9),
        other => panic!("{other:?}"),
    }
    assert!(matches!(
        second(SecondThreshold::WithinClusters { factor: 1.0 }),
        Err(SecondLayerError::Config(
            QuantizerConfigError::OutOfRange { .. }
        ))
    ));
    assert!(matches!(
        Soinn::<f64>::new(2, SoinnConfig::noisy())
            .unwrap()
            .second_layer(&SecondLayerConfig::shen_hasegawa(), &mut rng()),
        Err(SecondLayerError::TooFewUnits { found: 0 })
    ));
}

#[test]
fn weights_hold_in_both_layers() {
    // The third feature is noise, and does not count.
    let weights = [1.0, 1.0, 0.0];
    let mut soinn = Soinn::<f64>::weighted(&weights, SoinnConfig::noisy()).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for step in 0..10_000_u32 {
        let mut at = || rng.random::<f64>();
        let input = [4.0 * f64::from(step % 2) + at(), at(), 1000.0 * at()];
        soinn.observe(&input).unwrap();
    }
    soinn.remove_noise();
    let second = soinn
        .second_layer(&SecondLayerConfig::noisy(), &mut rng)
        .unwrap();
    assert_eq!(second.network().weights(), Some(&weights[..]));
    assert_eq!(second.network().clusters().count(), 2);
}

fn values(recalls: Vec<Recall<f64>>) -> Vec<Vec<f64>> {
    recalls.into_iter().map(|recall| recall.values).collect()
}

#[test]
fn many_keys_have_many_responses() {
    let mut memory = AssociativeMemory::<f64>::new(2, 1, SoinnConfig::exact()).unwrap();
    let lessons = [
        ([0.0, 0.0], [1.0]),
        ([0.0, 0.0], [2.0]),
        ([5.0, 0.0], [2.0]),
        ([9.0, 9.0], [7.0]),
    ];
    for _ in 0..4 {
        for (key, response) in &lessons {
            memory.associate(key, response).unwrap();
        }
    }
    assert_eq!(
        memory.soinn().network().clusters().count(),
        4,
        "one each, however often"
    );
    let mut responses = values(memory.responses(&[0.1, 0.0], 0.5).unwrap());
    responses.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!(responses, [[1.0], [2.0]]);
    assert_eq!(
        values(memory.keys(&[2.0], 0.5).unwrap()),
        [[0.0, 0.0], [5.0, 0.0]]
    );
    assert_eq!(
        values(memory.responses(&[3.0, 3.0], 0.5).unwrap()),
        Vec::<Vec<f64>>::new()
    );
    assert_eq!(memory.response(&[8.0, 8.0]).unwrap().values, [7.0]);
    assert!(
        (memory.response(&[8.0, 9.0]).unwrap().unit.distance() - 1.0).abs() < 1e-12,
        "keys only are compared"
    );
}

#[test]
fn noisy_lessons_are_learnt_to_their_means() {
    // Four patterns that lead in a ring, each lesson with noise on all features.
    let patterns = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let mut memory = AssociativeMemory::<f64>::new(2, 2, SoinnConfig::noisy()).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    // To the end of a period: what is new and alone has just gone.
    for step in 0..8002_usize {
        let mut noisy =
            |pattern: [f64; 2]| pattern.map(|value| value + 0.6 * (rng.random::<f64>() - 0.5));
        let (key, response) = (noisy(patterns[step % 4]), noisy(patterns[(step + 1) % 4]));
        memory.associate(&key, &response).unwrap();
    }
    assert!(memory.soinn().network().len() < 400, "it is compact");
    for (place, pattern) in patterns.iter().enumerate() {
        let forth = memory.response(pattern).unwrap().values;
        let back = memory.key(pattern).unwrap().values;
        assert!(
            squared(&forth, &patterns[(place + 1) % 4]).sqrt() < 0.5,
            "{forth:?}"
        );
        assert!(
            squared(&back, &patterns[(place + 3) % 4]).sqrt() < 0.5,
            "{back:?}"
        );
        assert_eq!(memory.responses(pattern, 0.5).unwrap().len(), 1);
    }
    // A ring goes round forever.
    let chain = memory.chain(&patterns[0], 1.0).unwrap().take(9);
    for (step, recall) in chain.enumerate() {
        let expected = patterns[(step + 1) % 4];
        assert!(squared(&recall.values, &expected).sqrt() < 0.6);
    }
}

#[test]
fn a_memory_refuses_what_it_cannot_hold() {
    let new = |key, response| AssociativeMemory::<f64>::new(key, response, SoinnConfig::exact());
    assert_eq!(new(0, 1).map(|_| ()), Err(QuantizerConfigError::NoFeatures));
    assert_eq!(new(1, 0).map(|_| ()), Err(QuantizerConfigError::NoFeatures));
    let mut memory = new(2, 1).unwrap();
    assert_eq!(memory.response(&[0.0, 0.0]), Err(InputError::NoUnits));
    let wrong = |expected, found| InputError::WrongDimension { expected, found };
    assert_eq!(memory.associate(&[0.0], &[0.0, 1.0]), Err(wrong(2, 1)));
    assert_eq!(memory.associate(&[0.0; 2], &[0.0; 2]), Err(wrong(1, 2)));
    memory.associate(&[0.0, 0.0], &[1.0]).unwrap();
    assert_eq!(memory.key(&[0.0, 0.0]).map(|_| ()), Err(wrong(1, 2)));
    assert!(matches!(
        memory.responses(&[f64::NAN, 0.0], 1.0),
        Err(InputError::NotFinite { .. })
    ));
    assert_eq!(
        memory.chain(&[0.0, 0.0], 1.0).map(|_| ()),
        Err(wrong(2, 1)),
        "a response of another size cannot be a key"
    );
}

#[test]
fn presets_are_those_of_their_papers() {
    let [paper, noisy, cpm] = [
        SoinnConfig::shen_hasegawa(),
        SoinnConfig::noisy(),
        SoinnConfig::cpm(),
    ];
    assert_eq!([paper, noisy, cpm].map(|one| one.max_age), [100, 20, 20]);
    assert_eq!([paper, noisy, cpm].map(|one| one.period), [100, 100, 20]);
    assert_eq!(noisy.denoising, Denoising::LowRate { c: 1.0 });
    assert_eq!(
        [paper, cpm].map(|one| one.denoising),
        [Denoising::FewWins { c: 1.0 }; 2]
    );
}

#[test]
fn steps_count_from_the_third_input() {
    let mut soinn = Soinn::<f64>::new(1, SoinnConfig::exact()).unwrap();
    for (number, input) in [0.0, 9.0, 4.0, 4.1, 7.0].into_iter().enumerate() {
        soinn.observe(&[input]).unwrap();
        assert_eq!(soinn.steps(), (number as u64).saturating_sub(1));
    }
}
