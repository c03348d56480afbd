//! Tests the maps that are learned of worlds in which every place looks the same, of painted
//! worlds, and after a kidnapping.

use super::abstract_world::{AbstractWorld, MoveNoise};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Point;
use tolman_maps::diktiometry::{
    Apart, Config, DiktiometryConfigError, GeometricMerge, Identity, Link, Matcher, Percepts,
    PerceptualIndexing, Use, WorldKind,
};
use tolman_maze::Direction;

use super::walk::{
    COMPASS, ODOMETRY, Score, Scripted, Walk, alike, blocks, braided_corridors, open, painted,
    rooms,
};

fn perfect(places: usize) -> Score {
    Score {
        purity: 1.0,
        places,
        visited: places,
        link_precision: 1.0,
        link_recall: 1.0,
    }
}

#[test]
fn a_random_walk_teaches_a_world_of_alike_places() {
    let (mut by_map, mut by_odometry) = (0.0, 0.0);
    for seed in 0..8 {
        let mut walk = Walk::new(open(5), ODOMETRY, alike(), seed);
        walk.wander(300);
        for _ in 300..700 {
            let direction = walk.robot.wander().unwrap();
            let (moved, report) = walk.go(direction);
            let predicted = report.tracks[0].predicted.and_then(|one| one.displacement);
            let predicted = predicted.map_or(moved.measured, |one| one.middle().coords);
            by_map += (predicted - moved.truth).norm_squared();
            by_odometry += (moved.measured - moved.truth).norm_squared();
        }
        assert_eq!(walk.score(), perfect(25), "seed {seed}");
        assert_eq!(walk.observer.map().check(4), None);
    }
    // The map knows moves better than they are measured.
    assert!(by_map < 0.5 * by_odometry, "{by_map} {by_odometry}");
}

/// A mapper that merges any boxes that meet confuses places. The paper's restructurers prevent
/// that.
#[test]
fn boxes_that_merely_meet_confuse_places() {
    let mut config = alike();
    config.matching.identity = Identity::Meets;
    config.restructuring.geometric_merge = GeometricMerge::Estims;
    let purities = (0..3).map(|seed| {
        let mut walk = Walk::new(open(10), ODOMETRY, config.clone(), seed);
        walk.wander(700);
        walk.score().purity
    });
    let worst = purities.fold(1.0, f64::min);
    assert!(worst < 0.8, "{worst}");
}

#[test]
fn a_matcher_that_is_off_matches_nothing() {
    let mut errors = ODOMETRY;
    errors.outliers = 0.05;
    errors.outlier_factor = 3.0;
    type Change = fn(&mut Config);
    let used = |change: Change, wanted: Matcher| {
        let mut config = alike();
        change(&mut config);
        let mut uses = 0;
        for seed in 0..3 {
            let mut walk = Walk::new(open(5), errors, config.clone(), seed);
            let mut planner = Scripted::new(0.3, seed);
            for _ in 0..300 {
                let (_, report) = planner.go(&mut walk);
                let matchers = report.tracks.iter().filter_map(|track| track.matcher);
                uses += matchers.filter(|matcher| *matcher == wanted).count();
            }
        }
        uses
    };
    let off: [(Change, Matcher); 3] = [
        (
            |config| config.matching.continuation = Use::Off,
            Matcher::Continue,
        ),
        (|config| config.matching.link = Use::Off, Matcher::Link),
        (|config| config.matching.alpha = Use::Off, Matcher::Alpha),
    ];
    for (change, matcher) in off {
        assert!(used(|_| (), matcher) > 0, "{matcher:?} is used");
        assert_eq!(used(change, matcher), 0, "{matcher:?} is off");
    }
}

#[test]
fn scripts_teach_a_larger_world() {
    let mut walk = Walk::new(open(10), ODOMETRY, alike(), 1);
    walk.heed(1.0, 1500);
    assert_eq!(walk.score(), perfect(100));
}

#[test]
fn scripts_teach_corridors_in_which_a_robot_stops_only_roughly() {
    let maze = blocks(6, 0.25, &mut ChaCha8Rng::seed_from_u64(1));
    let world = AbstractWorld::from_corridors(&maze, 1.0);
    assert!(
        (20..36).contains(&world.places().len()),
        "some cells lead straight on"
    );
    for place in 0..world.places().len() as u32 {
        for direction in world.exits(place) {
            let there = world.neighbour(place, direction).unwrap();
            assert_eq!(world.neighbour(there, direction.opposite()), Some(place));
        }
    }
    let mut errors = ODOMETRY;
    errors.stop = 0.0175;
    let mut config = alike();
    config.place_radius = errors.stop;
    let places = world.places().len();
    let mut walk = Walk::new(world, errors, config, 1);
    walk.heed(1.0, 1200);
    assert_eq!(walk.score(), perfect(places));
}

/// Boxes so wide that geometry cannot close the loops of the world.
const ROUGH: MoveNoise = {
    let mut errors = ODOMETRY;
    errors.distance = 0.2;
    errors.compass = 2.0 * COMPASS;
    errors.look = 0.2;
    errors
};

fn looked_at(world: AbstractWorld, look_merge: Use, moves: usize) -> Walk {
    let mut config = painted();
    config.restructuring.look_merge = look_merge;
    let mut walk = Walk::new(world, ROUGH, config, 1);
    walk.heed(0.3, moves);
    walk
}

#[test]
fn looks_close_loops_that_are_too_wide_for_geometry() {
    let walk = |look_merge| {
        let maze = blocks(12, 0.25, &mut ChaCha8Rng::seed_from_u64(1));
        let world = AbstractWorld::from_corridors(&maze, 1.0).painted(5, 1);
        looked_at(world, look_merge, 1000)
    };
    let (without, with) = (walk(Use::Off), walk(Use::On));
    let score = without.score();
    assert!(score.places > 2 * score.visited, "{score:?}");
    assert_eq!(with.score(), perfect(with.score().visited));
    let looks = with.observer.map().looks;
    assert!(looks.kinds > 20 && looks.different > 200, "{looks:?}");
}

/// A robot that goes to and fro doubles places before it has seen enough. They are folded once the
/// map around them is known.
#[test]
fn no_double_is_left_of_a_corridor_gone_to_and_fro() {
    for seed in [6, 8, 11, 17] {
        let walk = braided_corridors(8, seed);
        let score = walk.score();
        assert_eq!(score, perfect(score.visited), "seed {seed}");
    }
}

/// Looks tell nothing where all look alike, and the map learns that they tell nothing where rooms
/// are furnished alike.
#[test]
fn looks_that_deceive_confuse_no_places() {
    let with = looked_at(open(9).painted(1, 1), Use::On, 1000).score();
    let without = looked_at(open(9).painted(1, 1), Use::Off, 1000).score();
    assert_eq!(with, without);
    for score in [with, looked_at(rooms(9, 3, 8, 1), Use::On, 1000).score()] {
        assert!((score.purity - 1.0).abs() < 1e-12, "{score:?}");
    }
    let score = looked_at(rooms(16, 4, 8, 1), Use::On, 1200).score();
    assert!((score.purity - 1.0).abs() < 1e-12, "{score:?}");
}

/// A wall is painted again: the place is still where it was, and is known by either look.
#[test]
fn the_view_set_of_a_place_that_looks_new_grows() {
    let mut errors = ODOMETRY;
    errors.look = 0.2;
    let mut walk = Walk::new(open(5).painted(5, 1), errors, painted(), 1);
    walk.heed(1.0, 400);
    assert_eq!(walk.score(), perfect(25));
    let views = |walk: &Walk| {
        let places = walk.observer.map().paths.places();
        places.map(|(_, place)| place.views.len()).sum::<usize>()
    };
    assert_eq!(views(&walk), 25);
    let world = walk.robot.world().clone().repainted(7, 5).repainted(18, 5);
    walk.robot.find_itself_in(world.into());
    walk.heed(0.3, 400);
    assert_eq!(walk.score(), perfect(25));
    assert_eq!(views(&walk), 27);
}

/// Doors shut and open for good, one by one: the map follows, and plans lead where they say.
#[test]
fn doors_that_move_are_followed() {
    let doors = [
        (6, Direction::East),
        (12, Direction::North),
        (17, Direction::West),
    ];
    let mut walk = Walk::new(open(5), ODOMETRY, alike(), 1);
    walk.heed(1.0, 400);
    assert_eq!(walk.score(), perfect(25));
    for (place, direction) in doors {
        let shut = walk.robot.world().clone().with_way(place, direction, None);
        walk.robot.find_itself_in(shut.into());
        // A random walk is at either side of the door every 20 to 40 moves.
        walk.wander(2000);
        let score = walk.score();
        let kept = (score.purity, score.places, score.link_precision);
        assert_eq!(kept, (1.0, 25, 1.0), "{place} {direction:?}");
    }
    assert_eq!(walk.observer.map().paths.links().count(), 80 - 6);
    walk.robot.find_itself_in(open(5).into());
    walk.heed(1.0, 200);
    assert_eq!(walk.observer.map().paths.links().count(), 80);
    assert_eq!(walk.score(), perfect(25));
}

/// No plan leads through a door that was seen shut, long before the link is elided. Once it was
/// seen open, plans use it again.
#[test]
fn no_plan_leads_through_a_door_that_was_seen_shut() {
    let mut walk = Walk::new(open(2), ODOMETRY, alike(), 1);
    walk.heed(1.0, 40);
    assert_eq!(walk.score(), perfect(4));
    while walk.robot.at() != 0 {
        walk.wander(1);
    }
    let (here, truths) = (walk.observer.place(), walk.truths());
    let east = truths.iter().find(|(_, truth)| **truth == 1).unwrap();
    let steps = |walk: &Walk| walk.observer.plan(here, *east.0).unwrap().len();
    assert_eq!(steps(&walk), 1);
    let shut = open(2).with_way(0, Direction::East, None);
    walk.robot.find_itself_in(shut.into());
    for direction in [Direction::North, Direction::South] {
        walk.go(direction);
    }
    assert_eq!(steps(&walk), 3);
    assert_eq!(walk.observer.map().paths.links().count(), 8);
    walk.robot.find_itself_in(open(2).into());
    for direction in [Direction::North, Direction::South] {
        walk.go(direction);
    }
    assert_eq!(steps(&walk), 1);
}

/// A door that comes and goes is planned through just after it was seen open; later, a way round
/// that never changed is better.
#[test]
fn plans_lead_round_a_door_that_may_have_moved() {
    let mut walk = Walk::new(open(2), ODOMETRY, alike(), 1);
    walk.heed(1.0, 40);
    assert_eq!(walk.score(), perfect(4));
    for change in 0..20 {
        let to = (change % 2 == 1).then_some(1);
        let world = walk.robot.world().clone();
        let world = world.with_way(0, Direction::East, to);
        walk.robot.find_itself_in(world.into());
        walk.wander(20);
    }
    let truths = walk.truths();
    let place = |place: u32| *truths.iter().find(|(_, truth)| **truth == place).unwrap().0;
    let steps = |walk: &Walk| {
        let plan = walk.observer.plan(place(0), place(1));
        plan.unwrap().len()
    };
    while walk.robot.at() != 0 {
        walk.wander(1);
    }
    assert_eq!(steps(&walk), 1);
    walk.go(Direction::North);
    assert_eq!(steps(&walk), 1);
    for _ in 0..30 {
        walk.go(Direction::East);
        walk.go(Direction::West);
    }
    assert_eq!(steps(&walk), 3);
}

/// A door that opens into the side of a corridor makes a place there, and the place behind it stays
/// where it was. A place that the robot goes past is gone.
#[test]
fn a_place_that_appears_hides_none_behind_it() {
    let at = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0)];
    let places = at.map(|(x, y)| Point::new(x, y)).to_vec();
    let corner = AbstractWorld::of_places(places, vec![[None; 4]; 4]).unwrap();
    let corner = corner.with_way(2, Direction::North, Some(3));
    let past = corner.clone().with_way(0, Direction::East, Some(2));
    let between = corner.with_way(0, Direction::East, Some(1));
    let between = between.with_way(1, Direction::East, Some(2));
    let mut walk = Walk::new(past.clone(), ODOMETRY, alike(), 1);
    let (north, east) = (Direction::North, Direction::East);
    for direction in [east, north, north.opposite(), east.opposite()] {
        walk.go(direction);
    }
    // The chance that the way from a true place leads to another.
    let chance = |walk: &Walk, from: u32, to: u32| {
        let (truths, paths) = (walk.truths(), &walk.observer.map().paths);
        let is = |link: &Link| [link.from, link.to].map(|end| truths[&end]) == [from, to];
        let id = paths.links().find(|(_, link)| is(link)).unwrap().0;
        paths.chance(id)
    };
    walk.robot.find_itself_in(between.into());
    walk.go(east);
    assert!(chance(&walk, 0, 2) < 0.01);
    assert!((chance(&walk, 3, 2) - 1.0).abs() < 1e-12);
    for direction in [east, east.opposite(), east.opposite()] {
        walk.go(direction);
    }
    assert!(chance(&walk, 2, 1) > 0.99);
    walk.robot.find_itself_in(past.into());
    walk.go(east);
    assert!(chance(&walk, 2, 1) < 0.01);
    assert!((chance(&walk, 3, 2) - 1.0).abs() < 1e-12);
    assert!((walk.score().purity - 1.0).abs() < 1e-12);
}

#[test]
fn an_error_of_scale_shared_by_all_moves_does_no_harm() {
    let mut errors = ODOMETRY;
    errors.distance = 0.02;
    errors.shared_scale = 0.1;
    let mut config = alike();
    config.shared_scale = 0.1;
    for seed in 0..3 {
        let mut walk = Walk::new(open(8), errors, config.clone(), seed);
        walk.heed(1.0, 1000);
        assert_eq!(walk.score(), perfect(64), "seed {seed}");
    }
}

#[test]
fn moves_that_break_their_bounds_are_told_and_confuse_no_places() {
    let mut errors = ODOMETRY;
    errors.outliers = 0.01;
    errors.outlier_factor = 4.0;
    let mut contradictions = 0;
    for seed in 0..4 {
        let mut walk = Walk::new(open(5), errors, alike(), seed);
        let mut planner = Scripted::new(0.3, seed);
        for _ in 0..1000 {
            let (_, report) = planner.go(&mut walk);
            contradictions += report.contradictions.len();
        }
        let score = walk.score();
        assert!(score.purity > 0.99, "seed {seed}: {score:?}");
        assert!(score.link_recall > 0.95, "seed {seed}: {score:?}");
    }
    assert!(contradictions > 4, "{contradictions}");
}

#[test]
fn outliers_on_known_ways_of_a_static_world_leave_every_place_once() {
    let mut errors = ODOMETRY;
    errors.outliers = 0.01;
    // They end where the next place is, or where they began.
    errors.outlier_factor = 10.0;
    let mut config = alike();
    config.actions = Config::corridor_actions();
    config.world = WorldKind::Static;
    config.apart = Apart::Side;
    let scores = (0..20).map(|seed| {
        let maze = blocks(6, 0.25, &mut ChaCha8Rng::seed_from_u64(seed));
        let world = AbstractWorld::from_maze(&maze, 1.0);
        let mut walk = Walk::new(world, errors, config.clone(), seed);
        walk.heed(0.3, 2000);
        walk.score()
    });
    let scores: Vec<Score> = scores.collect();
    let right = scores.iter().filter(|score| **score == perfect(36)).count();
    // Without the rules for static worlds none is right.
    assert!(right >= 15, "{right} of 20: {scores:?}");
}

#[test]
fn a_kidnapped_robot_is_found_again_by_what_it_sees() {
    let mut errors = ODOMETRY;
    errors.look = 0.2;
    for indexing in [PerceptualIndexing::Columns, PerceptualIndexing::Triangles] {
        let mut config = painted();
        config.indexing.perceptual = indexing;
        let mut found = 0;
        for seed in 0..10 {
            let world = open(7).painted(5, seed);
            let mut walk = Walk::new(world, errors, config.clone(), seed);
            walk.heed(1.0, 800);
            assert_eq!(walk.score(), perfect(49), "seed {seed}");
            let truths = walk.truths();
            walk.robot.kidnap(seed as u32 * 4);
            walk.wander(20);
            found += usize::from(truths.get(&walk.observer.place()) == Some(&walk.robot.at()));
        }
        assert!(found >= 8, "{indexing:?}: {found} of 10");
    }
}

#[test]
fn views_of_two_columns_have_no_triangles() {
    let mut config = painted();
    if let Percepts::Signatures(kind) = &mut config.percepts {
        kind.columns = 2;
    }
    assert_eq!(config.check(), Ok(()));
    config.indexing.perceptual = PerceptualIndexing::Triangles;
    let refused = DiktiometryConfigError::NoTriangles { columns: 2 };
    assert_eq!(config.check(), Err(refused));
}
