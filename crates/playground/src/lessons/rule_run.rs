//! Sends a robot with a rule through a maze, from cell to cell in the simulator.

use alloc::collections::BTreeMap;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use tolman_arena::BoxError;
use tolman_arena::course::Course;
use tolman_arena::pioneer::{CORRIDOR_WIDTH, calibrated, without_noise};
use tolman_film::scenery_of;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze};
use tolman_replay::robot::{Body, Robot, Scan, TurnTranslate};
use tolman_replay::sim::Solo;
use tolman_replay::sim::robots::{LaserPioneer, LaserPioneerConfig};
use tolman_replay::{Notes, Replay, RobotTrack, json};
use tolman_systems::control::heading_of;

use super::start_of;
use crate::PlaygroundError;

/// How a run by a rule ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RuleEnd {
    /// The robot came to the goal.
    Arrived,
    /// It came to the same cell with the same heading again and again, so it will forever.
    Circles,
    /// No line of its rule named an open side.
    Stuck,
}

/// A run by a rule.
#[derive(Clone, Debug)]
pub(super) struct RuleRun {
    pub(super) end: RuleEnd,
    /// Length of the way, cells.
    pub(super) cells: usize,
    /// The run in the replay player's form.
    pub(super) replay: String,
}

/// Number of times that the robot comes to a cell with the same heading. A rule without a memory
/// repeats itself from the second time on; the film shows it once more.
const ROUNDS: u32 = 3;

/// Number of time steps in which the robot drives from one cell to the next.
const DRIVE: u32 = 4;

/// Sends the laser Pioneer of the MSLST paper, without noise, from the start of a maze. In each
/// cell it goes to the first side of `rule` that is open; north is ahead.
pub(super) fn run(maze: &Maze, rule: &[Direction]) -> Result<RuleRun, PlaygroundError> {
    let course = Course::new("lesson", maze.clone(), CORRIDOR_WIDTH)?;
    let mut driver = Driver::new(&course)?;
    let mut visits: BTreeMap<(Cell, Direction), u32> = BTreeMap::new();
    let mut lines = Notes::new("line of the rule");
    let mut cells = 0;
    let end = loop {
        if maze.goals().contains(&driver.cell()) {
            break RuleEnd::Arrived;
        }
        let rounds = visits.entry((driver.cell(), driver.heading)).or_default();
        *rounds += 1;
        if *rounds == ROUNDS {
            break RuleEnd::Circles;
        }
        let is_open = |(_, side): &(usize, &Direction)| driver.is_open(**side);
        let Some((line, side)) = (1..).zip(rule).find(is_open) else {
            break RuleEnd::Stuck;
        };
        lines.say(driver.poses.len() as u32 - 1, line.to_string());
        driver.go(*side).map_err(PlaygroundError::Robot)?;
        cells += 1;
    };
    let mut track = driver.track();
    let scenery = scenery_of(&course, &mut track);
    track.notes = vec![lines];
    let step_s = configured(&course).step_us as f64 * 1e-6;
    let replay = Replay::new("A robot with a rule", step_s, scenery, vec![track]);
    Ok(RuleRun {
        end,
        cells,
        replay: json(&replay)?,
    })
}

/// Returns the robot, which turns by an eighth of a circle in a step.
fn configured(course: &Course) -> LaserPioneerConfig {
    let mut config = without_noise(&calibrated());
    config.turn_per_step = FRAC_PI_4;
    config.translate_per_step = course.pitch() / f64::from(DRIVE);
    config
}

/// A robot that is driven from the middle of one cell to that of the next.
struct Driver<'a> {
    course: &'a Course,
    robot: Solo<LaserPioneer>,
    heading: Direction,
    poses: Vec<Pose>,
}

impl<'a> Driver<'a> {
    fn new(course: &'a Course) -> Result<Self, PlaygroundError> {
        let (start, heading) = start_of(&course.maze);
        let pose = Pose::new(course.cell_centre(start), heading_of(heading));
        let cannot = |error: BoxError| PlaygroundError::Robot(error);
        let model = LaserPioneer::new(configured(course)).map_err(|error| cannot(error.into()))?;
        let robot = Solo::new(course.world.clone(), model, pose, 1);
        Ok(Self {
            course,
            robot: robot.map_err(|error| cannot(error.into()))?,
            heading,
            poses: vec![pose],
        })
    }

    fn cell(&self) -> Cell {
        let at = self.robot.truth().pose.position;
        let cell = self.course.world.cell_at(at);
        cell.unwrap_or_else(|| start_of(&self.course.maze).0)
    }

    /// Returns whether the laser reaches farther to this side than the corridor is wide.
    fn is_open(&self, side: Direction) -> bool {
        let scan: Option<&Scan> = self.robot.sensing().scan.as_ref();
        let range = scan.and_then(|scan| scan.range_towards(turn_to(side), 0));
        range.is_some_and(|range| range >= self.course.corridor_width)
    }

    /// Turns to a side and drives one cell.
    fn go(&mut self, side: Direction) -> Result<(), BoxError> {
        let turn = turn_to(side);
        let turn = TurnTranslate {
            turn: turn.signum(),
            translate: 0.0,
        };
        for _ in 0..(turn_to(side).abs() / FRAC_PI_4).round() as u32 {
            self.step(turn)?;
        }
        let drive = TurnTranslate {
            turn: 0.0,
            translate: 1.0,
        };
        for _ in 0..DRIVE {
            self.step(drive)?;
        }
        self.heading = self.heading.turned(side);
        Ok(())
    }

    fn step(&mut self, command: TurnTranslate) -> Result<(), BoxError> {
        self.robot.step(&command)?;
        self.poses.push(self.robot.truth().pose);
        Ok(())
    }

    fn track(self) -> RobotTrack {
        let config = configured(self.course);
        let body = Body::Circle {
            radius: config.radius,
        };
        let mut track = RobotTrack::new("robot", body, self.poses);
        track.ring = Some(config.ring);
        track
    }
}

/// Returns the turn to a side of the robot, rad, counter-clockwise.
const fn turn_to(side: Direction) -> f64 {
    match side {
        Direction::North => 0.0,
        Direction::East => -FRAC_PI_2,
        Direction::South => 2.0 * FRAC_PI_2,
        Direction::West => FRAC_PI_2,
    }
}
