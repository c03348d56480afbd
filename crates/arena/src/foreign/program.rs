//! Starts a foreign program and exchanges lines with it.

use alloc::sync::Arc;
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::ffi::OsString;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender, TrySendError};
use std::thread;
use std::time::Instant;

use thiserror::Error;

/// Parameters of starting a foreign program.
#[derive(Clone, Copy, Debug)]
pub struct Launch<'a> {
    /// The program and its arguments.
    pub words: &'a [String],
    /// Command that runs [`keep`](super::keep) with our process's id and `words` behind it; empty
    /// for no keeper.
    pub keeper: &'a [OsString],
    /// Destination of the program's stderr.
    pub log: Log,
    /// Flag that ends the program once it is raised.
    pub stop: &'a Arc<AtomicBool>,
}

/// Whether the stderr of a foreign program is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Log {
    /// Shown on our stderr.
    Shown,
    /// Dropped.
    Dropped,
}

/// Resources that a foreign program may use before it is ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Maximum duration for which we wait for the program, in all.
    pub time: Duration,
    /// Maximum number of bytes that the program may write.
    pub bytes: u64,
    /// Maximum number of lines that the program may write.
    pub lines: u64,
    /// Maximum length of a line, bytes, with the end of the line.
    pub line_bytes: u64,
}

impl Default for Budget {
    /// Returns a budget of a minute, 64 MiB and a million lines of at most 4096 bytes.
    fn default() -> Self {
        Self {
            time: Duration::from_secs(60),
            bytes: 64 << 20,
            lines: 1_000_000,
            line_bytes: 4096,
        }
    }
}

/// Reason why a foreign program has to be ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Overrun {
    /// The program's time is over.
    #[error("the program is out of time; answer sooner, or raise the limit with --time-limit")]
    Time,
    /// The program wrote more bytes than it may.
    #[error("the program wrote too many bytes; write only answers to stdout")]
    Bytes,
    /// The program wrote more lines than it may.
    #[error("the program wrote too many lines; write one line per answer")]
    Lines,
    /// The program wrote a line that is too long.
    #[error("the program wrote a line that is too long; end each answer with a line break")]
    LineBytes,
    /// The flag of [`Launch::stop`] was raised.
    #[error("interrupted")]
    Stop,
}

/// End of a foreign program that had closed its stdout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// The program ended by itself.
    ByItself(ExitStatus),
    /// The program ran on and was killed.
    Killed,
}

/// Reason why a foreign program cannot be run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LaunchError {
    /// The command has no program.
    #[error("the command is empty: name a program")]
    NoProgram,
    /// The program does not start.
    #[error("`{program}` does not start: give the path of a program that can be run")]
    Start {
        /// Name of the program.
        program: String,
        /// The system's reason.
        source: io::Error,
    },
    /// The program cannot be waited for.
    #[error("the program cannot be waited for")]
    Wait(#[source] io::Error),
}

/// A running foreign program. Dropping it ends the program and all processes that it started.
///
/// Reading and writing have threads of their own, since a program that neither writes nor reads
/// must not hold up the clock. They end as soon as the program closes its pipes, or we close our
/// channels.
#[derive(Debug)]
pub struct ForeignProgram {
    name: String,
    stop: Arc<AtomicBool>,
    is_kept: bool,
    child: Child,
    lines: Receiver<Option<String>>,
    replies: Option<SyncSender<String>>,
    budget: Budget,
    waited: Duration,
    heard_bytes: u64,
    heard_lines: u64,
}

/// Number of lines that may wait to be read, in either direction.
const LINES_AHEAD: usize = 16;

/// Time between two looks at the flag and the clock.
const PULSE: Duration = Duration::from_millis(50);

#[cfg(target_os = "linux")]
/// Time within which the keeper must end the program, before the keeper itself is killed.
const KEEPER_TIME: Duration = Duration::from_secs(10);

impl ForeignProgram {
    /// Starts a program.
    ///
    /// # Errors
    /// [`LaunchError`] if it does not start. With a keeper, [`left`](Self::left) reports it later.
    pub fn start(launch: &Launch<'_>, budget: Budget) -> Result<Self, LaunchError> {
        let (program, arguments) = launch.words.split_first().ok_or(LaunchError::NoProgram)?;
        let mut command = match launch.keeper {
            [] => Command::new(program),
            [keeper, more @ ..] => {
                let mut command = Command::new(keeper);
                command.args(more).arg(std::process::id().to_string());
                command.arg("--").arg(program);
                command
            }
        };
        let mut child = command
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(match launch.log {
                Log::Shown => Stdio::inherit(),
                Log::Dropped => Stdio::null(),
            })
            .spawn()
            .map_err(|source| does_not_start(program, source))?;
        let (to_us, lines) = mpsc::sync_channel(LINES_AHEAD);
        let (replies, to_program) = mpsc::sync_channel(LINES_AHEAD);
        if let Some(output) = child.stdout.take() {
            thread::spawn(move || read(output, budget.line_bytes, &to_us));
        }
        if let Some(input) = child.stdin.take() {
            thread::spawn(move || write(input, &to_program));
        }
        Ok(Self {
            name: program.clone(),
            stop: Arc::clone(launch.stop),
            is_kept: !launch.keeper.is_empty(),
            child,
            lines,
            replies: Some(replies),
            budget,
            waited: Duration::ZERO,
            heard_bytes: 0,
            heard_lines: 0,
        })
    }

    /// Returns the next line that it writes, with its end; `None` if it has closed its stdout.
    ///
    /// # Errors
    /// [`Overrun`] if it has to be ended.
    pub fn hear(&mut self) -> Result<Option<String>, Overrun> {
        let line = loop {
            let left = self.look_at_clock()?;
            let began = Instant::now();
            let heard = self.lines.recv_timeout(left.min(PULSE));
            self.waited += began.elapsed();
            match heard {
                Ok(line) => break line.ok_or(Overrun::LineBytes)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(None),
            }
        };
        self.heard_lines += 1;
        self.heard_bytes += line.len() as u64;
        if self.heard_bytes > self.budget.bytes {
            return Err(Overrun::Bytes);
        }
        if self.heard_lines > self.budget.lines {
            return Err(Overrun::Lines);
        }
        Ok(Some(line))
    }

    /// Sends the program a line, without the line's end. A program that has closed its stdin gets
    /// none.
    ///
    /// # Errors
    /// [`Overrun`] if it has to be ended, as it does not read and too much is waiting for it.
    pub fn say(&mut self, line: String) -> Result<(), Overrun> {
        let mut waiting = line;
        loop {
            let Some(replies) = &self.replies else {
                return Ok(());
            };
            match replies.try_send(waiting) {
                Ok(()) | Err(TrySendError::Disconnected(_)) => return Ok(()),
                Err(TrySendError::Full(line)) => waiting = line,
            }
            self.look_at_clock()?;
            let began = Instant::now();
            thread::sleep(Duration::from_millis(1));
            self.waited += began.elapsed();
        }
    }

    /// Takes a line that has arrived and was not [heard](Self::hear) yet; `None` without one.
    pub fn heard_ahead(&self) -> Option<String> {
        self.lines.try_recv().ok().flatten()
    }

    /// Returns how long we have waited for the program.
    #[must_use]
    pub const fn waited(&self) -> Duration {
        self.waited
    }

    /// Waits for a program that has closed its stdout. Its stdin is closed too; if it does not end
    /// within `grace`, it is killed.
    ///
    /// # Errors
    /// [`LaunchError`] if it never started, or cannot be waited for.
    pub fn left(mut self, grace: Duration) -> Result<Left, LaunchError> {
        drop(self.replies.take());
        let ended = wait(&mut self.child, grace).map_err(LaunchError::Wait)?;
        let Some(status) = ended else {
            return Ok(Left::Killed);
        };
        // A keeper tells as a shell does that there is nothing to run.
        let never_started = match status.code() {
            Some(127) => Some(io::ErrorKind::NotFound),
            Some(126) => Some(io::ErrorKind::PermissionDenied),
            _ => None,
        };
        match never_started {
            Some(kind) if self.heard_lines == 0 && self.is_kept => {
                Err(does_not_start(&self.name, kind.into()))
            }
            _ => Ok(Left::ByItself(status)),
        }
    }

    /// Returns the remaining time, or an error if time is up or the flag is raised.
    fn look_at_clock(&self) -> Result<Duration, Overrun> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(Overrun::Stop);
        }
        let left = self.budget.time.checked_sub(self.waited);
        left.filter(|left| !left.is_zero()).ok_or(Overrun::Time)
    }
}

impl Drop for ForeignProgram {
    fn drop(&mut self) {
        // A program that has already ended is fine, and there is no one to report a failure to.
        if self.is_kept {
            let _ = ask_keeper(&mut self.child);
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Asks the keeper to end the program.
#[cfg(target_os = "linux")]
fn ask_keeper(child: &mut Child) -> io::Result<()> {
    use rustix::process::{Pid, Signal, kill_process};

    if child.try_wait()?.is_none() {
        kill_process(Pid::from_child(child), Signal::TERM)?;
        wait(child, KEEPER_TIME)?;
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn ask_keeper(_: &mut Child) -> io::Result<()> {
    Ok(())
}

fn does_not_start(program: &str, source: io::Error) -> LaunchError {
    LaunchError::Start {
        program: program.to_owned(),
        source,
    }
}

/// Waits for a child, no longer than `time`.
fn wait(child: &mut Child, time: Duration) -> io::Result<Option<ExitStatus>> {
    let started = Instant::now();
    loop {
        let status = child.try_wait()?;
        if status.is_some() || started.elapsed() >= time {
            return Ok(status);
        }
        thread::sleep(Duration::from_millis(1));
    }
}

/// Reads lines and sends them on. A line that is too long is sent as `None` and ends the reading.
fn read(output: ChildStdout, line_bytes: u64, to_us: &SyncSender<Option<String>>) {
    let mut output = BufReader::new(output);
    let mut line = Vec::new();
    loop {
        line.clear();
        match (&mut output).take(line_bytes).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return,
            Ok(_) => {}
        }
        let is_whole = line.ends_with(b"\n") || (line.len() as u64) < line_bytes;
        let sent = is_whole.then(|| String::from_utf8_lossy(&line).into_owned());
        if to_us.send(sent).is_err() || !is_whole {
            return;
        }
    }
}

fn write(mut input: ChildStdin, to_program: &Receiver<String>) {
    for line in to_program {
        // A program that has gone needs no line.
        if writeln!(input, "{line}")
            .and_then(|()| input.flush())
            .is_err()
        {
            return;
        }
    }
}
