use pyo3::prelude::*;
use tolman_planners::{Arcs, a_star};

use crate::errors::wrong;

/// Returns the nodes of a cheapest path from `source` to `target` and its cost, or `None` if no
/// path leads there. Nodes are numbers below `nodes`; `arcs` are tuples (tail, head, cost).
#[pyfunction]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over a list of its own"
)]
pub(crate) fn cheapest_path(
    py: Python<'_>,
    nodes: usize,
    arcs: Vec<(u32, u32, u32)>,
    source: u32,
    target: u32,
) -> PyResult<Option<(Vec<u32>, u32)>> {
    if let Some(&(tail, head, _)) = arcs
        .iter()
        .find(|(tail, head, _)| (*tail).max(*head) as usize >= nodes)
    {
        return Err(wrong(format!(
            "arcs: {tail} to {head} is not an arc between {nodes} nodes, which are numbered from 0"
        )));
    }
    py.detach(|| {
        let found = a_star(
            &Arcs::new(nodes, &arcs),
            source,
            |node| node == target,
            |_| 0,
        );
        Ok(found.map(|found| (found.path, found.cost)))
    })
}
