//! Intervals and boxes: sound on random points, tight against mpmath.

#![expect(
    clippy::unwrap_used,
    reason = "a test that cannot set itself up has failed"
)]

use core::f64::consts::{PI, TAU};

use proptest::prelude::*;
use tolman_geom::{Heading, Interval, IntervalError, Point, PointBox, Pose, PoseBox};

/// Worked out by data/intervals.py: operation, operands, tightest result.
type Case = (String, f64, f64, f64, f64, f64, f64);

fn interval(low: f64, high: f64) -> Interval {
    Interval::new(low, high).unwrap()
}

/// Returns the number of steps, from one double to the next, that lead from `a` to `b`.
fn steps(a: f64, b: f64) -> u64 {
    let ordered = |value: f64| {
        let bits = value.to_bits().cast_signed();
        if bits < 0 { i64::MIN - bits } else { bits }
    };
    ordered(a).abs_diff(ordered(b))
}

#[test]
fn results_are_the_tightest_or_little_wider() {
    let cases: Vec<Case> = serde_json::from_str(include_str!("data/intervals.json")).unwrap();
    assert!(cases.len() > 1000);
    for case in cases {
        let (operation, a, b) = (&*case.0, interval(case.1, case.2), interval(case.3, case.4));
        let tightest = interval(case.5, case.6);
        // How far a bound may lie outside the tightest: in doubles, and absolutely.
        let (result, doubles, absolute) = match operation {
            "add" => (a + b, 0, 0.0),
            "sub" => (a - b, 0, 0.0),
            "mul" => (a * b, 1, 0.0),
            "div" => (a.checked_div(b).unwrap(), 1, 0.0),
            "sqrt" => (a.sqrt().unwrap(), 1, 0.0),
            "sin" => (a.sin(), 8, 1e-18),
            "cos" => (a.cos(), 8, 1e-18),
            other => panic!("{other}"),
        };
        assert!(result.encloses(tightest), "{case:?}: {result:?}");
        for (ours, best) in [
            (result.low(), tightest.low()),
            (result.high(), tightest.high()),
        ] {
            assert!(
                steps(ours, best) <= doubles || (ours - best).abs() <= absolute,
                "{case:?}: {result:?}"
            );
        }
    }
}

fn any() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0,
        1 => any_finite(),
        1 => prop::sample::select(vec![
            0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, -5e-324,
        ]),
    ]
}

fn any_finite() -> impl Strategy<Value = f64> {
    prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL
}

prop_compose! {
    /// Returns an interval, two numbers of it, and an interval inside it.
    fn nested()(mut of in [any(), any(), any(), any()]) -> (Interval, f64, Interval) {
        of.sort_by(f64::total_cmp);
        (interval(of[0], of[3]), of[1], interval(of[1], of[2]))
    }
}

/// Returns whether `result` holds the exact value, which lies within a rounding of the computed
/// one.
fn holds(result: Interval, rounded: f64) -> bool {
    result.low() <= rounded.next_up() && rounded.next_down() <= result.high()
}

proptest! {
    #[test]
    fn arithmetic_is_sound_and_monotone((a, x, a_in) in nested(), (b, y, b_in) in nested()) {
        prop_assert!(holds(a + b, x + y));
        prop_assert!((a + b).encloses(a_in + b_in));
        prop_assert!(holds(a - b, x - y));
        prop_assert!((a - b).encloses(a_in - b_in));
        prop_assert!(holds(a * b, x * y));
        prop_assert!((a * b).encloses(a_in * b_in));
        prop_assert!(holds(a.squared(), x * x));
        prop_assert!(a.squared().encloses(a_in.squared()));
        prop_assert!((a * a).encloses(a.squared()));
        prop_assert_eq!(a.abs().contains(x.abs()), true);
        match (a.checked_div(b), a_in.checked_div(b_in)) {
            (Some(all), Some(part)) => prop_assert!(all.encloses(part), "{:?} {:?}", all, part),
            (None, part) => prop_assert_eq!(part, None),
            (Some(_), None) => prop_assert!(b_in.low() == 0.0 && b_in.high() == 0.0),
        }
        if y != 0.0 {
            prop_assert!(holds(a.checked_div(b).unwrap(), x / y));
        }
        match (a.sqrt(), a_in.sqrt()) {
            (Some(all), Some(part)) => prop_assert!(all.encloses(part)),
            (None, part) => prop_assert_eq!(part, None),
            (Some(_), None) => prop_assert!(a_in.high() < 0.0),
        }
        if x >= 0.0 {
            prop_assert!(holds(a.sqrt().unwrap(), x.sqrt()));
        }
    }

    #[test]
    fn sets_behave_as_sets((a, x, a_in) in nested(), (b, y, _) in nested()) {
        prop_assert!(a.hull(b).contains(x) && a.hull(b).contains(y));
        prop_assert!(a.encloses(a_in) && a.contains(a.middle()));
        match a.intersection(b) {
            Some(both) => {
                prop_assert!(a.encloses(both) && b.encloses(both) && a.meets(b));
                prop_assert!(a.gap(b) <= 0.0);
                prop_assert_eq!(b.contains(x), both.contains(x));
            }
            None => {
                prop_assert!(!a.meets(b) && !b.contains(x));
                prop_assert!(a.gap(b) <= (x - y).abs().next_up());
            }
        }
    }

    #[test]
    fn sine_and_cosine_are_sound(low in -100.0..100.0, width in 0.0..7.0, at in 0.0..=1.0) {
        let angles = interval(low, low + width);
        let angle = f64::clamp(low + at * width, angles.low(), angles.high());
        // libm is within a unit in the last place.
        let close = |a: Interval, b: f64| a.low() <= b + 3e-16 && b - 3e-16 <= a.high();
        prop_assert!(close(angles.sin(), libm::sin(angle)));
        prop_assert!(close(angles.cos(), libm::cos(angle)));
        prop_assert!(interval(-1.0, 1.0).encloses(angles.sin()));
    }
}

prop_compose! {
    fn boxes()(x in -20.0..20.0, y in -20.0..20.0, wide in 0.0..3.0, high in 0.0..3.0, at in [0.0..=1.0, 0.0..=1.0])
        -> (PointBox, Point)
    {
        let sides = PointBox::new(interval(x, x + wide), interval(y, y + high));
        let inside = Point::new(
            f64::clamp(x + at[0] * wide, sides.x.low(), sides.x.high()),
            f64::clamp(y + at[1] * high, sides.y.low(), sides.y.high()),
        );
        (sides, inside)
    }
}

prop_compose! {
    fn poses()((position, inside) in boxes(), low in -7.0..7.0, width in 0.0..4.0, at in 0.0..=1.0)
        -> (PoseBox, Pose)
    {
        let heading = interval(low, low + width);
        let inside = Pose::new(inside, Heading::from_radians(low + at * width));
        (PoseBox::new(position, heading), inside)
    }
}

/// Soundness of what f64 computes on the side: it is itself off by some roundings.
fn nearly(of: PoseBox, pose: Pose) -> bool {
    let widened = PoseBox::new(
        PointBox::new(
            of.position.x.widened(1e-12).unwrap(),
            of.position.y.widened(1e-12).unwrap(),
        ),
        of.heading.widened(1e-12).unwrap(),
    );
    widened.contains(pose)
}

proptest! {
    #[test]
    fn transforms_are_sound((a, in_a) in poses(), (b, in_b) in poses()) {
        prop_assert!(nearly(a.compose(b), in_a.compose(in_b)));
        prop_assert!(nearly(a.inverse(), in_a.inverse()));
        prop_assert!(nearly(a.between(b), in_a.between(in_b)));
        prop_assert!(nearly(a.inverse().compose(a), Pose::IDENTITY));
        prop_assert!(nearly(a.compose(a.inverse()), Pose::IDENTITY));
    }

    #[test]
    fn narrower_poses_give_narrower_results((a, in_a) in poses(), (b, in_b) in poses()) {
        let point = |outer: PoseBox, inner: Pose| {
            // The heading that lies in the box, not its wrapped equal.
            let turns = libm::round((outer.heading.middle() - inner.heading.radians()) / TAU);
            let heading = Interval::of(inner.heading.radians() + turns * TAU).unwrap();
            PoseBox::new(PointBox::of(inner.position).unwrap(), heading)
        };
        let (small_a, small_b) = (point(a, in_a), point(b, in_b));
        for (all, part) in [
            (a.compose(b), small_a.compose(small_b)),
            (a.compose(b), a.compose(small_b)),
            (a.inverse(), small_a.inverse()),
            (a.between(b), small_a.between(b)),
        ] {
            let slack = all.position.x.widened(1e-12).unwrap().encloses(part.position.x)
                && all.position.y.widened(1e-12).unwrap().encloses(part.position.y);
            prop_assert!(slack, "{:?} {:?}", all, part);
        }
    }

    /// Each side of the least box is touched by some turned position.
    #[test]
    fn a_turned_box_is_the_least((sides, _) in boxes(), low in -7.0..7.0, width in 0.0..3.0) {
        let angles = interval(low, low + width);
        let turned = sides.rotated(angles);
        let mut touched = PointBox::new(interval(1e9, 1e9), interval(1e9, 1e9));
        let mut seen = false;
        for x in [sides.x.low(), sides.x.high()] {
            for y in [sides.y.low(), sides.y.high()] {
                for step in 0..=400 {
                    let pose = Pose::new(
                        Point::origin(),
                        Heading::from_radians(low + width * f64::from(step) / 400.0),
                    );
                    let point = PointBox::of(pose.transform(Point::new(x, y))).unwrap();
                    touched = if seen { touched.hull(point) } else { point };
                    seen = true;
                }
            }
        }
        let widened = PointBox::new(
            turned.x.widened(1e-9).unwrap(),
            turned.y.widened(1e-9).unwrap(),
        );
        prop_assert!(widened.encloses(touched), "{:?} misses {:?}", turned, touched);
        // 400 steps of at most 0.0075 rad miss an extreme of a circle of at most 33 m by under a
        // millimetre.
        prop_assert!(turned.x.width() - touched.x.width() < 2e-3);
        prop_assert!(turned.y.width() - touched.y.width() < 2e-3);
    }

    /// Where a circle crosses an axis the sign of its slope is not certain.
    #[test]
    fn what_lies_on_an_axis_turns_about_nothing_but_the_angle(
        radius in 0.1..20.0, quarters in -9..9_i32, off in 0.0..1e-15,
    ) {
        for point in [Point::new(radius, 0.0), Point::new(-radius, 0.0), Point::new(0.0, radius), Point::new(0.0, -radius)] {
            let angle = 0.5 * PI * f64::from(quarters);
            let turned = PointBox::of(point).unwrap().rotated(interval(angle, angle + off));
            let pose = Pose::new(Point::origin(), Heading::from_radians(angle));
            let about = PointBox::about(pose.transform(point), 1e-12).unwrap();
            prop_assert!(about.encloses(turned), "{:?}", turned);
        }
    }

    #[test]
    fn intersections_keep_what_lies_in_both((a, pose) in poses(), (b, _) in poses()) {
        match a.intersection(b) {
            Some(both) => {
                prop_assert!(a.position.encloses(both.position) && b.position.encloses(both.position));
                if b.contains(pose) {
                    prop_assert!(nearly(both, pose));
                }
            }
            None => prop_assert!(!b.contains(pose)),
        }
        prop_assert!(nearly(a.hull(b), pose));
    }
}

/// Goes round a square with sides of 1 m ± 10 cm ahead and 5 cm aside and corners of 90° ± 1°. The
/// bounds grow as in another implementation of sound and tight arithmetic.
#[test]
fn boxes_grow_round_a_square_as_they_must() {
    let leg = PoseBox::new(
        PointBox::new(
            Interval::about(1.0, 0.1).unwrap(),
            Interval::about(0.0, 0.05).unwrap(),
        ),
        Interval::about(0.5 * PI, 1_f64.to_radians()).unwrap(),
    );
    let mut way = PoseBox::IDENTITY;
    for (moves, width) in [(4, 0.76), (8, 1.83), (20, 7.0), (40, 22.3)] {
        way = PoseBox::IDENTITY;
        for _ in 0..moves {
            way = way.compose(leg);
        }
        assert!(way.contains(Pose::IDENTITY), "{moves} moves");
        let grown = way.position.x.width();
        assert!(
            (grown - width).abs() < 0.01 * width + 0.005,
            "{moves} moves: {grown}"
        );
    }
    assert!(way.heading.width() > 1.39);
}

#[test]
fn headings_a_full_circle_apart_are_the_same() {
    let around = |degrees: f64| {
        PoseBox::new(
            PointBox::ORIGIN,
            Interval::about(degrees.to_radians(), 0.1).unwrap(),
        )
    };
    let seam = Pose::new(Point::origin(), Heading::from_degrees(-179.0));
    assert!(around(180.0).contains(seam) && around(540.0).contains(seam));
    assert!(around(180.0).intersection(around(-178.0)).is_some());
    assert!(around(180.0).intersection(around(90.0)).is_none());
    let seam = around(170.0).hull(around(-170.0)).heading;
    let expect = interval(170_f64.to_radians() - 0.1, 190_f64.to_radians() + 0.1);
    assert!(
        expect.widened(1e-12).unwrap().encloses(seam)
            && seam.widened(1e-12).unwrap().encloses(expect)
    );
    // Two wide arcs agree on both sides of the circle.
    let wide = |degrees: f64| {
        PoseBox::new(
            PointBox::ORIGIN,
            Interval::about(degrees.to_radians(), 2.0).unwrap(),
        )
    };
    let both = wide(0.0).intersection(wide(180.0)).unwrap();
    for degrees in [90.0, -90.0] {
        assert!(both.contains(Pose::new(Point::origin(), Heading::from_degrees(degrees))));
    }
    let anywhere = PoseBox::new(PointBox::ORIGIN, Interval::UNBOUNDED);
    assert_eq!(anywhere.intersection(around(3.0)), Some(around(3.0)));
    assert_eq!(around(3.0).intersection(anywhere), Some(around(3.0)));
}

#[test]
fn missing_bounds_stay_missing() {
    let half = interval(2.0, f64::INFINITY);
    assert_eq!(half + half, interval(4.0, f64::INFINITY));
    assert_eq!(half * Interval::ZERO, Interval::ZERO);
    assert_eq!((half - half), Interval::UNBOUNDED);
    assert_eq!(Interval::UNBOUNDED.sin(), interval(-1.0, 1.0));
    assert!(
        half.checked_div(half)
            .unwrap()
            .encloses(interval(0.0, 1e300))
    );
    assert_eq!(half.checked_div(Interval::ZERO), None);
    assert_eq!(
        half.checked_div(interval(-1.0, 1.0)),
        Some(Interval::UNBOUNDED)
    );
    assert_eq!(interval(-3.0, -1.0).sqrt(), None);
    assert_eq!(
        interval(1.0, 2.0).checked_div(half).map(Interval::low),
        Some(0.0)
    );
    assert_eq!(
        (-half).checked_div(interval(1.0, 2.0)),
        Some(interval(f64::NEG_INFINITY, (-1_f64).next_up()))
    );
    assert_eq!((-half).middle().to_bits(), (-2_f64).to_bits());
    assert_eq!(Interval::UNBOUNDED.middle().to_bits(), 0);
    assert!((half.middle() - 2.0).abs() < 1e-12 && half.width().is_infinite());
    // A sum that overflows has no upper bound, but still a lower one.
    let most = Interval::of(f64::MAX).unwrap();
    assert_eq!(most + most, interval(f64::MAX, f64::INFINITY));
    // A half-plane's edge may turn anywhere about the origin.
    let beyond = PointBox::new(half, Interval::ZERO);
    assert!(!beyond.is_bounded() && !PointBox::new(Interval::ZERO, half).is_bounded());
    for point in [Point::new(2.0, 0.1), Point::new(1e9, 1e8)] {
        assert!(beyond.rotated(interval(0.0, 0.1)).contains(point));
    }
    let lost = PoseBox::new(PointBox::UNBOUNDED, Interval::UNBOUNDED);
    assert!(lost.compose(lost).contains(Pose::IDENTITY));
    assert!(lost.inverse().contains(Pose::IDENTITY));
}

/// Checks that 2²⁰ quarter turns are told apart. Nothing is known of sines farther out.
#[test]
fn sines_of_many_turns_are_known_up_to_a_limit() {
    for angle in [1.647e6, -1.647e6] {
        let angles = Interval::of(angle).unwrap();
        assert!(angles.sin().width() < 1e-12 && angles.cos().width() < 1e-12);
        let beyond = Interval::of(angle + angle.signum() * 200.0).unwrap();
        assert_eq!(
            (beyond.sin(), beyond.cos()),
            (interval(-1.0, 1.0), interval(-1.0, 1.0))
        );
    }
}

#[test]
fn intervals_are_shown_with_the_decimals_asked_for() {
    assert_eq!(format!("{:.1}", interval(0.26, 7.0)), "[0.3, 7.0]");
    assert_eq!(format!("{}", interval(0.25, 7.0)), "[0.25, 7]");
    assert_eq!(format!("{:?}", interval(0.25, 7.0)), "[0.25, 7.0]");
}

#[test]
fn what_bounds_nothing_is_refused() {
    let refused = |low, high| Interval::new(low, high).unwrap_err().to_string();
    assert!(refused(f64::NAN, 1.0).contains("not both numbers"));
    assert!(refused(2.0, 1.0).contains("[2, 1]"));
    assert!(refused(f64::INFINITY, f64::INFINITY).contains("no number"));
    assert!(matches!(
        Interval::about(1.0, -0.5),
        Err(IntervalError::NegativeMargin { .. })
    ));
    assert!(Interval::about(f64::INFINITY, 1.0).is_err());
    assert!(PointBox::about(Point::new(0.0, f64::NAN), 1.0).is_err());
    assert!(PoseBox::of(Pose::new(Point::origin(), Heading::from_radians(f64::NAN))).is_err());
}

/// Maps hold these, so the names must last, and no bit of a bound may be lost.
#[cfg(feature = "serde")]
#[test]
fn boxes_survive_json() {
    let pose = PoseBox::new(
        PointBox::new(
            interval(0.1 + 0.2, 7.0),
            interval(f64::NEG_INFINITY, 1e-300),
        ),
        Interval::UNBOUNDED,
    );
    let json = serde_json::to_string(&pose).unwrap();
    assert_eq!(
        json,
        r#"{"position":{"x":[0.30000000000000004,7.0],"y":[null,1e-300]},"heading":[null,null]}"#
    );
    assert_eq!(serde_json::from_str::<PoseBox>(&json).unwrap(), pose);
    assert!(serde_json::from_str::<Interval>("[2.0, 1.0]").is_err());
}

proptest! {
    #[test]
    fn boxes_are_measured_as_their_sides_are((a, in_a) in boxes(), (b, in_b) in boxes(), degrees in -179.0..179.0) {
        let middle = a.middle();
        prop_assert!((middle.x - 0.5 * (a.x.low() + a.x.high())).abs() < 1e-12);
        prop_assert!((middle.y - 0.5 * (a.y.low() + a.y.high())).abs() < 1e-12);
        let longer = (a.x.high() - a.x.low()).max(a.y.high() - a.y.low());
        prop_assert!((a.width() - longer).abs() < 1e-12);
        // Two boxes meet exactly where they have something in common.
        prop_assert_eq!(a.meets(b), a.intersection(b).is_some());
        let beside = |a: Interval, b: Interval| (a.low() - b.high()).max(b.low() - a.high()).max(0.0);
        let gaps = [beside(a.x, b.x), beside(a.y, b.y)];
        prop_assert_eq!(a.meets(b), gaps == [0.0, 0.0]);
        prop_assert!((a.x.gap(b.x) - gaps[0]).abs() < 1e-12 && a.x.gap(b.x) <= gaps[0]);
        // The least distance is that of the nearest corners, and all distances are in between.
        let distance = a.distance(b);
        prop_assert!((distance.low() - gaps[0].hypot(gaps[1])).abs() < 1e-6, "{distance:?} {gaps:?}");
        prop_assert!(distance.contains((in_a - in_b).norm()));
        let far = |a: Interval, b: Interval| (a.high() - b.low()).max(b.high() - a.low());
        let farthest = far(a.x, b.x).hypot(far(a.y, b.y));
        prop_assert!((distance.high() - farthest).abs() < 1e-9);
        prop_assert!((Heading::from_degrees(degrees).degrees() - degrees).abs() < 1e-9);
        let pose = PoseBox::new(a, Interval::of(degrees.to_radians()).unwrap()).middle();
        prop_assert_eq!(pose.position, middle);
        prop_assert!((pose.heading.degrees() - degrees).abs() < 1e-9);
    }
}

/// Relations of two intervals, by all numbers on a small lattice.
#[test]
fn relations_are_those_of_the_numbers_inside() {
    let bounds = (0..5).flat_map(|low| (low..5).map(move |high| (low, high)));
    let all: Vec<(i32, i32)> = bounds.collect();
    let of = |(low, high): (i32, i32)| interval(f64::from(low), f64::from(high));
    for (a, b) in all.iter().flat_map(|a| all.iter().map(move |b| (*a, *b))) {
        let inside = |(low, high): (i32, i32), number: i32| (low..=high).contains(&number);
        let (one, other) = (of(a), of(b));
        let encloses = (0..5).all(|number| !inside(b, number) || inside(a, number));
        assert_eq!(one.encloses(other), encloses, "{a:?} {b:?}");
        let meets = (0..5).any(|number| inside(a, number) && inside(b, number));
        assert_eq!(one.meets(other), meets, "{a:?} {b:?}");
        let gap = (a.0 - b.1).max(b.0 - a.1).max(0);
        assert!(one.gap(other) <= f64::from(gap) && one.gap(other) > f64::from(gap) - 1e-9);
        let both = meets.then(|| (a.0.max(b.0), a.1.min(b.1)));
        assert_eq!(one.intersection(other), both.map(of));
        assert_eq!(one.hull(other), of((a.0.min(b.0), a.1.max(b.1))));
        let boxes = [(one, other), (other, one), (one, one)].map(|(x, y)| PointBox::new(x, y));
        assert_eq!(boxes[2].encloses(boxes[0]), encloses, "{a:?} {b:?}");
        assert_eq!(boxes[2].encloses(boxes[1]), encloses, "{a:?} {b:?}");
    }
}

#[test]
fn the_way_between_headings_is_the_shorter_one() {
    for (from, to, turn) in [
        (10.0, 50.0, 40.0),
        (170.0, -170.0, 20.0),
        (-100.0, 100.0, -160.0),
    ] {
        let [from, to] = [from, to].map(Heading::from_degrees);
        assert!((from.turn_to(to).to_degrees() - turn).abs() < 1e-9);
        let there = from.turned(from.turn_to(to));
        assert!((there.radians() - to.radians()).abs() < 1e-12);
    }
}
