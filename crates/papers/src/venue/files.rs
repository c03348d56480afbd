//! Reads worlds from files that the caller names.

use std::path::{Path, PathBuf};

use super::Venue;
use crate::maze_file;
use tolman_arena::course::Course;
use tolman_arena::pioneer;
use tolman_experiment::BoxError;

/// Returns the worlds of these files, each with its own name that is not `taken` by other tables.
pub(crate) fn from_files(files: &[PathBuf], taken: &[&str]) -> Result<Vec<Venue>, BoxError> {
    let mut venues: Vec<Venue> = Vec::new();
    for path in files {
        let mut venue = from_file(path)?;
        venue.table = maze_file::told_apart(&venue.table, |name| {
            taken.contains(&name) || venues.iter().any(|before| before.table == name)
        });
        venues.push(venue);
    }
    Ok(venues)
}

/// Returns the world of a file.
pub(crate) fn from_file(path: &Path) -> Result<Venue, BoxError> {
    let file = maze_file::read(path)?;
    let name = file.name.clone().unwrap_or_else(|| maze_file::stem(path));
    let course = Course::for_body(&name, &file, &pioneer::body())
        .map_err(|error| maze_file::in_file(path, error))?;
    let (title, steps) = (format!("The maze {name}"), course.step_limit());
    Ok(Venue::new(&name, &title, course, steps))
}
