//! Runs a mouse that is a program of its own.

use core::time::Duration;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread;
use std::time::Instant;

use serde::Serialize;
use thiserror::Error;
use tolman_maze::Maze;

use super::{Exchange, Score, Simulator};

/// When a mouse is stopped.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// After so much time.
    pub time: Duration,
    /// After so many moves, turns and crashes.
    pub movements: u64,
    /// The reset button is pressed after so many; never if there is no number.
    pub reset_after: Option<u64>,
}

/// Whether what a mouse writes to stderr is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Log {
    /// On our stderr.
    Shown,
    /// Nowhere.
    Dropped,
}

/// What became of a mouse.
#[derive(Clone, Debug, Serialize)]
pub struct Hosted {
    /// Whether it finished a run.
    pub solved: bool,
    /// The score as the code of mms counts it; 2000 if unsolved.
    pub score: f32,
    /// The score as the README of mms has it; 2000 if unsolved.
    pub score_in_cells: f32,
    /// How it ended.
    pub ended: MouseExit,
    /// Moves and turns.
    pub movements: u64,
    /// How often it ran against a wall.
    pub crashes: u64,
    /// Lines that were no command.
    pub invalid_commands: u64,
    /// All figures in half-steps.
    pub half_steps: Score,
    /// All figures in cells.
    pub cells: Score,
}

/// How a mouse ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum MouseExit {
    /// By itself, and said that all went well.
    Done,
    /// By itself, with a failure.
    Failed,
    /// It was out of time.
    OutOfTime,
    /// It had made all its movements.
    OutOfMovements,
    /// It wrote a line that no command can be.
    LineTooLong,
}

/// Why a mouse could not be run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum HostError {
    /// The command has no program.
    #[error("the mouse's command is empty: name a program")]
    NoProgram,
    /// The program does not start.
    #[error("the mouse `{program}` does not start: give the path of a program that can be run")]
    Start {
        /// Its name.
        program: String,
        /// Why.
        source: io::Error,
    },
    /// The program cannot be waited for.
    #[error("the mouse cannot be waited for")]
    Wait(#[source] io::Error),
}

/// No command is longer, bytes.
const LONGEST_LINE: u64 = 4096;

/// Lines that may wait to be answered before the mouse has to.
const LINES_AHEAD: usize = 256;

/// Runs the program `words[0]` with the other words as arguments as a mouse in a maze, until it
/// ends or a limit is reached; then it is killed. `watch` is shown every line with its answer.
///
/// # Errors
/// [`HostError`] if it does not start. That it fails, or does not solve the maze, is a result.
pub fn host(
    words: &[String],
    maze: &Maze,
    limits: &Limits,
    log: Log,
    watch: impl FnMut(&Exchange),
) -> Result<Hosted, HostError> {
    let (program, arguments) = words.split_first().ok_or(HostError::NoProgram)?;
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(match log {
            Log::Shown => Stdio::inherit(),
            Log::Dropped => Stdio::null(),
        })
        .spawn()
        .map_err(|source| HostError::Start {
            program: program.clone(),
            source,
        })?;
    let mut simulator = Simulator::new(maze);
    if let Some(movements) = limits.reset_after {
        simulator.reset_after(movements);
    }
    let stopped = match (child.stdin.take(), child.stdout.take()) {
        (Some(input), Some(output)) => converse(&mut simulator, input, output, limits, watch),
        _ => None,
    };
    let ended = match stopped {
        Some(ended) => {
            // It may have ended by itself by now, which is as good.
            let _ = child.kill();
            child.wait().map_err(HostError::Wait)?;
            ended
        }
        None => wait(&mut child, limits.time)?,
    };
    let (half_steps, cells) = (simulator.score_in_half_steps(), simulator.score_in_cells());
    Ok(Hosted {
        solved: half_steps.solved,
        score: half_steps.value(),
        score_in_cells: cells.value(),
        ended,
        movements: simulator.movements(),
        crashes: simulator.crashes(),
        invalid_commands: simulator.invalid(),
        half_steps: *half_steps,
        cells: *cells,
    })
}

/// Answers the mouse until it closes its stdout (`None`) or has to be stopped.
///
/// Reading and writing have threads of their own, since a mouse that neither writes nor reads must
/// not hold up the clock.
fn converse(
    simulator: &mut Simulator<'_>,
    input: ChildStdin,
    output: ChildStdout,
    limits: &Limits,
    mut watch: impl FnMut(&Exchange),
) -> Option<MouseExit> {
    let deadline = Instant::now() + limits.time;
    let (to_us, lines) = mpsc::sync_channel(LINES_AHEAD);
    let (replies, to_mouse) = mpsc::sync_channel(LINES_AHEAD);
    // They end as soon as the mouse's ends of the pipes are closed, or ours of the channels.
    thread::spawn(move || read(output, &to_us));
    thread::spawn(move || write(input, &to_mouse));
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        let line = match lines.recv_timeout(left) {
            Ok(Some(line)) => line,
            Ok(None) => return Some(MouseExit::LineTooLong),
            Err(RecvTimeoutError::Timeout) => return Some(MouseExit::OutOfTime),
            Err(RecvTimeoutError::Disconnected) => return None,
        };
        let exchange = Exchange::of(simulator, &line);
        watch(&exchange);
        if simulator.movements() + simulator.crashes() >= limits.movements {
            return Some(MouseExit::OutOfMovements);
        }
        if let Some(reply) = exchange.reply
            && !send(&replies, reply, deadline)
        {
            return Some(MouseExit::OutOfTime);
        }
    }
}

/// Hands a reply on; false if the mouse reads nothing until the deadline. One that is gone needs
/// none.
fn send(replies: &SyncSender<String>, reply: String, deadline: Instant) -> bool {
    let mut waiting = reply;
    loop {
        match replies.try_send(waiting) {
            Ok(()) | Err(mpsc::TrySendError::Disconnected(_)) => return true,
            Err(mpsc::TrySendError::Full(_)) if Instant::now() >= deadline => return false,
            Err(mpsc::TrySendError::Full(reply)) => {
                waiting = reply;
                thread::sleep(Duration::from_millis(1));
            }
        }
    }
}

/// Reads lines; `None` for one that is too long, and then no more.
fn read(output: ChildStdout, to_us: &SyncSender<Option<String>>) {
    let mut output = BufReader::new(output);
    let mut line = Vec::new();
    loop {
        line.clear();
        match (&mut output)
            .take(LONGEST_LINE)
            .read_until(b'\n', &mut line)
        {
            Ok(0) | Err(_) => return,
            Ok(_) => {}
        }
        let is_whole = line.ends_with(b"\n") || (line.len() as u64) < LONGEST_LINE;
        let sent = is_whole.then(|| String::from_utf8_lossy(&line).into_owned());
        if to_us.send(sent).is_err() || !is_whole {
            return;
        }
    }
}

fn write(mut input: ChildStdin, to_mouse: &Receiver<String>) {
    for reply in to_mouse {
        // A mouse that has gone needs no reply.
        if writeln!(input, "{reply}")
            .and_then(|()| input.flush())
            .is_err()
        {
            return;
        }
    }
}

/// Waits for a mouse that has closed its stdout; one that does not end in a second, or in what it
/// was given if that is less, is killed.
fn wait(child: &mut Child, time: Duration) -> Result<MouseExit, HostError> {
    let deadline = Instant::now() + time.min(Duration::from_secs(1));
    loop {
        match child.try_wait().map_err(HostError::Wait)? {
            Some(status) if status.success() => return Ok(MouseExit::Done),
            Some(_) => return Ok(MouseExit::Failed),
            None if Instant::now() >= deadline => {
                let _ = child.kill();
                child.wait().map_err(HostError::Wait)?;
                return Ok(MouseExit::OutOfTime);
            }
            None => thread::sleep(Duration::from_millis(2)),
        }
    }
}
