//! Table 1 of MSLST: the number of states that the equilibrium GNG learns of a maze.

use tolman_quantizers::{Gng, GngConfig, Quantizer};

use crate::rows::row_of;
use crate::tolerances::PROTOTYPES;
use crate::venue::{self, StatesRow, TABLE_1};
use tolman_arena::course::Course;
use tolman_arena::mslst;
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record};

/// Name of the table in `summary.json`.
pub(super) const NAME: &str = "1";

/// Number of time steps of phase I: "approximately 4000 time steps".
pub(super) const STEPS: u32 = 4000;

record! {
    /// An equilibrium GNG that learned the scans of phase I.
    struct NetworkRun {
        /// Number of units of the network, each a state.
        states: usize => neither("states").decimals(1).tolerance(PROTOTYPES),
        /// Root of the mean squared distance of a scan from the nearest state.
        rms_error: f64 => lower("RMS error").unit("robot units").at_least(0),
    }
}

pub(super) fn table() -> Table {
    let row = |row: StatesRow| Row::new(row.row).paper("states_median", row.states);
    Table::of::<NetworkRun>(NAME, "States of MSLST's equilibrium GNG")
        .metric(Metric::median("states_median", NetworkRun::states).titled("states (median)"))
        .metrics_from(NetworkRun::rms_error)
        .paper_runs(1)
        .rows(TABLE_1.map(row))
        .note(format!(
            "The scans of {STEPS} time steps of the Avoid brain, one maze and one network a run. The decay d = {} was chosen on \
             Large 50 alone; J 100 and Large 20 are predictions.",
            GngConfig::mslst(50.0).decay
        ))
}

/// The courses of the table.
#[derive(Debug)]
pub(super) struct Mazes {
    j: Course,
    large: Course,
}

impl Mazes {
    pub(super) fn new() -> Result<Self, BoxError> {
        Ok(Self {
            j: venue::j_maze()?,
            large: venue::large_maze()?,
        })
    }

    pub(super) fn all(&self) -> [&Course; 2] {
        [&self.j, &self.large]
    }

    /// Returns the scans of phase I in the Large maze.
    pub(super) fn large_scans(&self, seed: u64) -> Result<Vec<Vec<f64>>, BoxError> {
        scans(&self.large, seed)
    }

    /// Returns the network of a run of the table, and the scans it learned.
    pub(super) fn learn(&self, job: &Job<'_>) -> Result<(Gng<f64>, Vec<Vec<f64>>), BoxError> {
        let row = row_of(job, TABLE_1, |row| row.row == job.row)?;
        let course = row_of(job, self.all(), |course| course.name == row.maze)?;
        let scans = scans(course, job.seed)?;
        let gng = learned(&scans, GngConfig::mslst(row.threshold))?;
        Ok((gng, scans))
    }

    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (gng, scans) = self.learn(job)?;
        let error = gng.network().quantization_error(&scans)?;
        let run = NetworkRun {
            states: gng.network().len(),
            rms_error: libm::sqrt(error.mean_squared),
        };
        Ok(run.fields()?)
    }
}

/// Name of the table of decays.
pub(super) const DECAY: &str = "decay of errors";

/// Decays that are tried; Fritzke's is 0.995.
const DECAYS: [f64; 9] = [
    0.99, 0.993, 0.995, 0.996, 0.997, 0.9975, 0.998, 0.999, 0.9995,
];

record! {
    /// The networks of table 1 with another decay of errors, each from its own scans.
    struct DecayRun {
        /// Number of states of the Large maze at threshold 50, by which the decay is chosen.
        large_50: usize => neither("Large 50").decimals(1),
        /// Number of states of the J maze at threshold 100.
        j_100: usize => neither("J 100").decimals(1),
        /// Number of states of the Large maze at threshold 20.
        large_20: usize => neither("Large 20").decimals(1),
    }
}

/// Returns the table by which the decay is chosen: the one that gives the paper's 26 states in
/// Large 50, as the median of runs. The other mazes are predictions.
pub(super) fn decay_table() -> Table {
    let fields = [DecayRun::large_50, DecayRun::j_100, DecayRun::large_20];
    let table = Table::of::<DecayRun>(DECAY, "Table 1 by the decay of errors, medians")
        .rows(DECAYS.map(|decay| Row::new(format!("{decay}"))))
        .note("The paper has 26 states in Large 50, 16 in J 100 and 43 in Large 20, and says nothing of the decay.");
    let median = |field: &str| Metric::median(field, field);
    fields.into_iter().map(median).fold(table, Table::metric)
}

impl Mazes {
    pub(super) fn run_decay(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let decay: f64 = job.row.parse()?;
        let large = scans(&self.large, job.seed)?;
        let j = scans(&self.j, job.seed)?;
        let run = DecayRun {
            large_50: states(&large, 50.0, decay)?,
            j_100: states(&j, 100.0, decay)?,
            large_20: states(&large, 20.0, decay)?,
        };
        Ok(run.fields()?)
    }
}

/// Returns the number of states that are learned from scans.
fn states(scans: &[Vec<f64>], threshold: f64, decay: f64) -> Result<usize, BoxError> {
    let mut config = GngConfig::mslst(threshold);
    config.decay = decay;
    Ok(learned(scans, config)?.network().len())
}

/// Returns the network that is learned from scans.
fn learned(scans: &[Vec<f64>], config: GngConfig) -> Result<Gng<f64>, BoxError> {
    let mut gng = Gng::new(pioneer::ring().beams as usize, config)?;
    for scan in scans {
        gng.observe(scan)?;
    }
    Ok(gng)
}

/// Returns the scans of phase I.
fn scans(course: &Course, seed: u64) -> Result<Vec<Vec<f64>>, BoxError> {
    Ok(mslst::scans(course, &pioneer::calibrated(), STEPS, seed)?)
}
