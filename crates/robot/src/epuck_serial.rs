//! A driver for the real e-puck, over its serial ASCII protocol, which its standard firmware speaks over Bluetooth.
//!
//! Each command is a letter with its arguments, each answer the same letter in lower case: `D,l,r` sets the speeds of the wheels (answer `d`), `N` asks for
//! the proximity sensors (`n,` and eight numbers), `Q` for the encoders (`q,l,r`). Any port that reads and writes bytes will do; give it a time-out.
//!
//! ```
//! use core::time::Duration;
//! use tolman_robot::Robot;
//! use tolman_robot::epuck::WheelSpeeds;
//! use tolman_robot::epuck_serial::SerialEpuck;
//!
//! # struct Port(std::io::Cursor<Vec<u8>>);
//! # impl std::io::Read for Port { fn read(&mut self, b: &mut [u8]) -> std::io::Result<usize> { self.0.read(b) } }
//! # impl std::io::Write for Port { fn write(&mut self, b: &[u8]) -> std::io::Result<usize> { Ok(b.len()) } fn flush(&mut self) -> std::io::Result<()> { Ok(()) } }
//! # let port = Port(std::io::Cursor::new(b"n,1,2,3,4,5,6,7,8\r\nq,0,0\r\nd\r\nn,8,7,6,5,4,3,2,1\r\nq,10,10\r\n".to_vec()));
//! // The caller owns the clock: here nothing waits.
//! let mut robot = SerialEpuck::open(port, 64_000, |_: Duration| ())?;
//! robot.step(&WheelSpeeds { left: 1.0, right: 1.0 })?;
//! assert_eq!(robot.sensing().proximity.unwrap()[0], 8.0);
//! assert!(robot.sensing().encoders.unwrap().left > 0.06);
//! # Ok::<(), tolman_robot::epuck_serial::SerialError>(())
//! ```

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::f64::consts::TAU;
use core::time::Duration;
use std::io::{ErrorKind, Read, Write};

use thiserror::Error;

use crate::Robot;
use crate::epuck::{EpuckSensing, MOST_WHEEL_SPEED, PROXIMITY_SENSORS, WheelSpeeds, WheelTurns};

/// Motor steps of a turn of a wheel: 20 of the motor behind a gear of 50 to 1.
const STEPS_PER_TURN: f64 = 1000.0;

/// No answer is longer, bytes.
const LONGEST: usize = 256;

/// A real e-puck behind a port.
#[derive(Debug)]
pub struct SerialEpuck<P, W> {
    port: P,
    wait: W,
    step_us: u64,
    /// The encoders' counters, which turn over at 2¹⁶.
    counters: [u16; 2],
    sensing: EpuckSensing,
}

impl<P: Read + Write, W: FnMut(Duration)> SerialEpuck<P, W> {
    /// Asks the robot what it senses. Each step lasts `step_us` microseconds, for which `wait` is called.
    ///
    /// # Errors
    /// [`SerialError`] if it does not answer as it should.
    pub fn open(port: P, step_us: u64, wait: W) -> Result<Self, SerialError> {
        let mut robot = Self {
            port,
            wait,
            step_us,
            counters: [0; 2],
            sensing: EpuckSensing::default(),
        };
        robot.sensing.proximity = Some(robot.proximity()?);
        robot.counters = robot.encoders()?;
        robot.sensing.encoders = Some(WheelTurns::default());
        Ok(robot)
    }

    /// Gives the port back.
    pub fn into_port(self) -> P {
        self.port
    }

    fn proximity(&mut self) -> Result<[f64; PROXIMITY_SENSORS], SerialError> {
        let answer = self.ask("N", "n")?;
        let numbers: Vec<f64> = numbers(&answer, PROXIMITY_SENSORS)?;
        let mut values = [0.0; PROXIMITY_SENSORS];
        values.copy_from_slice(&numbers);
        Ok(values)
    }

    fn encoders(&mut self) -> Result<[u16; 2], SerialError> {
        let answer = self.ask("Q", "q")?;
        let numbers = numbers(&answer, 2)?;
        // Signed or not, the lower sixteen bits are the counter.
        Ok([numbers[0] as i64 as u16, numbers[1] as i64 as u16])
    }

    fn drive(&mut self, speeds: WheelSpeeds) -> Result<(), SerialError> {
        let steps = |speed: f64| {
            let speed = speed.clamp(-MOST_WHEEL_SPEED, MOST_WHEEL_SPEED);
            (speed / TAU * STEPS_PER_TURN) as i32
        };
        let command = format!("D,{},{}", steps(speeds.left), steps(speeds.right));
        self.ask(&command, "d").map(|_| ())
    }

    /// Sends a command and gives the answer, which begins as it should.
    fn ask(&mut self, command: &str, expected: &'static str) -> Result<String, SerialError> {
        let line = format!("{command}\n");
        let sent = self.port.write_all(line.as_bytes());
        sent.and_then(|()| self.port.flush())
            .map_err(|error| SerialError::of(error.kind()))?;
        let answer = self.line()?;
        if answer.split(',').next() == Some(expected) {
            Ok(answer)
        } else {
            Err(SerialError::Unexpected { expected, answer })
        }
    }

    /// The next line that is not empty.
    fn line(&mut self) -> Result<String, SerialError> {
        let mut line = Vec::new();
        loop {
            let mut byte = [0];
            match self.port.read(&mut byte) {
                Ok(0) => return Err(SerialError::Closed),
                Ok(_) if byte[0] == b'\n' => {
                    let text = core::str::from_utf8(&line).unwrap_or_default().trim();
                    if !text.is_empty() {
                        return Ok(text.to_owned());
                    }
                    if !line.iter().all(u8::is_ascii_whitespace) {
                        return Err(SerialError::Garbage);
                    }
                    line.clear();
                }
                Ok(_) if line.len() >= LONGEST => return Err(SerialError::Garbage),
                Ok(_) => line.push(byte[0]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(SerialError::of(error.kind())),
            }
        }
    }
}

/// The numbers behind the letter of an answer.
fn numbers(answer: &str, count: usize) -> Result<Vec<f64>, SerialError> {
    let parts = answer.split(',').skip(1);
    let numbers: Vec<f64> = parts
        .map_while(|part| part.trim().parse::<i32>().ok().map(f64::from))
        .collect();
    if numbers.len() == count && answer.split(',').count() == count + 1 {
        Ok(numbers)
    } else {
        Err(SerialError::Numbers {
            expected: count,
            answer: answer.to_owned(),
        })
    }
}

impl<P: Read + Write, W: FnMut(Duration)> Robot for SerialEpuck<P, W> {
    type Command = WheelSpeeds;
    type Sensing = EpuckSensing;
    type Error = SerialError;

    fn sensing(&self) -> &EpuckSensing {
        &self.sensing
    }

    fn step(&mut self, command: &WheelSpeeds) -> Result<(), SerialError> {
        if !(command.left.is_finite() && command.right.is_finite()) {
            return Err(SerialError::NotFinite);
        }
        let mut step = || {
            self.drive(*command)?;
            (self.wait)(Duration::from_micros(self.step_us));
            let proximity = self.proximity()?;
            Ok((proximity, self.encoders()?))
        };
        match step() {
            Ok((proximity, counters)) => {
                let turned = |side: usize| {
                    let steps = counters[side].wrapping_sub(self.counters[side]) as i16;
                    f64::from(steps) / STEPS_PER_TURN * TAU
                };
                self.sensing.encoders = Some(WheelTurns {
                    left: turned(0),
                    right: turned(1),
                });
                self.counters = counters;
                self.sensing.proximity = Some(proximity);
                self.sensing.time_us += self.step_us;
                Ok(())
            }
            Err(error) => {
                // It is to stand still, if it still listens.
                let _ = self.port.write_all(b"D,0,0\n");
                let _ = self.port.flush();
                self.sensing.proximity = None;
                self.sensing.encoders = None;
                Err(error)
            }
        }
    }
}

/// Why the e-puck does not do what it is told.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SerialError {
    /// It does not answer.
    #[error(
        "the e-puck does not answer in time: check that it is switched on and the port's time-out"
    )]
    TimedOut,
    /// The port is closed.
    #[error("the port was closed: connect to the e-puck again")]
    Closed,
    /// The port failed.
    #[error("the port failed: {0:?}")]
    Port(ErrorKind),
    /// What came is no line of text.
    #[error("the e-puck sends what is no line of text: check the port's speed and its firmware")]
    Garbage,
    /// The answer is that to another command.
    #[error(
        "the e-puck answers {answer:?} where `{expected}` should stand: switch it off and on again"
    )]
    Unexpected {
        /// How it should begin.
        expected: &'static str,
        /// What came.
        answer: String,
    },
    /// There are not as many numbers as there should be.
    #[error(
        "the e-puck answers {answer:?}, which has not {expected} numbers: a part of the line was lost"
    )]
    Numbers {
        /// How many there should be.
        expected: usize,
        /// What came.
        answer: String,
    },
    /// A speed is no number.
    #[error("the speed of a wheel is not finite; give finite numbers")]
    NotFinite,
}

impl SerialError {
    fn of(kind: ErrorKind) -> Self {
        match kind {
            ErrorKind::TimedOut | ErrorKind::WouldBlock => Self::TimedOut,
            ErrorKind::UnexpectedEof | ErrorKind::BrokenPipe => Self::Closed,
            kind => Self::Port(kind),
        }
    }
}

#[cfg(test)]
mod tests {
    use alloc::collections::VecDeque;
    use std::io;

    use super::*;

    /// A port that answers each command with the next line of a script; `None` is a time-out.
    struct Script {
        answers: VecDeque<Option<&'static [u8]>>,
        coming: VecDeque<u8>,
        timed_out: bool,
        sent: Vec<u8>,
    }

    impl Script {
        fn new(answers: &[Option<&'static [u8]>]) -> Self {
            Self {
                answers: answers.iter().copied().collect(),
                coming: VecDeque::new(),
                timed_out: false,
                sent: Vec::new(),
            }
        }
    }

    impl Read for Script {
        fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
            match self.coming.pop_front() {
                Some(byte) => {
                    bytes[0] = byte;
                    Ok(1)
                }
                None if self.timed_out => Err(ErrorKind::TimedOut.into()),
                None => Ok(0),
            }
        }
    }

    impl Write for Script {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.sent.extend(bytes);
            match self.answers.pop_front() {
                Some(Some(answer)) => self.coming.extend(answer),
                Some(None) => self.timed_out = true,
                None => {}
            }
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    const N: Option<&[u8]> = Some(b"n,10,20,30,40,50,60,70,80\r\n");
    const D: Option<&[u8]> = Some(b"d\r\n");
    const Q: Option<&[u8]> = Some(b"q,65530,-6\r\n");
    const AHEAD: WheelSpeeds = WheelSpeeds {
        left: TAU / 10.0,
        right: 100.0,
    };

    fn after(answers: &[Option<&'static [u8]>]) -> (Result<(), SerialError>, Script) {
        let mut script = alloc::vec![N, Q];
        script.extend(answers);
        let mut robot = SerialEpuck::open(Script::new(&script), 100_000, |_| ()).unwrap();
        let result = robot.step(&AHEAD);
        let is_silent = robot.sensing().proximity.is_none();
        assert_eq!(result.is_err(), is_silent);
        (result, robot.into_port())
    }

    #[test]
    fn it_speaks_the_protocol() {
        let script = [N, Q, Some(b"d\r\n"), N, Some(b"\r\nq,4,94\r\n")];
        let mut waited = Duration::ZERO;
        let mut robot =
            SerialEpuck::open(Script::new(&script), 100_000, |time| waited += time).unwrap();
        robot.step(&AHEAD).unwrap();
        let sensing = *robot.sensing();
        assert_eq!(sensing.proximity.unwrap().map(|value| value as u32)[7], 80);
        // From 65530 over 0 to 4, and from -6 to 94.
        let turns = sensing.encoders.unwrap();
        assert!((turns.left - 0.01 * TAU).abs() < 1e-12, "{turns:?}");
        assert!((turns.right - 0.1 * TAU).abs() < 1e-12, "{turns:?}");
        assert_eq!(sensing.time_us, 100_000);
        let sent = String::from_utf8(robot.into_port().sent).unwrap();
        // The right wheel as fast as it can.
        assert_eq!(sent, "N\nQ\nD,100,999\nN\nQ\n");
        assert_eq!(waited, Duration::from_millis(100));
    }

    #[test]
    fn what_goes_wrong_is_told_and_stops_the_robot() {
        let unexpected = SerialError::Unexpected {
            expected: "d",
            answer: "welcome".into(),
        };
        let numbers = |expected, answer: &str| SerialError::Numbers {
            expected,
            answer: answer.into(),
        };
        let cases: [(&[Option<&'static [u8]>], SerialError); 8] = [
            (&[None], SerialError::TimedOut),
            (&[], SerialError::Closed),
            (&[D, None], SerialError::TimedOut),
            (&[Some(&[0xff, 0xfe, b'\n'])], SerialError::Garbage),
            (&[Some(&[b'x'; 300])], SerialError::Garbage),
            (&[Some(b"welcome\r\n")], unexpected),
            (&[D, Some(b"n,1,2,3\r\n")], numbers(8, "n,1,2,3")),
            (&[D, N, Some(b"q,1,\r\n")], numbers(2, "q,1,")),
        ];
        for (answers, expected) in cases {
            let (result, port) = after(answers);
            assert_eq!(result, Err(expected));
            assert!(port.sent.ends_with(b"D,0,0\n"));
        }
    }

    #[test]
    fn speeds_that_are_none_are_refused() {
        let mut robot = SerialEpuck::open(Script::new(&[N, Q]), 1, |_| ()).unwrap();
        let speeds = WheelSpeeds {
            left: f64::NAN,
            right: 0.0,
        };
        assert_eq!(robot.step(&speeds), Err(SerialError::NotFinite));
    }
}
