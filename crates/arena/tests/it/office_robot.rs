//! The robot of the offices: what it senses at the true places, and between them.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_arena::diktiometry::{
    Office, OfficeConfig, OfficeRobot, SurveyorConfig, TruePlace, blocks, mapper, office_robot,
};
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::diktiometry::{MoveOutcome, Signature};
use tolman_maze::Direction;
use tolman_sim::DoorState;
use tolman_systems::diktiometry::{Arrival, Rover, Surveyor};

fn office(seed: u64, doorway_share: f64) -> Office {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let maze = blocks(6, 0.4, &mut rng);
    let mut config = OfficeConfig::bare();
    config.doorway_share = doorway_share;
    config.colours = 5;
    config.seed = seed;
    Office::new(&maze, &config).unwrap()
}

/// Walks at random. At every arrival, calls back with the places left and reached, the arrival
/// and the robot.
fn walk(
    office: &Office,
    shut: &[usize],
    moves: u32,
    seed: u64,
    mut see: impl FnMut(&TruePlace, &TruePlace, &Arrival, &OfficeRobot),
) {
    let places = office.places(shut);
    let mut at = *places.first_key_value().unwrap().0;
    let config = SurveyorConfig::paper();
    let pose = Pose::new(places[&at].position, Heading::NORTH);
    let mut robot = office_robot(office, &config, pose, seed).unwrap();
    for leaf in shut.iter().flat_map(|number| Office::leaves(*number)) {
        robot.set_door(&leaf, DoorState::Shut).unwrap();
    }
    let routines = office
        .diktiometer(&config, mapper(office, &config))
        .routines;
    let mut rover = Surveyor::new(robot, config.sight, routines).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    for _ in 0..moves {
        let direction = Direction::ALL[rng.random_range(0_u32..4) as usize];
        let arrival = rover.go(direction).unwrap();
        let way = places[&at].ways[direction.index()];
        let expected = match way {
            Some(_) => MoveOutcome::Arrived,
            None => MoveOutcome::Blocked,
        };
        assert_eq!(
            arrival.outcome, expected,
            "{direction} of {:?}",
            places[&at]
        );
        let from = at;
        at = way.unwrap_or(at);
        see(&places[&from], &places[&at], &arrival, rover.robot());
    }
}

#[test]
fn routines_end_at_the_true_places() {
    for (seed, doorways) in [(1, 0.0), (2, 0.3), (3, 1.0)] {
        let office = office(seed, doorways);
        walk(&office, &[], 300, seed, |_, to, arrival, robot| {
            let miss = (robot.truth().pose.position - to.position).abs().max();
            assert!(
                miss < SurveyorConfig::paper().place_radius,
                "{miss} m from {to:?}"
            );
            assert_eq!(arrival.exits, to.ways.map(|way| way.is_some()), "{to:?}");
        });
    }
}

#[test]
fn the_true_way_is_inside_the_box() {
    let office = office(4, 0.3);
    let mut widths = Vec::new();
    let places = office.places(&[]);
    let mut before = places.first_key_value().unwrap().1.position;
    walk(&office, &[], 300, 4, |from, to, arrival, robot| {
        let here = robot.truth().pose.position;
        let moved = here - before;
        before = here;
        assert!(
            arrival.moved.contains(Point::origin() + moved),
            "{moved:?} {arrival:?}"
        );
        let way = (to.position - from.position).norm();
        if way > 0.0 {
            widths.push(arrival.moved.width() / way);
        }
    });
    assert!(
        widths.iter().all(|width| *width < 0.45),
        "boxes say something: {widths:?}"
    );
}

#[test]
fn a_shut_doorway_is_a_wall() {
    let office = office(5, 0.4);
    let shut: Vec<usize> = (0..office.doorways()).step_by(3).collect();
    walk(&office, &shut, 200, 5, |_, to, arrival, _| {
        assert_eq!(arrival.exits, to.ways.map(|way| way.is_some()));
    });
}

#[test]
fn a_place_looks_the_same_from_wherever_one_comes() {
    let office = office(6, 0.2);
    let mut seen: Vec<(Point, Signature)> = Vec::new();
    walk(&office, &[], 300, 6, |_, to, arrival, _| {
        seen.push((to.position, arrival.look.clone().unwrap()));
    });
    let alike = |a: &Signature, b: &Signature| {
        let same = |column: &usize| {
            let mut pairs = a.column(*column).iter().zip(b.column(*column));
            pairs.all(|(a, b)| (a - b).abs() < 0.15)
        };
        (0..a.columns()).filter(same).count() as f64 / a.columns() as f64
    };
    let (mut same, mut other) = (Vec::new(), Vec::new());
    for (i, (here, a)) in seen.iter().enumerate() {
        for (there, b) in &seen[..i] {
            let near = (here - there).norm() < 1e-9;
            if near { &mut same } else { &mut other }.push(alike(a, b));
        }
    }
    let mean = |shares: &[f64]| shares.iter().sum::<f64>() / shares.len() as f64;
    assert!(mean(&same) > 0.8, "{}", mean(&same));
    assert!(mean(&other) < 0.45, "{}", mean(&other));
}
