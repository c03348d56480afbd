//! Bags of ROS: written here, by SQLite, and by another program.
#![expect(clippy::float_cmp, reason = "what was written is read to the bit")]

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::Command;

use bzip2::write::BzEncoder;
use lz4_flex::frame::FrameEncoder;
use proptest::prelude::*;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};
use tolman_formats::{LogOptions, LogScan, LogTimes, LogTrouble, WholeLog};

/// Layout of a message.
#[derive(Clone, Copy, PartialEq)]
enum Ros {
    One,
    Two,
}

/// A message that is written.
struct Body {
    ros: Ros,
    bytes: Vec<u8>,
}

impl Body {
    fn of(ros: Ros) -> Self {
        let bytes = Vec::new();
        Self { ros, bytes }
    }

    fn number(mut self, bytes: &[u8]) -> Self {
        if self.ros == Ros::Two {
            let size = self.bytes.len().next_multiple_of(bytes.len());
            self.bytes.resize(size, 0);
        }
        self.bytes.extend(bytes);
        self
    }

    fn count(self, count: u32) -> Self {
        self.number(&count.to_le_bytes())
    }

    fn floats(self, floats: &[f32]) -> Self {
        let mut all = floats.iter();
        all.try_fold(self, |body, float| Some(body.number(&float.to_le_bytes())))
            .unwrap()
    }

    fn doubles(self, doubles: &[f64]) -> Self {
        let mut all = doubles.iter();
        all.try_fold(self, |body, double| {
            Some(body.number(&double.to_le_bytes()))
        })
        .unwrap()
    }

    fn text(self, text: &str) -> Self {
        let end = if self.ros == Ros::Two { "\0" } else { "" };
        let text = format!("{text}{end}");
        let mut body = self.count(u32::try_from(text.len()).unwrap());
        body.bytes.extend(text.as_bytes());
        body
    }

    fn header(self, sec: u32, frame: &str) -> Self {
        let body = if self.ros == Ros::One {
            self.count(7)
        } else {
            self
        };
        body.count(sec).count(500_000_000).text(frame)
    }

    fn done(self) -> Vec<u8> {
        let head: &[u8] = if self.ros == Ros::Two {
            &[0, 1, 0, 0]
        } else {
            &[]
        };
        [head, &self.bytes].concat()
    }
}

fn scan(ros: Ros, sec: u32, ranges: &[f32]) -> Vec<u8> {
    let count = u32::try_from(ranges.len()).unwrap();
    let body = Body::of(ros).header(sec, "/laser");
    let body = body.floats(&[-1.0, 1.0, 1.0, 0.0, 0.1, 0.1, 30.0]);
    body.count(count).floats(ranges).count(0).done()
}

/// Returns odometry of a robot that looks left.
fn odometry(ros: Ros, sec: u32, x: f64) -> Vec<u8> {
    let half = core::f64::consts::FRAC_1_SQRT_2;
    let body = Body::of(ros).header(sec, "odom").text("base_link");
    body.doubles(&[x, 0.0, 0.0, 0.0, 0.0, half, half])
        .doubles(&[1.0; 36])
        .done()
}

/// Returns the transform of a part, by its position and its orientation x, y, z, w.
fn transform(ros: Ros, sec: u32, [on, part]: [&str; 2], at: [f64; 3], turned: [f64; 4]) -> Vec<u8> {
    let body = Body::of(ros).count(1).header(sec, on).text(part);
    body.doubles(&at).doubles(&turned).done()
}

const LEVEL: [f64; 4] = [0.0, 0.0, 0.0, 1.0];

/// A message with its topic, its type and the second of its receipt.
type Sent = (&'static str, &'static str, u32, Vec<u8>);

const SCAN: &str = "sensor_msgs/msg/LaserScan";
const ODOMETRY: &str = "nav_msgs/msg/Odometry";
const TRANSFORM: &str = "tf2_msgs/msg/TFMessage";

fn drive(ros: Ros) -> Vec<Sent> {
    let mount = transform(ros, 0, ["base_link", "laser"], [0.25, 0.0, 0.3], LEVEL);
    vec![
        ("/tf_static", TRANSFORM, 0, mount),
        ("/scan", SCAN, 0, scan(ros, 0, &[1.0, 2.0, 3.0])),
        ("/odom", ODOMETRY, 1, odometry(ros, 1, 0.0)),
        ("/scan", SCAN, 2, scan(ros, 2, &[1.0, f32::NAN, 0.05])),
        ("/other_scan", SCAN, 2, scan(ros, 2, &[f32::INFINITY, 60.0])),
        ("/odom", ODOMETRY, 3, odometry(ros, 3, 2.0)),
    ]
}

fn record(opcode: u8, parts: &[&[u8]]) -> Vec<u8> {
    let body = parts.concat();
    [&[opcode], &(body.len() as u64).to_le_bytes()[..], &body].concat()
}

fn text(text: &str) -> Vec<u8> {
    let size = u32::try_from(text.len()).unwrap().to_le_bytes();
    [&size, text.as_bytes()].concat()
}

fn packed(format: &str, bytes: &[u8]) -> Vec<u8> {
    match format {
        "lz4" => {
            let mut encoder = FrameEncoder::new(Vec::new());
            encoder.write_all(bytes).unwrap();
            encoder.finish().unwrap()
        }
        "bz2" => {
            let mut encoder = BzEncoder::new(Vec::new(), bzip2::Compression::fast());
            encoder.write_all(bytes).unwrap();
            encoder.finish().unwrap()
        }
        "zstd" => compress_to_vec(bytes, CompressionLevel::Fastest),
        _ => bytes.to_vec(),
    }
}

/// Returns an MCAP file whose messages lie in one chunk.
fn mcap(format: &str, sent: &[Sent]) -> Vec<u8> {
    let mut records = Vec::new();
    for (id, (topic, kind, sec, data)) in (1_u16..).zip(sent) {
        let id = id.to_le_bytes();
        records.extend(record(3, &[&id, &text(kind), &text("ros2msg"), &[0; 4]]));
        records.extend(record(4, &[&id, &id, &text(topic), &text("cdr"), &[0; 4]]));
        let time = (u64::from(*sec) * 1_000_000_000 + 250_000_000).to_le_bytes();
        records.extend(record(5, &[&id, &[0; 4], &time, &time, data]));
    }
    let chunk = packed(format, &records);
    let size = (records.len() as u64).to_le_bytes();
    let chunk = record(
        6,
        &[
            &[0; 16],
            &size,
            &[0; 4],
            &text(format),
            &(chunk.len() as u64).to_le_bytes(),
            &chunk,
        ],
    );
    [b"\x89MCAP0\r\n", &chunk[..], &record(15, &[&[0; 4]])].concat()
}

fn block(fields: &[(&str, &[u8])]) -> Vec<u8> {
    let fields = fields.iter().map(|(name, value)| {
        let field = [name.as_bytes(), b"=", value].concat();
        [
            &u32::try_from(field.len()).unwrap().to_le_bytes(),
            &field[..],
        ]
        .concat()
    });
    sized(&fields.collect::<Vec<_>>().concat())
}

fn sized(bytes: &[u8]) -> Vec<u8> {
    [&u32::try_from(bytes.len()).unwrap().to_le_bytes(), bytes].concat()
}

/// Returns a bag of ROS 1 whose messages lie in one chunk.
fn ros1(format: &str, sent: &[Sent]) -> Vec<u8> {
    let mut records = Vec::new();
    for (id, (topic, kind, sec, data)) in (0_u32..).zip(sent) {
        let id = id.to_le_bytes();
        let kind = kind.replace("/msg/", "/");
        records.extend(block(&[
            ("op", &[7]),
            ("conn", &id),
            ("topic", topic.as_bytes()),
        ]));
        records.extend(block(&[("type", kind.as_bytes())]));
        let time = [sec.to_le_bytes(), 250_000_000_u32.to_le_bytes()].concat();
        records.extend(block(&[("op", &[2]), ("conn", &id), ("time", &time)]));
        records.extend(sized(data));
    }
    let size = u32::try_from(records.len()).unwrap().to_le_bytes();
    let head = block(&[
        ("op", &[5]),
        ("compression", format.as_bytes()),
        ("size", &size),
    ]);
    let first = [block(&[("op", &[3])]), sized(&[b' '; 9])].concat();
    [
        b"#ROSBAG V2.0\n",
        &first[..],
        &head,
        &sized(&packed(format, &records)),
    ]
    .concat()
}

fn read(bytes: Vec<u8>) -> WholeLog {
    WholeLog::of_bytes(bytes, &LogOptions::whole()).unwrap()
}

#[test]
fn bags_of_both_ages_and_all_packings_are_read_with_where_the_robot_was() {
    let two = ["", "lz4", "zstd"].map(|format| mcap(format, &drive(Ros::Two)));
    let one = ["none", "lz4", "bz2"].map(|format| ros1(format, &drive(Ros::One)));
    for bytes in two.into_iter().chain(one) {
        for bytes in [packed("bz2", &bytes), packed("zstd", &bytes), bytes] {
            let log = read(bytes);
            // The first was taken before any odometry.
            assert_eq!(log.scans.len(), 1, "{:?}", log.report);
            assert_eq!(log.report.count(LogTrouble::NoOdometry), 1);
            let LogScan {
                time,
                odometry,
                robot_from_laser,
                scan,
                ..
            } = &log.scans[0];
            assert_eq!((*time, odometry.position.x), (2.5, 1.0));
            let turned = odometry.heading.radians() - core::f64::consts::FRAC_PI_2;
            assert!(turned.abs() < 1e-9);
            assert_eq!(robot_from_laser.position.x, 0.25);
            // Neither what is not a number nor what is nearer than the laser sees was met.
            assert_eq!(scan.ranges, [1.0, 30.0, 30.0]);
            assert_eq!(log.report.count(LogTrouble::NoRange), 1);
            // Another laser met less, and is named.
            assert!(
                log.report.notes[0].contains("/other_scan"),
                "{:?}",
                log.report.notes
            );
        }
    }
}

#[test]
fn topics_and_times_are_chosen() {
    let mut options = LogOptions::whole();
    options.times = Some(LogTimes::Receipt);
    options.scan_topics = vec!["/scan".to_owned(), "/other_scan".to_owned()];
    let log = WholeLog::of_bytes(mcap("", &drive(Ros::Two)), &options).unwrap();
    let times: Vec<f64> = log.scans.iter().map(|scan| scan.time).collect();
    assert_eq!(times, [2.25, 2.25]);
    options.odom_topic = Some("/wheels".to_owned());
    let wrong = WholeLog::of_bytes(mcap("", &drive(Ros::Two)), &options).unwrap_err();
    assert!(
        wrong.contains("/wheels") && wrong.contains("/odom"),
        "{wrong}"
    );
    let mut stamped = drive(Ros::Two);
    for sent in stamped.iter_mut().filter(|sent| sent.1 == SCAN) {
        sent.3 = scan(Ros::Two, 0, &[1.0, 2.0, 3.0]);
    }
    let log = read(mcap("", &stamped));
    assert_eq!(log.scans.len(), 1);
    assert!(
        log.report.notes.iter().any(|note| note.contains("--times")),
        "{:?}",
        log.report
    );
}

#[test]
fn odometry_may_be_a_transform_or_missing() {
    let mut sent = drive(Ros::Two);
    sent.retain(|sent| sent.1 != ODOMETRY);
    let blind = read(mcap("", &sent));
    assert_eq!(blind.scans.len(), 2);
    assert!(
        blind
            .report
            .notes
            .iter()
            .any(|note| note.contains("no odometry"))
    );
    for sec in 0..4 {
        let at = [f64::from(sec), 0.0, 0.0];
        let moved = transform(Ros::Two, sec, ["/odom", "base_link"], at, LEVEL);
        sent.push(("/tf", TRANSFORM, sec, moved));
    }
    let log = read(mcap("", &sent));
    let at: Vec<f64> = log
        .scans
        .iter()
        .map(|scan| scan.odometry.position.x)
        .collect();
    assert_eq!(at, [0.0, 2.0]);
    assert_eq!(log.scans[0].robot_from_laser.position.x, 0.25);
}

#[test]
fn a_laser_that_hangs_upside_down_sees_its_beams_mirrored() {
    // By roll, by pitch, and by both, which is a turn.
    let turned = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
    ];
    let left = turned.map(|turned| {
        let mut sent = drive(Ros::Two);
        sent[0].3 = transform(Ros::Two, 0, ["base_link", "laser"], [0.0; 3], turned);
        let scan = read(mcap("", &sent)).scans.remove(0);
        // Where the first beam, 1 rad to the laser's right, looks.
        let beam = tolman_formats::geom::Heading::from_radians(scan.scan.ring.bearing(0));
        let end = tolman_formats::geom::Point::from(beam.unit());
        let end = scan.robot_from_laser.transform(end);
        [end.x, end.y].map(|part| (part * 1e6).round() / 1e6)
    });
    let [ahead, aside] = [1_f64.cos(), 1_f64.sin()].map(|part| (part * 1e6).round() / 1e6);
    assert_eq!(left, [[ahead, aside], [-ahead, -aside], [-ahead, aside]]);
    let mut sent = drive(Ros::Two);
    let half = core::f64::consts::FRAC_1_SQRT_2;
    sent[0].3 = transform(
        Ros::Two,
        0,
        ["base_link", "laser"],
        [0.0; 3],
        [half, 0.0, 0.0, half],
    );
    assert_eq!(read(mcap("", &sent)).report.count(LogTrouble::OnEdge), 1);
}

#[test]
fn what_is_missing_or_cut_is_told() {
    let without = &drive(Ros::Two)[1..];
    assert_eq!(read(mcap("", without)).report.count(LogTrouble::NoMount), 1);
    let none = &drive(Ros::Two)[..1];
    let wrong = WholeLog::of_bytes(mcap("", none), &LogOptions::whole()).unwrap_err();
    assert!(wrong.contains("/tf_static"), "{wrong}");
    let database = fs::read(database()).unwrap();
    let bags = [
        mcap("lz4", &drive(Ros::Two)),
        ros1("bz2", &drive(Ros::One)),
        database,
    ];
    for whole in bags {
        let step = 1 + whole.len() / 300;
        for end in (0..whole.len()).step_by(step) {
            let _ = WholeLog::of_bytes(whole[..end].to_vec(), &LogOptions::whole());
            let mut spoiled = whole.clone();
            spoiled[end] ^= 0x55;
            let _ = WholeLog::of_bytes(spoiled, &LogOptions::whole());
        }
    }
}

proptest! {
    #[test]
    fn no_bytes_are_too_strange(magic in 0..6_usize, bytes in prop::collection::vec(any::<u8>(), 0..80)) {
        let magics: [&[u8]; 6] = [
            b"\x89MCAP0\r\n", b"#ROSBAG V2.0\n", b"SQLite format 3\0", b"\x28\xb5\x2f\xfd",
            b"\xfd7zXZ\0\0\x04\xe6\xd6\xb4\x46", b"BZh91AY&SY",
        ];
        let _ = WholeLog::of_bytes([magics[magic], &bytes].concat(), &LogOptions::whole());
    }
}

fn database() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/drive.db3")
}

#[test]
fn databases_and_folders_are_read() {
    let plain = WholeLog::open(&database(), &LogOptions::whole()).unwrap();
    assert_eq!((plain.scans.len(), plain.report.odometry), (8, 8));
    assert_eq!(plain.scans[3].scan.ranges.len(), 300);
    assert_eq!(plain.scans[3].robot_from_laser.position.x, 0.25);
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("bag-folder");
    fs::create_dir_all(&folder).unwrap();
    let bytes = fs::read(database()).unwrap();
    fs::write(folder.join("b_0.db3.zstd"), packed("zstd", &bytes)).unwrap();
    let metadata = "rosbag2_bagfile_information:\n  version: 5\n  relative_file_paths:\n    - b_0.db3.zstd\n  \
                    compression_format: zstd\n  compression_mode: FILE\n";
    fs::write(folder.join("metadata.yaml"), metadata).unwrap();
    let log = WholeLog::open(&folder, &LogOptions::whole()).unwrap();
    assert_eq!(log.scans, plain.scans);
    let topics = WholeLog::list(&folder, u64::MAX).unwrap();
    let names: Vec<(&str, u64)> = topics
        .iter()
        .map(|it| (it.name.as_str(), it.count))
        .collect();
    assert_eq!(names, [("/odom", 8), ("/scan", 8), ("/tf_static", 1)]);
    assert_eq!(topics[1].rate_hz, Some(1.0));
    assert_eq!(
        (topics[0].frame.as_str(), topics[1].frame.as_str()),
        ("base_link in odom", "laser")
    );
}

#[test]
fn xz_of_several_streams_is_unpacked() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/log.clf.xz");
    let log = WholeLog::open(&path, &LogOptions::whole()).unwrap();
    assert_eq!(
        (log.scans.len(), log.report.lines),
        (16, 16),
        "{:?}",
        log.report
    );
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
#[ignore = "fetches mcap-ros2-support from PyPI: cargo test -p tolman-formats --test it -- --ignored rosbag"]
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
    let log = WholeLog::open(&path, &LogOptions::whole()).unwrap();
    assert_eq!(log.scans.len(), 3, "{:?}", log.report);
    assert_eq!(log.scans[2].odometry.position.x, 1.0);
    assert_eq!(log.scans[2].scan.ranges, [1.0, 4.0, 30.0]);
    assert!(log.report.troubles.is_empty(), "{:?}", log.report);
}
