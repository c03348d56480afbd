//! A driver for the real e-puck, over its serial ASCII protocol, which its standard firmware speaks
//! over Bluetooth.
//!
//! Each command is a letter with its arguments, and each answer begins with the same letter in
//! lower case. `D,l,r` sets the speeds of the wheels (answer `d`). `E` asks for the set speeds
//! (answer `e,l,r`), and `N` for the proximity sensors (`n,` and eight numbers). `Q` asks for the
//! encoders (`q,l,r`). Speeds and encoders count thousandths of a turn. Any port that reads and
//! writes bytes will do; give it a time-out.
//!
//! `Q` tells what the wheels do; `E` tells the speeds that the firmware uses. The robot answers `d`
//! even to a command that lost a byte on its way. A remote control may set other speeds without the
//! driver's knowledge. So every `D` is followed by an `E`.
//!
//! A step is `D`, `E`, the time step, `N`, `Q`. The robot drives on while these lines are
//! exchanged. So let `wait` return one step after it last returned, as below, rather than sleep for
//! a whole step. Choose a step long enough for the lines.
//!
//! ```
//! use std::thread::sleep;
//! use std::time::{Duration, Instant};
//! use tolman_robot::Robot;
//! use tolman_robot::epuck::WheelSpeeds;
//! use tolman_robot::epuck_serial::SerialEpuck;
//!
//! # struct Port(std::io::Cursor<Vec<u8>>);
//! # impl std::io::Read for Port { fn read(&mut self, b: &mut [u8]) -> std::io::Result<usize> { self.0.read(b) } }
//! # impl std::io::Write for Port { fn write(&mut self, b: &[u8]) -> std::io::Result<usize> { Ok(b.len()) } fn flush(&mut self) -> std::io::Result<()> { Ok(()) } }
//! # let answers = b"d\r\ne,0,0\r\nn,1,2,3,4,5,6,7,8\r\nq,0,0\r\nd\r\ne,159,159\r\nn,8,7,6,5,4,3,2,1\r\nq,10,10\r\n";
//! # let port = Port(std::io::Cursor::new(answers.to_vec()));
//! // The caller owns the clock.
//! let mut passed = Instant::now();
//! let wait = |step: Duration| {
//!     sleep((passed + step).saturating_duration_since(Instant::now()));
//!     passed = Instant::now();
//! };
//! // `port` is open at 115200 baud, as the operating system's port for the paired robot.
//! let mut robot = SerialEpuck::open(port, 64_000, wait)?;
//! robot.step(&WheelSpeeds { left: 1.0, right: 1.0 })?;
//! assert_eq!(robot.sensing().proximity.unwrap()[0], 8.0);
//! assert!(robot.sensing().encoders.unwrap().left > 0.06);
//! # Ok::<(), tolman_robot::epuck_serial::SerialError>(())
//! ```

// Input holds any bytes: a reader indexes nothing.
#![cfg_attr(not(test), warn(clippy::indexing_slicing))]

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::time::Duration;
use std::io::{ErrorKind, Read, Write};

use thiserror::Error;

use crate::Robot;
use crate::epuck::{
    ENCODER_STEP, EpuckSensing, MOST_WHEEL_SPEED, PROXIMITY_SENSORS, WheelSpeeds, WheelTurns,
};

/// Maximum length of an answer with the empty lines before it, bytes.
const LONGEST: usize = 256;

/// Maximum number of lines that are not an answer while a connection is opened: the firmware's
/// greeting, or answers to earlier questions.
const FOREIGN_LINES: usize = 8;

/// A real e-puck behind a port.
#[derive(Debug)]
pub struct SerialEpuck<P, W> {
    port: P,
    wait: W,
    step_us: u64,
    /// Last readings of the encoders' counters, which wrap at 2¹⁶.
    counters: [u16; 2],
    /// Number of lines before an answer that are skipped: 0 once the connection is open.
    foreign_lines: usize,
    sensing: EpuckSensing,
}

impl<P: Read + Write, W: FnMut(Duration)> SerialEpuck<P, W> {
    /// Stops the robot, checks that it stands still, and reads its sensors. Earlier lines are
    /// skipped: after a failure, open the port again. Each step lasts `step_us` microseconds, for
    /// which `wait` is called.
    ///
    /// # Errors
    /// [`SerialError`] if the robot does not answer, or not as its protocol says.
    pub fn open(port: P, step_us: u64, wait: W) -> Result<Self, SerialError> {
        let mut robot = Self {
            port,
            wait,
            step_us,
            counters: [0; 2],
            foreign_lines: FOREIGN_LINES,
            sensing: EpuckSensing::default(),
        };
        robot.drive([0; 2])?;
        robot.sensing.proximity = Some(robot.proximity()?);
        robot.counters = robot.encoders()?;
        robot.sensing.encoders = Some(WheelTurns::default());
        robot.foreign_lines = 0;
        Ok(robot)
    }

    /// Ends the connection and returns its port.
    pub fn into_port(self) -> P {
        self.port
    }

    fn proximity(&mut self) -> Result<[f64; PROXIMITY_SENSORS], SerialError> {
        Ok(numbers(self.ask("N", "n")?)?.map(f64::from))
    }

    fn encoders(&mut self) -> Result<[u16; 2], SerialError> {
        // Signed or not, the lower sixteen bits are the counter.
        Ok(numbers(self.ask("Q", "q")?)?.map(|counter: i32| {
            let [low, high, ..] = counter.to_le_bytes();
            u16::from_le_bytes([low, high])
        }))
    }

    /// Sets the speeds of the wheels, encoder steps per second, and checks that the robot took
    /// them.
    fn drive(&mut self, told: [i32; 2]) -> Result<(), SerialError> {
        let [left, right] = told;
        self.ask(&format!("D,{left},{right}"), "d")?;
        let set = numbers(self.ask("E", "e")?)?;
        if set == told {
            Ok(())
        } else {
            Err(SerialError::Speeds { told, set })
        }
    }

    /// Sends a command and returns the answer, which begins with the `expected` text.
    fn ask(&mut self, command: &str, expected: &'static str) -> Result<String, SerialError> {
        let line = format!("{command}\n");
        let sent = self.port.write_all(line.as_bytes());
        sent.and_then(|()| self.port.flush())
            .map_err(|error| SerialError::of(error.kind()))?;
        loop {
            let answer = self.line()?;
            if answer.split(',').next() == Some(expected) {
                return Ok(answer);
            }
            self.foreign_lines = self
                .foreign_lines
                .checked_sub(1)
                .ok_or(SerialError::Unexpected { expected, answer })?;
        }
    }

    /// Returns the next line that is not empty.
    fn line(&mut self) -> Result<String, SerialError> {
        let mut line = Vec::new();
        // Empty lines count too: a port that sends nothing else would hold the robot forever.
        for _ in 0..LONGEST {
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
                Ok(_) => line.push(byte[0]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(SerialError::of(error.kind())),
            }
        }
        Err(SerialError::Garbage)
    }
}

/// Returns the speed nearest to this one, rad/s, that the protocol can express and the wheels can
/// reach.
fn steps_per_second(speed: f64) -> i32 {
    let speed = speed.clamp(-MOST_WHEEL_SPEED, MOST_WHEEL_SPEED);
    (speed / ENCODER_STEP).round() as i32
}

/// Returns the numbers behind the letter of an answer.
fn numbers<const N: usize>(answer: String) -> Result<[i32; N], SerialError> {
    let parts = answer.split(',').skip(1);
    let numbers: Option<Vec<i32>> = parts.map(|part| part.trim().parse().ok()).collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or(SerialError::Numbers {
        expected: N,
        answer,
    })
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
            self.drive([command.left, command.right].map(steps_per_second))?;
            (self.wait)(Duration::from_micros(self.step_us));
            let proximity = self.proximity()?;
            Ok((proximity, self.encoders()?))
        };
        match step() {
            Ok((proximity, counters)) => {
                let turned = |now: u16, before: u16| {
                    f64::from(now.wrapping_sub(before).cast_signed()) * ENCODER_STEP
                };
                let ([left, right], before) = (counters, self.counters);
                self.sensing.encoders = Some(WheelTurns {
                    left: turned(left, before[0]),
                    right: turned(right, before[1]),
                });
                self.counters = counters;
                self.sensing.proximity = Some(proximity);
                self.sensing.time_us += self.step_us;
                Ok(())
            }
            Err(error) => {
                // If the robot still listens, it stops.
                let _ = self.port.write_all(b"D,0,0\n");
                let _ = self.port.flush();
                self.sensing.proximity = None;
                self.sensing.encoders = None;
                Err(error)
            }
        }
    }
}

/// Reason why the exchange with the e-puck failed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SerialError {
    /// The e-puck does not answer.
    #[error(
        "the e-puck does not answer in time: check that it is switched on and the port's time-out"
    )]
    TimedOut,
    /// The port is closed, or a device file gave nothing within its time-out.
    #[error(
        "the port gives nothing more: check that the e-puck is switched on, and connect to it again"
    )]
    Closed,
    /// The port reported an error of another kind.
    #[error("the port failed ({0:?}): check the connection to the e-puck and open the port again")]
    Port(ErrorKind),
    /// The answer is not a line of text.
    #[error("the e-puck sends bytes that are not text: check the port's speed and its firmware")]
    Garbage,
    /// The answer belongs to another command.
    #[error(
        "the e-puck answers {answer:?} where `{expected}` should stand: open its port again; if that does not help, switch it off and on"
    )]
    Unexpected {
        /// Text with which the answer should begin.
        expected: &'static str,
        /// Answer that was received.
        answer: String,
    },
    /// The answer has too few or too many numbers.
    #[error(
        "the e-puck answers {answer:?}, which does not have {expected} numbers: a part of the \
         line was lost; open its port again"
    )]
    Numbers {
        /// Number of numbers expected.
        expected: usize,
        /// Answer that was received.
        answer: String,
    },
    /// The wheels' speeds differ from those commanded.
    #[error(
        "the e-puck drives at {set:?} steps a second, but was commanded {told:?}: a byte was lost, or its remote control is in use; open its port again"
    )]
    Speeds {
        /// Commanded speed, left and right, encoder steps a second.
        told: [i32; 2],
        /// Speed that the robot reports, left and right, encoder steps a second.
        set: [i32; 2],
    },
    /// A speed is not a number.
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
        answers: VecDeque<Answer>,
        coming: VecDeque<u8>,
        timed_out: bool,
        sent: Vec<u8>,
    }

    impl Script {
        fn new(answers: &[Answer]) -> Self {
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

    type Answer = Option<&'static [u8]>;

    const D: Answer = Some(b"d\r\n");
    const STILL: Answer = Some(b"e,0,0\r\n");
    /// As told by [`AHEAD`]: the right wheel as fast as it can.
    const E: Answer = Some(b"e,100,999\r\n");
    const N: Answer = Some(b"n,10,20,30,40,50,60,70,80\r\n");
    const Q: Answer = Some(b"q,65530,-6\r\n");
    const OPENED: [Answer; 4] = [D, STILL, N, Q];
    const AHEAD: WheelSpeeds = WheelSpeeds {
        left: 100.0 * ENCODER_STEP,
        right: 100.0,
    };

    fn after(answers: &[Answer]) -> (Result<(), SerialError>, Script) {
        let mut script = OPENED.to_vec();
        script.extend(answers);
        let mut robot = SerialEpuck::open(Script::new(&script), 100_000, |_| ()).unwrap();
        let result = robot.step(&AHEAD);
        let is_silent = robot.sensing().proximity.is_none();
        assert_eq!(result.is_err(), is_silent);
        (result, robot.into_port())
    }

    #[test]
    fn it_speaks_the_protocol() {
        let script = [D, STILL, N, Q, D, E, N, Some(b"\r\nq,4,94\r\n")];
        let mut waited = Duration::ZERO;
        let mut robot =
            SerialEpuck::open(Script::new(&script), 100_000, |time| waited += time).unwrap();
        robot.step(&AHEAD).unwrap();
        let sensing = *robot.sensing();
        assert!((sensing.proximity.unwrap()[7] - 80.0).abs() < 1e-9);
        // From 65530 over 0 to 4, and from -6 to 94.
        let turns = sensing.encoders.unwrap();
        assert!(
            (turns.left - 10.0 * ENCODER_STEP).abs() < 1e-12,
            "{turns:?}"
        );
        assert!(
            (turns.right - 100.0 * ENCODER_STEP).abs() < 1e-12,
            "{turns:?}"
        );
        assert_eq!(sensing.time_us, 100_000);
        let sent = String::from_utf8(robot.into_port().sent).unwrap();
        assert_eq!(sent, "D,0,0\nE\nN\nQ\nD,100,999\nE\nN\nQ\n");
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
        let speeds = |set| SerialError::Speeds {
            told: [100, 999],
            set,
        };
        let late = SerialError::Unexpected {
            expected: "e",
            answer: "d".into(),
        };
        let cases: [(&[Answer], SerialError); 13] = [
            (&[None], SerialError::TimedOut),
            (&[], SerialError::Closed),
            (&[D, None], SerialError::TimedOut),
            (&[D, E, N, None], SerialError::TimedOut),
            (&[Some(&[0xff, 0xfe, b'\n'])], SerialError::Garbage),
            (&[Some(&[b'x'; 300])], SerialError::Garbage),
            (&[Some(b"welcome\r\n")], unexpected),
            // The answer to a command of before came late.
            (&[D, D], late),
            (&[D, Some(b"e,100\r\n")], numbers(2, "e,100")),
            // A digit was lost on the way to the robot.
            (&[D, Some(b"e,10,999\r\n")], speeds([10, 999])),
            // A remote control said stop.
            (&[D, STILL], speeds([0, 0])),
            (&[D, E, Some(b"n,1,2,3\r\n")], numbers(8, "n,1,2,3")),
            (&[D, E, N, Some(b"q,1,\r\n")], numbers(2, "q,1,")),
        ];
        for (answers, expected) in cases {
            let (result, port) = after(answers);
            assert_eq!(result, Err(expected));
            assert!(port.sent.ends_with(b"D,0,0\n"));
        }
    }

    #[test]
    fn opening_passes_over_what_is_no_answer() {
        // A greeting, and what a step that timed out left unread: its `e` and the `d` to the stop.
        let greeting = b"\r\nWELCOME to the e-Puck\r\ne,100,999\r\nd\r\nd\r\n";
        let script = [Some(greeting.as_slice()), STILL, N, Q, D, E, N, Q];
        let mut robot = SerialEpuck::open(Script::new(&script), 1, |_| ()).unwrap();
        robot.step(&AHEAD).unwrap();
    }

    #[test]
    fn a_robot_that_does_not_stop_is_not_opened() {
        let open = |script: &[Answer]| SerialEpuck::open(Script::new(script), 1, |_| ()).err();
        let still_driving = SerialError::Speeds {
            told: [0; 2],
            set: [100, 999],
        };
        assert_eq!(open(&[D, E]), Some(still_driving));
        assert_eq!(open(&[None]), Some(SerialError::TimedOut));
        let talk = b"z,Command not found\r\n".repeat(FOREIGN_LINES + 1);
        let unexpected = SerialError::Unexpected {
            expected: "d",
            answer: "z,Command not found".into(),
        };
        assert_eq!(open(&[Some(talk.leak())]), Some(unexpected));
    }

    #[test]
    fn speeds_that_are_none_are_refused() {
        let mut robot = SerialEpuck::open(Script::new(&OPENED), 1, |_| ()).unwrap();
        let speeds = WheelSpeeds {
            left: f64::NAN,
            right: 0.0,
        };
        assert_eq!(robot.step(&speeds), Err(SerialError::NotFinite));
    }
}
