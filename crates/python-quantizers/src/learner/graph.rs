use numpy::ndarray::{Array2, ArrayView2};
use pyo3::prelude::*;
use tolman_quantizers::{Network, Scalar, UnitId, UnknownUnit};

use crate::errors::wrong;
use crate::rows::each;

/// Returns the prototypes by ascending id, one row per unit.
pub(super) fn prototypes<S: Scalar>(network: &Network<S>) -> PyResult<Array2<S>> {
    let mut values = Vec::with_capacity(network.len() * network.dimension());
    for id in network.ids() {
        values.extend(network.prototype(id).map_err(gone)?);
    }
    let shape = (network.len(), network.dimension());
    Array2::from_shape_vec(shape, values).map_err(|error| wrong(error.to_string()))
}

/// Returns the ids of the units, ascending.
pub(super) fn ids<S: Scalar>(network: &Network<S>) -> Vec<i64> {
    network.ids().map(|id| i64::from(id.0)).collect()
}

/// Returns the ends of each edge, as numbers of units by ascending id, and its age.
pub(super) fn edges<S: Scalar>(network: &Network<S>) -> PyResult<Array2<i64>> {
    let ids: Vec<UnitId> = network.ids().collect();
    let mut values = Vec::new();
    for edge in network.edges() {
        values.push(number(&ids, edge.ends.0));
        values.push(number(&ids, edge.ends.1));
        values.push(i64::from(edge.age));
    }
    let shape = (values.len() / 3, 3);
    Array2::from_shape_vec(shape, values).map_err(|error| wrong(error.to_string()))
}

/// Returns, for each unit, the number of its cluster.
pub(super) fn clusters<S: Scalar>(network: &Network<S>) -> Vec<i64> {
    let clusters = network.clusters();
    clusters.iter().map(|(_, label)| i64::from(label)).collect()
}

/// Returns, for each row, the number of the nearest unit and its squared distance.
pub(super) fn nearest<S: Scalar>(
    network: &Network<S>,
    x: &ArrayView2<'_, S>,
) -> PyResult<(Vec<i64>, Vec<f64>)> {
    let ids: Vec<UnitId> = network.ids().collect();
    let (mut numbers, mut squared) = (Vec::with_capacity(x.nrows()), Vec::with_capacity(x.nrows()));
    each(x, |input| {
        let nearest = network.nearest(input)?;
        numbers.push(number(&ids, nearest.id));
        squared.push(nearest.squared_distance.to_f64());
        Ok(())
    })?;
    Ok((numbers, squared))
}

fn number(ids: &[UnitId], id: UnitId) -> i64 {
    ids.partition_point(|known| *known < id) as i64
}

fn gone(error: UnknownUnit) -> PyErr {
    wrong(error.to_string())
}
