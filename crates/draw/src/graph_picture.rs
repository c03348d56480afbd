//! Graphs whose nodes have coordinates: a learned map, or a network over its data.

use maud::{Markup, html};
use tolman_geom::Point;

use super::Series;
use super::number::{line, tenths};
use super::words;

/// A graph to be drawn over a [`FloorPlan`](super::FloorPlan) or in a [`Chart`](super::Chart), each
/// node at its coordinates.
///
/// Nodes that are not finite are left out, and so are edges that end at such a node or at none.
///
/// ```
/// use tolman_draw::{GraphPicture, GraphEdge, GraphNode, NodeMark, FloorPlan, Series};
/// use tolman_geom::Point;
///
/// let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
/// let walls: Vec<[Point; 2]> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect();
/// let mut map = GraphPicture::new();
/// let start = map.node(GraphNode::at(Point::new(0.5, 0.5)));
/// let goal = GraphNode::at(Point::new(2.5, 1.5)).mark(NodeMark::Disc).label("goal");
/// let goal = map.node(goal.series(Series(2)));
/// map.edge(GraphEdge::between(start, goal).label("east"));
///
/// let mut plan = FloorPlan::of_walls(&walls, 400.0);
/// plan.graph(&map);
/// let drawing = plan.drawing("A room with a map of two places.");
/// assert!(drawing.body.into_string().contains("goal"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GraphPicture {
    /// The nodes, known by their index.
    pub nodes: Vec<GraphNode>,
    /// Edges, each by the indices of the nodes at its ends.
    pub edges: Vec<GraphEdge>,
    /// The radius of a node, user units.
    pub radius: f64,
    /// Positions of other signs, which the labels of nodes must not cover.
    pub signs: Vec<Point>,
}

/// A node of a drawn graph.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphNode {
    /// Position on the picture.
    pub position: Point,
    /// Series whose colour the node is drawn in.
    pub series: Series,
    /// Shape of the node, which shows its class.
    pub mark: NodeMark,
    /// Text beside the node; empty for none.
    pub label: String,
    /// Text shown while the pointer rests on the node; empty for none.
    pub note: String,
}

/// The shape of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NodeMark {
    /// An open ring.
    #[default]
    Ring,
    /// A filled disc.
    Disc,
    /// An open square.
    Square,
}

impl NodeMark {
    /// Returns the shape as an element, in the colour of a series or of the element around it, with
    /// a note that may be empty.
    pub(super) fn markup(
        self,
        series: Option<Series>,
        (x, y): (f64, f64),
        r: f64,
        note: &str,
    ) -> Markup {
        let class = match self {
            Self::Ring | Self::Square => "node",
            Self::Disc => "node full",
        };
        let class = match series {
            Some(series) => format!("{class} {}", series.class()),
            None => class.to_owned(),
        };
        let note = html! { @if !note.is_empty() { title { (note) } } };
        html! {
            @if self == Self::Square {
                rect class=(class) x=(tenths(x - r)) y=(tenths(y - r))
                    width=(tenths(2.0 * r)) height=(tenths(2.0 * r)) { (note) }
            } @else {
                circle class=(class) cx=(tenths(x)) cy=(tenths(y)) r=(tenths(r)) { (note) }
            }
        }
    }
}

/// An edge of a drawn graph.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphEdge {
    /// Index of the node at which the edge begins.
    pub from: usize,
    /// Index of the node at which the edge ends.
    pub to: usize,
    /// Series whose colour the edge is drawn in.
    pub series: Series,
    /// Style of the line, which shows the edge's class.
    pub line: EdgeLine,
    /// Text beside the middle of the edge; empty for none.
    pub label: String,
}

/// Style of an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum EdgeLine {
    /// A continuous line, without arrow heads.
    #[default]
    Plain,
    /// A dashed line, for doubtful things.
    Dashed,
    /// A line with an arrow head towards its end; two that run opposite ways show both heads.
    Arrow,
}

impl GraphPicture {
    /// Returns a picture without nodes, whose nodes will have a radius of 3.2 user units.
    pub const fn new() -> Self {
        Self {
            nodes: Vec::new(),
            edges: Vec::new(),
            radius: 3.2,
            signs: Vec::new(),
        }
    }

    /// Sets the radius of the nodes, user units.
    #[must_use]
    pub const fn radius(mut self, radius: f64) -> Self {
        self.radius = radius;
        self
    }

    /// Adds a node and returns its index.
    pub fn node(&mut self, node: GraphNode) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Adds an edge.
    pub fn edge(&mut self, edge: GraphEdge) {
        self.edges.push(edge);
    }

    /// Returns the SVG elements, with coordinates from `at`, in a frame of this width and height.
    /// Labels of nodes stay inside the frame where possible.
    pub(super) fn markup(&self, at: &dyn Fn(Point) -> (f64, f64), frame: (f64, f64)) -> Markup {
        html! {
            g class="graph" {
                @for (series, line, path) in self.lines(at) {
                    path class={ "edge " (series.class()) }
                        stroke-dasharray=[(line == EdgeLine::Dashed).then_some("4 3")] d=(path) {}
                }
                @for (head, series) in self.heads(at) {
                    path class={ "head " (series.class()) } d=(head) {}
                }
                @for node in self.nodes.iter().filter(|node| is_finite(node)) {
                    (node.mark.markup(Some(node.series), at(node.position), self.radius, &node.note))
                }
                @for (label, (x, y)) in self.labels(at, frame) {
                    text class="label" x=(tenths(x)) y=(tenths(y)) { (label) }
                }
                @for (edge, [from, to]) in self.sound_edges().filter(|(edge, _)| !edge.label.is_empty()) {
                    @let (x, y) = beside(at(from), at(to));
                    text class="label quiet" text-anchor="middle" dominant-baseline="central"
                        x=(tenths(x)) y=(tenths(y)) { (edge.label) }
                }
            }
        }
    }

    /// Returns the labels of nodes, each with the position where its text begins. A label stands
    /// beside its node, where it covers the least of nodes, signs and earlier labels. It is left
    /// out where all positions cover other labels: two words in one place cannot be read.
    fn labels(
        &self,
        at: &dyn Fn(Point) -> (f64, f64),
        frame: (f64, f64),
    ) -> Vec<(&str, (f64, f64))> {
        let nodes = self.nodes.iter().filter(|node| is_finite(node));
        let labelled = nodes.clone().filter(|node| !node.label.is_empty());
        let nodes = nodes.map(|node| Patch::about(at(node.position), self.radius, self.radius));
        let signs = self.signs.iter();
        let signs = signs.map(|sign| Patch::about(at(*sign), 5.0, 5.0));
        // Without labels there is nothing to place.
        let (mut things, mut words) = (Vec::new(), Vec::new());
        if labelled.clone().next().is_some() {
            things.extend(nodes.chain(signs));
            words.extend(self.edge_labels(at));
        }
        let mut placed = Vec::new();
        for node in labelled {
            let width = words::broad(&node.label) * LABEL;
            let places = self.beside_node(at(node.position), width);
            let labels = places.map(|(x, y)| ((x, y), Patch::of_text(x, y, width)));
            // A label that is cut off cannot be read at all.
            let covered = |label: &Patch| label.covered(&things) + 10.0 * label.outside(frame);
            let free = labels
                .into_iter()
                .filter(|(_, label)| label.covered(&words) <= TOUCH);
            // Of equally good places, the first.
            let best = free.min_by(|a, b| covered(&a.1).total_cmp(&covered(&b.1)));
            let Some((begin, label)) = best else { continue };
            words.push(label);
            placed.push((node.label.as_str(), begin));
        }
        placed
    }

    /// Returns the positions where the label of a node may begin, the best one first.
    fn beside_node(&self, (x, y): (f64, f64), width: f64) -> [(f64, f64); 12] {
        let gap = self.radius + 2.0;
        let (east, west, middle) = (x + gap, x - gap - width, x - width / 2.0);
        let (above, below) = (y - self.radius, y + self.radius + 8.0);
        [
            (east, above),
            (east, below),
            (west, above),
            (west, below),
            (middle, above - 3.0),
            (middle, below + 3.0),
            (east + 2.0, y + 3.5),
            (west - 2.0, y + 3.5),
            // Farther away, in case everything near is taken.
            (east + 6.0, above - 8.0),
            (east + 6.0, below + 8.0),
            (west - 6.0, above - 8.0),
            (west - 6.0, below + 8.0),
        ]
    }

    fn edge_labels(&self, at: &dyn Fn(Point) -> (f64, f64)) -> Vec<Patch> {
        let labelled = self
            .sound_edges()
            .filter(|(edge, _)| !edge.label.is_empty());
        let patches = labelled.map(|(edge, [from, to])| {
            let width = words::width(&edge.label) * LABEL;
            Patch::about(beside(at(from), at(to)), width / 2.0, 5.0)
        });
        patches.collect()
    }

    /// Returns one path for each class of edges, so that hundreds of edges need few elements.
    fn lines(&self, at: &dyn Fn(Point) -> (f64, f64)) -> Vec<(Series, EdgeLine, String)> {
        let mut paths: Vec<(Series, EdgeLine, String)> = Vec::new();
        for (edge, [from, to]) in self.sound_edges() {
            let shown = line([at(from), at(to)]);
            let mut same = paths.iter_mut();
            match same.find(|path| (path.0, path.1) == (edge.series, edge.line)) {
                Some((_, _, path)) => path.push_str(&shown),
                None => paths.push((edge.series, edge.line, shown)),
            }
        }
        paths
    }

    /// Returns the arrow heads, each at two thirds of its edge.
    fn heads(&self, at: &dyn Fn(Point) -> (f64, f64)) -> Vec<(String, Series)> {
        let arrows = self
            .sound_edges()
            .filter(|(edge, _)| edge.line == EdgeLine::Arrow);
        arrows
            .filter_map(|(edge, [from, to])| {
                let ((x0, y0), (x1, y1)) = (at(from), at(to));
                let (dx, dy) = (x1 - x0, y1 - y0);
                let length = libm::hypot(dx, dy);
                if length < 1e-9 {
                    return None;
                }
                let size = 1.4 * self.radius;
                let (ux, uy) = (size * dx / length, size * dy / length);
                let (x, y) = (x0 + dx * 2.0 / 3.0, y0 + dy * 2.0 / 3.0);
                let head = line([
                    (x + ux, y + uy),
                    (x - ux - 0.7 * uy, y - uy + 0.7 * ux),
                    (x - ux + 0.7 * uy, y - uy - 0.7 * ux),
                ]);
                Some((head + "Z", edge.series))
            })
            .collect()
    }

    /// Returns the edges between nodes that have positions, with these positions.
    fn sound_edges(&self) -> impl Iterator<Item = (&GraphEdge, [Point; 2])> {
        let place = |index: usize| {
            let node = self.nodes.get(index).filter(|node| is_finite(node))?;
            Some(node.position)
        };
        self.edges
            .iter()
            .filter_map(move |edge| Some((edge, [place(edge.from)?, place(edge.to)?])))
    }
}

/// The size of labels, as a share of that of other text.
const LABEL: f64 = 0.85;

/// Area in which labels may touch each other, square user units.
const TOUCH: f64 = 1.0;

/// A rectangle of a drawing that something covers, user units.
#[derive(Clone, Copy, Debug)]
struct Patch {
    x: (f64, f64),
    y: (f64, f64),
}

impl Patch {
    fn about((x, y): (f64, f64), half_width: f64, half_height: f64) -> Self {
        Self {
            x: (x - half_width, x + half_width),
            y: (y - half_height, y + half_height),
        }
    }

    /// Returns the rectangle of a label whose text begins at (`x`, `y`), on its base line.
    fn of_text(x: f64, y: f64, width: f64) -> Self {
        Self {
            x: (x, x + width),
            y: (y - 8.0, y + 2.0),
        }
    }

    /// Returns the area that lies outside a frame of this width and height.
    fn outside(&self, frame: (f64, f64)) -> f64 {
        let area = (self.x.1 - self.x.0) * (self.y.1 - self.y.0);
        let inside = Self {
            x: (0.0, frame.0),
            y: (0.0, frame.1),
        };
        area - self.overlap(&inside)
    }

    /// Returns the area that others cover, each by itself.
    fn covered(&self, others: &[Self]) -> f64 {
        others.iter().map(|other| self.overlap(other)).sum()
    }

    /// Returns the area of the overlap.
    fn overlap(&self, other: &Self) -> f64 {
        let along = |a: (f64, f64), b: (f64, f64)| (a.1.min(b.1) - a.0.max(b.0)).max(0.0);
        along(self.x, other.x) * along(self.y, other.y)
    }
}

impl Default for GraphPicture {
    fn default() -> Self {
        Self::new()
    }
}

impl GraphNode {
    /// Returns a plain node at a position.
    pub fn at(position: Point) -> Self {
        Self {
            position,
            series: Series(0),
            mark: NodeMark::Ring,
            label: String::new(),
            note: String::new(),
        }
    }

    /// Sets the colour.
    #[must_use]
    pub const fn series(mut self, series: Series) -> Self {
        self.series = series;
        self
    }

    /// Sets the shape.
    #[must_use]
    pub const fn mark(mut self, mark: NodeMark) -> Self {
        self.mark = mark;
        self
    }

    /// Sets the text beside it.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Sets the text that appears when the pointer rests on it.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.note = note.into();
        self
    }
}

impl GraphEdge {
    /// Returns a plain edge between the nodes of two indices.
    pub const fn between(from: usize, to: usize) -> Self {
        Self {
            from,
            to,
            series: Series(0),
            line: EdgeLine::Plain,
            label: String::new(),
        }
    }

    /// Sets the colour.
    #[must_use]
    pub const fn series(mut self, series: Series) -> Self {
        self.series = series;
        self
    }

    /// Sets the style of the edge's line.
    #[must_use]
    pub const fn line(mut self, line: EdgeLine) -> Self {
        self.line = line;
        self
    }

    /// Sets the text beside its middle.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }
}

/// Returns the position of a label beside the middle of an edge, above it. Text on a line is hard
/// to read.
fn beside(from: (f64, f64), to: (f64, f64)) -> (f64, f64) {
    let middle = (f64::midpoint(from.0, to.0), f64::midpoint(from.1, to.1));
    let along = (to.0 - from.0, to.1 - from.1);
    let length = libm::hypot(along.0, along.1);
    let (x, y) = if length > 0.0 {
        (along.1 / length, -along.0 / length)
    } else {
        (0.0, -1.0)
    };
    let up = if y > 0.0 { -1.0 } else { 1.0 };
    (middle.0 + 9.0 * up * x, middle.1 + 8.0 * up * y)
}

fn is_finite(node: &GraphNode) -> bool {
    node.position.x.is_finite() && node.position.y.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Large enough for all nodes and labels.
    const FRAME: (f64, f64) = (1000.0, 1000.0);

    fn drawn(graph: &GraphPicture) -> String {
        let markup = graph.markup(&|at| (10.0 * at.x, -10.0 * at.y), FRAME);
        markup.into_string()
    }

    #[test]
    fn nodes_and_edges_lie_at_their_coordinates() {
        let mut graph = GraphPicture::new();
        let a = graph.node(GraphNode::at(Point::new(1.0, -2.0)).label("a & b"));
        let b = graph.node(GraphNode::at(Point::new(3.0, 0.0)).mark(NodeMark::Square));
        graph.edge(GraphEdge::between(a, b));
        let svg = drawn(&graph);
        assert!(svg.contains("cx=\"10\" cy=\"20\""), "{svg}");
        assert!(svg.contains("x=\"26.8\" y=\"-3.2\""), "{svg}");
        assert!(svg.contains("d=\"M10 20L30 0\""), "{svg}");
        assert!(svg.contains("a &amp; b"));
        assert!(roxmltree::Document::parse(&svg).is_ok());
    }

    #[test]
    fn labels_stand_beside_their_edges() {
        let label = |to: Point| {
            let mut graph = GraphPicture::new();
            let from = graph.node(GraphNode::at(Point::new(0.0, 0.0)));
            let to = graph.node(GraphNode::at(to));
            graph.edge(GraphEdge::between(from, to).label("here"));
            drawn(&graph)
        };
        for to in [Point::new(4.0, 0.0), Point::new(-4.0, 0.0)] {
            let svg = label(to);
            assert!(svg.contains("y=\"-8\">here"), "above: {svg}");
        }
        let svg = label(Point::new(0.0, 4.0));
        assert!(svg.contains("x=\"-9\" y=\"-20\">here"), "{svg}");
    }

    #[test]
    fn labels_of_nodes_cover_neither_nodes_nor_signs_nor_each_other() {
        let place = |graph: &GraphPicture, label: &str| {
            let at = |at: Point| (500.0 + 10.0 * at.x, 500.0 - 10.0 * at.y);
            let labels = graph.labels(&at, FRAME);
            let (x, y) = labels.iter().find(|placed| placed.0 == label).unwrap().1;
            let tenths = |value: f64| (10.0 * value).round() / 10.0;
            (tenths(x - 500.0), tenths(y - 500.0))
        };
        let mut graph = GraphPicture::new();
        graph.node(GraphNode::at(Point::new(0.0, 0.0)).label("goal"));
        assert_eq!(place(&graph, "goal"), (5.2, -3.2), "above, to the right");
        graph.signs.push(Point::new(1.5, 0.7));
        assert_eq!(place(&graph, "goal"), (5.2, 11.2), "below, to the right");
        // A neighbour whose label would cover that one.
        graph.node(GraphNode::at(Point::new(0.2, -1.8)).label("A10"));
        let (goal, next) = (place(&graph, "goal"), place(&graph, "A10"));
        let patch = |(x, y)| Patch::of_text(x, y, 20.0);
        assert!(
            patch(goal).overlap(&patch(next)) <= 0.0,
            "{goal:?} {next:?}"
        );
    }

    #[test]
    fn a_label_without_a_place_of_its_own_is_left_out() {
        let mut graph = GraphPicture::new();
        for number in 0..40 {
            let near = 0.01 * f64::from(number);
            graph.node(GraphNode::at(Point::new(near, near)).label(number.to_string()));
        }
        let at = |at: Point| (500.0 + 10.0 * at.x, 500.0 - 10.0 * at.y);
        let labels = graph.labels(&at, FRAME);
        assert!((4..40).contains(&labels.len()), "{labels:?}");
        let patches: Vec<Patch> = labels
            .iter()
            .map(|(label, (x, y))| Patch::of_text(*x, *y, words::broad(label) * LABEL))
            .collect();
        for (number, patch) in patches.iter().enumerate() {
            assert!(patch.covered(&patches[..number]) <= TOUCH, "{labels:?}");
        }
    }

    #[test]
    fn a_class_of_edges_is_one_path() {
        let mut graph = GraphPicture::new();
        for i in 0..500_u32 {
            graph.node(GraphNode::at(Point::new(f64::from(i), 0.0)));
        }
        for i in 1..500 {
            let series = Series(u32::from(i % 2 == 0));
            graph.edge(GraphEdge::between(i - 1, i).series(series));
        }
        let svg = drawn(&graph);
        assert_eq!(svg.matches("<path").count(), 2);
        assert_eq!(svg.matches("<circle").count(), 500);
        assert_eq!(svg.matches('L').count(), 499);
    }

    #[test]
    fn what_has_no_place_is_left_out() {
        let mut graph = GraphPicture::new();
        graph.node(GraphNode::at(Point::new(f64::NAN, 0.0)));
        graph.node(GraphNode::at(Point::new(0.0, 0.0)));
        graph.edge(GraphEdge::between(0, 1));
        graph.edge(GraphEdge::between(1, 7));
        graph.edge(GraphEdge::between(1, 1).line(EdgeLine::Arrow));
        let svg = drawn(&graph);
        assert_eq!(svg.matches("<circle").count(), 1);
        assert_eq!(
            svg.matches("<path").count(),
            1,
            "the loop's line without a head"
        );
    }

    #[test]
    fn arrow_heads_point_to_the_end_of_their_edge() {
        let mut graph = GraphPicture::new().radius(5.0);
        graph.node(GraphNode::at(Point::new(0.0, 0.0)));
        graph.node(GraphNode::at(Point::new(9.0, 0.0)));
        graph.edge(GraphEdge::between(0, 1).line(EdgeLine::Arrow));
        // Two thirds of 90 is 60; the tip 7 ahead, the barbs 7 behind.
        assert!(drawn(&graph).contains("d=\"M67 0L53 4.9L53 -4.9Z\""));
    }
}
