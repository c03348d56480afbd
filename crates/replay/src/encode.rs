//! A replay as the player reads it: JSON, format `tolman-replay`, version 2 (`docs/replay.md`).

use serde_json::{Value, json};
use thiserror::Error;
use tolman_draw::visible;
use tolman_geom::Point;
use tolman_robot::{Body, Ring};
use tolman_sim::{Bounds, DoorState};

use super::rounding::{bounds_of, rounded};
use super::{
    Belief, Chapter, Exemplar, Fact, Field, MapEdge, MapGrowth, MapNode, Marks, Notes, Replay,
    RobotTrack, Scans, SceneryDoor, SceneryZone, Shape, TimeSeries, blob,
};

const FORMAT: &str = "tolman-replay";
const VERSION: u32 = 2;

/// Reason why a replay cannot be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// The replay has no track with a pose.
    #[error("there is no track with a pose; give at least one")]
    Empty,
    /// The time step is not positive.
    #[error("the time step is {step_s} s; give one above 0")]
    Step {
        /// Time step that was given, s.
        step_s: f64,
    },
    /// A number is not finite.
    #[error("{what} {index} holds a number that is not finite; give finite numbers")]
    NotFinite {
        /// Kind of the item, such as a pose.
        what: String,
        /// Index of the item, from 0.
        index: usize,
    },
    /// Steps that must ascend do not.
    #[error("{what} {index} is of an earlier step than the one before it; sort them by step")]
    Order {
        /// Kind of the item.
        what: String,
        /// Index of the item, from 0.
        index: usize,
    },
    /// A reading does not have one range per beam.
    #[error("{what} {index} has {found} ranges; give {expected}, one per beam")]
    Ranges {
        /// Kind of the reading.
        what: String,
        /// Index of the reading, from 0.
        index: usize,
        /// Number of ranges in the reading.
        found: usize,
        /// Number of beams.
        expected: usize,
    },
    /// An edge ends at a node that does not exist.
    #[error(
        "edge {index} of the map `{map}` names node {id}, which does not exist; add the node or remove the edge"
    )]
    NoNode {
        /// Name of the map.
        map: String,
        /// Index of the edge, from 0.
        index: usize,
        /// Id of the missing node.
        id: u32,
    },
    /// Two nodes share an id.
    #[error("two nodes of the map `{map}` have the id {id}; number them")]
    NodeTwice {
        /// Name of the map.
        map: String,
        /// Id that two nodes share.
        id: u32,
    },
    /// The grid of a field is empty.
    #[error(
        "the field `{field}` has {columns} columns of cells {pitch} m wide; give at least one \
         column and a width above 0"
    )]
    Grid {
        /// Name of the field.
        field: String,
        /// Number of the field's columns.
        columns: u32,
        /// Side of a cell, m.
        pitch: f64,
    },
}

/// Returns the replay as JSON that may stand between `<script type="application/json">` and
/// `</script>`, because it contains no `<`. A pose near the previous one takes at most 9
/// characters, and each robot a few hundred more.
///
/// Linear in the size of the replay.
///
/// # Errors
/// [`EncodeError`] if there is nothing to play, or if a number, an order or a name is invalid.
pub fn json(replay: &Replay) -> Result<String, EncodeError> {
    let mut value = value(replay)?;
    show_hidden(&mut value);
    Ok(value.to_string().replace('<', "\\u003c"))
}

/// Makes all texts [`visible`].
fn show_hidden(value: &mut Value) {
    match value {
        Value::String(text) => *text = visible(text).into_owned(),
        Value::Array(items) => items.iter_mut().for_each(show_hidden),
        Value::Object(fields) => fields.values_mut().for_each(show_hidden),
        _ => {}
    }
}

fn value(replay: &Replay) -> Result<Value, EncodeError> {
    if !(replay.step_s.is_finite() && replay.step_s > 0.0) {
        return Err(EncodeError::Step {
            step_s: replay.step_s,
        });
    }
    if !replay.tracks.iter().any(|track| !track.poses.is_empty()) {
        return Err(EncodeError::Empty);
    }
    let scenery = &replay.scenery;
    all_finite("wall", &scenery.walls, |wall| wall.iter().all(finite))?;
    all_finite("zone", &scenery.zones, |zone| {
        zone.corners.iter().all(finite)
    })?;
    all_finite("door", &scenery.doors, |door| door.ends.iter().all(finite))?;
    for track in &replay.tracks {
        all_finite("pose", &track.poses, |pose| pose.is_finite())?;
    }
    let ends = scenery.walls.iter().flatten().copied();
    let positions = replay.tracks.iter().flat_map(|track| &track.poses);
    let corners = scenery.zones.iter().flat_map(|zone| &zone.corners).copied();
    let ends = ends.chain(corners);
    let bounds = bounds_of(ends.chain(positions.map(|pose| pose.position)));
    let tracks = replay.tracks.iter();
    let tracks = tracks.map(|track| self::track(track, &bounds));
    Ok(json!({
        "format": FORMAT,
        "version": VERSION,
        "title": replay.title,
        "facts": facts(&replay.facts),
        "step_s": replay.step_s,
        "chapters": chapters(&replay.chapters)?,
        "box": [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y],
        "walls": blob::floats(coordinates(scenery.walls.iter().flatten())),
        "zones": scenery.zones.iter().map(zone).collect::<Value>(),
        "doors": each(&scenery.doors, door)?,
        "tracks": tracks.collect::<Result<Vec<_>, _>>()?,
        "marks": each(&replay.marks, marks)?,
    }))
}

fn chapters(chapters: &[Chapter]) -> Result<Value, EncodeError> {
    ascend("chapter", chapters.iter().map(|chapter| chapter.from))?;
    let chapters = chapters.iter();
    let chapters = chapters.map(|chapter| json!([chapter.from, chapter.caption, chapter.seconds]));
    Ok(chapters.collect())
}

fn zone(zone: &SceneryZone) -> Value {
    let corners = blob::floats(coordinates(&zone.corners));
    json!({ "kind": zone.kind, "name": zone.name, "corners": corners })
}

fn door(door: &SceneryDoor) -> Result<Value, EncodeError> {
    ascend("change of a door", door.changes.iter().map(|c| c.step))?;
    let changes = door.changes.iter();
    let changes =
        changes.map(|change| json!([change.step, u8::from(change.state == DoorState::Shut)]));
    let ends: Vec<f64> = coordinates(&door.ends).collect();
    Ok(json!({ "name": door.name, "ends": ends, "shut": changes.collect::<Value>() }))
}

fn track(track: &RobotTrack, bounds: &Bounds) -> Result<Value, EncodeError> {
    ascend("lift", track.lifts.iter().copied())?;
    let poses = track.poses.iter().map(|pose| rounded(bounds, *pose));
    let along = |axis: usize| blob::changes(poses.clone().map(|pose| i32::from(pose[axis])));
    // A turn across ±π is also a small change.
    let headings = poses.clone().scan(0_i32, |before, [_, _, heading]| {
        *before += i32::from(heading.wrapping_sub(*before as u16) as i16);
        Some(*before)
    });
    let body = match &track.body {
        Body::Circle { radius } => json!({ "radius": radius }),
        Body::Polygon { corners } => {
            json!({ "corners": coordinates(corners).collect::<Vec<f64>>() })
        }
    };
    Ok(json!({
        "name": track.name,
        "body": body,
        "ring": track.ring.as_ref().map(ring),
        "scans": track.scans.as_ref().map(scans).transpose()?,
        "x": along(0),
        "y": along(1),
        "heading": blob::changes(headings),
        "lifts": track.lifts,
        "maps": each(&track.maps, map)?,
        "beliefs": each(&track.beliefs, belief)?,
        "fields": each(&track.fields, field)?,
        "series": each(&track.series, series)?,
        "notes": each(&track.notes, notes)?,
        "marks": each(&track.marks, marks)?,
    }))
}

fn ring(ring: &Ring) -> Value {
    json!({
        "beams": ring.beams,
        "first": ring.first_bearing,
        "spacing": ring.spacing,
        "reach": ring.max_range,
    })
}

/// Maximum value of a range that takes two bytes.
const FINE: f64 = 65535.0;
const COARSE: f64 = 255.0;

/// Returns ranges as shares of the ring's reach, in whole parts of `most`. A beam that met nothing,
/// or read NaN, counts as the reach.
fn shares<'a>(
    (what, index): (&str, usize),
    ring: &'a Ring,
    ranges: &'a [f64],
    most: f64,
) -> Result<impl Iterator<Item = f64>, EncodeError> {
    let (found, expected) = (ranges.len(), ring.beams as usize);
    if found != expected {
        return Err(EncodeError::Ranges {
            what: what.to_owned(),
            index,
            found,
            expected,
        });
    }
    let share = move |range: &f64| match range / ring.max_range {
        share if share >= 0.0 => libm::round(share.min(1.0) * most),
        _ => most,
    };
    Ok(ranges.iter().map(share))
}

fn scans(scans: &Scans) -> Result<Value, EncodeError> {
    let steps = steps("scan", scans.steps.iter().copied())?;
    let mut bytes = Vec::new();
    for (index, ranges) in scans.ranges.iter().enumerate() {
        let shares = shares(("scan", index), &scans.ring, ranges, FINE)?;
        bytes.extend(shares.flat_map(|share| (share as u16).to_le_bytes()));
    }
    Ok(json!({ "ring": ring(&scans.ring), "steps": steps, "ranges": blob::bytes(&bytes) }))
}

fn map(map: &MapGrowth) -> Result<Value, EncodeError> {
    let mut ids: Vec<u32> = map.nodes.iter().map(|node| node.id).collect();
    ids.sort_unstable();
    if let Some(twice) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(EncodeError::NodeTwice {
            map: map.name.clone(),
            id: twice[0],
        });
    }
    for (index, edge) in map.edges.iter().enumerate() {
        for id in [edge.a, edge.b] {
            if ids.binary_search(&id).is_err() {
                return Err(EncodeError::NoNode {
                    map: map.name.clone(),
                    index,
                    id,
                });
            }
        }
    }
    all_finite("node", &map.nodes, |node| {
        finite(&node.position) && node.moves.iter().all(|moved| finite(&moved.position))
    })?;
    all_finite("edge", &map.edges, |edge| edge.way.iter().all(finite))?;
    Ok(json!({
        "name": map.name,
        "nodes": each(&map.nodes, node)?,
        "edges": map.edges.iter().map(edge).collect::<Value>(),
    }))
}

/// Returns a node without its empty fields: maps have many nodes, and most have few facts.
fn node(node: &MapNode) -> Result<Value, EncodeError> {
    ascend("move of a node", node.moves.iter().map(|moved| moved.step))?;
    let moves = node.moves.iter();
    let moves = moves.map(|moved| json!([moved.step, place(moved.position)]));
    ascend(
        "label of a node",
        node.labels.iter().map(|label| label.step),
    )?;
    let labels = node.labels.iter();
    let labels = labels.map(|label| json!([label.step, label.text]));
    let mut value = json!({
        "id": node.id,
        "at": place(node.position),
        "born": node.born,
        "died": node.died,
        "labels": labels.collect::<Value>(),
        "facts": facts(&node.facts),
        "visits": steps("visit of a node", node.visits.iter().copied())?,
        "moves": moves.collect::<Value>(),
        "exemplar": node.exemplar.as_ref().map(exemplar).transpose()?,
    });
    if let Value::Object(object) = &mut value {
        object.retain(|_, value| ![Value::Null, json!(""), json!([])].contains(value));
    }
    Ok(value)
}

fn exemplar(Exemplar { heading, scan }: &Exemplar) -> Result<Value, EncodeError> {
    let shares = shares(("exemplar scan", 0), &scan.ring, &scan.ranges, COARSE)?;
    Ok(json!({
        "heading": short(heading.radians()),
        "ring": ring(&scan.ring),
        "ranges": blob::bytes(&shares.map(|share| share as u8).collect::<Vec<_>>()),
    }))
}

fn edge(edge: &MapEdge) -> Value {
    // Arrays instead of objects, because a large map has many edges.
    let mut value = json!([edge.a, edge.b, edge.kind, edge.born, edge.died, edge.label]);
    if let (Value::Array(parts), false) = (&mut value, edge.way.is_empty()) {
        let way = coordinates(&edge.way).map(|along| libm::round(along * 1e3) / 1e3);
        parts.push(way.collect());
    }
    value
}

fn belief(belief: &Belief) -> Result<Value, EncodeError> {
    ascend("belief", belief.entries.iter().map(|entry| entry.step))?;
    let entries = belief.entries.iter().map(|entry| {
        let shapes: Vec<Value> = entry.shapes.iter().map(shape).collect();
        json!([entry.step, shapes])
    });
    Ok(json!({ "name": belief.name, "entries": entries.collect::<Vec<Value>>() }))
}

/// Returns a shape. Non-finite numbers become null, which the player leaves out.
fn shape(shape: &Shape) -> Value {
    match *shape {
        Shape::Point { position, weight } => {
            json!(["point", short(weight), place(position)])
        }
        Shape::Pose { pose, weight } => {
            let heading = short(pose.heading.radians());
            json!(["pose", short(weight), place(pose.position), heading])
        }
        Shape::Node { id, weight } => json!(["node", short(weight), id]),
        Shape::Box { min, max, weight } => {
            json!(["box", short(weight), place(min), place(max)])
        }
        Shape::Ellipse {
            centre,
            semi_axes: [a, b],
            heading,
            weight,
        } => {
            let heading = short(heading.radians());
            json!([
                "ellipse",
                short(weight),
                place(centre),
                [short(a), short(b)],
                heading
            ])
        }
    }
}

fn field(field: &Field) -> Result<Value, EncodeError> {
    let steps = steps("change of a field", field.changes.iter().map(|c| c.step))?;
    if !(field.pitch.is_finite() && field.pitch > 0.0 && field.columns > 0) {
        return Err(EncodeError::Grid {
            field: field.name.clone(),
            columns: field.columns,
            pitch: field.pitch,
        });
    }
    // A cell without a value is NaN, which single precision has.
    let values = field.changes.iter().map(|c| c.value.unwrap_or(f64::NAN));
    Ok(json!({
        "name": field.name,
        "origin": place(field.origin),
        "pitch": field.pitch,
        "columns": field.columns,
        "range": field.range,
        "steps": steps,
        "cells": blob::numbers(field.changes.iter().map(|c| c.cell)),
        "values": blob::floats(values),
    }))
}

fn series(series: &TimeSeries) -> Result<Value, EncodeError> {
    let steps = || series.samples.iter().map(|sample| sample.step);
    let encoded = self::steps("sample", steps())?;
    all_finite("sample", &series.samples, |sample| sample.value.is_finite())?;
    let values = || series.samples.iter().map(|sample| sample.value);
    let mut object = json!({ "name": series.name, "unit": series.unit, "steps": encoded });
    let is_whole = |value: f64| (libm::trunc(value) - value).abs() <= 0.0 && value.abs() < 1e9;
    if values().all(is_whole) {
        object["whole"] = blob::changes(values().map(|value| value as i32)).into();
    } else {
        object["values"] = blob::floats(values()).into();
    }
    // Values at every step from the first on need no list of steps.
    if let Some(first) = steps().next()
        && steps()
            .zip(first..)
            .all(|(step, expected)| step == expected)
    {
        object["steps"] = first.into();
    }
    Ok(object)
}

/// Returns each text once, in the order in which they first appear, and their indices by step.
fn notes(notes: &Notes) -> Result<Value, EncodeError> {
    let steps = steps("note", notes.notes.iter().map(|note| note.step))?;
    let mut texts: Vec<&str> = Vec::new();
    let mut numbers = alloc::collections::BTreeMap::new();
    let mut indices = Vec::new();
    for note in &notes.notes {
        let next = texts.len() as u32;
        let index = *numbers.entry(note.text.as_str()).or_insert(next);
        if index == next {
            texts.push(&note.text);
        }
        indices.push(index);
    }
    Ok(json!({
        "name": notes.name,
        "texts": texts,
        "steps": steps,
        "index": blob::numbers(indices),
    }))
}

fn marks(marks: &Marks) -> Result<Value, EncodeError> {
    let steps = steps("mark", marks.steps.iter().copied())?;
    Ok(json!({ "kind": marks.kind, "name": marks.name, "steps": steps }))
}

fn facts(facts: &[Fact]) -> Value {
    facts
        .iter()
        .map(|fact| json!([fact.name, fact.value]))
        .collect()
}

/// Returns a position rounded to a tenth of a millimetre.
fn place(point: Point) -> Value {
    json!([short(point.x), short(point.y)])
}

/// Returns a number rounded to four decimals.
fn short(number: f64) -> f64 {
    libm::round(number * 1e4) / 1e4
}

fn finite(point: &Point) -> bool {
    point.x.is_finite() && point.y.is_finite()
}

fn each<T>(
    all: &[T],
    encode: fn(&T) -> Result<Value, EncodeError>,
) -> Result<Vec<Value>, EncodeError> {
    all.iter().map(encode).collect()
}

fn all_finite<T>(what: &str, all: &[T], holds: impl Fn(&T) -> bool) -> Result<(), EncodeError> {
    match all.iter().position(|one| !holds(one)) {
        Some(index) => Err(EncodeError::NotFinite {
            what: what.to_owned(),
            index,
        }),
        None => Ok(()),
    }
}

/// Returns the coordinates of points, x and y in turn.
fn coordinates<'a>(points: impl IntoIterator<Item = &'a Point>) -> impl Iterator<Item = f64> {
    points.into_iter().flat_map(|at| [at.x, at.y])
}

/// Returns steps, which must ascend.
fn steps(what: &str, steps: impl Iterator<Item = u32> + Clone) -> Result<String, EncodeError> {
    ascend(what, steps.clone())?;
    Ok(blob::steps(steps))
}

fn ascend(what: &str, steps: impl Iterator<Item = u32>) -> Result<(), EncodeError> {
    let mut before = 0;
    for (index, step) in steps.enumerate() {
        if step < before {
            return Err(EncodeError::Order {
                what: what.to_owned(),
                index,
            });
        }
        before = step;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use tolman_geom::{Heading, Pose};
    use tolman_robot::Scan;

    use super::*;
    use crate::{BeliefAt, FieldChange, NodeMove, Note, Sample, Scenery, ZoneKind};

    /// Returns a replay with every kind of layer.
    fn full() -> Replay {
        let at = |x: f64| Point::new(x, 0.5);
        let pose = |x| Pose::new(at(x), Heading::from_radians(3.0 + x));
        let ring = Ring::full(4, 2.0);
        let body = Body::Circle { radius: 0.1 };
        let mut track = RobotTrack::new("robot", body, vec![pose(0.0), pose(0.25), pose(1.0)]);
        track.ring = Some(ring);
        let mut node = MapNode::new(7, at(0.0), 0);
        node.moves.push(NodeMove {
            step: 1,
            position: at(0.1),
        });
        node.visits = vec![0, 2];
        node.exemplar = Some(Exemplar {
            heading: Heading::EAST,
            scan: Scan::clear(ring),
        });
        track.maps.push(MapGrowth {
            name: "map".to_owned(),
            nodes: vec![node, MapNode::new(9, at(1.0), 2)],
            edges: vec![MapEdge::new(7, 9, 2)],
        });
        let shape = Shape::Node { id: 7, weight: 1.0 };
        let entries = vec![BeliefAt {
            step: 1,
            shapes: vec![shape],
        }];
        track.beliefs.push(Belief {
            name: "belief".to_owned(),
            entries,
        });
        track.fields.push(Field {
            name: "field".to_owned(),
            origin: at(0.0),
            pitch: 1.0,
            columns: 1,
            range: [0.0, 1.0],
            changes: vec![FieldChange {
                step: 0,
                cell: 0,
                value: None,
            }],
        });
        let samples = |values: [f64; 2]| {
            (0..)
                .zip(values)
                .map(|(step, value)| Sample { step, value })
                .collect()
        };
        for values in [[1.0, -3.0], [0.5, 1.0]] {
            let (name, unit) = ("number".to_owned(), String::new());
            track.series.push(TimeSeries {
                name,
                unit,
                samples: samples(values),
            });
        }
        let note = |step, text: &str| Note {
            step,
            text: text.to_owned(),
        };
        let notes = vec![note(0, "a"), note(1, "b"), note(2, "a")];
        track.notes.push(Notes {
            name: "notes".to_owned(),
            notes,
        });
        let zone = SceneryZone {
            kind: ZoneKind::Region,
            name: String::new(),
            corners: vec![at(0.0)],
        };
        let scenery = Scenery {
            zones: vec![zone],
            ..Scenery::default()
        };
        Replay::new("full", 0.1, scenery, vec![track])
    }

    #[test]
    fn every_layer_is_written() {
        let value = value(&full()).unwrap();
        let track = &value["tracks"][0];
        // The box is a metre wide: a quarter is 16384 of 65535.
        assert_eq!(track["x"], blob::changes([0, 16384, 65535]));
        assert_eq!(track["series"][0]["whole"], blob::changes([1, -3]));
        assert_eq!(track["series"][0]["steps"], 0, "one at each step");
        assert_eq!(track["series"][1]["values"], blob::floats([0.5, 1.0]));
        assert_eq!(track["notes"][0]["texts"], json!(["a", "b"]));
        assert_eq!(track["notes"][0]["index"], blob::numbers([0, 1, 0]));
        assert_eq!(
            track["maps"][0]["nodes"][0]["moves"],
            json!([[1, [0.1, 0.5]]])
        );
        let exemplar = &track["maps"][0]["nodes"][0]["exemplar"]["ranges"];
        assert_eq!(*exemplar, blob::bytes(&[255; 4]));
        assert_eq!(
            track["maps"][0]["edges"],
            json!([[7, 9, "passage", 2, null, ""]])
        );
        assert_eq!(
            track["beliefs"][0]["entries"],
            json!([[1, [["node", 1.0, 7]]]])
        );
    }

    #[test]
    fn a_turn_past_the_seam_is_a_small_change() {
        let value = value(&full()).unwrap();
        // From 3.0 to 3.25 rad and on to 4.0, of which π is passed.
        let quantum = |radians: f64| {
            libm::round((radians + core::f64::consts::PI) * 65536.0 / core::f64::consts::TAU) as i32
        };
        let headings = [3.0, 3.25, 4.0].map(quantum);
        assert!(headings[1] > 65536, "past the seam");
        // The first heading is counted from the side of the seam that is nearer to 0.
        let expected = blob::changes(headings.map(|heading| heading - 65536));
        assert_eq!(value["tracks"][0]["heading"], expected);
    }

    #[test]
    fn what_makes_no_sense_is_refused_by_name() {
        let refused = |change: fn(&mut Replay)| {
            let mut replay = full();
            change(&mut replay);
            json(&replay).unwrap_err().to_string()
        };
        for (error, part) in [
            (refused(|replay| replay.tracks.clear()), "no track"),
            (refused(|replay| replay.step_s = f64::NAN), "NaN s"),
            (
                refused(|replay| replay.tracks[0].poses[1].position.x = f64::INFINITY),
                "pose 1",
            ),
            (
                refused(|replay| replay.tracks[0].maps[0].edges[0].b = 8),
                "node 8",
            ),
            (
                refused(|replay| replay.tracks[0].maps[0].nodes[1].id = 7),
                "the id 7",
            ),
            (
                refused(|replay| replay.tracks[0].notes[0].notes[0].step = 2),
                "note 1",
            ),
            (
                refused(|replay| replay.tracks[0].fields[0].columns = 0),
                "0 columns",
            ),
        ] {
            assert!(error.contains(part), "no `{part}` in: {error}");
        }
    }
}
