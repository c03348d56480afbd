//! Table 1 of MSLST: how many states the equilibrium GNG makes of a maze.

use tolman_quantizers::{Gng, GngConfig, Quantizer};

use crate::tolerances::PROTOTYPES;
use crate::venue::{self, StatesRow, TABLE_1, states_row};
use tolman_arena::course::Course;
use tolman_arena::mslst;
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record};

/// The table's name in `summary.json`.
pub(super) const NAME: &str = "1";

/// Phase I: "approximately 4000 time steps".
pub(super) const STEPS: u32 = 4000;

record! {
    /// An equilibrium GNG that learned the scans of phase I.
    struct NetworkRun {
        /// Units of the network, each a state.
        states: usize => neither("states").decimals(1).tolerance(PROTOTYPES),
        /// Root of the mean squared distance of a scan from the nearest state.
        rms_error: f64 => lower("RMS error").unit("robot units").at_least(0),
    }
}

pub(super) fn table() -> Table {
    let row = |row: StatesRow| Row::new(row.row).paper("states_median", row.states);
    Table::of::<NetworkRun>(NAME, "States of MSLST's equilibrium GNG")
        .metric(Metric::median("states_median", NetworkRun::states).titled("states (median)"))
        .metric(Metric::mean(NetworkRun::rms_error))
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

    /// The scans of phase I in the Large maze.
    pub(super) fn large_scans(&self, seed: u64) -> Result<Vec<Vec<f64>>, BoxError> {
        scans(&self.large, seed)
    }

    /// The network of a run of the table, and the scans it learned.
    pub(super) fn learn(&self, job: &Job<'_>) -> Result<(Gng<f64>, Vec<Vec<f64>>), BoxError> {
        let row = states_row(job.row)?;
        let mut courses = self.all().into_iter();
        let course = courses.find(|course| course.name == row.maze);
        let course = course.ok_or_else(|| format!("there is no maze {}", row.maze))?;
        let scans = scans(course, job.seed)?;
        let beams = pioneer::ring().beams as usize;
        let mut gng = Gng::new(beams, GngConfig::mslst(row.threshold))?;
        for scan in &scans {
            gng.observe(scan)?;
        }
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

/// The scans of phase I.
fn scans(course: &Course, seed: u64) -> Result<Vec<Vec<f64>>, BoxError> {
    Ok(mslst::scans(course, &pioneer::calibrated(), STEPS, seed)?)
}
