use numpy::ndarray::Array2;
use pyo3::prelude::*;
use tolman_quantizers::{Network, Scalar, UnitId};

use crate::errors::wrong;

/// The units and edges of a network at one moment.
pub(super) struct Graph<S> {
    /// One row per unit, by ascending id.
    pub(super) units: Array2<S>,
    pub(super) ids: Vec<i64>,
    /// The two ends of each edge, as rows of `units`, and its age.
    pub(super) edges: Array2<i64>,
    /// The cluster of each unit.
    pub(super) clusters: Vec<i64>,
}

impl<S: Scalar> Graph<S> {
    pub(super) fn of(network: &Network<S>) -> PyResult<Self> {
        let ids: Vec<UnitId> = network.ids().collect();
        let mut values = Vec::with_capacity(ids.len() * network.dimension());
        for id in &ids {
            let prototype = network.prototype(*id);
            values.extend(prototype.map_err(|error| wrong(error.to_string()))?);
        }
        let mut edges = Vec::new();
        for edge in network.edges() {
            let ends = [edge.ends.0, edge.ends.1];
            edges.extend(ends.map(|end| number(&ids, end)));
            edges.push(i64::from(edge.age));
        }
        let clusters = network.clusters();
        Ok(Self {
            units: table(values, network.dimension())?,
            edges: table(edges, 3)?,
            clusters: clusters.iter().map(|(_, label)| i64::from(label)).collect(),
            ids: ids.iter().map(|id| i64::from(id.0)).collect(),
        })
    }
}

fn table<T>(values: Vec<T>, columns: usize) -> PyResult<Array2<T>> {
    let shape = (values.len() / columns, columns);
    Array2::from_shape_vec(shape, values).map_err(|error| wrong(error.to_string()))
}

/// Returns the row of a unit among all of them.
pub(super) fn number(ids: &[UnitId], id: UnitId) -> i64 {
    ids.partition_point(|known| *known < id) as i64
}
