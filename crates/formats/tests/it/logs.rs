//! Published logs, intact and damaged: usable lines are used, and the rest is reported.

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use flate2::Compression;
use flate2::write::GzEncoder;
use proptest::prelude::*;
use tolman_formats::input::MOST_BYTES;
use tolman_formats::{
    LogEntry, LogReader, LogReport, LogScan, LogTrouble, ReadRelations, ReadTrajectory, tum,
};

const LOG: &str = "\
# a comment
PARAM robot_frontlaser_offset 0.2 nohost 0
ODOM 0 0 0 0.1 0 0 1.0 pippo 1.0
FLASER 3 1.0 2.0 81.91 0.7 0.5 0 0.5 0.5 0 1.5 pippo 1.5
NEFF 0.7
ROBOTLASER1 0 -1.57 3.14 1.57 50.0 0.01 0 3 1.0 2.0 60.0 0 1.1 0.5 0.1 1.0 0.5 0.1 0 0 0.3 0.4 0 2.0 pippo 2.0
ROBOTLASER1 0 -1.57 3.14 1.57 50.0 0.01 0 3 1.0 2.0 3.0 2 7 8 1.1 0.5 0.1 1.0 0.5 0.1 0 0 0.3 0.4 0 2.5 pippo 2.5
ROBOTLASER1 0 -1.57 3.14 1.57 50.0 0.01 0 3 1.0 2.0 3.0 1.1 0.5 0.1 1.0 0.5 0.1 0 0 0.3 0.4 3.0 pippo 3.0
";

fn read(text: &[u8]) -> (Vec<LogEntry>, LogReport) {
    let mut reader = LogReader::new(text);
    let entries = reader.by_ref().collect();
    (entries, reader.report().clone())
}

fn scans(text: &[u8]) -> Vec<LogScan> {
    let entries = read(text).0.into_iter();
    let scan = |entry| match entry {
        LogEntry::Scan(scan) => Some(scan),
        LogEntry::BareScan(_) | LogEntry::Odometry(_) => None,
    };
    entries.filter_map(scan).collect()
}

#[test]
fn both_ages_and_all_kinds_are_read() {
    let (entries, report) = read(LOG.as_bytes());
    assert_eq!((entries.len(), report.scans, report.odometry), (5, 4, 1));
    assert_eq!(report.other_kinds["NEFF"].first_line, 5);
    assert!(report.troubles.is_empty(), "{:?}", report.troubles);
    let scans = scans(LOG.as_bytes());
    // The parameter and the two poses agree on where the laser sits.
    assert!((scans[0].robot_from_laser.position.x - 0.2).abs() < 1e-12);
    let times: Vec<f64> = scans.iter().map(|scan| scan.time).collect();
    assert_eq!(times, [1.5, 2.0, 2.5, 3.0]);
    for scan in &scans[1..] {
        assert!((scan.odometry.position.x - 1.0).abs() < 1e-12, "{scan:?}");
    }
    assert_eq!(scans[1].scan.ranges, [1.0, 2.0, 50.0]);
}

#[test]
fn beams_lie_as_the_laser_has_them() {
    for (beams, spacing_deg) in [(180, 1.0), (181, 1.0), (360, 0.5), (361, 0.5)] {
        let ranges = vec!["1.0"; beams].join(" ");
        let line = format!("FLASER {beams} {ranges} 0 0 0 0 0 0 1 h 1\n");
        let ring = scans(line.as_bytes())[0].scan.ring;
        assert!(
            (ring.spacing.to_degrees() - spacing_deg).abs() < 1e-9,
            "{beams}"
        );
        assert!((ring.first_bearing.to_degrees() + 90.0).abs() < 1e-9);
    }
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    let spoiled = "\
FLASER 2 1 2 0 0 0 0 0 0 5.0 h 5.0
FLASER 2 1 nan 0 0 0 0.1 0 0 6.0 h 6.0
FLASER 2 1
FLASER 2 1 2 0 0 0 nan 0 0 6.5 h 6.5
FLASER 2 1 2 0 0 0 0.2 0 0 5.5 h 5.5
FLASER 2 1 2 0 0 0 0.3 0 0 500 h 500
FLASER 999999999 1 2 0 0 0
ODOM 0 0
FLASER 2 1 2 0 0 0 0.3 0 0 501 h 501 and more
";
    let (entries, report) = read(spoiled.as_bytes());
    assert_eq!(entries.len(), 5);
    let lines = |trouble| -> Vec<u64> {
        let met = &report.troubles[&trouble];
        met.first.iter().map(|(line, _)| *line).collect()
    };
    assert_eq!(lines(LogTrouble::NoRange), [2]);
    assert_eq!(lines(LogTrouble::Cut), [3, 8]);
    assert_eq!(lines(LogTrouble::NoNumber), [4, 7]);
    assert_eq!(lines(LogTrouble::BackInTime), [5]);
    assert_eq!(lines(LogTrouble::ClockJump), [6]);
    assert_eq!(lines(LogTrouble::TooManyFields), [9]);
    let told = report.sentences().join("\n");
    assert!(told.contains("line 4 (the odometry is `nan`)"), "{told}");
}

#[test]
fn ranges_in_centimetres_are_suspected() {
    let (_, report) = read(b"FLASER 2 120 230 0 0 0 0 0 0 5.0 h 5.0\n");
    let told = report.sentences().join("\n");
    assert!(told.contains("are the ranges in metres?"), "{told}");
}

fn temporary(name: &str, bytes: &[u8]) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, bytes).unwrap();
    path
}

#[test]
fn a_packed_log_that_was_cut_is_used_as_far_as_it_goes() {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    let many: String = (0..2000)
        .map(|time| format!("ODOM {}.{time} 0 0 0 0 0 {time} h {time}\n", time % 7))
        .collect();
    encoder.write_all(many.as_bytes()).unwrap();
    let packed = encoder.finish().unwrap();
    for (name, share, all) in [("whole.gz", 1, true), ("cut.gz", 2, false)] {
        let path = temporary(name, &packed[..packed.len() / share]);
        let mut reader = LogReader::open(&path, MOST_BYTES).unwrap();
        let count = reader.by_ref().count();
        assert_eq!(count == 2000, all, "{count}");
        assert!(count > 100);
        assert_eq!(reader.report().count(LogTrouble::EndsEarly) == 0, all);
    }
}

#[test]
fn a_file_of_something_else_is_refused_by_name() {
    let path = temporary("poem.txt", b"Roses are red\n");
    let error = ReadRelations::open(&path).unwrap_err().to_string();
    assert!(
        error.contains("poem.txt") && error.contains("line 1"),
        "{error}"
    );
    let error = ReadTrajectory::open(&path).unwrap_err().to_string();
    assert!(error.contains("line 1") && error.contains("qx"), "{error}");
    let error = LogReader::open(&path.with_file_name("nowhere"), MOST_BYTES)
        .err()
        .unwrap();
    assert!(error.to_string().contains("nowhere"));
}

proptest! {
    #[test]
    fn no_mutation_of_a_log_is_a_panic(
        cuts in proptest::collection::vec((0_usize..600, any::<u8>()), 0..12), end in 0_usize..700,
    ) {
        let mut bytes = LOG.as_bytes().to_vec();
        for (place, byte) in cuts {
            let place = place % bytes.len();
            bytes[place] = byte;
        }
        bytes.truncate(end);
        let (entries, report) = read(&bytes);
        prop_assert_eq!(entries.len() as u64, report.scans + report.odometry);
        for scan in scans(&bytes) {
            prop_assert!(scan.odometry.is_finite() && scan.noted.is_finite() && scan.time.is_finite());
            prop_assert_eq!(scan.scan.ranges.len(), scan.scan.ring.beams as usize);
            prop_assert!(scan.scan.ranges.iter().all(|range| *range >= 0.0 && range.is_finite()));
        }
        let _ = ReadRelations::from_lines(&bytes[..]);
        let _ = ReadTrajectory::parse(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_trajectory_is_read_as_it_was_written(
        poses in proptest::collection::vec((-9.0..9.0, -9.0..9.0, -3.1..3.1), 1..9),
    ) {
        use tolman_formats::geom::{Heading, Point, Pose};
        use tolman_formats::robot::{TimedPose, Trajectory};
        let timed = (0..).zip(&poses).map(|(time, (x, y, turn)): (i32, &(f64, f64, f64))| TimedPose {
            time: f64::from(time),
            pose: Pose::new(Point::new(*x, *y), Heading::from_radians(*turn)),
        });
        let way = Trajectory::new(timed);
        let read = ReadTrajectory::parse(&tum(&way)).unwrap().planar();
        for (a, b) in way.poses().iter().zip(read.poses()) {
            let off = a.pose.between(b.pose);
            prop_assert!(off.position.coords.norm() < 2e-6 && off.heading.radians().abs() < 1e-6);
        }
        prop_assert_eq!(way.poses().len(), read.poses().len());
    }
}
