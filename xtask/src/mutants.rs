//! `cargo xtask mutants`: checks that the tests notice small changes of the code.

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::ci::{Outcome, with};
use crate::workspace::{cargo, read, target_folder};

/// Crates whose wrong results show nowhere at once, so that only tests find them.
const PACKAGES: &[&str] = &[
    "tolman-geom",
    "tolman-maze",
    "tolman-planners",
    "tolman-quantizers",
    "tolman-maps",
];

/// Minimum share of the changes that the tests have to notice, %.
const LEAST: u64 = 92;

/// Time limit for the tests of one change, seconds. A change that exceeds it counts as noticed.
const TIME: &str = "300";

/// Files of tests alone, whose changes say nothing about the code.
const TESTS: &str = "**/tests.rs";

/// Choice of the changes that are tried: of all, every `of`-th one from the `first` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shard {
    pub(crate) first: u32,
    pub(crate) of: u32,
}

impl Shard {
    /// Parses a shard written as K/N.
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let parts = text.split_once('/');
        let read = parts.and_then(|(first, of)| {
            let (first, of) = (first.parse().ok()?, of.parse().ok()?);
            (first < of).then_some(Self { first, of })
        });
        read.context("give K/N with K < N, such as 3/60")
    }
}

/// Tries a share of the changes of these crates, or of all crates, each with the tests of its own
/// crate, in a copy of the workspace.
///
/// # Errors
/// If the tests notice too few, or cannot be built.
pub(crate) fn check(shard: Shard, packages: &[String]) -> Result<Outcome> {
    with("cargo-mutants", "cargo install cargo-mutants", || {
        tried(shard, packages)?.check()?;
        Ok(Outcome::Passed)
    })
}

/// Tries the changes.
fn tried(shard: Shard, packages: &[String]) -> Result<Tried> {
    let folder = target_folder()?.join("mutants");
    let Shard { first, of } = shard;
    let mut mutants = cargo("mutants --baseline skip --all-features --no-shuffle --jobs 1");
    let named = packages.iter().map(String::as_str);
    let all = PACKAGES.iter().copied().filter(|_| packages.is_empty());
    for package in named.chain(all) {
        mutants.args(["--package", package]);
    }
    mutants.args(["--sharding", "round-robin", "--shard"]);
    mutants.arg(format!("{first}/{of}"));
    mutants.args(["--exclude", TESTS, "--timeout", TIME]);
    mutants.arg("--output").arg(&folder);
    // Dependencies are compiled once, not in every copy again.
    mutants.env("CARGO_TARGET_DIR", folder.join("build"));
    // Its exit code says less than its output.
    mutants.status().context("cannot start cargo mutants")?;
    let folder = folder.join("mutants.out");
    eprint!("{}", read(&folder.join("missed.txt"))?);
    Tried::of(&read(&folder.join("outcomes.json"))?)
}

/// Result of the changes that compile.
#[derive(Debug, PartialEq)]
struct Tried {
    noticed: u64,
    missed: u64,
}

impl Tried {
    /// Reads the counts of `outcomes.json`.
    fn of(text: &str) -> Result<Self> {
        let outcomes: Value = serde_json::from_str(text).context("outcomes.json")?;
        let count = |name: &str| {
            let count = outcomes.get(name).and_then(Value::as_u64);
            count.with_context(|| format!("outcomes.json has no count `{name}`"))
        };
        Ok(Self {
            noticed: count("caught")? + count("timeout")?,
            missed: count("missed")?,
        })
    }

    /// Checks that enough of the changes were noticed.
    fn check(&self) -> Result<()> {
        let Self { noticed, missed } = *self;
        let all = noticed + missed;
        ensure!(all > 0, "nothing was changed: give a larger share");
        let told = format!("the tests notice {noticed} of {all} changes");
        eprintln!("{told}");
        ensure!(
            100 * noticed >= LEAST * all,
            "{told}, under {LEAST} %: add tests, or give the reason in docs/notebook/hardening.md"
        );
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shard_is_one_of_some() {
        assert_eq!(Shard::parse("3/60").unwrap(), Shard { first: 3, of: 60 });
        for wrong in ["3", "60/60", "-1/3", "1/x", ""] {
            assert!(Shard::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_share_that_is_noticed_is_what_counts() {
        let text = r#"{"caught": 91, "timeout": 1, "missed": 8, "unviable": 30}"#;
        let tried = Tried::of(text).unwrap();
        assert_eq!(
            tried,
            Tried {
                noticed: 92,
                missed: 8
            }
        );
        assert!(tried.check().is_ok());
        for (noticed, missed) in [(91, 9), (0, 0)] {
            assert!(Tried { noticed, missed }.check().is_err());
        }
        assert!(Tried::of(r#"{"caught": 91, "missed": 8}"#).is_err());
    }
}
