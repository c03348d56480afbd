//! Tests that scans give the right pose of a robot whose odometry is wrong.

use alloc::collections::BTreeSet;
use core::f64::consts::PI;

use proptest::prelude::*;
use tolman_geom::{Heading, Point, Pose};
use tolman_maps::scan_matching::{
    OccupancyGrid, ScanMatching, ScanMatchingConfig, ScanMatchingError, ScanStep,
};
use tolman_robot::{Mapper, Ring, Scan};
use tolman_sim::casters::BeamSweep;
use tolman_sim::{WallSegment, World};

use crate::pinned::pinned;

/// Returns a room with a niche and a pillar, so that no two places look alike.
fn room() -> World {
    let corners = [
        (0.0, 0.0),
        (7.0, 0.0),
        (7.0, 2.0),
        (8.0, 2.0),
        (8.0, 3.0),
        (7.0, 3.0),
        (7.0, 5.0),
        (0.0, 5.0),
        (0.0, 0.0),
    ];
    let pillar = [(2.0, 3.5), (2.6, 3.5), (2.6, 4.0), (2.0, 4.0), (2.0, 3.5)];
    let walls = [&corners[..], &pillar[..]].into_iter().flat_map(|corners| {
        let point = |(x, y): (f64, f64)| Point::new(x, y);
        corners
            .windows(2)
            .map(move |pair| WallSegment::between(point(pair[0]), point(pair[1])))
    });
    World::from_segments(walls.collect()).unwrap()
}

const RING: Ring = Ring {
    beams: 180,
    first_bearing: -0.5 * PI,
    spacing: PI / 180.0,
    max_range: 30.0,
};

fn scan(world: &World, pose: Pose) -> Scan {
    let mut sweep = BeamSweep::new(RING);
    sweep.aim(pose);
    world.caster().scan(&mut sweep);
    Scan {
        ring: RING,
        ranges: sweep.ranges().collect(),
    }
}

fn pose(x: f64, y: f64, degrees: f64) -> Pose {
    Pose::new(Point::new(x, y), Heading::from_degrees(degrees))
}

fn step(world: &World, moved: Pose, at: Pose) -> ScanStep {
    ScanStep {
        moved,
        scan: scan(world, at),
        robot_from_laser: Pose::IDENTITY,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn a_beam_contradicts_the_map_where_it_ends_on_floor(
        x in 0.5..6.5, y in 0.5..3.0, degrees in -180.0..180.0, off in -0.4..0.4, farthest in 2.0..9.0, wall in 0.1..0.7,
    ) {
        let world = room();
        let mut grid = OccupancyGrid::around([Point::new(-0.5, -0.5), Point::new(7.5, 5.5)].into_iter(), 0.1);
        for seen in [pose(3.0, 2.0, 0.0), pose(3.0, 2.0, 180.0), pose(5.0, 1.0, 90.0), pose(1.0, 4.0, -40.0)] {
            grid.add(&scan(&world, seen), seen, 9.0);
        }
        let shares: Vec<Option<f64>> = grid.occupancy().collect();
        let is_wall = |column: i64, row: i64| {
            let is_inside = (0..grid.columns as i64).contains(&column) && (0..grid.rows as i64).contains(&row);
            is_inside && shares[row as usize * grid.columns + column as usize].is_some_and(|share| share > wall)
        };
        let at = pose(x, y, degrees);
        let mut seen = scan(&world, at);
        // Some hit nothing, and one is what a broken laser says.
        seen.ranges[3] = RING.max_range;
        seen.ranges[7] = 0.0;
        let map_from_laser = pose(x + off, y - off, degrees);
        let (mut all, mut on_floor) = (0, 0);
        for (beam, range) in (0..).zip(&seen.ranges) {
            if *range <= 0.0 || *range >= farthest {
                continue;
            }
            let bearing = map_from_laser.heading.turned(RING.bearing(beam)).unit();
            let end = (map_from_laser.position + bearing * *range - grid.origin) / grid.cell;
            let (column, row) = (end.x.floor() as i64, end.y.floor() as i64);
            let near = (-1..=1).flat_map(|aside| (-1..=1).map(move |ahead| (column + aside, row + ahead)));
            all += 1;
            on_floor += usize::from(!near.into_iter().any(|(column, row)| is_wall(column, row)));
        }
        prop_assert_eq!(grid.contradicted(&seen, map_from_laser, farthest, wall), [all, on_floor]);
    }

    /// Cells are counted again, from points on the beam that lie much closer than cells are wide.
    #[test]
    fn a_beam_passes_the_cells_on_its_way_and_ends_in_the_last(
        x in 0.0..3.0, y in 0.0..3.0, bearing in -3.1..3.1, range in 0.2..2.5,
    ) {
        // Some beams leave the grid.
        let corners = [Point::new(0.0, 0.0), Point::new(3.0, 3.0)];
        let mut grid = OccupancyGrid::around(corners.into_iter(), 0.1);
        let ring = Ring { beams: 1, first_bearing: bearing, spacing: 0.1, max_range: 9.0 };
        let from = pose(x, y, 30.0);
        grid.add(&Scan { ring, ranges: vec![range] }, from, 8.0);
        let slot_beside = |along: f64, aside: [f64; 2]| {
            let at = from.position + from.heading.turned(bearing).unit() * along - grid.origin;
            let [column, row] = [at.x + aside[0], at.y + aside[1]].map(|along| (along / 0.1).floor());
            let is_inside = column >= 0.0 && row >= 0.0 && column < grid.columns as f64 && row < grid.rows as f64;
            is_inside.then(|| row as usize * grid.columns + column as usize)
        };
        let slot = |along: f64| slot_beside(along, [0.0; 2]);
        let along = |step: i32| range * f64::from(step) / 10_000.0;
        let met: Vec<Option<usize>> = (0..=10_000).map(|step| slot(along(step))).collect();
        // Those too whose corner the beam only touches.
        let corners = [[1e-3, 1e-3], [1e-3, -1e-3], [-1e-3, 1e-3], [-1e-3, -1e-3]];
        let near = (0..=10_000).flat_map(|step| corners.map(|aside| slot_beside(along(step), aside)));
        let touched: BTreeSet<usize> = near.flatten().collect();
        let (first, last) = (met[0], slot(range));
        for (index, share) in grid.occupancy().enumerate() {
            match share {
                // A beam may pass through the last cell only to end there.
                Some(share) if Some(index) == last => prop_assert!(share > 0.99),
                Some(share) => prop_assert!(share == 0.0 && touched.contains(&index)),
                None => prop_assert!(Some(index) != last && Some(index) != first),
            }
        }
        // What is left out was cut at a corner for less than half a cell.
        let told: Vec<bool> = grid.occupancy().map(|share| share.is_some()).collect();
        let passed: BTreeSet<usize> = met.iter().flatten().copied().collect();
        for cell in passed {
            let points = met.iter().filter(|met| **met == Some(cell)).count();
            let length = range * points as f64 / 10_000.0;
            prop_assert!(told[cell] || length < 0.051, "{length}");
        }
    }

    #[test]
    fn a_known_displacement_is_found_again(
        x in 2.0..5.0, y in 1.0..3.0, degrees in -180.0..180.0,
        ahead in 0.2..0.5, turn in -30.0..30.0, lie_x in -0.3..0.3, lie_y in -0.3..0.3, lie in -15.0..15.0,
    ) {
        let world = room();
        let from = pose(x, y, degrees);
        let moved = pose(ahead, 0.0, turn);
        let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
        mapper.observe(&step(&world, Pose::IDENTITY, from)).unwrap();
        let said = moved.compose(pose(lie_x, lie_y, lie));
        // A scan is not looked at as long as the wheels say that the robot has hardly moved.
        prop_assume!(said.position.coords.norm() > ScanMatchingConfig::indoor().step);
        mapper.observe(&step(&world, said, from.compose(moved))).unwrap();
        let found = mapper.trajectory()[1];
        let off = moved.between(found);
        prop_assert!(off.position.coords.norm() < 0.04, "{off:?}");
        prop_assert!(off.heading.degrees().abs() < 1.0, "{off:?}");
    }
}

/// Three rounds of a room, by wheels that turn two degrees a step too far.
#[test]
fn places_seen_again_keep_the_map_together() {
    let world = room();
    let at = |index: i32| {
        let turn = 0.15 * f64::from(index);
        let (sin, cos) = turn.sin_cos();
        pose(3.8 + 2.2 * cos, 2.2 + 1.0 * sin, 90.0 + turn.to_degrees())
    };
    let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
    let mut truth = Vec::new();
    for index in 0..130 {
        let before = at((index - 1).max(0));
        let moved = before.between(at(index)).compose(pose(0.0, 0.0, 2.0));
        mapper.observe(&step(&world, moved, at(index))).unwrap();
        truth.push(at(0).between(at(index)));
    }
    mapper.finish().unwrap();
    assert!(mapper.closures() > 5, "{}", mapper.closures());
    let trajectory = mapper.trajectory();
    let off = truth
        .iter()
        .zip(&trajectory)
        .map(|(truth, found)| (truth.position - found.position).norm());
    let worst = off.fold(0.0, f64::max);
    assert!(worst < 0.08, "{worst}");
    // What is occupied is a wall, as seen from the first pose.
    let ends = (0..130).flat_map(|index| {
        let laser = trajectory[index];
        scan(&world, at(index as i32))
            .ranges
            .into_iter()
            .zip(0..)
            .map(move |(range, beam)| {
                laser.transform(Point::from(
                    Heading::from_radians(RING.bearing(beam)).unit() * range,
                ))
            })
    });
    let mut grid = OccupancyGrid::around(ends, 0.1);
    for (index, laser) in trajectory.iter().enumerate() {
        grid.add(&scan(&world, at(index as i32)), *laser, 20.0);
    }
    let occupied: Vec<bool> = grid
        .occupancy()
        .map(|share| share.is_some_and(|share| share > 0.5))
        .collect();
    let walls = (0..occupied.len()).filter(|slot| occupied[*slot]);
    let mut far = 0;
    let mut count = 0;
    for slot in walls {
        let [column, row] = [slot % grid.columns, slot / grid.columns];
        let middle = |index: usize| (index as f64 + 0.5) * grid.cell;
        let there = grid.origin + tolman_geom::Vector::new(middle(column), middle(row));
        far += i32::from(world.nearest_wall_distance(at(0).transform(there)) > 0.2);
        count += 1;
    }
    assert!(count > 100 && far == 0, "{far} of {count}");
}

#[test]
fn what_is_no_scan_is_refused_and_changes_nothing() {
    let world = room();
    let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
    mapper
        .observe(&step(&world, Pose::IDENTITY, pose(2.0, 2.0, 0.0)))
        .unwrap();
    let nowhere = step(&world, pose(f64::NAN, 0.0, 0.0), pose(2.0, 2.0, 0.0));
    let refused = mapper.observe(&nowhere);
    assert_eq!(refused, Err(ScanMatchingError::NotFinite { scan: 1 }));
    let mut short = step(&world, pose(0.3, 0.0, 0.0), pose(2.3, 2.0, 0.0));
    short.scan.ranges.pop();
    let refused = mapper.observe(&short);
    let expected = ScanMatchingError::Ranges {
        scan: 1,
        found: 179,
        beams: 180,
    };
    assert_eq!(refused, Err(expected));
    assert_eq!(mapper.trajectory().len(), 1);
    // A laser that sees nothing leaves the robot to its wheels.
    for _ in 0..3 {
        let blind = ScanStep {
            moved: pose(0.5, 0.0, 0.0),
            scan: Scan::clear(RING),
            robot_from_laser: Pose::IDENTITY,
        };
        mapper.observe(&blind).unwrap();
    }
    assert!((mapper.trajectory()[3].position.x - 1.5).abs() < 1e-9);
}

#[test]
fn doubt_of_a_pose_grows_with_the_way_since_the_last_closure() {
    let world = room();
    let mut mapper = ScanMatching::new(ScanMatchingConfig::places());
    assert_eq!(mapper.doubt(0).to_bits(), 0.0_f64.to_bits());
    let ahead = pose(0.5, 0.0, 0.0);
    let mut at = pose(1.0, 1.0, 0.0);
    mapper.observe(&step(&world, Pose::IDENTITY, at)).unwrap();
    for _ in 0..8 {
        at = at.compose(ahead);
        mapper.observe(&step(&world, ahead, at)).unwrap();
    }
    let doubts: Vec<f64> = (0..mapper.keyframes().len())
        .map(|keyframe| mapper.doubt(keyframe))
        .collect();
    assert!(doubts.len() > 3, "{doubts:?}");
    assert!(
        doubts.is_sorted() && doubts[0] < doubts[doubts.len() - 1],
        "{doubts:?}"
    );
}

/// Two rounds of the room by wheels that lie, of which every figure is pinned; and another round on
/// the map of the first.
#[test]
fn a_run_by_scans_is_what_it_was() {
    let world = room();
    let at = |index: i32, aside: f64| {
        let turn = 0.15 * f64::from(index);
        let (sin, cos) = turn.sin_cos();
        let wide = 2.2 + aside + 0.2 * (3.0 * turn).sin();
        pose(
            3.8 + wide * cos,
            2.2 + (1.0 + aside) * sin,
            90.0 + turn.to_degrees(),
        )
    };
    let run = |rounds: i32, aside: f64, lie: f64| {
        let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
        for index in 0..42 * rounds {
            let before = at((index - 1).max(0), aside);
            let lies = pose(0.01 * lie, -0.01, lie);
            let moved = before.between(at(index, aside)).compose(lies);
            let step = ScanStep {
                robot_from_laser: pose(0.1, 0.02, 1.0),
                ..step(
                    &world,
                    moved,
                    at(index, aside).compose(pose(0.1, 0.02, 1.0)),
                )
            };
            mapper.observe(&step).unwrap();
        }
        mapper
    };
    let mut mapper = run(2, 0.0, 2.0);
    let mut figures = vec![format!("{:?}", mapper.keyframes())];
    let ring = Ring {
        beams: 24,
        first_bearing: 0.1,
        spacing: PI / 12.0,
        max_range: 9.0,
    };
    for finished in [false, true] {
        if finished {
            mapper.finish().unwrap();
        }
        let trajectory = mapper.trajectory();
        figures.extend(trajectory.iter().step_by(6).map(|pose| format!("{pose:?}")));
        for edge in mapper.graph().closures().step_by(4) {
            figures.push(format!("{} {} {:?}", edge.from, edge.to, edge.measured));
            figures.push(format!("{:?}", edge.information.as_slice()));
        }
        for keyframe in [0, 9, 25] {
            figures.push(format!("{:?}", mapper.doubt(keyframe)));
            figures.push(format!("{:?}", mapper.axis_about(keyframe)));
            let seen = mapper.surroundings(keyframe, ring, Heading::from_degrees(20.0));
            figures.push(format!("{:?}", seen.unwrap().ranges));
        }
        figures.push(format!("{:?} {:?}", mapper.axis(), mapper.belief()));
    }
    let other = run(1, -0.1, -1.0);
    figures.push(format!("{:?}", mapper.overlay(&other)));
    let odometry = mapper.graph().edges().iter().step_by(7);
    figures.extend(odometry.map(|edge| format!("{:?}", edge.information.as_slice())));
    let mut places = ScanMatching::new(ScanMatchingConfig::places());
    for index in 0..84 {
        let before = at((index - 1).max(0), 0.0);
        let moved = before.between(at(index, 0.0)).compose(pose(0.0, 0.0, 0.3));
        places
            .observe(&step(&world, moved, at(index, 0.0)))
            .unwrap();
    }
    let last = places.keyframes().len() - 1;
    for (here, there) in [
        (last, 2),
        (last - 1, 2),
        (last - 1, 1),
        (last, last),
        (3, last),
        (99, 0),
    ] {
        let matches = places.recognize(here, there).unwrap();
        figures.push(format!("{here} {there} {matches} {}", places.closures()));
    }
    figures.push(format!("{:?}", places.trajectory().last()));
    pinned("scan_matching", &figures);
}

/// A scan that met nothing has no surfaces, and no surfaces have no axis.
#[test]
fn a_map_without_surfaces_has_no_axis() {
    let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
    assert_eq!(mapper.axis(), None);
    let world = room();
    let mut seen = step(&world, Pose::IDENTITY, pose(2.0, 2.0, 0.0));
    seen.scan.ranges.fill(RING.max_range);
    mapper.observe(&seen).unwrap();
    assert_eq!(mapper.axis(), None);
    assert_eq!(mapper.axis_about(0), None);
}

/// Long rounds by maps of places, laid over each other.
#[test]
fn maps_laid_over_each_other_are_what_they_were() {
    let world = room();
    let run = |config: ScanMatchingConfig, first: i32, count: i32, lie: f64| {
        let at = |index: i32| {
            let turn = 0.09 * f64::from(first + index);
            let (sin, cos) = turn.sin_cos();
            let wide = 2.0 + 0.4 * (2.0 * turn).cos();
            pose(3.9 + wide * cos, 2.3 + 1.1 * sin, 90.0 + turn.to_degrees())
        };
        let mut mapper = ScanMatching::new(config);
        for index in 0..count {
            let before = at((index - 1).max(0));
            let moved = before
                .between(at(index))
                .compose(pose(0.005, 0.004 * lie, lie));
            mapper.observe(&step(&world, moved, at(index))).unwrap();
        }
        mapper.finish().unwrap();
        mapper
    };
    let mut figures = Vec::new();
    let [places, indoor] = [ScanMatchingConfig::places(), ScanMatchingConfig::indoor()];
    let maps = [
        run(places.clone(), 0, 160, 0.8),
        run(indoor, 20, 110, -1.2),
        run(places, 45, 60, 0.0),
    ];
    for map in &maps {
        figures.push(format!("{} {}", map.keyframes().len(), map.closures()));
        let trajectory = map.trajectory();
        let poses = trajectory.iter().step_by(17);
        figures.extend(poses.map(|pose| format!("{pose:?}")));
        let edges = map.graph().closures().step_by(5);
        figures.extend(edges.map(|edge| format!("{} {} {:?}", edge.from, edge.to, edge.measured)));
        let doubts = (0..map.keyframes().len()).step_by(9);
        figures.extend(doubts.map(|keyframe| map.doubt(keyframe).to_string()));
        let overlays = maps.each_ref().map(|other| map.overlay(other));
        figures.extend(overlays.map(|overlay| format!("{overlay:?}")));
    }
    pinned("scan_overlays", &figures);
}

/// A mapper's view has a place for each keyframe, and each edge both ways.
#[test]
fn the_view_of_a_map_is_its_graph() {
    let world = room();
    let mut mapper = ScanMatching::new(ScanMatchingConfig::indoor());
    let (mut at, ahead) = (pose(1.0, 1.0, 0.0), pose(0.4, 0.0, 3.0));
    mapper.observe(&step(&world, Pose::IDENTITY, at)).unwrap();
    for _ in 0..9 {
        at = at.compose(ahead);
        mapper.observe(&step(&world, ahead, at)).unwrap();
    }
    let view = Mapper::map(&mapper);
    let poses = mapper.graph().poses();
    assert!(poses.len() > 2);
    assert_eq!(view.places.len(), poses.len());
    for ((number, pose), place) in (0..).zip(poses).zip(&view.places) {
        assert_eq!((place.id, place.position), (number, Some(pose.position)));
        assert_eq!(place.landmark, None);
    }
    let ways: Vec<_> = view.links.iter().map(|link| (link.from, link.to)).collect();
    let edges = mapper.graph().edges().iter();
    let both = edges.flat_map(|edge| [(edge.from, edge.to), (edge.to, edge.from)]);
    assert_eq!(ways, both.collect::<Vec<_>>());
    let last = mapper.trajectory().last().unwrap().position;
    let believed = Mapper::belief(&mapper);
    assert_eq!(believed.len(), 1);
    assert_eq!(believed[0].at, tolman_robot::Position::Point(last));
}

/// A grid holds all its points, four cells off its border, and its corner lies on whole cells.
#[test]
fn a_grid_is_as_wide_as_its_points_and_a_margin() {
    for cell in [0.1, 0.25] {
        let points = [
            Point::new(-1.03, 2.0),
            Point::new(0.6, 4.31),
            Point::new(f64::NAN, 0.0),
        ];
        let grid = OccupancyGrid::around(points.into_iter(), cell);
        for (low, high, origin, count) in [
            (-1.03, 0.6, grid.origin.x, grid.columns),
            (2.0, 4.31, grid.origin.y, grid.rows),
        ] {
            let whole = origin / cell;
            assert!((whole - whole.round()).abs() < 1e-9, "{origin}");
            let (before, beyond) = (low - origin, origin + count as f64 * cell - high);
            for margin in [before, beyond] {
                assert!(
                    margin >= 4.0 * cell - 1e-9 && margin < 5.1 * cell,
                    "{margin} {cell}"
                );
            }
        }
        assert_eq!(grid.occupancy().count(), grid.columns * grid.rows);
        assert!(grid.occupancy().all(|share| share.is_none()));
    }
}
