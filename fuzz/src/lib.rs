//! What must hold for every text, shared by the fuzz targets.
//!
//! ```text
//! cargo install cargo-fuzz
//! cargo +nightly fuzz run tolman -- -max_total_time=60
//! ```
//!
//! `cargo xtask ci` holds the parsers to the same on the stable compiler, with proptest's texts.

use tolman_formats::{
    LogReader, G2o, GreyMap, LogEntry, ReadRelations, ReadTrajectory, RosMap, RosMapHeader,
};
use tolman_maze::{Format, parse_as, read, read_as, write};

/// A parser may refuse a text, but not panic; and what it takes, its format can hold and give back.
pub fn parses_or_refuses(text: &str, format: Format) {
    match parse_as(text, format) {
        Ok(file) => {
            let written = write(&file, format).expect("a maze fits the format it came in");
            let again = parse_as(&written, format).expect("what was written parses");
            assert_eq!(again.maze, file.maze);
            assert_eq!(read_as(text, format).is_ok(), file.maze.check().is_ok());
        }
        Err(error) => assert!(error.line >= 1 && error.column >= 1, "{error}"),
    }
}

/// The same for a format found by the text itself.
pub fn detects_or_refuses(text: &str) {
    if let Ok(format) = Format::detect(text) {
        parses_or_refuses(text, format);
    }
    let _ = read(text);
}

/// A picture has as many values as it says, none of them above its white.
pub fn is_a_picture_or_refused(bytes: &[u8]) {
    if let Ok(picture) = GreyMap::parse(bytes) {
        assert_eq!(picture.values.len(), picture.width * picture.height);
        assert!(picture.values.iter().all(|value| *value <= picture.most));
    }
}

/// A map has a cell for each value of its picture, and a size that is one.
pub fn is_a_header_or_refused(text: &str) {
    if let Ok(header) = RosMapHeader::parse(text) {
        let picture = GreyMap::parse(b"P2 2 1 2 0 1").expect("a picture");
        let map = RosMap::of(&header, &picture);
        assert!(map.cells.len() == 2 && map.resolution > 0.0 && map.resolution.is_finite());
    }
}

/// What is used of a log has finite numbers and a range for every beam, and all of it is counted.
pub fn is_used_or_left_out(bytes: &[u8]) {
    let mut reader = LogReader::new(bytes);
    let mut count = 0;
    for entry in reader.by_ref() {
        count += 1;
        if let LogEntry::Scan(scan) = entry {
            assert_eq!(scan.scan.ranges.len(), scan.scan.ring.beams as usize);
            assert!(scan.scan.ranges.iter().all(|range| *range >= 0.0 && range.is_finite()));
            assert!(scan.odometry.is_finite() && scan.noted.is_finite() && scan.time.is_finite());
        }
    }
    assert_eq!(reader.report().scans + reader.report().odometry, count);
    let _ = ReadRelations::from_lines(bytes);
    let _ = ReadTrajectory::from_lines(bytes);
}

/// A pose graph has an edge, and reads as it was when it is written again.
pub fn is_a_graph_or_refused(bytes: &[u8]) {
    if let Ok(graph) = G2o::read(bytes) {
        let again = G2o::parse(&graph.text()).expect("what was written is read");
        assert!(again.left_out.is_empty() && !again.edges.is_empty());
        assert_eq!((again.poses, again.edges.len()), (graph.poses, graph.edges.len()));
    }
}
