//! Tells the crate which commit and compiler it is built from, for the reports.

use std::path::Path;
use std::process::Command;

/// Git folder of the project's own repository, relative to this crate.
const REPOSITORY: &str = "../../.git";
/// File that exists beside this crate only in that repository.
const NEIGHBOUR: &str = "../geom/Cargo.toml";

fn main() {
    let commit = if is_checkout() {
        // Any change of the sources may make the tree differ from its commit, and the log of HEAD
        // grows with every commit and checkout.
        println!("cargo::rerun-if-changed=..");
        let log = format!("{REPOSITORY}/logs/HEAD");
        if Path::new(&log).exists() {
            println!("cargo::rerun-if-changed={log}");
        }
        commit()
    } else {
        println!("cargo::rerun-if-changed=build.rs");
        None
    };
    let compiler = std::env::var("RUSTC")
        .ok()
        .and_then(|rustc| output(&rustc, &["--version"]));
    println!(
        "cargo::rustc-env=TOLMAN_COMMIT={}",
        commit.as_deref().unwrap_or(env!("CARGO_PKG_VERSION"))
    );
    println!(
        "cargo::rustc-env=TOLMAN_COMPILER={}",
        compiler.as_deref().unwrap_or("unknown")
    );
}

/// Returns whether this crate lies in the project's repository. In a package or in another
/// project's sources, the commit would be that of other code.
fn is_checkout() -> bool {
    Path::new(REPOSITORY).exists() && Path::new(NEIGHBOUR).exists()
}

/// Returns the commit, marked if the sources differ from it.
fn commit() -> Option<String> {
    let commit = output("git", &["rev-parse", "--short=10", "HEAD"])?;
    let changes = output(
        "git",
        &["status", "--porcelain", "--untracked-files=no", ".."],
    )?;
    Some(if changes.is_empty() {
        commit
    } else {
        format!("{commit}-dirty")
    })
}

/// Returns the first line a program prints, if it can be run and succeeds.
fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output
        .status
        .success()
        .then(|| text.lines().next().unwrap_or_default().to_owned())
}
