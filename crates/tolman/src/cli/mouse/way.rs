//! The way of a mouse through a maze, to show and to write down.

use anyhow::Context;
use serde_json::{Value, json};
use tolman_arena::course::Course;
use tolman_arena::micromouse::SideSeen;
use tolman_geom::{Point, Pose};
use tolman_maze::{Cell, Direction, Maze};
use tolman_replay::{Floor, Mark, Marks, Notes, Replay, RobotTrack, Scenery};
use tolman_robot::Body;

use super::walls_known::WallsKnown;
use crate::cli::live::{Live, Now, Scene};
use crate::cli::looks::Looks;
use crate::cli::{Failure, OrBadInput, file, picture, replay_file};

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
    /// View that shows the way live; `None` without one.
    live: Option<Live>,
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
    /// Returns a way without steps. `header` goes into the first line of the trace, beside its
    /// format.
    ///
    /// # Errors
    /// If the maze marks no start.
    pub(in crate::cli) fn new(name: String, maze: &Maze, header: Value) -> Result<Self, Failure> {
        Self::of_pitch(name, maze, header, PITCH)
    }

    /// Returns the same as [`new`](Self::new), for cells of another size: the distance between the
    /// middles of two cells is `pitch`, m.
    ///
    /// # Errors
    /// If the maze marks no start.
    pub(in crate::cli) fn of_pitch(
        name: String,
        maze: &Maze,
        header: Value,
        pitch: f64,
    ) -> Result<Self, Failure> {
        let course = Course::new(&name, maze.clone(), pitch).or_bad_input()?;
        let start = course.start().or_bad_input()?;
        Ok(Self {
            name,
            course,
            header,
            poses: vec![start],
            steps: Vec::new(),
            pitch,
            walls: WallsKnown::new(maze.grid(), pitch),
            run: None,
            lifts: Vec::new(),
            live: None,
        })
    }

    /// Shows the way step by step from now on, if `looks` asks for it. `step_limit` is the maximum
    /// number of steps.
    ///
    /// # Errors
    /// If the terminal has gone.
    pub(in crate::cli) fn watched(
        mut self,
        looks: &Looks,
        step_limit: Option<u32>,
    ) -> Result<Self, Failure> {
        if looks.live {
            self.live = Some(Live::open(Scene {
                course: self.course.clone(),
                word: "mouse".to_owned(),
                seed: self.header["seed"].as_u64().unwrap_or(0),
                start: self.poses[0],
                step_us: STEP_US,
                radius: RADIUS * self.pitch,
                step_limit,
            })?);
        }
        Ok(self)
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
        if let Some(live) = &mut self.live {
            live.watch(&Now {
                pose: step.pose,
                bump: step.came == Came::Crashed,
                action: &step.words,
                ended: None,
                scan: None,
            });
        }
        self.poses.push(step.pose);
        self.steps.push(step);
    }

    /// Shows the outcome, `told` in words, and writes the files that `looks` requests.
    ///
    /// # Errors
    /// If a file cannot be written, or the terminal has gone.
    pub(in crate::cli) fn show(mut self, looks: &Looks, told: &str) -> Result<(), Failure> {
        let overwrite = looks.overwrite()?;
        if let Some(live) = self.live.take() {
            live.close(told).context("the terminal has gone")?;
        }
        if let Some(path) = &looks.trace {
            file::write(path, self.trace())?;
        }
        if let Some(path) = &looks.svg {
            let (before, run) = self.poses.split_at(self.run.unwrap_or(0));
            file::write(path, picture::of_runs(&self.course, &[before, run], told))?;
        }
        match &looks.replay {
            Some(path) => replay_file::write(path, self.replay(told), overwrite),
            None => Ok(()),
        }
    }

    /// Returns the way as JSON lines: a header, then one line per step.
    fn trace(&self) -> String {
        let mut header = json!({ "format": "tolman-mouse-trace", "version": 1, "maze": self.name });
        if let (Value::Object(header), Value::Object(more)) = (&mut header, &self.header) {
            header.extend(more.clone());
        }
        let mut text = format!("{header}\n");
        for (number, step) in (1..).zip(&self.steps) {
            let mut line = json!({ "step": number });
            if let (Value::Object(line), Value::Object(more)) = (&mut line, &step.line) {
                line.extend(more.clone());
            }
            text += &format!("{line}\n");
        }
        text
    }

    fn replay(self, told: &str) -> Replay {
        let world = &self.course.world;
        let radius = RADIUS * self.pitch;
        let body = Body::Circle { radius };
        let mut track = RobotTrack::new("mouse", body, self.poses.clone());
        let mut scenery = Scenery::of_world(world);
        if let Some(floor) = Floor::from(world, self.poses[0].position) {
            scenery.zones.extend(floor.solid());
            let places = self.poses.iter().map(|pose| pose.position);
            track.series.push(floor.coverage(places));
        }
        let mut moves = Notes::new("move");
        for (step, done) in (1..).zip(&self.steps) {
            moves.say(step, done.words.clone());
        }
        track.notes = vec![moves];
        track.series.push(self.walls.count());
        track.maps = vec![self.walls.growth()];
        track.marks = vec![
            Marks::new(Mark::Bump, "crash", self.crashes()),
            Marks::new(Mark::Event, "put back to the start", self.lifts.clone()),
        ];
        track.lifts = self.lifts;
        let title = format!("A mouse in {}", self.name);
        let replay = Replay::new(title, STEP_US as f64 * 1e-6, scenery, vec![track]);
        let facts = self.header.as_object().into_iter().flatten();
        let words = facts.filter_map(|(name, value)| Some((name, value.as_str()?)));
        let replay = words.fold(replay.fact("maze", self.name), |replay, (name, value)| {
            replay.fact(name, value)
        });
        replay.fact("outcome", told)
    }

    fn crashes(&self) -> Vec<u32> {
        let steps = (1..).zip(&self.steps);
        let crashed = steps.filter(|(_, step)| step.came == Came::Crashed);
        crashed.map(|(number, _)| number).collect()
    }
}

/// Returns the point, m, that is `x` and `y` half-cells from the south-west corner of the maze.
pub(in crate::cli) fn half_cells(x: f64, y: f64) -> Point {
    Point::new(0.5 * PITCH * x, 0.5 * PITCH * y)
}
