//! The abstract world, in which mappers of places are tested, beside the robot in offices.

#[expect(dead_code, reason = "the tests of the mappers need more of it")]
#[path = "../../crates/maps/tests/it/diktiometry/abstract_world.rs"]
mod abstract_world;

use abstract_world::{AbstractRobot, AbstractWorld, MoveNoise};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_arena::diktiometry::{
    Office, OfficeConfig, SurveyorConfig, blocks, mapper, office_robot,
};
use tolman_geom::{Heading, Pose};
use tolman_maze::Direction;
use tolman_systems::diktiometry::{Rover, Surveyor};

/// Checks that the abstract world, in which mappers are tested a million times, has the statistics
/// of the robot.
#[test]
fn the_abstract_world_offers_the_same_statistics() {
    let seed = 8;
    let rng = || ChaCha8Rng::seed_from_u64(seed);
    let mut furniture = OfficeConfig::bare();
    (furniture.doorway_share, furniture.colours, furniture.seed) = (0.2, 5, seed);
    let office = Office::new(&blocks(6, 0.4, &mut rng()), &furniture).unwrap();
    let config = SurveyorConfig::paper();
    let truth = office.places(&[]);
    let number: Vec<u32> = truth.keys().copied().collect();
    let place = |site: u32| number.binary_search(&site).unwrap() as u32;
    let positions = truth.values().map(|place| place.position).collect();
    let ways = truth
        .values()
        .map(|there| there.ways.map(|way| way.map(place)));
    let world = AbstractWorld::of_places(positions, ways.collect()).unwrap();
    let mut errors = MoveNoise::NONE;
    errors.distance = config.odometry_share;
    errors.compass = config.compass_bound;
    errors.stop = 0.03;
    let mut ghost = AbstractRobot::new(world.into(), 0, errors, seed).unwrap();

    // Of each move: how wide the box is and how wrong its middle, a metre of way.
    let (mut real, mut ghostly) = (Vec::new(), Vec::new());
    let (mut at, mut before) = (number[0], truth[&number[0]].position);
    let pose = Pose::new(before, Heading::NORTH);
    let robot = office_robot(&office, &config, pose, seed).unwrap();
    let routines = office
        .diktiometer(&config, mapper(&office, &config))
        .routines;
    let mut rover = Surveyor::new(robot, config.sight, routines).unwrap();
    let mut rng = rng();
    for _ in 0..600 {
        let direction = Direction::ALL[rng.random_range(0_u32..4) as usize];
        let moved = rover.go(direction).unwrap().moved;
        let here = rover.robot().truth().pose.position;
        let truly = here - before;
        before = here;
        if let Some(to) = truth[&at].ways[direction.index()] {
            at = to;
            let miss = moved.middle().coords - truly;
            real.push([moved.width(), miss.norm()].map(|x| x / truly.norm()));
        }
    }
    for _ in 0..real.len() {
        let direction = ghost.wander().unwrap();
        let gone = ghost.go(direction).unwrap();
        let told = gone.odometry.position;
        let miss = told.middle().coords - gone.truth;
        ghostly.push([told.width(), miss.norm()].map(|x| x / gone.truth.norm()));
    }
    let means = |all: &[[f64; 2]]| {
        [0, 1].map(|i| all.iter().map(|one| one[i]).sum::<f64>() / all.len() as f64)
    };
    let (real, ghostly) = (means(&real), means(&ghostly));
    for (real, ghostly) in real.into_iter().zip(ghostly) {
        let ratio = real / ghostly;
        assert!((0.75..1.33).contains(&ratio), "{real} and {ghostly}");
    }
}
