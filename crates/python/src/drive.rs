use numpy::PyArray2;
use pyo3::prelude::*;
use tolman_geom::{Pose, path_length};
use tolman_replay::Replay;

use crate::map::table;
use crate::replay::PyReplay;

/// A drive to the goal by a learned map, as `Map.drive` returns it.
#[pyclass(name = "Drive", module = "tolman", frozen)]
pub(crate) struct PyDrive {
    /// Whether the robot is at the goal.
    #[pyo3(get)]
    pub(crate) reached: bool,
    /// End of the drive, in words.
    #[pyo3(get)]
    pub(crate) outcome: String,
    /// Number of time steps in which it touched something.
    #[pyo3(get)]
    pub(crate) bumps: usize,
    pub(crate) poses: Vec<Pose>,
    pub(crate) replay: Replay,
}

#[pymethods]
impl PyDrive {
    /// Returns the robot's true way, an array of shape (steps + 1, 3): x and y, m, and heading,
    /// rad.
    #[getter]
    fn path<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        table(py, &self.poses)
    }

    /// Returns the number of time steps.
    #[getter]
    fn steps(&self) -> usize {
        self.poses.len() - 1
    }

    /// Returns the length of the way, m.
    #[getter]
    fn metres(&self) -> f64 {
        path_length(&self.poses)
    }

    /// Returns the replay, which a notebook shows.
    fn replay(&self) -> PyReplay {
        PyReplay(self.replay.clone())
    }

    /// Returns what a notebook shows.
    fn _repr_html_(&self) -> String {
        self.replay()._repr_html_()
    }

    fn __repr__(&self) -> String {
        let ended = if self.reached {
            "at the goal"
        } else {
            &self.outcome
        };
        format!(
            "<tolman.Drive: {ended} after {} steps, {:.1} m>",
            self.steps(),
            self.metres()
        )
    }
}
