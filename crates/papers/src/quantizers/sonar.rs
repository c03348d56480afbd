//! Relates the units of a real ring of 24 sonars to the robot's action.

use std::path::Path;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use super::any::{ROWS, quantizer};
use super::streams::shuffle;
use crate::data;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_formats::SonarTable;

/// Name of the table.
pub(crate) const NAME: &str = "sonar ring";

/// Path of the log below the folder of external data.
const FILE: &str = "logs/scitos-sonar24/sensor_readings_24.data.gz";

const SONARS: usize = 24;
const UNITS: usize = 100;

/// Threshold of the equilibrium GNG, m².
const THRESHOLD: f64 = 10.0;

/// Number of times that the readings are shown, each time in another order.
const PASSES: u32 = 5;

/// The log: readings in metres, each with the wall-following robot's action, in order of time.
#[derive(Debug)]
pub(crate) struct Log {
    readings: Vec<([f64; SONARS], usize)>,
    /// Possible actions, in the order of the log.
    actions: Vec<String>,
}

impl Log {
    /// Returns the log; `None` if the file is missing.
    pub(crate) fn find() -> Result<Option<Self>, BoxError> {
        let path = data::folder().map(|folder| folder.join(FILE));
        match path {
            Some(path) if path.exists() => Self::read(&path).map(Some),
            _ => Ok(None),
        }
    }

    fn read(path: &Path) -> Result<Self, BoxError> {
        let table = SonarTable::read(path)?;
        let (mut readings, mut actions) = (Vec::new(), Vec::<String>::new());
        for (ranges, action) in table.scans.into_iter().zip(table.actions) {
            let ranges: [f64; SONARS] = ranges.try_into().map_err(|ranges: Vec<f64>| {
                let (path, found) = (path.display(), ranges.len());
                format!("{path}: {found} ranges a line; give the log of {SONARS} sonars")
            })?;
            let known = actions.iter().position(|known| *known == action);
            let action = known.unwrap_or_else(|| {
                actions.push(action);
                actions.len() - 1
            });
            readings.push((ranges, action));
        }
        Ok(Self { readings, actions })
    }

    pub(crate) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        // There are four laps: three to learn from, and one to test on.
        let (learnt, asked) = self.readings.split_at(self.readings.len() * 3 / 4);
        let mut rng = ChaCha8Rng::seed_from_u64(job.seed);
        let mut order: Vec<usize> = (0..learnt.len()).collect();
        let mut quantizer = quantizer(job.row, SONARS, UNITS, THRESHOLD)?;
        for _ in 0..PASSES {
            shuffle(&mut order, &mut rng);
            for reading in &order {
                quantizer.observe(&learnt[*reading].0)?;
            }
        }
        let network = quantizer.network();
        // Ids ascend, so the largest is the last.
        let ids = network.ids().last().map_or(0, |id| id.0 as usize + 1);
        let mut votes = vec![vec![0_u32; self.actions.len()]; ids];
        for (ranges, action) in learnt {
            votes[network.nearest(ranges)?.id.0 as usize][*action] += 1;
        }
        let mut right = 0_u32;
        for (ranges, action) in asked {
            let votes = &votes[network.nearest(ranges)?.id.0 as usize];
            let most = votes.iter().max();
            right += u32::from(votes.iter().position(|v| Some(v) == most) == Some(*action));
        }
        let error = network.quantization_error(asked.iter().map(|(ranges, _)| ranges))?;
        let run = SonarRun {
            units: network.len(),
            rms_error: libm::sqrt(error.mean_squared),
            right_percent: 100.0 * f64::from(right) / asked.len() as f64,
        };
        Ok(run.fields()?)
    }
}

record! {
    /// A quantizer that learned three laps and was asked about the fourth.
    struct SonarRun {
        /// Root of the mean squared distance of an asked scan from the nearest unit.
        rms_error: f64 => lower("RMS error").unit("m").at_least(0),
        /// Number of units of the network.
        units: usize => neither("units").decimals(0),
        /// Share of tested scans whose nearest unit gives the robot's action.
        right_percent: f64 => higher("action predicted").percent().decimals(1),
    }
}

pub(crate) fn table() -> Table {
    Table::of::<SonarRun>(NAME, "A ring of 24 sonars on a wall-following robot")
        .metrics_from(SonarRun::rms_error)
        .rows(ROWS.map(Row::new))
        .note(
        "A log of four laps (Freire and Barreto 2010). Three are learned, in random orders. For each \
         scan of the fourth, the nearest unit predicts the action that was most frequent with that \
         unit before.",
    )
}
