//! The associative memory, as `python/tolman_quantizers` uses it.

use numpy::ndarray::{Array2, ArrayView2};
use numpy::{PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tolman_quantizers::{AssociativeMemory, InputError, Quantizer, Recall};

use crate::errors::{refused, wrong};
use crate::learner::config::{named, soinn_config};
use crate::params::Params;
use crate::rows::{in_pieces, in_row, row_of, rows};
use crate::shared::Shared;

/// An associative memory of rows of 64-bit numbers. Other threads may read it while one learns.
#[pyclass(name = "Memory", module = "tolman_quantizers._quantizers", frozen)]
pub(crate) struct PyMemory {
    memory: Shared<AssociativeMemory<f64>>,
    /// Numbers of features of a key and of a response.
    features: [usize; 2],
}

type Answer<'py> = PyResult<Bound<'py, PyArray2<f64>>>;

#[pymethods]
impl PyMemory {
    /// Returns an empty memory for keys and responses of these numbers of features.
    #[new]
    fn new(key: usize, response: usize, params: &Bound<'_, PyDict>) -> PyResult<Self> {
        let config = soinn_config(&Params(params))?;
        let memory = AssociativeMemory::new(key, response, config).map_err(named)?;
        Ok(Self {
            memory: Shared::new(memory),
            features: [key, response],
        })
    }

    /// Learns row by row that a response belongs to a key.
    fn associate(
        &self,
        py: Python<'_>,
        keys: &Bound<'_, PyAny>,
        responses: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let (keys, responses) = (rows::<f64>(keys)?, rows::<f64>(responses)?);
        let counts = [&keys, &responses].map(|array| array.shape()[0]);
        if counts[0] != counts[1] {
            return Err(wrong(format!(
                "keys has {} rows and responses has {}, but each response belongs to a key",
                counts[0], counts[1]
            )));
        }
        let (keys, responses) = (keys.as_array(), responses.as_array());
        let work = |row: usize| {
            let mut memory = self.memory.write();
            let learned = memory.associate(&row_of(&keys, row), &row_of(&responses, row));
            learned.map_err(|error| in_row(row, &error))?;
            Ok(row + 1)
        };
        in_pieces(py, counts[0], work, |_| Ok(()))
    }

    /// Returns for each row the other part of the nearest association: the response to a key, or,
    /// if `back`, the key of a response.
    fn recall<'py>(&self, py: Python<'py>, asked: &Bound<'py, PyAny>, back: bool) -> Answer<'py> {
        let asked = rows::<f64>(asked)?;
        let asked = asked.as_array();
        let found = py.detach(|| {
            let memory = self.memory.read();
            let recall = |row: usize| {
                let asked = row_of(&asked, row);
                let recall = match back {
                    false => memory.response(&asked),
                    true => memory.key(&asked),
                };
                recall.map_err(|error| in_row(row, &error))
            };
            (0..asked.nrows()).map(recall).collect::<PyResult<Vec<_>>>()
        })?;
        self.table(py, found, !back)
    }

    /// Returns the other parts of all associations whose part is not farther than `reach` from the
    /// one row asked, the nearest first.
    fn recall_all<'py>(
        &self,
        py: Python<'py>,
        asked: &Bound<'py, PyAny>,
        reach: f64,
        back: bool,
    ) -> Answer<'py> {
        let asked = rows::<f64>(asked)?;
        let asked = one(&asked.as_array())?;
        let memory = self.memory.read();
        let found = match back {
            false => memory.responses(&asked, reach),
            true => memory.keys(&asked, reach),
        };
        self.table(py, found.map_err(|error| unanswered(&error))?, !back)
    }

    /// Returns the response to the one row asked, the response to that, and so on, at most `most`
    /// of them, until no key lies within `reach`.
    fn chain<'py>(
        &self,
        py: Python<'py>,
        asked: &Bound<'py, PyAny>,
        reach: f64,
        most: usize,
    ) -> Answer<'py> {
        let asked = rows::<f64>(asked)?;
        let asked = one(&asked.as_array())?;
        let memory = self.memory.read();
        let chain = memory.chain(&asked, reach);
        let chain = chain.map_err(|error| unanswered(&error))?;
        self.table(py, chain.take(most).collect(), true)
    }

    fn __len__(&self) -> usize {
        self.memory.read().soinn().network().len()
    }
}

impl PyMemory {
    /// Returns what was recalled, a row each: responses or keys.
    fn table<'py>(
        &self,
        py: Python<'py>,
        found: Vec<Recall<f64>>,
        are_responses: bool,
    ) -> Answer<'py> {
        let shape = (found.len(), self.features[usize::from(are_responses)]);
        let values = found.into_iter().flat_map(|recall| recall.values);
        let table = Array2::from_shape_vec(shape, values.collect());
        let table = table.map_err(|error| wrong(error.to_string()))?;
        Ok(PyArray2::from_owned_array(py, table))
    }
}

/// Returns the only row of an array.
fn one(asked: &ArrayView2<'_, f64>) -> PyResult<Vec<f64>> {
    match asked.nrows() {
        1 => Ok(asked.iter().copied().collect()),
        found => Err(wrong(format!(
            "one row is asked for at a time, not {found}"
        ))),
    }
}

fn unanswered(error: &InputError) -> PyErr {
    refused("the memory cannot answer", error)
}
