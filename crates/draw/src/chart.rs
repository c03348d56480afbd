//! Charts: a frame with two axes that holds lines with bands of spread, points, graphs and
//! pictures.

use maud::{Markup, html};
use tolman_geom::Point;

use super::number::{NOTHING, extent, line, tenths};
use super::scale::{Scale, Spacing};
use super::words;
use super::{Drawing, GraphPicture, Image, Series};
use tolman_stats::ConfidenceInterval;

/// Width for the labels of the value axis, user units.
const LEFT: f64 = 56.0;
const RIGHT: f64 = 22.0;
/// Height for the title of the value axis, user units.
const TOP: f64 = 24.0;
/// Height for the labels and the title of the other axis, user units.
const BOTTOM: f64 = 42.0;

/// One axis of a [`Chart`].
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    title: String,
    spacing: Spacing,
    ends: Option<ConfidenceInterval>,
    from_zero: bool,
    ticks: Ticks,
}

/// Rule for the labels of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ticks {
    Anywhere,
    AtWholeNumbers,
}

impl Axis {
    /// Returns a linear axis whose range is that of the data.
    pub fn linear(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            spacing: Spacing::Linear,
            ends: None,
            from_zero: false,
            ticks: Ticks::Anywhere,
        }
    }

    /// Labels only whole numbers, as for counts.
    #[must_use]
    pub const fn whole_numbers(mut self) -> Self {
        self.ticks = Ticks::AtWholeNumbers;
        self
    }

    /// Returns a logarithmic axis, from one whole power of ten to another. Values that are not
    /// positive are left out.
    pub fn log(title: impl Into<String>) -> Self {
        Self {
            spacing: Spacing::Log,
            ..Self::linear(title)
        }
    }

    /// Makes the axis begin at 0 and end at a round number.
    #[must_use]
    pub const fn from_zero(mut self) -> Self {
        self.from_zero = true;
        self
    }

    /// Sets the range. Values beyond it are cut off.
    #[must_use]
    pub const fn between(mut self, low: f64, high: f64) -> Self {
        self.ends = Some(ConfidenceInterval::new(low, high));
        self
    }

    /// Returns the scale for `values`, with about `steps` labels.
    fn scale(&self, values: impl Iterator<Item = f64>, steps: f64) -> Scale {
        let positive = self.spacing == Spacing::Log;
        let usable = |value: &f64| value.is_finite() && (!positive || *value > 0.0);
        let (low, high) = extent(values.filter(usable), NOTHING);
        let steps = match self.ticks {
            Ticks::Anywhere => steps,
            // Steps of 1 or longer are whole numbers.
            Ticks::AtWholeNumbers => steps.min((high - low).max(1.0)),
        };
        match (self.ends, self.spacing) {
            (Some(ConfidenceInterval { low, high }), Spacing::Linear) => {
                Scale::linear(low, high, steps)
            }
            (Some(ConfidenceInterval { low, high }), Spacing::Log) => Scale::log(low, high),
            (None, Spacing::Log) => Scale::log(low, high),
            (None, Spacing::Linear) if self.from_zero && low >= 0.0 => Scale::up_to(high, steps),
            (None, Spacing::Linear) => {
                let room = 0.04 * (high - low);
                Scale::linear(low - room, high + room, steps)
            }
        }
    }
}

/// Lines, points and graphs in a frame with axes.
///
/// Layers lie above each other in the order they are added. What is not finite, or has no place on
/// a logarithmic axis, is left out.
///
/// ```
/// use tolman_draw::{Axis, Chart, GraphEdge, GraphNode, GraphPicture, Line, LinePoint, Points, Series};
/// use tolman_stats::ConfidenceInterval;
/// use tolman_geom::Point;
///
/// // Error against inputs, with the spread over runs.
/// let error = [(100.0, 0.5), (1000.0, 0.05), (10000.0, 0.01)].map(|(inputs, error)| {
///     LinePoint::new(inputs, error).spread(ConfidenceInterval { low: 0.5 * error, high: 2.0 * error })
/// });
/// let mut chart = Chart::new(Axis::log("inputs"), Axis::log("error"));
/// chart.line(Line::new("GNG", Series(0), error.to_vec()));
/// let falling = chart.drawing("The error of GNG falls with the inputs.");
///
/// // A network over its data, both axes to the same scale.
/// let mut chart = Chart::new(Axis::linear("x"), Axis::linear("y")).equal();
/// chart.points(Points::new("inputs", Series(5), vec![Point::new(0.1, 0.0), Point::new(0.9, 1.1)]));
/// let mut network = GraphPicture::new();
/// let (a, b) = (GraphNode::at(Point::origin()), GraphNode::at(Point::new(1.0, 1.0)));
/// let edge = GraphEdge::between(network.node(a), network.node(b));
/// network.edge(edge);
/// chart.graph(network);
/// let covered = chart.drawing("A network of two nodes over two inputs.");
/// # assert!(falling.body.into_string().contains("band"));
/// # assert!(covered.body.into_string().contains("graph"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    x: Axis,
    y: Axis,
    width: f64,
    height: f64,
    aspect: Aspect,
    layers: Vec<Layer>,
}

/// Whether a unit has the same length on both axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Aspect {
    Free,
    Equal,
}

#[derive(Clone, Debug, PartialEq)]
enum Layer {
    Line(Line),
    Points(Points),
    Graph(GraphPicture),
    Pinned(Pinned),
}

/// A line through values, with a band of spread around it.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Label for the legend; empty for none.
    pub label: String,
    /// Series whose colour the line is drawn in.
    pub series: Series,
    /// The values, from left to right.
    pub points: Vec<LinePoint>,
}

impl Line {
    /// Returns a line through these values.
    pub fn new(label: impl Into<String>, series: Series, points: Vec<LinePoint>) -> Self {
        Self {
            label: label.into(),
            series,
            points,
        }
    }
}

/// One value of a [`Line`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePoint {
    /// Position on the first axis.
    pub x: f64,
    /// Value on the second axis, in the axis's unit.
    pub y: f64,
    /// Spread around the value: quartiles, a 95 % interval or extremes.
    pub spread: Option<ConfidenceInterval>,
}

impl LinePoint {
    /// Returns a value without spread.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y, spread: None }
    }

    /// Sets the spread.
    #[must_use]
    pub const fn spread(mut self, spread: ConfidenceInterval) -> Self {
        self.spread = Some(spread);
        self
    }
}

/// A picture with its middle at a point of a chart.
#[derive(Clone, Debug, PartialEq)]
struct Pinned {
    at: Point,
    image: Image,
    width: f64,
    note: String,
}

/// Points that no line joins.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// Label for the legend; empty for none.
    pub label: String,
    /// Series whose colour the points are drawn in.
    pub series: Series,
    /// Positions of the points, in the units of the axes.
    pub positions: Vec<Point>,
}

impl Points {
    /// Returns a set of points.
    pub fn new(label: impl Into<String>, series: Series, positions: Vec<Point>) -> Self {
        Self {
            label: label.into(),
            series,
            positions,
        }
    }
}

impl Chart {
    /// Returns an empty chart, 520 by 320 user units.
    pub const fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            width: 520.0,
            height: 320.0,
            aspect: Aspect::Free,
            layers: Vec::new(),
        }
    }

    /// Sets the size of the whole picture, user units.
    #[must_use]
    pub const fn sized(mut self, width: f64, height: f64) -> Self {
        self.width = width;
        self.height = height;
        self
    }

    /// Gives a unit the same length on both axes, if both are linear. The height then follows from
    /// the width and the data.
    #[must_use]
    pub const fn equal(mut self) -> Self {
        self.aspect = Aspect::Equal;
        self
    }

    /// Adds a line with its band.
    pub fn line(&mut self, line: Line) {
        self.layers.push(Layer::Line(line));
    }

    /// Adds points, which no line joins.
    pub fn points(&mut self, points: Points) {
        self.layers.push(Layer::Points(points));
    }

    /// Adds a graph.
    pub fn graph(&mut self, graph: GraphPicture) {
        self.layers.push(Layer::Graph(graph));
    }

    /// Adds an image with its middle at a point, `width` user units wide. The note appears when the
    /// pointer rests on it.
    pub fn image(&mut self, at: Point, image: Image, width: f64, note: impl Into<String>) {
        let note = note.into();
        self.layers.push(Layer::Pinned(Pinned {
            at,
            image,
            width,
            note,
        }));
    }

    /// Returns the finished picture. `description` describes it in words.
    pub fn drawing(&self, description: impl Into<String>) -> Drawing {
        let (legend, legend_height) = self.legend();
        let top = TOP + legend_height;
        let width = self.width - LEFT - RIGHT;
        let xs = || self.positions().map(|(x, _)| x);
        let ys = || self.positions().map(|(_, y)| y);
        let x_scale = self.x.scale(xs(), (width / 90.0).max(2.0));
        let free_height = (self.height - TOP - BOTTOM).max(40.0);
        let y_scale = self.y.scale(ys(), (free_height / 55.0).max(2.0));
        let height = match (self.aspect, x_scale.length(), y_scale.length()) {
            (Aspect::Equal, Some(x), Some(y)) => width * y / x,
            _ => free_height,
        };
        let frame = Frame {
            x: &x_scale,
            y: &y_scale,
            width,
            height,
        };
        let body = html! {
            text class="quiet" x="0" y="12" { (self.y.title) }
            (legend)
            g transform={ "translate(" (tenths(LEFT)) " " (tenths(top)) ")" } {
                (frame.axes(&self.x.title))
                // An inner SVG element cuts off what lies beyond its edges.
                svg width=(tenths(width)) height=(tenths(height)) {
                    @for layer in &self.layers { (frame.layer(layer)) }
                }
            }
        };
        Drawing {
            width: self.width,
            height: top + height + BOTTOM,
            description: description.into(),
            body,
        }
    }

    /// Returns everything that the axes have to cover, as pairs of values.
    fn positions(&self) -> impl Iterator<Item = (f64, f64)> {
        self.layers.iter().flat_map(|layer| -> Vec<(f64, f64)> {
            match layer {
                Layer::Line(line) => line
                    .points
                    .iter()
                    .flat_map(|point| {
                        let ends = point.spread.map(|spread| [spread.low, spread.high]);
                        let ends = ends.into_iter().flatten().map(|y| (point.x, y));
                        ends.chain([(point.x, point.y)])
                    })
                    .collect(),
                Layer::Points(points) => points.positions.iter().map(|at| (at.x, at.y)).collect(),
                Layer::Graph(graph) => {
                    let nodes = graph.nodes.iter();
                    nodes
                        .map(|node| (node.position.x, node.position.y))
                        .collect()
                }
                Layer::Pinned(pinned) => vec![(pinned.at.x, pinned.at.y)],
            }
        })
    }

    /// Returns the labels in rows below the title, and the height of those rows.
    fn legend(&self) -> (Markup, f64) {
        let entries = self.layers.iter().filter_map(|layer| match layer {
            Layer::Line(line) => Some((&line.label, line.series, true)),
            Layer::Points(points) => Some((&points.label, points.series, false)),
            Layer::Graph(_) | Layer::Pinned(_) => None,
        });
        let mut placed = Vec::new();
        let (mut x, mut row) = (LEFT, 0.0);
        for (label, series, is_line) in entries.filter(|(label, ..)| !label.is_empty()) {
            let width = words::width(label) + 34.0;
            if x > LEFT && x + width > self.width {
                (x, row) = (LEFT, row + 1.0);
            }
            placed.push((x, row, label, series, is_line));
            x += width;
        }
        let height = if placed.is_empty() {
            0.0
        } else {
            (row + 1.0) * 18.0
        };
        let markup = html! {
            @for (x, row, label, series, is_line) in placed {
                @let y = TOP + 18.0 * row + 6.0;
                g class=(series.class()) {
                    @if is_line {
                        path class="line" d={ "M" (tenths(x)) " " (tenths(y)) "h18" } {}
                    } @else {
                        g class="points" { circle cx=(tenths(x + 9.0)) cy=(tenths(y)) r="3" {} }
                    }
                    text x=(tenths(x + 23.0)) y=(tenths(y)) dominant-baseline="central" { (label) }
                }
            }
        };
        (markup, height)
    }
}

/// The area between the axes.
struct Frame<'a> {
    x: &'a Scale,
    y: &'a Scale,
    width: f64,
    height: f64,
}

impl Frame<'_> {
    /// Returns the position of a pair of values in the picture; `None` if it has none.
    fn at(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let at = (
            self.x.share(x) * self.width,
            (1.0 - self.y.share(y)) * self.height,
        );
        (at.0.is_finite() && at.1.is_finite()).then_some(at)
    }

    fn axes(&self, x_title: &str) -> Markup {
        let (width, height) = (self.width, self.height);
        html! {
            @for tick in &self.y.ticks {
                @let y = (1.0 - self.y.share(tick.value)) * height;
                path class="grid" d={ "M0 " (tenths(y)) "H" (tenths(width)) } {}
                text class="quiet" x="-7" y=(tenths(y)) text-anchor="end"
                    dominant-baseline="central" { (tick.label) }
            }
            @for tick in &self.x.ticks {
                @let x = self.x.share(tick.value) * width;
                path class="grid" d={ "M" (tenths(x)) " 0V" (tenths(height)) } {}
                text class="quiet" x=(tenths(x)) y=(tenths(height + 16.0)) text-anchor="middle" {
                    (tick.label)
                }
            }
            text class="quiet" x=(tenths(width)) y=(tenths(height + 34.0)) text-anchor="end" {
                (x_title)
            }
        }
    }

    fn layer(&self, layer: &Layer) -> Markup {
        match layer {
            Layer::Line(line) => self.line(line),
            Layer::Points(points) => self.points(points),
            // A node without a position is passed on as non-finite, and so is not drawn.
            Layer::Graph(graph) => {
                let mut graph = graph.clone();
                for node in &mut graph.nodes {
                    let at = self.at(node.position.x, node.position.y);
                    node.position =
                        at.map_or(Point::new(f64::NAN, f64::NAN), |(x, y)| Point::new(x, y));
                }
                graph.markup(&|at| (at.x, at.y), (self.width, self.height))
            }
            Layer::Pinned(pinned) => self.pinned(pinned),
        }
    }

    fn pinned(&self, pinned: &Pinned) -> Markup {
        let Drawing {
            width,
            height,
            body,
            ..
        } = pinned.image.drawing("", pinned.width);
        let place = self.at(pinned.at.x, pinned.at.y);
        let corner = place.map(|(x, y)| (x - 0.5 * width, y - 0.5 * height));
        html! {
            @if let Some((x, y)) = corner {
                svg x=(tenths(x)) y=(tenths(y)) width=(tenths(width)) height=(tenths(height)) {
                    @if !pinned.note.is_empty() { title { (pinned.note) } }
                    (body)
                }
            }
        }
    }

    fn line(&self, shown: &Line) -> Markup {
        let values = shown.points.iter();
        let path = line(values.clone().filter_map(|point| self.at(point.x, point.y)));
        let with_spread = || shown.points.iter().filter_map(|p| Some((p.x, p.spread?)));
        let above = with_spread().map(|(x, spread)| (x, spread.high));
        let below: Vec<(f64, f64)> = with_spread().map(|(x, spread)| (x, spread.low)).collect();
        let around = above.chain(below.into_iter().rev());
        let band = line(around.filter_map(|(x, y)| self.at(x, y)));
        html! {
            g class=(shown.series.class()) {
                @if !band.is_empty() { path class="band" d={ (band) "Z" } {} }
                path class="line" d=(path) {}
                @if shown.points.len() <= 30 {
                    g class="points" {
                        @for (x, y) in values.filter_map(|point| self.at(point.x, point.y)) {
                            circle cx=(tenths(x)) cy=(tenths(y)) r="2.4" {}
                        }
                    }
                }
            }
        }
    }

    fn points(&self, points: &Points) -> Markup {
        let radius = if points.positions.len() > 400 {
            "1.2"
        } else {
            "2"
        };
        html! {
            g class={ "points many " (points.series.class()) } {
                @for (x, y) in points.positions.iter().filter_map(|at| self.at(at.x, at.y)) {
                    circle cx=(tenths(x)) cy=(tenths(y)) r=(radius) {}
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{GraphEdge, GraphNode};

    fn unit(title: &str) -> Axis {
        Axis::linear(title).between(0.0, 1.0)
    }

    fn svg(chart: &Chart) -> String {
        chart.drawing("a test").body.into_string()
    }

    /// Returns a chart whose frame is 100 by 100.
    fn square(x: Axis, y: Axis) -> Chart {
        Chart::new(x, y).sized(100.0 + LEFT + RIGHT, 100.0 + TOP + BOTTOM)
    }

    #[test]
    fn values_lie_where_the_axes_say() {
        let mut chart = square(unit("x"), unit("y"));
        let spread = ConfidenceInterval::new(0.25, 1.0);
        let points = vec![
            LinePoint::new(0.0, 0.0).spread(ConfidenceInterval::new(0.0, 0.5)),
            LinePoint::new(1.0, 0.5).spread(spread),
        ];
        chart.line(Line::new("", Series(0), points));
        let svg = svg(&chart);
        assert!(svg.contains("class=\"line\" d=\"M0 100L100 50\""), "{svg}");
        assert!(
            svg.contains("class=\"band\" d=\"M0 50L100 0L100 75L0 100Z\""),
            "{svg}"
        );
    }

    #[test]
    fn logarithmic_axes_take_positive_values_only() {
        let mut chart = square(Axis::log("n"), Axis::log("error"));
        let values = [(1.0, 0.01), (10.0, 0.0), (100.0, 1.0), (f64::NAN, 1.0)];
        let points = values.map(|(x, y)| LinePoint::new(x, y)).to_vec();
        chart.line(Line::new("", Series(0), points));
        assert!(svg(&chart).contains("class=\"line\" d=\"M0 100L100 0\""));
    }

    #[test]
    fn equal_axes_give_the_picture_the_shape_of_its_data() {
        let mut chart = square(Axis::linear("x"), Axis::linear("y")).equal();
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)];
        let corners = corners.map(|(x, y)| Point::new(x, y)).to_vec();
        chart.points(Points::new("data", Series(1), corners));
        let drawing = chart.drawing("a rectangle");
        // Half as high as wide, and one row for the legend.
        let height = drawing.height - TOP - BOTTOM - 18.0;
        assert!((height - 50.0).abs() < 1e-9, "{height}");
    }

    #[test]
    fn a_graph_shares_the_frame() {
        let mut chart = square(unit("x"), unit("y"));
        let mut graph = GraphPicture::new();
        for at in [(0.0, 0.0), (1.0, 1.0), (f64::INFINITY, 0.0)] {
            graph.node(GraphNode::at(Point::new(at.0, at.1)));
        }
        graph.edge(GraphEdge::between(0, 1));
        chart.graph(graph);
        let svg = svg(&chart);
        assert!(svg.contains("d=\"M0 100L100 0\""));
        assert_eq!(svg.matches("class=\"node").count(), 2);
    }

    #[test]
    fn images_have_their_middles_where_the_axes_say() {
        let mut chart = square(unit("x"), unit("y"));
        let image = Image::grey(2, 1, &[0, 255]).unwrap();
        chart.image(Point::new(0.25, 0.5), image.clone(), 20.0, "two & two");
        chart.image(Point::new(f64::NAN, 0.5), image, 20.0, "nowhere");
        let svg = svg(&chart);
        let place = "<svg x=\"15\" y=\"45\" width=\"20\" height=\"10\"><title>two &amp; two";
        assert!(svg.contains(place), "{svg}");
        assert!(!svg.contains("nowhere"));
    }

    #[test]
    fn an_empty_chart_has_axes() {
        let drawing = Chart::new(Axis::linear("x"), Axis::log("y")).drawing("nothing");
        assert!(drawing.height.is_finite());
        let body = drawing.body.into_string();
        assert!(
            body.contains("grid") && roxmltree::Document::parse(&format!("<g>{body}</g>")).is_ok()
        );
    }
}
