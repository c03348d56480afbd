//! Published data sets, each in a few lines of its kind, intact and damaged.

use std::fs;
use std::path::PathBuf;

use tolman_formats::geom::Point;
use tolman_formats::{
    BarcodeSighting, LogEntry, LogOptions, LogReader, LogTrouble, LogVelocity, SonarTable,
    TucDrive, UtiasRobot, WholeLog,
};

/// Returns a folder of its own, with these files.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    for (file, text) in files {
        fs::write(folder.join(file), text).unwrap();
    }
    folder
}

#[test]
fn wean_hall_is_read_in_metres() {
    let ranges = ["250"; 180].join(" ");
    let log = format!("O 100 -50 1.5 0.1\nL 100 -50 0 125 -50 0 {ranges} 0.2\nL 1 2 3\n");
    let mut reader = LogReader::new(log.as_bytes());
    let entries: Vec<LogEntry> = reader.by_ref().collect();
    let LogEntry::Odometry(odometry) = entries[0] else {
        panic!("{entries:?}")
    };
    assert_eq!(odometry.pose.position, Point::new(1.0, -0.5));
    let LogEntry::Scan(scan) = &entries[1] else {
        panic!("{entries:?}")
    };
    assert_eq!((scan.time, scan.scan.ranges.len()), (0.2, 180));
    assert_eq!(scan.scan.ranges, [2.5; 180]);
    assert!((scan.scan.ring.spacing.to_degrees() - 1.0).abs() < 1e-12);
    assert_eq!(reader.report().count(LogTrouble::Cut), 1);
    let whole = WholeLog::of_bytes(log.into_bytes(), &LogOptions::whole()).unwrap();
    let mount = whole.scans[0].robot_from_laser.position;
    assert!((mount.x - 0.25).abs() < 1e-12);
}

const BARCODES: &str = "# Subject # Barcode #\n 1 5\n 6 72\n";

#[test]
fn a_robot_of_the_utias_set_is_read() {
    let files = [
        ("Barcodes.dat", BARCODES),
        ("Robot2_Odometry.dat", "10.0 0.1 -0.2\n10.5 nan 0\n11 0 0\n"),
        (
            "Robot2_Measurement.dat",
            "10 72 2.5 0.1\n10 5 1 0\n10 9 1 0\n",
        ),
        ("Robot2_Groundtruth.dat", "# t x y o\n10 1 2 0.5\n"),
    ];
    let robot = UtiasRobot::read(&folder("utias", &files), 2).unwrap();
    assert_eq!(robot.odometry.len(), 2);
    assert_eq!(robot.reports[1].1.count(LogTrouble::NoNumber), 1);
    let landmarks: Vec<bool> = robot
        .sightings
        .iter()
        .map(BarcodeSighting::is_landmark)
        .collect();
    assert_eq!(landmarks, [true, false]);
    assert_eq!(robot.strangers[&9], 1);
    assert_eq!(robot.truth.poses()[0].pose.position, Point::new(1.0, 2.0));
}

#[test]
fn a_robot_that_is_not_there_is_named() {
    let files = [("Barcodes.dat", BARCODES)];
    let error = UtiasRobot::read(&folder("utias-without", &files), 3).unwrap_err();
    assert!(error.to_string().contains("Robot3_Odometry.dat"), "{error}");
}

#[test]
fn places_that_look_alike_are_read_beside_the_odometry() {
    let sensed = "odom2 0 1 0 0 1 1 1\nodom2 2 0 0 0.5 1 1 1\nloop 2 0 0.75\nloop 2\nfoo 1\n";
    let truth = "point2 0 -4 0.5 0 0 0 0\nangle 0 0.1 0\n";
    let folder = folder("tuc", &[("in.txt", sensed), ("gt.txt", truth)]);
    let drive = TucDrive::read(&folder.join("in.txt")).unwrap();
    assert_eq!((drive.odometry.len(), drive.matches.len()), (2, 1));
    let alike: Vec<f64> = drive.matches.iter().map(|one| one.similarity).collect();
    assert_eq!(alike, [0.75]);
    assert_eq!(drive.report.count(LogTrouble::UnknownKind), 1);
    assert_eq!(drive.report.count(LogTrouble::Cut), 1);
    let truth = TucDrive::read_truth(&folder.join("gt.txt")).unwrap();
    assert_eq!(truth.poses().len(), 1);
    let way = LogVelocity::dead_reckoning(&drive.odometry);
    assert_eq!(way.poses()[1].pose.position, Point::new(2.0, 0.0));
}

#[test]
fn a_quarter_of_a_circle_leads_to_its_end() {
    let step = |number: u32| LogVelocity {
        time: f64::from(number),
        forward: 0.01,
        left: 0.0,
        turn: 0.01,
    };
    let steps: Vec<LogVelocity> = (0..158).map(step).collect();
    let way = LogVelocity::dead_reckoning(&steps);
    let end = way.poses().last().unwrap().pose;
    let off = end.position - Point::new(libm::sin(1.57), 1.0 - libm::cos(1.57));
    assert!(off.norm() < 1e-3, "{end:?}");
}

#[test]
fn sonar_readings_have_as_many_ranges_each() {
    let table = "S1,S2,OUTPUT\n0.5,5.0,Move-Forward\n0.25,1,Sharp-Right-Turn\n1,2,3,Odd\n";
    let folder = folder("sonar", &[("readings.data", table)]);
    let table = SonarTable::read(&folder.join("readings.data")).unwrap();
    assert_eq!(table.scans, [[0.5, 5.0], [0.25, 1.0]]);
    assert_eq!(table.actions[1], "Sharp-Right-Turn");
    // The first line names the columns, the last has too many.
    assert_eq!(table.report.count(LogTrouble::NoNumber), 1);
    assert_eq!(table.report.count(LogTrouble::Cut), 1);
}
