//! Hundreds of mazes other people drew, where they are at hand: the folder named by `TOLMAN_DATA`,
//! or `../shared/data` beside the checkout. They carry no licence, so they are not part of the
//! project.

use std::fs;
use std::io::{self, Write as _};
use std::path::PathBuf;

use tolman_maze::{
    CheckError, Direction, Format, MazeFault, MazeFile, WriteError, parse, read, write,
};

/// Returns the maze files of a folder and the folders in it, or none with a message.
fn files(folder: &str) -> Vec<PathBuf> {
    let data = std::env::var_os("TOLMAN_DATA").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data")),
        PathBuf::from,
    );
    let mut folders = vec![data.join("mazes").join(folder)];
    if !folders[0].is_dir() {
        // Written past the test harness, which would keep it to itself.
        let folder = folders[0].display();
        let mut stderr = io::stderr();
        writeln!(
            stderr,
            "SKIPPED: {folder} is not there; set TOLMAN_DATA to run this test"
        )
        .unwrap();
        return Vec::new();
    }
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Checks that every format holds the maze and gives it back, or names what it cannot hold.
fn round_trips(file: &MazeFile, own: Format) {
    for format in Format::ALL {
        match write(file, format) {
            Ok(text) => {
                assert_eq!(Format::detect(&text).unwrap(), format);
                assert_eq!(parse(&text).unwrap().maze, file.maze, "{format}");
            }
            Err(WriteError::Goals { goals, middle, .. }) => {
                assert!(
                    !matches!(
                        format,
                        Format::Mazefiles | Format::Boxes | Format::Tolman | Format::Blocks
                    ),
                    "{format}"
                );
                assert_ne!(goals, middle);
            }
            Err(WriteError::Shape { grid, .. }) => {
                assert!(matches!(format, Format::Numbers | Format::Maz), "{format}");
                assert!(grid.width() != grid.height() || ![16, 32].contains(&grid.width()));
            }
            Err(error) => panic!("{format}: {error}"),
        }
    }
    assert!(
        write(file, own).is_ok(),
        "a maze fits the format it came in"
    );
}

#[test]
fn competition_mazes_parse_solve_and_round_trip() {
    for folder in ["classic", "halfsize"] {
        let mut unsolvable = Vec::new();
        for path in files(folder) {
            let text = fs::read_to_string(&path).unwrap();
            let file = parse(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert_eq!(Format::detect(&text).unwrap(), Format::Mazefiles);
            assert_eq!(file.maze.start().unwrap().1, Direction::North);
            round_trips(&file, Format::Mazefiles);
            // Drawn again it is the file it came from, line ends and trailing blanks aside.
            let lines = |text: &str| {
                text.lines()
                    .map(|line| line.trim_end().to_owned())
                    .collect::<Vec<_>>()
            };
            let drawn = lines(&file.maze.to_string());
            assert_eq!(
                drawn,
                lines(&text.replace('+', "o"))[..drawn.len()],
                "{}",
                path.display()
            );
            match read(&text) {
                Ok(read) => assert_eq!(read, file),
                Err(error) => {
                    assert!(
                        matches!(error.fault, MazeFault::Maze(CheckError::NoWay { .. })),
                        "{error}"
                    );
                    unsolvable.push(path.file_name().unwrap().to_owned());
                }
            }
        }
        if folder == "classic" && !unsolvable.is_empty() {
            assert_eq!(unsolvable, ["001-anomaly-test.txt", "001.txt"]);
        } else {
            assert!(unsolvable.is_empty(), "{unsolvable:?}");
        }
    }
}

#[test]
fn the_papers_mazes_and_generated_ones_read_and_round_trip() {
    for folder in ["udacity", "generated"] {
        for path in files(folder) {
            let text = fs::read_to_string(&path).unwrap();
            let file = read(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            round_trips(&file, Format::Numbers);
            let again = write(&file, Format::Numbers).unwrap();
            assert_eq!(
                again.trim_end(),
                text.replace('\r', "").trim_end(),
                "{}",
                path.display()
            );
        }
    }
}

/// Compares the length of the shortest way, in cells, with the paper's for its three mazes.
#[test]
fn the_papers_mazes_have_the_papers_shortest_ways() {
    for (path, cells) in files("udacity").iter().zip([30, 43, 49]) {
        let maze = read(&fs::read_to_string(path).unwrap()).unwrap().maze;
        let (start, _) = maze.start().unwrap();
        assert_eq!(maze.steps_to_goal()[maze.grid().index(start)], Some(cells));
    }
}
