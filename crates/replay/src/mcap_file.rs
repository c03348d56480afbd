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
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use serde_json::{Value, json};
use thiserror::Error;
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::Ring;

use super::{
    EncodeError, EventContent, FloorDisc, FloorDrawing, Replay, ReplayEvent, Rgba, WORLD, events,
};

/// Reason why a replay cannot be written as MCAP.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum McapExportError {
    /// The replay itself is invalid.
    #[error(transparent)]
    Replay(#[from] EncodeError),
    /// The MCAP writer refuses the replay.
    #[error("the replay does not fit into MCAP; write it as HTML")]
    Write(#[from] McapError),
}

/// Returns a replay as the bytes of an MCAP file; the same replay gives the same bytes. Times are
/// those of the run, from 0. It holds the [`events`] of the replay.
///
/// # Errors
/// As [`json`](super::json), and if there are more than 65,535 topics.
pub fn mcap(replay: &Replay) -> Result<Vec<u8>, McapExportError> {
    let events = events(replay)?;
    Ok(written(replay, &events)?)
}

fn written(replay: &Replay, events: &[ReplayEvent<'_>]) -> Result<Vec<u8>, McapError> {
    let options = WriteOptions::new().library("tolman-replay");
    let mut writer = Writer::with_options(Cursor::new(Vec::new()), options)?;
    let mut channels: BTreeMap<&str, u16> = BTreeMap::new();
    for (sequence, event) in (0..).zip(events) {
        let channel_id = match channels.get(event.topic.as_str()) {
            Some(id) => *id,
            None => {
                let name = schema_name(&event.content);
                let data = schema(name).to_string();
                let schema = writer.add_schema(name, "jsonschema", data.as_bytes())?;
                let id = writer.add_channel(schema, &event.topic, "json", &BTreeMap::new())?;
                channels.insert(&event.topic, id);
                id
            }
        };
        let log_time = replay.nanos(event.step);
        let header = MessageHeader {
            channel_id,
            sequence,
            log_time,
            publish_time: log_time,
        };
        let message = message(&event.content, &timestamp(log_time));
        writer.write_to_known_channel(&header, message.to_string().as_bytes())?;
    }
    writer.finish()?;
    Ok(writer.into_inner().into_inner())
}

/// Returns a time in the form that messages use.
fn timestamp(nanos: u64) -> Value {
    json!({ "sec": nanos / 1_000_000_000, "nsec": nanos % 1_000_000_000 })
}

const SCENE: &str = "foxglove.SceneUpdate";
const TRANSFORM: &str = "foxglove.FrameTransform";
const SCAN: &str = "foxglove.LaserScan";
const LOG: &str = "foxglove.Log";
const NUMBER: &str = "tolman.Number";

/// Returns the name of the schema of the event's message.
const fn schema_name(content: &EventContent<'_>) -> &'static str {
    match content {
        EventContent::Pose { .. } => TRANSFORM,
        EventContent::Draw { .. } | EventContent::Erase { .. } => SCENE,
        EventContent::Scan { .. } => SCAN,
        EventContent::Number { .. } => NUMBER,
        EventContent::Text { .. } => LOG,
    }
}

/// Returns the schema of a message, with only the fields that these messages use.
fn schema(name: &str) -> Value {
    let (object, array, number) = ("object", "array", "number");
    let fields: &[(&str, &str)] = match name {
        SCENE => &[("entities", array), ("deletions", array)],
        TRANSFORM => &[
            ("timestamp", object),
            ("parent_frame_id", "string"),
            ("child_frame_id", "string"),
            ("translation", object),
            ("rotation", object),
        ],
        SCAN => &[
            ("timestamp", object),
            ("frame_id", "string"),
            ("pose", object),
            ("start_angle", number),
            ("end_angle", number),
            ("ranges", array),
            ("intensities", array),
        ],
        LOG => &[
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

/// Returns the message of an event.
fn message(content: &EventContent<'_>, timestamp: &Value) -> Value {
    match content {
        EventContent::Pose { frame, pose } => json!({
            "timestamp": timestamp, "parent_frame_id": WORLD, "child_frame_id": frame,
            "translation": point(pose.position), "rotation": rotation(pose.heading),
        }),
        EventContent::Draw { frame, id, drawing } => {
            let mut entity = entity(drawing);
            entity["timestamp"] = timestamp.clone();
            entity["frame_id"] = frame.as_str().into();
            entity["id"] = id.as_str().into();
            json!({ "entities": [entity] })
        }
        EventContent::Erase { id, .. } => {
            let gone = json!({ "timestamp": timestamp, "type": 0, "id": id });
            json!({ "deletions": [gone] })
        }
        EventContent::Scan {
            frame,
            ring,
            ranges,
        } => scan(frame, ring, ranges, timestamp),
        EventContent::Number { value, unit } => json!({ "value": value, "unit": unit }),
        EventContent::Text { source, text } => json!({
            "timestamp": timestamp, "level": 2, "name": source, "message": text,
        }),
    }
}

fn scan(frame: &str, ring: &Ring, ranges: &[f64], timestamp: &Value) -> Value {
    let last = ring.beams.saturating_sub(1);
    let none: [f64; 0] = [];
    json!({
        "timestamp": timestamp, "frame_id": frame, "pose": at(Pose::IDENTITY),
        "start_angle": ring.bearing(0), "end_angle": ring.bearing(0) + ring.spacing * f64::from(last),
        "ranges": ranges, "intensities": none,
    })
}

fn point(point: Point) -> Value {
    json!({ "x": point.x, "y": point.y, "z": 0.0 })
}

fn rotation(heading: Heading) -> Value {
    let half = 0.5 * heading.radians();
    json!({ "x": 0.0, "y": 0.0, "z": libm::sin(half), "w": libm::cos(half) })
}

fn at(pose: Pose) -> Value {
    json!({ "position": point(pose.position), "orientation": rotation(pose.heading) })
}

fn colour([r, g, b, a]: Rgba) -> Value {
    json!({ "r": r, "g": g, "b": b, "a": a })
}

/// Line types of Foxglove: a closed loop, and pairs of points.
const LOOP: u8 = 1;
const PAIRS: u8 = 2;

/// Returns the entity of a drawing, without time, frame and id.
fn entity(drawing: &FloorDrawing) -> Value {
    match drawing {
        FloorDrawing::Segments(segments, ink) => {
            lines(PAIRS, segments.iter().flatten().copied(), *ink)
        }
        FloorDrawing::Outline(corners, ink) => lines(LOOP, corners.iter().copied(), *ink),
        FloorDrawing::Discs(discs) => {
            let discs: Vec<Value> = discs.iter().map(disc).collect();
            json!({ "spheres": discs })
        }
    }
}

fn lines(kind: u8, points: impl Iterator<Item = Point>, ink: Rgba) -> Value {
    let points: Vec<Value> = points.map(point).collect();
    json!({ "lines": [{
        "type": kind, "pose": at(Pose::IDENTITY), "thickness": 2.0, "scale_invariant": true,
        "points": points, "color": colour(ink),
    }] })
}

fn disc(disc: &FloorDisc) -> Value {
    let diameter = 2.0 * disc.radius;
    json!({
        "pose": at(Pose::new(disc.centre, Heading::EAST)), "color": colour(disc.colour),
        "size": { "x": diameter, "y": diameter, "z": 0.01 },
    })
}

#[cfg(test)]
mod tests {
    use mcap::MessageStream;

    use super::*;
    use tolman_robot::Body;

    use crate::{
        MapEdge, MapGrowth, MapNode, Mark, Marks, NodeMove, RobotTrack, Scenery, TimeSeries,
    };

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
