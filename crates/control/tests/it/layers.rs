//! Each layer by itself, on scans worked out by hand.

use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_control::{
    Avoid, Center, Corridor, CorridorDetector, Layer, Move, Orient, Outcome, Proposal, RingError,
    Situation, Stack, View, heading_of,
};
use tolman_geom::Heading;
use tolman_maze::Direction;
use tolman_robot::{Ring, Scan, TurnTranslate};

const UNIT: f64 = 0.5;
const WIDTH: f64 = 1.9 * UNIT;
const RING: fn() -> Ring = || Ring::full(72, 2.5 * UNIT);

/// Returns the ring's scan in an endless corridor along `axis`, looking to `heading`. The robot is
/// `left` metres from the wall to the left of the axis.
fn corridor_scan(axis: Heading, left: f64, heading: Heading) -> Scan {
    let mut scan = Scan::clear(RING());
    let ring = scan.ring;
    for (beam, range) in scan.ranges.iter_mut().enumerate() {
        let across = axis
            .turn_to(heading.turned(ring.bearing(beam as u32)))
            .sin();
        let side = if across > 0.0 { left } else { WIDTH - left };
        let wall = side / across.abs();
        *range = wall.min(ring.max_range);
    }
    scan
}

fn rng() -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(7)
}

fn corrected(
    layer: &mut dyn Layer,
    command: TurnTranslate,
    scan: &Scan,
    heading: Heading,
    corridor: Option<Corridor>,
) -> Proposal {
    let situation = Situation {
        view: View { scan, heading },
        corridor,
    };
    layer.correct(
        Proposal {
            command,
            ends: None,
        },
        &situation,
        &mut rng(),
    )
}

fn detector() -> CorridorDetector {
    CorridorDetector::new(RING(), WIDTH).unwrap()
}

fn seen(scan: &Scan, heading: Heading) -> Option<Corridor> {
    detector().detect(View { scan, heading })
}

mod detector {
    use super::*;

    proptest! {
        #[test]
        fn sees_a_corridor_and_its_axis_from_any_place_and_heading(
            left in 0.3..0.65_f64,
            heading in -180.0..180.0_f64,
        ) {
            let heading = Heading::from_degrees(heading);
            let seen = seen(&corridor_scan(Heading::NORTH, left, heading), heading).unwrap();
            // Turning by the misalignment faces along the corridor, to the nearest beam.
            let turned = heading.turned(f64::from(seen.misaligned_beams) * RING().spacing);
            let off = turned.turn_to(Heading::NORTH).abs();
            prop_assert!(off.min(core::f64::consts::PI - off) <= 0.51 * RING().spacing);
            prop_assert!(seen.narrowest >= WIDTH - 1e-9 && seen.narrowest < 1.01 * WIDTH);
        }
    }

    #[test]
    fn sees_none_in_the_open() {
        let (scan, heading) = (&Scan::clear(RING()), Heading::NORTH);
        // Also where a corridor is wider than the beams can see.
        for width in [WIDTH, 1.6, 5.0] {
            let detector = CorridorDetector::new(RING(), width).unwrap();
            assert_eq!(detector.detect(View { scan, heading }), None, "{width} m");
        }
    }

    #[test]
    fn a_run_may_cross_the_seam_of_the_circle() {
        // Near to the sums of pairs 30 … 35 and 0 … 7: fourteen in a row round the seam.
        let mut scan = Scan::clear(RING());
        for pair in (30..36).chain(0..8) {
            scan.ranges[pair] = 0.4;
            scan.ranges[pair + 36] = 0.4;
        }
        // The first of the seven in the middle is the narrowest: the axis lies across it.
        scan.ranges[0] = 0.3;
        assert!(seen(&scan, Heading::EAST).is_some());
        assert_eq!(
            seen(&scan, Heading::from_degrees(45.0)),
            None,
            "a diagonal is a bend"
        );
        scan.ranges[35] = 1.25;
        scan.ranges[71] = 1.25;
        assert_eq!(seen(&scan, Heading::EAST), None, "thirteen are too few");
    }

    #[test]
    fn other_rings_are_refused_with_a_reason() {
        for beams in [0, 4, 6, 10, 71, 74] {
            let refused = CorridorDetector::new(Ring::full(beams, 1.25), WIDTH);
            assert_eq!(refused, Err(RingError::Quarters { beams }));
        }
        let refused = |ring, width| CorridorDetector::new(ring, width).unwrap_err();
        let fan = refused(Ring::fan(72, 3.0, 1.25), WIDTH);
        assert!(matches!(fan, RingError::NotAFullCircle { .. }));
        for width in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
            assert!(matches!(refused(RING(), width), RingError::Width { .. }));
        }
    }
}

mod move_layer {
    use super::*;

    fn step(layer: &mut Move, heading: Heading) -> Proposal {
        let scan = Scan::clear(RING());
        corrected(layer, TurnTranslate::STOP, &scan, heading, None)
    }

    #[test]
    fn turns_in_proportion_to_the_error_then_translates_twice() {
        let mut layer = Move::paper();
        layer.begin(Direction::North);
        let turn = step(&mut layer, Heading::from_degrees(50.0));
        assert!((turn.command.turn - 0.0105 * 40.0).abs() < 1e-12 && turn.ends.is_none());
        let first = step(&mut layer, Heading::from_degrees(86.5));
        assert_eq!(
            first.command,
            TurnTranslate {
                turn: 0.0,
                translate: 0.25
            }
        );
        assert_eq!(first.ends, None);
        // The heading is not looked at again.
        let second = step(&mut layer, Heading::from_degrees(20.0));
        assert_eq!(
            second.command,
            TurnTranslate {
                turn: 0.0,
                translate: 0.25
            }
        );
        assert_eq!(second.ends, Some(Outcome::Completed));
    }

    #[test]
    fn backs_up_when_that_turns_less() {
        let mut layer = Move::paper();
        layer.begin(Direction::South);
        let step = step(&mut layer, Heading::from_degrees(88.0));
        assert_eq!(
            step.command,
            TurnTranslate {
                turn: 0.0,
                translate: -0.25
            }
        );
    }

    proptest! {
        #[test]
        fn never_asks_for_more_than_a_quarter_turn(heading in -180.0..180.0_f64) {
            for action in Direction::ALL {
                let mut layer = Move::paper();
                layer.begin(action);
                let step = step(&mut layer, Heading::from_degrees(heading));
                prop_assert!(step.command.turn.abs() <= 0.0105 * 90.0 + 1e-9);
            }
        }
    }
}

mod orient {
    use super::*;

    /// Returns the proposal that the layers make of `action` in a corridor along north, from a
    /// heading `offset_deg` off its axis.
    fn outcome(action: Direction, offset_deg: f64) -> Proposal {
        let heading = Heading::from_degrees(90.0 + offset_deg);
        let scan = corridor_scan(Heading::NORTH, 0.5 * WIDTH, heading);
        let corridor = seen(&scan, heading);
        let mut top = Move::paper();
        top.begin(action);
        let proposed = corrected(&mut top, TurnTranslate::STOP, &scan, heading, corridor);
        corrected(
            &mut Orient::paper(72, WIDTH),
            proposed.command,
            &scan,
            heading,
            corridor,
        )
    }

    #[test]
    fn an_action_along_the_corridor_never_contradicts() {
        for offset in -90..=90 {
            for action in [Direction::North, Direction::South] {
                let ends = outcome(action, f64::from(offset)).ends;
                assert_ne!(ends, Some(Outcome::Failed), "{action} from {offset}°");
            }
        }
    }

    #[test]
    fn an_action_across_the_corridor_fails_at_once_unless_the_robot_already_faces_the_wall() {
        // 86° is Move's tolerance itself, where rounding decides.
        for offset in (-90..=90_i32).filter(|offset| offset.abs() != 86) {
            for action in [Direction::East, Direction::West] {
                let proposal = outcome(action, f64::from(offset));
                let failed = proposal.ends == Some(Outcome::Failed);
                // Within Move's tolerance of the wall there is nothing to turn and so nothing to
                // contradict: it translates, which is Avoid's business.
                assert_eq!(failed, offset.abs() < 86, "{action} from {offset}°");
                if failed {
                    assert!(proposal.command.translate.abs() < 1e-12);
                    let towards_axis = -f64::from(offset.signum());
                    assert!(
                        proposal.command.turn * towards_axis >= 0.0,
                        "the failing step turns to the axis, {offset}°"
                    );
                }
            }
        }
    }

    #[test]
    fn adds_its_turn_to_that_of_move() {
        let proposal = outcome(Direction::North, 20.0);
        let expected = -20.0 * 0.0105 - 4.0 * 0.04;
        assert!(
            (proposal.command.turn - expected).abs() < 1e-9,
            "{proposal:?}"
        );
    }

    #[test]
    fn nudges_out_of_a_corner() {
        let corridor = Some(Corridor {
            misaligned_beams: 5,
            narrowest: 0.5 * WIDTH,
        });
        let scan = Scan::clear(RING());
        let mut layer = Orient::paper(72, WIDTH);
        let still = corrected(
            &mut layer,
            TurnTranslate::STOP,
            &scan,
            Heading::NORTH,
            corridor,
        );
        assert!(still.command.translate != 0.0 && still.command.translate.abs() <= 0.1);
        assert!(still.command.turn.abs() < 1e-12);
    }

    #[test]
    fn rests_outside_corridors() {
        let scan = Scan::clear(RING());
        let command = TurnTranslate {
            turn: 0.4,
            translate: 0.0,
        };
        let mut layer = Orient::paper(72, WIDTH);
        assert_eq!(
            corrected(&mut layer, command, &scan, Heading::NORTH, None).command,
            command
        );
    }
}

mod center {
    use super::*;

    #[test]
    fn steers_to_the_middle_forward_and_backward() {
        let axis = Heading::NORTH;
        // (metres to the left wall, translation, expected sign of the turn)
        for (left, translate, sign) in [
            (0.3, 0.25, -1.0),
            (0.65, 0.25, 1.0),
            (0.3, -0.25, 1.0),
            (0.65, -0.25, -1.0),
            (0.475, 0.25, 0.0),
            (0.3, 0.0, 0.0),
        ] {
            let scan = corridor_scan(axis, left, axis);
            let command = TurnTranslate {
                turn: 0.0,
                translate,
            };
            let corridor = seen(&scan, axis);
            let got = corrected(&mut Center::paper(), command, &scan, axis, corridor);
            assert!(
                (got.command.turn - 0.05 * sign).abs() < 1e-12,
                "{left} m, {translate}"
            );
        }
    }
}

mod avoid {
    use super::*;

    fn ahead(ranges: &[(usize, f64)], translate: f64, layer: &mut Avoid) -> Proposal {
        let mut scan = Scan::clear(RING());
        for &(beam, range) in ranges {
            scan.ranges[beam] = range;
        }
        let command = TurnTranslate {
            turn: 0.0,
            translate,
        };
        corrected(layer, command, &scan, Heading::NORTH, None)
    }

    #[test]
    fn a_wall_in_front_fails_the_action_before_the_first_step_and_cuts_it_short_after() {
        let mut layer = Avoid::paper(72, UNIT);
        layer.begin(Direction::North);
        let blocked = ahead(&[(71, 0.44)], 0.25, &mut layer);
        assert_eq!(
            (blocked.command.translate, blocked.ends),
            (0.0, Some(Outcome::Failed))
        );
        layer.begin(Direction::North);
        assert_eq!(ahead(&[], 0.25, &mut layer).ends, None);
        assert_eq!(
            ahead(&[(1, 0.44)], 0.25, &mut layer).ends,
            Some(Outcome::CutShort)
        );
    }

    #[test]
    fn looks_the_way_it_travels() {
        let wall_ahead = [(0, 0.3)];
        let mut layer = Avoid::paper(72, UNIT);
        assert_eq!(ahead(&wall_ahead, -0.25, &mut layer).ends, None);
        let back = ahead(&[(36, 0.3)], -0.25, &mut layer).ends;
        assert_eq!(back, Some(Outcome::CutShort), "a step back was made");
        let front = ahead(&wall_ahead, 0.25, &mut layer).ends;
        assert_eq!(front, Some(Outcome::Failed), "a step ahead was not");
    }

    #[test]
    fn edges_away_from_a_wall_beside_and_fails_only_far_below_the_buffer() {
        let mut layer = Avoid::paper(72, UNIT);
        assert!(
            ahead(&[(3, 0.4)], 0.25, &mut layer).command.turn < 0.0,
            "wall on the left"
        );
        assert!(
            ahead(&[(69, 0.4)], 0.25, &mut layer).command.turn > 0.0,
            "wall on the right"
        );
        assert!(
            ahead(&[(33, 0.4)], -0.25, &mut layer).command.turn > 0.0,
            "right of the tail"
        );
        layer.begin(Direction::North);
        assert_eq!(
            ahead(&[(5, 0.2)], 0.25, &mut layer).ends,
            Some(Outcome::Failed)
        );
        assert_eq!(
            ahead(&[(6, 0.2)], 0.25, &mut layer).ends,
            None,
            "the sixth is not watched"
        );
    }

    #[test]
    fn rests_while_the_robot_turns() {
        let mut layer = Avoid::paper(72, UNIT);
        assert_eq!(ahead(&[(0, 0.1)], 0.0, &mut layer), Proposal::default());
    }
}

mod stack {
    use super::*;

    #[test]
    fn a_view_that_cannot_be_read_fails_the_action_at_rest() {
        let mut stack = Stack::paper(RING(), UNIT, WIDTH).unwrap();
        let clear = Scan::clear(RING());
        let mut holed = clear.clone();
        holed.ranges[0] = f64::NAN;
        let mut short = clear.clone();
        short.ranges.pop();
        let unreadable = [
            (Scan::clear(Ring::full(36, 1.25)), Heading::NORTH),
            (Scan::clear(Ring::fan(72, 3.0, 1.25)), Heading::NORTH),
            (short, Heading::NORTH),
            (holed, Heading::NORTH),
            (clear, Heading::from_radians(f64::NAN)),
        ];
        for (scan, heading) in &unreadable {
            stack.begin(Direction::North);
            let view = View {
                scan,
                heading: *heading,
            };
            let proposal = stack.correct(view, &mut rng());
            assert_eq!(proposal.ends, Some(Outcome::Failed));
            assert_eq!(proposal.command, TurnTranslate::STOP);
        }
    }

    #[test]
    fn lengths_that_are_none_are_refused() {
        for robot_unit in [f64::NAN, 0.0, -0.5, f64::INFINITY] {
            assert!(matches!(
                Stack::paper(RING(), robot_unit, WIDTH),
                Err(RingError::RobotUnit { .. })
            ));
        }
    }

    #[test]
    fn directions_are_headings() {
        assert_eq!(heading_of(Direction::East), Heading::EAST);
        assert_eq!(heading_of(Direction::West), Heading::WEST);
    }
}

/// A layer may be handed any scan when it is used without the stack.
#[test]
fn no_layer_minds_a_scan_without_beams_or_of_another_ring() {
    for beams in [0, 1, 2, 3, 5, 8, 181] {
        let scan = Scan::clear(Ring::full(beams, 1.25));
        let corridor = Some(Corridor {
            misaligned_beams: 1,
            narrowest: WIDTH,
        });
        let layers: [&mut dyn Layer; 4] = [
            &mut Move::paper(),
            &mut Orient::paper(72, WIDTH),
            &mut Center::paper(),
            &mut Avoid::paper(72, UNIT),
        ];
        for layer in layers {
            layer.begin(Direction::North);
            for translate in [-0.25, 0.25] {
                let command = TurnTranslate {
                    turn: 0.0,
                    translate,
                };
                let got = corrected(layer, command, &scan, Heading::NORTH, corridor);
                assert!(got.command.turn.is_finite() && got.command.translate.is_finite());
            }
        }
    }
}
