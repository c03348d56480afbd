//! Certificates of merges hold in every world, and none holds that was changed.

use super::abstract_world::{AbstractWorld, MoveNoise};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_maps::diktiometry::{
    Action, Apart, CertifiedMerges, Config, JournalLength, JournalSpan, MergeCertificate,
    MergeCertificateError, MergeProof, Use, WorldKind, certify_merges, verify_merges,
};
use tolman_maze::Maze;
use tolman_maze::drawings::{ladder_of, ring, spiral};

use super::walk::{ODOMETRY, Walk, alike, blocks, braided, painted, rooms};

/// Returns a walk through blocks where nothing changes, and what is proven of its map.
pub(super) fn walked(config: Config, seed: u64) -> (Walk, CertifiedMerges) {
    let maze = blocks(5, 0.25, &mut ChaCha8Rng::seed_from_u64(seed));
    certified(
        AbstractWorld::from_maze(&maze, 1.0),
        ODOMETRY,
        300,
        config,
        seed,
    )
}

fn certified(
    world: AbstractWorld,
    errors: MoveNoise,
    moves: usize,
    mut config: Config,
    seed: u64,
) -> (Walk, CertifiedMerges) {
    config.journal = JournalLength::All;
    config.world = WorldKind::Static;
    config.apart = Apart::Side;
    let mut walk = Walk::new(world, errors, config, seed);
    walk.heed(0.3, moves);
    let journal = walk.observer.journal().unwrap();
    let told = certify_merges(walk.observer.config(), journal).unwrap();
    (walk, told)
}

fn verified(walk: &Walk, certificates: &[MergeCertificate]) -> Result<(), MergeCertificateError> {
    let journal = walk.observer.journal().unwrap();
    verify_merges(walk.observer.config(), journal, certificates)
}

fn assert_true(walk: &Walk, told: &CertifiedMerges) {
    for certificate in &told.certificates {
        let [one, other] = certificate.visits.map(|visit| walk.log[visit].0);
        assert_eq!(one, other, "{certificate:?}");
    }
}

fn corridors() -> Config {
    let mut config = alike();
    config.actions = Config::corridor_actions();
    config
}

#[test]
fn merges_are_proven_and_what_is_proven_is_true() {
    let mut proven = 0;
    for seed in 0..6 {
        let (walk, told) = walked(corridors(), seed);
        assert_eq!(verified(&walk, &told.certificates), Ok(()));
        assert_true(&walk, &told);
        assert_eq!(told.unproven, [[0; 2]; 0], "seed {seed}");
        proven += told.certificates.len();
    }
    assert!(proven > 30, "{proven}");
}

/// Returns a walk through the corridors of a drawing, where everything looks alike.
fn wound(drawing: &Maze, seed: u64) -> (Walk, CertifiedMerges) {
    let mut config = corridors();
    config.restructuring.winding_merge = Use::On;
    let world = AbstractWorld::from_corridors(drawing, 1.0);
    certified(world, ODOMETRY, 200, config, seed)
}

#[test]
fn a_ring_is_proven_by_its_turns() {
    let mut proven = 0;
    // In 46 a corner merges, leaves again and merges again.
    for seed in 0..48 {
        let size = 6 + seed as u16 % 24;
        let ring = ring((size, size), &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
        let (walk, told) = wound(&ring, seed);
        assert_eq!(walk.observer.map().paths.places().count(), 4, "seed {seed}");
        assert_eq!(verified(&walk, &told.certificates), Ok(()));
        assert_eq!(told.unproven, [[0; 2]; 0], "seed {seed}");
        assert_true(&walk, &told);
        for certificate in &told.certificates {
            let by_turns = matches!(certificate.proof, MergeProof::Winding(_));
            proven += usize::from(by_turns && !certificate.rests_on_looks);
        }
    }
    assert!(proven >= 24, "{proven}");
}

/// Returns a walk through long painted corridors, or through rooms that are furnished alike.
fn looked(seed: u64) -> (Walk, CertifiedMerges) {
    let mut config = painted();
    config.actions = Config::corridor_actions();
    config.restructuring.look_merge = Use::On;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let world = match seed % 4 {
        0 => AbstractWorld::from_corridors(&blocks(7, 0.25, &mut rng), 1.0).painted(5, seed),
        1 => AbstractWorld::from_corridors(&ladder_of(11, &mut rng).unwrap(), 1.0).painted(8, seed),
        2 => AbstractWorld::from_corridors(&braided(8, 0.6, &mut rng), 1.0).painted(4, seed),
        _ => rooms(9, 3, 8, seed),
    };
    let mut errors = ODOMETRY;
    errors.distance = 0.4;
    errors.look = 0.15;
    certified(world, errors, 600, config, seed)
}

/// Returns the number of merges by looks in worlds of these seeds, the number of false ones, and
/// the number of false ones to expect from their stated chances. No other merge may be false.
#[expect(clippy::print_stdout, reason = "the figures of a long run")]
fn looks_of(seeds: core::ops::Range<u64>) -> (usize, usize, f64) {
    let (mut all, mut wrong, mut expected) = (0, 0, 0.0);
    let mut by_bounds = 0;
    for seed in seeds {
        let (walk, told) = looked(seed);
        assert_eq!(verified(&walk, &told.certificates), Ok(()), "seed {seed}");
        for certificate in &told.certificates {
            let [one, other] = certificate.visits.map(|visit| walk.log[visit].0);
            if let MergeProof::Looks(evidence) = &certificate.proof {
                all += 1;
                wrong += usize::from(one != other);
                expected += evidence.chance;
            } else if !certificate.rests_on_looks {
                by_bounds += 1;
                assert_eq!(one, other, "seed {seed}: {certificate:?}");
            }
        }
    }
    println!("{by_bounds} merges by bounds; {wrong} of {all} by looks false, expected {expected}");
    (all, wrong, expected)
}

#[test]
fn looks_err_as_seldom_as_they_state() {
    let (all, wrong, expected) = looks_of(0..24);
    assert!(
        all > 30 && wrong == 0,
        "{wrong} of {all}, expected {expected}"
    );
}

#[test]
#[ignore = "takes minutes: cargo test -p tolman-maps --all-features --test it -- --ignored looks_err"]
fn looks_err_as_seldom_as_they_state_ten_thousand_times() {
    let (all, wrong, expected) = looks_of(100..4300);
    assert!(all >= 10_000, "{all}");
    assert!(
        wrong as f64 <= 3.0 * expected,
        "{wrong} of {all}, expected {expected}"
    );
}

#[test]
fn a_spiral_is_no_ring() {
    for seed in 0..8 {
        let size = 6 + seed as u16;
        let spiral = spiral((size, size), &mut ChaCha8Rng::seed_from_u64(seed)).unwrap();
        let (walk, told) = wound(&spiral, seed);
        assert_true(&walk, &told);
    }
}

#[test]
fn a_proof_does_not_hold_under_other_assumptions() {
    let (walk, told) = walked(corridors(), 0);
    let mut config = walk.observer.config().clone();
    config.separation = 0.2;
    config.alike_separation = 0.2;
    let journal = walk.observer.journal().unwrap();
    let found = verify_merges(&config, journal, &told.certificates);
    assert!(
        matches!(found, Err(MergeCertificateError::TooWide { .. })),
        "{found:?}"
    );
    // The first is proven from the journal alone; the last rests on others.
    assert_eq!(verified(&walk, &told.certificates[..1]), Ok(()));
    let last = told.certificates.last().unwrap();
    let alone = verified(&walk, core::slice::from_ref(last));
    assert!(alone.is_err(), "{last:?}");
}

/// Returns all certificates that differ from one in a number.
fn changed(certificate: &MergeCertificate, by: usize) -> Vec<MergeCertificate> {
    let mut all = Vec::new();
    let mut push = |change: &dyn Fn(&mut MergeCertificate)| {
        let mut other = certificate.clone();
        change(&mut other);
        all.push(other);
    };
    push(&|one| one.visits[0] += by);
    push(&|one| one.visits[1] += by);
    push(&|one| one.rests_on_looks = !one.rests_on_looks);
    push(&|one| one.seal = one.seal.wrapping_add(by as u64));
    let routes = match &certificate.proof {
        MergeProof::Bounds(routes) => routes.as_slice(),
        MergeProof::Winding(_) | MergeProof::Looks(_) => &[],
    };
    for (number, route) in routes.iter().enumerate() {
        for at in 0..route.len() {
            let change = |change: fn(&mut JournalSpan, usize)| {
                move |one: &mut MergeCertificate| {
                    if let MergeProof::Bounds(routes) = &mut one.proof {
                        change(&mut routes[number][at], by);
                    }
                }
            };
            push(&change(|span, by| span.begin += by));
            push(&change(|span, by| span.end += by));
            push(&change(|span, _| {
                core::mem::swap(&mut span.begin, &mut span.end);
            }));
        }
        push(&|one| {
            if let MergeProof::Bounds(routes) = &mut one.proof {
                routes.remove(number);
            }
        });
    }
    push(&|one| {
        if let MergeProof::Looks(evidence) = &mut one.proof {
            evidence.chance *= 0.5;
        } else {
            one.visits.swap(0, 1);
        }
    });
    push(&|one| {
        if let MergeProof::Looks(evidence) = &mut one.proof {
            evidence.looks.deceiving = evidence.looks.deceiving.wrapping_sub(1);
        } else {
            one.visits = [one.visits[1]; 2];
        }
    });
    push(&|one| {
        if let MergeProof::Looks(evidence) = &mut one.proof {
            evidence.pairs[0].after = Some((0, Action(0)));
        } else {
            one.proof = MergeProof::Bounds(Vec::new());
        }
    });
    all
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn no_certificate_holds_that_was_changed(seed in 0_u64..1000, which in any::<prop::sample::Index>(), by in 1_usize..400) {
        let mut config = if seed % 2 == 0 { alike() } else { painted() };
        config.actions = Config::corridor_actions();
        let (walk, told) = walked(config, seed);
        prop_assert_eq!(verified(&walk, &told.certificates), Ok(()));
        prop_assume!(!told.certificates.is_empty());
        let number = which.index(told.certificates.len());
        for wrong in changed(&told.certificates[number], by) {
            let mut certificates = told.certificates.clone();
            certificates[number] = wrong;
            let found = verified(&walk, &certificates);
            prop_assert!(found.is_err(), "{:?}", certificates[number]);
        }
    }
}
