use alloc::collections::BTreeMap;

use tolman_arena::pioneer;
use tolman_draw::{Drawing, GraphEdge, GraphNode, GraphPicture, LinePoint, PolarPlot, Series};
use tolman_quantizers::{Network, Scalar, UnitId};
use tolman_stats::{ConfidenceInterval, mean, quantile};
use tolman_systems::mslst::ROBOT_UNIT;

/// Returns a scan that MSLST has learned, in robot units, as seen from the robot; `size` user units
/// wide.
pub(crate) fn model_scan(model: impl Iterator<Item = f64>, size: f64, what: String) -> Drawing {
    let ring = pioneer::ring();
    let metres: Vec<f64> = model.map(|range| range * ROBOT_UNIT).collect();
    let mut plot = PolarPlot::new(ring.max_range, size);
    plot.ranges(&ring, &metres, Series(0));
    plot.drawing(what)
}

/// Returns the mean of values as a point of a line, with their quartiles; `None` without values.
pub(crate) fn mean_with_quartiles(x: f64, values: &[f64]) -> Option<LinePoint> {
    let at = |share| quantile(values, share).ok();
    let quartiles = ConfidenceInterval::new(at(0.25)?, at(0.75)?);
    Some(LinePoint::new(x, mean(values).ok()?).spread(quartiles))
}

/// Returns a network as a graph. `node` draws a unit, or leaves it out; an edge has the colour of
/// the unit at which it begins.
pub(crate) fn network_graph<S: Scalar>(
    network: &Network<S>,
    node: impl Fn(UnitId) -> Option<GraphNode>,
) -> GraphPicture {
    let mut graph = GraphPicture::new();
    let mut nodes = BTreeMap::new();
    for id in network.ids() {
        if let Some(node) = node(id) {
            let series = node.series;
            nodes.insert(id, (graph.node(node), series));
        }
    }
    for edge in network.edges() {
        let ends = nodes.get(&edge.ends.0).zip(nodes.get(&edge.ends.1));
        if let Some(((from, series), (to, _))) = ends {
            graph.edge(GraphEdge::between(*from, *to).series(*series));
        }
    }
    graph
}
