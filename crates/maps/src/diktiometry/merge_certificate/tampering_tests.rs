//! Changes every field of certificates, as found in their serialized form, and asks the checker.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::FRAC_PI_2;

use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use tolman_maze::drawings::ring;
use tolman_maze::{Braided, Direction, Maze};

#[expect(dead_code, reason = "the tests from outside need more of it")]
#[path = "../../../tests/it/diktiometry/abstract_world.rs"]
mod abstract_world;

use super::look_evidence::look_alike;
use super::{
    CertifiedMerges, Identities, LookEvidence, MergeCertificate, MergeCertificateError, MergeProof,
    certify_merges, verifier, verify_merges,
};
use crate::diktiometry::{
    Action, Apart, Config, Exits, FirstPlace, Journal, JournalLength, Looks, MoveOutcome,
    ObservedMove, Observer, Signature, Use,
};
use abstract_world::{AbstractRobot, AbstractWorld, MoveNoise};

const MOVES: usize = 400;

/// A walk through a small world, with the certificates of its merges and the truth.
struct Walked {
    config: Config,
    journal: Journal,
    /// True place of each visit.
    truth: Vec<u32>,
    certificates: Vec<MergeCertificate>,
}

impl Walked {
    /// Walks the corridors of a small maze at random, between walls of `colours` colours.
    fn new(colours: u32, seed: u64) -> Self {
        let shape = Braided {
            width: 6,
            height: 6,
            share: 1.0,
        };
        let maze = shape.generate(&mut ChaCha8Rng::seed_from_u64(seed));
        Self::through(&maze.unwrap(), colours, seed)
    }

    /// Walks round a ring.
    fn round(colours: u32, seed: u64) -> Self {
        let ring = ring((8, 8), &mut ChaCha8Rng::seed_from_u64(seed));
        Self::through(&ring.unwrap(), colours, seed)
    }

    fn through(maze: &Maze, colours: u32, seed: u64) -> Self {
        let world = AbstractWorld::from_corridors(maze, 1.0).painted(colours, seed);
        let config = config();
        let (journal, truth) = walk(world, &config, seed);
        let CertifiedMerges { certificates, .. } = certify_merges(&config, &journal).unwrap();
        Self {
            config,
            journal,
            truth,
            certificates,
        }
    }

    /// Checks the certificates up to one that is put in the place of another.
    fn verify_with(
        &self,
        number: usize,
        changed: MergeCertificate,
    ) -> Result<(), MergeCertificateError> {
        let mut certificates = self.certificates[..number].to_vec();
        certificates.push(changed);
        verify_merges(&self.config, &self.journal, &certificates)
    }

    /// Returns whether a certificate in the place of this one is true by the world itself: its
    /// visits were to one place, and looks agree by coincidence as rarely as it states.
    fn is_true(&self, number: usize, certificate: &MergeCertificate) -> bool {
        let [one, other] = certificate.visits.map(|visit| self.truth[visit]);
        let is_stated_right = match &certificate.proof {
            MergeProof::Bounds(_) | MergeProof::Winding(_) => true,
            MergeProof::Looks(evidence) => {
                are_parts(&evidence.looks)
                    && (self.coincidence(number, evidence) - evidence.chance).abs() < 1e-6
            }
        };
        one == other && is_stated_right
    }

    /// Returns the probability of a coincidence, computed without the certificates' code for it.
    fn coincidence(&self, number: usize, evidence: &LookEvidence) -> f64 {
        let first = |index: usize| evidence.pairs[index].visits[0];
        let is_new = |index: &usize| {
            let mut before = 0..*index;
            !before
                .any(|other| look_alike(first(other), first(*index), &self.config, &self.journal))
        };
        let agreeing = (0..evidence.pairs.len()).filter(is_new).count();
        let others = f64::from(evidence.looks.kinds) + 2.0;
        let by_rule = rule_power(&evidence.looks, self.paired(number, evidence));
        (others * mean_power(&evidence.looks, agreeing).max(by_rule)).min(1.0)
    }

    /// Returns the number of pairs of which no place is in a pair before, by the identities that
    /// the certificates before this one prove.
    fn paired(&self, number: usize, evidence: &LookEvidence) -> usize {
        let mut known = Identities::new(&self.config);
        for step in &self.journal.moves {
            known.arrive(step.action);
        }
        for certificate in &self.certificates[..number] {
            known.join(certificate.visits[0], certificate.visits[1]);
        }
        let mut used: Vec<usize> = Vec::new();
        for pair in &evidence.pairs {
            if !pair
                .visits
                .iter()
                .any(|visit| used.iter().any(|other| known.same(*visit, *other)))
            {
                used.extend(pair.visits);
            }
        }
        used.len() / 2
    }
}

/// Returns whether counts are of pairs, of the alike among these, of those with known neighbours,
/// and of those whose neighbours are alike, too.
fn are_parts(looks: &Looks) -> bool {
    let Looks {
        different,
        deceiving,
        followed,
        repeating,
        ..
    } = *looks;
    [different, deceiving, followed, repeating].is_sorted_by(|whole, part| part <= whole)
}

/// Returns the mean of pᵏ, where p has the beta distribution that the counts give with Jeffreys'
/// prior, by an integral over p = sin² θ.
fn mean_power(looks: &Looks, agreeing: usize) -> f64 {
    let kinds = f64::from(looks.kinds);
    let pairs = f64::from(looks.different).min(0.5 * kinds * (kinds - 1.0));
    if pairs < 1.0 {
        return 1.0;
    }
    let alike = pairs * f64::from(looks.deceiving) / f64::from(looks.different);
    let weight = |theta: f64, power: f64| {
        let (sine, cosine) = (libm::sin(theta), libm::cos(theta));
        libm::pow(sine, 2.0 * (alike + power)) * libm::pow(cosine, 2.0 * (pairs - alike))
    };
    let steps = 4000;
    let integral = |power: f64| -> f64 {
        let middle = |step: u32| (f64::from(step) + 0.5) * FRAC_PI_2 / f64::from(steps);
        (0..steps).map(|step| weight(middle(step), power)).sum()
    };
    integral(agreeing as f64) / integral(0.0)
}

/// Returns the power of the rate at which neighbours of places that look alike do so, too.
fn rule_power(looks: &Looks, places: usize) -> f64 {
    let repeats = f64::from(looks.repeating) / (f64::from(looks.followed) + 2.0);
    (0..places).map(|_| repeats).product()
}

fn config() -> Config {
    let mut config = verifier::tests::config();
    config.actions = Config::corridor_actions();
    config.journal = JournalLength::All;
    config.apart = Apart::Side;
    config.restructuring.look_merge = Use::On;
    config.restructuring.winding_merge = Use::On;
    config
}

fn percept(look: [f64; 4]) -> Option<Signature> {
    Some(Signature::new(1, look.to_vec()).unwrap())
}

/// Returns the journal of a random walk, and the true place of each visit.
fn walk(world: AbstractWorld, config: &Config, seed: u64) -> (Journal, Vec<u32>) {
    let mut noise = MoveNoise::NONE;
    (noise.distance, noise.compass, noise.look) = (0.2, 0.14, 0.2);
    let mut robot = AbstractRobot::new(world.into(), 0, noise, seed).unwrap();
    let start = FirstPlace {
        percept: percept(robot.look()),
        exits: exits(&robot),
    };
    let mut observer = Observer::new(config.clone(), start).unwrap();
    let mut truth = vec![robot.at()];
    for _ in 0..MOVES {
        let direction = robot.wander().unwrap();
        let moved = robot.go(direction).unwrap();
        let step = ObservedMove {
            action: Action(direction as u32),
            odometry: moved.odometry,
            percept: percept(moved.look),
            exits: exits(&robot),
            outcome: MoveOutcome::Arrived,
        };
        observer.step(&step).unwrap();
        truth.push(moved.to);
    }
    (observer.journal().unwrap().clone(), truth)
}

fn exits(robot: &AbstractRobot) -> Exits {
    let exits = robot.world().exits(robot.at());
    Exits::Seen(
        exits
            .map(|direction: Direction| Action(direction as u32))
            .collect(),
    )
}

/// Returns the pointers to all leaves of a value, and to all elements of its arrays.
fn parts(value: &Value, at: &str, leaves: &mut Vec<String>, elements: &mut Vec<String>) {
    match value {
        Value::Array(all) => {
            for (index, part) in all.iter().enumerate() {
                let at = format!("{at}/{index}");
                elements.push(at.clone());
                parts(part, &at, leaves, elements);
            }
        }
        Value::Object(all) => {
            for (key, part) in all {
                parts(part, &format!("{at}/{key}"), leaves, elements);
            }
        }
        _ => leaves.push(at.to_string()),
    }
}

/// Returns other values for a leaf.
fn others(leaf: &Value, any: u64) -> Vec<Value> {
    let mut others = match leaf {
        Value::Bool(is) => vec![json!(!is)],
        Value::Null => (0..4).map(|action| json!([0, action])).collect(),
        Value::Number(number) => match number.as_u64() {
            Some(whole) => {
                let near = [whole.wrapping_add(1), whole.wrapping_sub(1)];
                let far = [
                    0,
                    any,
                    u64::from(u32::MAX),
                    u64::MAX,
                    whole ^ 1 << (any % 64),
                ];
                near.into_iter().chain(far).map(Value::from).collect()
            }
            None => {
                let real = number.as_f64().unwrap();
                let near = [
                    0.5 * real,
                    real.next_up(),
                    real.next_down(),
                    0.0,
                    1.0,
                    -real,
                ];
                near.map(Value::from).into()
            }
        },
        _ => Vec::new(),
    };
    others.retain(|other| other != leaf);
    others
}

/// Returns all certificates that differ from one in a leaf of its serialized form, or lack an
/// element of an array. What is no certificate any more is left out.
fn changed(certificate: &MergeCertificate, any: u64) -> Vec<MergeCertificate> {
    let whole = serde_json::to_value(certificate).unwrap();
    let (mut leaves, mut elements) = (Vec::new(), Vec::new());
    parts(&whole, "", &mut leaves, &mut elements);
    let mut all = Vec::new();
    for at in leaves {
        for other in others(whole.pointer(&at).unwrap(), any) {
            let mut value = whole.clone();
            *value.pointer_mut(&at).unwrap() = other;
            all.push(value);
        }
    }
    for at in elements {
        let mut value = whole.clone();
        let (array, index) = at.rsplit_once('/').unwrap();
        let array = value.pointer_mut(array).unwrap().as_array_mut().unwrap();
        array.remove(index.parse().unwrap());
        all.push(value);
    }
    let certificates = all
        .into_iter()
        .filter_map(|value| serde_json::from_value(value).ok());
    certificates.filter(|other| other != certificate).collect()
}

/// Returns the names of the fields that lead to the leaves of a value, without indices.
fn fields(value: &Value) -> BTreeSet<String> {
    let (mut leaves, mut elements) = (Vec::new(), Vec::new());
    parts(value, "", &mut leaves, &mut elements);
    let names = leaves.iter().map(|leaf| {
        let names = leaf
            .split('/')
            .filter(|name| name.parse::<usize>().is_err());
        names.collect::<Vec<&str>>().join("/")
    });
    names.collect()
}

fn any_walk() -> impl Strategy<Value = Walked> {
    let walk = |(is_ring, colours, seed)| {
        let walk = if is_ring { Walked::round } else { Walked::new };
        walk(colours, seed)
    };
    (prop::bool::weighted(0.25), 1_u32..9, 0_u64..1000).prop_map(walk)
}

impl core::fmt::Debug for Walked {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "{} certificates of {} visits",
            self.certificates.len(),
            self.truth.len()
        )
    }
}

#[test]
fn walks_have_certificates_with_every_field() {
    let mut found = BTreeSet::new();
    for seed in 0..4 {
        let walks = [Walked::new(8, seed), Walked::round(1, seed)];
        for certificate in walks.into_iter().flat_map(|walk| walk.certificates) {
            found.extend(fields(&serde_json::to_value(certificate).unwrap()));
        }
    }
    let of_all = ["/visits", "/rests_on_looks", "/seal"];
    let of_bounds = ["/proof/Bounds/begin", "/proof/Bounds/end"];
    let of_winding = [
        "/proof/Winding/corners",
        "/proof/Winding/begins",
        "/proof/Winding/corridors/begin",
        "/proof/Winding/corridors/end",
    ];
    let of_looks = [
        "/proof/Looks/pairs/visits",
        "/proof/Looks/pairs/after",
        "/proof/Looks/looks/kinds",
        "/proof/Looks/looks/different",
        "/proof/Looks/looks/deceiving",
        "/proof/Looks/looks/followed",
        "/proof/Looks/looks/repeating",
        "/proof/Looks/chance",
    ];
    let all = of_all.into_iter().chain(of_bounds).chain(of_winding);
    let all = all.chain(of_looks);
    assert_eq!(found, all.map(ToString::to_string).collect());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// The seal tells that a certificate was changed, whichever field it was.
    #[test]
    fn no_changed_field_is_overlooked(walked in any_walk(), which in any::<prop::sample::Index>(), any in any::<u64>()) {
        prop_assume!(!walked.certificates.is_empty());
        let number = which.index(walked.certificates.len());
        for wrong in changed(&walked.certificates[number], any) {
            let found = walked.verify_with(number, wrong.clone());
            prop_assert_eq!(found, Err(MergeCertificateError::Changed { number }), "{:?}", wrong);
        }
    }

    /// A forger seals again what he changed. Then the checker refuses it, or it is true all the
    /// same, by another way through the journal.
    #[test]
    fn a_forged_field_is_refused_or_true(walked in any_walk(), which in any::<prop::sample::Index>(), any in any::<u64>()) {
        prop_assume!(!walked.certificates.is_empty());
        let number = which.index(walked.certificates.len());
        let certificate = &walked.certificates[number];
        prop_assert!(walked.is_true(number, certificate), "{:?}", certificate);
        // Numbers of visits, mostly.
        let any = any % (2 * MOVES as u64);
        for mut forged in changed(certificate, any) {
            forged.seal = forged.checksum();
            if forged == *certificate {
                continue; // The seal alone was changed.
            }
            let found = walked.verify_with(number, forged.clone());
            prop_assert!(found.is_err() || walked.is_true(number, &forged), "{:?}", forged);
            prop_assert!(found.is_err() || forged.rests_on_looks == certificate.rests_on_looks, "{:?}", forged);
            if let Err(error) = found {
                let named = format!("certificate {number} ");
                prop_assert!(error.to_string().starts_with(&named), "{}", error);
            }
        }
    }
}
