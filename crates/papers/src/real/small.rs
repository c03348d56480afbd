//! A small log of the project's own simulator, which is always available.

use std::io::Read;

use flate2::read::GzDecoder;
use tolman_experiment::{BoxError, Fields, Job, Record, Row, Table, record};
use tolman_geom::Pose;

use super::trajectories::aligned;
use super::{LogMapper, RobotLog};
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "small log";

const PACKED: &[u8] = include_bytes!("../../logs/office.clf.gz");

const ROWS: [(&str, LogMapper); 7] = [
    ("odometry", LogMapper::Odometry),
    ("matching", LogMapper::Matching),
    ("places", LogMapper::Places),
    ("diktiometry", LogMapper::Diktiometry),
    ("cpm", LogMapper::Cpm),
    ("place graph", LogMapper::PlaceGraph),
    ("dense", LogMapper::ScanMatching),
];

/// The small log, in which the true pose of each scan is noted.
#[derive(Debug)]
pub(super) struct Small {
    pub(super) log: RobotLog,
}

record! {
    /// A way through the simulated office.
    struct SmallRun {
        /// Root-mean-square error of the scans' positions after the best rotation and shift.
        rms_m: f64 => lower("error, root mean square").unit("m").at_least(0).decimals(3),
        /// Largest of these errors.
        largest_m: f64 => lower("largest error").unit("m").at_least(0).decimals(3),
        /// Number of places that were recognized again.
        closures: usize => neither("closures").decimals(0),
        /// Number of places on the map.
        places: usize => neither("places").decimals(0),
        /// Number of places within 1 m of an earlier one.
        doubled: usize => lower("doubled places").decimals(0),
    }
}

pub(super) fn table() -> Table {
    Table::of::<SmallRun>(NAME, "A simulated office")
        .metrics_from(SmallRun::rms_m)
        .rows(ROWS.map(|(name, _)| Row::new(name).run_each(1)))
        .note("The log `logs/office.clf.gz`, which the project's simulator wrote: 180 beams over half a circle, wheels that drift. Always here.")
}

impl Small {
    pub(super) fn read() -> Result<Self, BoxError> {
        let mut text = Vec::new();
        GzDecoder::new(PACKED).read_to_end(&mut text)?;
        Ok(Self {
            log: RobotLog::of_text(&text)?,
        })
    }

    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (_, system) = row_of(job, ROWS, |(name, _)| *name == job.row)?;
        let truth: Vec<Pose> = self.log.scans.iter().map(|scan| scan.noted).collect();
        let found = self.log.map(system, &self.log.odometry(), |_| {})?;
        let score = aligned(&found.poses, &truth)?;
        let run = SmallRun {
            rms_m: score.rms,
            largest_m: score.largest,
            closures: found.closures,
            places: found.places.places.len(),
            doubled: found.doubled(),
        };
        Ok(run.fields()?)
    }
}
