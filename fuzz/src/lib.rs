//! What must hold for every text, shared by the fuzz targets.
//!
//! ```text
//! cargo install cargo-fuzz
//! cargo +nightly fuzz run tolman -- -max_total_time=60
//! ```
//!
//! `cargo xtask ci` holds the parsers to the same on the stable compiler, with proptest's texts.

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
