//! Replays for Foxglove and other readers of MCAP: messages in Foxglove's schemas, as JSON.
//!
//! | topic | schema | holds |
//! | --- | --- | --- |
//! | `/tf` | `foxglove.FrameTransform` | each robot's pose, a message a step |
//! | `/scene` | `foxglove.SceneUpdate` | walls, zones and doors |
//! | `/ROBOT/body` | `foxglove.SceneUpdate` | the outline |
//! | `/ROBOT/scan` | `foxglove.LaserScan` | recorded scans |
//! | `/ROBOT/map/NAME` | `foxglove.SceneUpdate` | a map as it grows: nodes and edges that appear, move and disappear |
//! | `/ROBOT/belief/NAME` | `foxglove.SceneUpdate` | the believed poses |
//! | `/ROBOT/NAME` | `tolman.Number` | a time series |
//! | `/log` | `foxglove.Log` | notes and marks |

use alloc::collections::BTreeMap;
use core::f64::consts::TAU;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use serde_json::{Value, json};
use thiserror::Error;
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::Body;
use tolman_sim::DoorState;

use super::{
    Belief, EncodeError, MapEdge, MapGrowth, MapNode, Marks, Notes, Replay, RobotTrack, Scans,
    Scenery, Shape, json as checked,
};

/// Reason why a replay cannot be written as MCAP.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum McapExportError {
    /// The replay itself is invalid.
    #[error(transparent)]
    Replay(#[from] EncodeError),
    /// The MCAP writer refuses it.
    #[error("the replay does not fit into MCAP")]
    Write(#[from] McapError),
}

/// Returns a replay as the bytes of an MCAP file; the same replay gives the same bytes. Times are
/// those of the run, from 0. Fields over the floor are left out.
///
/// # Errors
/// As [`json`](super::json), and if there are more than 65,535 topics.
pub fn mcap(replay: &Replay) -> Result<Vec<u8>, McapExportError> {
    checked(replay)?;
    let mut events = Events::new(replay.step_s);
    scenery(&replay.scenery, &mut events);
    marks(&replay.marks, "", &mut events);
    for track in &replay.tracks {
        follow(track, &mut events);
    }
    Ok(events.written()?)
}

/// Messages that still have to be sorted by time.
struct Events {
    /// Length of a step, s.
    step_s: f64,
    messages: Vec<Event>,
}

struct Event {
    step: u32,
    topic: String,
    schema: &'static str,
    message: Value,
}

impl Events {
    const fn new(step_s: f64) -> Self {
        Self {
            step_s,
            messages: Vec::new(),
        }
    }

    /// Returns the time of a step, ns.
    fn nanos(&self, step: u32) -> u64 {
        (f64::from(step) * self.step_s * 1e9).round() as u64
    }

    /// Returns the time of a step in the form that messages use.
    fn timestamp(&self, step: u32) -> Value {
        let nanos = self.nanos(step);
        json!({ "sec": nanos / 1_000_000_000, "nsec": nanos % 1_000_000_000 })
    }

    fn send(&mut self, step: u32, topic: &str, schema: &'static str, message: Value) {
        self.messages.push(Event {
            step,
            topic: topic.to_owned(),
            schema,
            message,
        });
    }

    /// Draws the entity called `id`, or replaces it.
    fn draw(&mut self, step: u32, topic: &str, frame: &str, id: &str, mut entity: Value) {
        entity["timestamp"] = self.timestamp(step);
        entity["frame_id"] = frame.into();
        entity["id"] = id.into();
        let update = json!({ "entities": [entity] });
        self.send(step, topic, SCENE, update);
    }

    /// Removes the entity called `id`.
    fn erase(&mut self, step: u32, topic: &str, id: &str) {
        let gone = json!({ "timestamp": self.timestamp(step), "type": 0, "id": id });
        self.send(step, topic, SCENE, json!({ "deletions": [gone] }));
    }

    fn log(&mut self, step: u32, name: &str, text: &str) {
        let message = json!({
            "timestamp": self.timestamp(step), "level": 2, "name": name, "message": text,
        });
        self.send(step, "/log", "foxglove.Log", message);
    }

    /// Returns the file with all messages, in order of time.
    fn written(mut self) -> Result<Vec<u8>, McapError> {
        self.messages.sort_by_key(|event| event.step);
        let options = WriteOptions::new().library("tolman-replay");
        let mut writer = Writer::with_options(Cursor::new(Vec::new()), options)?;
        let mut channels: BTreeMap<String, u16> = BTreeMap::new();
        for (sequence, event) in (0..).zip(&self.messages) {
            let channel_id = match channels.get(&event.topic) {
                Some(id) => *id,
                None => {
                    let data = schema(event.schema).to_string();
                    let schema = writer.add_schema(event.schema, "jsonschema", data.as_bytes())?;
                    let none = BTreeMap::new();
                    let id = writer.add_channel(schema, &event.topic, "json", &none)?;
                    channels.insert(event.topic.clone(), id);
                    id
                }
            };
            let log_time = self.nanos(event.step);
            let header = MessageHeader {
                channel_id,
                sequence,
                log_time,
                publish_time: log_time,
            };
            writer.write_to_known_channel(&header, event.message.to_string().as_bytes())?;
        }
        writer.finish()?;
        Ok(writer.into_inner().into_inner())
    }
}

const SCENE: &str = "foxglove.SceneUpdate";

/// Returns the schema of a message, as far as these messages use it.
fn schema(name: &str) -> Value {
    let (object, array, number) = ("object", "array", "number");
    let fields: &[(&str, &str)] = match name {
        SCENE => &[("entities", array), ("deletions", array)],
        "foxglove.FrameTransform" => &[
            ("timestamp", object),
            ("parent_frame_id", "string"),
            ("child_frame_id", "string"),
            ("translation", object),
            ("rotation", object),
        ],
        "foxglove.LaserScan" => &[
            ("timestamp", object),
            ("frame_id", "string"),
            ("pose", object),
            ("start_angle", number),
            ("end_angle", number),
            ("ranges", array),
            ("intensities", array),
        ],
        "foxglove.Log" => &[
            ("timestamp", object),
            ("level", "integer"),
            ("message", "string"),
            ("name", "string"),
        ],
        _ => &[("value", number), ("unit", "string")],
    };
    let properties = fields.iter().map(|(name, kind)| {
        let kind = json!({ "type": kind });
        ((*name).to_owned(), kind)
    });
    let properties: serde_json::Map<String, Value> = properties.collect();
    json!({ "title": name, "type": "object", "properties": properties })
}

fn point(point: Point, height: f64) -> Value {
    json!({ "x": point.x, "y": point.y, "z": height })
}

fn rotation(heading: Heading) -> Value {
    let half = 0.5 * heading.radians();
    json!({ "x": 0.0, "y": 0.0, "z": libm::sin(half), "w": libm::cos(half) })
}

fn at(pose: Pose) -> Value {
    json!({ "position": point(pose.position, 0.0), "orientation": rotation(pose.heading) })
}

fn colour([r, g, b]: [f64; 3], a: f64) -> Value {
    json!({ "r": r, "g": g, "b": b, "a": a })
}

/// Colour of walls.
const DARK: [f64; 3] = [0.25, 0.27, 0.3];
/// Colour of zones of the floor.
const GREEN: [f64; 3] = [0.2, 0.6, 0.3];
/// Colour of what a robot learned.
const BLUE: [f64; 3] = [0.15, 0.45, 0.8];
/// Colour of a robot and of its belief.
const RED: [f64; 3] = [0.85, 0.3, 0.2];

/// Line types of Foxglove: a closed loop, and pairs of points.
const LOOP: u8 = 1;
const PAIRS: u8 = 2;

fn lines(kind: u8, points: impl IntoIterator<Item = Point>, ink: &Value) -> Value {
    let points: Vec<Value> = points.into_iter().map(|at| point(at, 0.0)).collect();
    json!({ "lines": [{
        "type": kind, "pose": at(Pose::IDENTITY), "thickness": 2.0, "scale_invariant": true,
        "points": points, "color": ink,
    }] })
}

fn disc(centre: Point, radius: f64, ink: &Value) -> Value {
    json!({
        "pose": at(Pose::new(centre, Heading::EAST)), "color": ink,
        "size": { "x": 2.0 * radius, "y": 2.0 * radius, "z": 0.01 },
    })
}

fn scenery(scenery: &Scenery, events: &mut Events) {
    let walls = scenery.walls.iter().flatten().copied();
    let walls = lines(PAIRS, walls, &colour(DARK, 1.0));
    events.draw(0, "/scene", "world", "walls", walls);
    for zone in &scenery.zones {
        let corners = zone.corners.iter().copied();
        let outline = lines(LOOP, corners, &colour(GREEN, 1.0));
        let id = format!("zone {}", zone.name);
        events.draw(0, "/scene", "world", &id, outline);
    }
    for door in &scenery.doors {
        let id = format!("door {}", door.name);
        for change in &door.changes {
            match change.state {
                DoorState::Shut => {
                    let wall = lines(PAIRS, door.ends, &colour(DARK, 1.0));
                    events.draw(change.step, "/scene", "world", &id, wall);
                }
                DoorState::Open => events.erase(change.step, "/scene", &id),
            }
        }
    }
}

fn marks(marks: &[Marks], robot: &str, events: &mut Events) {
    for mark in marks {
        for step in &mark.steps {
            events.log(*step, robot, &mark.name);
        }
    }
}

fn follow(track: &RobotTrack, events: &mut Events) {
    let name = &track.name;
    let frame = format!("robot {name}");
    for (step, pose) in (0..).zip(&track.poses) {
        let transform = json!({
            "timestamp": events.timestamp(step), "parent_frame_id": "world",
            "child_frame_id": frame, "translation": point(pose.position, 0.0),
            "rotation": rotation(pose.heading),
        });
        events.send(step, "/tf", "foxglove.FrameTransform", transform);
    }
    let outline = lines(LOOP, outline(&track.body), &colour(RED, 1.0));
    events.draw(0, &format!("/{name}/body"), &frame, "body", outline);
    if let Some(recorded) = &track.scans {
        scans(recorded, &format!("/{name}/scan"), &frame, events);
    }
    for map in &track.maps {
        grow(map, &format!("/{name}/map/{}", map.name), events);
    }
    for belief in &track.beliefs {
        believe(
            belief,
            track,
            &format!("/{name}/belief/{}", belief.name),
            events,
        );
    }
    for series in &track.series {
        let topic = format!("/{name}/{}", series.name);
        for sample in &series.samples {
            let number = json!({ "value": sample.value, "unit": series.unit });
            events.send(sample.step, &topic, "tolman.Number", number);
        }
    }
    for Notes { name: about, notes } in &track.notes {
        for note in notes {
            events.log(note.step, &format!("{name} {about}"), &note.text);
        }
    }
    marks(&track.marks, name, events);
}

/// Returns the corners of a body. A disc has a notch ahead.
fn outline(body: &Body) -> Vec<Point> {
    match body {
        Body::Polygon { corners } => corners.clone(),
        Body::Circle { radius } => {
            let corner = |corner: u32| {
                let heading = Heading::from_radians(TAU * f64::from(corner) / 24.0);
                Point::from(*radius * heading.unit())
            };
            core::iter::once(Point::origin())
                .chain((0..=24).map(corner))
                .collect()
        }
    }
}

fn scans(scans: &Scans, topic: &str, frame: &str, events: &mut Events) {
    let ring = &scans.ring;
    let last = ring.beams.saturating_sub(1);
    for (step, ranges) in scans.steps.iter().zip(&scans.ranges) {
        let none: [f64; 0] = [];
        let scan = json!({
            "timestamp": events.timestamp(*step), "frame_id": frame, "pose": at(Pose::IDENTITY),
            "start_angle": ring.bearing(0), "end_angle": ring.bearing(0) + ring.spacing * f64::from(last),
            "ranges": ranges, "intensities": none,
        });
        events.send(*step, topic, "foxglove.LaserScan", scan);
    }
}

/// Draws nodes and edges when they appear, again when they move, and removes them when they
/// disappear.
fn grow(map: &MapGrowth, topic: &str, events: &mut Events) {
    let nodes: BTreeMap<u32, &MapNode> = map.nodes.iter().map(|node| (node.id, node)).collect();
    for node in &map.nodes {
        let id = format!("node {}", node.id);
        let moves = node.moves.iter().map(|moved| (moved.step, moved.position));
        for (step, position) in core::iter::once((node.born, node.position)).chain(moves) {
            let sphere = json!({ "spheres": [disc(position, 0.05, &colour(BLUE, 1.0))] });
            events.draw(step, topic, "world", &id, sphere);
        }
        if let Some(died) = node.died {
            events.erase(died, topic, &id);
        }
    }
    for (number, edge) in map.edges.iter().enumerate() {
        let Some(ends) = nodes.get(&edge.a).zip(nodes.get(&edge.b)) else {
            continue; // There is none: such a replay was refused.
        };
        let id = format!("edge {number}");
        for step in redrawn(edge, [ends.0, ends.1]) {
            let ends = [place(ends.0, step), place(ends.1, step)];
            events.draw(
                step,
                topic,
                "world",
                &id,
                lines(PAIRS, ends, &colour(BLUE, 0.6)),
            );
        }
        if let Some(died) = edge.died {
            events.erase(died, topic, &id);
        }
    }
}

/// Returns the steps at which an edge is drawn: when it appears, and when one of its ends moves.
fn redrawn(edge: &MapEdge, ends: [&MapNode; 2]) -> Vec<u32> {
    let lives = |step: &u32| *step > edge.born && edge.died.is_none_or(|died| *step < died);
    let moves = ends.into_iter().flat_map(|node| &node.moves);
    let moves = moves.map(|moved| moved.step).filter(lives);
    let mut steps: Vec<u32> = core::iter::once(edge.born).chain(moves).collect();
    steps.sort_unstable();
    steps.dedup();
    steps
}

/// Returns the position of a node at a step.
fn place(node: &MapNode, step: u32) -> Point {
    let moved = node.moves.iter().rev().find(|moved| moved.step <= step);
    moved.map_or(node.position, |moved| moved.position)
}

fn believe(belief: &Belief, track: &RobotTrack, topic: &str, events: &mut Events) {
    for entry in &belief.entries {
        let discs = entry.shapes.iter().filter_map(|shape| {
            let (centre, radius, weight) = extent(shape, track, entry.step)?;
            Some(disc(centre, radius, &colour(RED, weight)))
        });
        let discs: Vec<Value> = discs.collect();
        let spheres = json!({ "spheres": discs });
        events.draw(entry.step, topic, "world", "belief", spheres);
    }
}

/// Returns a disc for a part of a belief: its centre, radius (m) and weight. `None` for a node that
/// is on no map.
fn extent(shape: &Shape, track: &RobotTrack, step: u32) -> Option<(Point, f64, f64)> {
    Some(match *shape {
        Shape::Point { position, weight } => (position, 0.1, weight),
        Shape::Pose { pose, weight } => (pose.position, 0.1, weight),
        Shape::Node { id, weight } => {
            let mut nodes = track.maps.iter().flat_map(|map| &map.nodes);
            (place(nodes.find(|node| node.id == id)?, step), 0.1, weight)
        }
        Shape::Box { min, max, weight } => {
            let half = 0.5 * (max - min);
            (min + half, half.norm(), weight)
        }
        Shape::Ellipse {
            centre,
            semi_axes: [a, b],
            weight,
            ..
        } => (centre, a.max(b), weight),
    })
}

#[cfg(test)]
mod tests {
    use mcap::MessageStream;

    use super::*;
    use crate::{Mark, NodeMove, TimeSeries};

    fn replay() -> Replay {
        let pose = |x| Pose::new(Point::new(x, 0.5), Heading::NORTH);
        let body = Body::Circle { radius: 0.1 };
        let mut track = RobotTrack::new("mouse", body, vec![pose(0.2), pose(0.7), pose(1.2)]);
        let mut first = MapNode::new(3, Point::new(0.0, 0.0), 1);
        let position = Point::new(0.5, 0.0);
        first.moves.push(NodeMove { step: 2, position });
        track.maps.push(MapGrowth {
            name: "places".to_owned(),
            nodes: vec![first, MapNode::new(4, Point::new(1.0, 0.0), 1)],
            edges: vec![MapEdge::new(3, 4, 1)],
        });
        let mut coverage = TimeSeries::new("coverage", "%");
        coverage.sample(2, 0.25);
        track.series.push(coverage);
        track.marks.push(Marks::new(Mark::Bump, "bump", [1]));
        let scenery = Scenery {
            walls: vec![[Point::new(0.0, 0.0), Point::new(1.0, 0.0)]],
            ..Scenery::default()
        };
        Replay::new("Two steps", 0.1, scenery, vec![track])
    }

    /// Returns topic, schema, time (ns) and content of each message.
    fn read(bytes: &[u8]) -> Vec<(String, String, u64, Value)> {
        let message = |message: Result<mcap::Message<'_>, _>| {
            let message = message.unwrap();
            let schema = message.channel.schema.as_ref().unwrap();
            assert_eq!(schema.encoding, "jsonschema");
            let named: Value = serde_json::from_slice(&schema.data).unwrap();
            let content: Value = serde_json::from_slice(&message.data).unwrap();
            for field in content.as_object().unwrap().keys() {
                assert!(
                    named["properties"].get(field).is_some(),
                    "{field} is not in the schema"
                );
            }
            let topic = message.channel.topic.clone();
            (topic, schema.name.clone(), message.log_time, content)
        };
        MessageStream::new(bytes).unwrap().map(message).collect()
    }

    #[test]
    fn what_is_written_is_read_back_by_the_library_of_the_format() {
        let messages = read(&mcap(&replay()).unwrap());
        let of = |topic: &str| -> Vec<_> {
            let of = messages.iter().filter(|message| message.0 == topic);
            of.cloned().collect()
        };
        assert!(messages.is_sorted_by_key(|message| message.2));
        let poses = of("/tf");
        assert_eq!(poses.len(), 3);
        assert_eq!(poses[2].2, 200_000_000);
        assert_eq!(poses[2].3["translation"]["x"], 1.2);
        let half = poses[0].3["rotation"]["z"].as_f64().unwrap();
        assert!(
            (half - 0.5_f64.sqrt()).abs() < 1e-12,
            "north is a quarter turn"
        );
        let walls = &of("/scene")[0];
        assert_eq!(walls.1, SCENE);
        assert_eq!(walls.3["entities"][0]["lines"][0]["points"][1]["x"], 1.0);
        assert_eq!(of("/mouse/coverage")[0].3["value"], 0.25);
        assert_eq!(of("/log")[0].3["message"], "bump");
    }

    #[test]
    fn an_edge_follows_its_node() {
        let messages = read(&mcap(&replay()).unwrap());
        let ends = messages.iter().filter_map(|(topic, _, time, message)| {
            let entity = &message["entities"][0];
            let is_edge = topic == "/mouse/map/places" && entity["id"] == "edge 0";
            is_edge.then(|| (*time, entity["lines"][0]["points"][0]["x"].clone()))
        });
        let ends: Vec<_> = ends.collect();
        assert_eq!(ends, [(100_000_000, json!(0.0)), (200_000_000, json!(0.5))]);
    }

    #[test]
    fn the_same_replay_gives_the_same_bytes() {
        assert_eq!(mcap(&replay()).unwrap(), mcap(&replay()).unwrap());
    }

    #[test]
    fn what_cannot_be_played_is_refused() {
        let mut empty = replay();
        empty.tracks.clear();
        let refused = mcap(&empty);
        assert!(matches!(
            refused,
            Err(McapExportError::Replay(EncodeError::Empty))
        ));
    }
}
