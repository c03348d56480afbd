//! The scan map in rooms whose walls are known: what it draws, where it fits a scan, and what it
//! believes.

use proptest::prelude::*;
use tolman_geom::{Heading, Point, Vector};
use tolman_maps::scan_map::{
    Advance, ChartError, ChartParts, Explanation, ScanChart, ScanMap, ScanMapConfig, ScanPlace,
    StandpointBelief, Standpoints, WallGrid,
};
use tolman_robot::{Landmark, Ring, Scan};

use crate::pinned::pinned;

const DIAMETER: f64 = 0.5;

fn ring() -> Ring {
    Ring::full(72, 1.25)
}

/// Returns the scan of a robot at `at`, looking `heading`, in a corridor from (0, 0) to (`length`,
/// 0.95).
fn scan_of(length: f64, at: Point, heading: Heading) -> Scan {
    let mut scan = Scan::clear(ring());
    for (index, range) in (0..).zip(&mut scan.ranges) {
        let way = heading.turned(ring().bearing(index)).unit();
        let to_wall = |at: f64, way: f64, far: f64| {
            if way > 1e-12 {
                (far - at) / way
            } else if way < -1e-12 {
                -at / way
            } else {
                f64::INFINITY
            }
        };
        let wall = to_wall(at.x, way.x, length).min(to_wall(at.y, way.y, 0.95));
        *range = wall.min(ring().max_range);
    }
    scan
}

/// Walks along a corridor in steps whose odometry is off by `errors`, and back to the start.
/// Returns the map and the error of its last position.
fn walked(length: f64, errors: &[f64]) -> (ScanMap, f64) {
    let mut map = ScanMap::new(ScanMapConfig::for_robot(DIAMETER));
    let start = Point::new(0.5, 0.475);
    let mut at = start;
    let mut observe = |at: Point, moved: Vector| {
        map.observe(&Advance {
            moved,
            sd: Vector::new(0.02, 0.02),
            heading: Heading::EAST,
            scan: &scan_of(length, at, Heading::EAST),
            landmark: (at.x > length - 0.6).then_some(Landmark::Goal),
            walls_change: false,
        });
    };
    observe(at, Vector::zeros());
    let count = ((length - 1.0) / 0.4) as usize;
    let there = (0..count).map(|_| 0.4);
    let back = (0..count).map(|_| -0.4);
    for (step, error) in there.chain(back).zip(errors.iter().cycle()) {
        at.x += step;
        observe(at, Vector::new(step + error, 0.5 * error));
    }
    let off = (map.position() - Point::origin()) - (at - start);
    (map, off.norm())
}

#[test]
fn walls_are_where_scans_met_them_and_unknown_beyond() {
    let mut grid = WallGrid::default();
    let at = Point::new(0.5, 0.475);
    grid.add(at, Heading::NORTH, &scan_of(4.0, at, Heading::NORTH));
    assert!(grid.is_wall(Point::new(-0.01, 0.475)) || grid.is_wall(Point::new(0.01, 0.475)));
    assert!(!grid.is_wall(Point::new(0.25, 0.475)));
    assert!(
        !grid.sees(at, Point::new(0.5, 2.0)),
        "through the northern wall"
    );
    assert!(grid.sees(at, Point::new(1.2, 0.475)));
    assert!(!grid.is_known(Point::new(3.0, 0.475)));
}

#[test]
fn a_corridor_walked_to_and_fro_has_each_place_once() {
    let (map, off) = walked(5.0, &[0.0]);
    assert!(off < 0.05, "{off}");
    let places = map.places().len();
    assert!((6..=9).contains(&places), "{places}");
    let view = map.view();
    let goals = view.places.iter().filter(|place| place.landmark.is_some());
    assert!(goals.count() >= 1);
    assert!(view.links.iter().all(|link| link.from != link.to));
}

/// Where the walls contradict the odometry, they decide, however sure the odometry is.
#[test]
fn walls_correct_odometry_that_is_worse_than_it_told() {
    for error in [-0.3, -0.25, 0.25, 0.3] {
        let mut map = ScanMap::new(ScanMapConfig::for_robot(DIAMETER));
        for (x, moved) in [(0.5, 0.0), (1.1, 0.6), (0.5, -0.6 + error)] {
            map.observe(&Advance {
                moved: Vector::new(moved, 0.0),
                sd: Vector::new(0.02, 0.02),
                heading: Heading::EAST,
                scan: &scan_of(1.6, Point::new(x, 0.475), Heading::EAST),
                landmark: None,
                walls_change: false,
            });
        }
        let off = (map.position() - Point::origin()).norm();
        assert!(off < 0.1, "off by {error} m, it is {off} m off");
        assert!(map.surprise() < ScanMap::DOUBTFUL);
    }
}

#[test]
fn a_robot_that_saw_one_end_knows_which_end_it_is_at() {
    let (map, _) = walked(5.0, &[0.0]);
    let on = Standpoints::of(map.chart(), ring());
    let mut belief = StandpointBelief::anywhere(&on);
    // The map begins where the robot did: its western end lies half a metre to the west.
    belief.saw(
        &on,
        Heading::EAST,
        &scan_of(5.0, Point::new(0.4, 0.475), Heading::EAST),
    );
    let at = on.position(belief.likeliest().unwrap()).unwrap();
    assert!((at - Point::new(-0.1, 0.0)).norm() < 0.15, "{at}");
    // It goes two metres to the east, where nothing but corridor is seen, and knows where it is.
    belief.moved(&on, Vector::new(2.0, 0.0), Vector::new(0.05, 0.05));
    belief.saw(
        &on,
        Heading::EAST,
        &scan_of(5.0, Point::new(2.4, 0.475), Heading::EAST),
    );
    let at = on.position(belief.likeliest().unwrap()).unwrap();
    assert!((at - Point::new(1.9, 0.0)).norm() < 0.2, "{at}");
    assert!(belief.certainty(&on, DIAMETER) > 0.95);
}

/// Returns the belief of a robot that meets another corridor, and the best explanation of each
/// look. It knows that it stands in a corridor 5 m long, `from` m from its western end. Then it
/// looks `looks` times, from `seen`, m, in a corridor of `length`, m.
fn surprised(
    from: f64,
    seen: f64,
    length: f64,
    looks: u32,
) -> (Standpoints, StandpointBelief, Vec<Explanation>) {
    let (map, _) = walked(5.0, &[0.0]);
    let on = Standpoints::of(map.chart(), ring());
    let mut belief = StandpointBelief::anywhere(&on);
    let end = scan_of(5.0, Point::new(0.4, 0.475), Heading::EAST);
    for _ in 0..8 {
        belief.saw(&on, Heading::EAST, &end);
    }
    if from > 0.5 {
        belief.moved(&on, Vector::new(from - 0.4, 0.0), Vector::new(0.05, 0.05));
    }
    let scan = scan_of(length, Point::new(seen, 0.475), Heading::EAST);
    let explanations = (0..looks)
        .map(|_| belief.saw(&on, Heading::EAST, &scan))
        .collect();
    (on, belief, explanations)
}

#[test]
fn who_is_lifted_finds_out() {
    let (on, belief, _) = surprised(0.4, 2.5, 5.0, 4);
    let at = on.position(belief.likeliest().unwrap()).unwrap();
    // Off both ends of the corridor, which are out of sight.
    assert!((0.6..3.4).contains(&at.x), "{at}");
}

#[test]
fn a_wall_that_is_new_moves_nobody() {
    let (on, belief, explanations) = surprised(2.4, 2.4, 3.0, 2);
    assert!(
        !explanations.contains(&Explanation::Lifted),
        "{explanations:?}"
    );
    let here = belief.likeliest().unwrap();
    let at = on.position(here).unwrap();
    assert!((at - Point::new(1.9, 0.0)).norm() < 0.2, "{at}");
    let scan = scan_of(3.0, Point::new(2.4, 0.475), Heading::EAST);
    let walls = on.new_walls(here, Heading::EAST, &scan);
    assert!(!walls.is_empty());
    for wall in &walls {
        assert!((wall.x - 2.5).abs() < 0.25, "{wall}");
    }
    let known = scan_of(5.0, Point::new(2.4, 0.475), Heading::EAST);
    assert!(on.new_walls(here, Heading::EAST, &known).is_empty());
    // Drawn, it bars the way, and its robot knows no less where it is.
    let drawn = Standpoints::of(on.chart().with_walls(&walls), ring());
    let (west, east) = (Point::new(1.9, 0.0), Point::new(3.5, 0.0));
    assert!(on.chart().ground().sees(west, east));
    assert!(!drawn.chart().ground().sees(west, east));
    let carried = belief.carried_over(&on, &drawn);
    let at = drawn.position(carried.likeliest().unwrap()).unwrap();
    assert!((at - Point::new(1.9, 0.0)).norm() < 0.3, "{at}");
}

/// A scan that fits nowhere restarts the belief, also one at the map's end.
#[test]
fn a_scan_that_fits_nowhere_makes_it_begin_anew() {
    // It has seen the western end of a corridor whose other end is out of sight.
    let mut map = ScanMap::new(ScanMapConfig::for_robot(DIAMETER));
    let start = Point::new(0.5, 0.475);
    map.observe(&Advance {
        moved: Vector::zeros(),
        sd: Vector::zeros(),
        heading: Heading::EAST,
        scan: &scan_of(9.0, start, Heading::EAST),
        landmark: None,
        walls_change: false,
    });
    let on = Standpoints::of(map.chart(), ring());
    let nowhere = scan_of(0.6, Point::new(0.3, 0.475), Heading::EAST);
    for way in [0.0, 1.0] {
        let mut belief = StandpointBelief::anywhere(&on);
        belief.saw(&on, Heading::EAST, &scan_of(9.0, start, Heading::EAST));
        let moved = Vector::new(way, 0.0);
        belief.moved(&on, moved, Vector::new(0.02, 0.02));
        for _ in 0..3 {
            belief.saw(&on, Heading::EAST, &nowhere);
        }
        let likeliest = on.position(belief.likeliest().unwrap()).unwrap();
        let least = belief.probabilities().iter().copied().fold(1.0, f32::min);
        assert!(
            least > 0.0,
            "after {way} m it still believes in {likeliest}"
        );
    }
}

/// A standpoint's scan is that of a robot there, as far as walls are known to a cell.
#[test]
fn standpoints_see_what_is_there() {
    let (map, _) = walked(5.0, &[0.0]);
    let on = Standpoints::of(map.chart(), ring());
    let views = on.views();
    let mut scan = Scan::clear(ring());
    for (number, at) in (0..).zip(on.positions()) {
        assert_eq!((on.position(number), on.at(at)), (Some(at), Some(number)));
        views.scan(number, Heading::WEST, &mut scan);
        let truly = scan_of(5.0, at + Vector::new(0.5, 0.475), Heading::WEST);
        // Beams that run along a wall meet it far from where they should; others pass cells that no
        // scan showed.
        let seen = scan.ranges.iter().zip(&truly.ranges);
        let seen = seen.filter(|(seen, _)| **seen < 1.2);
        let off = seen.filter(|(seen, truly)| (*seen - *truly).abs() > 0.1);
        assert!(off.count() <= 6, "from {at}: {:?}", scan.ranges);
    }
    assert_eq!(on.position(on.len() as u32), None);
    let goals: Vec<Point> = on
        .goals()
        .iter()
        .filter_map(|at| on.position(*at))
        .collect();
    assert!(goals.iter().all(|at| at.x > 3.7), "{goals:?}");
    assert!(!goals.is_empty());
}

/// A chart comes back from its parts, and the standpoints on it are the same.
#[test]
fn a_chart_comes_back() {
    let (map, _) = walked(3.0, &[0.01, -0.02]);
    let chart = map.chart();
    let parts = chart.to_parts();
    let read = ScanChart::from_parts(parts).unwrap();
    assert_eq!(read, chart);
    assert_eq!(read.view(), map.view());
    let [learned, read] = [chart, read].map(|chart| Standpoints::of(chart, ring()));
    assert!(learned.positions().eq(read.positions()) && !learned.is_empty());
    // What is drawn on the ground is what the grid knew.
    let grid = learned.chart().ground().grid();
    for (column, row) in (-40..140).flat_map(|column| (-40..80).map(move |row| (column, row))) {
        let at = Point::new(0.025 * f64::from(column), 0.025 * f64::from(row));
        assert_eq!(grid.is_wall(at), map.grid().is_wall(at), "{at}");
        assert_eq!(grid.is_known(at), map.grid().is_known(at), "{at}");
        let ground = learned.chart().ground();
        let start = Point::new(0.0, 0.0);
        assert_eq!(ground.sees(start, at), map.grid().sees(start, at), "{at}");
    }
}

/// Parts that make no map are refused by name, and never make it panic.
#[test]
fn hostile_parts_are_refused() {
    type Spoil = fn(&mut ChartParts);
    let cases: [(Spoil, &str); 13] = [
        (|parts| parts.radius = f64::NAN, "keeps NaN m from walls"),
        (|parts| parts.radius = 1e9, "keeps 1000000000 m"),
        (
            |parts| parts.cell = 0.1,
            "cells are 0.1 m wide, expected 0.05",
        ),
        (
            |parts| parts.places[1].position.x = f64::INFINITY,
            "place 1 is at",
        ),
        (|parts| parts.goal[0].y = f64::NAN, "goal 0 is at"),
        (
            |parts| parts.links[0] = [1, 1],
            "link 0 goes from place 1 to place 1",
        ),
        (|parts| parts.links[0] = [0, 999], "to place 999"),
        (|parts| parts.links[1] = parts.links[0], "link 1 goes"),
        (|parts| parts.first = [i32::MIN, 0], "too far away"),
        (|parts| parts.first = [0, i32::MAX], "too far away"),
        (|parts| parts.rows[1].push('#'), "row 1 has"),
        (|parts| parts.rows[0].clear(), "row 1 has"),
        (
            |parts| parts.rows[2].replace_range(0..1, "x"),
            "row 2, cell 0: 'x'",
        ),
    ];
    let (map, _) = walked(3.0, &[0.0]);
    for (spoil, expect) in cases {
        let mut parts = map.chart().to_parts();
        spoil(&mut parts);
        let refused: ChartError = ScanChart::from_parts(parts).unwrap_err();
        let told = refused.to_string();
        assert!(told.contains(expect), "{told} for {expect}");
    }
    // Nothing at all is a map of nothing.
    let mut parts = map.chart().to_parts();
    parts.rows.clear();
    let on = Standpoints::of(ScanChart::from_parts(parts).unwrap(), ring());
    assert!(on.is_empty() && StandpointBelief::anywhere(&on).likeliest().is_none());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Odometry errors do not add up where the walls tell.
    #[test]
    fn errors_do_not_add_up(errors in prop::collection::vec(-0.03..0.03_f64, 3..9), length in 2.0..3.4_f64) {
        let (map, off) = walked(length, &errors);
        // Unseen, errors of one sign would add up to 0.36 m. In longer corridors these can exceed
        // the stated error of the odometry. Then the walls at the ends are not recognized.
        prop_assert!(off < 0.25, "{off}");
        prop_assert!(map.agreement() > 0.5);
    }

    /// However the robot moves and whatever it sees, its belief is a distribution.
    #[test]
    fn beliefs_add_up_to_one(
        moves in prop::collection::vec((-0.6..0.6_f64, -0.2..0.2_f64, 0.3..4.7_f64), 1..8),
    ) {
        let (map, _) = walked(5.0, &[0.01]);
        let on = Standpoints::of(map.chart(), ring());
        let mut belief = StandpointBelief::anywhere(&on);
        for (x, y, seen) in moves {
            belief.moved(&on, Vector::new(x, y), Vector::new(0.06, 0.01));
            belief.saw(&on, Heading::NORTH, &scan_of(5.0, Point::new(seen, 0.475), Heading::NORTH));
            belief.missed_the_goal(&on);
            let sum: f64 = belief.probabilities().iter().copied().map(f64::from).sum();
            prop_assert!((sum - 1.0).abs() < 1e-5, "{sum}");
        }
    }

    /// A grid that grows forgets nothing.
    #[test]
    fn growing_keeps_what_was_drawn(x in -20.0..20.0_f64, y in -20.0..20.0_f64) {
        let mut grid = WallGrid::default();
        let at = Point::new(0.5, 0.475);
        grid.add(at, Heading::EAST, &scan_of(4.0, at, Heading::EAST));
        let before = grid.clone();
        prop_assume!(x.abs().max(y.abs()) > 4.0);
        grid.add(Point::new(x, y), Heading::EAST, &Scan::clear(ring()));
        for (column, row) in (0..40).flat_map(|column| (0..20).map(move |row| (column, row))) {
            let at = Point::new(f64::from(column) * 0.04, f64::from(row) * 0.05);
            prop_assert_eq!(before.wall_distance(at), grid.wall_distance(at));
        }
    }
}

/// A corridor walked to and fro by a robot whose odometry errs, and what it believes when it comes
/// back: every figure is pinned.
#[test]
fn a_run_in_a_corridor_is_what_it_was() {
    let mut figures = Vec::new();
    let mut map = ScanMap::new(ScanMapConfig::for_robot(DIAMETER));
    let mut at = Point::new(0.5, 0.475);
    let steps = [
        0.0, 0.4, 0.35, 0.4, 0.45, 0.4, 0.3, -0.4, -0.35, -0.4, -0.45, -0.3,
    ];
    for (step, error) in steps
        .into_iter()
        .zip([0.0, 0.02, -0.03, 0.01].into_iter().cycle())
    {
        at.x += step;
        map.observe(&Advance {
            moved: Vector::new(step + error, 0.7 * error),
            sd: Vector::new(0.03, 0.02),
            heading: Heading::from_degrees(3.0),
            scan: &scan_of(3.4, at, Heading::from_degrees(3.0)),
            landmark: (at.x > 2.6).then_some(Landmark::Goal),
            walls_change: false,
        });
        figures.push(format!("{:?} {:?}", map.position(), map.at()));
        figures.push(format!("{} {}", map.agreement(), map.surprise()));
        let clearings = map.clearings();
        let way = clearings.way_to_gap(map.position());
        let metres = way.and_then(|way| way.metres(map.position()));
        figures.push(format!("{metres:?} {}", map.bytes()));
    }
    map.pass(Vector::new(0.1, 0.0), Landmark::Goal);
    figures.push(format!("{:?} {:?}", map.goal(), map.places()));
    figures.extend(map.chart().to_parts().rows);
    let on = Standpoints::of(map.chart(), ring());
    figures.push(format!(
        "{} {:?} {:?}",
        on.len(),
        on.goals(),
        on.position(7)
    ));
    let mut belief = StandpointBelief::anywhere(&on);
    let looks = [
        (0.5, 3.4),
        (0.9, 3.4),
        (1.3, 3.4),
        (1.3, 1.9),
        (2.8, 3.4),
        (3.0, 3.4),
    ];
    let mut before = 0.5;
    for (x, length) in looks {
        belief.moved(&on, Vector::new(x - before, 0.01), Vector::new(0.04, 0.02));
        before = x;
        let heading = Heading::from_degrees(30.0);
        let scan = scan_of(length, Point::new(x, 0.475), heading);
        let explanation = belief.saw(&on, heading, &scan);
        if x > 2.9 {
            belief.sensed_the_goal(&on);
        } else {
            belief.missed_the_goal(&on);
        }
        let certainty = belief.certainty(&on, DIAMETER);
        figures.push(format!(
            "{explanation:?} {:?} {certainty}",
            belief.likeliest()
        ));
        let probabilities = belief.probabilities().iter().step_by(17);
        let probabilities: Vec<String> = probabilities.map(|one| format!("{one:.6}")).collect();
        figures.push(probabilities.join(" "));
    }
    pinned("scan_map", &figures);
}

/// Returns a chart of six places: 0 – 1 – 2 – 3, 0 – 4 – 3, and 5 on its own.
fn charted(goal: usize, surprise: f64) -> ScanChart {
    let place = |number: u32| ScanPlace {
        position: Point::new(f64::from(number), 0.0),
        landmark: None,
    };
    ScanChart::from_parts(ChartParts {
        radius: 0.2,
        places: (0..6).map(place).collect(),
        links: vec![[0, 1], [0, 4], [1, 2], [2, 3], [3, 4]],
        goal: vec![Point::origin(); goal],
        start: Vec::new(),
        numbered: Vec::new(),
        surprise,
        cell: WallGrid::CELL,
        first: [0, 0],
        rows: vec!["..".to_owned()],
    })
    .unwrap()
}

#[test]
fn a_chart_is_doubted_for_what_it_lacks_or_contradicts() {
    let doubt = |goal, surprise| charted(goal, surprise).doubt();
    assert!(doubt(0, 0.0).unwrap().contains("never sensed the goal"));
    let most = ScanMap::DOUBTFUL;
    assert_eq!(
        [0.0, 0.5 * most, most].map(|surprise| doubt(1, surprise)),
        [None; 3]
    );
    assert!(doubt(1, 1.01 * most).unwrap().contains("contradict"));
}

#[test]
fn a_way_on_a_chart_has_the_fewest_links() {
    let chart = charted(1, 0.0);
    assert_eq!(chart.way(0, &[3]), Some(vec![0, 4, 3]));
    assert_eq!(chart.way(3, &[0, 1]).map(|way| way.len()), Some(3));
    assert_eq!(chart.way(2, &[5, 1]), Some(vec![2, 1]));
    assert_eq!(chart.way(2, &[2]), Some(vec![2]));
    assert_eq!((chart.way(0, &[5]), chart.way(5, &[0, 1])), (None, None));
    let view = chart.view();
    assert_eq!((view.places.len(), view.links.len()), (6, 10));
}

#[test]
fn a_robot_twice_as_wide_has_a_map_twice_as_coarse() {
    for diameter in [0.2, 0.5] {
        let config = ScanMapConfig::for_robot(diameter);
        let lengths = [
            config.radius,
            config.spacing_of_places,
            config.reach_of_visit,
            config.spacing_of_scans,
            config.farthest_fit,
        ];
        for (length, share) in lengths.iter().zip([0.45, 1.0, 0.9, 0.4, 0.7]) {
            assert!((length - share * diameter).abs() < 1e-12, "{length}");
        }
    }
}

/// The start is where its landmark is sensed, unless the map begins there; numbers are no place.
#[test]
fn a_start_is_noted_where_the_map_does_not_begin() {
    let noted = |first: Option<Landmark>, last: Landmark| {
        let mut map = ScanMap::new(ScanMapConfig::for_robot(DIAMETER));
        for (step, landmark) in [(0.0, first), (0.4, None), (0.4, Some(last))] {
            let at = Point::new(0.5 + step, 0.475);
            map.observe(&Advance {
                moved: Vector::new(step, 0.0),
                sd: Vector::new(0.02, 0.02),
                heading: Heading::EAST,
                scan: &scan_of(4.0, at, Heading::EAST),
                landmark,
                walls_change: false,
            });
        }
        let before = (map.start().len(), map.goal().len());
        // Near where it was sensed before it is the same, and farther off another point.
        map.pass(Vector::new(0.01, 0.0), last);
        assert_eq!((map.start().len(), map.goal().len()), before);
        map.pass(Vector::new(0.03, 0.0), last);
        (map.start().len(), map.goal().len())
    };
    let (start, goal) = (Landmark::Start, Landmark::Goal);
    assert_eq!(noted(None, start), (2, 0));
    assert_eq!(noted(Some(start), start), (0, 0));
    assert_eq!(noted(Some(goal), start), (2, 1));
    assert_eq!(noted(Some(start), goal), (0, 2));
    assert_eq!(noted(None, Landmark::Numbered(3)), (0, 0));
    assert_eq!(noted(Some(Landmark::Numbered(3)), start), (2, 0));
}

/// A map begins where the robot was first observed. The start, if it is there, is nowhere else.
#[test]
fn a_start_elsewhere_is_a_surprise() {
    let mut map = ScanMap::new(ScanMapConfig::for_robot(DIAMETER));
    map.pass(Vector::new(0.3, 0.0), Landmark::Goal);
    assert!(map.goal().is_empty());
    map.observe(&Advance {
        moved: Vector::new(0.7, -0.2),
        sd: Vector::new(0.3, 0.3),
        heading: Heading::EAST,
        scan: &scan_of(4.0, Point::new(0.5, 0.475), Heading::EAST),
        landmark: Some(Landmark::Start),
        walls_change: false,
    });
    assert_eq!(map.position(), Point::origin());
    map.pass(Vector::new(1.9 * DIAMETER, 0.0), Landmark::Start);
    assert!(map.surprise() < ScanMap::DOUBTFUL);
    map.pass(Vector::new(2.1 * DIAMETER, 0.0), Landmark::Start);
    assert!(map.surprise() > ScanMap::DOUBTFUL);
}
