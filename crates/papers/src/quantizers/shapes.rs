//! Rings and squares: error by inputs for each quantizer.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_quantizers::Quantizer;

use super::any::{ROWS, quantizer};
use super::streams::{Point, rings_and_squares};
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};

/// Name of the table.
pub(super) const NAME: &str = "rings and squares";

/// Numbers of inputs after which the error is measured; the last is the length of a run.
pub(super) const MARKS: [u32; 6] = [100, 300, 1000, 3000, 10_000, 30_000];

/// Number of points on which the error is measured. They are not learned.
const PROBES: usize = 2000;

/// Number of units that GNG grows to.
const UNITS: usize = 100;

/// Threshold in squared units of the data, which gives about 100 units in equilibrium.
const THRESHOLD: f64 = 0.05;

record! {
    /// A quantizer that learned the points.
    pub(super) struct ShapesRun {
        /// Root of the mean squared distance of a point from the nearest unit after 100 inputs.
        rms_100: f64 => lower("RMS error after 100").at_least(0),
        /// RMS error after 300 inputs.
        rms_300: f64 => lower("RMS error after 300").at_least(0),
        /// RMS error after 1000 inputs.
        rms_1000: f64 => lower("RMS error after 1000").at_least(0),
        /// RMS error after 3000 inputs.
        rms_3000: f64 => lower("RMS error after 3000").at_least(0),
        /// RMS error after 10,000 inputs.
        rms_10000: f64 => lower("RMS error after 10,000").at_least(0),
        /// Root of the mean squared distance of a point from the nearest unit, at the end.
        rms_30000: f64 => lower("RMS error after 30,000").at_least(0).decimals(4),
        /// Number of units of the network.
        units: usize => neither("units").decimals(0),
        /// Clusters of the network.
        clusters: usize => neither("clusters").decimals(1),
    }
}

impl ShapesRun {
    /// Returns the errors at [`MARKS`].
    pub(super) const fn errors(&self) -> [f64; MARKS.len()] {
        [
            self.rms_100,
            self.rms_300,
            self.rms_1000,
            self.rms_3000,
            self.rms_10000,
            self.rms_30000,
        ]
    }
}

pub(super) fn table() -> Table {
    Table::of::<ShapesRun>(NAME, "Two rings and two squares")
        .metrics_from(ShapesRun::rms_30000)
        .rows(ROWS.map(Row::new))
        .note(format!(
        "{} points, drawn at random; the error is that of {PROBES} others. GNG and GNG-U have at most {UNITS} units.",
        MARKS[MARKS.len() - 1]
    ))
}

/// A network, its training inputs, and its errors at [`MARKS`].
pub(super) struct Learned {
    pub(super) quantizer: Box<dyn Quantizer<f64>>,
    pub(super) data: Vec<Point>,
    errors: [f64; MARKS.len()],
}

pub(super) fn learn(job: &Job<'_>) -> Result<Learned, BoxError> {
    let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
    let probes: Vec<Point> = (0..PROBES).map(|_| rings_and_squares(&mut rng)).collect();
    let mut quantizer = quantizer(job.row, 2, UNITS, THRESHOLD)?;
    let (mut data, mut errors) = (Vec::new(), [0.0; MARKS.len()]);
    for (mark, rms) in MARKS.into_iter().zip(&mut errors) {
        while data.len() < mark as usize {
            let point = rings_and_squares(&mut rng);
            quantizer.observe(&point)?;
            data.push(point);
        }
        let error = quantizer.network().quantization_error(&probes)?;
        *rms = libm::sqrt(error.mean_squared);
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
    let [rms_100, rms_300, rms_1000, rms_3000, rms_10000, rms_30000] = learned.errors;
    let run = ShapesRun {
        rms_100,
        rms_300,
        rms_1000,
        rms_3000,
        rms_10000,
        rms_30000,
        units: network.len(),
        clusters: network.clusters().count(),
    };
    Ok(run.fields()?)
}
