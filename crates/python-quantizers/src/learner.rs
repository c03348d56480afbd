//! Any quantizer, for 32-bit or 64-bit numbers, as the estimators of `python/tolman_quantizers` use
//! it.

pub(crate) mod config;
mod graph;
mod nearest;

use numpy::ndarray::ArrayView2;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use tolman_quantizers::{Gng, InputError, Quantizer, ReplayQuantizer, Scalar, Soinn};

use self::config::{gng_config, named, replay_config, soinn_config};
use self::graph::Graph;
use crate::errors::{refused, wrong};
use crate::params::Params;
use crate::rows::{checked, few, flat, in_pieces, least_spread, row_of, rows};
use crate::shared::Shared;

/// A quantizer that can be saved, and learns many inputs at once.
trait Learner<S: Scalar>: Quantizer<S> + Send + Sync {
    /// Learns from inputs that lie in turn, up to `batch` at once. They are valid.
    fn learn(&mut self, inputs: &[S], batch: usize) -> Result<(), InputError>;

    /// Returns the whole state of the quantizer.
    fn saved(&self) -> postcard::Result<Vec<u8>>;
}

impl<S: Scalar + serde::Serialize> Learner<S> for Gng<S> {
    fn learn(&mut self, inputs: &[S], batch: usize) -> Result<(), InputError> {
        match batch {
            0 | 1 => each(self, inputs),
            _ => self.observe_batch(inputs, batch),
        }
    }

    fn saved(&self) -> postcard::Result<Vec<u8>> {
        postcard::to_allocvec(self)
    }
}

impl<S: Scalar + serde::Serialize> Learner<S> for Soinn<S> {
    fn learn(&mut self, inputs: &[S], _: usize) -> Result<(), InputError> {
        each(self, inputs)
    }

    fn saved(&self) -> postcard::Result<Vec<u8>> {
        postcard::to_allocvec(self)
    }
}

/// A growing neural gas with a memory of past inputs.
type Replay<S> = ReplayQuantizer<S, Gng<S>>;

impl<S: Scalar + serde::Serialize> Learner<S> for Replay<S> {
    fn learn(&mut self, inputs: &[S], _: usize) -> Result<(), InputError> {
        each(self, inputs)
    }

    fn saved(&self) -> postcard::Result<Vec<u8>> {
        postcard::to_allocvec(self)
    }
}

fn each<S: Scalar>(quantizer: &mut impl Quantizer<S>, inputs: &[S]) -> Result<(), InputError> {
    let dimension = quantizer.network().dimension();
    for input in inputs.chunks_exact(dimension) {
        quantizer.observe(input)?;
    }
    Ok(())
}

/// Returns the number of rows to learn between two looks at signals and readers: whole batches, as
/// many as pay for turning all units twice.
fn step(features: usize, units: usize, batch: usize) -> usize {
    match batch {
        0 | 1 => few(features),
        // At least as if there were some hundred units: the rows may have to be copied.
        _ => (EFFORT / (features * units.max(500)) / batch).max(1) * batch,
    }
}

/// Number of features compared with units by products in some hundredths of a second.
const EFFORT: usize = 500_000_000;

type Any<S> = Shared<Box<dyn Learner<S>>>;

/// A quantizer of either type of numbers.
enum AnyLearner {
    Single(Any<f32>),
    Double(Any<f64>),
}

impl AnyLearner {
    fn single(learner: impl Learner<f32> + 'static) -> Self {
        Self::Single(Shared::new(Box::new(learner)))
    }

    fn double(learner: impl Learner<f64> + 'static) -> Self {
        Self::Double(Shared::new(Box::new(learner)))
    }
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

/// A quantizer that learns from rows of arrays. Other threads may read it while one learns: they
/// wait for a few rows, with Python's lock released.
#[pyclass(name = "Learner", module = "tolman_quantizers._quantizers", frozen)]
pub(crate) struct PyLearner {
    any: AnyLearner,
    /// What [`Self::resumed`] has to be told.
    kind: &'static str,
}

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
        let params = Params(params);
        match kind {
            "gng" => Self::gng(dimension, single, &params),
            "soinn" => {
                let config = soinn_config(&params)?;
                let any = match single {
                    true => AnyLearner::single(Soinn::new(dimension, config).map_err(named)?),
                    false => AnyLearner::double(Soinn::new(dimension, config).map_err(named)?),
                };
                Ok(Self { any, kind: "soinn" })
            }
            _ => Err(unknown(kind)),
        }
    }

    /// Returns the quantizer that [`Self::saved`] described.
    #[staticmethod]
    fn resumed(kind: &str, single: bool, saved: &[u8]) -> PyResult<Self> {
        let (kind, any) = match (kind, single) {
            ("gng", true) => ("gng", AnyLearner::single(read::<Gng<f32>>(saved)?)),
            ("gng", false) => ("gng", AnyLearner::double(read::<Gng<f64>>(saved)?)),
            ("replay", true) => ("replay", AnyLearner::single(read::<Replay<f32>>(saved)?)),
            ("replay", false) => ("replay", AnyLearner::double(read::<Replay<f64>>(saved)?)),
            ("soinn", true) => ("soinn", AnyLearner::single(read::<Soinn<f32>>(saved)?)),
            ("soinn", false) => ("soinn", AnyLearner::double(read::<Soinn<f64>>(saved)?)),
            _ => return Err(unknown(kind)),
        };
        Ok(Self { any, kind })
    }

    /// Returns the whole state of the quantizer.
    fn saved<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let saved = py.detach(|| either!(&self.any, learner => learner.read().saved()));
        let saved = saved.map_err(|error| refused("the quantizer cannot be saved", &error))?;
        Ok(PyBytes::new(py, &saved))
    }

    /// Checks that all rows can be learned.
    fn check(&self, py: Python<'_>, x: &Bound<'_, PyAny>) -> PyResult<()> {
        either!(&self.any, learner => {
            let x = rows(x)?;
            check(py, learner, &x.as_array())
        })
    }

    /// Learns from rows that were checked, in the order given, up to `batch` at once. Now and then
    /// it calls `after` with the number of rows learned.
    fn observe(
        &self,
        py: Python<'_>,
        x: &Bound<'_, PyAny>,
        order: Option<&Bound<'_, PyArray1<i64>>>,
        batch: usize,
        after: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let order = order.map(PyArrayMethods::readonly);
        let order = order.as_ref().map(|order| order.as_slice()).transpose();
        let order = order.map_err(|error| refused("order", &error))?;
        let after = |done: usize| match after {
            Some(after) => after.call1((done,)).map(drop),
            None => Ok(()),
        };
        either!(&self.any, learner => {
            let x = rows(x)?;
            let x = x.as_array();
            let count = x.nrows();
            if order.is_some_and(|order| order.iter().any(|row| *row < 0 || *row as usize >= count)) {
                return Err(wrong(format!("order: it names a row beyond the {count} of X")));
            }
            let mut piece = Vec::new();
            let work = |from: usize| {
                let units = learner.read().network().len();
                let until = count.min(from + step(x.ncols(), units, batch));
                let learned = match order {
                    None => learner.write().learn(&flat(&x, from..until), batch),
                    Some(order) => {
                        piece.clear();
                        for row in &order[from..until] {
                            piece.extend_from_slice(&row_of(&x, *row as usize));
                        }
                        learner.write().learn(&piece, batch)
                    }
                };
                learned.map_err(|error| refused("X", &error))?;
                Ok(until)
            };
            in_pieces(py, count, work, after)
        })
    }

    /// Returns, for each row, the number of the nearest unit in the order of the units, its squared
    /// distance and its cluster.
    #[expect(clippy::type_complexity, reason = "a tuple is what Python takes apart")]
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
    ) -> PyResult<(
        Bound<'py, PyArray1<i64>>,
        Bound<'py, PyArray1<f64>>,
        Bound<'py, PyArray1<i64>>,
    )> {
        let (numbers, squared, clusters) = either!(&self.any, learner => {
            let x = rows(x)?;
            let x = x.as_array();
            py.detach(|| {
                let learner = learner.read();
                let network = learner.network();
                let (numbers, squared) = nearest::nearest(network, &x)?;
                let clusters = network.clusters();
                let labels: Vec<i64> = clusters.iter().map(|(_, label)| i64::from(label)).collect();
                let of_rows = numbers.iter().map(|number| labels[*number as usize]);
                let of_rows: Vec<i64> = of_rows.collect();
                PyResult::Ok((numbers, squared, of_rows))
            })?
        });
        Ok((
            PyArray1::from_vec(py, numbers),
            PyArray1::from_vec(py, squared),
            PyArray1::from_vec(py, clusters),
        ))
    }

    /// Returns the units and edges at one moment: the prototypes, one row per unit, by ascending
    /// id; their ids, which are never used again; the two ends of each edge, as rows, and its age;
    /// the cluster of each unit.
    #[expect(clippy::type_complexity, reason = "a tuple is what Python takes apart")]
    fn graph<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(
        Bound<'py, PyAny>,
        Bound<'py, PyArray1<i64>>,
        Bound<'py, PyArray2<i64>>,
        Bound<'py, PyArray1<i64>>,
    )> {
        either!(&self.any, learner => {
            let graph = py.detach(|| Graph::of(learner.read().network()))?;
            Ok((
                PyArray2::from_owned_array(py, graph.units).into_any(),
                PyArray1::from_vec(py, graph.ids),
                PyArray2::from_owned_array(py, graph.edges),
                PyArray1::from_vec(py, graph.clusters),
            ))
        })
    }

    /// Returns what [`Self::resumed`] has to be told.
    #[getter]
    const fn kind(&self) -> &'static str {
        self.kind
    }

    /// Returns whether the numbers have 32 bits.
    #[getter]
    fn single(&self) -> bool {
        matches!(self.any, AnyLearner::Single(_))
    }

    fn __len__(&self, py: Python<'_>) -> usize {
        py.detach(|| either!(&self.any, learner => learner.read().network().len()))
    }
}

impl PyLearner {
    /// Returns an empty growing neural gas, with a memory of past inputs if the parameters ask for
    /// one.
    fn gng(dimension: usize, single: bool, params: &Params<'_, '_>) -> PyResult<Self> {
        let config = gng_config(params)?;
        let replay = replay_config(params)?;
        let any = match single {
            true => {
                let gng = Gng::new(dimension, config).map_err(named)?;
                match replay {
                    None => AnyLearner::single(gng),
                    Some(replay) => {
                        AnyLearner::single(Replay::<f32>::new(gng, replay).map_err(named)?)
                    }
                }
            }
            false => {
                let gng = Gng::new(dimension, config).map_err(named)?;
                match replay {
                    None => AnyLearner::double(gng),
                    Some(replay) => {
                        AnyLearner::double(Replay::<f64>::new(gng, replay).map_err(named)?)
                    }
                }
            }
        };
        let kind = if replay.is_some() { "replay" } else { "gng" };
        Ok(Self { any, kind })
    }
}

/// Checks all rows before any is learned, so that either all of them are learned or none.
///
/// # Errors
/// A `ValueError` that names the first invalid row, or tells that the rows lie so close together
/// that the squares of their distances vanish.
fn check<S: Scalar>(py: Python<'_>, learner: &Any<S>, x: &ArrayView2<'_, S>) -> PyResult<()> {
    let step = few(x.ncols());
    let (mut spread, mut begins) = (0.0_f64, false);
    let work = |from: usize| {
        let until = usize::min(from + step, x.nrows());
        let learner = learner.read();
        begins = learner.network().is_empty();
        for number in from..until {
            checked(learner.network(), &row_of(x, number), number)?;
            for (value, first) in x.row(number).iter().zip(x.row(0)) {
                spread = spread.max((value.to_f64() - first.to_f64()).abs());
            }
        }
        Ok(until)
    };
    in_pieces(py, x.nrows(), work, |_| Ok(()))?;
    let least = least_spread::<S>();
    if begins && spread > 0.0 && spread < least {
        return Err(wrong(format!(
            "X: its rows differ by at most {spread:e} in a feature, and below {least:e} the squares of distances vanish: scale X"
        )));
    }
    Ok(())
}

fn unknown(kind: &str) -> PyErr {
    wrong(format!("kind is '{kind}', which is not a quantizer"))
}

fn read<Q: serde::de::DeserializeOwned>(saved: &[u8]) -> PyResult<Q> {
    postcard::from_bytes(saved).map_err(|error| refused("saved", &error))
}
