//! Where MSLST and its baselines run: the paper's two mazes, or the files that the caller names.

use std::fs;
use std::path::{Path, PathBuf};

use tolman_maze::MazeFile;

use crate::course::Course;
use crate::data;
use crate::experiment::BoxError;
use crate::pioneer;

/// One world with its table.
#[derive(Debug)]
pub(in crate::experiment) struct Venue {
    /// The name of its table in `summary.json`.
    pub(in crate::experiment) table: String,
    /// The title of its table.
    pub(in crate::experiment) title: String,
    pub(in crate::experiment) course: Course,
    pub(in crate::experiment) step_limit: u32,
    /// What the paper says of it.
    pub(in crate::experiment) paper: &'static [PaperRow],
}

/// A row of the paper's tables 2 and 3; means with their standard deviations.
#[derive(Debug)]
pub(in crate::experiment) struct PaperRow {
    pub(in crate::experiment) row: &'static str,
    pub(in crate::experiment) success_percent: f64,
    pub(in crate::experiment) actions: (f64, f64),
    pub(in crate::experiment) steps: (f64, f64),
}

const TABLE_2: &[PaperRow] = &[
    PaperRow {
        row: "Avoid",
        success_percent: 68.0,
        actions: (73.16, 70.231),
        steps: (109.48, 78.521),
    },
    PaperRow {
        row: "Wall-follow",
        success_percent: 92.0,
        actions: (43.68, 26.24),
        steps: (91.76, 56.421),
    },
    PaperRow {
        row: "MSLST 100",
        success_percent: 100.0,
        actions: (17.08, 16.088),
        steps: (38.12, 34.003),
    },
];

const TABLE_3: &[PaperRow] = &[
    PaperRow {
        row: "Avoid",
        success_percent: 40.0,
        actions: (247.32, 166.916),
        steps: (383.72, 173.098),
    },
    PaperRow {
        row: "Wall-follow",
        success_percent: 72.0,
        actions: (130.04, 83.414),
        steps: (278.52, 162.169),
    },
    PaperRow {
        row: "MSLST 20",
        success_percent: 92.0,
        actions: (69.72, 130.205),
        steps: (117.08, 130.452),
    },
    PaperRow {
        row: "MSLST 50",
        success_percent: 100.0,
        actions: (42.72, 41.733),
        steps: (103.2, 99.839),
    },
];

/// The paper's limits, time steps.
const J_STEPS: u32 = 200;
const LARGE_STEPS: u32 = 500;

/// Competition mazes that join in where they are found.
const COMPETITION: [&str; 2] = [
    "mazes/classic/taiwan2016f.txt",
    "mazes/classic/apec2016.txt",
];

/// The worlds for these files, or the default ones, and a remark on what is not there.
pub(in crate::experiment) fn venues(
    files: &[PathBuf],
) -> Result<(Vec<Venue>, Option<String>), BoxError> {
    if !files.is_empty() {
        return Ok((from_files(files)?, None));
    }
    let mut venues = papers()?;
    let Some(folder) = data::folder() else {
        return Ok((venues, Some(data::missing("competition mazes"))));
    };
    for file in COMPETITION {
        let path = folder.join(file);
        if path.exists() {
            venues.push(from_file(&path)?);
        }
    }
    Ok((venues, None))
}

/// The worlds of these files, each under a name of its own.
pub(in crate::experiment) fn from_files(files: &[PathBuf]) -> Result<Vec<Venue>, BoxError> {
    let venues: Result<Vec<Venue>, BoxError> = files.iter().map(|path| from_file(path)).collect();
    Ok(told_apart(venues?))
}

/// The paper's own worlds.
pub(in crate::experiment) fn papers() -> Result<Vec<Venue>, BoxError> {
    Ok(vec![
        Venue {
            table: "2 (J)".into(),
            title: "The J maze".into(),
            course: built_in("J", include_str!("../../../../../mazes/j.maze"))?,
            step_limit: J_STEPS,
            paper: TABLE_2,
        },
        Venue {
            table: "3 (Large)".into(),
            title: "The Large maze".into(),
            course: built_in("Large", include_str!("../../../../../mazes/large.maze"))?,
            step_limit: LARGE_STEPS,
            paper: TABLE_3,
        },
    ])
}

fn built_in(name: &str, text: &str) -> Result<Course, BoxError> {
    Ok(Course::new(
        name,
        &tolman_maze::read(text)?,
        &pioneer::body(),
    )?)
}

fn from_file(path: &Path) -> Result<Venue, BoxError> {
    let in_file = |source: BoxError| -> BoxError {
        Box::new(InFile {
            path: path.to_owned(),
            source,
        })
    };
    let text = fs::read_to_string(path).map_err(|error| in_file(error.into()))?;
    let file: MazeFile = tolman_maze::read(&text).map_err(|error| in_file(error.into()))?;
    // A maze's own name has no control characters; that of its file may, and terminals obey them.
    let stem = path
        .file_stem()
        .map(|stem| stem.to_string_lossy().replace(char::is_control, "\u{fffd}"));
    let name = file.name.clone().or(stem).unwrap_or_default();
    let course =
        Course::new(&name, &file, &pioneer::body()).map_err(|error| in_file(error.into()))?;
    Ok(Venue {
        table: name.clone(),
        title: format!("The maze {name}"),
        step_limit: course.step_limit(),
        course,
        paper: &[],
    })
}

/// Two files may bear one name, or that of the detector's table; the later ones get a number.
fn told_apart(mut venues: Vec<Venue>) -> Vec<Venue> {
    for index in 0..venues.len() {
        let name = venues[index].table.clone();
        let mut candidate = name.clone();
        let mut count = 1;
        while candidate == super::detector::NAME
            || venues[..index]
                .iter()
                .any(|before| before.table == candidate)
        {
            count += 1;
            candidate = format!("{name} ({count})");
        }
        venues[index].table = candidate;
    }
    venues
}

/// An error with the file it happened in.
#[derive(Debug, thiserror::Error)]
#[error("the maze file {path:?} cannot be used")]
struct InFile {
    path: PathBuf,
    source: BoxError,
}
