//! Search on graphs of Python's own. Only what a search reaches is looked up.

use core::cell::RefCell;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use tolman_planners::{Graph, a_star, path_between};

use crate::errors::wrong;

/// Returns the nodes of a cheapest path from `source` to `target` and its cost, or `None` if no
/// path leads there.
#[pyfunction]
#[pyo3(signature = (graph, source, target, weight))]
pub(crate) fn cheapest_path<'py>(
    graph: &Bound<'py, PyAny>,
    source: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
    weight: Option<&str>,
) -> PyResult<Option<(Vec<Bound<'py, PyAny>>, u32)>> {
    // What networkx's own searches use; its mappings are written in Python.
    let inner = |name: &str| {
        let found = graph.getattr(name).ok();
        found.filter(PyAnyMethods::is_instance_of::<PyDict>)
    };
    let adjacent = inner("_adj").unwrap_or_else(|| graph.clone());
    for (name, node) in [("source", source), ("target", target)] {
        if !adjacent.contains(node)? {
            return Err(wrong(format!(
                "{name} is {}, which is no node of the graph",
                node.repr()?
            )));
        }
    }
    // Undirected graphs have no predecessors.
    let before = inner("_pred").or_else(|| inner("_adj"));
    if let (Some(adjacent), Some(before), None) = (inner("_adj"), &before, weight) {
        return fewest_steps(adjacent.cast()?, before.cast()?, source, target);
    }
    let known = RefCell::new(Known {
        nodes: Vec::new(),
        numbers: PyDict::new(graph.py()),
        fault: None,
    });
    let from = known.borrow_mut().number(source)?;
    let to = known.borrow_mut().number(target)?;
    let lazy = |adjacent: Bound<'py, PyAny>| {
        let count = adjacent.len()?;
        PyResult::Ok(Lazy {
            count,
            adjacent,
            weight,
            known: &known,
        })
    };
    let found = match before {
        Some(before) => path_between(&lazy(adjacent)?, &lazy(before)?, from, to),
        None => {
            let found = a_star(&lazy(adjacent)?, from, |node| node == to, |_| 0);
            found.map(|found| (found.path, found.cost))
        }
    };
    let known = known.into_inner();
    if let Some(fault) = known.fault {
        return Err(fault);
    }
    Ok(found.map(|(path, cost)| {
        let nodes = path.iter().map(|node| known.nodes[*node as usize].clone());
        (nodes.collect(), cost)
    }))
}

/// Returns the nodes of a path of the fewest arcs and their number: breadth-first search from both
/// ends, by what networkx keeps of a graph, on the end that has fewer nodes to go on from.
fn fewest_steps<'py>(
    adjacent: &Bound<'py, PyDict>,
    before: &Bound<'py, PyDict>,
    source: &Bound<'py, PyAny>,
    target: &Bound<'py, PyAny>,
) -> PyResult<Option<(Vec<Bound<'py, PyAny>>, u32)>> {
    let py = adjacent.py();
    // For each node that an end has met, the node it was met from.
    let (from_source, from_target) = (PyDict::new(py), PyDict::new(py));
    from_source.set_item(source, py.None())?;
    from_target.set_item(target, py.None())?;
    let (mut ahead, mut back) = (vec![source.clone()], vec![target.clone()]);
    let mut middle = from_target.contains(source)?.then(|| source.clone());
    while middle.is_none() && !ahead.is_empty() && !back.is_empty() {
        let (level, arcs, met, others) = match ahead.len() <= back.len() {
            true => (&mut ahead, adjacent, &from_source, &from_target),
            false => (&mut back, before, &from_target, &from_source),
        };
        'level: for tail in core::mem::take(level) {
            let Some(heads) = arcs.get_item(&tail)? else {
                continue;
            };
            for head in heads.try_iter()? {
                let head = head?;
                if met.contains(&head)? {
                    continue;
                }
                met.set_item(&head, &tail)?;
                if others.contains(&head)? {
                    middle = Some(head);
                    break 'level;
                }
                level.push(head);
            }
        }
    }
    let Some(middle) = middle else {
        return Ok(None);
    };
    let mut nodes = vec![middle.clone()];
    let mut at = middle.clone();
    while let Some(node) = from_source.get_item(&at)?.filter(|node| !node.is_none()) {
        nodes.push(node.clone());
        at = node;
    }
    nodes.reverse();
    at = middle;
    while let Some(node) = from_target.get_item(&at)?.filter(|node| !node.is_none()) {
        nodes.push(node.clone());
        at = node;
    }
    let steps = nodes.len() as u32 - 1;
    Ok(Some((nodes, steps)))
}

/// A graph that numbers its nodes as a search meets them.
struct Lazy<'a, 'py> {
    count: usize,
    /// For each node the nodes that its arcs lead to, or a mapping of them to costs or attributes.
    adjacent: Bound<'py, PyAny>,
    weight: Option<&'a str>,
    known: &'a RefCell<Known<'py>>,
}

struct Known<'py> {
    nodes: Vec<Bound<'py, PyAny>>,
    numbers: Bound<'py, PyDict>,
    /// The first fault of the graph. Nothing is looked up any more.
    fault: Option<PyErr>,
}

impl<'py> Known<'py> {
    fn number(&mut self, node: &Bound<'py, PyAny>) -> PyResult<u32> {
        if let Some(number) = self.numbers.get_item(node)? {
            return number.extract();
        }
        let number = self.nodes.len() as u32;
        self.numbers.set_item(node, number)?;
        self.nodes.push(node.clone());
        Ok(number)
    }
}

impl Graph for Lazy<'_, '_> {
    fn node_count(&self) -> usize {
        self.count
    }

    fn for_each_arc(&self, node: u32, mut visit: impl FnMut(u32, u32)) {
        let known = &mut *self.known.borrow_mut();
        if known.fault.is_none()
            && let Err(fault) = self.list(known, node, &mut visit)
        {
            known.fault = Some(fault);
        }
    }
}

impl<'py> Lazy<'_, 'py> {
    fn list(
        &self,
        known: &mut Known<'py>,
        node: u32,
        visit: &mut impl FnMut(u32, u32),
    ) -> PyResult<()> {
        let tail = known.nodes[node as usize].clone();
        let heads = self.adjacent.get_item(&tail)?;
        let mut arc = |head: &Bound<'py, PyAny>, cost: Option<Bound<'py, PyAny>>| {
            let cost = self.cost(cost, &tail, head)?;
            let number = match known.numbers.get_item(head)? {
                Some(number) => number.extract()?,
                None if self.adjacent.contains(head)? => known.number(head)?,
                None => {
                    return Err(wrong(format!(
                        "graph: {} leads to {}, which is no node of it",
                        tail.repr()?,
                        head.repr()?
                    )));
                }
            };
            visit(number, cost);
            PyResult::Ok(())
        };
        if let Ok(heads) = heads.cast::<PyDict>() {
            for (head, cost) in heads.iter() {
                arc(&head, Some(cost))?;
            }
            return Ok(());
        }
        let is_mapping = heads.cast::<PyMapping>().is_ok();
        for head in heads.try_iter()? {
            let head = head?;
            let cost = is_mapping.then(|| heads.get_item(&head)).transpose()?;
            arc(&head, cost)?;
        }
        Ok(())
    }

    /// Returns the cost of an arc, given what the graph holds of it; 1 if that is nothing.
    fn cost(
        &self,
        held: Option<Bound<'py, PyAny>>,
        tail: &Bound<'py, PyAny>,
        head: &Bound<'py, PyAny>,
    ) -> PyResult<u32> {
        let has_attributes = held
            .as_ref()
            .is_some_and(|held| held.cast::<PyMapping>().is_ok());
        let cost = match (held, self.weight) {
            (Some(attributes), Some(weight)) if has_attributes => {
                if !attributes.contains(weight)? {
                    return Err(wrong(format!(
                        "weight: the arc from {} to {} has no attribute '{weight}'",
                        tail.repr()?,
                        head.repr()?
                    )));
                }
                attributes.get_item(weight)?
            }
            (Some(_), None) if has_attributes => return Ok(1),
            (_, Some(_)) => {
                return Err(wrong(
                    "weight is for graphs whose arcs have attributes, as those of networkx"
                        .to_owned(),
                ));
            }
            (Some(cost), None) => cost,
            (None, None) => return Ok(1),
        };
        let whole = cost.extract::<u32>().ok().or_else(|| {
            let number = cost.extract::<f64>().ok()?;
            let is_whole = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
            is_whole.then_some(number as u32)
        });
        whole.ok_or_else(|| match (cost.repr(), tail.repr(), head.repr()) {
            (Ok(cost), Ok(tail), Ok(head)) => wrong(format!(
                "the cost from {tail} to {head} is {cost} but has to be a whole number from 0 to {}",
                u32::MAX
            )),
            _ => wrong("a cost has to be a whole number".to_owned()),
        })
    }
}
