use pyo3::prelude::*;
use tolman_maps::bump_map::{BumpMap, BumpMove, BumpWay};

use crate::errors::{refused, wrong};
use crate::maze::direction;

/// A map of places from actions and bumps alone, without odometry, of a robot that moves by cells.
///
/// Parameters
/// ----------
/// look : int
///     What the place looks like where the robot is, from 0 to 2³² − 1.
#[pyclass(name = "BumpMap", module = "tolman")]
pub(crate) struct PyBumpMap(BumpMap);

#[pymethods]
impl PyBumpMap {
    /// Returns the map of a robot that has not moved yet, at a place with this look.
    #[new]
    #[pyo3(signature = (look = 0))]
    fn new(look: u32) -> Self {
        Self(BumpMap::new(look))
    }

    /// Takes in a move.
    ///
    /// Parameters
    /// ----------
    /// action : {"north", "east", "south", "west"}
    ///     Where the robot tried to go.
    /// moved : bool
    ///     Whether it went there, or bumped and stayed.
    /// look : int
    ///     What the place looks like where it is now, from 0 to 2³² − 1.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such direction, or no map explains what was met.
    #[pyo3(signature = (action, moved, look = 0))]
    fn learn(&mut self, py: Python<'_>, action: &str, moved: bool, look: u32) -> PyResult<()> {
        let action = direction("action", action)?;
        let step = BumpMove {
            action,
            moved,
            look,
        };
        py.detach(|| self.0.learn(step))
            .map_err(|error| refused("moved", &error))
    }

    /// Returns where to go to learn more: "north", "east", "south" or "west".
    fn advice(&self) -> String {
        self.0.advice().to_string()
    }

    /// Returns the place where the robot is.
    #[getter]
    fn here(&self) -> u32 {
        self.0.here()
    }

    /// Returns the place where it began.
    #[getter]
    fn start(&self) -> u32 {
        self.0.start()
    }

    /// Returns all places.
    #[getter]
    fn places(&self) -> Vec<u32> {
        self.0.places().collect()
    }

    /// Returns the number of ways that nobody tried.
    #[getter]
    fn untried(&self) -> usize {
        self.0.untried()
    }

    /// Returns how many moves in a row, up to the last, the map predicted.
    #[getter]
    const fn predicted(&self) -> usize {
        self.0.predicted()
    }

    /// Returns whether the map is complete and probably right: it has predicted the last moves,
    /// eight for each place.
    #[getter]
    fn is_tested(&self) -> bool {
        self.0.is_tested()
    }

    /// Returns what is known of a way: "untried", "closed" or "open".
    ///
    /// Parameters
    /// ----------
    /// place : int
    ///     One of `places`.
    /// action : {"north", "east", "south", "west"}
    ///     Where the way leads.
    ///
    /// Returns
    /// -------
    /// str
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such place or direction.
    fn way(&self, place: u32, action: &str) -> PyResult<&'static str> {
        Ok(match self.known(place, action)? {
            BumpWay::Untried => "untried",
            BumpWay::Closed => "closed",
            BumpWay::To(_) => "open",
        })
    }

    /// Returns the place to which an open way leads, otherwise `None`.
    ///
    /// Parameters
    /// ----------
    /// place : int
    ///     One of `places`.
    /// action : {"north", "east", "south", "west"}
    ///     Where the way leads.
    ///
    /// Returns
    /// -------
    /// int or None
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If there is no such place or direction.
    fn beyond(&self, place: u32, action: &str) -> PyResult<Option<u32>> {
        Ok(match self.known(place, action)? {
            BumpWay::To(next) => Some(next),
            BumpWay::Untried | BumpWay::Closed => None,
        })
    }

    fn __repr__(&self) -> String {
        let (places, untried) = (self.0.place_count(), self.0.untried());
        format!("<tolman.BumpMap: {places} places, {untried} ways untried>")
    }
}

impl PyBumpMap {
    /// Returns what is known of a way.
    ///
    /// # Errors
    /// A `ValueError` that names the parameter, if there is no such place or direction.
    fn known(&self, place: u32, action: &str) -> PyResult<BumpWay> {
        let action = direction("action", action)?;
        match self.0.places().any(|known| known == place) {
            true => Ok(self.0.way(place, action)),
            false => Err(wrong(format!(
                "place is {place}, which is not among places"
            ))),
        }
    }
}
