//! File operations with errors that name the file.

use std::fs;
use std::io;
use std::path::Path;

use super::Error;
use crate::files;

const REPAIR: &str = "check that the folder is writable and the disk is not full, or choose another \
                      folder with --out";

/// Returns `result` with action and path added to an error.
pub(super) fn at<T>(action: &'static str, path: &Path, result: io::Result<T>) -> Result<T, Error> {
    result.map_err(|source| Error::File {
        action,
        path: path.to_owned(),
        repair: REPAIR,
        source,
    })
}

/// Returns the same as [`at`], or `None` if there is nothing at the path.
pub(super) fn if_there<T>(
    action: &'static str,
    path: &Path,
    result: io::Result<T>,
) -> Result<Option<T>, Error> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        result => at(action, path, result).map(Some),
    }
}

/// Makes a folder and those above it.
pub(super) fn make_folder(path: &Path) -> Result<(), Error> {
    at("make the folder", path, fs::create_dir_all(path))
}

/// Calls [`files::write_whole`], with its name in the error.
pub(super) fn write_whole(path: &Path, contents: &[u8]) -> Result<(), Error> {
    at("write", path, files::write_whole(path, contents))
}
