//! Every caster against parry2d's polyline.

use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::Ring;
use tolman_sim::Wall;
use tolman_sim::casters::{Caster, Lanes, LatticeWalk, ParryPolyline, Sweep, WallIndex};

use crate::worlds;

/// How closely casters agree, m.
const CLOSE: f64 = 1e-9;

/// Where a ray passes the free end of a wall this closely, a caster may see the end or what lies
/// behind it: what is seen from either side.
fn check(
    reference: &ParryPolyline,
    origin: Point,
    direction: Vector,
    max_range: f64,
    range: f64,
) -> Result<(), TestCaseError> {
    let aside = Vector::new(-direction.y, direction.x) * CLOSE;
    let seen = [Vector::zeros(), aside, -aside]
        .map(|aside| reference.cast(origin + aside, direction, max_range));
    let least = seen.into_iter().fold(f64::INFINITY, f64::min) - CLOSE;
    let most = seen.into_iter().fold(0.0, f64::max) + CLOSE;
    prop_assert!(
        (least..=most).contains(&range),
        "{origin} towards {direction}: {range}, parry {seen:?}"
    );
    Ok(())
}

fn heading() -> impl Strategy<Value = Heading> {
    prop_oneof![
        (-4.0..4.0).prop_map(Heading::from_radians),
        (-8_i32..=8).prop_map(|eighth| Heading::from_degrees(45.0 * f64::from(eighth))),
    ]
}

fn ring() -> impl Strategy<Value = Ring> {
    (
        1_u32..200,
        -4.0..4.0,
        0.1..1.0,
        prop_oneof![0.1..3.0, 3.0..40.0],
    )
        .prop_map(|(beams, first_bearing, share, max_range)| {
            let spacing = share * core::f64::consts::TAU / f64::from(beams);
            Ring {
                beams,
                first_bearing,
                spacing,
                max_range,
            }
        })
}

proptest! {
    #[test]
    fn single_rays_agree(
        (world, point) in worlds::world_and_point(),
        heading in heading(),
        max_range in 0.1..20.0_f64,
    ) {
        let reference = ParryPolyline::new(world.walls());
        let direction = heading.unit();
        let index = WallIndex::new(world.walls(), Lanes::Baseline);
        for caster in [world.caster(), &index] {
            let range = caster.cast(point, direction, max_range);
            check(&reference, point, direction, max_range, range)?;
        }
    }

    #[test]
    fn sweeps_agree(
        (world, point) in worlds::world_and_point(),
        heading in heading(),
        ring in ring(),
    ) {
        let reference = ParryPolyline::new(world.walls());
        let index = WallIndex::new(world.walls(), Lanes::Baseline);
        let mut sweep = Sweep::new(ring);
        for caster in [world.caster(), &index] {
            sweep.aim(Pose::new(point, heading));
            caster.scan(&mut sweep);
            for beam in 0..sweep.beams() {
                check(&reference, point, sweep.direction(beam), ring.max_range, sweep.range(beam))?;
            }
        }
        // Walls drawn one by one, as doors are.
        sweep.aim(Pose::new(point, heading));
        for wall in world.walls() {
            sweep.meet_wall(wall);
        }
        for beam in 0..sweep.beams() {
            check(&reference, point, sweep.direction(beam), ring.max_range, sweep.range(beam))?;
        }
    }

    #[test]
    fn more_lanes_give_the_same_bits(
        (world, point) in worlds::world_and_point(),
        heading in heading(),
        ring in ring(),
    ) {
        let mut casters: Vec<[Box<dyn Caster>; 2]> = vec![[Lanes::Baseline, Lanes::Widest]
            .map(|lanes| Box::new(WallIndex::new(world.walls(), lanes)) as Box<dyn Caster>)];
        if let (Some(baseline), Some(widest)) =
            (LatticeWalk::new(&world, Lanes::Baseline), LatticeWalk::new(&world, Lanes::Widest))
        {
            casters.push([Box::new(baseline), Box::new(widest)]);
        }
        let mut sweep = Sweep::new(ring);
        for pair in casters {
            let [baseline, widest] = pair.map(|caster| {
                sweep.aim(Pose::new(point, heading));
                caster.scan(&mut sweep);
                sweep.ranges().iter().map(|range| range.to_bits()).collect::<Vec<_>>()
            });
            prop_assert_eq!(baseline, widest);
        }
    }

    /// The lattice walk computes all crossings of a short beam at once and walks a long one: the
    /// same numbers.
    #[test]
    fn short_beams_and_walked_rays_give_the_same_bits(
        (world, point) in worlds::with_point(worlds::maze_world()),
        heading in heading(),
        max_range in 0.1..4.0_f64,
    ) {
        let mut sweep = Sweep::new(Ring::full(72, max_range));
        sweep.aim(Pose::new(point, heading));
        world.caster().scan(&mut sweep);
        for beam in 0..sweep.beams() {
            let walked = world.caster().cast(point, sweep.direction(beam), max_range);
            prop_assert_eq!(walked.to_bits(), sweep.range(beam).to_bits());
        }
    }

    #[test]
    fn the_nearest_wall_is_the_nearest_of_all(world in worlds::world(), point in worlds::point()) {
        let all = world.walls().iter().map(|wall| wall.distance(point));
        let nearest = all.fold(f64::INFINITY, f64::min);
        prop_assert!((world.nearest_wall_distance(point) - nearest).abs() < 1e-12);
        let far = point + Vector::new(1e4, -1e4);
        let all = world.walls().iter().map(|wall| wall.distance(far));
        prop_assert!((world.nearest_wall_distance(far) - all.fold(f64::INFINITY, f64::min)).abs() < 1e-9);
    }

    #[test]
    fn a_disc_shortens_the_beams_that_meet_it(
        point in worlds::point(),
        heading in heading(),
        ring in ring(),
        centre in worlds::point(),
        radius in 0.01..2.0_f64,
    ) {
        let to_centre = centre - point;
        prop_assume!(to_centre.norm() > radius + 1e-6);
        let mut sweep = Sweep::new(ring);
        sweep.aim(Pose::new(point, heading));
        sweep.meet_disc(centre, radius);
        for beam in 0..sweep.beams() {
            let direction = sweep.direction(beam);
            let (ahead, aside) = (direction.dot(&to_centre), direction.perp(&to_centre));
            let square = radius * radius - aside * aside;
            prop_assume!(square.abs() > 1e-6);
            let range = if square > 0.0 && ahead > 0.0 { ahead - square.sqrt() } else { f64::INFINITY };
            prop_assert!((sweep.range(beam) - range.min(ring.max_range)).abs() < 1e-8);
        }
    }
}

#[test]
fn a_ray_into_a_joint_does_not_leak() {
    let corner = Point::new(3.0, 1.0);
    let walls = [
        Wall::between(Point::new(3.0, 0.0), corner),
        Wall::between(corner, Point::new(2.0, 2.0)),
    ];
    let index = WallIndex::new(&walls, Lanes::Baseline);
    for x in 0..200 {
        let origin = Point::new(f64::from(x) * 0.013 - 0.1, 0.9 - f64::from(x) * 0.0041);
        let direction = (corner - origin).normalize();
        let range = index.cast(origin, direction, 10.0);
        assert!(
            (range - (corner - origin).norm()).abs() < 1e-9,
            "{origin}: {range}"
        );
    }
}
