//! Properties of every growing neural gas after every input.

use alloc::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;
use tolman_quantizers::{
    Edge, ErrorKind, Event, Gng, GngConfig, GrowthGate, Network, Quantizer, Removal, StepOrder,
    UnitId, UnknownUnit, Utility,
};

use super::streams::{cube, grid};

/// Configurations of every kind, with small numbers so that much happens.
pub(crate) fn configs() -> impl Strategy<Value = GngConfig> {
    let rates = (0.0..=1.0, 0.0..=0.3, 1..12_u32, 1..8_u32, 0.0..=1.0);
    let kinds = (
        prop::sample::select(vec![StepOrder::Fritzke, StepOrder::Mslst]),
        prop::sample::select(vec![
            ErrorKind::Squared,
            ErrorKind::Absolute,
            ErrorKind::Relative,
        ]),
        prop_oneof![
            Just(GrowthGate::Open),
            (0.0..2.0).prop_map(|threshold| GrowthGate::MeanError { threshold }),
            (0.0..0.1).prop_map(|threshold| GrowthGate::Rate { threshold }),
        ],
        prop::option::of(
            (0.5..20.0, any::<bool>()).prop_map(|(threshold, always)| Utility {
                threshold,
                removal: if always {
                    Removal::EveryInput
                } else {
                    Removal::WhenFull
                },
            }),
        ),
    );
    let bounds = (
        prop_oneof![1e-300..1.0, 0.9..=1.0_f64],
        prop_oneof![2..60_usize, Just(usize::MAX)],
    );
    (rates, kinds, bounds).prop_map(|(rates, (order, error, gate, utility), bounds)| {
        let mut config = GngConfig::fritzke();
        (config.winner_rate, config.neighbour_rate) = (rates.0, rates.1);
        (config.max_age, config.growth_period, config.split_factor) = (rates.2, rates.3, rates.4);
        (config.decay, config.max_units) = bounds;
        (config.order, config.error) = (order, error);
        (config.gate, config.utility) = (gate, utility);
        config
    })
}

/// Streams with and without repeated points and equal distances.
pub(crate) fn streams() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let shape = (1..5_usize, 1..400_usize, any::<u64>());
    (shape, any::<bool>()).prop_map(|((dimension, len, seed), on_grid)| {
        if on_grid {
            grid(dimension, len, seed)
        } else {
            cube(dimension, len, seed)
        }
    })
}

type Edges = BTreeSet<(UnitId, UnitId)>;

fn edges(network: &Network<f64>) -> Edges {
    network.edges().map(|edge| edge.ends).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn keeps_its_graph_and_numbers_sound(config in configs(), inputs in streams()) {
        let mut gng = Gng::new(inputs[0].len(), config).unwrap();
        let mut seen = BTreeSet::new();
        let mut present = BTreeSet::new();
        for input in &inputs {
            let observation = gng.observe(input).unwrap();
            let network = gng.network();
            prop_assert!(seen.contains(&observation.first.id) || network.contains(observation.first.id));
            prop_assert!(network.len() <= config.max_units);

            let now: BTreeSet<_> = network.ids().collect();
            prop_assert_eq!(now.len(), network.len());
            for id in now.difference(&present) {
                prop_assert!(seen.insert(*id), "unit {} came twice", id);
            }
            present = now;

            for edge in network.edges() {
                prop_assert!(edge.age <= config.max_age);
                prop_assert!(edge.ends.0 < edge.ends.1);
                prop_assert!(network.neighbours(edge.ends.0).unwrap().any(|id| id == edge.ends.1));
                prop_assert!(network.neighbours(edge.ends.1).unwrap().any(|id| id == edge.ends.0));
            }
            for id in network.ids() {
                prop_assert!(network.len() < 2 || network.neighbours(id).unwrap().count() > 0);
                prop_assert!(network.neighbours(id).unwrap().all(|other| network.contains(other)));
                prop_assert!(network.prototype(id).unwrap().all(|value| (-1e-9..=3.0 + 1e-9).contains(&value)));
                let (error, utility) = (gng.error(id).unwrap(), gng.utility(id).unwrap());
                prop_assert!(error >= 0.0 && error.is_finite());
                prop_assert!(utility >= 0.0 && utility.is_finite());
            }
        }
        // Two units are never given up again.
        let distinct = inputs.iter().any(|input| input != &inputs[0]);
        prop_assert_eq!(gng.network().len() >= 2, distinct);
    }

    #[test]
    fn tells_what_happens(config in configs(), inputs in streams(), merge in any::<bool>()) {
        let mut gng = Gng::new(inputs[0].len(), config).unwrap();
        gng.events().listen();
        let (mut units, mut links) = (BTreeSet::new(), Edges::new());
        for (step, input) in inputs.iter().enumerate() {
            gng.observe(input).unwrap();
            if merge && step % 50 == 49 {
                let ids: Vec<_> = gng.network().ids().collect();
                gng.merge(ids[ids.len() / 2], ids[0]).unwrap();
            }
            for event in gng.events().drain() {
                match event {
                    Event::Inserted { id, between } => {
                        prop_assert!(units.insert(id));
                        prop_assert!(between.is_none_or(|(a, b)| units.contains(&a) && units.contains(&b)));
                    }
                    Event::Removed { id } | Event::Merged { gone: id, .. } => {
                        prop_assert!(units.remove(&id));
                        prop_assert!(links.iter().all(|(a, b)| *a != id && *b != id));
                    }
                    Event::Linked(a, b) => prop_assert!(links.insert((a, b))),
                    Event::Unlinked(a, b) => prop_assert!(links.remove(&(a, b))),
                    other => prop_assert!(false, "{other:?} is not known here"),
                }
            }
        }
        prop_assert_eq!(&units, &gng.network().ids().collect());
        prop_assert_eq!(links, edges(gng.network()));
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20))]

    /// Compares with the algorithm written again, as literally as possible.
    #[test]
    fn does_what_fritzke_wrote(seed: u64, dimension in 1..4_usize) {
        let mut config = GngConfig::fritzke();
        config.growth_period = 7;
        config.max_age = 6;
        config.max_units = 30;
        let mut gng = Gng::new(dimension, config).unwrap();
        let inputs = cube(dimension, 600, seed);
        let mut literal = Literal::new(&inputs[0], &inputs[1]);
        for (step, input) in inputs.iter().enumerate() {
            gng.observe(input).unwrap();
            if step >= 2 {
                literal.step(input, &config);
            }
        }
        prop_assert_eq!(edges(gng.network()), literal.edges.keys().copied().collect::<Edges>());
        let ages = gng.network().edges().map(|edge| (edge.ends, edge.age));
        prop_assert_eq!(ages.collect::<BTreeMap<_, _>>(), literal.edges);
        for (id, (prototype, error)) in &literal.units {
            prop_assert_eq!(&gng.network().prototype(*id).unwrap().collect::<Vec<_>>(), prototype);
            prop_assert!((gng.error(*id).unwrap() - error).abs() <= 1e-9 * error.max(1e-9));
        }
    }
}

/// Fritzke 1995, section 2, steps 1 to 10, with maps and sweeps instead of what makes it fast.
struct Literal {
    units: BTreeMap<UnitId, (Vec<f64>, f64)>,
    edges: BTreeMap<(UnitId, UnitId), u32>,
    next: u32,
    steps: u32,
}

fn pair(a: UnitId, b: UnitId) -> (UnitId, UnitId) {
    (a.min(b), a.max(b))
}

impl Literal {
    fn new(first: &[f64], second: &[f64]) -> Self {
        let units = [
            (UnitId(0), (first.into(), 0.0)),
            (UnitId(1), (second.into(), 0.0)),
        ];
        Self {
            units: units.into(),
            edges: [((UnitId(0), UnitId(1)), 0)].into(),
            next: 2,
            steps: 0,
        }
    }

    fn neighbours(&self, of: UnitId) -> Vec<UnitId> {
        let ends = self.edges.keys().filter(|(a, b)| *a == of || *b == of);
        ends.map(|(a, b)| if *a == of { *b } else { *a }).collect()
    }

    fn worst(&self, ids: impl Iterator<Item = UnitId>) -> UnitId {
        let mut ids: Vec<_> = ids.collect();
        ids.sort_by(|a, b| self.units[b].1.total_cmp(&self.units[a].1).then(a.cmp(b)));
        ids[0]
    }

    fn step(&mut self, input: &[f64], config: &GngConfig) {
        let distance = |prototype: &[f64]| {
            let squares = prototype.iter().zip(input).map(|(p, x)| (x - p) * (x - p));
            squares.fold(0.0, |sum, square| sum + square)
        };
        let mut near: Vec<_> = self
            .units
            .iter()
            .map(|(id, unit)| (distance(&unit.0), *id))
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let ((squared, s1), (_, s2)) = (near[0], near[1]);
        for (ends, age) in &mut self.edges {
            if ends.0 == s1 || ends.1 == s1 {
                *age += 1;
            }
        }
        self.units.get_mut(&s1).unwrap().1 += squared;
        let neighbours = self.neighbours(s1);
        let rates = neighbours.iter().map(|id| (*id, config.neighbour_rate));
        for (id, rate) in rates.chain([(s1, config.winner_rate)]) {
            for (p, x) in self.units.get_mut(&id).unwrap().0.iter_mut().zip(input) {
                *p += rate * (x - *p);
            }
        }
        self.edges.insert(pair(s1, s2), 0);
        self.edges.retain(|_, age| *age <= config.max_age);
        let ids: Vec<_> = self.units.keys().copied().collect();
        for id in ids {
            if self.neighbours(id).is_empty() {
                self.units.remove(&id);
            }
        }
        self.steps += 1;
        if self.steps.is_multiple_of(config.growth_period) && self.units.len() < config.max_units {
            let q = self.worst(self.units.keys().copied());
            let f = self.worst(self.neighbours(q).into_iter());
            let r = UnitId(self.next);
            self.next += 1;
            let middle = self.units[&q].0.iter().zip(&self.units[&f].0);
            let middle = middle.map(|(a, b)| 0.5 * (a + b)).collect();
            self.edges.remove(&pair(q, f));
            self.edges.insert(pair(q, r), 0);
            self.edges.insert(pair(r, f), 0);
            self.units.get_mut(&q).unwrap().1 *= config.split_factor;
            self.units.get_mut(&f).unwrap().1 *= config.split_factor;
            self.units.insert(r, (middle, self.units[&q].1));
        }
        for unit in self.units.values_mut() {
            unit.1 *= config.decay;
        }
    }
}

#[test]
fn mslst_moves_the_second_unit_it_has_just_linked() {
    let start = [[0.0], [2.0], [8.0], [10.0]];
    let run = |order| {
        let mut config = GngConfig::fritzke();
        config.order = order;
        let mut gng = Gng::new(1, config).unwrap();
        gng.begin_with(&start).unwrap();
        // Nearest is 2, second 8.
        gng.observe(&[4.9]).unwrap();
        let age = gng
            .network()
            .edges()
            .find(|edge| edge.ends == (UnitId(1), UnitId(2)));
        let moved = gng.network().prototype(UnitId(2)).unwrap().next().unwrap();
        (age.unwrap().age, moved < 8.0)
    };
    // Joined before: both orders move it, and the edge's age tells them apart.
    assert_eq!(run(StepOrder::Fritzke), (0, true));
    assert_eq!(run(StepOrder::Mslst), (1, true));

    let unjoined = |order| {
        let mut config = GngConfig::fritzke();
        config.order = order;
        let mut gng = Gng::new(1, config).unwrap();
        gng.begin_with(&[[0.0], [5.0], [1.0]]).unwrap();
        gng.observe(&[0.4]).unwrap();
        gng.network().prototype(UnitId(2)).unwrap().next().unwrap()
    };
    assert!(unjoined(StepOrder::Fritzke) >= 1.0);
    assert!(unjoined(StepOrder::Mslst) < 1.0);
}

#[test]
fn utility_follows_a_jump() {
    // All inputs move to another place: GNG leaves units behind, GNG-U brings them along.
    let left_behind = |utility| {
        let mut config = GngConfig::fritzke();
        config.max_units = 20;
        config.utility = utility;
        let mut gng = Gng::new(2, config).unwrap();
        for input in cube(2, 10_000, 1) {
            gng.observe(&input).unwrap();
        }
        for input in cube(2, 10_000, 2) {
            gng.observe(&[input[0] + 10.0, input[1]]).unwrap();
        }
        let network = gng.network();
        let x = |id| network.prototype(id).unwrap().next().unwrap();
        network.ids().filter(|id| x(*id) < 5.0).count()
    };
    assert!(left_behind(None) >= 5);
    for removal in [Removal::EveryInput, Removal::WhenFull] {
        assert_eq!(
            left_behind(Some(Utility {
                threshold: 3.0,
                removal
            })),
            0
        );
    }
}

#[test]
fn a_network_merged_into_one_unit_goes_on() {
    let mut gng = Gng::<f64>::new(1, GngConfig::fritzke()).unwrap();
    gng.observe(&[0.0]).unwrap();
    gng.observe(&[1.0]).unwrap();
    gng.merge(UnitId(0), UnitId(1)).unwrap();
    assert_eq!(gng.merge(UnitId(0), UnitId(1)), Err(UnknownUnit(UnitId(0))));
    assert_eq!(gng.network().len(), 1);
    // One unit again, so the next point that differs is the second.
    gng.observe(&[0.0]).unwrap();
    let edges: Vec<_> = gng.network().edges().collect();
    assert_eq!(
        edges,
        [Edge {
            ends: (UnitId(1), UnitId(2)),
            age: 0
        }]
    );
    gng.observe(&[0.1]).unwrap();
}

#[test]
fn presets_are_those_of_their_papers() {
    let mslst = GngConfig::mslst(50.0);
    assert_eq!(mslst.order, StepOrder::Mslst);
    assert_eq!(mslst.gate, GrowthGate::MeanError { threshold: 50.0 });
    let provost = GngConfig::provost(0.1);
    let rates = [provost.winner_rate, provost.neighbour_rate, provost.decay];
    assert_eq!(
        rates.map(f64::to_bits),
        [0.05, 0.0006, 0.9995].map(f64::to_bits)
    );
    assert_eq!((provost.max_age, provost.growth_period), (100, 200));
    assert_eq!(
        (provost.error, provost.gate),
        (ErrorKind::Relative, GrowthGate::Rate { threshold: 0.1 })
    );
    assert_eq!(
        provost.split_factor.to_bits(),
        GngConfig::fritzke().split_factor.to_bits()
    );
}

#[test]
fn an_error_at_the_threshold_makes_no_unit() {
    for gate in [
        GrowthGate::MeanError { threshold: 0.0 },
        GrowthGate::Rate { threshold: 0.0 },
    ] {
        let mut config = GngConfig::fritzke();
        (config.gate, config.growth_period, config.neighbour_rate) = (gate, 1, 0.0);
        let mut gng = Gng::<f64>::new(1, config).unwrap();
        // Both units are where the inputs are, so there is no error.
        for input in [0.0, 1.0].repeat(20) {
            gng.observe(&[input]).unwrap();
        }
        assert_eq!(gng.network().len(), 2, "{gate:?}");
        for _ in 0..20 {
            gng.observe(&[0.5]).unwrap();
        }
        assert!(gng.network().len() > 2, "{gate:?}");
    }
}

#[test]
fn a_network_counts_its_steps_and_names_its_units() {
    let mut gng = Gng::<f64>::new(1, GngConfig::fritzke()).unwrap();
    for input in 0..7_u32 {
        gng.observe(&[f64::from(input)]).unwrap();
    }
    // The first two became units.
    assert_eq!(gng.steps(), 5);
    assert_eq!(UnitId(37).to_string(), "37");
    let clusters = gng.network().clusters();
    let labels: Vec<_> = gng.network().ids().map(|id| clusters.label(id)).collect();
    assert!(labels.iter().all(|label| *label == Ok(0)), "{labels:?}");
    assert!(clusters.label(UnitId(999)).is_err());
    assert!(gng.network().ids().all(|id| gng.utility(id) == Ok(0.0)));
}
