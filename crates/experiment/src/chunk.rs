//! Shares of an experiment's runs, for more than one machine.

use alloc::collections::{BTreeMap, BinaryHeap};
use core::cmp::Reverse;
use core::fmt;
use core::str::FromStr;
use std::path::{Path, PathBuf};

use super::at::{at, if_there};
use super::runs_file::Key;
use super::{Error, Job, Procedure};

/// One of several shares of an experiment's runs, written `3/8`.
///
/// Runs that [share](Procedure::shares) work are in one chunk. The chunk of a run depends only on
/// the experiment and the number of runs, so machines need not communicate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Chunk {
    number: u32,
    of: u32,
}

/// A text that is not a chunk.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is not a chunk; write I/K for the I-th of K, such as 3/8, with I from 1 to K and K up \
     to {}",
    Chunk::MOST
)]
pub struct ChunkError {
    text: String,
}

impl Chunk {
    /// Maximum number of chunks of an experiment.
    pub const MOST: u32 = 100_000;

    /// Returns the chunk `number` of `of`, counted from 1; `None` if there is no such chunk.
    pub const fn new(number: u32, of: u32) -> Option<Self> {
        if number >= 1 && number <= of && of <= Self::MOST {
            Some(Self { number, of })
        } else {
            None
        }
    }

    /// Returns the folder of this chunk's results under the experiment's.
    pub fn folder_in(self, results: &Path) -> PathBuf {
        results.join(format!("chunk-{}-of-{}", self.number, self.of))
    }

    /// Returns the chunk whose results a folder of this name holds; `None` if it is another folder.
    pub(super) fn of_folder(name: &str) -> Option<Self> {
        let (number, of) = name.strip_prefix("chunk-")?.split_once("-of-")?;
        Self::new(number.parse().ok()?, of.parse().ok()?)
    }

    /// Returns the chunks in a folder of results, in order.
    pub(super) fn all_in(results: &Path) -> Result<Vec<Self>, Error> {
        let action = "read the folder";
        let mut chunks = Vec::new();
        let entries = if_there(action, results, std::fs::read_dir(results))?;
        for entry in entries.into_iter().flatten() {
            let name = at(action, results, entry)?.file_name();
            chunks.extend(name.to_str().and_then(Self::of_folder));
        }
        chunks.sort_unstable();
        Ok(chunks)
    }

    /// Returns the number of chunks that this one belongs to.
    pub(super) const fn of(self) -> u32 {
        self.of
    }

    /// Returns the jobs of this chunk, in the order of `jobs`.
    pub(super) fn take<'a>(
        self,
        jobs: Vec<(Key, Job<'a>)>,
        procedure: &dyn Procedure,
    ) -> Vec<(Key, Job<'a>)> {
        let mut dealt = deal(&jobs, self.of, procedure).into_iter();
        let mine = |_: &(Key, Job<'a>)| dealt.next() == Some(self.number);
        jobs.into_iter().filter(mine).collect()
    }
}

/// Returns the number of the chunk of each job. Jobs that share work go together to the chunk with
/// the fewest runs so far.
///
/// Complexity: O(n log (n `chunks`)) for n jobs.
pub(super) fn deal(jobs: &[(Key, Job<'_>)], chunks: u32, procedure: &dyn Procedure) -> Vec<u32> {
    let mut lots: Vec<Vec<usize>> = Vec::new();
    let mut shared = BTreeMap::new();
    for (place, (_, job)) in jobs.iter().enumerate() {
        let lot = match procedure.shares(job) {
            Some(work) => *shared.entry(work).or_insert(lots.len()),
            None => lots.len(),
        };
        if lot == lots.len() {
            lots.push(Vec::new());
        }
        lots[lot].push(place);
    }
    let mut loads: BinaryHeap<_> = (1..=chunks).map(|chunk| Reverse((0, chunk))).collect();
    let mut dealt = vec![0; jobs.len()];
    for lot in lots {
        let Some(mut least) = loads.peek_mut() else {
            break;
        };
        let Reverse((load, chunk)) = &mut *least;
        *load += lot.len();
        for place in lot {
            dealt[place] = *chunk;
        }
    }
    dealt
}

impl fmt::Display for Chunk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Chunk {
    type Err = ChunkError;

    fn from_str(text: &str) -> Result<Self, ChunkError> {
        let named = text.split_once('/');
        named
            .and_then(|(number, of)| Self::new(number.parse().ok()?, of.parse().ok()?))
            .ok_or_else(|| ChunkError {
                text: text.to_owned(),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BoxError, Fields};

    /// Procedure whose runs of the same map are in one chunk. Runs of the row "alone" share
    /// nothing.
    #[derive(Debug)]
    struct Maps(u32);

    impl Procedure for Maps {
        fn run(&self, _job: &Job<'_>) -> Result<Fields, BoxError> {
            Ok(Fields::default())
        }

        fn shares(&self, job: &Job<'_>) -> Option<String> {
            (job.row != "alone").then(|| format!("{} {}", job.row, job.run % self.0))
        }
    }

    fn jobs(rows: &[&'static str], runs: u32) -> Vec<(Key, Job<'static>)> {
        let mut jobs = Vec::new();
        for (place, row) in rows.iter().enumerate() {
            jobs.extend((0..runs).map(|run| ((0, place, run), Job::of(1, "table", row, run))));
        }
        jobs
    }

    #[test]
    fn every_run_is_in_one_chunk_with_what_it_shares() {
        let jobs = jobs(&["a", "b", "alone"], 30);
        let procedure = Maps(5);
        for of in [1, 2, 3, 8] {
            let mut found = Vec::new();
            for number in 1..=of {
                let chunk = Chunk::new(number, of).unwrap();
                let taken = chunk.take(jobs.clone(), &procedure);
                // Ten maps of six runs and thirty runs: no chunk exceeds its share by more than a
                // map.
                let share = jobs.len().div_ceil(of as usize);
                assert!(taken.len().abs_diff(share) <= 6, "{chunk}: {}", taken.len());
                found.extend(taken);
            }
            found.sort_by_key(|(key, _)| *key);
            assert_eq!(found, jobs, "{of}");
            let dealt = deal(&jobs, of, &procedure);
            let mut chunks = BTreeMap::new();
            for ((_, job), chunk) in jobs.iter().zip(dealt) {
                if let Some(work) = procedure.shares(job) {
                    assert_eq!(*chunks.entry(work).or_insert(chunk), chunk);
                }
            }
        }
    }

    #[test]
    fn chunks_are_read_as_they_are_written() {
        let chunk: Chunk = "3/8".parse().unwrap();
        assert_eq!(chunk.to_string(), "3/8");
        let folder = chunk.folder_in(Path::new("out"));
        let name = folder.file_name().unwrap().to_str().unwrap();
        assert_eq!(Chunk::of_folder(name), Some(chunk));
        for wrong in ["", "3", "0/8", "9/8", "1/0", "-1/8", "1/100001", "1/8/2"] {
            let error = wrong.parse::<Chunk>().unwrap_err();
            assert!(error.to_string().contains("such as 3/8"), "{wrong}");
        }
    }
}
