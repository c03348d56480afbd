//! What must hold of every reader, one function a format: whatever the file, it is used or refused,
//! and what is used is sound.

use core::str;
use core::time::Duration;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::{env, fs, process};

use tolman_arena::diktiometry::SurveyFile;
use tolman_arena::gngslam::DataSet;
use tolman_arena::mms::{Exchange, Simulator};
use tolman_experiment::compare;
use tolman_formats::{
    G2o, GreyMap, LogEntry, LogOptions, LogReader, ReadRelations, ReadTrajectory, RosMap,
    RosMapHeader, SonarTable, TucDrive, UtiasRobot, WholeLog,
};
use tolman_maze::{Format, parse_as, read_as, write};
use tolman_replay::Trace;
use tolman_robot::epuck::WheelSpeeds;
use tolman_robot::epuck_serial::SerialEpuck;
use tolman_robot::{Mapper, Robot, Task};
use tolman_sim::robots::{Epuck, LaserPioneer};
use tolman_sim::trace::replay;
use tolman_sim::{Occupancy, World};
use tolman_systems::micromouse::Until;
use tolman_systems::micromouse::mms::play;
use tolman_systems::{cpm, gngslam, mslst};

use super::Answer;

/// Returns what `take` makes of a text; bytes that are not text are refused before.
fn of_text(bytes: &[u8], take: impl FnOnce(&str) -> Answer) -> Answer {
    str::from_utf8(bytes).map_or(Answer::Refused, take)
}

/// A maze that parses has a form in its own format, which parses to the same.
fn maze(bytes: &[u8], format: Format) -> Answer {
    of_text(bytes, |text| match parse_as(text, format) {
        Ok(file) => {
            let written = write(&file, format).expect("a maze fits the format it came in");
            let again = parse_as(&written, format).expect("what was written parses");
            assert_eq!(again.maze, file.maze);
            assert_eq!(read_as(text, format).is_ok(), file.maze.check().is_ok());
            Answer::Taken
        }
        Err(error) => {
            assert!(error.line >= 1 && error.column >= 1, "{error}");
            Answer::Refused
        }
    })
}

pub(super) fn read(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        if let Ok(format) = Format::detect(text) {
            maze(bytes, format);
        }
        Answer::of(&tolman_maze::read(text))
    })
}

pub(super) fn tolman(bytes: &[u8]) -> Answer {
    maze(bytes, Format::Tolman)
}

pub(super) fn numbers(bytes: &[u8]) -> Answer {
    maze(bytes, Format::Numbers)
}

pub(super) fn mazefiles(bytes: &[u8]) -> Answer {
    maze(bytes, Format::Mazefiles)
}

pub(super) fn num(bytes: &[u8]) -> Answer {
    maze(bytes, Format::Num)
}

/// A world that is read can be written, and reads as the same.
pub(super) fn world(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let world = World::from_json(text);
        if let Ok(world) = &world {
            let written = world
                .to_json()
                .expect("a world that was read can be written");
            let again = World::from_json(&written).expect("what was written is read");
            assert_eq!(again.to_json().unwrap(), written);
        }
        Answer::of(&world)
    })
}

/// A map has a cell for each value of its picture, and a size that is one.
pub(super) fn ros_map_header(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let header = RosMapHeader::parse(text);
        if let Ok(header) = &header {
            let picture = GreyMap::parse(b"P2 2 1 2 0 1").expect("a picture");
            let map = RosMap::of(header, &picture);
            assert!(map.cells.len() == 2 && map.resolution > 0.0 && map.resolution.is_finite());
        }
        Answer::of(&header)
    })
}

/// A picture has as many values as it says, none of them above its white.
pub(super) fn grey_map(bytes: &[u8]) -> Answer {
    let picture = GreyMap::parse(bytes);
    if let Ok(picture) = &picture {
        assert_eq!(picture.values.len(), picture.width * picture.height);
        assert!(picture.values.iter().all(|value| *value <= picture.most));
    }
    Answer::of(&picture)
}

/// A map in two files, an empty line between them, becomes a world or is refused.
pub(super) fn ros_map(bytes: &[u8]) -> Answer {
    let gap = bytes.windows(2).position(|two| two == b"\n\n");
    let (header, picture) = bytes.split_at(gap.map_or(0, |gap| gap + 2));
    let (Ok(header), Ok(picture)) = (
        RosMapHeader::parse(&String::from_utf8_lossy(header)),
        GreyMap::parse(picture),
    ) else {
        return Answer::Refused;
    };
    let map = RosMap::of(&header, &picture);
    let occupied = map
        .cells
        .iter()
        .map(|cell| *cell != tolman_formats::MapCell::Free);
    Answer::of(&World::from_occupancy(&Occupancy {
        width: map.width,
        height: map.height,
        resolution: map.resolution,
        origin: map.origin,
        occupied: occupied.collect(),
    }))
}

/// What is used of a log has finite numbers and a range for every beam, and all of it is counted.
pub(super) fn carmen(bytes: &[u8]) -> Answer {
    let mut reader = LogReader::new(bytes);
    let mut count = 0;
    for entry in reader.by_ref() {
        count += 1;
        if let LogEntry::Scan(scan) | LogEntry::BareScan(scan) = entry {
            assert_eq!(scan.scan.ranges.len(), scan.scan.ring.beams as usize);
            let mut ranges = scan.scan.ranges.iter();
            assert!(ranges.all(|range| *range >= 0.0 && range.is_finite()));
            assert!(scan.odometry.is_finite() && scan.noted.is_finite() && scan.time.is_finite());
        }
    }
    assert_eq!(reader.report().scans + reader.report().odometry, count);
    match count {
        0 => Answer::Refused,
        _ => Answer::Taken,
    }
}

pub(super) fn relations(bytes: &[u8]) -> Answer {
    match ReadRelations::from_lines(bytes).relations.is_empty() {
        true => Answer::Refused,
        false => Answer::Taken,
    }
}

/// A trajectory is in order of time and of finite numbers.
pub(super) fn tum(bytes: &[u8]) -> Answer {
    let read = ReadTrajectory::parse(&String::from_utf8_lossy(bytes));
    if let Ok(read) = &read {
        assert!(read.poses.is_sorted_by(|a, b| a.time < b.time));
        let planar = read.planar();
        assert_eq!(planar.poses().len(), read.poses.len());
    }
    Answer::of(&read)
}

/// Returns a file of this process with these bytes, in a folder that is there.
fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = env::temp_dir().join(format!("tolman-fuzz-{}-{name}", process::id()));
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path
}

/// The same bytes as each of the files of a robot.
pub(super) fn utias(bytes: &[u8]) -> Answer {
    let barcodes = file("Barcodes.dat", b"1 5\n6 72\n");
    let folder = barcodes.parent().unwrap_or(Path::new("."));
    for name in ["Odometry", "Measurement", "Groundtruth"] {
        fs::write(folder.join(format!("Robot1_{name}.dat")), bytes).unwrap();
    }
    Answer::of(&UtiasRobot::read(folder, 1))
}

pub(super) fn tuc(bytes: &[u8]) -> Answer {
    Answer::of(&TucDrive::read(&file("in.txt", bytes)))
}

/// All scans of a table have as many ranges.
pub(super) fn sonar_table(bytes: &[u8]) -> Answer {
    let table = SonarTable::read(&file("sonar.data", bytes));
    if let Ok(table) = &table {
        assert_eq!(table.scans.len(), table.actions.len());
        let beams = table.scans.first().map_or(0, Vec::len);
        assert!(table.scans.iter().all(|scan| scan.len() == beams));
    }
    Answer::of(&table)
}

/// A pose graph has an edge, and reads as it was when it is written again.
pub(super) fn g2o(bytes: &[u8]) -> Answer {
    let graph = G2o::read(bytes);
    if let Ok(graph) = &graph {
        let again = G2o::parse(&graph.text()).expect("what was written is read");
        assert!(again.left_out.is_empty() && !again.edges.is_empty());
        assert_eq!(
            (&again.poses, again.edges.len()),
            (&graph.poses, graph.edges.len())
        );
    }
    Answer::of(&graph)
}

/// A bag of any kind, or a log of lines, packed or not.
pub(super) fn whole_log(bytes: &[u8]) -> Answer {
    match WholeLog::of_bytes(bytes.to_vec(), &LogOptions::whole()) {
        Ok(log) if !log.scans.is_empty() => Answer::Taken,
        _ => Answer::Refused,
    }
}

/// A trace is played again, and read alone.
pub(super) fn trace(bytes: &[u8]) -> Answer {
    let _ = Trace::<LaserPioneer>::read("a trace", bytes);
    Answer::of(&replay::<LaserPioneer>(bytes))
}

pub(super) fn trace_of_epuck(bytes: &[u8]) -> Answer {
    let _ = Trace::<Epuck>::read("a trace", bytes);
    Answer::of(&replay::<Epuck>(bytes))
}

pub(super) fn map_of_mslst(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let file = mslst::MapFile::from_json(text);
        if let Ok(file) = &file {
            file.to_json().expect("a map that was read can be written");
        }
        Answer::of(&file)
    })
}

pub(super) fn map_of_mslst_better(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let file = mslst::better::BetterMapFile::from_json(text);
        if let Ok(file) = &file {
            file.to_json().expect("a map that was read can be written");
        }
        Answer::of(&file)
    })
}

/// A map that is read has ways that can be planned.
pub(super) fn map_of_cpm(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let file = cpm::MapFile::from_json(text);
        if let Ok(file) = &file {
            file.to_json().expect("a map that was read can be written");
            if let Some(start) = file.map.start() {
                let _ = file.map.plan(start, |_| false);
            }
        }
        Answer::of(&file)
    })
}

pub(super) fn map_of_gngslam(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let file = gngslam::MapFile::from_json(text);
        if let Ok(file) = &file {
            file.to_json().expect("a map that was read can be written");
            let _ = file.graph.map();
        }
        Answer::of(&file)
    })
}

/// A survey that is read can be looked at, or says why not.
pub(super) fn map_of_diktiometry(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let Ok(file) = SurveyFile::from_json(text) else {
            return Answer::Refused;
        };
        file.to_json()
            .expect("a survey that was read can be written");
        let _ = (file.complaint(Task::Explore), file.goal());
        Answer::Taken
    })
}

/// A data set that is read is the same when it is written and read again.
pub(super) fn data_set(bytes: &[u8]) -> Answer {
    of_text(bytes, |text| {
        let set = DataSet::from_text(text);
        if let Ok(set) = &set
            && let Ok(written) = set.to_text()
        {
            assert!(DataSet::from_text(&written).is_ok());
        }
        Answer::of(&set)
    })
}

/// Runs agree with themselves, if they are runs at all.
pub(super) fn runs(bytes: &[u8]) -> Answer {
    let path = file("runs.jsonl", bytes);
    let folder = path.parent().unwrap_or(Path::new("."));
    let differences = compare(folder, folder);
    if let Ok(differences) = &differences {
        assert!(differences.is_empty(), "{differences}");
    }
    Answer::of(&differences)
}

/// A port at whose other end somebody says what they like.
struct Port<'a>(&'a [u8]);

impl Read for Port<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.read(bytes)
    }
}

impl Write for Port<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// What an e-puck says while a connection is opened and three steps are made.
pub(super) fn epuck_serial(bytes: &[u8]) -> Answer {
    let Ok(mut robot) = SerialEpuck::open(Port(bytes), 64_000, |_: Duration| {}) else {
        return Answer::Refused;
    };
    let speeds = WheelSpeeds {
        left: 0.0,
        right: 0.0,
    };
    for _ in 0..3 {
        if robot.step(&speeds).is_err() {
            return Answer::Refused;
        }
    }
    Answer::Taken
}

/// What a simulator of mms says to our mouse.
pub(super) fn mms_mouse(bytes: &[u8]) -> Answer {
    Answer::of(&play(bytes, io::sink(), io::sink(), Until::Goal))
}

/// What a mouse says to our host.
pub(super) fn mms_host(bytes: &[u8]) -> Answer {
    let maze = tolman_maze::read("+---+---+\n|     G |\n+   +   +\n| S |   |\n+---+---+\n");
    let maze = maze.expect("a maze").maze;
    let mut simulator = Simulator::new(&maze);
    let mut answered = Answer::Refused;
    for line in String::from_utf8_lossy(bytes).lines() {
        let exchange = Exchange::of(&mut simulator, line);
        let _ = exchange.sides_seen(maze.grid(), |cell, side| maze.is_open(cell, side));
        if exchange.reply.is_some_and(|reply| reply != "invalid") {
            answered = Answer::Taken;
        }
    }
    answered
}
