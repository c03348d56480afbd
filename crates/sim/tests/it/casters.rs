//! Every caster against parry2d's polyline.

use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_robot::Ring;
use tolman_sim::WallSegment;
use tolman_sim::casters::{BeamSweep, Caster, Lanes, LatticeWalk, ParryPolyline, WallIndex};

use crate::worlds;

/// Maximum difference of the ranges of two casters, m.
const CLOSE: f64 = 1e-9;

/// Ranges that rays may read in a world of walls, by parry2d.
///
/// Where a ray passes the end of a wall closely, a caster may see the end or what lies behind it.
/// The range is at least that of slightly longer walls and at most that of slightly shorter ones.
/// That no ray slips through where walls meet is a test of its own.
struct Reference {
    longer: ParryPolyline,
    shorter: ParryPolyline,
}

impl Reference {
    fn new(walls: &[WallSegment]) -> Self {
        let by = |length: f64| {
            let walls: Vec<WallSegment> = walls
                .iter()
                .map(|wall| {
                    let along = (wall.end - wall.start).normalize() * length;
                    WallSegment::between(wall.start - along, wall.end + along)
                })
                .collect();
            ParryPolyline::new(&walls)
        };
        Self {
            longer: by(2.0 * CLOSE),
            shorter: by(-2.0 * CLOSE),
        }
    }

    fn check(
        &self,
        origin: Point,
        direction: Vector,
        max_range: f64,
        range: f64,
    ) -> Result<(), TestCaseError> {
        // Along a wall that is nearly parallel, a hair to the side is a long way.
        let aside = Vector::new(-direction.y, direction.x) * CLOSE;
        let origins = [origin, origin + aside, origin - aside];
        let read = |caster: &ParryPolyline| {
            origins.map(|origin| caster.cast(origin, direction, max_range))
        };
        let least = read(&self.longer).into_iter().fold(f64::INFINITY, f64::min) - CLOSE;
        let most = read(&self.shorter).into_iter().fold(0.0, f64::max) + CLOSE;
        prop_assert!(
            (least..=most).contains(&range),
            "{origin} towards {direction}: {range}, parry {least} to {most}"
        );
        Ok(())
    }
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
        let reference = Reference::new(world.walls());
        let direction = heading.unit();
        let index = WallIndex::new(world.walls(), Lanes::Baseline);
        for caster in [world.caster(), &index] {
            let range = caster.cast(point, direction, max_range);
            reference.check(point, direction, max_range, range)?;
        }
    }

    #[test]
    fn sweeps_agree(
        (world, point) in worlds::world_and_point(),
        heading in heading(),
        ring in ring(),
    ) {
        let reference = Reference::new(world.walls());
        let index = WallIndex::new(world.walls(), Lanes::Baseline);
        let mut sweep = BeamSweep::new(ring);
        for caster in [world.caster(), &index] {
            sweep.aim(Pose::new(point, heading));
            caster.scan(&mut sweep);
            for beam in 0..sweep.beams() {
                reference.check(point, sweep.direction(beam), ring.max_range, sweep.range(beam))?;
            }
        }
        // Walls drawn one by one, as doors are.
        sweep.aim(Pose::new(point, heading));
        for wall in world.walls() {
            sweep.meet_wall(wall);
        }
        for beam in 0..sweep.beams() {
            reference.check(point, sweep.direction(beam), ring.max_range, sweep.range(beam))?;
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
        let mut sweep = BeamSweep::new(ring);
        for pair in casters {
            let [baseline, widest] = pair.map(|caster| {
                sweep.aim(Pose::new(point, heading));
                caster.scan(&mut sweep);
                sweep.ranges().map(f64::to_bits).collect::<Vec<_>>()
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
        let mut sweep = BeamSweep::new(Ring::full(72, max_range));
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
        let mut sweep = BeamSweep::new(ring);
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

proptest! {
    /// Two walls that meet on either side of a ray stop it, however exactly it is aimed at the
    /// joint.
    #[test]
    fn a_ray_into_a_joint_does_not_leak(
        joint in worlds::point(),
        origin in worlds::point(),
        left in (0.01..3.1_f64, 0.01..4.0_f64),
        right in (0.01..3.1_f64, 0.01..4.0_f64),
        ring in ring(),
    ) {
        let to_joint = joint - origin;
        prop_assume!(to_joint.norm() > 1e-3);
        let ahead = Heading::of(to_joint);
        let wall = |turn: f64, length: f64| {
            WallSegment::between(joint, joint + ahead.turned(turn).unit() * length)
        };
        let walls = [wall(left.0, left.1), wall(-right.0, right.1)];
        let index = WallIndex::new(&walls, Lanes::Baseline);
        let range = index.cast(origin, to_joint.normalize(), 100.0);
        prop_assert!(range <= to_joint.norm() + CLOSE, "{range} of {}", to_joint.norm());
        let mut sweep = BeamSweep::new(Ring { first_bearing: 0.0, max_range: 100.0, ..ring });
        sweep.aim(Pose::new(origin, ahead));
        index.scan(&mut sweep);
        prop_assert!(sweep.range(0) <= to_joint.norm() + CLOSE);
    }
}

#[test]
fn rays_from_anywhere_end() {
    let wall = WallSegment::between(Point::new(0.0, -1.0), Point::new(0.0, 1.0));
    let index = WallIndex::new(&[wall], Lanes::Baseline);
    let west = Vector::new(-1.0, 0.0);
    for away in [1e3, 1e6] {
        let range = index.cast(Point::new(away, 0.5), west, f64::INFINITY);
        assert!((range - away).abs() < CLOSE * away, "{range}");
    }
    for x in [1e17, 1e200, 1e308, f64::INFINITY, f64::NAN] {
        for max_range in [5.0, 1e17, f64::INFINITY] {
            // What it reads does not matter; a range that is not a number would.
            let range = index.cast(Point::new(x, 0.5), west, max_range);
            assert!(range >= 0.0, "{range} from {x}");
            assert!(index.cast(Point::new(3.0, 0.5), Vector::new(x, x), max_range) >= 0.0);
        }
    }
}
