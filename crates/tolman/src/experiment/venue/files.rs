//! The worlds that the caller names.

use std::fs;
use std::path::{Path, PathBuf};

use tolman_maze::MazeFile;

use super::Venue;
use crate::course::Course;
use crate::experiment::BoxError;
use crate::pioneer;

/// The worlds of these files, each under a name of its own that is none of those `taken` by other tables.
pub(in crate::experiment) fn from_files(
    files: &[PathBuf],
    taken: &[&str],
) -> Result<Vec<Venue>, BoxError> {
    let venues: Result<Vec<Venue>, BoxError> = files.iter().map(|path| from_file(path)).collect();
    Ok(told_apart(venues?, taken))
}

/// The world of a file.
pub(in crate::experiment) fn from_file(path: &Path) -> Result<Venue, BoxError> {
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

/// Two files may bear one name, or that of another table; the later ones get a number.
fn told_apart(mut venues: Vec<Venue>, taken: &[&str]) -> Vec<Venue> {
    for index in 0..venues.len() {
        let name = venues[index].table.clone();
        let mut candidate = name.clone();
        let mut count = 1;
        while taken.contains(&candidate.as_str())
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
