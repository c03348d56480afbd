use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::input;

/// Name of the file that describes a folder of ROS 2.
const METADATA: &str = "metadata.yaml";

/// Endings of bags, before that of a packing.
const ENDINGS: [&str; 3] = [".mcap", ".db3", ".bag"];

/// Returns the files of a folder that is a bag, in order, and how each of their messages is packed.
pub(crate) fn files(folder: &Path) -> io::Result<(Vec<PathBuf>, String)> {
    let Ok(metadata) = input::text(&folder.join(METADATA)) else {
        return Ok((listed(folder)?, String::new()));
    };
    let value = |name: &str| {
        let mut lines = metadata
            .lines()
            .filter_map(|line| line.trim().strip_prefix(name));
        unquoted(lines.next().unwrap_or_default()).to_owned()
    };
    let packed = match value("compression_mode:").to_ascii_lowercase().as_str() {
        "message" => value("compression_format:"),
        _ => String::new(),
    };
    let mut lines = metadata.lines().map(str::trim);
    let list = lines
        .by_ref()
        .find_map(|line| line.strip_prefix("relative_file_paths:"));
    let list = list.unwrap_or_default().trim();
    let names: Vec<&str> = match list.strip_prefix('[') {
        Some(list) => list.trim_end_matches(']').split(',').collect(),
        None => lines.map_while(|line| line.strip_prefix("- ")).collect(),
    };
    let names = names
        .into_iter()
        .map(unquoted)
        .filter(|name| !name.is_empty());
    // Older programs name the files with their folder.
    let file = |name: &str| {
        let path = folder.join(name);
        let beside = Path::new(name).file_name().map(|name| folder.join(name));
        beside.filter(|_| !path.exists()).unwrap_or(path)
    };
    let files: Vec<PathBuf> = names.map(file).collect();
    match files.is_empty() {
        true => Ok((listed(folder)?, packed)),
        false => Ok((files, packed)),
    }
}

fn unquoted(text: &str) -> &str {
    text.trim().trim_matches(['"', '\''])
}

/// Returns the bags in a folder, by name: numbers within names count as numbers.
fn listed(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if ENDINGS.iter().any(|ending| name.contains(ending)) && path.is_file() {
            files.push((name.len(), name, path));
        }
    }
    files.sort();
    Ok(files.into_iter().map(|(_, _, path)| path).collect())
}
