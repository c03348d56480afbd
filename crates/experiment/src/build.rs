//! The program that made the results.

use std::fs;

use serde::{Deserialize, Serialize};

use super::hash::fnv64;

/// The build that plays the runs. Results of different builds are never mixed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Build {
    /// Commit that the program was built from, or `unknown`.
    pub commit: String,
    /// Name and version of the compiler.
    pub compiler: String,
    /// Hash of the running executable, or `unknown` if it cannot be read.
    pub executable: String,
}

impl Build {
    /// Returns the build of the running program, made from this `commit` by this `compiler`. Reads
    /// the executable once.
    pub fn current(commit: &str, compiler: &str) -> Self {
        let executable = std::env::current_exe().and_then(fs::read);
        Self {
            commit: commit.to_owned(),
            compiler: compiler.to_owned(),
            executable: executable.map_or_else(
                |_| "unknown".to_owned(),
                |bytes| format!("{:016x}", fnv64(&bytes)),
            ),
        }
    }
}
