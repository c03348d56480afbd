//! A robot wanders through a room with wheels that are out of calibration, and maps places.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maps::geom::{Heading, Point, Pose, Vector};
use tolman_maps::place_graph::{
    Outline, PlaceGraph, PlaceGraphConfig, PlaceGraphError, SeenThere, foot_line,
};
use tolman_robot::pioneer_2dx::CAMERA;
use tolman_robot::{Mapper, Odometry, Picture, Snapshot, Sounding};
use tolman_sim::{WallSegment, World};

use crate::pinned::pinned;

fn room() -> World {
    let corners = [
        (0.0, 0.0),
        (5.0, 0.0),
        (5.0, 2.0),
        (3.5, 2.0),
        (3.5, 4.0),
        (0.0, 4.0),
    ];
    let point = |(x, y): (f64, f64)| Point::new(x, y);
    let next = corners.iter().cycle().skip(1);
    let walls = corners
        .iter()
        .zip(next)
        .map(|(a, b)| WallSegment::between(point(*a), point(*b)));
    World::from_segments(walls.collect()).unwrap()
}

/// A robot whose wheels say something else than the truth.
struct Wanderer {
    world: World,
    truth: Pose,
    reckoned: Pose,
    scale: f64,
    curvature: f64,
    rolled: Vec<Odometry>,
    rng: ChaCha8Rng,
}

impl Wanderer {
    fn new(seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let start = Pose::new(
            Point::new(1.0, 1.0),
            Heading::from_radians(rng.random_range(-3.0..3.0)),
        );
        Self {
            world: room(),
            truth: start,
            reckoned: start,
            scale: rng.random_range(-0.03..0.03),
            curvature: rng.random_range(-0.15..0.15),
            rolled: Vec::new(),
            rng,
        }
    }

    fn noise(&mut self, deviation: f64) -> f64 {
        // Twelve evenly spread numbers are normal enough.
        let sum: f64 = (0..12).map(|_| self.rng.random_range(-0.5..0.5)).sum();
        deviation * sum
    }

    fn step(&mut self, distance: f64, turn: f64) {
        let step = Odometry { distance, turn };
        self.rolled.push(step);
        self.reckoned = step.applied_to(self.reckoned);
        let slip = self.noise(0.02 * distance.abs().sqrt());
        let skid = self.noise(0.02 * (distance.abs() + turn.abs()).sqrt());
        let distance_truly = distance * (1.0 + self.scale) + slip;
        let turn_truly = turn * (1.0 + self.scale) + distance * self.curvature + skid;
        self.truth = self.truth.displaced(distance_truly, turn_truly);
    }

    /// Turns a little, or goes on a little where there is room.
    fn move_on(&mut self) {
        let ahead = self.range(0.0);
        if ahead < 0.9 || self.rng.random_range(0..6) == 0 {
            let turn = self.rng.random_range(0.2..0.6);
            let sign = if self.range(0.6) > self.range(-0.6) {
                1.0
            } else {
                -1.0
            };
            self.step(0.0, sign * turn);
        } else {
            for _ in 0..4 {
                self.step(0.1, 0.0);
            }
        }
    }

    fn range(&self, bearing: f64) -> f64 {
        let direction = self.truth.heading.turned(bearing).unit();
        self.world
            .caster()
            .cast(self.truth.position, direction, 6.0)
    }

    fn see(&mut self) -> SeenThere {
        let mut soundings = Vec::new();
        for degrees in (-120..=120).step_by(4) {
            let bearing = f64::from(degrees).to_radians();
            soundings.push(Sounding {
                mount: Pose::new(Point::origin(), Heading::from_radians(bearing)),
                half_width: 0.0,
                range: self.range(bearing) + self.noise(0.02),
                max_range: 6.0,
            });
        }
        SeenThere {
            rolled: core::mem::take(&mut self.rolled),
            snapshot: Snapshot {
                soundings,
                picture: None,
            },
            put_down: false,
        }
    }
}

/// Returns the root-mean-square errors of the map's pose and of dead reckoning over the last half,
/// with map and robot.
fn errors(seed: u64, looks: usize) -> (f64, f64, PlaceGraph, Wanderer) {
    let mut robot = Wanderer::new(seed);
    let start = robot.truth;
    let mut map = PlaceGraph::new(PlaceGraphConfig::indoors());
    let (mut by_map, mut by_wheels) = (0.0, 0.0);
    for look in 0..looks {
        let seen = robot.see();
        map.observe(&seen).unwrap();
        if look >= looks / 2 {
            let here = start.compose(map.here().unwrap());
            by_map += (here.position - robot.truth.position).norm_squared();
            by_wheels += (robot.reckoned.position - robot.truth.position).norm_squared();
        }
        robot.move_on();
    }
    let half = (looks - looks / 2) as f64;
    (
        (by_map / half).sqrt(),
        (by_wheels / half).sqrt(),
        map,
        robot,
    )
}

#[test]
fn the_map_corrects_the_pose_that_the_wheels_lose() {
    for seed in 0..2 {
        let (by_map, by_wheels, map, robot) = errors(seed, 120);
        assert!(map.is_localized());
        assert!(by_map < 0.1, "{by_map}");
        assert!(by_wheels > 5.0 * by_map, "{by_wheels}");
        assert!((map.wheels().curvature - robot.curvature).abs() < 0.02);
        assert!((map.wheels().scale - robot.scale).abs() < 0.01);
    }
}

#[test]
fn a_robot_that_was_put_down_finds_itself() {
    let (_, _, map, _) = errors(1, 150);
    let first = Wanderer::new(1).truth;
    let mut found = 0;
    for seed in 20..22 {
        let mut map = map.clone().put_down(false);
        let mut other = Wanderer::new(seed);
        let (x, y) = (
            other.rng.random_range(0.5..4.5),
            other.rng.random_range(0.5..1.5),
        );
        other.truth = Pose::new(Point::new(x, y), other.truth.heading);
        for _ in 0..30 {
            let seen = other.see();
            map.observe(&seen).unwrap();
            other.move_on();
        }
        let seen = other.see();
        map.observe(&seen).unwrap();
        let here = first.compose(map.here().unwrap());
        let off = (here.position - other.truth.position).norm();
        found += u32::from(map.is_localized() && off < 0.15);
    }
    assert_eq!(found, 2);
}

#[test]
fn what_is_no_number_is_no_reading_and_leaves_the_map_as_it_was() {
    let mut robot = Wanderer::new(3);
    let mut map = PlaceGraph::new(PlaceGraphConfig::indoors());
    for _ in 0..30 {
        map.observe(&robot.see()).unwrap();
        robot.move_on();
    }
    let mut seen = robot.see();
    for (sounding, range) in
        seen.snapshot
            .soundings
            .iter_mut()
            .zip([f64::NAN, 0.0, f64::INFINITY, -1.0])
    {
        sounding.range = range;
    }
    map.observe(&seen).unwrap();
    assert!(map.here().unwrap().is_finite());
    let before = (map.here(), map.places().len());
    seen.rolled = vec![Odometry {
        distance: f64::NAN,
        turn: 0.0,
    }];
    assert_eq!(
        map.observe(&seen),
        Err(PlaceGraphError::Odometry { step: 0 })
    );
    assert_eq!((map.here(), map.places().len()), before);
}

#[test]
fn an_empty_map_begins_where_a_robot_is_put_down_on_it() {
    for grows in [true, false] {
        let mut robot = Wanderer::new(4);
        let mut map = PlaceGraph::new(PlaceGraphConfig::indoors()).put_down(grows);
        assert_eq!(map.here(), None);
        let mut seen = robot.see();
        seen.put_down = true;
        map.observe(&seen).unwrap();
        assert_eq!(map.here(), Some(Pose::IDENTITY));
        assert!(map.is_localized());
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_map_comes_back_from_a_file_to_the_bit() {
    let (_, _, map, mut robot) = errors(5, 60);
    let text = serde_json::to_string(&map).unwrap();
    let mut read: PlaceGraph = serde_json::from_str(&text).unwrap();
    assert_eq!(read.places(), map.places());
    assert_eq!(read.poses(), map.poses());
    assert_eq!(read.map(), map.map());
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
    // It finds a robot as the map does that was never written down.
    let mut kept = map.put_down(true);
    for _ in 0..6 {
        let seen = robot.see();
        kept.observe(&seen).unwrap();
        read.observe(&seen).unwrap();
        assert_eq!(read.belief(), kept.belief());
        robot.move_on();
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_file_that_holds_no_map_is_refused() {
    let (_, _, map, _) = errors(6, 20);
    let sound = serde_json::to_value(&map).unwrap();
    let check = |pointer: &str, value: serde_json::Value, expect: &str| {
        let mut file = sound.clone();
        *file.pointer_mut(pointer).unwrap() = value;
        let told = serde_json::from_value::<PlaceGraph>(file).unwrap_err();
        assert!(told.to_string().contains(expect), "{pointer}: {told}");
    };
    check("/format", "soup".into(), "the format is \"soup\"");
    check("/version", 2.into(), "version 2");
    check(
        "/config/place_distance",
        (-1.0).into(),
        "`place_distance` is -1",
    );
    check("/places/0/outline/points/0/deviation", 0.into(), "place 0");
    check("/links/0/1", 999.into(), "the number of places is");
    check(
        "/edges/0/to",
        999.into(),
        "names a pose that does not exist",
    );
}

#[test]
fn a_sonar_faces_what_both_neighbours_hear_farther_off() {
    let sonar = |(number, range): (u32, f64)| Sounding {
        mount: Pose::new(
            Point::origin(),
            Heading::from_degrees(30.0 * f64::from(number)),
        ),
        half_width: 0.2,
        max_range: 5.0,
        range,
    };
    let snapshot = Snapshot {
        soundings: [(0, 1.0), (1, 1.5), (2, 2.0)].map(sonar).to_vec(),
        picture: None,
    };
    let faced = Outline::of(&snapshot).faced;
    assert_eq!(faced.len(), 1, "{faced:?}");
    assert!((faced[0].position - Point::new(1.0, 0.0)).norm() < 1e-12);
    assert_eq!(faced[0].normal, Some(Vector::new(-1.0, 0.0)));
    assert!((faced[0].deviation - 0.03).abs() < 1e-12);
    // All round, in any order, each is held to the neighbours on its sides; farther than 3 m none
    // faces anything.
    let ranges = [3.5, 3.2, 2.9, 1.2, 1.3, 1.1, 4.0, 3.1, 4.5, 2.0, 2.6, 3.6];
    let mut soundings: Vec<Sounding> = (0..).zip(ranges).map(sonar).collect();
    soundings.rotate_left(5);
    soundings.swap(2, 9);
    let snapshot = Snapshot {
        soundings,
        picture: None,
    };
    let faced: Vec<f64> = Outline::of(&snapshot)
        .faced
        .iter()
        .map(|point| point.position.coords.norm())
        .collect();
    let count = ranges.len();
    let expected = (0..count).filter(|index| {
        let beside = [
            ranges[(index + 1) % count],
            ranges[(index + count - 1) % count],
        ];
        ranges[*index] <= 3.0 && beside.iter().all(|range| ranges[*index] <= *range)
    });
    let mut expected: Vec<f64> = expected.map(|index| ranges[index]).collect();
    assert_eq!(expected, [1.2, 1.1, 2.0]);
    let mut found = faced;
    for list in [&mut expected, &mut found] {
        list.sort_by(f64::total_cmp);
    }
    assert_eq!(found.len(), 3);
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-12);
    }
}

/// Returns a picture whose pixels are these, by number.
fn picture([width, height]: [u32; 2], pixel: impl FnMut(u32) -> [u8; 3]) -> Picture {
    Picture {
        width,
        height,
        camera: CAMERA,
        pixels: (0..width * height).map(pixel).collect(),
    }
}

#[test]
fn what_stands_on_the_floor_is_where_its_foot_is() {
    let (width, height, foot) = (40, 30, 22);
    let pixel = |row: u32| if row < foot { [200, 20, 20] } else { [100; 3] };
    let picture = picture([width, height], |index| pixel(index / width));
    let points = foot_line(&picture);
    assert_eq!(points.len(), 40);
    let down = (f64::from(foot) - 15.0) / 15.0 * (0.5 * CAMERA.field_down).tan();
    for point in points {
        assert!(
            (point.position.x - CAMERA.height / down).abs() < 1e-9,
            "{point:?}"
        );
        let [red, _] = point.colour.unwrap();
        assert!((red - 200.0 / 240.0).abs() < 1e-9, "{point:?}");
    }
}

/// What the camera sees lies as far from the robot as the camera, and ranges count where they met
/// something.
#[test]
fn an_outline_is_seen_from_where_the_sensors_are() {
    let (width, height) = (6, 30);
    let pixel = |row: u32| if row < 22 { [200, 20, 20] } else { [100; 3] };
    let picture = |x: f64, y: f64| {
        let mut camera = CAMERA;
        camera.position = Point::new(x, y);
        let pixels = (0..width * height).map(|index| pixel(index / width));
        Picture {
            width,
            height,
            camera,
            pixels: pixels.collect(),
        }
    };
    let [at, moved] = [(0.0, 0.0), (0.2, -0.1)].map(|(x, y)| foot_line(&picture(x, y)));
    assert_eq!(at.len(), 6);
    for (at, moved) in at.iter().zip(&moved) {
        let off = moved.position - at.position - Vector::new(0.2, -0.1);
        assert!(off.norm() < 1e-12);
    }
    let beam = |range: f64| Sounding {
        mount: Pose::IDENTITY,
        half_width: 0.0,
        max_range: 5.0,
        range,
    };
    for (range, is_met) in [
        (0.009, false),
        (0.011, true),
        (4.99, true),
        (4.996, false),
        (5.0, false),
        (f64::NAN, false),
    ] {
        let snapshot = Snapshot {
            soundings: vec![beam(range)],
            picture: None,
        };
        assert_eq!(
            Outline::of(&snapshot).points.len(),
            usize::from(is_met),
            "{range}"
        );
    }
}

/// A pixel is something else than floor if it differs by more than 0.22 of the brightness, and not
/// at 0.22 itself: 11 of 50 here.
#[test]
fn floor_ends_where_it_is_unlike_by_more_than_the_limit() {
    let feet = |red: u8| {
        let (width, height) = (4, 30);
        let pixel = |row: u32| match row {
            22.. => [38; 3],
            21 => [red, 39, 38],
            _ => [250, 0, 0],
        };
        let picture = picture([width, height], |index| pixel(index / width));
        foot_line(&picture)
    };
    let (like, unlike) = (feet(49), feet(51));
    assert_eq!((like.len(), unlike.len()), (4, 4));
    assert!(like[0].position.x > unlike[0].position.x);
}

/// A wanderer's map, and another robot that finds itself on it: every figure is pinned.
#[test]
fn a_run_by_outlines_is_what_it_was() {
    let mut robot = Wanderer::new(0);
    let mut map = PlaceGraph::new(PlaceGraphConfig::indoors());
    let mut figures = Vec::new();
    for look in 0..90 {
        map.observe(&robot.see()).unwrap();
        if look % 6 == 0 {
            let belief = map.belief();
            let here = (map.here(), map.is_localized(), belief.len());
            figures.push(format!("{here:?} {:?}", map.wheels()));
        }
        robot.move_on();
    }
    figures.extend(map.poses().poses().iter().map(|pose| format!("{pose:?}")));
    for edge in map.poses().edges().iter().step_by(3) {
        figures.push(format!("{} {} {:?}", edge.from, edge.to, edge.measured));
        figures.push(format!("{:?}", edge.information.as_slice()));
    }
    for place in map.places().iter().step_by(5) {
        figures.push(format!("{} {:?}", place.points.len(), place.points.first()));
        figures.push(format!(
            "{:?} {:?}",
            place.faced.first(),
            place.points.last()
        ));
    }
    figures.push(format!(
        "{} {}",
        map.bytes(),
        map.nearest(Point::new(1.0, 1.0))
    ));
    for grows in [true, false] {
        let mut found = map.clone().put_down(grows);
        let mut other = Wanderer::new(21);
        other.truth = Pose::new(Point::new(2.5, 1.2), other.truth.heading);
        for look in 0..24 {
            found.observe(&other.see()).unwrap();
            let here = (found.here(), found.is_localized(), found.places().len());
            figures.push(format!("{here:?}"));
            if look % 8 == 0 {
                let belief = found.belief();
                figures.push(format!("{} {:?}", belief.len(), belief.first()));
            }
            other.move_on();
        }
    }
    pinned("place_graph", &figures);
}

#[test]
fn wheels_that_err_more_or_stand_closer_bend_the_way_more() {
    let curvature = |share, track| {
        let config = PlaceGraphConfig::indoors().for_wheels(share, track);
        assert_eq!(config.scale_deviation.to_bits(), f64::to_bits(share));
        config.curvature_deviation
    };
    assert!((curvature(0.03, 0.32) - 0.15).abs() < 1e-12);
    assert!((curvature(0.06, 0.32) - 0.3).abs() < 1e-12);
    assert!((curvature(0.03, 0.08) - 0.6).abs() < 1e-12);
}

/// Pictures of a floor that grows darker, with things on it: every foot is pinned.
#[test]
fn the_feet_of_things_are_what_they_were() {
    let mut figures = Vec::new();
    for (width, height) in [(12, 30), (97, 21), (5, 3), (4, 60)] {
        let pixel = |index: u32| {
            let (column, row) = (index % width, index / width);
            let floor = 60 + (90 * row / height) as u8 + (index * 7 % 5) as u8;
            let foot = height / 2 + 1 + column * 5 % (height / 2 + 1);
            let rim = 20 * ((column + row) % 3) as u8;
            match (row < foot, column % 4) {
                (true, 0) => [190, 30 + rim, 20],
                (true, 1) => [20, 40, 160 + rim],
                // Hardly unlike the floor.
                (true, 2) => [floor + 14, floor + rim, floor],
                _ => [floor; 3],
            }
        };
        let picture = picture([width, height], pixel);
        let feet = foot_line(&picture);
        figures.push(format!("{width} {height} {}", feet.len()));
        figures.extend(feet.iter().map(|foot| format!("{foot:?}")));
    }
    pinned("foot_line", &figures);
}
