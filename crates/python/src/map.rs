use numpy::PyArray2;
use numpy::ndarray::Array2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tolman_geom::Pose;
use tolman_robot::{Landmark, MapPlace, MapView};

use crate::errors::wrong;
use crate::robot::tuple;

/// A map that a system has learned.
#[pyclass(name = "Map", module = "tolman", frozen)]
pub(crate) struct PyMap {
    pub(crate) view: MapView,
    /// The robot's way, m and rad.
    pub(crate) poses: Vec<Pose>,
    /// Name of its system.
    #[pyo3(get)]
    pub(crate) system: String,
    /// End of the learning, in words.
    #[pyo3(get)]
    pub(crate) outcome: String,
    /// Probability that the map is right, by the system's own estimate, 0 … 1; `None` if it has
    /// none.
    #[pyo3(get)]
    pub(crate) certainty: Option<f64>,
    /// Whether the map is right; `None` if the truth is unknown.
    #[pyo3(get)]
    pub(crate) is_right: Option<bool>,
    /// Number of places that were recognized again; only for a log.
    #[pyo3(get)]
    pub(crate) closures: Option<usize>,
}

#[pymethods]
impl PyMap {
    /// Returns the places by id: `position` in the map's own frame, m, and `landmark`. Either is
    /// left out where the map has none.
    #[getter]
    fn places<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let places = PyDict::new(py);
        for place in &self.view.places {
            places.set_item(place.id, told(py, place)?)?;
        }
        Ok(places)
    }

    /// Returns the ways between places, as pairs of ids. A way that can be driven in both
    /// directions is listed twice.
    #[getter]
    fn links(&self) -> Vec<(u32, u32)> {
        let links = self.view.links.iter();
        links.map(|link| (link.from, link.to)).collect()
    }

    /// Returns the robot's way, one row per step or scan: x and y, m, and heading, rad. For a
    /// simulated robot it is the true way, for a log the one that was found.
    #[getter]
    fn path<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut values = Vec::with_capacity(3 * self.poses.len());
        for pose in &self.poses {
            let (x, y, heading) = tuple(*pose);
            values.extend([x, y, heading]);
        }
        let rows = Array2::from_shape_vec((self.poses.len(), 3), values);
        let rows = rows.map_err(|error| wrong(error.to_string()))?;
        Ok(PyArray2::from_owned_array(py, rows))
    }

    /// Returns the map as a directed graph of networkx. Its nodes are ids with the attributes of
    /// [`Self::places`].
    fn to_networkx<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let graph = py.import("networkx")?.call_method0("DiGraph")?;
        for place in &self.view.places {
            graph.call_method("add_node", (place.id,), Some(&told(py, place)?))?;
        }
        for link in &self.view.links {
            graph.call_method1("add_edge", (link.from, link.to))?;
        }
        Ok(graph)
    }

    fn __len__(&self) -> usize {
        self.view.places.len()
    }

    fn __repr__(&self) -> String {
        let (places, links) = (self.view.places.len(), self.view.links.len());
        format!(
            "<tolman.Map of {}: {places} places, {links} links>",
            self.system
        )
    }
}

/// Returns the attributes of a place: `position` and `landmark`, each only if it is known.
fn told<'py>(py: Python<'py>, place: &MapPlace) -> PyResult<Bound<'py, PyDict>> {
    let known = PyDict::new(py);
    if let Some(position) = place.position {
        known.set_item("position", (position.x, position.y))?;
    }
    match place.landmark {
        Some(Landmark::Start) => known.set_item("landmark", "start")?,
        Some(Landmark::Goal) => known.set_item("landmark", "goal")?,
        Some(Landmark::Numbered(number)) => known.set_item("landmark", number)?,
        None => {}
    }
    Ok(known)
}
