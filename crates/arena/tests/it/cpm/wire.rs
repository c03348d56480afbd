//! Drives the agent through the serial driver. A firmware speaks the real robot's protocol and
//! drives the simulated one.

use alloc::collections::VecDeque;
use alloc::rc::Rc;
use core::cell::RefCell;
use core::time::Duration;
use std::io::{self, ErrorKind, Read, Write};

use tolman_arena::cpm::{CpmRun, SimulatedEpuck, epuck, walker_config};
use tolman_control::epuck::{Pilot, Profile, SensorAlignment, TURN_STEP};
use tolman_maps::cpm::CpMap;
use tolman_robot::epuck::{ENCODER_STEP, EpuckSensing, WheelSpeeds};
use tolman_robot::epuck_serial::{SerialEpuck, SerialError};
use tolman_robot::{Landmark, Landmarked, Robot, SensesLandmarks};
use tolman_sim::robots::Epuck;
use tolman_systems::cpm::{
    Aim, CpmConfig, CpmFailure, CpmRobot, Done, EpisodeSummary, Mode, WalkError, Walker,
    WalkerConfig,
};

use super::trials::{PATTERNS, maze_1};

const WIDTH: f64 = 0.25;

/// Firmware of the robot: it reads lines, answers, and turns the wheels by whole steps of the
/// motors.
struct Firmware {
    body: SimulatedEpuck,
    /// Speeds of the wheels, steps per second.
    speeds: [i32; 2],
    /// Angles that the wheels have turned since the firmware was started, rad.
    turned: [f64; 2],
    heard: Vec<u8>,
    answers: VecDeque<u8>,
    /// Number of incoming bytes until the next one is lost; `None` if no byte will be lost.
    lost: Option<usize>,
}

impl Firmware {
    fn new(body: SimulatedEpuck) -> Self {
        Self {
            body,
            speeds: [0; 2],
            turned: [0.0; 2],
            heard: Vec::new(),
            answers: VecDeque::new(),
            lost: None,
        }
    }

    fn hear(&mut self, byte: u8) {
        let lost = self.lost;
        self.lost = lost.and_then(|left| left.checked_sub(1));
        if lost == Some(0) {
            return;
        }
        if byte != b'\n' {
            self.heard.push(byte);
            return;
        }
        let line = core::mem::take(&mut self.heard);
        let answer = self.answer(core::str::from_utf8(&line).unwrap());
        self.answers.extend(answer.bytes());
        self.answers.extend(b"\r\n");
    }

    fn answer(&mut self, line: &str) -> String {
        let mut parts = line.split(',');
        let letter = parts.next().unwrap_or_default();
        let numbers: Vec<i32> = parts.map_while(|part| part.parse().ok()).collect();
        match (letter, numbers.as_slice()) {
            ("D", [left, right]) => {
                self.speeds = [*left, *right];
                "d".into()
            }
            ("E", []) => format!("e,{},{}", self.speeds[0], self.speeds[1]),
            ("N", []) => {
                let values = self.body.sensing().proximity.unwrap();
                let values = values.map(|value| format!(",{}", libm::round(value) as i32));
                format!("n{}", values.concat())
            }
            ("Q", []) => {
                // Counters of sixteen bits.
                let [left, right] = self
                    .turned
                    .map(|turned| libm::floor(turned / ENCODER_STEP) as i64 as i16);
                format!("q,{left},{right}")
            }
            _ => "z,Command not found".into(),
        }
    }

    /// Simulates a time step.
    fn pass(&mut self) {
        let [left, right] = self.speeds.map(|speed| f64::from(speed) * ENCODER_STEP);
        self.body.step(&WheelSpeeds { left, right }).unwrap();
        let encoders = self.body.sensing().encoders.unwrap();
        self.turned[0] += encoders.left;
        self.turned[1] += encoders.right;
    }
}

/// Our end of the serial line.
#[derive(Clone)]
struct Line(Rc<RefCell<Firmware>>);

impl Line {
    /// Opens the driver on the line. Its landmarks are those of the simulation.
    fn robot(
        &self,
    ) -> Result<impl CpmRobot<Error = SerialError, Sensing = EpuckSensing> + use<>, SerialError>
    {
        let (clock, watcher) = (self.clone(), self.clone());
        let wait = move |_: Duration| clock.0.borrow_mut().pass();
        let robot = SerialEpuck::open(self.clone(), epuck().step_us, wait)?;
        Ok(Landmarked::new(robot, move |_| {
            watcher.0.borrow().body.landmark()
        }))
    }
}

impl Read for Line {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match (self.0.borrow_mut().answers.pop_front(), bytes.first_mut()) {
            (Some(answer), Some(byte)) => {
                *byte = answer;
                Ok(1)
            }
            _ => Err(ErrorKind::TimedOut.into()),
        }
    }
}

impl Write for Line {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut firmware = self.0.borrow_mut();
        for byte in bytes {
            firmware.hear(*byte);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn simulated(seed: u64) -> SimulatedEpuck {
    let maze = maze_1();
    let robot = Epuck::new(epuck()).unwrap();
    maze.robot_at(maze.start().unwrap(), robot, seed).unwrap()
}

fn line(seed: u64) -> Line {
    Line(Rc::new(RefCell::new(Firmware::new(simulated(seed)))))
}

/// Returns the walker's configuration for a robot whose encoders count steps.
fn config() -> WalkerConfig {
    let mut config = walker_config(&epuck(), WIDTH).unwrap();
    config.pilot.turn_tolerance = TURN_STEP;
    config
}

#[test]
fn it_sweeps_and_follows_as_on_the_simulator() {
    let line = line(1);
    let mut near = Pilot::new(simulated(1), walker_config(&epuck(), WIDTH).unwrap().pilot);
    let mut far = Pilot::new(line.robot().unwrap(), config().pilot);
    let [one, other] = [near.sweep().unwrap(), far.sweep().unwrap()]
        .map(|sweep| Profile::of(&sweep, SensorAlignment::Mounts).unwrap());
    for (one, other) in one.values().iter().zip(other.values()) {
        assert!((one - other).abs() < 20.0, "{one} {other}");
    }
    for _ in 0..12 {
        near.follow(0.5).unwrap();
        far.follow(0.5).unwrap();
        near.sweep().unwrap();
        far.sweep().unwrap();
    }
    let one = near.robot().truth().pose.position;
    let firmware = line.0.borrow();
    let other = firmware.body.truth().pose.position;
    let start = firmware.body.path()[0].position;
    assert!((one - other).norm() < 0.01, "{one} {other}");
    assert!((other - start).norm() > 0.2, "{other}");
    assert_eq!(firmware.body.bumps(), 0);
}

/// Finds the goal, is lifted to the start by `lift`, and goes to the goal again.
fn play<B: CpmRobot>(
    body: B,
    config: WalkerConfig,
    seed: u64,
    lift: impl FnOnce(&mut B),
) -> Result<([EpisodeSummary; 2], CpMap), CpmFailure<B::Error>> {
    let mode = Mode::Paper(CpmConfig::online());
    let mut run = CpmRun::begin(body, config, &PATTERNS, mode, seed)?;
    let first = run.pursue(Aim::Find(Landmark::Goal), |_, _, _| {})?;
    lift(run.walker.body_mut());
    run.layer.placed_at_start(&mut run.walker)?;
    let second = run.drive_to_goal()?.unwrap();
    Ok(([first, second], run.layer.map().clone()))
}

#[test]
fn it_finds_the_goal_and_goes_there_again() {
    for seed in 0..3 {
        let line = line(seed);
        let start = line.0.borrow().body.truth().pose;
        let (near, one) = play(
            simulated(seed),
            walker_config(&epuck(), WIDTH).unwrap(),
            seed,
            |body| body.place(start).unwrap(),
        )
        .unwrap();
        let lifted = line.clone();
        let (far, other) = play(line.robot().unwrap(), config(), seed, move |_| {
            lifted.0.borrow_mut().body.place(start).unwrap();
        })
        .unwrap();
        assert_eq!(far.map(|episode| episode.done), [Done::Reached; 2]);
        let firmware = line.0.borrow();
        assert_eq!(firmware.body.landmark(), Some(Landmark::Goal));
        assert_eq!(firmware.body.bumps(), 0);
        assert!(far[1].seconds < 0.5 * far[0].seconds, "{far:?}");
        // As on the simulator itself: as many fragments, in nearly as long a time.
        assert_eq!(other.fragments().count(), one.fragments().count());
        for (near, far) in near.iter().zip(&far) {
            assert!((far.seconds / near.seconds - 1.0).abs() < 0.2);
        }
    }
}

#[test]
fn what_is_lost_on_the_wire_stops_it_and_it_can_be_opened_again() {
    let line = line(1);
    let mut walker = Walker::new(line.robot().unwrap(), config());
    walker.begin().unwrap();
    // `D,-994,994` without its first digit.
    line.0.borrow_mut().lost = Some(3);
    let error = walker.look_around().unwrap_err();
    let told = error.to_string();
    assert!(
        told.contains("-94, 994") && told.contains("-994, 994"),
        "{told}"
    );
    assert!(matches!(error, WalkError::Pilot(_)));
    assert_eq!(line.0.borrow().speeds, [0; 2]);
    let mut again = Walker::new(line.robot().unwrap(), config());
    again.begin().unwrap();
}
