//! `cargo xtask playground`: the systems compiled for browsers, in one page that opens from a file.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, anyhow, bail, ensure};
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::ci::Outcome;
use crate::workspace::{cargo, output, read, root, succeed, target_folder};

/// Target for which the module is compiled.
const TARGET: &str = "wasm32-unknown-unknown";

/// Path of the page, which has placeholders for the embedded files.
const PAGE: &str = "crates/playground/page/index.html";

/// Size that the page must stay below, bytes: it is sent by mail and opened on phones.
const LARGEST: usize = 5_000_000;

/// Builds the page and prints its size.
///
/// # Errors
/// If the target or wasm-bindgen is not installed, or something does not build.
pub(crate) fn run(out: Option<&Path>) -> Result<()> {
    if let Some(why) = missing()? {
        bail!("{why}");
    }
    let file = match out {
        Some(out) => env::current_dir()?.join(out),
        None => usual()?,
    };
    build(&file)
}

/// Builds the page and tests it in a browser, if all needed tools are installed.
///
/// # Errors
/// If something does not build, or a test of the page fails.
pub(crate) fn check() -> Result<Outcome> {
    if let Some(why) = missing()? {
        return Ok(Outcome::Missing(why));
    }
    let file = usual()?;
    build(&file)?;
    let mut test = cargo(
        "test --workspace --all-features --test browser --quiet -- --ignored playground pages_of_folders",
    );
    test.env("TOLMAN_PLAYGROUND", &file);
    succeed(test.env("TOLMAN_PAGES", folder()?))?;
    Ok(Outcome::Passed)
}

fn folder() -> Result<PathBuf> {
    Ok(target_folder()?.join("playground"))
}

fn usual() -> Result<PathBuf> {
    Ok(folder()?.join("tolman-playground.html"))
}

/// Returns the tool that is not installed, with the command that installs it.
pub(crate) fn missing() -> Result<Option<String>> {
    let installed =
        output(Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]))?;
    if !fs::exists(installed.trim())? {
        return Ok(Some(format!(
            "the target is missing: rustup target add {TARGET}"
        )));
    }
    let wanted = bindgen_version()?;
    let found = Command::new("wasm-bindgen").arg("--version").output();
    let found = found.map(|found| String::from_utf8_lossy(&found.stdout).trim().to_owned());
    let install = format!("cargo install wasm-bindgen-cli --version {wanted}");
    Ok(match found {
        Ok(found) if found == format!("wasm-bindgen {wanted}") => None,
        Ok(found) => Some(format!("{found} is installed: {install}")),
        Err(_) => Some(format!("wasm-bindgen is missing: {install}")),
    })
}

/// Returns the version of wasm-bindgen in the lock file; the program must have the same.
fn bindgen_version() -> Result<String> {
    let lock = read(&root().join("Cargo.lock"))?;
    let mut lines = lock.lines();
    lines.find(|line| *line == "name = \"wasm-bindgen\"");
    let version = lines.next().and_then(|line| line.split('"').nth(1));
    let version = version.ok_or_else(|| anyhow!("Cargo.lock names no wasm-bindgen"))?;
    Ok(version.to_owned())
}

fn build(file: &Path) -> Result<()> {
    succeed(&mut cargo(&format!(
        "build --quiet --profile wasm --target {TARGET} --package tolman-playground"
    )))?;
    let made = target_folder()?
        .join(TARGET)
        .join("wasm/tolman_playground.wasm");
    let folder = folder()?;
    fs::create_dir_all(&folder)?;
    let bound = target_folder()?.join(TARGET).join("wasm/bound");
    let mut bindgen = Command::new("wasm-bindgen");
    bindgen.args(["--target", "no-modules", "--no-typescript"]);
    bindgen.args([
        "--remove-name-section",
        "--remove-producers-section",
        "--out-dir",
    ]);
    succeed(bindgen.arg(&bound).arg(&made))?;
    let page = fill(&read(&root().join(PAGE))?, &bound)?;
    let size = page.len();
    ensure!(
        size < LARGEST,
        "the page has {size} bytes, and may have {LARGEST}: leave something out"
    );
    // The page is written under another name and then renamed, so that no incomplete page remains.
    let mut beside = OsString::from(file);
    beside.push(".new");
    fs::write(&beside, page).with_context(|| format!("cannot write {}", file.display()))?;
    fs::rename(&beside, file)?;
    let module = fs::metadata(bound.join("tolman_playground_bg.wasm"))?.len();
    eprintln!(
        "{}: {:.2} MB, of which the module has {:.2} MB",
        file.display(),
        size as f64 / 1e6,
        module as f64 / 1e6
    );
    Ok(())
}

/// Replaces the placeholders of the page by files of the workspace or of the folder `bound`. `{{
/// PATH }}` is a file's text, `{{ string PATH }}` the same as a string of JavaScript, and `{{ gzip
/// PATH }}` its bytes, compressed and in base64.
fn fill(page: &str, bound: &Path) -> Result<String> {
    let mut parts = page.split("{{ ");
    let mut filled = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (place, rest) = part
            .split_once(" }}")
            .with_context(|| format!("{PAGE}: a place is not closed"))?;
        let (form, path) = place.split_once(' ').unwrap_or(("", place));
        let path = match path.strip_prefix("bound/") {
            Some(name) => bound.join(name),
            None => root().join(path),
        };
        let bytes = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
        let text = match form {
            "gzip" => base64(&gzip(&bytes)?),
            "string" => serde_json::to_string(&String::from_utf8(bytes)?)?,
            _ => String::from_utf8(bytes)?,
        };
        ensure!(
            !text.contains("</"),
            "{}: `</` would end the part of the page that it stands in",
            path.display()
        );
        filled.push_str(&text);
        filled.push_str(rest);
    }
    Ok(filled)
}

/// Returns `bytes` in gzip, which browsers expand themselves.
fn gzip(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
    gzip.write_all(bytes)?;
    Ok(gzip.finish()?)
}

/// Returns `bytes` in base64.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let mut bits = [0; 4];
        bits[1..=three.len()].copy_from_slice(three);
        let bits = u32::from_be_bytes(bits);
        for letter in 0..4 {
            text.push(match letter <= three.len() {
                true => LETTERS[(bits >> (18 - 6 * letter) & 63) as usize].into(),
                false => '=',
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_rfc() {
        for (text, encoded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(text.as_bytes()), encoded);
        }
        assert_eq!(base64(&[0xfb, 0xff]), "+/8=");
    }

    #[test]
    fn a_place_is_filled_with_its_file() {
        let page = "<a>{{ string mazes/star.maze }}</a>";
        let filled = fill(page, Path::new("nowhere")).unwrap();
        assert!(filled.starts_with("<a>\"# A star") && filled.ends_with("\"</a>"));
        for wrong in ["{{ open", "{{ no/such/file }}", "{{ bound/x }}"] {
            assert!(fill(wrong, Path::new("nowhere")).is_err(), "{wrong}");
        }
    }

    #[test]
    fn every_place_of_the_page_names_a_file() {
        let page = read(&root().join(PAGE)).unwrap();
        let places = page
            .split("{{ ")
            .skip(1)
            .filter_map(|part| part.split_once(" }}"));
        let paths: Vec<&str> = places
            .map(|(place, _)| place.split(' ').next_back().unwrap_or_default())
            .collect();
        assert!(paths.len() >= 8, "{paths:?}");
        for path in paths.iter().filter(|path| !path.starts_with("bound/")) {
            assert!(root().join(path).exists(), "{path}");
        }
    }
}
