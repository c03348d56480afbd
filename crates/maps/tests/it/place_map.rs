//! Place maps of a made-up pitch: a rectangle whose walls have four colours, seen by a pinhole
//! camera.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maps::place_map::{
    ColourSpace, FeatureChoice, FeatureError, FeatureGroup, FeatureScaling, FeatureTable,
    ImageFeature, ImageForm, PlaceMap, PlaceMapConfig, PlaceMapError, PlaceRecord,
};
use tolman_quantizers::{GngConfig, UnitId};
use tolman_robot::{Mapper, Picture, Position, Snapshot, Sounding, pioneer_2dx};

use crate::pinned::pinned;

const WIDTH: f64 = 4.0;
const LENGTH: f64 = 4.6;
/// East, north, west, south. The windows are in the east.
const COLOURS: [[u8; 3]; 4] = [[220, 20, 20], [230, 220, 30], [20, 200, 60], [20, 40, 220]];

/// Returns the wall that a ray meets, and how far away.
fn meet(from: Point, direction: Vector) -> (usize, f64) {
    let to = |distance: f64, speed: f64| match speed > 1e-9 {
        true => distance / speed,
        false => f64::INFINITY,
    };
    let times = [
        to(WIDTH - from.x, direction.x),
        to(LENGTH - from.y, direction.y),
        to(from.x, -direction.x),
        to(from.y, -direction.y),
    ];
    let nearest = |a, b| if times[b] < times[a] { b } else { a };
    let wall = (1..4).fold(0, nearest);
    (wall, times[wall])
}

fn record(pose: Pose) -> PlaceRecord {
    let mut picture = Picture::black(80, 60, pioneer_2dx::CAMERA);
    for column in 0..80 {
        let bearing = picture.leftward(column).atan();
        let (wall, _) = meet(pose.position, pose.heading.turned(bearing).unit());
        for row in 0..30 {
            picture.pixels[row * 80 + column as usize] = COLOURS[wall];
        }
    }
    let sounding = |mount: Pose| Sounding {
        mount,
        half_width: pioneer_2dx::SONAR_HALF_WIDTH,
        range: meet(
            pose.position,
            pose.heading.turned(mount.heading.radians()).unit(),
        )
        .1,
        max_range: pioneer_2dx::SONAR_MOST,
    };
    PlaceRecord {
        odometry: pose,
        snapshot: Snapshot {
            soundings: pioneer_2dx::sonar_mounts().map(sounding).into(),
            picture: Some(picture),
        },
    }
}

/// Records near walls that look at them, as a robot takes that turns away from near collisions.
fn records(count: usize) -> Vec<PlaceRecord> {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut one = || {
        let position = Point::new(
            rng.random_range(0.4..WIDTH - 0.4),
            rng.random_range(0.4..LENGTH - 0.4),
        );
        let looks = [0.0, 90.0, 180.0, 270.0].map(Heading::from_degrees);
        let near = |a: &&Heading, b: &&Heading| {
            let [a, b] = [a, b].map(|look| meet(position, look.unit()).1);
            a.total_cmp(&b)
        };
        let look = *looks.iter().min_by(near).unwrap();
        record(Pose::new(
            position,
            look.turned(rng.random_range(-0.7..0.7)),
        ))
    };
    (0..count).map(|_| one()).collect()
}

/// Returns the same records with an odometry that takes left for right.
fn mirrored(records: &[PlaceRecord]) -> Vec<PlaceRecord> {
    let mut records = records.to_vec();
    for record in &mut records {
        record.odometry.position.x = WIDTH - record.odometry.position.x;
    }
    records
}

fn fine() -> PlaceMapConfig {
    let mut config = PlaceMapConfig::paper();
    config.gng = GngConfig::fritzke();
    config.gng.max_units = 40;
    config.gng.growth_period = 20;
    config
}

fn small(scaling: FeatureScaling) -> FeatureChoice {
    FeatureChoice::paper_with_sonar(ImageFeature::small(ColourSpace::Hsv)).scaled(scaling)
}

fn learn(records: &[PlaceRecord], form: ImageForm, config: PlaceMapConfig) -> PlaceMap {
    let table = FeatureTable::of(records, &small(FeatureScaling::Group), form).unwrap();
    let rng = &mut ChaCha8Rng::seed_from_u64(3);
    PlaceMap::learn(&table, 0..records.len(), config, rng).unwrap()
}

/// Returns the share of red in a picture.
fn redness(picture: &Picture) -> f64 {
    let red = |pixel: &&[u8; 3]| pixel[0] > 120 && pixel[1] < 90 && pixel[2] < 90;
    picture.pixels.iter().filter(red).count() as f64 / picture.pixels.len() as f64
}

/// Returns the distance by which the nodes that see the windows lie east of the others, m. The map
/// is first turned so that the yellow side is straight above the blue side, as the paper draws it.
fn windows_to_the_right(map: &PlaceMap) -> f64 {
    let mean_where = |see: &dyn Fn(&Picture) -> bool| {
        let seen = map.positions();
        let seen = seen.filter(|(node, _)| see(&map.picture(*node).unwrap()));
        let seen: Vec<Vector> = seen.map(|(_, position)| position.coords).collect();
        assert!(!seen.is_empty());
        seen.iter().sum::<Vector>() / seen.len() as f64
    };
    let mostly = |channels: [bool; 3]| {
        move |picture: &Picture| {
            let is = |pixel: &&[u8; 3]| (0..3).all(|c| (pixel[c] > 120) == channels[c]);
            picture.pixels.iter().filter(is).count() * 4 > picture.pixels.len()
        }
    };
    let blue = mean_where(&mostly([false, false, true]));
    let yellow = mean_where(&mostly([true, true, false]));
    let windows = mean_where(&|picture| redness(picture) > 0.25);
    let up = (yellow - blue).normalize();
    let right = Vector::new(up.y, -up.x);
    right.dot(&(windows - 0.5 * (yellow + blue)))
}

#[test]
fn the_map_is_no_mirror_image_of_the_world() {
    let records = records(600);
    let map = learn(&records, ImageForm::Pixels, fine());
    let right = windows_to_the_right(&map);
    assert!(right > 0.5, "{right}");
    // The test can fail: odometry that counts to the left gives the paper's mirror image.
    let wrong = learn(&mirrored(&records), ImageForm::Pixels, fine());
    assert!(windows_to_the_right(&wrong) < -0.5);
}

#[test]
fn what_is_left_of_the_robot_is_left_in_a_node_s_picture() {
    let records = records(600);
    let map = learn(&records, ImageForm::Pixels, fine());
    let (mut plain, mut mirrored) = (0, 0);
    for record in &records {
        let seen = record.snapshot.picture.as_ref().unwrap();
        let learned = map.picture(map.nearest(record).unwrap()).unwrap();
        let differs = |column: u32, of: u32| {
            let [a, b] = [learned.pixel(column, 10), seen.pixel(2 * of, 20)].map(Option::unwrap);
            (0..3).map(|c| u64::from(a[c].abs_diff(b[c]))).sum::<u64>()
        };
        plain += (0..40).map(|column| differs(column, column)).sum::<u64>();
        mirrored += (0..40)
            .map(|column| differs(column, 39 - column))
            .sum::<u64>();
    }
    assert!(5 * plain < 4 * mirrored, "{plain} {mirrored}");
}

#[test]
fn nodes_lie_where_their_records_were_taken() {
    let records = records(600);
    let map = learn(&records, ImageForm::Pixels, fine());
    let squares = records.iter().map(|record| {
        let node = map.nearest(record).unwrap();
        (map.position(node).unwrap() - record.odometry.position).norm_squared()
    });
    let rms = (squares.sum::<f64>() / records.len() as f64).sqrt();
    assert!(rms < 0.6, "{rms} m");
}

#[test]
fn images_in_their_span_give_the_same_map() {
    let records = records(150);
    let pixels = learn(&records, ImageForm::Pixels, fine());
    let span = learn(&records, ImageForm::Span { left_out: 0.0 }, fine());
    assert!(span.space().dimension() < 150 + 18);
    assert_eq!(pixels.map().links, span.map().links);
    for (node, position) in pixels.positions() {
        assert!((span.position(node).unwrap() - position).norm() < 1e-3);
        let [a, b] = [&pixels, &span].map(|map| map.picture(node).unwrap().pixels);
        let near = |a: &[u8; 3], b: &[u8; 3]| (0..3).all(|c| a[c].abs_diff(b[c]) <= 3);
        let same = a.iter().zip(&b).filter(|(a, b)| near(a, b)).count();
        // A hue beside the tear of the circle may turn over.
        assert!(same * 100 >= a.len() * 99, "{same} of {}", a.len());
    }
    for record in &records {
        assert_eq!(pixels.nearest(record), span.nearest(record));
    }
}

#[test]
fn groups_count_as_their_scaling_says() {
    let records = records(200);
    // Mean squared distance between records, by group.
    let spread = |scaling| {
        let table = FeatureTable::of(&records, &small(scaling), ImageForm::Pixels).unwrap();
        assert_eq!(table.len(), records.len());
        let rows: Vec<&[f32]> = (0..200).map(|row| table.row(row).unwrap()).collect();
        let pairs = || rows.iter().flat_map(|a| rows.iter().map(move |b| (a, b)));
        [0..3600, 3600..3602, 3602..3618].map(|part| {
            let squares = pairs().map(|(a, b)| {
                let each = a[part.clone()].iter().zip(&b[part.clone()]);
                each.map(|(a, b)| f64::from((a - b) * (a - b))).sum::<f64>()
            });
            squares.sum::<f64>() / (200.0 * 200.0)
        })
    };
    // Of values that are drawn independently it is twice their variance.
    for (found, expect) in spread(FeatureScaling::Group).iter().zip([2.0, 2.0, 2.0]) {
        assert!((found - expect).abs() < 1e-3, "{found}");
    }
    for (found, expect) in spread(FeatureScaling::Value)
        .iter()
        .zip([7200.0, 4.0, 32.0])
    {
        assert!((found / expect - 1.0).abs() < 1e-3, "{found}");
    }
    let raw = FeatureTable::of(&records, &small(FeatureScaling::Raw), ImageForm::Pixels).unwrap();
    let position = records[7].odometry.position;
    assert_eq!(
        raw.row(7).unwrap()[3600..3602],
        [position.x as f32, position.y as f32]
    );
}

#[test]
fn a_way_follows_links_and_is_the_shortest() {
    let records = records(400);
    let map = learn(&records, ImageForm::Pixels, fine());
    let links = map.map().links;
    let nodes: Vec<UnitId> = map.network().ids().collect();
    let length = |way: &[UnitId]| -> f64 {
        let legs = way.windows(2).map(|leg| {
            let [a, b] = [leg[0], leg[1]].map(|node| map.position(node).unwrap());
            (b - a).norm()
        });
        legs.sum()
    };
    let mut led = 0;
    for from in &nodes {
        for to in &nodes {
            let Some(way) = map.way(*from, *to) else {
                continue;
            };
            led += 1;
            assert_eq!((way.first(), way.last()), (Some(from), Some(to)));
            for leg in way.windows(2) {
                let link = links
                    .iter()
                    .any(|link| (link.from, link.to) == (leg[0].0, leg[1].0));
                assert!(link, "{leg:?}");
            }
            // No way by a link of the goal is shorter.
            for before in map.network().neighbours(*to).unwrap() {
                let other = map.way(*from, before).unwrap();
                let detour = length(&other) + length(&[before, *to]);
                assert!(length(&way) <= detour + 0.1);
            }
        }
    }
    assert!(led > nodes.len(), "the map is in one piece, or nearly");
    assert_eq!(map.way(nodes[0], UnitId(99_999)), None);
}

#[test]
fn one_record_at_a_time_gives_a_map_and_a_belief() {
    let records = records(300);
    let table = FeatureTable::of(&records, &small(FeatureScaling::Group), ImageForm::Pixels);
    let mut map = PlaceMap::new(table.unwrap().space().clone(), fine()).unwrap();
    assert!(map.map().places.is_empty() && map.belief().is_empty());
    for record in &records {
        map.observe(record).unwrap();
    }
    let view = map.map();
    assert!(view.places.len() > 10 && view.places.iter().all(|place| place.position.is_some()));
    assert!(matches!(map.belief()[..], [guess] if matches!(guess.at, Position::Place(_))));
}

#[test]
fn the_same_seed_gives_the_same_map() {
    let records = records(100);
    let [a, b] = [(), ()].map(|()| learn(&records, ImageForm::Pixels, PlaceMapConfig::paper()));
    assert_eq!(a.map(), b.map());
}

#[cfg(feature = "serde")]
#[test]
fn maps_survive_files_whatever_form_images_have() {
    let records = records(80);
    for form in [ImageForm::Pixels, ImageForm::Span { left_out: 0.0 }] {
        let map = learn(&records, form, fine());
        let text = serde_json::to_string(&map).unwrap();
        let read: PlaceMap = serde_json::from_str(&text).unwrap();
        assert_eq!(read.map().links, map.map().links);
        for record in &records {
            assert_eq!(read.nearest(record), map.nearest(record));
        }
        for (node, position) in map.positions() {
            assert!((read.position(node).unwrap() - position).norm() < 1e-5);
        }
        for (from, to, expect) in [
            (
                "tolman-place-map",
                "tolman-maze",
                "give \"tolman-place-map\"",
            ),
            (
                "\"version\":1,\"parts\"",
                "\"version\":2,\"parts\"",
                "version 2",
            ),
            ("\"scale\":", "\"scale\":-", "finite and above 0"),
            ("\"dimension\":", "\"dimension\":9", "changed or cut off"),
        ] {
            let error = serde_json::from_str::<PlaceMap>(&text.replacen(from, to, 1));
            let error = error.unwrap_err().to_string();
            assert!(error.contains(expect), "{error}");
        }
        let mut flat = serde_json::to_value(&map).unwrap();
        *flat.pointer_mut("/parts/0/scale").unwrap() = 0.into();
        let error = serde_json::from_value::<PlaceMap>(flat).unwrap_err();
        assert!(error.to_string().contains("finite and above 0"), "{error}");
    }
}

#[test]
fn what_has_no_features_is_refused_by_number() {
    let mut records = records(3);
    let choice = small(FeatureScaling::Group);
    let of = |records: &[PlaceRecord], choice: &FeatureChoice| {
        FeatureTable::of(records, choice, ImageForm::Pixels).unwrap_err()
    };
    assert_eq!(of(&[], &choice), FeatureError::NoRecords);
    let none = FeatureChoice {
        groups: vec![],
        ..choice.clone()
    };
    assert_eq!(of(&records, &none), FeatureError::NoFeatures);
    let twice = FeatureChoice {
        groups: vec![FeatureGroup::Sonar; 2],
        ..choice.clone()
    };
    assert_eq!(
        of(&records, &twice),
        FeatureError::ChosenTwice { group: "sonar" }
    );
    let picture = records[1].snapshot.picture.take();
    assert_eq!(of(&records, &choice), FeatureError::NoPicture { record: 1 });
    let mut torn = picture.clone().unwrap();
    torn.pixels.pop();
    let (width, height, found) = (torn.width, torn.height, torn.pixels.len());
    records[1].snapshot.picture = Some(torn);
    let bad = |width, height, found| FeatureError::BadPicture {
        record: 1,
        width,
        height,
        found,
    };
    assert_eq!(of(&records, &choice), bad(width, height, found));
    let mut empty = picture.clone().unwrap();
    empty.pixels.clear();
    (empty.width, empty.height) = (0, 0);
    records[1].snapshot.picture = Some(empty);
    assert_eq!(of(&records, &choice), bad(0, 0, 0));
    records[1].snapshot.picture = picture;
    records[2].snapshot.soundings.pop();
    let other = FeatureError::OtherSoundings {
        record: 2,
        expected: 16,
        found: 15,
    };
    assert_eq!(of(&records, &choice), other);
    records.pop();
    records[1].odometry.position.x = f64::NAN;
    let group = "odometry";
    assert_eq!(
        of(&records, &choice),
        FeatureError::NotFinite { record: 1, group }
    );
    records.pop();
    let table = FeatureTable::of(&records, &choice, ImageForm::Pixels).unwrap();
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    let few = PlaceMap::learn(&table, 0..1, PlaceMapConfig::paper(), rng);
    assert_eq!(few.unwrap_err(), PlaceMapError::TooFewRecords { found: 1 });
    let beyond = PlaceMap::learn(&table, 0..2, PlaceMapConfig::paper(), rng);
    let missing = PlaceMapError::NoSuchRecord {
        record: 1,
        count: 1,
    };
    assert_eq!(beyond.unwrap_err(), missing);
}

/// A map of a few records: every figure is pinned.
#[test]
fn a_small_map_is_what_it_was() {
    let records = records(120);
    let mut figures = Vec::new();
    for form in [ImageForm::Pixels, ImageForm::Span { left_out: 0.01 }] {
        let map = learn(&records, form, fine());
        figures.push(format!("{} {}", map.bytes(), map.space().dimension()));
        for (node, position) in map.positions() {
            let ranges = map.ranges(node);
            figures.push(format!("{node:?} {position:?} {ranges:?}"));
        }
        let nodes: Vec<UnitId> = map.positions().map(|(node, _)| node).collect();
        let picture = map.picture(nodes[3]).unwrap();
        figures.push(format!("{:?}", &picture.pixels[..40]));
        figures.push(format!("{:?}", map.way(nodes[0], nodes[nodes.len() - 1])));
        let near: Vec<UnitId> = records
            .iter()
            .step_by(9)
            .map(|one| map.nearest(one).unwrap())
            .collect();
        figures.push(format!("{near:?}"));
        let known = [Some(1.0), None, None, Some(2.0), None, None, None, None];
        figures.push(format!("{:?}", map.nearest_by_ranges(&known)));
        let features = map.space().features(&records[5]).unwrap();
        let features = features.iter().step_by(7);
        let features: Vec<String> = features.map(|one| format!("{one:.5}")).collect();
        figures.push(features.join(" "));
    }
    pinned("place_map", &figures);
}
