//! Writes files completely or not at all, and lists the files of a folder.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes a file completely or not at all. Readers see the old contents or the new ones, never a
/// part. The data is on the disk before the file is moved to its place.
///
/// A link is followed. A read-only file is left as it is. A device or a pipe is written to, not
/// replaced.
///
/// # Errors
/// The system's error; no new file is then left behind.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    let Ok(there) = fs::canonicalize(path) else {
        return move_into_place(path, contents);
    };
    let former = fs::metadata(&there)?;
    if !former.is_file() {
        return OpenOptions::new()
            .write(true)
            .open(&there)?
            .write_all(contents);
    }
    if former.permissions().readonly() {
        return Err(io::ErrorKind::PermissionDenied.into());
    }
    move_into_place(&there, contents)
}

fn move_into_place(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".tmp");
    let temporary = path.with_file_name(name);
    let written = File::create(&temporary).and_then(|mut file| {
        file.write_all(contents)?;
        file.sync_data()?;
        fs::rename(&temporary, path)
    });
    if written.is_err() {
        // The temporary file is useless; the error to report is the first one.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Returns the files directly in a folder, sorted by name.
///
/// # Errors
/// The system's error.
pub fn files_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let listed = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    let mut files: Vec<PathBuf> = listed.iter().map(fs::DirEntry::path).collect();
    files.retain(|path| path.is_file());
    files.sort();
    Ok(files)
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::{FileTypeExt, symlink};
    use std::{env, process};

    use super::*;

    #[test]
    fn links_are_followed_and_what_is_no_file_stays_what_it_is() {
        let folder = env::temp_dir().join(format!("tolman-files-{}", process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (file, link) = (folder.join("file"), folder.join("link"));
        fs::write(&file, "old").unwrap();
        symlink(&file, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());

        let mut permissions = fs::metadata(&file).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&file, permissions).unwrap();
        let refused = write_whole(&file, b"newer").unwrap_err();
        assert_eq!(refused.kind(), io::ErrorKind::PermissionDenied);

        // A copy of the name, so that a mistake costs a link and not the machine's device.
        let null = folder.join("null");
        symlink("/dev/null", &null).unwrap();
        write_whole(&null, b"gone").unwrap();
        assert!(
            fs::metadata("/dev/null")
                .unwrap()
                .file_type()
                .is_char_device()
        );
        fs::remove_dir_all(&folder).unwrap();
    }
}
