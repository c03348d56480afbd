//! A robot's stream of scans is not shuffled: the effect of the order of inputs on GNG.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_quantizers::{Gng, GngConfig, Quantizer, ReplayConfig, ReplayQuantizer};

use super::states::Mazes;
use super::streams::shuffle;
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};

/// Name of the table.
pub(super) const NAME: &str = "order of inputs";

const SHUFFLED: &str = "shuffled";
const IN_TIME: &str = "in time";
const REPLAYED: &str = "in time, replayed";

/// Number of units that GNG grows to, and number of times that the scans are shown.
const UNITS: usize = 40;
const PASSES: u32 = 3;

record! {
    /// A quantizer that learned the scans in some order.
    struct OrderRun {
        /// Mean squared distance of a scan from the nearest unit.
        mean_squared_error: f64 => lower("MSE").unit("robot units²").at_least(0),
        /// Root of the mean squared distance of a scan from the nearest unit.
        rms_error: f64 => lower("RMS error").unit("robot units").at_least(0),
        /// Number of units of the network.
        units: usize => neither("units").decimals(0),
    }
}

pub(super) fn table() -> Table {
    let title = "GNG on the scans of the Large maze, in two orders and with a memory";
    Table::of::<OrderRun>(NAME, title)
        .metrics_from(OrderRun::mean_squared_error)
        .rows([SHUFFLED, IN_TIME, REPLAYED].map(Row::new))
        .note(format!(
            "The 4000 scans of a run of table 1, {PASSES} times over, to a GNG of at most {UNITS} \
             units. The error is over all those scans. Replayed: eight remembered scans are learned \
             for each new one."
        ))
}

pub(super) fn run(mazes: &Mazes, job: &Job<'_>) -> Result<Fields, BoxError> {
    let scans = mazes.large_scans(job.seed)?;
    let mut order: Vec<usize> = (0..scans.len()).collect();
    if job.row == SHUFFLED {
        let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
        rng.set_stream(4);
        shuffle(&mut order, &mut rng);
    }
    let features = pioneer::ring().beams as usize;
    let stream = || {
        let once = order.iter().map(|scan| &scans[*scan]);
        (0..PASSES).flat_map(move |_| once.clone())
    };
    let fields = if job.row == REPLAYED {
        let gng = Gng::<f64>::new(features, GngConfig::in_order(UNITS))?;
        learn(
            ReplayQuantizer::new(gng, ReplayConfig::measured(job.seed))?,
            stream(),
            &scans,
        )?
    } else {
        let mut config = GngConfig::fritzke();
        config.max_units = UNITS;
        learn(Gng::<f64>::new(features, config)?, stream(), &scans)?
    };
    Ok(fields)
}

/// Returns the record of a quantizer that learned a stream, measured on all scans.
fn learn<'a>(
    mut quantizer: impl Quantizer<f64>,
    stream: impl Iterator<Item = &'a Vec<f64>>,
    scans: &[Vec<f64>],
) -> Result<Fields, BoxError> {
    for scan in stream {
        quantizer.observe(scan)?;
    }
    let error = quantizer.network().quantization_error(scans)?;
    let run = OrderRun {
        mean_squared_error: error.mean_squared,
        rms_error: libm::sqrt(error.mean_squared),
        units: quantizer.network().len(),
    };
    Ok(run.fields()?)
}
