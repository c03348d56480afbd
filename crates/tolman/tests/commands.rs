//! Every command that README, the pages and the help texts show works. It is run as it stands, in a
//! folder that holds only `mazes` and `logs`. It ends with the exit code that a comment behind it
//! names, else 0.
//!
//! A debug build takes many minutes. `TOLMAN` may name another one:
//! `cargo build --release -p tolman`, then
//! `TOLMAN=target/debug/tolman cargo test -p tolman --test commands -- --ignored`.
#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![expect(clippy::print_stderr, reason = "it says what takes long")]
#![cfg(unix)]

extern crate alloc;

use alloc::sync::Arc;
use std::collections::HashMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::{Mutex, OnceLock};
use std::thread;
use std::time::Instant;

/// Returns the command: what `TOLMAN` names, else the one built with this test.
fn tolman() -> PathBuf {
    let named = std::env::var_os("TOLMAN").map(|path| root().join(path));
    named.unwrap_or_else(|| env!("CARGO_BIN_EXE_tolman").into())
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs a line as a shell does in `folder`.
fn sh(folder: &Path, line: &str) -> Output {
    let bin = tolman();
    let bin = bin.parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let mut command = Command::new("sh");
    command.args(["-c", line]).current_dir(folder);
    command.env("PATH", path).env("HOME", folder);
    command.stdin(Stdio::null()).output().unwrap()
}

/// Returns a command and the exit code it should have.
fn expected(line: &str) -> (String, i32) {
    let (command, comment) = line.split_once(" # ").unwrap_or((line, ""));
    let code = comment.trim().strip_prefix("exits ");
    let code = code.map_or(0, |code| code.trim().parse().unwrap());
    let command = command.trim();
    // A picture in the terminal needs one.
    if command.contains("--live") {
        return (
            format!("script --quiet --return --command \"{command}\" /dev/null"),
            code,
        );
    }
    (command.to_owned(), code)
}

/// What every reader has.
const GIVEN: [&str; 2] = ["mazes", "logs"];

/// Returns an empty folder of this name, with what every reader has.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("commands")
        .join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    for given in GIVEN {
        let from = root().join(given).canonicalize().unwrap();
        symlink(from, folder.join(given)).unwrap();
    }
    folder
}

/// Where a line wrote, and how it ended, once it has run.
type Once = Arc<OnceLock<(PathBuf, Output)>>;

/// The lines that needed nothing of the lines before them. Several pages show some of them.
#[derive(Default)]
struct Ran(Mutex<HashMap<String, Once>>);

impl Ran {
    /// Runs a line in `page`, or copies there what it wrote for another page.
    fn run(&self, page: &Path, line: &str) -> Output {
        let needs = |word: &str| {
            let word = word.trim_matches('\'');
            page.join(word).exists() && !GIVEN.iter().any(|given| word.starts_with(given))
        };
        if line.split_whitespace().any(needs) {
            return sh(page, line);
        }
        let (number, ran) = {
            let mut all = self.0.lock().unwrap();
            (
                all.len(),
                Arc::clone(all.entry(line.to_owned()).or_default()),
            )
        };
        let (made, output) = ran.get_or_init(|| {
            let made = folder(&format!("line-{number}"));
            let output = sh(&made, line);
            for given in GIVEN {
                fs::remove_file(made.join(given)).unwrap();
            }
            (made, output)
        });
        let copied = Command::new("cp")
            .arg("-r")
            .arg(made.join("."))
            .arg(page)
            .status();
        assert!(copied.unwrap().success());
        output.clone()
    }
}

/// Runs the lines of one page one by one and returns what went wrong.
fn run(ran: &Ran, page: &str, lines: &[String]) -> Vec<String> {
    let folder = folder(&page.replace(['/', ' '], "-"));
    let mut wrong = Vec::new();
    for line in lines {
        let (command, code) = expected(line);
        if command.contains("python3") && Command::new("python3").arg("-V").output().is_err() {
            continue;
        }
        let begun = Instant::now();
        let output = ran.run(&folder, &command);
        eprintln!("{:7.1} s  {page}: {line}", begun.elapsed().as_secs_f64());
        if output.status.code() != Some(code) {
            let err = String::from_utf8_lossy(&output.stderr);
            wrong.push(format!(
                "{page}: `{line}` ends with {}: {err}",
                output.status
            ));
        }
    }
    wrong
}

/// Returns the lines of a page that call `tolman`: those of its fenced blocks, and what its tables
/// say under *you type*.
fn commands_of_page(text: &str) -> Vec<String> {
    let tables = text
        .split("\n\n")
        .filter(|part| part.contains("| you type |"));
    let typed = tables.flat_map(|table| table.split('`').skip(1).step_by(2));
    let blocks = text.split("\n```").skip(1).step_by(2);
    let lines = blocks.flat_map(str::lines).map(|line| {
        let line = line.strip_prefix("$ ").unwrap_or(line);
        line.replace("cargo run --release -p tolman --", "tolman")
    });
    let typed = typed.map(str::to_owned);
    lines
        .chain(typed)
        .filter(|line| line.starts_with("tolman "))
        .collect()
}

/// Returns the examples of a verb's help.
fn commands_of_help(verb: &[String]) -> Vec<String> {
    let help = Command::new(tolman())
        .args(verb)
        .arg("--help")
        .output()
        .unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let lines = help.lines().map(str::trim);
    lines
        // A second line of usage is not a command.
        .filter(|line| line.starts_with("tolman ") && !line.ends_with("<COMMAND>"))
        .map(str::to_owned)
        .collect()
}

/// Returns the verbs below `verb`, by the list that its help begins with.
fn verbs(verb: &[String]) -> Vec<Vec<String>> {
    let help = Command::new(tolman())
        .args(verb)
        .arg("--help")
        .output()
        .unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let listed = help.split("Commands:\n").nth(1).unwrap_or_default();
    let names = listed.lines().take_while(|line| !line.is_empty());
    let names = names.filter_map(|line| line.split_whitespace().next());
    let below = names.filter(|name| *name != "help").map(|name| {
        let mut below = verb.to_vec();
        below.push(name.to_owned());
        below
    });
    let mut found = vec![verb.to_vec()];
    found.extend(below.flat_map(|verb| verbs(&verb)));
    found
}

/// Runs all pages, each in a folder of its own, as many at a time as there are cores, and returns
/// what went wrong.
fn run_all(pages: Vec<(String, Vec<String>)>) -> Vec<String> {
    let left = Mutex::new(pages.into_iter());
    let ran = Ran::default();
    let work = || {
        let mut wrong = Vec::new();
        let next = || left.lock().unwrap().next();
        while let Some((page, lines)) = next() {
            wrong.extend(run(&ran, &page, &lines));
        }
        wrong
    };
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        let ended = workers
            .into_iter()
            .flat_map(|worker| worker.join().unwrap());
        ended.collect()
    })
}

#[test]
#[ignore = "takes many minutes in a debug build"]
fn every_command_that_is_shown_works() {
    let mut pages = vec![root().join("README.md")];
    let docs = fs::read_dir(root().join("docs")).unwrap();
    pages.extend(docs.map(|entry| entry.unwrap().path()));
    pages.retain(|page| page.extension().is_some_and(|extension| extension == "md"));
    pages.sort();
    let of_pages = pages.into_iter().map(|page| {
        let lines = commands_of_page(&fs::read_to_string(&page).unwrap());
        (
            page.file_name().unwrap().to_string_lossy().into_owned(),
            lines,
        )
    });
    let of_help = verbs(&[]).into_iter().map(|verb| {
        let name = format!("tolman {} --help", verb.join(" "));
        (name, commands_of_help(&verb))
    });
    let all: Vec<(String, Vec<String>)> = of_pages.chain(of_help).collect();
    let count: usize = all.iter().map(|(_, lines)| lines.len()).sum();
    let wrong = run_all(all);
    assert!(count > 60, "only {count} commands are shown");
    assert!(
        wrong.is_empty(),
        "{} of {count} fail:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
