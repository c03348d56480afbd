//! The workspace's folders, and how to start other programs there.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use anyhow::{Context, Result, ensure};
use serde_json::Value;

/// Returns the folder of the workspace's `Cargo.toml`.
pub(crate) fn root() -> &'static Path {
    let xtask = Path::new(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().unwrap_or(xtask)
}

/// Returns the cargo that runs this chore.
pub(crate) fn cargo_program() -> PathBuf {
    env::var_os("CARGO").map_or_else(|| PathBuf::from("cargo"), PathBuf::from)
}

/// Returns `cargo` with these arguments, separated by spaces, in the workspace's root.
pub(crate) fn cargo(arguments: &str) -> Command {
    let mut command = Command::new(cargo_program());
    command
        .current_dir(root())
        .args(arguments.split_whitespace());
    command
}

/// Returns the workspace's members in the JSON of `cargo metadata`.
///
/// # Errors
/// If cargo cannot read a manifest.
pub(crate) fn metadata() -> Result<Value> {
    let text = output(&mut cargo("metadata --format-version 1 --no-deps"))?;
    serde_json::from_str(&text).context("`cargo metadata` is not JSON")
}

/// Returns the text of a file.
pub(crate) fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))
}

/// Returns the paths in a folder, sorted by name.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries =
        fs::read_dir(folder).with_context(|| format!("cannot read {}", folder.display()))?;
    let mut paths: Vec<_> = entries
        .map(|entry| Ok(entry?.path()))
        .collect::<Result<_>>()?;
    paths.sort();
    Ok(paths)
}

/// Returns the Rust files in a folder and below, sorted by path.
pub(crate) fn rust_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in entries(folder)? {
        if path.is_dir() {
            files.extend(rust_files(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

/// Returns the folder that cargo builds into.
///
/// # Errors
/// As [`metadata`].
pub(crate) fn target_folder() -> Result<PathBuf> {
    let metadata = metadata()?;
    let folder = metadata["target_directory"].as_str();
    folder
        .map(PathBuf::from)
        .context("cargo names no target folder")
}

/// Returns a command of the workspace as the tests built it, in the workspace's root.
///
/// # Errors
/// As [`metadata`].
pub(crate) fn built(name: &str) -> Result<Command> {
    let mut command = Command::new(target_folder()?.join("debug").join(name));
    command.current_dir(root());
    Ok(command)
}

/// Runs a command to its end.
///
/// # Errors
/// If it cannot be started or does not exit with 0.
pub(crate) fn succeed(command: &mut Command) -> Result<()> {
    let shown = shown(command);
    let status = command
        .status()
        .with_context(|| format!("cannot start `{shown}`"))?;
    ensure!(status.success(), "`{shown}` failed: {status}");
    Ok(())
}

/// Runs a command to its end and returns its stdout.
///
/// # Errors
/// If it cannot be started, does not exit with 0, or does not write UTF-8.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    let shown = shown(command);
    let output = command
        .output()
        .with_context(|| format!("cannot start `{shown}`"))?;
    ensure!(
        output.status.success(),
        "`{shown}` failed: {}\n{}",
        output.status,
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).with_context(|| format!("`{shown}` did not write UTF-8"))
}

/// Returns whether `program` can be started.
pub(crate) fn installed(program: &str) -> bool {
    // Some of cargo's subcommands know what they are called by alone.
    let mut command = match program.strip_prefix("cargo-") {
        Some(subcommand) => cargo(subcommand),
        None => Command::new(program),
    };
    command
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success())
}

fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program());
    let mut words = vec![program.file_name().unwrap_or_default().to_string_lossy()];
    words.extend(command.get_args().map(std::ffi::OsStr::to_string_lossy));
    words.join(" ")
}
