//! Converts a robot's log into a TUM trajectory and reports the faults of the log.
#![expect(clippy::print_stdout, reason = "the trajectory is its result")]

use tolman_formats::{LogEntry, LogReader, tum};
use tolman_robot::{TimedPose, Trajectory};

/// Three scans as CARMEN writes them, and a line that was cut off.
const LOG: &str = "\
FLASER 3 1.0 2.0 1.5 0.0 0.0 0.0 0.0 0.0 0.0 1.00 mine 1.00
FLASER 3 0.9 2.0 1.5 0.1 0.0 0.0 0.1 0.0 0.0 1.25 mine 1.25
FLASER 3 0.8 2.0 1.5 0.2 0.0
FLASER 3 0.7 2.0 1.5 0.3 0.0 0.1 0.3 0.0 0.1 1.75 mine 1.75
";

fn main() {
    let mut reader = LogReader::new(LOG.as_bytes());
    let mut poses = Vec::new();
    for entry in &mut reader {
        if let LogEntry::Scan(scan) = entry {
            poses.push(TimedPose {
                time: scan.time,
                pose: scan.odometry,
            });
        }
    }
    assert_eq!(poses.len(), 3);
    for sentence in reader.report().sentences() {
        println!("# {sentence}");
    }
    // Tools such as evo take this for the way that was driven.
    print!("{}", tum(&Trajectory::new(poses)));
}
