//! Beliefs about walls, and where a mouse is among them, against the simulator's truth.

use core::f64::consts::FRAC_PI_2;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::wall_belief::{
    PoseFilter, PoseFilterConfig, RangeModel, RangeReading, WallBelief,
};
use tolman_maze::{Braided, Cell, Direction, Grid, Knowledge, Maze, Walls};
use tolman_sim::{CorridorSize, World};

use crate::pinned::pinned;

const SIZE: CorridorSize = CorridorSize {
    corridor_width: 0.168,
    wall_thickness: 0.012,
};
const MAX_RANGE: f64 = 1.0;

fn maze(seed: u64) -> Maze {
    let braided = Braided {
        width: 8,
        height: 8,
        share: 0.5,
    };
    braided
        .generate(&mut ChaCha8Rng::seed_from_u64(seed))
        .unwrap()
}

/// Returns the readings of perfect sensors to all four sides.
fn readings(world: &World, pose: Pose) -> [RangeReading; 4] {
    [0.0, 1.0, 2.0, 3.0].map(|quarters| {
        let bearing = quarters * FRAC_PI_2;
        let unit = pose.heading.turned(bearing).unit();
        // Nothing is nearer than the nearest wall: so far the ray can go at once.
        let mut range = 0.0;
        while range < MAX_RANGE {
            let free = world.nearest_wall_distance(pose.position + unit * range);
            if free < 1e-6 {
                break;
            }
            range += free;
        }
        RangeReading {
            bearing,
            range: range.min(MAX_RANGE),
            max_range: MAX_RANGE,
        }
    })
}

fn seen_from_everywhere(maze: &Maze, world: &World, looks: u8) -> WallBelief<8> {
    let mut belief = WallBelief::new(maze.grid(), SIZE.pitch(), SIZE.wall_thickness).unwrap();
    for cell in maze.grid().cells() {
        let pose = Pose::new(belief.middle(cell), Heading::EAST);
        for reading in readings(world, pose) {
            for _ in 0..looks {
                belief.observe(pose, reading, &SENSOR);
            }
        }
    }
    belief
}

#[test]
fn what_is_seen_well_is_known_rightly() {
    for seed in 0..3 {
        let maze = maze(seed);
        let world = World::from_maze(&maze, &SIZE).unwrap();
        let belief = seen_from_everywhere(&maze, &world, 2);
        for cell in maze.grid().cells() {
            for side in Direction::ALL {
                let truth = maze.knowledge(cell, side);
                assert_eq!(belief.knowledge(cell, side), truth, "{cell} {side}");
            }
        }
    }
}

#[test]
fn a_wrong_belief_is_given_up() {
    let mut belief = WallBelief::<8>::new(Grid::new(3, 1), 0.18, 0.012).unwrap();
    let pose = Pose::new(Point::new(0.09, 0.09), Heading::EAST);
    let reading = |range| RangeReading {
        bearing: 0.0,
        range,
        max_range: MAX_RANGE,
    };
    let side = (Cell::new(0, 0), Direction::East);
    for _ in 0..100 {
        belief.observe(pose, reading(0.084), &SENSOR);
    }
    assert_eq!(belief.knowledge(side.0, side.1), Knowledge::Wall);
    for _ in 0..8 {
        belief.observe(pose, reading(0.264), &SENSOR);
    }
    assert_eq!(belief.knowledge(side.0, side.1), Knowledge::Open);
    // What ends between two lines says nothing of the farther one, what is oblique or no number
    // says nothing at all.
    belief.observe(pose, reading(0.35), &SENSOR);
    assert_eq!(
        belief.knowledge(Cell::new(1, 0), Direction::East),
        Knowledge::Wall
    );
    let before = belief.clone();
    belief.observe(pose, reading(f64::NAN), &SENSOR);
    let oblique = Pose::new(pose.position, Heading::from_degrees(30.0));
    belief.observe(oblique, reading(0.1), &SENSOR);
    assert_eq!(belief, before);
}

const FILTER: PoseFilterConfig = {
    let mut config = PoseFilterConfig::for_pitch(0.1);
    config.particles = 300;
    config.slip = 0.1;
    config.drift = 0.2;
    config.spread = 0.001;
    config.sensor = SENSOR;
    config
};

const SENSOR: RangeModel = RangeModel {
    absolute: 0.005,
    relative: 0.01,
    outliers: 0.1,
};

#[test]
fn particles_gather_where_the_mouse_is() {
    let maze = maze(1);
    let world = World::from_maze(&maze, &SIZE).unwrap();
    let belief = seen_from_everywhere(&maze, &world, 2);
    let truth = Pose::new(belief.middle(Cell::new(2, 3)), Heading::NORTH);
    // It thinks it is 4 cm off.
    let wrong = Pose::new(truth.position + Vector::new(0.03, -0.03), truth.heading);
    let mut filter = PoseFilter::new(FILTER, wrong).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let seen = readings(&world, truth);
    for _ in 0..40 {
        // Jitter: it is told to go forth and back, and does not move.
        filter.drive(0.01, 0.05, &mut rng);
        filter.drive(-0.01, -0.05, &mut rng);
        filter.sense(&belief, &seen, &mut rng);
    }
    assert!((filter.estimate().position - truth.position).norm() < 0.01);
}

#[test]
fn particles_in_two_cells_agree_when_the_cells_turn_out_to_differ() {
    // Two corridors side by side, one of three cells and one of two.
    let text = "+---+---+---+\n| S       G |\n+---+---+---+\n|       |   |\n+---+---+---+";
    let maze = tolman_maze::read(text).unwrap().maze;
    let world = World::from_maze(&maze, &SIZE).unwrap();
    let belief = seen_from_everywhere(&maze, &world, 2);
    let [long, short] = [1, 0].map(|row| belief.middle(Cell::new(0, row)));
    let poses = [long, short].map(|middle| vec![Pose::new(middle, Heading::EAST); 100]);
    let mut filter = PoseFilter::new(FILTER, Pose::IDENTITY).unwrap();
    filter.spread(poses.concat());
    let (_, before) = filter.likeliest(belief.pitch());
    assert!((before - 0.5).abs() < 1e-9);
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let truth = Pose::new(long, Heading::EAST);
    filter.sense(&belief, &readings(&world, truth), &mut rng);
    let (pose, weight) = filter.likeliest(belief.pitch());
    assert!(
        weight > 0.95 && (pose.position - long).norm() < 1e-9,
        "{weight}"
    );
    filter.gather(&mut rng);
    assert!((filter.estimate().position - long).norm() < 0.2 * belief.pitch());
}

#[test]
fn without_walls_the_mean_goes_where_the_wheels_are_told() {
    let start = Pose::new(Point::new(0.5, 0.5), Heading::EAST);
    let mut filter = PoseFilter::new(FILTER, start).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    for _ in 0..20 {
        filter.drive(0.01, 0.0, &mut rng);
    }
    let off = filter.estimate().position - Point::new(0.7, 0.5);
    assert!(off.norm() < 0.01);
    filter.place(start);
    assert!((filter.estimate().position - start.position).norm() < 1e-12);
}

#[test]
fn numbers_out_of_range_are_refused() {
    let refused = |change: fn(&mut PoseFilterConfig)| {
        let mut config = FILTER;
        change(&mut config);
        PoseFilter::new(config, Pose::IDENTITY).map_err(|error| error.field)
    };
    assert!(refused(|_| ()).is_ok());
    assert_eq!(
        refused(|config| config.particles = 0).unwrap_err(),
        "particles"
    );
    assert_eq!(
        refused(|config| config.sensor.absolute = 0.0).unwrap_err(),
        "sensor.absolute"
    );
    assert_eq!(
        refused(|config| config.slip = f64::NAN).unwrap_err(),
        "slip"
    );
    assert_eq!(
        refused(|config| config.sensor.outliers = 1.5).unwrap_err(),
        "sensor.outliers"
    );
    assert!(WallBelief::<8>::new(Grid::new(9, 2), 0.18, 0.012).is_err());
}

/// A mouse that drives through a maze: every figure is pinned.
#[test]
fn a_run_among_particles_is_what_it_was() {
    let maze = maze(3);
    let world = World::from_maze(&maze, &SIZE).unwrap();
    let mut belief = WallBelief::<8>::new(maze.grid(), SIZE.pitch(), SIZE.wall_thickness).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut truth = Pose::new(belief.middle(Cell::new(2, 2)), Heading::from_degrees(91.0));
    let mut filter = PoseFilter::new(FILTER, truth).unwrap();
    let mut figures = Vec::new();
    for step in 0..24 {
        let (distance, turn) = if step % 4 == 3 {
            (0.02, 0.8)
        } else {
            (0.03, -0.05)
        };
        let free = world.nearest_wall_distance(truth.position);
        let distance = if free < 0.04 { 0.0 } else { distance };
        truth = truth.displaced(distance, turn);
        filter.drive(distance, turn, &mut rng);
        let seen = readings(&world, truth);
        filter.sense(&belief, &seen, &mut rng);
        let estimate = filter.estimate();
        for reading in seen {
            belief.observe(estimate, reading, &SENSOR);
        }
        if step == 10 {
            belief.doubt_walls();
            belief.bump(Cell::new(0, 0), Direction::North);
        }
        figures.push(format!("{estimate:?} {:?}", filter.likeliest(0.18)));
        let heading = Heading::from_degrees(37.0 * f64::from(step));
        let meetings: Vec<_> = belief.meetings(truth.position, heading, 0.9).collect();
        figures.push(format!("{meetings:?}"));
    }
    figures.push(format!("{belief:?}"));
    pinned("wall_belief", &figures);
}
