//! A replay as events in order of time, for writers of other formats.

use alloc::collections::BTreeMap;
use core::f64::consts::TAU;

use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Body, Ring};
use tolman_sim::DoorState;

use super::{
    Belief, EncodeError, MapEdge, MapGrowth, MapNode, Marks, Replay, RobotTrack, Scans, Scenery,
    Shape, json as checked,
};

/// Something that happens in a replay at a step.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayEvent<'a> {
    /// Step at which the event happens.
    pub step: u32,
    /// Subject, as a path: `/scene`, `/ROBOT/map/NAME`.
    pub topic: String,
    /// Content of the event.
    pub content: EventContent<'a>,
}

/// Kind of a [`ReplayEvent`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EventContent<'a> {
    /// A robot has this pose in the world.
    Pose {
        /// Name of the frame that moves with the robot.
        frame: String,
        /// Pose in the world's frame.
        pose: Pose,
    },
    /// A thing is drawn. It replaces the thing with the same id on this topic.
    Draw {
        /// Frame in which the drawing's coordinates are given: [`WORLD`], or that of a robot.
        frame: String,
        /// Id, unique on its topic.
        id: String,
        /// Drawing of the thing.
        drawing: FloorDrawing,
    },
    /// The thing with this id on this topic disappears.
    Erase {
        /// Frame in which the thing was drawn.
        frame: String,
        /// Id of the thing on its topic.
        id: String,
    },
    /// The range sensor was read.
    Scan {
        /// Frame of the robot, in which the beams are given.
        frame: String,
        /// Geometry of the beams.
        ring: &'a Ring,
        /// Range of each beam, m.
        ranges: &'a [f64],
    },
    /// A number of a time series changes.
    Number {
        /// New value of the series.
        value: f64,
        /// Unit; `%` means that the value is a share.
        unit: &'a str,
    },
    /// A note or mark begins.
    Text {
        /// Name of the robot and of the layer.
        source: String,
        /// Text of the note or mark.
        text: &'a str,
    },
}

/// Name of the frame that does not move.
pub const WORLD: &str = "world";

/// A drawing on the floor, in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum FloorDrawing {
    /// Segments of one colour.
    Segments(Vec<[Point; 2]>, Rgba),
    /// A closed line.
    Outline(Vec<Point>, Rgba),
    /// Discs, each of its own colour.
    Discs(Vec<FloorDisc>),
}

/// A disc on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorDisc {
    /// Middle of the disc, m.
    pub centre: Point,
    /// Radius of the disc, m.
    pub radius: f64,
    /// Colour of the disc.
    pub colour: Rgba,
}

/// A colour: red, green, blue and opacity, each from 0 to 1.
pub type Rgba = [f64; 4];

/// Colour of walls.
const DARK: Rgba = [0.25, 0.27, 0.3, 1.0];
/// Colour of zones of the floor.
const GREEN: Rgba = [0.2, 0.6, 0.3, 1.0];
/// Colour of things that a robot learned.
const BLUE: Rgba = [0.15, 0.45, 0.8, 1.0];
/// Colour of a robot and of its belief.
const RED: Rgba = [0.85, 0.3, 0.2, 1.0];

/// Radius of nodes of a map, m.
const NODE: f64 = 0.05;
/// Radius of believed positions, m.
const BELIEVED: f64 = 0.1;

/// Returns the events of a replay in order of their steps. The colour of a thing shows whether it
/// belongs to the world, to a learned map or to a robot. Fields over the floor are left out.
///
/// ```
/// use tolman_replay::{EventContent, Replay, RobotTrack, Scenery, events};
/// use tolman_geom::{Heading, Point, Pose};
/// use tolman_robot::Body;
///
/// let pose = |x| Pose::new(Point::new(x, 0.5), Heading::EAST);
/// let body = Body::Circle { radius: 0.1 };
/// let track = RobotTrack::new("robot", body, vec![pose(0.2), pose(0.7)]);
/// let replay = Replay::new("Two steps", 0.1, Scenery::default(), vec![track]);
/// let events = events(&replay)?;
/// assert_eq!(events.last().map(|event| event.step), Some(1));
/// let is_pose = |content: &EventContent<'_>| matches!(content, EventContent::Pose { .. });
/// assert_eq!(events.iter().filter(|event| is_pose(&event.content)).count(), 2);
/// # Ok::<(), tolman_replay::EncodeError>(())
/// ```
///
/// # Errors
/// As [`json`](super::json).
pub fn events(replay: &Replay) -> Result<Vec<ReplayEvent<'_>>, EncodeError> {
    checked(replay)?;
    let mut events = Events(Vec::new());
    scenery(&replay.scenery, &mut events);
    marks(&replay.marks, "", &mut events);
    for track in &replay.tracks {
        follow(track, &mut events);
    }
    events.0.sort_by_key(|event| event.step);
    Ok(events.0)
}

/// Events that still have to be sorted by time.
struct Events<'a>(Vec<ReplayEvent<'a>>);

impl<'a> Events<'a> {
    fn add(&mut self, step: u32, topic: &str, content: EventContent<'a>) {
        let topic = topic.to_owned();
        self.0.push(ReplayEvent {
            step,
            topic,
            content,
        });
    }

    fn draw(&mut self, step: u32, topic: &str, id: &str, drawing: FloorDrawing) {
        self.draw_in(WORLD, step, topic, id, drawing);
    }

    fn draw_in(&mut self, frame: &str, step: u32, topic: &str, id: &str, drawing: FloorDrawing) {
        let content = EventContent::Draw {
            frame: frame.to_owned(),
            id: id.to_owned(),
            drawing,
        };
        self.add(step, topic, content);
    }

    fn erase(&mut self, step: u32, topic: &str, id: &str) {
        let content = EventContent::Erase {
            frame: WORLD.to_owned(),
            id: id.to_owned(),
        };
        self.add(step, topic, content);
    }

    fn say(&mut self, step: u32, source: &str, text: &'a str) {
        let source = source.to_owned();
        self.add(step, "/log", EventContent::Text { source, text });
    }
}

fn scenery(scenery: &Scenery, events: &mut Events<'_>) {
    let walls = FloorDrawing::Segments(scenery.walls.clone(), DARK);
    events.draw(0, "/scene", "walls", walls);
    for zone in &scenery.zones {
        let outline = FloorDrawing::Outline(zone.corners.clone(), GREEN);
        events.draw(0, "/scene", &format!("zone {}", zone.name), outline);
    }
    for door in &scenery.doors {
        let id = format!("door {}", door.name);
        for change in &door.changes {
            match change.state {
                DoorState::Shut => {
                    let wall = FloorDrawing::Segments(vec![door.ends], DARK);
                    events.draw(change.step, "/scene", &id, wall);
                }
                DoorState::Open => events.erase(change.step, "/scene", &id),
            }
        }
    }
}

fn marks<'a>(marks: &'a [Marks], robot: &str, events: &mut Events<'a>) {
    for mark in marks {
        for step in &mark.steps {
            events.say(*step, robot, &mark.name);
        }
    }
}

fn follow<'a>(track: &'a RobotTrack, events: &mut Events<'a>) {
    let name = &track.name;
    let frame = format!("robot {name}");
    for (step, pose) in (0..).zip(&track.poses) {
        let (frame, pose) = (frame.clone(), *pose);
        events.add(step, "/tf", EventContent::Pose { frame, pose });
    }
    let outline = FloorDrawing::Outline(outline(&track.body), RED);
    events.draw_in(&frame, 0, &format!("/{name}/body"), "body", outline);
    if let Some(recorded) = &track.scans {
        scans(recorded, &format!("/{name}/scan"), &frame, events);
    }
    for map in &track.maps {
        grow(map, &format!("/{name}/map/{}", map.name), events);
    }
    for belief in &track.beliefs {
        let topic = format!("/{name}/belief/{}", belief.name);
        believe(belief, track, &topic, events);
    }
    for series in &track.series {
        let topic = format!("/{name}/{}", series.name);
        for sample in &series.samples {
            let (value, unit) = (sample.value, series.unit.as_str());
            events.add(sample.step, &topic, EventContent::Number { value, unit });
        }
    }
    for notes in &track.notes {
        for note in &notes.notes {
            events.say(note.step, &format!("{name} {}", notes.name), &note.text);
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

fn scans<'a>(scans: &'a Scans, topic: &str, frame: &str, events: &mut Events<'a>) {
    for (step, ranges) in scans.steps.iter().zip(&scans.ranges) {
        let content = EventContent::Scan {
            frame: frame.to_owned(),
            ring: &scans.ring,
            ranges,
        };
        events.add(*step, topic, content);
    }
}

/// Draws nodes and edges when they appear, again when they move, and erases them when they
/// disappear.
fn grow(map: &MapGrowth, topic: &str, events: &mut Events<'_>) {
    let nodes: BTreeMap<u32, &MapNode> = map.nodes.iter().map(|node| (node.id, node)).collect();
    for node in &map.nodes {
        let id = format!("node {}", node.id);
        let moves = node.moves.iter().map(|moved| (moved.step, moved.position));
        for (step, centre) in core::iter::once((node.born, node.position)).chain(moves) {
            let disc = FloorDisc {
                centre,
                radius: NODE,
                colour: BLUE,
            };
            events.draw(step, topic, &id, FloorDrawing::Discs(vec![disc]));
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
            let corners = edge.way.iter().copied();
            let way = [place(ends.0, step)].into_iter().chain(corners);
            let way: Vec<Point> = way.chain([place(ends.1, step)]).collect();
            let pieces = way.windows(2).map(|piece| [piece[0], piece[1]]);
            let line = FloorDrawing::Segments(pieces.collect(), faint(BLUE, 0.6));
            events.draw(step, topic, &id, line);
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

const fn faint([r, g, b, _]: Rgba, opacity: f64) -> Rgba {
    [r, g, b, opacity]
}

fn believe(belief: &Belief, track: &RobotTrack, topic: &str, events: &mut Events<'_>) {
    for entry in &belief.entries {
        let shapes = entry.shapes.iter();
        let discs = shapes.filter_map(|shape| believed(shape, track, entry.step));
        let discs = FloorDrawing::Discs(discs.collect());
        events.draw(entry.step, topic, "belief", discs);
    }
}

/// Returns a disc for a part of a belief, as opaque as it is likely. `None` for a node that is on
/// no map.
fn believed(shape: &Shape, track: &RobotTrack, step: u32) -> Option<FloorDisc> {
    let at = |id| Some(place(track.node(id)?, step));
    let (centre, weight) = shape.middle(at)?;
    let radius = match *shape {
        Shape::Box { min, max, .. } => (0.5 * (max - min)).norm(),
        Shape::Ellipse {
            semi_axes: [a, b], ..
        } => a.max(b),
        _ => BELIEVED,
    };
    let colour = faint(RED, weight);
    Some(FloorDisc {
        centre,
        radius,
        colour,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NodeMove;

    fn replay() -> Replay {
        let pose = |x| Pose::new(Point::new(x, 0.5), Heading::NORTH);
        let body = Body::Circle { radius: 0.1 };
        let mut track = RobotTrack::new("mouse", body, [0.2, 0.7, 1.2, 1.7].map(pose).into());
        let mut first = MapNode::new(3, Point::new(0.0, 0.0), 1);
        let position = Point::new(0.5, 0.0);
        first.moves.push(NodeMove { step: 2, position });
        let mut edge = MapEdge::new(3, 4, 1);
        edge.died = Some(3);
        track.maps.push(MapGrowth {
            name: "places".to_owned(),
            nodes: vec![first, MapNode::new(4, Point::new(1.0, 0.0), 1)],
            edges: vec![edge],
        });
        let mut belief = Belief::new("belief");
        let shapes = vec![Shape::Node { id: 3, weight: 0.5 }];
        belief.entries.push(crate::BeliefAt { step: 2, shapes });
        track.beliefs.push(belief);
        Replay::new("Three steps", 0.1, Scenery::default(), vec![track])
    }

    #[test]
    fn an_edge_follows_its_node_until_it_disappears() {
        let replay = replay();
        let events = events(&replay).unwrap();
        assert!(events.is_sorted_by_key(|event| event.step));
        let starts = events.iter().filter_map(|event| match &event.content {
            EventContent::Draw { id, drawing, .. } if id == "edge 0" => match drawing {
                FloorDrawing::Segments(segments, _) => Some((event.step, Some(segments[0][0].x))),
                other => panic!("an edge is drawn as {other:?}"),
            },
            EventContent::Erase { id, .. } if id == "edge 0" => Some((event.step, None)),
            _ => None,
        });
        let starts: Vec<_> = starts.collect();
        assert_eq!(starts, [(1, Some(0.0)), (2, Some(0.5)), (3, None)]);
    }

    #[test]
    fn a_belief_is_where_its_node_has_moved_to() {
        let replay = replay();
        let events = events(&replay).unwrap();
        let belief = events
            .iter()
            .find(|event| event.topic == "/mouse/belief/belief");
        let EventContent::Draw { drawing, .. } = &belief.unwrap().content else {
            panic!("a belief is drawn");
        };
        let disc = FloorDisc {
            centre: Point::new(0.5, 0.0),
            radius: BELIEVED,
            colour: [0.85, 0.3, 0.2, 0.5],
        };
        assert_eq!(*drawing, FloorDrawing::Discs(vec![disc]));
    }
}
