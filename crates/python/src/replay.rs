use std::path::PathBuf;

use pyo3::prelude::*;
use tolman_replay::{Replay, moving_picture, page};

use crate::errors::{refused, unread};

/// The recording of a robot's way, and of what its system knew on it, as `Map.replay` and
/// `Drive.replay` return it.
#[pyclass(name = "Replay", module = "tolman", frozen)]
pub(crate) struct PyReplay(pub(crate) Replay);

#[pymethods]
impl PyReplay {
    /// Returns the replay as an SVG that plays in a loop, without a script.
    fn svg(&self) -> String {
        moving_picture(&self.0)
    }

    /// Returns the replay as a whole HTML page, with controls. It needs no network.
    fn html(&self) -> PyResult<String> {
        page(&self.0).map_err(|error| refused("replay", &error))
    }

    /// Writes the page to a file.
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
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over a path of its own"
    )]
    fn save(&self, path: PathBuf) -> PyResult<()> {
        let text = self.html()?;
        std::fs::write(&path, text).map_err(|error| unread(&path.display().to_string(), &error))
    }

    /// Returns what a notebook shows.
    pub(crate) fn _repr_html_(&self) -> String {
        self.svg()
    }

    fn __repr__(&self) -> String {
        format!(
            "<tolman.Replay {:?}, {} steps>",
            self.0.title,
            self.0.steps()
        )
    }
}
