//! Saves runs that are interrupted, and continues them.
//!
//! A run depends only on its command line. So the file of an interrupted run holds the command
//! line, how far the run came, and a checksum of its results so far. To continue, the program
//! repeats these steps without showing them, compares the checksum, and then goes on.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use core::hash::Hasher;
use core::time::Duration;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Error, anyhow};
use fnv::FnvHasher;
use serde::{Deserialize, Serialize};
use tolman_arena::BoxError;
use tolman_geom::Pose;

use super::kind::Kind;
use super::outputs::{self, Output};
use super::words::counted;
use super::{Failure, OrBadInput, Result, Unboxed, called, file};

/// Options to save and continue an interrupted run, for verbs that save nothing else.
#[derive(clap::Args)]
pub(super) struct GoingOn {
    /// Continue an interrupted run; repeat all other options as they were
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    /// Save the run to this file once a second, to continue it after an interruption. Without this
    /// option, only Ctrl-C saves it, to drive.unfinished or run.unfinished
    #[arg(long, value_name = "FILE", value_parser = outputs::file(&["unfinished", "json"]))]
    unfinished: Option<Output>,
}

impl GoingOn {
    /// Returns the keeper of a run with the command line `call`.
    ///
    /// # Errors
    /// Bad input if there is no run to continue.
    pub(super) fn keeper(&self, call: Call) -> Result<Keeper> {
        let verb = call.verb();
        let path = self.unfinished.as_deref().map(Path::to_owned);
        let path = path.unwrap_or_else(|| PathBuf::from(format!("{verb}.unfinished")));
        if self.unfinished.is_none() {
            outputs::note("unfinished", &path)?;
        }
        let former = self.from.as_deref().map(read).transpose()?;
        let keeper = Keeper::new(path, call, former)?;
        Ok(keeper.saving(match self.unfinished {
            Some(_) => Saving::WhileItGoes,
            None => Saving::AtItsEnd,
        }))
    }
}

/// Command line on which a run depends: its verb, then its flags with their values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Call(Vec<(String, String)>);

impl Call {
    pub(super) fn new(verb: &str) -> Self {
        Self(vec![("the verb".to_owned(), verb.to_owned())])
    }

    /// Adds a flag and its value, or nothing if the flag was not given.
    #[must_use]
    pub(super) fn with(mut self, flag: &str, value: Option<impl ToString>) -> Self {
        self.0
            .extend(value.map(|value| (flag.to_owned(), value.to_string())));
        self
    }

    fn verb(&self) -> &str {
        self.0.first().map_or("", |(_, verb)| verb)
    }

    /// Returns the first difference from `former`: the flag, its value then, and its value now.
    fn difference(&self, former: &Self) -> Option<String> {
        let differs = |flag: &str| {
            let of = |call: &Self| {
                let mut values = call.0.iter().filter(|(given, _)| given == flag);
                values.next().map(|(_, value)| value.clone())
            };
            let (then, now) = (of(former), of(self));
            let told = |value: Option<String>| value.unwrap_or_else(|| "not given".to_owned());
            (then != now).then(|| format!("{flag} was {}, and is {}", told(then), told(now)))
        };
        let flags = former.0.iter().chain(&self.0);
        flags.map(|(flag, _)| flag).find_map(|flag| differs(flag))
    }
}

/// Format of the file, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Format {
    #[serde(rename = "tolman-unfinished")]
    Unfinished,
}

/// Version of the format that is written and read.
const VERSION: u32 = 1;

/// An interrupted run as a file.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Unfinished {
    format: Format,
    version: u32,
    call: Call,
    /// Progress of the run.
    done: Done,
    /// Checksum of the run's results until then.
    checksum: String,
    /// Map from which the run continued; `None` if it did not continue one.
    map: Option<FormerMap>,
}

/// A map from which a run continued. It is kept here, because its file may change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FormerMap {
    /// Path of the map's file, for messages.
    pub(super) name: PathBuf,
    /// Text of the whole file.
    pub(super) text: String,
}

/// Progress of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Done {
    /// Number of actions begun.
    pub(super) actions: u32,
    /// Number of time steps made.
    pub(super) steps: u32,
}

impl Unfinished {
    /// Reads the text of an interrupted run.
    ///
    /// # Errors
    /// If it is another kind of file, or has a later version.
    fn of_text(text: &str) -> Result<Self, Error> {
        let read: Self = serde_json::from_str(text)?;
        match read.version {
            VERSION => Ok(read),
            other => Err(anyhow!(
                "its version is {other}, and this program reads {VERSION}; use the one that wrote it"
            )),
        }
    }
}

/// An interrupted run and the path of its file.
pub(super) struct Former {
    path: PathBuf,
    run: Unfinished,
}

impl Former {
    /// Returns the interrupted run in `text`; `None` if it is another kind of file.
    ///
    /// # Errors
    /// Bad input that says what is wrong in it.
    pub(super) fn of_text(path: &Path, text: &str) -> Result<Option<Self>> {
        if !Kind::Unfinished.is_of(text) {
            return Ok(None);
        }
        let run = Unfinished::of_text(text).with_context(|| path.display().to_string());
        Ok(Some(Self {
            path: path.to_owned(),
            run: run.or_bad_input()?,
        }))
    }

    /// Returns the map from which the run continued, or `None`.
    pub(super) const fn map(&self) -> Option<&FormerMap> {
        self.run.map.as_ref()
    }
}

/// Reads an interrupted run.
fn read(path: &Path) -> Result<Former> {
    let text = file::read(path, "give a file of an interrupted run")?;
    let former = Former::of_text(path, &text)?;
    former.ok_or_else(|| {
        let name = path.display().to_string();
        let error = anyhow!("it is not an interrupted run, which Ctrl-C leaves behind");
        Failure::BadInput(Kind::Unfinished.explain(&text, &name, error))
    })
}

/// Moments at which a run is saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Saving {
    /// The run is never saved, because its driver cannot be made to repeat it.
    Never,
    /// The run is saved when Ctrl-C interrupts it.
    AtItsEnd,
    /// The run is also saved about once a second, in case something else ends it.
    WhileItGoes,
}

/// Saves a run in progress, and first has it repeat the former run.
pub(super) struct Keeper {
    path: PathBuf,
    call: Call,
    saving: Saving,
    map: Option<FormerMap>,
    /// Former run; `None` once it has been repeated, or if there is none.
    former: Option<Former>,
    trail: Trail,
    done: Done,
    next: Instant,
    /// Files in which this run is saved.
    written: Vec<PathBuf>,
}

/// Minimum time between two saves.
const PERIOD: Duration = Duration::from_secs(1);

/// Minimum time between two saves, as a multiple of the time that a save takes.
const PATIENCE: u32 = 20;

/// State of a run so far as a text, without the robot's way; or the reason why it has none.
type State = Result<String, BoxError>;

impl Keeper {
    /// Returns the keeper of a run with the command line `call`, which saves it to `path` and
    /// repeats `former` first.
    ///
    /// # Errors
    /// Bad input if `former` has another command line.
    pub(super) fn new(path: PathBuf, call: Call, former: Option<Former>) -> Result<Self> {
        if let Some(former) = &former
            && let Some(difference) = call.difference(&former.run.call)
        {
            return Err(Failure::BadInput(anyhow!(
                "{} is another run: {difference}; repeat all options of that run",
                former.path.display()
            )));
        }
        Ok(Self {
            path,
            call,
            saving: Saving::WhileItGoes,
            map: former.as_ref().and_then(|former| former.run.map.clone()),
            written: former.iter().map(|former| former.path.clone()).collect(),
            former,
            trail: Trail::default(),
            done: Done::default(),
            next: Instant::now() + PERIOD,
        })
    }

    /// Sets when the run is saved.
    pub(super) fn saving(self, saving: Saving) -> Self {
        Self { saving, ..self }
    }

    /// Sets the map from which the run continues.
    pub(super) fn with_map(self, map: Option<FormerMap>) -> Self {
        let map = map.or(self.map);
        Self { map, ..self }
    }

    /// Returns the length of the former run while it is still being repeated, or `None` afterwards.
    pub(super) fn again(&self) -> Option<Done> {
        self.former.as_ref().map(|former| former.run.done)
    }

    /// Records that the run has reached `done`, with its way and its bumps so far. Saves it if that
    /// is due.
    ///
    /// # Errors
    /// If the repeated part differs from the former run.
    pub(super) fn went(
        &mut self,
        done: Done,
        path: &[Pose],
        bumped: &[u32],
        state: impl Fn() -> State,
    ) -> Result {
        self.trail.follow(path, bumped);
        self.done = done;
        if let Some(former) = self.former.take_if(|former| former.run.done == done) {
            if self.checksum(&state)? != former.run.checksum {
                return Err(parted(&former));
            }
            self.next = Instant::now() + PERIOD;
        }
        let is_time = self.saving == Saving::WhileItGoes && Instant::now() >= self.next;
        if is_time && self.former.is_none() {
            let began = Instant::now();
            // If it cannot be saved now, it is saved at the end, or the error is reported there.
            let _ = self.save(&state);
            self.next = Instant::now() + PERIOD.max(began.elapsed() * PATIENCE);
        }
        Ok(())
    }

    /// Saves the run as it is now. While a former run is still being repeated, its file stays as it
    /// was.
    ///
    /// # Errors
    /// If the file cannot be written.
    fn save(&mut self, state: &impl Fn() -> State) -> Result {
        if self.saving == Saving::Never {
            return Ok(());
        }
        let run = match &self.former {
            Some(former) => former.run.clone(),
            None => Unfinished {
                format: Format::Unfinished,
                version: VERSION,
                call: self.call.clone(),
                done: self.done,
                checksum: self.checksum(state)?,
                map: self.map.clone(),
            },
        };
        file::write(&self.path, serde_json::to_string(&run)?)?;
        if !self.written.contains(&self.path) {
            self.written.push(self.path.clone());
        }
        Ok(())
    }

    /// Saves the run as it is now, and returns the failure that names the command which continues
    /// it; or why it cannot be saved.
    pub(super) fn interrupted(&mut self, state: impl Fn() -> State) -> Failure {
        if let Err(failure) = self.save(&state) {
            return failure;
        }
        let Done { actions, steps } = self.again().unwrap_or(self.done);
        let told = format!(
            "interrupted after {}, {}",
            counted(actions as usize, "action"),
            counted(steps as usize, "step")
        );
        Failure::Interrupted(match self.saving {
            Saving::Never => anyhow!(told),
            _ => anyhow!("{told}; go on with: {}", called::going_on(&self.path)),
        })
    }

    /// Ends the run, and returns the files in which it is saved.
    ///
    /// # Errors
    /// If it ended before the former run was repeated, so that it is another run.
    pub(super) fn finish(self) -> Result<Saved> {
        match &self.former {
            Some(former) => Err(parted(former)),
            None => Ok(Saved(self.written)),
        }
    }

    fn checksum(&self, state: &impl Fn() -> State) -> Result<String> {
        let mut trail = self.trail.clone();
        let state = state().unboxed()?;
        trail.hash(state.as_bytes());
        Ok(format!("{:016x}", trail.hash))
    }
}

/// The files in which a run that has ended is saved. They stay until its results are written.
#[must_use]
pub(super) struct Saved(Vec<PathBuf>);

impl Saved {
    /// Removes the files.
    pub(super) fn remove(self) {
        for path in self.0 {
            // The file may already have been removed.
            let _ = fs::remove_file(path);
        }
    }

    /// Returns what becomes of a run whose results cannot be written.
    pub(super) fn told(&self) -> String {
        match self.0.last() {
            Some(path) => format!("the run is kept; go on with: {}", called::going_on(path)),
            None => "what was learned is lost; repeat the command with another --out".to_owned(),
        }
    }
}

fn parted(former: &Former) -> Failure {
    let Done { actions, .. } = former.run.done;
    Failure::Failed(anyhow!(
        "{}: its first {actions} actions, repeated, gave another result; continue with the program that wrote it, or \
         begin again without --from",
        former.path.display()
    ))
}

/// Returns the checksum of a text.
pub(super) fn checksum(text: &str) -> String {
    let mut trail = Trail::default();
    trail.hash(text.as_bytes());
    format!("{:016x}", trail.hash)
}

/// Running checksum of a robot's way: FNV-1a, 64 bits.
#[derive(Clone, Debug)]
struct Trail {
    hash: u64,
    poses: usize,
    bumps: usize,
}

impl Default for Trail {
    fn default() -> Self {
        Self {
            hash: FnvHasher::default().finish(),
            poses: 0,
            bumps: 0,
        }
    }
}

impl Trail {
    /// Adds everything new since the last call. O(new).
    fn follow(&mut self, path: &[Pose], bumped: &[u32]) {
        for pose in path.iter().skip(self.poses) {
            let Pose { position, heading } = pose;
            for number in [position.x, position.y, heading.radians()] {
                self.hash(&number.to_bits().to_le_bytes());
            }
        }
        for step in bumped.iter().skip(self.bumps) {
            self.hash(&step.to_le_bytes());
        }
        (self.poses, self.bumps) = (path.len(), bumped.len());
    }

    fn hash(&mut self, bytes: &[u8]) {
        let mut hash = FnvHasher::with_key(self.hash);
        hash.write(bytes);
        self.hash = hash.finish();
    }
}
