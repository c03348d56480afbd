//! The way of a mouse through a maze, to show and to write down.

use std::path::Path;

use serde_json::Value;
use tolman_arena::course::Course;
use tolman_arena::micromouse::SideSeen;
use tolman_film::scenery_of;
use tolman_geom::{Point, Pose};
use tolman_maze::{Cell, Direction, Maze};
use tolman_replay::{Mark, Marks, Notes, Replay, RobotTrack};
use tolman_robot::Body;

use super::walls_known::WallsKnown;
use crate::cli::live::{Live, Now, Scene};
use crate::cli::looks::Looks;
use crate::cli::{OrBadInput, Result, maze, picture};

/// Distance between the middles of two cells, as in competitions, m.
pub(in crate::cli) const PITCH: f64 = 0.18;

/// Radius of the circle that the mouse is drawn as, in pitches.
const RADIUS: f64 = 0.25;

/// Time for which a step is shown, µs; the rules give a step no duration.
const STEP_US: u64 = 200_000;

/// A mouse's way, step by step.
#[derive(Debug)]
pub(in crate::cli) struct Way {
    /// Name of the maze.
    name: String,
    course: Course,
    /// Distance between the middles of two cells, m.
    pitch: f64,
    /// Facts of the whole way, for the first line of the trace.
    header: Value,
    /// Pose before the first step, and after each step.
    poses: Vec<Pose>,
    /// Result of each of the mouse's steps.
    steps: Vec<WayStep>,
    walls: WallsKnown,
    /// Number of steps before its last run, where that is to be drawn apart; `None` otherwise.
    run: Option<usize>,
    /// Numbers of the steps after which the mouse was put back to the start.
    lifts: Vec<u32>,
    live: Live,
}

/// Result of one of the mouse's steps.
#[derive(Debug)]
pub(in crate::cli) struct WayStep {
    pub(in crate::cli) pose: Pose,
    /// Description of the step in words.
    pub(in crate::cli) words: String,
    /// Line of the trace.
    pub(in crate::cli) line: Value,
    /// End of the step.
    pub(in crate::cli) came: Came,
}

/// End of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) enum Came {
    /// The mouse went where it wanted.
    Moved,
    /// A wall stopped the mouse.
    Crashed,
    /// The mouse was put back to the start.
    PutBack,
}

impl Way {
    /// Returns the way of a mouse that is about to begin, or `None` if `looks` asks for nothing to
    /// show. The middles of two cells are `pitch` metres apart, and `step_limit` is the maximum
    /// number of steps. `header` goes into the first line of the trace, beside its format.
    ///
    /// # Errors
    /// If the maze marks no start, or the terminal has gone.
    pub(in crate::cli) fn watched(
        file: &Path,
        maze: &Maze,
        header: Value,
        pitch: f64,
        looks: &Looks,
        step_limit: Option<u32>,
    ) -> Result<Option<Self>> {
        if !looks.any() {
            return Ok(None);
        }
        let name = maze::name(file);
        let course = Course::new(&name, maze.clone(), pitch).or_bad_input()?;
        let start = course.start().or_bad_input()?;
        let scene = || Scene {
            course: course.clone(),
            word: "mouse".to_owned(),
            seed: header["seed"].as_u64().unwrap_or(0),
            start,
            step_us: STEP_US,
            radius: RADIUS * pitch,
            step_limit,
        };
        let live = Live::open(looks.live, scene)?;
        Ok(Some(Self {
            name,
            course,
            header,
            poses: vec![start],
            steps: Vec::new(),
            pitch,
            walls: WallsKnown::new(maze.grid(), pitch),
            run: None,
            lifts: Vec::new(),
            live,
        }))
    }

    /// Returns the pose in the middle of a cell, looking towards `direction`.
    pub(in crate::cli) fn in_cell(&self, cell: Cell, direction: Direction) -> Pose {
        self.course.in_cell(cell, direction)
    }

    /// Records the mouse's view in its cell.
    pub(in crate::cli) fn see(&mut self, sides: &[SideSeen]) {
        let step = self.steps.len() as u32;
        sides.iter().for_each(|side| self.walls.see(step, *side));
    }

    /// Returns whether the mouse knows that there is no wall on this side of a cell.
    pub(in crate::cli) fn knows_open(&self, cell: Cell, side: Direction) -> bool {
        self.walls.knows_open(cell, side)
    }

    /// Records that the last run begins here. A picture shows it apart from the steps before.
    pub(in crate::cli) fn begin_run(&mut self) {
        self.run = Some(self.steps.len());
    }

    /// Adds a step, and shows it until the next is due.
    pub(in crate::cli) fn go(&mut self, step: WayStep) {
        if step.came == Came::PutBack {
            self.lifts.push(self.poses.len() as u32);
        }
        self.live.watch(&Now {
            pose: step.pose,
            bump: step.came == Came::Crashed,
            action: &step.words,
            ended: None,
            scan: None,
        });
        self.poses.push(step.pose);
        self.steps.push(step);
    }

    /// Shows the outcome, `told` in words, and writes the files that `looks` requests.
    ///
    /// # Errors
    /// If a file cannot be written, or the terminal has gone.
    pub(in crate::cli) fn show(mut self, looks: &Looks, told: &str) -> Result {
        looks.check()?;
        self.live.close(told)?;
        looks.write(
            || Ok(self.trace().into_bytes()),
            || {
                let (before, run) = self.poses.split_at(self.run.unwrap_or(0));
                picture::of_runs(&self.course, &[before, run], told)
            },
            || self.replay(told),
        )
    }

    /// Returns the way as JSON lines: a header, then one line per step.
    fn trace(&self) -> String {
        let mut header = self.header.clone();
        header["format"] = "tolman-mouse-trace".into();
        header["version"] = 1.into();
        header["maze"] = self.name.as_str().into();
        let mut text = format!("{header}\n");
        for (number, step) in (1..).zip(&self.steps) {
            let mut line = step.line.clone();
            line["step"] = Value::from(number);
            text += &format!("{line}\n");
        }
        text
    }

    fn replay(&self, told: &str) -> Replay {
        let radius = RADIUS * self.pitch;
        let body = Body::Circle { radius };
        let mut track = RobotTrack::new("mouse", body, self.poses.clone());
        let scenery = scenery_of(&self.course, &mut track);
        let mut moves = Notes::new("move");
        let mut crashes = Marks::new(Mark::Bump, "crash", []);
        for (number, step) in (1..).zip(&self.steps) {
            moves.say(number, step.words.clone());
            if step.came == Came::Crashed {
                crashes.steps.push(number);
            }
        }
        track.notes = vec![moves];
        track.series.push(self.walls.count());
        track.maps = vec![self.walls.growth()];
        let put_back = Marks::new(Mark::Event, "put back to the start", self.lifts.clone());
        track.marks = vec![crashes, put_back];
        track.lifts.clone_from(&self.lifts);
        let title = format!("A mouse in {}", self.name);
        let replay = Replay::new(title, STEP_US as f64 * 1e-6, scenery, vec![track]);
        let facts = self.header.as_object().into_iter().flatten();
        let words = facts.filter_map(|(name, value)| Some((name, value.as_str()?)));
        let replay = replay.fact("maze", &self.name);
        let replay = words.fold(replay, |replay, (name, value)| replay.fact(name, value));
        replay.fact("outcome", told)
    }
}

/// Returns the point, m, that is `x` and `y` half-cells from the south-west corner of the maze.
pub(in crate::cli) fn half_cells(x: f64, y: f64) -> Point {
    Point::new(0.5 * PITCH * x, 0.5 * PITCH * y)
}
