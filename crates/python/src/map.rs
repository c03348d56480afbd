use std::path::PathBuf;

use numpy::PyArray2;
use numpy::ndarray::Array2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tolman_geom::Pose;
use tolman_robot::{Landmark, MapPlace, MapView};

use crate::drive::PyDrive;
use crate::errors::{unread, wrong};
use crate::maze::PyMaze;
use crate::replay::PyReplay;
use crate::robot::tuple;
use crate::system::{Lesson, drive, opened};

/// A map that a system has learned, as `learn`, `map_log` and `Map.open` return it.
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
    /// The map as the command reads it, or why there is no such file.
    pub(crate) file: Result<String, String>,
    /// What it was learned from; `None` for a log or a file.
    pub(crate) lesson: Option<Lesson>,
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

    /// Returns the robot's way, an array of shape (steps or scans, 3): x and y, m, and heading,
    /// rad. For a simulated robot it is the true way, for a log the one that was found.
    #[getter]
    fn path<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        table(py, &self.poses)
    }

    /// Reads a map that `save` or `tolman learn` wrote.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file.
    ///
    /// Returns
    /// -------
    /// Map
    ///
    /// Raises
    /// ------
    /// OSError
    ///     If the file cannot be read.
    /// ValueError
    ///     If it holds no map. The message says where.
    #[staticmethod]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn open(path: PathBuf) -> PyResult<Self> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(&path).map_err(|error| unread(&name, &error))?;
        opened(name, text)
    }

    /// Writes the map to a file that the command reads, as `tolman map show` and `tolman drive`.
    ///
    /// Parameters
    /// ----------
    /// path : str or path
    ///     The file, which is overwritten.
    ///
    /// Raises
    /// ------
    /// OSError
    ///     If it cannot be written.
    /// ValueError
    ///     If the system has no such file.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn save(&self, path: PathBuf) -> PyResult<()> {
        let text = self.text()?;
        std::fs::write(&path, text).map_err(|error| unread(&path.display().to_string(), &error))
    }

    /// Sends a robot by the map from a random place to the goal. Ctrl-C ends it within one action.
    ///
    /// Parameters
    /// ----------
    /// maze : Maze or None
    ///     Where the robot drives; by default in the maze in which the map was learned.
    /// seed : int
    ///     From 0. The same seed gives the same drive.
    /// progress : callable or None
    ///     Called now and then with the number of time steps so far and a few words.
    ///
    /// Returns
    /// -------
    /// Drive
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the map has no file or does not know its maze, or the robot does not fit into the
    ///     maze.
    #[pyo3(signature = (maze = None, *, seed = 1, progress = None))]
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over objects of their own"
    )]
    fn drive(
        &self,
        py: Python<'_>,
        maze: Option<Py<PyMaze>>,
        seed: u64,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<PyDrive> {
        let learned_in = self.lesson.as_ref().map(|lesson| &lesson.maze);
        let maze = maze
            .as_ref()
            .or(learned_in)
            .ok_or_else(|| wrong("maze: the map does not know its maze, so give it".to_owned()))?;
        let (text, maze) = (self.text()?, maze.get());
        py.detach(|| drive(text, maze, seed, progress.as_ref()))
    }

    /// Returns the replay of the learning, which a notebook shows. The system learns again for it.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the map is of a log or a file.
    fn replay(&self, py: Python<'_>) -> PyResult<PyReplay> {
        let lesson = self
            .lesson
            .as_ref()
            .ok_or_else(|| wrong("there is no replay of a map from a log or a file".to_owned()))?;
        lesson.replay(py).map(PyReplay)
    }

    /// Returns the places as a frame of pandas: a row a place, its id as the index, x and y, m, and
    /// its landmark, each as far as it is known.
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     If pandas is not installed.
    fn to_frame<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        pictures(py)?.call_method1("frame_of_places", (self.places(py)?,))
    }

    /// Draws places, links and the robot's way with matplotlib, in metres.
    ///
    /// Parameters
    /// ----------
    /// ax : matplotlib.axes.Axes or None
    ///     Where to draw; None makes new axes.
    ///
    /// Returns
    /// -------
    /// matplotlib.axes.Axes
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     If matplotlib is not installed.
    #[pyo3(signature = (ax = None))]
    fn plot<'py>(
        &self,
        py: Python<'py>,
        ax: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let drawn = (ax, self.places(py)?, self.links(), self.path(py)?);
        pictures(py)?.call_method1("plot_map", drawn)
    }

    /// Returns the map as a directed graph of networkx. Its nodes are ids, with the attributes x
    /// and y, m, and landmark, as text, each as far as it is known.
    ///
    /// Raises
    /// ------
    /// ImportError
    ///     If networkx is not installed.
    fn to_networkx<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let graph = py.import("networkx")?.call_method0("DiGraph")?;
        for place in &self.view.places {
            let known = told(py, place)?;
            if let Some(position) = place.position {
                known.del_item("position")?;
                known.set_item("x", position.x)?;
                known.set_item("y", position.y)?;
            }
            // Files of graphs hold one type an attribute.
            if let Some(landmark) = known.get_item("landmark")? {
                known.set_item("landmark", landmark.str()?)?;
            }
            graph.call_method("add_node", (place.id,), Some(&known))?;
        }
        for link in &self.view.links {
            graph.call_method1("add_edge", (link.from, link.to))?;
        }
        Ok(graph)
    }

    /// Returns a drawing as SVG: a dot for each place whose position is known, S at the start and G
    /// at the goal, and the links between them.
    fn svg(&self) -> String {
        let placed = self.view.places.iter();
        let placed = placed.filter_map(|place| Some((place, place.position?)));
        let placed: Vec<_> = placed.collect();
        let span = |part: fn(&tolman_geom::Point) -> f64| {
            let values = placed.iter().map(|(_, position)| part(position));
            let (low, high) = values
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                    (low.min(value), high.max(value))
                });
            (low, high)
        };
        let ((west, east), (south, north)) = (span(|at| at.x), span(|at| at.y));
        let side = 320.0;
        let scale = (side - 24.0) / (east - west).max(north - south).max(1e-9);
        let at = |position: tolman_geom::Point| {
            let (x, y) = (position.x - west, north - position.y);
            (12.0 + scale * x, 12.0 + scale * y)
        };
        let position = |id: u32| {
            let found = placed.iter().find(|(place, _)| place.id == id);
            found.map(|(_, position)| at(*position))
        };
        let mut drawn = String::new();
        for link in &self.view.links {
            if let (Some(from), Some(to)) = (position(link.from), position(link.to)) {
                drawn.push_str(&format!(
                    "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#999\"/>",
                    from.0, from.1, to.0, to.1
                ));
            }
        }
        for (place, position) in &placed {
            let (x, y) = at(*position);
            drawn.push_str(&format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#1f77b4\"/>"
            ));
            let letter = match place.landmark {
                Some(Landmark::Start) => "S",
                Some(Landmark::Goal) => "G",
                _ => continue,
            };
            drawn.push_str(&format!(
                "<text x=\"{:.1}\" y=\"{:.1}\">{letter}</text>",
                x + 5.0,
                y - 5.0
            ));
        }
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{side}\" height=\"{side}\" viewBox=\"0 0 {side} {side}\" \
             font-family=\"sans-serif\" font-size=\"12\">{drawn}</svg>"
        )
    }

    /// Returns what a notebook shows.
    fn _repr_html_(&self) -> String {
        self.svg()
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

impl PyMap {
    /// Returns the text of its file.
    fn text(&self) -> PyResult<&str> {
        let text = self.file.as_deref();
        text.map_err(|why| wrong(format!("this map has no file: {why}")))
    }
}

/// Returns the module that draws with matplotlib.
pub(crate) fn pictures(py: Python<'_>) -> PyResult<Bound<'_, PyModule>> {
    py.import("tolman._pictures")
}

/// Returns poses, one row each: x and y, m, and heading, rad.
pub(crate) fn table<'py>(py: Python<'py>, poses: &[Pose]) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let mut values = Vec::with_capacity(3 * poses.len());
    for pose in poses {
        let (x, y, heading) = tuple(*pose);
        values.extend([x, y, heading]);
    }
    let rows = Array2::from_shape_vec((poses.len(), 3), values);
    let rows = rows.map_err(|error| wrong(error.to_string()))?;
    Ok(PyArray2::from_owned_array(py, rows))
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
