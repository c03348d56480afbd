//! Any quantizer, for 32-bit or 64-bit numbers, as the estimators of `python/tolman` use it.

mod config;
mod graph;

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tolman_quantizers::{Gng, Quantizer, Scalar, Soinn};

use self::config::{gng_config, named, soinn_config};
use crate::errors::{refused, wrong};
use crate::params::Params;
use crate::rows::{check, each, rows};

/// A quantizer that can be saved.
trait Learner<S: Scalar>: Quantizer<S> + Send + Sync {
    /// Returns the whole state of the quantizer as JSON.
    fn saved(&self) -> serde_json::Result<String>;
}

impl<S: Scalar, Q> Learner<S> for Q
where
    Q: Quantizer<S> + serde::Serialize + Send + Sync,
{
    fn saved(&self) -> serde_json::Result<String> {
        serde_json::to_string(self)
    }
}

/// A quantizer of either type of numbers.
enum AnyLearner {
    Single(Box<dyn Learner<f32>>),
    Double(Box<dyn Learner<f64>>),
}

/// Evaluates the same expression for either type of numbers.
macro_rules! either {
    ($any:expr, $learner:ident => $body:expr) => {
        match $any {
            AnyLearner::Single($learner) => $body,
            AnyLearner::Double($learner) => $body,
        }
    };
}

/// A quantizer that learns from rows of arrays.
#[pyclass(name = "Learner", module = "tolman._tolman")]
pub(crate) struct PyLearner {
    kind: Kind,
    any: AnyLearner,
}

/// The kinds of quantizers.
#[derive(Clone, Copy)]
enum Kind {
    Gng,
    Soinn,
}

const KINDS: [(&str, Kind); 2] = [("gng", Kind::Gng), ("soinn", Kind::Soinn)];

#[pymethods]
impl PyLearner {
    /// Returns an empty quantizer for inputs of `dimension` features; `single` chooses 32-bit
    /// numbers.
    #[new]
    fn new(
        kind: &str,
        dimension: usize,
        single: bool,
        params: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let kind = kind_of(kind)?;
        let params = Params(params);
        let any = match kind {
            Kind::Gng => {
                let config = gng_config(&params)?;
                match single {
                    true => {
                        AnyLearner::Single(Box::new(Gng::new(dimension, config).map_err(named)?))
                    }
                    false => {
                        AnyLearner::Double(Box::new(Gng::new(dimension, config).map_err(named)?))
                    }
                }
            }
            Kind::Soinn => {
                let config = soinn_config(&params)?;
                match single {
                    true => {
                        AnyLearner::Single(Box::new(Soinn::new(dimension, config).map_err(named)?))
                    }
                    false => {
                        AnyLearner::Double(Box::new(Soinn::new(dimension, config).map_err(named)?))
                    }
                }
            }
        };
        Ok(Self { kind, any })
    }

    /// Returns the quantizer that [`Self::saved`] described.
    #[staticmethod]
    fn resumed(kind: &str, single: bool, saved: &str) -> PyResult<Self> {
        let kind = kind_of(kind)?;
        let any = match (kind, single) {
            (Kind::Gng, true) => AnyLearner::Single(Box::new(read::<Gng<f32>>(saved)?)),
            (Kind::Gng, false) => AnyLearner::Double(Box::new(read::<Gng<f64>>(saved)?)),
            (Kind::Soinn, true) => AnyLearner::Single(Box::new(read::<Soinn<f32>>(saved)?)),
            (Kind::Soinn, false) => AnyLearner::Double(Box::new(read::<Soinn<f64>>(saved)?)),
        };
        Ok(Self { kind, any })
    }

    /// Returns the whole state of the quantizer as JSON.
    fn saved(&self) -> PyResult<String> {
        let saved = either!(&self.any, learner => learner.saved());
        saved.map_err(|error| refused("the quantizer cannot be saved", &error))
    }

    /// Learns from each row in order. If one row is invalid, none is learned.
    fn observe(&mut self, py: Python<'_>, x: &Bound<'_, PyAny>) -> PyResult<()> {
        either!(&mut self.any, learner => {
            let x = rows(x)?;
            let x = x.as_array();
            py.detach(|| {
                check(learner.network(), &x)?;
                each(&x, |input| learner.observe(input).map(drop))
            })
        })
    }

    /// Returns, for each row, the number of the nearest unit in the order of [`Self::units`], and
    /// its squared distance.
    #[expect(clippy::type_complexity, reason = "a tuple is what Python takes apart")]
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>)> {
        let (numbers, squared) = either!(&self.any, learner => {
            let x = rows(x)?;
            let x = x.as_array();
            py.detach(|| graph::nearest(learner.network(), &x))?
        });
        Ok((
            PyArray1::from_vec(py, numbers),
            PyArray1::from_vec(py, squared),
        ))
    }

    /// Returns the prototypes, one row per unit.
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(match &self.any {
            AnyLearner::Single(learner) => {
                PyArray2::from_owned_array(py, graph::prototypes(learner.network())?).into_any()
            }
            AnyLearner::Double(learner) => {
                PyArray2::from_owned_array(py, graph::prototypes(learner.network())?).into_any()
            }
        })
    }

    /// Returns the id of each unit. An id is never used again.
    fn ids<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let ids = either!(&self.any, learner => graph::ids(learner.network()));
        PyArray1::from_vec(py, ids)
    }

    /// Returns the two ends of each edge and its age, one row per edge.
    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let edges = either!(&self.any, learner => graph::edges(learner.network()))?;
        Ok(PyArray2::from_owned_array(py, edges))
    }

    /// Returns, for each unit, the number of its cluster.
    fn clusters<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let labels = either!(&self.any, learner => graph::clusters(learner.network()));
        PyArray1::from_vec(py, labels)
    }

    /// Returns the number of features of an input.
    #[getter]
    fn dimension(&self) -> usize {
        either!(&self.any, learner => learner.network().dimension())
    }

    /// Returns whether the numbers have 32 bits.
    #[getter]
    fn single(&self) -> bool {
        matches!(self.any, AnyLearner::Single(_))
    }

    /// Returns the name of its kind.
    #[getter]
    fn kind(&self) -> &'static str {
        match self.kind {
            Kind::Gng => "gng",
            Kind::Soinn => "soinn",
        }
    }

    fn __len__(&self) -> usize {
        either!(&self.any, learner => learner.network().len())
    }
}

fn kind_of(name: &str) -> PyResult<Kind> {
    let found = KINDS.iter().find(|(known, _)| *known == name);
    let kind = found.map(|(_, kind)| *kind);
    kind.ok_or_else(|| wrong(format!("kind is '{name}', which is not a quantizer")))
}

fn read<'a, Q: serde::Deserialize<'a>>(saved: &'a str) -> PyResult<Q> {
    serde_json::from_str(saved).map_err(|error| refused("saved", &error))
}
