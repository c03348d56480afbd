//! Files are read back by Rerun's own decoder, and compared with the replay.

use std::collections::BTreeMap;
use std::io::BufReader;

use re_chunk::Chunk;
use re_log_encoding::DecoderApp;
use re_log_types::LogMsg;
use re_sdk_types::archetypes::{
    Clear, LineStrips3D, Points3D, RecordingInfo, Scalars, SeriesLines, TextDocument, TextLog,
    Transform3D,
};
use re_sdk_types::components::{
    ClearIsRecursive, LineStrip3D, Name, Position3D, RotationQuat, Scalar, Text, Translation3D,
};
use re_sdk_types::{Component, ComponentDescriptor};
use tolman_geom::{Heading, Point, Pose};
use tolman_replay::{
    Belief, BeliefAt, DoorChange, EncodeError, Fact, MapEdge, MapGrowth, MapNode, Mark, Marks,
    NodeMove, Notes, Replay, RobotTrack, Scans, Scenery, SceneryDoor, Shape, TimeSeries,
};
use tolman_robot::{Body, Ring};
use tolman_sim::DoorState;

use crate::{RrdExportError, rrd};

/// Length of a step, s.
const STEP: f64 = 0.1;

fn poses() -> Vec<Pose> {
    let pose = |(x, degrees)| Pose::new(Point::new(x, 0.5), Heading::from_degrees(degrees));
    [(0.2, 0.0), (0.7, 90.0), (1.2, -135.0), (1.7, 10.0)]
        .map(pose)
        .into()
}

fn ring() -> Ring {
    Ring::full(4, 2.0)
}

/// Returns a replay with something of everything that is written.
fn replay() -> Replay {
    let mut track = RobotTrack::new("mouse", Body::Circle { radius: 0.1 }, poses());
    track.scans = Some(Scans {
        ring: ring(),
        steps: vec![1],
        ranges: vec![vec![1.0, 0.5, 2.0, f64::NAN]],
    });
    track.maps.push(map());
    let shapes = vec![Shape::Node { id: 3, weight: 0.5 }];
    track.beliefs.push(Belief {
        name: "guess".to_owned(),
        entries: vec![BeliefAt { step: 2, shapes }],
    });
    let mut coverage = TimeSeries::new("coverage", "%");
    coverage.sample(0, 0.0);
    coverage.sample(2, 0.25);
    track.series.push(coverage);
    let mut notes = Notes::new("action");
    notes.say(1, "go north");
    track.notes.push(notes);
    track.marks.push(Marks::new(Mark::Bump, "bump", [3]));
    let door = |step, state| DoorChange { step, state };
    let scenery = Scenery {
        walls: vec![
            [Point::new(0.0, 0.0), Point::new(2.0, 0.0)],
            [Point::new(2.0, 0.0), Point::new(2.0, 1.0)],
        ],
        doors: vec![SceneryDoor {
            name: "d".to_owned(),
            ends: [Point::new(1.0, 0.0), Point::new(1.0, 1.0)],
            changes: vec![door(0, DoorState::Shut), door(2, DoorState::Open)],
        }],
        ..Scenery::default()
    };
    let mut replay = Replay::new("Three steps", STEP, scenery, vec![track]);
    replay.facts.push(Fact::new("seed", "7"));
    replay
}

/// Returns a map of two nodes, of which one moves, with an edge that disappears.
fn map() -> MapGrowth {
    let mut first = MapNode::new(3, Point::new(0.0, 0.0), 1);
    let position = Point::new(0.5, 0.0);
    first.moves.push(NodeMove { step: 2, position });
    let mut edge = MapEdge::new(3, 4, 1);
    edge.died = Some(3);
    MapGrowth {
        name: "places".to_owned(),
        nodes: vec![first, MapNode::new(4, Point::new(1.0, 0.0), 1)],
        edges: vec![edge],
    }
}

/// A file, by entity: what always holds, and what holds from a time on.
struct Read {
    chunks: BTreeMap<String, Vec<Chunk>>,
}

impl Read {
    fn of(bytes: &[u8]) -> Self {
        let mut chunks: BTreeMap<String, Vec<Chunk>> = BTreeMap::new();
        let mut messages = DecoderApp::decode_lazy(BufReader::new(bytes));
        let first = messages.next().unwrap().unwrap();
        assert!(matches!(first, LogMsg::SetStoreInfo(_)), "{first:?}");
        for message in messages {
            let LogMsg::ArrowMsg(store, message) = message.unwrap() else {
                panic!("only the first message says what follows");
            };
            assert_eq!(store.application_id().as_str(), "tolman");
            let chunk = Chunk::from_arrow_msg(&message).unwrap();
            chunk.sanity_check().unwrap();
            let entity = chunk.entity_path().iter().map(|part| part.unescaped_str());
            let entity: Vec<&str> = entity.collect();
            chunks.entry(entity.join("/")).or_default().push(chunk);
        }
        Self { chunks }
    }

    /// Returns the values of a component of an entity, with the steps from which they hold. The
    /// time has to be that of the step.
    fn values<C: Component>(
        &self,
        entity: &str,
        component: &ComponentDescriptor,
    ) -> Vec<(i64, Vec<C>)> {
        let chunks = self.chunks.get(entity).into_iter().flatten();
        let of = |chunk: &Chunk| {
            let component = component.component;
            let indices = |timeline: &str| -> Vec<i64> {
                let indices = chunk.iter_component_indices(timeline.into(), component);
                indices.map(|(time, _)| time.as_i64()).collect()
            };
            let steps = indices("step");
            let times = steps.iter().map(|step| step * (1e9 * STEP) as i64);
            assert_eq!(indices("time"), times.collect::<Vec<_>>(), "{entity}");
            let values = chunk.iter_component::<C>(component);
            let values = values.map(|values| values.as_slice().to_vec());
            steps.into_iter().zip(values).collect::<Vec<_>>()
        };
        chunks
            .filter(|chunk| !chunk.is_static())
            .flat_map(of)
            .collect()
    }

    /// Returns the values of a component that always hold.
    fn always<C: Component>(&self, entity: &str, component: &ComponentDescriptor) -> Vec<C> {
        let chunks = self.chunks.get(entity).into_iter().flatten();
        let fixed = chunks.filter(|chunk| chunk.is_static());
        let values = fixed.flat_map(|chunk| {
            let values = chunk.iter_component::<C>(component.component);
            values
                .flat_map(|values| values.as_slice().to_vec())
                .collect::<Vec<_>>()
        });
        values.collect()
    }

    fn points(&self, entity: &str) -> Vec<(i64, Vec<[f32; 3]>)> {
        let points = self.values::<Position3D>(entity, &Points3D::descriptor_positions());
        let plain = |point: Position3D| [point.x(), point.y(), point.z()];
        let of = |(step, points): (i64, Vec<Position3D>)| {
            (step, points.into_iter().map(plain).collect())
        };
        points.into_iter().map(of).collect()
    }

    fn lines(&self, entity: &str) -> Vec<(i64, Vec<Vec<[f32; 3]>>)> {
        let lines = self.values::<LineStrip3D>(entity, &LineStrips3D::descriptor_strips());
        let plain = |strip: LineStrip3D| strip.0.iter().map(|point| point.0).collect();
        let of = |(step, strips): (i64, Vec<LineStrip3D>)| {
            (step, strips.into_iter().map(plain).collect())
        };
        lines.into_iter().map(of).collect()
    }

    fn erased(&self, entity: &str) -> Vec<i64> {
        let cleared = self.values::<ClearIsRecursive>(entity, &Clear::descriptor_is_recursive());
        cleared.into_iter().map(|(step, _)| step).collect()
    }
}

fn read() -> Read {
    Read::of(&rrd(&replay()).unwrap())
}

#[test]
fn the_entities_are_those_of_the_replay() {
    let read = read();
    let entities: Vec<&str> = read.chunks.keys().map(String::as_str).collect();
    assert_eq!(
        entities,
        [
            "__properties",
            "facts",
            "log/mouse",
            "log/mouse action",
            "mouse/coverage",
            "world",
            "world/mouse/belief/guess/belief",
            "world/mouse/map/places/edge 0",
            "world/mouse/map/places/node 3",
            "world/mouse/map/places/node 4",
            "world/robot mouse",
            "world/robot mouse/body",
            "world/robot mouse/scan",
            "world/scene/door d",
            "world/scene/walls",
        ]
    );
}

#[test]
fn the_poses_are_those_of_the_replay() {
    let read = read();
    let robot = "world/robot mouse";
    let moved = read.values::<Translation3D>(robot, &Transform3D::descriptor_translation());
    let turned = read.values::<RotationQuat>(robot, &Transform3D::descriptor_quaternion());
    assert_eq!((moved.len(), turned.len()), (4, 4));
    for ((step, pose), ((at, translation), (_, turn))) in
        (0..).zip(poses()).zip(moved.iter().zip(&turned))
    {
        assert_eq!(*at, step);
        let position = Point::new(translation[0].x().into(), translation[0].y().into());
        assert!((position - pose.position).norm() < 1e-6, "{translation:?}");
        let [x, y, z, w] = turn[0].0.0.map(f64::from);
        assert!(x == 0.0 && y == 0.0, "it turns about the vertical");
        let heading = Heading::from_radians(2.0 * libm::atan2(z, w));
        assert!(heading.turn_to(pose.heading).abs() < 1e-6, "{turn:?}");
    }
}

#[test]
fn walls_stand_and_doors_open() {
    let read = read();
    let walls = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]];
    let walls = vec![walls[..2].to_vec(), walls[1..].to_vec()];
    assert_eq!(read.lines("world/scene/walls"), [(0, walls)]);
    let door = vec![vec![[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]];
    assert_eq!(read.lines("world/scene/door d"), [(0, door)]);
    assert_eq!(read.erased("world/scene/door d"), [2]);
}

#[test]
fn a_map_grows_moves_and_shrinks() {
    let read = read();
    let place = "world/mouse/map/places";
    let at = |x| vec![[x, 0.0, 0.0]];
    assert_eq!(
        read.points(&format!("{place}/node 3")),
        [(1, at(0.0)), (2, at(0.5))]
    );
    assert_eq!(read.points(&format!("{place}/node 4")), [(1, at(1.0))]);
    let from = |x| vec![vec![[x, 0.0, 0.0], [1.0, 0.0, 0.0]]];
    let edge = format!("{place}/edge 0");
    assert_eq!(read.lines(&edge), [(1, from(0.0)), (2, from(0.5))]);
    assert_eq!(read.erased(&edge), [3]);
    assert_eq!(
        read.points("world/mouse/belief/guess/belief"),
        [(2, at(0.5))]
    );
}

#[test]
fn a_scan_has_what_its_beams_met() {
    let read = read();
    let scans = read.points("world/robot mouse/scan");
    let [(1, hits)] = &scans[..] else {
        panic!("one scan at step 1: {scans:?}");
    };
    // The third beam met nothing, and the fourth failed.
    assert_eq!(hits.len(), 2, "{hits:?}");
    let near = |[x, y, _]: [f32; 3], [to_x, to_y]: [f32; 2]| {
        (x - to_x).abs() < 1e-6 && (y - to_y).abs() < 1e-6
    };
    assert!(
        near(hits[0], [1.0, 0.0]) && near(hits[1], [0.0, 0.5]),
        "{hits:?}"
    );
}

#[test]
fn numbers_words_and_facts_are_kept() {
    let read = read();
    let numbers = read.values::<Scalar>("mouse/coverage", &Scalars::descriptor_scalars());
    let numbers: Vec<(i64, f64)> = numbers
        .iter()
        .map(|(step, values)| (*step, values[0].0.0))
        .collect();
    assert_eq!(numbers, [(0, 0.0), (2, 0.25)]);
    let name = read.always::<Name>("mouse/coverage", &SeriesLines::descriptor_names());
    assert_eq!(name[0].as_str(), "mouse/coverage, share");
    let said = |entity| -> Vec<(i64, String)> {
        let said = read.values::<Text>(entity, &TextLog::descriptor_text());
        said.into_iter()
            .map(|(step, texts)| (step, texts[0].as_str().to_owned()))
            .collect()
    };
    assert_eq!(said("log/mouse action"), [(1, "go north".to_owned())]);
    assert_eq!(said("log/mouse"), [(3, "bump".to_owned())]);
    let facts = read.always::<Text>("facts", &TextDocument::descriptor_text());
    assert_eq!(facts[0].as_str(), "- seed: 7");
    let title = read.always::<Name>("__properties", &RecordingInfo::descriptor_name());
    assert_eq!(title[0].as_str(), "Three steps");
}

#[test]
fn the_same_replay_gives_the_same_messages_and_another_one_another_recording() {
    let messages = |replay: &Replay| -> Vec<LogMsg> {
        let bytes = rrd(replay).unwrap();
        let mut messages = DecoderApp::decode_lazy(BufReader::new(&bytes[..]));
        let read = messages.by_ref().map(Result::unwrap).collect();
        let index = messages.rrd_manifests().unwrap();
        assert_eq!(index.len(), 1, "the file has an index");
        read
    };
    let once = messages(&replay());
    assert!(once == messages(&replay()));
    let mut other = replay();
    other.title.push('!');
    assert_ne!(once[0].store_id(), messages(&other)[0].store_id());
}

#[test]
fn what_cannot_be_played_is_refused() {
    let mut empty = replay();
    empty.tracks.clear();
    let refused = rrd(&empty);
    assert!(matches!(
        refused,
        Err(RrdExportError::Replay(EncodeError::Empty))
    ));
}
