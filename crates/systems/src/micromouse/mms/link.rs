//! The mouse's end of the two pipes: it writes one command per line and reads one reply per line.

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use std::io::{self, BufRead, Read, Write};

use tolman_maze::{Cell, Direction};

use super::PlayError;

/// Maximum number of bytes read of a reply: no valid one is longer.
const MOST_BYTES: u64 = 256;

/// Speaks to whatever hosts the mouse.
#[derive(Debug)]
pub(super) struct Link<R, W> {
    input: R,
    output: W,
}

impl<R: BufRead, W: Write> Link<R, W> {
    pub(super) const fn new(input: R, output: W) -> Self {
        Self { input, output }
    }

    /// Sends a command without a reply.
    pub(super) fn tell(&mut self, command: &str) -> Result<(), PlayError> {
        // A simulator that has gone is found out about by the next question.
        writeln!(self.output, "{command}").map_err(|error| gone(error, command))
    }

    fn ask<T>(
        &mut self,
        command: &str,
        expected: &'static str,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Result<T, PlayError> {
        self.tell(command)?;
        self.output.flush().map_err(|error| gone(error, command))?;
        let mut line = Vec::new();
        let mut input = (&mut self.input).take(MOST_BYTES);
        let bytes = input.read_until(b'\n', &mut line);
        if bytes.map_err(|error| gone(error, command))? == 0 {
            return Err(PlayError::HostGone {
                command: command.to_owned(),
                source: None,
            });
        }
        let line = String::from_utf8_lossy(&line);
        let reply = line.trim();
        read(reply).ok_or_else(|| PlayError::Reply {
            command: command.to_owned(),
            reply: reply.to_owned(),
            expected,
        })
    }

    pub(super) fn number(&mut self, command: &str) -> Result<u16, PlayError> {
        self.ask(command, "a number of cells", |reply| {
            reply.parse().ok().filter(|cells| *cells > 0)
        })
    }

    pub(super) fn truth(&mut self, command: &str) -> Result<bool, PlayError> {
        self.ask(command, "true or false", |reply| reply.parse().ok())
    }

    pub(super) fn acknowledged(&mut self, command: &str) -> Result<(), PlayError> {
        self.ask(command, "ack", |reply| (reply == "ack").then_some(()))
    }

    /// Sends a drive command.
    pub(super) fn drive(&mut self, command: &str) -> Result<Driven, PlayError> {
        self.ask(command, "ack or crash", |reply| match reply {
            "ack" => Some(Driven::Arrived),
            "crash" => Some(Driven::Crashed),
            _ => None,
        })
    }

    /// Draws a wall.
    pub(super) fn show_wall(&mut self, cell: Cell, side: Direction) -> Result<(), PlayError> {
        let side = match side {
            Direction::North => 'n',
            Direction::East => 'e',
            Direction::South => 's',
            Direction::West => 'w',
        };
        self.tell(&format!("setWall {} {} {side}", cell.x, cell.y))
    }

    /// Sends everything still to be written.
    pub(super) fn close(mut self) -> Result<(), PlayError> {
        self.output.flush().map_err(|error| gone(error, "the end"))
    }
}

/// Result of a movement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Driven {
    Arrived,
    Crashed,
}

fn gone(error: io::Error, command: &str) -> PlayError {
    PlayError::HostGone {
        command: command.to_owned(),
        source: Some(error),
    }
}
