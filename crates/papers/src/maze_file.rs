//! The maze files of an experiment, and their names.

use std::path::{Path, PathBuf};

use tolman_formats::input;
use tolman_maze::MazeFile;

use tolman_experiment::BoxError;

/// Returns the maze in a file.
pub(super) fn read(path: &Path) -> Result<MazeFile, BoxError> {
    let text = input::text(path).map_err(|error| in_file(path, error))?;
    tolman_maze::read(&text).map_err(|error| in_file(path, error))
}

/// Returns an error with the file in which it occurred.
pub(super) fn in_file(path: &Path, source: impl Into<BoxError>) -> BoxError {
    Box::new(InFile {
        path: path.to_owned(),
        source: source.into(),
    })
}

#[derive(Debug, thiserror::Error)]
#[error("the maze file {path:?} cannot be used; correct it or name another")]
struct InFile {
    path: PathBuf,
    source: BoxError,
}

/// Returns the file's name without folder and extension. Control characters, which terminals would
/// obey, are made visible; a maze's own name has none.
pub(super) fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    stem.to_string_lossy().replace(char::is_control, "\u{fffd}")
}

/// Returns the name, with a number added if it is taken.
pub(super) fn told_apart(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut candidate = name.to_owned();
    let mut count = 1;
    while is_taken(&candidate) {
        count += 1;
        candidate = format!("{name} ({count})");
    }
    candidate
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_files_and_told_apart() {
        assert_eq!(stem(Path::new("a/b.1.maze")), "b.1");
        assert_eq!(stem(Path::new("a/bell\u{7}.maze")), "bell\u{fffd}");
        assert_eq!(stem(Path::new("..")), "..");
        let taken = ["hook", "hook (2)"];
        let is_taken = |name: &str| taken.contains(&name);
        assert_eq!(told_apart("hook", is_taken), "hook (3)");
        assert_eq!(told_apart("eye", is_taken), "eye");
    }
}
