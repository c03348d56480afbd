//! Writes files completely or not at all, and lists the files of a folder.

use core::hash::{BuildHasher, Hasher};
use std::fs::{self, File, OpenOptions};
use std::hash::RandomState;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes a file completely or not at all. Readers see the old contents or the new ones, never a
/// part. The data is on the disk before the file is moved to its place. Of two writers at a time,
/// the last to end wins.
///
/// A link is followed. A read-only file is left as it is. A device or a pipe is written to, not
/// replaced.
///
/// # Errors
/// The system's error; no new file is then left behind.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    match Replacement::of(path)? {
        Some(new) => new.take_place(contents),
        None => OpenOptions::new()
            .write(true)
            .open(path)?
            .write_all(contents),
    }
}

/// Checks that [`write_whole`] can write to `path`, and changes nothing there.
///
/// # Errors
/// The system's error.
pub fn check_writable(path: &Path) -> io::Result<()> {
    Replacement::of(path).map(drop)
}

/// A new file beside the one that it is to replace. It is removed unless it takes its place.
struct Replacement {
    path: PathBuf,
    temporary: PathBuf,
    file: File,
}

impl Replacement {
    /// Makes an empty file; `None` if `path` is a device or a pipe, which cannot be replaced.
    fn of(path: &Path) -> io::Result<Option<Self>> {
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let former = fs::metadata(&path).ok();
        match former.as_ref().map(fs::Metadata::file_type) {
            Some(kind) if kind.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Some(kind) if !kind.is_file() => return Ok(None),
            _ => {}
        }
        let mode = former.map(|former| former.permissions());
        if mode.as_ref().is_some_and(fs::Permissions::readonly) {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        loop {
            // Nobody can foresee the name, and a link of that name is not followed.
            let name = format!(".{:016x}.tmp", RandomState::new().build_hasher().finish());
            let temporary = path.with_file_name(name);
            match File::create_new(&temporary) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                file => {
                    let new = Self {
                        path,
                        temporary,
                        file: file?,
                    };
                    mode.map_or(Ok(()), |mode| new.file.set_permissions(mode))?;
                    return Ok(Some(new));
                }
            }
        }
    }

    fn take_place(mut self, contents: &[u8]) -> io::Result<()> {
        self.file.write_all(contents)?;
        self.file.sync_all()?;
        fs::rename(&self.temporary, &self.path)
    }
}

impl Drop for Replacement {
    fn drop(&mut self) {
        // It is gone if it has taken its place; else the error to report is the first one.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// Returns what lies directly in a folder and is no folder, sorted by name. It may be a link to
/// nothing.
///
/// # Errors
/// The system's error.
pub fn files_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let listed = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    let mut files: Vec<PathBuf> = listed.iter().map(fs::DirEntry::path).collect();
    files.retain(|path| !path.is_dir());
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
        assert!(check_writable(&file).is_err() && check_writable(&folder).is_err());
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
