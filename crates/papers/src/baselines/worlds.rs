//! The worlds of the baselines: the paper's, competition mazes if they are here, or the caller's.

use std::path::PathBuf;

use super::detector;
use crate::data;
use crate::venue::{self, Venue};
use tolman_experiment::BoxError;

/// Competition mazes, used if they are here.
const COMPETITION: [&str; 2] = [
    "mazes/classic/taiwan2016f.txt",
    "mazes/classic/apec2016.txt",
];

/// Returns the worlds of these files, or the default ones, and a note on missing ones.
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
