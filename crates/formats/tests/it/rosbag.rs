//! Bags of ROS 2, written by the crate that reads them and by another program.
#![expect(clippy::float_cmp, reason = "what was written is read to the bit")]

use alloc::collections::BTreeMap;
use std::fs;
use std::io::Cursor;
use std::path::PathBuf;
use std::process::Command;

use mcap::Writer;
use mcap::records::MessageHeader;
use serde::Serialize;
use tolman_formats::input::MOST_BYTES;
use tolman_formats::{LogEntry, LogScan, LogTrouble, RosBag, is_mcap};

#[derive(Serialize)]
struct Header {
    stamp: (i32, u32),
    frame: &'static str,
}

const fn header(sec: i32, frame: &'static str) -> Header {
    Header {
        stamp: (sec, 500_000_000),
        frame,
    }
}

#[derive(Serialize)]
struct LaserScan {
    header: Header,
    /// First and last angle, spacing, two times, least and greatest range.
    numbers: [f32; 7],
    ranges: Vec<f32>,
    intensities: Vec<f32>,
}

fn scan(sec: i32, ranges: &[f32]) -> LaserScan {
    LaserScan {
        header: header(sec, "laser"),
        numbers: [-1.0, 1.0, 1.0, 0.0, 0.1, 0.1, 30.0],
        ranges: ranges.to_vec(),
        intensities: Vec::new(),
    }
}

/// Returns a pose on the floor, turned to the left by a quarter, and what comes after it.
fn odometry(sec: i32, x: f64) -> impl Serialize {
    let half = core::f64::consts::FRAC_1_SQRT_2;
    (
        header(sec, "odom"),
        "base_link",
        [x, 0.0, 0.0],
        [0.0, 0.0, half, half],
        [1.0; 20],
    )
}

fn mount() -> impl Serialize {
    (
        1_u32,
        header(0, "base_link"),
        "laser",
        [0.25, 0.0, 0.3],
        [0.0, 0.0, 0.0, 1.0],
    )
}

struct Bag {
    writer: Writer<Cursor<Vec<u8>>>,
    time: u64,
}

impl Bag {
    fn new() -> Self {
        let writer = Writer::new(Cursor::new(Vec::new())).unwrap();
        Self { writer, time: 0 }
    }

    fn add(&mut self, topic: &str, kind: &str, message: &impl Serialize) {
        let schema = self.writer.add_schema(kind, "ros2msg", b"").unwrap();
        let none = BTreeMap::new();
        let channel_id = self
            .writer
            .add_channel(schema, topic, "cdr", &none)
            .unwrap();
        let mut data = vec![0, 1, 0, 0];
        data.extend(cdr_encoding::to_vec::<_, byteorder::LittleEndian>(message).unwrap());
        self.time += 1;
        let header = MessageHeader {
            channel_id,
            sequence: 0,
            log_time: self.time,
            publish_time: self.time,
        };
        self.writer.write_to_known_channel(&header, &data).unwrap();
    }

    fn bytes(mut self) -> Vec<u8> {
        self.writer.finish().unwrap();
        self.writer.into_inner().into_inner()
    }
}

const SCAN: &str = "sensor_msgs/msg/LaserScan";
const ODOMETRY: &str = "nav_msgs/msg/Odometry";

fn drive(has_mount: bool) -> Vec<u8> {
    let mut bag = Bag::new();
    if has_mount {
        bag.add("/tf_static", "tf2_msgs/msg/TFMessage", &mount());
    }
    bag.add("/scan", SCAN, &scan(0, &[1.0, 2.0, 3.0]));
    bag.add("/odom", ODOMETRY, &odometry(1, 0.0));
    bag.add("/scan", SCAN, &scan(2, &[1.0, f32::NAN, 0.05]));
    bag.add("/other_scan", SCAN, &scan(2, &[1.0]));
    bag.add("/odom", ODOMETRY, &odometry(3, 2.0));
    bag.bytes()
}

fn scans(bag: &RosBag) -> Vec<&LogScan> {
    let entries = bag.entries.iter();
    let scans = entries.filter_map(|entry| match entry {
        LogEntry::Scan(scan) => Some(scan),
        LogEntry::Odometry(_) => None,
    });
    scans.collect()
}

#[test]
fn a_bag_is_read_with_where_the_robot_was() {
    let bag = RosBag::of(&drive(true)[..]);
    let scans = scans(&bag);
    // The first was taken before any odometry.
    assert_eq!(scans.len(), 1, "{:?}", bag.report);
    assert_eq!(bag.report.count(LogTrouble::NoOdometry), 1);
    let LogScan {
        time,
        odometry,
        robot_from_laser,
        scan,
        ..
    } = scans[0];
    assert_eq!(*time, 2.5);
    assert_eq!(odometry.position.x, 1.0);
    assert!((odometry.heading.radians() - core::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert_eq!(robot_from_laser.position.x, 0.25);
    // Neither what is not a number nor what is nearer than the laser sees was hit.
    assert_eq!(scan.ranges, [1.0, 30.0, 30.0]);
    assert_eq!(bag.report.count(LogTrouble::NoRange), 1);
    let others: Vec<&String> = bag.report.other_kinds.keys().collect();
    assert!(others[0].starts_with("/other_scan"), "{others:?}");
}

#[test]
fn what_is_missing_or_cut_is_told() {
    let bag = RosBag::of(&drive(false)[..]);
    assert_eq!(bag.report.count(LogTrouble::NoMount), 1);
    let whole = drive(true);
    for end in (0..whole.len()).step_by(7) {
        let cut = RosBag::of(&whole[..end]);
        assert!(cut.entries.len() <= 3);
    }
    for place in (0..whole.len()).step_by(3) {
        let mut spoiled = whole.clone();
        spoiled[place] ^= 0x55;
        let _ = RosBag::of(&spoiled[..]);
    }
}

const WRITE: &str = "\
from mcap_ros2.writer import Writer
scan = '''std_msgs/Header header
float32 angle_min
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges
float32[] intensities
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
'''
odom = '''std_msgs/Header header
string child_frame_id
geometry_msgs/PoseWithCovariance pose
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: geometry_msgs/PoseWithCovariance
geometry_msgs/Pose pose
float64[36] covariance
================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
'''
def header(sec, frame):
    return {'stamp': {'sec': sec, 'nanosec': 0}, 'frame_id': frame}
with open('drive.mcap', 'wb') as file:
    writer = Writer(file)
    scans = writer.register_msgdef('sensor_msgs/msg/LaserScan', scan)
    moves = writer.register_msgdef('nav_msgs/msg/Odometry', odom)
    for sec in range(3):
        place = {'x': 0.5 * sec, 'y': 0.0, 'z': 0.0}
        level = {'x': 0.0, 'y': 0.0, 'z': 0.0, 'w': 1.0}
        pose = {'pose': {'position': place, 'orientation': level}, 'covariance': [0.0] * 36}
        moved = {'header': header(sec, 'odom'), 'child_frame_id': 'laser', 'pose': pose}
        writer.write_message(topic='/odom', schema=moves, message=moved, log_time=sec, publish_time=sec)
        seen = {'header': header(sec, 'laser'), 'angle_min': -1.0, 'angle_max': 1.0, 'angle_increment': 1.0,
            'time_increment': 0.0, 'scan_time': 0.1, 'range_min': 0.1, 'range_max': 30.0,
            'ranges': [1.0, 2.0 + sec, 31.0], 'intensities': []}
        writer.write_message(topic='/scan', schema=scans, message=seen, log_time=sec, publish_time=sec)
    writer.finish()
";

#[test]
#[ignore = "fetches mcap-ros2-support from PyPI: cargo test -p tolman-formats --features mcap --test it -- --ignored rosbag"]
fn what_others_have_written_is_read() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("rosbag");
    fs::create_dir_all(&folder).unwrap();
    let python = folder.join("venv/bin/python");
    let run = |program: &str, arguments: &[&str]| {
        let mut command = Command::new(program);
        let status = command.current_dir(&folder).args(arguments).status();
        status.is_ok_and(|status| status.success())
    };
    let python = python.to_str().unwrap();
    let is_there = run("python3", &["-m", "venv", "venv"])
        && run(python, &["-m", "pip", "install", "-q", "mcap-ros2-support"]);
    if !is_there {
        eprintln!("skipped: mcap-ros2-support cannot be installed here");
        return;
    }
    assert!(run(python, &["-c", WRITE]));
    let path = folder.join("drive.mcap");
    assert!(is_mcap(&path));
    let bag = RosBag::read(&path, MOST_BYTES).unwrap();
    let scans = scans(&bag);
    assert_eq!(scans.len(), 3, "{:?}", bag.report);
    assert_eq!(scans[2].odometry.position.x, 1.0);
    assert_eq!(scans[2].scan.ranges, [1.0, 4.0, 30.0]);
    assert!(bag.report.troubles.is_empty(), "{:?}", bag.report);
}
