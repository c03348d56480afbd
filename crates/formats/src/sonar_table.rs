//! Reads readings of a ring of sonars with a word for the robot's action, one scan per line:
//! `r₁,…,rₙ,Word`, lengths in m.
//!
//! Source: the wall-following data of the UCI repository (A. Freire, G. Barreto and others, 2009),
//! whose first line names the columns.

use std::path::Path;

use crate::fields::{Fields, Wrong};
use crate::log::{self, LogError, LogReport, LogTrouble};

/// Scans of a ring of sonars.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SonarTable {
    /// Ranges of each scan, m; all scans have equally many.
    pub scans: Vec<Vec<f64>>,
    /// Word for the robot's action at each scan.
    pub actions: Vec<String>,
    /// Report on reading the file.
    pub report: LogReport,
}

impl SonarTable {
    /// Reads a file, plain or gzipped.
    ///
    /// # Errors
    /// If there is no such file, or no line of it can be used.
    pub fn read(path: &Path) -> Result<Self, LogError> {
        let (rows, report) = log::read_records(path, "r₁,…,rₙ,action", row)?;
        let beams = rows.first().map_or(0, |(scan, _)| scan.len());
        let mut table = Self {
            report,
            ..Self::default()
        };
        for (index, (scan, action)) in rows.into_iter().enumerate() {
            if scan.len() == beams {
                table.scans.push(scan);
                table.actions.push(action);
            } else {
                let what = format!("row {} has {} of {beams} ranges", index + 1, scan.len());
                table.report.met_trouble(LogTrouble::Cut, 0, what);
            }
        }
        Ok(table)
    }
}

fn row(fields: &mut Fields<'_>) -> Result<(Vec<f64>, String), Wrong> {
    let line = fields.word("the row")?;
    let (ranges, action) = line
        .rsplit_once(',')
        .ok_or_else(|| (LogTrouble::Cut, "it has no action".to_owned()))?;
    let mut scan = Vec::new();
    for range in ranges.split(',') {
        scan.push(Fields::of(range).number("a range")?);
    }
    Ok((scan, action.to_owned()))
}
