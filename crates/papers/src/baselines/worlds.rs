//! The worlds of the baselines: the paper's, competition mazes where they are found, or the
//! caller's.

use std::path::PathBuf;

use super::detector;
use crate::data;
use crate::venue::{self, Venue};
use tolman_experiment::BoxError;

/// Competition mazes that join in where they are found.
const COMPETITION: [&str; 2] = [
    "mazes/classic/taiwan2016f.txt",
    "mazes/classic/apec2016.txt",
];

/// Returns the worlds for these files, or the default ones, and a remark on what is not there.
pub(super) fn venues(files: &[PathBuf]) -> Result<(Vec<Venue>, Option<String>), BoxError> {
    if !files.is_empty() {
        return Ok((venue::from_files(files, &[detector::NAME])?, None));
    }
    let mut venues = Vec::from(venue::papers()?);
    let Some(folder) = data::folder() else {
        return Ok((venues, Some(data::missing("competition mazes"))));
    };
    for file in COMPETITION {
        let path = folder.join(file);
        if path.exists() {
            venues.push(venue::from_file(&path)?);
        }
    }
    Ok((venues, None))
}
