//! What a robot knows over time, as layers that any system can provide.

use serde::Serialize;
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Guess, Position, Scan};

use super::Fact;

/// A learned map as it grew: nodes and edges that appear, may move, and may disappear.
///
/// ```
/// use tolman_replay::{MapEdge, MapGrowth, MapNode};
/// use tolman_geom::Point;
///
/// // A place at step 0, another at step 40, and a way between them.
/// let mut map = MapGrowth { name: "places".to_owned(), ..MapGrowth::default() };
/// map.nodes.push(MapNode::new(0, Point::new(0.5, 0.5), 0));
/// map.nodes.push(MapNode::new(1, Point::new(2.5, 0.5), 40));
/// map.edges.push(MapEdge::new(0, 1, 40));
/// // At step 90 it learns that it was wrong by half a metre.
/// map.nodes[1].move_to(90, Point::new(3.0, 0.5), 0.05);
/// assert_eq!(map.nodes[1].latest().x, 3.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MapGrowth {
    /// Name of the layer, such as `state graph`.
    pub name: String,
    /// Nodes of the map, in any order, with unique ids.
    pub nodes: Vec<MapNode>,
    /// Edges between the nodes.
    pub edges: Vec<MapEdge>,
}

/// A node of a [`MapGrowth`]: a state, a place, a unit of a quantizer or a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct MapNode {
    /// Id by which edges and beliefs name the node.
    pub id: u32,
    /// First position, in the world's frame, m.
    pub position: Point,
    /// Step at which the node appears.
    pub born: u32,
    /// Step at which the node disappears; `None` if it stays.
    pub died: Option<u32>,
    /// Labels beside the node, ascending by step; each holds until the next.
    pub labels: Vec<NodeLabel>,
    /// Facts shown when the node is clicked.
    pub facts: Vec<Fact>,
    /// Steps at which the robot visited the node, ascending.
    pub visits: Vec<u32>,
    /// Later positions, ascending by step.
    pub moves: Vec<NodeMove>,
    /// Scan that the node stands for.
    pub exemplar: Option<Exemplar>,
}

impl MapNode {
    /// Returns a node that stays, without label, facts, visits and exemplar.
    #[must_use]
    pub const fn new(id: u32, position: Point, born: u32) -> Self {
        Self {
            id,
            position,
            born,
            died: None,
            labels: Vec::new(),
            facts: Vec::new(),
            visits: Vec::new(),
            moves: Vec::new(),
            exemplar: None,
        }
    }

    /// Returns the node's last position.
    #[must_use]
    pub fn latest(&self) -> Point {
        let last = self.moves.last();
        last.map_or(self.position, |last| last.position)
    }

    /// Moves the node from `step` on, if `position` is more than `still` away, m. Of several
    /// positions at one step the last counts.
    pub fn move_to(&mut self, step: u32, position: Point, still: f64) {
        if (self.latest() - position).norm() > still {
            self.moves.pop_if(|moved| moved.step >= step);
            self.moves.push(NodeMove { step, position });
        }
    }

    /// Returns the node's last label; empty for none.
    #[must_use]
    pub fn label(&self) -> &str {
        self.labels.last().map_or("", |label| &label.text)
    }

    /// Labels the node from `step` on, if it is not labelled so yet. An empty text removes the
    /// label.
    pub fn label_from(&mut self, step: u32, text: &str) {
        if self.label() != text {
            self.labels.pop_if(|label| label.step >= step);
            let text = text.to_owned();
            self.labels.push(NodeLabel { step, text });
        }
    }
}

/// A node's label, in a word or two, from a step on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeLabel {
    /// Step from which the label holds.
    pub step: u32,
    /// Words of the label; empty for none.
    pub text: String,
}

/// A node's new position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeMove {
    /// Step from which the position holds.
    pub step: u32,
    /// Position of the node, m.
    pub position: Point,
}

/// A scan that a node stands for, drawn as a polar plot when the node is clicked.
#[derive(Clone, Debug, PartialEq)]
pub struct Exemplar {
    /// Heading of bearing 0 of the scan.
    pub heading: Heading,
    /// Scan of the node. Its ranges are drawn to 1/255 of the largest.
    pub scan: Scan,
}

/// An edge of a [`MapGrowth`].
#[derive(Clone, Debug, PartialEq)]
pub struct MapEdge {
    /// Id of the node at which the edge begins.
    pub a: u32,
    /// Id of the node at which the edge ends.
    pub b: u32,
    /// Meaning of the edge, which decides its style.
    pub kind: EdgeKind,
    /// Step at which the edge appears.
    pub born: u32,
    /// Step at which the edge disappears; `None` if it stays.
    pub died: Option<u32>,
    /// Label, a word or two, shown when one of the nodes is clicked; empty for none.
    pub label: String,
    /// Corners of the edge between its ends, from `a` to `b`, m; none if it is straight.
    pub way: Vec<Point>,
}

impl MapEdge {
    /// Returns a passage that stays, without a label.
    #[must_use]
    pub const fn new(a: u32, b: u32, born: u32) -> Self {
        Self {
            a,
            b,
            kind: EdgeKind::Passage,
            born,
            died: None,
            label: String::new(),
            way: Vec::new(),
        }
    }
}

/// Meaning of a [`MapEdge`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum EdgeKind {
    /// A way between two nodes.
    Passage,
    /// A way between two nodes that the robot has not driven. It is drawn straight, and dashed.
    Supposed,
    /// A wall between two posts.
    Wall,
    /// A relation other than a way, such as a loop closure or a match.
    Relation,
}

/// Believed positions of a robot, or of something else.
///
/// ```
/// use tolman_replay::Belief;
/// use tolman_robot::{Guess, Position};
/// use tolman_geom::Point;
///
/// let mut belief = Belief::new("belief");
/// let site = |id| (id == 3).then_some(Point::new(1.5, 0.5));
/// let guess = Guess { at: Position::Place(3), weight: 0.9 };
/// belief.note(10, &[guess], site);
/// belief.note(11, &[guess], site);
/// assert_eq!(belief.entries.len(), 1, "nothing new at step 11");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Belief {
    /// Name of the layer.
    pub name: String,
    /// Beliefs with their first steps, ascending; each holds until the next.
    pub entries: Vec<BeliefAt>,
}

impl Belief {
    /// Returns a layer without beliefs.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            entries: Vec::new(),
        }
    }

    /// Records a system's belief from `step` on, if it has changed. It keeps the most likely
    /// guesses, at positions that `site` gives for places.
    pub fn note(&mut self, step: u32, guesses: &[Guess], site: impl Fn(u32) -> Option<Point>) {
        let likely = guesses.iter().filter(|guess| guess.weight >= LEAST_WEIGHT);
        let shapes = likely.take(SHOWN_GUESSES).filter_map(|guess| {
            let position = match guess.at {
                Position::Point(position) => position,
                Position::Place(id) => site(id)?,
            };
            let weight = guess.weight;
            Some(Shape::Point { position, weight })
        });
        let shapes: Vec<Shape> = shapes.collect();
        let before = self.entries.last().map(|entry| &entry.shapes);
        if before.map_or(!shapes.is_empty(), |before| *before != shapes) {
            self.entries.pop_if(|entry| entry.step >= step);
            self.entries.push(BeliefAt { step, shapes });
        }
    }
}

/// Maximum number of possible poses that are shown. More would be unreadable, and make the file
/// large.
const SHOWN_GUESSES: usize = 8;

/// Weight below which a guess is not shown.
const LEAST_WEIGHT: f64 = 0.01;

/// One state of a [`Belief`].
#[derive(Clone, Debug, PartialEq)]
pub struct BeliefAt {
    /// First step at which the belief holds.
    pub step: u32,
    /// Shapes of the whole belief; empty for no belief.
    pub shapes: Vec<Shape>,
}

/// A part of a belief, in the world's frame. Weights are from 0 to 1 and are shown as opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// The robot may be at this position.
    Point {
        /// Position in the world, m.
        position: Point,
        /// Probability of the position, 0 … 1.
        weight: f64,
    },
    /// The robot may have this pose.
    Pose {
        /// Pose in the world.
        pose: Pose,
        /// Probability of the pose, 0 … 1.
        weight: f64,
    },
    /// The robot may be at this node of a map.
    Node {
        /// Id of the node.
        id: u32,
        /// Probability of the node, 0 … 1.
        weight: f64,
    },
    /// The robot is inside this axis-aligned box.
    Box {
        /// South-west corner of the box, m.
        min: Point,
        /// North-east corner of the box, m.
        max: Point,
        /// Probability that the robot is in the box, 0 … 1.
        weight: f64,
    },
    /// The robot is near this position: an ellipse of uncertainty.
    Ellipse {
        /// Middle of the ellipse, m.
        centre: Point,
        /// Semi-axes of the ellipse, m.
        semi_axes: [f64; 2],
        /// Direction of the first semi-axis.
        heading: Heading,
        /// Probability that the robot is in the ellipse, 0 … 1.
        weight: f64,
    },
}

impl Shape {
    /// Returns the middle of the shape and its weight. `at` says where a node lies.
    pub(super) fn middle(self, at: impl FnOnce(u32) -> Option<Point>) -> Option<(Point, f64)> {
        Some(match self {
            Self::Point { position, weight } => (position, weight),
            Self::Pose { pose, weight } => (pose.position, weight),
            Self::Node { id, weight } => (at(id)?, weight),
            Self::Box { min, max, weight } => (min + 0.5 * (max - min), weight),
            Self::Ellipse { centre, weight, .. } => (centre, weight),
        })
    }
}

/// Numbers over the cells of a grid that change now and then, drawn as colours and, if there is
/// room, as digits.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Name of the layer, such as `distance to the goal`.
    pub name: String,
    /// Position of the south-west corner of cell 0, m.
    pub origin: Point,
    /// Side length of a cell, m.
    pub pitch: f64,
    /// Number of columns. Cell i is in column i mod columns, row i / columns, from the south-west.
    pub columns: u32,
    /// Values drawn in the palest and in the strongest colour.
    pub range: [f64; 2],
    /// Changes by step, ascending. A cell that never had a value is not drawn.
    pub changes: Vec<FieldChange>,
}

/// One change of a [`Field`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldChange {
    /// First step at which the value holds.
    pub step: u32,
    /// Number of the cell.
    pub cell: u32,
    /// New value of the cell, or `None` to remove it.
    pub value: Option<f64>,
}

/// A number over time, shown with its curve.
///
/// ```
/// use tolman_replay::TimeSeries;
///
/// let mut charge = TimeSeries::new("battery", "V");
/// charge.sample(0, 7.4);
/// charge.sample(600, 7.1);
/// assert_eq!(charge.samples.len(), 2);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimeSeries {
    /// Name of the values, such as `coverage`.
    pub name: String,
    /// Unit, shown after the number; `%` shows a share in per cent.
    pub unit: String,
    /// Values, ascending by step; each holds until the next.
    pub samples: Vec<Sample>,
}

impl TimeSeries {
    /// Returns a series without values.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            samples: Vec::new(),
        }
    }

    /// Adds a value that holds from `step` on. Of several at one step the last counts.
    pub fn sample(&mut self, step: u32, value: f64) {
        self.samples.pop_if(|sample| sample.step >= step);
        self.samples.push(Sample { step, value });
    }
}

/// One value of a [`TimeSeries`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// First step at which the value holds.
    pub step: u32,
    /// Value of the quantity, in its own unit.
    pub value: f64,
}

/// Words over time, such as the action in progress or the present state.
///
/// ```
/// use tolman_replay::Notes;
///
/// let mut notes = Notes::new("action");
/// notes.say(0, "go north");
/// notes.say(1, "go north");
/// notes.say(9, "go east");
/// assert_eq!(notes.notes.len(), 2, "what holds on is said once");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes {
    /// Subject of the notes, such as `action`.
    pub name: String,
    /// Notes of the layer, ascending by step; each holds until the next.
    pub notes: Vec<Note>,
}

impl Notes {
    /// Returns a layer without notes.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            notes: Vec::new(),
        }
    }

    /// Adds `text` from `step` on, unless it is the present text already.
    pub fn say(&mut self, step: u32, text: impl Into<String>) {
        let text = text.into();
        if self.notes.last().is_none_or(|last| last.text != text) {
            self.notes.push(Note { step, text });
        }
    }
}

/// One of [`Notes`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// First step at which the note holds.
    pub step: u32,
    /// Text of the note.
    pub text: String,
}

/// Steps at which something happened, marked on the slider.
///
/// ```
/// use tolman_replay::{Mark, Marks};
///
/// let bumps = Marks::new(Mark::Bump, "bump", [12, 57]);
/// assert_eq!(bumps.steps, [12, 57]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Marks {
    /// Kind of the events, which sets the marks' colour.
    pub kind: Mark,
    /// Name of the events, such as `bump`.
    pub name: String,
    /// Steps of the events, ascending.
    pub steps: Vec<u32>,
}

impl Marks {
    /// Returns marks at these steps.
    pub fn new(kind: Mark, name: impl Into<String>, steps: impl IntoIterator<Item = u32>) -> Self {
        Self {
            kind,
            name: name.into(),
            steps: steps.into_iter().collect(),
        }
    }
}

/// Kind of a mark on the slider.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Mark {
    /// The body touched something.
    Bump,
    /// An action failed.
    Failure,
    /// The robot arrived.
    Arrival,
    /// The robot was lifted and put down elsewhere.
    Kidnapping,
    /// The first step at which two runs differ.
    Difference,
    /// An event of any other kind.
    Event,
}
