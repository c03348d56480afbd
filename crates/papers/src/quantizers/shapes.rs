//! Rings and squares: the quantizers side by side, error against inputs.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_quantizers::Quantizer;

use super::any::{ROWS, quantizer};
use super::streams::{Point, rings_and_squares};
use tolman_experiment::{BoxError, Fields, Job, Kind, Metric, Row, Table};

/// The table's name.
pub(super) const NAME: &str = "rings and squares";

/// Inputs after which the error is measured; the last is the length of a run.
pub(super) const MARKS: [u32; 6] = [100, 300, 1000, 3000, 10_000, 30_000];

/// Points that the error is measured on, which are not learnt.
const PROBES: usize = 2000;

/// GNG grows to so many units.
const UNITS: usize = 100;

/// In squared units of the data: about 100 units in equilibrium.
const THRESHOLD: f64 = 0.05;

/// The name of the field for the error after so many inputs.
pub(super) fn field(inputs: u32) -> String {
    format!("rms_{inputs}")
}

pub(super) fn table() -> Table {
    let mut table = Table::new(NAME, "Two rings and two squares");
    for inputs in MARKS {
        table = table.field(field(inputs), Kind::Number);
    }
    table = table
        .field("units", Kind::Count)
        .field("clusters", Kind::Count)
        .metric(
            Metric::mean(field(MARKS[MARKS.len() - 1]))
                .titled("RMS error")
                .decimals(4),
        )
        .metric(Metric::mean("units").decimals(0))
        .metric(Metric::mean("clusters").decimals(1));
    for row in ROWS {
        table = table.row(Row::new(row));
    }
    table.note(format!(
        "{} points, drawn at random; the error is that of {PROBES} others. GNG and GNG-U have at most {UNITS} units.",
        MARKS[MARKS.len() - 1]
    ))
}

/// A network, what it learned, and its errors at [`MARKS`].
pub(super) struct Learned {
    pub(super) quantizer: Box<dyn Quantizer<f64>>,
    pub(super) data: Vec<Point>,
    errors: Vec<f64>,
}

pub(super) fn learn(job: &Job<'_>) -> Result<Learned, BoxError> {
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    let probes: Vec<Point> = (0..PROBES).map(|_| rings_and_squares(&mut rng)).collect();
    let mut quantizer = quantizer(job.row, 2, UNITS, THRESHOLD)?;
    let (mut data, mut errors) = (Vec::new(), Vec::new());
    for mark in MARKS {
        while data.len() < mark as usize {
            let point = rings_and_squares(&mut rng);
            quantizer.observe(&point)?;
            data.push(point);
        }
        let error = quantizer.network().quantization_error(&probes)?;
        errors.push(libm::sqrt(error.mean_squared));
    }
    Ok(Learned {
        quantizer,
        data,
        errors,
    })
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let learned = learn(job)?;
    let network = learned.quantizer.network();
    let mut fields = Fields::new()
        .count("units", network.len() as u64)
        .count("clusters", network.clusters().count() as u64);
    for (mark, error) in MARKS.into_iter().zip(learned.errors) {
        fields = fields.number(field(mark), error);
    }
    Ok(fields)
}
