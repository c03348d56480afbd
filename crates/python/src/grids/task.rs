//! What a robot of a grid is there for.

use crate::errors::wrong;
use pyo3::PyResult;

/// Task of a robot that moves from cell to cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GridTask {
    /// It drives to one landmark after another.
    Errand,
    /// It looks until it has seen all places and links.
    Learn,
    /// It finds out where it was put down, and tells.
    Locate,
}

impl GridTask {
    const ALL: [(Self, &'static str); 3] = [
        (Self::Errand, "errand"),
        (Self::Learn, "learn"),
        (Self::Locate, "locate"),
    ];

    pub(super) fn of_name(name: &str) -> PyResult<Self> {
        let found = Self::ALL.into_iter().find(|(_, known)| *known == name);
        found.map(|(task, _)| task).ok_or_else(|| {
            let names = Self::ALL.map(|(_, name)| name);
            wrong(format!(
                "task is '{name}' but has to be one of {}",
                names.join(", ")
            ))
        })
    }

    pub(super) fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}
