//! The Rust part of the Python module `tolman`: `tolman._tolman`.
//!
//! `python/tolman` is the other part: environments, mappers and types. Slow or long work
//! happens here, with Python's lock released.

extern crate alloc;

mod bump_map;
mod drive;
mod errors;
mod grids;
mod log;
mod map;
mod maze;
mod mouse;
mod planners;
mod replay;
mod robot;
mod system;

/// The module as Python imports it.
#[pyo3::pymodule]
mod _tolman {
    #[pymodule_export]
    use crate::bump_map::PyBumpMap;
    #[pymodule_export]
    use crate::drive::PyDrive;
    #[pymodule_export]
    use crate::grids::PyGrids;
    #[pymodule_export]
    use crate::log::map_log;
    #[pymodule_export]
    use crate::map::PyMap;
    #[pymodule_export]
    use crate::maze::PyMaze;
    #[pymodule_export]
    use crate::mouse::PyMouse;
    #[pymodule_export]
    use crate::planners::cheapest_path;
    #[pymodule_export]
    use crate::replay::PyReplay;
    #[pymodule_export]
    use crate::robot::PyRobot;
    #[pymodule_export]
    use crate::system::{learn, systems};
}
