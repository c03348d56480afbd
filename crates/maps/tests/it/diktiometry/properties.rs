//! Properties of every observer, whatever the robot does and whatever becomes of the advice.

use proptest::prelude::*;
use tolman_geom::{Interval, Point, PointBox, PoseBox};
use tolman_maps::diktiometry::{
    Action, Config, Exits, FirstPlace, GeometricIndexing, GeometricMerge, Identity, JournalLength,
    MoveOutcome, ObservedMove, ObservedMoveError, Observer, Percepts, PerceptualIndexing,
    Precedence, Signature, SignatureKind, Use, ViewRotation,
};

use super::walk::{ODOMETRY, Walk, open};

const ACTIONS: u32 = 4;

/// Returns a configuration whose choices are the bits of a number.
pub(super) fn config(seed: u32) -> Config {
    let mut config = Config::new(Config::compass_actions(), 1.0);
    let bit = |number: u32| seed >> number & 1 == 1;
    if bit(0) {
        config.matching.identity = Identity::Meets;
    }
    if bit(1) {
        config.matching.order = Precedence::Static;
    }
    config.indexing.geometric = match seed >> 2 & 3 {
        0 => GeometricIndexing::Off,
        1 => GeometricIndexing::ActiveFrames,
        _ => GeometricIndexing::Search,
    };
    config.restructuring.geometric_merge = match seed >> 4 & 3 {
        0 => GeometricMerge::Off,
        1 => GeometricMerge::Estims,
        _ => GeometricMerge::Narrow,
    };
    if bit(6) {
        config.frame_half_width = 0.4;
    }
    if bit(7) {
        config.percepts = Percepts::Signatures(SignatureKind {
            rows: 1,
            columns: 4,
            tolerance: 0.5,
            share: 0.6,
            rotation: ViewRotation::Free,
            views: 2,
        });
    }
    if bit(8) {
        config.indexing.expectational = Use::Off;
    }
    if bit(9) {
        config.matching.continuation = Use::Off;
    }
    if bit(10) {
        config.matching.link = Use::Off;
    }
    if bit(11) {
        config.indexing.perceptual = PerceptualIndexing::Triangles;
    }
    if bit(12) {
        config.restructuring.look_merge = Use::On;
        config.restructuring.look_error = 0.9;
    }
    // Restructurers that act on little evidence act more often.
    config.restructuring.visits = 1;
    config.restructuring.weight = 1.0;
    config.transients.rate = 0.9;
    config.transients.fading = 0.7;
    config.journal = JournalLength::All;
    config
}

/// Returns a move of a robot that says what it likes.
fn any_move() -> impl Strategy<Value = ObservedMove> {
    let coordinate = prop_oneof![6 => (-2_i32..=2).prop_map(f64::from), 1 => -3.0..3.0, 1 => Just(1e300), 1 => Just(-1e-300)];
    (
        0..ACTIONS,
        coordinate.clone(),
        coordinate,
        prop_oneof![Just(0.0), Just(0.1), 0.0..2.0, Just(1e300)],
        prop::collection::vec(prop_oneof![Just(0.0), Just(1.0), -1e300..1e300], 4),
        prop::option::of(prop::collection::vec(0..ACTIONS, 0..4)),
        prop::bool::weighted(0.1),
    )
        .prop_map(
            |(action, x, y, margin, look, exits, blocked)| ObservedMove {
                action: Action(action),
                odometry: PoseBox::new(
                    PointBox::about(Point::new(x, y), margin).unwrap(),
                    Interval::ZERO,
                ),
                percept: Some(Signature::new(1, look).unwrap()),
                exits: exits.map_or(Exits::Unknown, |exits| {
                    Exits::Seen(exits.into_iter().map(Action).collect())
                }),
                outcome: if blocked {
                    MoveOutcome::Blocked
                } else {
                    MoveOutcome::Arrived
                },
            },
        )
}

pub(super) fn observer_and_moves(
    config: &Config,
    mut moves: Vec<ObservedMove>,
) -> (Observer, Vec<ObservedMove>) {
    let sees = config.percepts != Percepts::None;
    if !sees {
        for step in &mut moves {
            step.percept = None;
        }
    }
    let percept = sees.then(|| Signature::new(1, vec![0.0; 4]).unwrap());
    let start = FirstPlace {
        percept,
        exits: Exits::Unknown,
    };
    (Observer::new(config.clone(), start).unwrap(), moves)
}

/// A place where a track stands is not elided, also if it got its name by a merge in the same move.
#[test]
fn the_place_of_a_track_stays_when_it_merges() {
    let about = |x, y, margin| PointBox::about(Point::new(x, y), margin).unwrap();
    let moves = [
        (3, about(1.0, -1e-300, 0.0), Exits::Unknown),
        (0, about(-1.0, 0.0, 0.1), Exits::Seen(Vec::new())),
        (3, about(1.17, 0.0, 0.84), Exits::Unknown),
    ];
    let moves = moves.map(|(action, moved, exits)| ObservedMove {
        action: Action(action),
        odometry: PoseBox::new(moved, Interval::ZERO),
        percept: Some(Signature::new(1, vec![0.0; 4]).unwrap()),
        exits,
        outcome: MoveOutcome::Arrived,
    });
    let (mut observer, moves) = observer_and_moves(&config(1_856_336_660), moves.into());
    for step in moves {
        observer.step(&step).unwrap();
        for track in observer.tracks() {
            assert_eq!(observer.map().paths.resolve(track.place), Some(track.place));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// No input breaks the observer. After every move the two graphs keep their promises, and a
    /// best track is at a place.
    #[test]
    fn nothing_breaks_it(seed in any::<u32>(), moves in prop::collection::vec(any_move(), 0..60)) {
        let config = config(seed);
        let (mut observer, moves) = observer_and_moves(&config, moves);
        for step in moves {
            let report = observer.step(&step).unwrap();
            prop_assert_eq!(observer.map().check(ACTIONS as usize), None);
            prop_assert_eq!(report.tracks.len(), observer.tracks().len());
            prop_assert!(!observer.tracks().is_empty());
            prop_assert!(observer.tracks().len() <= config.tracks.cap);
            for track in observer.tracks() {
                prop_assert_eq!(observer.map().paths.resolve(track.place), Some(track.place));
                prop_assert!((0.0..=1.0).contains(&track.confidence));
                for action in 0..ACTIONS {
                    let predicted = observer.predict(track.place, Action(action));
                    let sum: f64 = predicted.iter().map(|one| one.probability).sum();
                    prop_assert!(predicted.is_empty() || (sum - 1.0).abs() < 1e-9);
                }
            }
            for advice in observer.opportunities() {
                prop_assert!(!advice.script.is_empty());
                prop_assert!(advice.script.iter().all(|action| action.0 < ACTIONS));
            }
            if let Some((last, _)) = observer.map().paths.places().last()
                && let Some(plan) = observer.plan(observer.place(), last)
            {
                let end = plan.last().map_or(observer.place(), |step| step.to);
                prop_assert_eq!(end, last);
            }
        }
    }

    /// What is undone never was, to the bit; and the same moves lead to the same map.
    #[test]
    fn undo_restores_every_bit(
        seed in any::<u32>(),
        moves in prop::collection::vec(any_move(), 1..150),
        kept in 0.0..1.0_f64,
    ) {
        let config = config(seed);
        let (mut observer, moves) = observer_and_moves(&config, moves);
        let kept = (kept * moves.len() as f64) as usize;
        let mut before = observer.clone();
        for (number, step) in moves.iter().enumerate() {
            observer.step(step).unwrap();
            if number + 1 == kept {
                before = observer.clone();
            }
        }
        let again = Observer::replay(config, observer.journal().unwrap()).unwrap();
        prop_assert_eq!(format!("{:?}", again.map()), format!("{:?}", observer.map()));
        prop_assert_eq!(&again, &observer);
        observer.undo((moves.len() - kept) as u64).unwrap();
        prop_assert_eq!(format!("{:?}", before.map()), format!("{:?}", observer.map()));
        prop_assert_eq!(&before, &observer);
    }

    /// A move that is refused changes nothing.
    #[test]
    fn bad_moves_change_nothing(seed in any::<u32>(), moves in prop::collection::vec(any_move(), 1..30)) {
        let config = config(seed);
        let (mut observer, moves) = observer_and_moves(&config, moves);
        for step in &moves {
            observer.step(step).unwrap();
        }
        let before = observer.clone();
        let step = &moves[0];
        let unbounded = PoseBox::new(PointBox::new(Interval::UNBOUNDED, Interval::ZERO), Interval::ZERO);
        let bad = [
            ObservedMove { action: Action(ACTIONS), ..step.clone() },
            ObservedMove { odometry: unbounded, ..step.clone() },
            ObservedMove { percept: Some(Signature::new(2, vec![0.0; 6]).unwrap()), ..step.clone() },
            ObservedMove { exits: Exits::Seen(vec![Action(9)]), ..step.clone() },
        ];
        for (number, bad) in bad.iter().enumerate() {
            let error = observer.step(bad).unwrap_err();
            let named = match error {
                ObservedMoveError::UnknownAction { .. } => 0,
                ObservedMoveError::Unbounded { .. } => 1,
                ObservedMoveError::PerceptSize { .. } => 2,
                ObservedMoveError::UnknownExit { .. } => 3,
                _ => 4,
            };
            prop_assert_eq!(named, number);
            prop_assert_eq!(&observer, &before);
        }
    }

    /// While the bounds hold, no place is confused with another, and every relation contains the
    /// truth. That is so whether the robot follows the advice, ignores it, or follows some of it.
    #[test]
    fn relations_hold_the_truth(seed in any::<u64>(), obedience in 0_u32..=4, stop in 0_u32..2) {
        let mut config = Config::new(Config::compass_actions(), 1.0);
        let mut errors = ODOMETRY;
        errors.stop = 0.02 * f64::from(stop);
        config.place_radius = errors.stop;
        let mut walk = Walk::new(open(4), errors, config, seed);
        walk.heed(0.25 * f64::from(obedience), 200);
        let score = walk.score();
        prop_assert!(score.purity > 1.0 - 1e-12);
        let truths = walk.truths();
        for (place, truth) in &truths {
            let at = walk.observer.map().paths.place(*place).unwrap();
            for relation in walk.observer.map().reference.relations(at.frame) {
                let others = walk.observer.map().paths.places();
                for (other, _) in others.filter(|(_, other)| other.frame == relation.to) {
                    let points = walk.robot.world().places();
                    let way = points[truths[&other] as usize] - points[*truth as usize];
                    prop_assert!(relation.position.contains(way.into()));
                }
            }
        }
    }
}

#[test]
fn numbers_that_bound_nothing_make_no_move() {
    assert!(Interval::new(f64::NAN, 1.0).is_err());
    assert!(Interval::new(1.0, 0.0).is_err());
    assert!(Signature::new(1, vec![f64::NAN]).is_err());
    assert!(Signature::new(2, vec![0.0; 3]).is_err());
    assert!(Signature::new(0, Vec::new()).is_err());
}

#[test]
fn configurations_out_of_range_make_no_observer() {
    let good = || Config::new(Config::compass_actions(), 1.0);
    let spoiled: [fn(&mut Config); 6] = [
        |config| config.separation = f64::NAN,
        |config| config.separation = 0.0,
        |config| config.alike_separation = 0.5,
        |config| config.shared_scale = 1.0,
        |config| config.tracks.cap = 0,
        |config| config.actions[0].reverse = Some(Action(7)),
    ];
    for (number, spoil) in spoiled.iter().enumerate() {
        let mut config = good();
        spoil(&mut config);
        assert!(
            Observer::new(config, FirstPlace::default()).is_err(),
            "{number}"
        );
    }
    assert!(Observer::new(good(), FirstPlace::default()).is_ok());
}

#[test]
fn a_merge_is_taken_back() {
    let mut config = Config::new(Config::compass_actions(), 1.0);
    config.journal = JournalLength::All;
    let mut walk = Walk::new(open(5), ODOMETRY, config, 3);
    let mut merged = None;
    while merged.is_none() {
        let direction = walk.robot.wander().unwrap();
        let (_, report) = walk.go(direction);
        merged = report
            .restructured
            .into_iter()
            .find_map(|change| match change {
                tolman_maps::diktiometry::Restructured::Merged { kept, merged, .. } => {
                    Some((kept, merged))
                }
                _ => None,
            });
    }
    let (kept, lost) = merged.unwrap();
    assert_eq!(
        walk.observer.map().paths.resolve(lost),
        walk.observer.map().paths.resolve(kept)
    );
    walk.observer.tell_apart(kept, lost).unwrap();
    let paths = &walk.observer.map().paths;
    assert_ne!(paths.resolve(lost), paths.resolve(kept));
    assert_eq!(walk.observer.map().check(4), None);
}
