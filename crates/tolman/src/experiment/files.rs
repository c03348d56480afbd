//! Files that are whole or not there.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

use super::Error;

const REPAIR: &str = "check that the folder is writable and the disk is not full, or choose another \
                      folder with --out";

/// Names what was tried on which path when the system refuses.
pub(super) fn at<T>(action: &'static str, path: &Path, result: io::Result<T>) -> Result<T, Error> {
    result.map_err(|source| Error::File {
        action,
        path: path.to_owned(),
        repair: REPAIR,
        source,
    })
}

/// Makes a folder and those above it.
pub(super) fn make_folder(path: &Path) -> Result<(), Error> {
    at("make the folder", path, fs::create_dir_all(path))
}

/// Writes a file beside its place and moves it there, so that a reader sees the former file or the
/// new one, never a part. The data are on the disk before the move.
pub(super) fn write_whole(path: &Path, contents: &[u8]) -> Result<(), Error> {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".tmp");
    let temporary = path.with_file_name(name);
    let written = File::create(&temporary).and_then(|mut file| {
        file.write_all(contents)?;
        file.sync_data()
    });
    if written.is_err() {
        // What is left of it is of no use; the error that matters is the first one.
        let _ = fs::remove_file(&temporary);
    }
    at("write", path, written)?;
    at("write", path, fs::rename(&temporary, path))
}
