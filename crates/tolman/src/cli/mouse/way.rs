//! A mouse's way through a maze, for whoever looks at it.

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

/// From the middle of a cell to that of the next, as in competitions, m.
pub(in crate::cli) const PITCH: f64 = 0.18;

/// The radius of the circle that the mouse is drawn as, in pitches.
const RADIUS: f64 = 0.25;

/// A step has no length in time: it is played as if it took this long, µs.
const STEP_US: u64 = 200_000;

/// A mouse's way, step by step.
#[derive(Debug)]
pub(in crate::cli) struct Way {
    /// The name of the maze.
    name: String,
    course: Course,
    /// From the middle of a cell to that of the next, m.
    pitch: f64,
    /// What is to be known of it as a whole, in the trace's first line.
    header: Value,
    /// Before the first step, and after each.
    poses: Vec<Pose>,
    /// What it did in each step.
    steps: Vec<WayStep>,
    walls: WallsKnown,
    /// Steps after which its last run began, where that is to be seen apart.
    run: Option<usize>,
    /// Steps after which it was put back to the start.
    lifts: Vec<u32>,
    /// Who looks while it goes.
    live: Option<Live>,
}

/// What a mouse did in one step.
#[derive(Debug)]
pub(in crate::cli) struct WayStep {
    pub(in crate::cli) pose: Pose,
    /// In words.
    pub(in crate::cli) words: String,
    /// For the trace.
    pub(in crate::cli) line: Value,
    /// What came of it.
    pub(in crate::cli) came: Came,
}

/// What comes of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) enum Came {
    /// It went where it wanted.
    Moved,
    /// A wall stopped it.
    Crashed,
    /// It was put back to the start.
    PutBack,
}

impl Way {
    /// Returns a way of no steps yet; `header` is what the trace begins with, beside its format.
    ///
    /// # Errors
    /// If the maze marks no start.
    pub(in crate::cli) fn new(name: String, maze: &Maze, header: Value) -> Result<Self, Failure> {
        Self::of_pitch(name, maze, header, PITCH)
    }

    /// Returns the same in cells of another size: `pitch` is from the middle of a cell to that of
    /// the next, m.
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

    /// Lets `looks` watch it from now on, step by step, if that is asked for; `step_limit` is the
    /// most steps it may have.
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

    /// Returns the middle of a cell, looking to `direction`.
    pub(in crate::cli) fn in_cell(&self, cell: Cell, direction: Direction) -> Pose {
        self.course.in_cell(cell, direction)
    }

    /// Notes what the mouse sees where it is.
    pub(in crate::cli) fn see(&mut self, sides: &[SideSeen]) {
        let step = self.steps.len() as u32;
        sides.iter().for_each(|side| self.walls.see(step, *side));
    }

    /// Returns whether the mouse knows that no wall stands on this side of a cell.
    pub(in crate::cli) fn knows_open(&self, cell: Cell, side: Direction) -> bool {
        self.walls.knows_open(cell, side)
    }

    /// Notes that the last run begins here: a picture shows it apart from what came before.
    pub(in crate::cli) fn begin_run(&mut self) {
        self.run = Some(self.steps.len());
    }

    /// Notes a step, and shows it to who looks until the next is due.
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

    /// Shows its outcome, `told` in words, to who looked, and writes it down as `looks` asks for.
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

    /// Returns the way as JSON lines: a header, and a line a step.
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

/// Returns a point of the maze, counted in half-cells from the south-west corner, m.
pub(in crate::cli) fn half_cells(x: f64, y: f64) -> Point {
    Point::new(0.5 * PITCH * x, 0.5 * PITCH * y)
}
