use core::fmt;
use core::panic::AssertUnwindSafe;
use core::time::Duration;
use std::io;
use std::panic::catch_unwind;
use std::time::Instant;

use super::{Answer, FuzzTarget, Mutator};

/// An answer that takes longer is a fault.
const SLOW: Duration = Duration::from_secs(2);

/// A reader that holds more than this at once is at fault, bytes.
const GREEDY: u64 = 1 << 30;

/// Mutated files for one reader.
#[derive(Debug)]
pub struct Campaign {
    target: &'static FuzzTarget,
    seeds: Vec<Vec<u8>>,
    mutator: Mutator,
    findings: Findings,
}

/// What came of a campaign so far.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// The number of files.
    pub files: u64,
    /// How many of them could be used.
    pub taken: u64,
    /// The longest that an answer took.
    pub slowest: Duration,
    /// The most that a reader held at once, bytes.
    pub most_memory: u64,
    /// The files that a reader did not answer as it should.
    pub faults: Vec<(Vec<u8>, Fault)>,
}

/// What is wrong with an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// It panicked, in these words.
    Panic(String),
    /// It took this long.
    Slow(Duration),
    /// It held this many bytes at once.
    Greedy(u64),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Panic(words) => write!(f, "panics: {words}"),
            Self::Slow(time) => write!(f, "takes {:.1} s", time.as_secs_f64()),
            Self::Greedy(bytes) => write!(f, "holds {} MiB", bytes >> 20),
        }
    }
}

impl Campaign {
    /// Returns a campaign against `target`.
    ///
    /// # Errors
    /// If its seeds cannot be read.
    pub fn new(target: &'static FuzzTarget, seed: u64) -> io::Result<Self> {
        Ok(Self {
            seeds: target.seeds()?,
            target,
            mutator: Mutator::new(seed),
            findings: Findings::default(),
        })
    }

    /// Returns whether the reader takes all seeds as they are; if not, the number of the first that
    /// it does not take.
    pub fn refused_seed(&self) -> Option<usize> {
        let mut seeds = self.seeds.iter();
        seeds.position(|seed| (self.target.check)(seed) == Answer::Refused)
    }

    /// Gives the reader `count` further files.
    pub fn go_on(&mut self, count: u32) {
        for _ in 0..count {
            let file = self.mutator.file(&self.seeds);
            let began = Instant::now();
            let mut answer = None;
            let held = allocation_counter::measure(|| {
                answer = Some(catch_unwind(AssertUnwindSafe(|| {
                    (self.target.check)(&file)
                })));
            });
            let (took, held) = (began.elapsed(), held.bytes_max);
            let findings = &mut self.findings;
            findings.files += 1;
            findings.slowest = findings.slowest.max(took);
            findings.most_memory = findings.most_memory.max(held);
            let fault = match answer {
                Some(Err(words)) => Some(Fault::Panic(words_of(&*words))),
                _ if took > SLOW => Some(Fault::Slow(took)),
                _ if held > GREEDY => Some(Fault::Greedy(held)),
                Some(Ok(answer)) => {
                    findings.taken += u64::from(answer == Answer::Taken);
                    None
                }
                None => None,
            };
            findings.faults.extend(fault.map(|fault| (file, fault)));
        }
    }

    /// Returns its target.
    #[must_use]
    pub const fn target(&self) -> &'static FuzzTarget {
        self.target
    }

    /// Returns what came of it so far.
    #[must_use]
    pub const fn findings(&self) -> &Findings {
        &self.findings
    }
}

fn words_of(panic: &(dyn core::any::Any + Send)) -> String {
    let words = panic.downcast_ref::<String>().cloned();
    let words = words.or_else(|| {
        panic
            .downcast_ref::<&str>()
            .map(|words| (*words).to_owned())
    });
    words.unwrap_or_default()
}
