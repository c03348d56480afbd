//! Worlds for MSLST and its baselines, and the measurements of every run there.

mod drawings;
mod files;
mod measured;
mod paper;
mod played;
mod right_hand;

use alloc::collections::BTreeMap;

use serde::Serialize;
use tolman_geom::Point;
use tolman_maze::{Maze, MazeFile};
use tolman_sim::robots::LaserPioneerConfig;

use tolman_arena::Mind;
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::episode::{self, EpisodeError, Trial};
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, Job, Row};
use tolman_film::Recorder;
use tolman_replay::Replay;

pub(super) use drawings::{Condition, Drawing, LARGE_DRAWINGS};
pub(super) use files::{from_file, from_files};
pub(super) use measured::MazeRun;
pub(super) use paper::{PAPER_RUNS, PaperRow, StatesRow, TABLE_1};
pub(super) use played::Played;

/// A world with its table.
#[derive(Debug)]
pub(super) struct Venue {
    /// Name of the world's table in `summary.json`.
    pub(super) table: String,
    /// Title of the world's table.
    pub(super) title: String,
    pub(super) course: Course,
    pub(super) robot: LaserPioneerConfig,
    pub(super) step_limit: u32,
    cast: Cast,
    /// Values from the paper.
    paper: &'static [PaperRow],
}

/// A world as configurations contain it.
#[derive(Debug, Serialize)]
pub(super) struct World {
    maze: String,
    /// Width of the world's corridors, m.
    corridor_width: f64,
    /// Maximum number of time steps of a run.
    step_limit: u32,
}

impl World {
    pub(super) fn of(course: &Course, step_limit: u32) -> Self {
        Self {
            maze: course.maze.to_string(),
            corridor_width: course.corridor_width,
            step_limit,
        }
    }
}

/// Returns the configuration that runs of the calibrated robot depend on: its worlds, by table.
pub(super) fn config<'a, W: Serialize>(
    worlds: impl Iterator<Item = (&'a str, W)>,
) -> Result<toml::Table, BoxError> {
    #[derive(Serialize)]
    struct Config<'a, W> {
        robot: LaserPioneerConfig,
        worlds: BTreeMap<&'a str, W>,
    }
    Ok(toml::Table::try_from(Config {
        robot: pioneer::calibrated(),
        worlds: worlds.collect(),
    })?)
}

/// Returns the paper's own worlds.
pub(super) fn papers() -> Result<[Venue; 2], BoxError> {
    Ok([j_like(j_maze()?), large_like(large_maze()?)])
}

/// Returns a course that stands for the paper's J maze, with the paper's limit and rows.
fn j_like(course: Course) -> Venue {
    Venue::new("2 (J)", "The J maze", course, paper::J_STEPS).known(paper::TABLE_2)
}

/// Returns a course that stands for the paper's Large maze, with the paper's limit and rows.
pub(super) fn large_like(course: Course) -> Venue {
    Venue::new("3 (Large)", "The Large maze", course, paper::LARGE_STEPS).known(paper::TABLE_3)
}

/// Returns the first Large maze, drawn when steps per action were still a condition. It is too long
/// for the paper's figures, and hard to navigate.
pub(super) fn large_hard() -> Result<Venue, BoxError> {
    let course = built_in("Large, hard", include_str!("../../mazes/large-hard.maze"))?;
    let title = "The first Large maze, which is too long to be the paper's";
    Ok(Venue::new(
        "3 (large-hard)",
        title,
        course,
        paper::LARGE_STEPS,
    ))
}

/// Returns the paper's J maze.
pub(super) fn j_maze() -> Result<Course, BoxError> {
    built_in("J", include_str!("../../mazes/j.maze"))
}

/// Returns the paper's Large maze.
pub(super) fn large_maze() -> Result<Course, BoxError> {
    built_in("Large", include_str!("../../mazes/large.maze"))
}

fn built_in(name: &str, text: &str) -> Result<Course, BoxError> {
    Ok(Course::for_body(
        name,
        &tolman_maze::read(text)?,
        &pioneer::body(),
    )?)
}

impl Venue {
    /// Returns a course that is not in the paper, for the calibrated robot.
    pub(super) fn new(table: &str, title: &str, course: Course, step_limit: u32) -> Self {
        Self {
            table: table.to_owned(),
            title: title.to_owned(),
            course,
            robot: pioneer::calibrated(),
            step_limit,
            cast: Cast::default(),
            paper: &[],
        }
    }

    /// Returns a maze that is not in the paper, with a limit proportional to its corridors.
    ///
    /// # Errors
    /// If the robot does not fit its corridors.
    pub(super) fn of_maze(table: &str, name: &str, maze: Maze) -> Result<Self, BoxError> {
        let course = Course::for_body(name, &MazeFile::from(maze), &pioneer::body())?;
        let limit = course.step_limit();
        Ok(Self::new(table, name, course, limit))
    }

    /// Returns the venue with the paper's values.
    fn known(self, paper: &'static [PaperRow]) -> Self {
        Self { paper, ..self }
    }

    /// Returns the venue with the caller's limit. If it differs from the paper's, the paper's
    /// values are dropped.
    pub(super) fn limited(self, limit: Option<u32>) -> Self {
        match limit {
            Some(step_limit) if step_limit != self.step_limit => Self {
                step_limit,
                paper: &[],
                ..self
            },
            _ => self,
        }
    }

    /// Returns the venue with another name, as a variant of a table.
    pub(super) fn renamed(self, table: &str, title: &str) -> Self {
        Self {
            table: table.to_owned(),
            title: title.to_owned(),
            ..self
        }
    }

    /// Returns whether the paper has a table for it.
    pub(super) const fn is_papers(&self) -> bool {
        !self.paper.is_empty()
    }

    /// Returns the row of a brain, with the paper's values.
    pub(super) fn row(&self, name: &str) -> Row {
        let row = Row::new(name);
        match self.paper(name) {
            Some(paper) => row
                .paper("success_percent", paper.success_percent)
                .paper_mean(MazeRun::actions, paper.actions.0, paper.actions.1)
                .paper_mean(MazeRun::steps, paper.steps.0, paper.steps.1),
            None => row,
        }
    }

    /// Returns the paper's values for a brain here.
    pub(super) fn paper(&self, name: &str) -> Option<&'static PaperRow> {
        self.paper.iter().find(|paper| paper.row == name)
    }

    /// Returns the configuration that the runs here depend on.
    pub(super) fn world(&self) -> World {
        World::of(&self.course, self.step_limit)
    }

    /// Returns the trial of a seed, from the start that belongs to it.
    pub(super) fn trial(&self, seed: u64) -> Trial<'_> {
        Trial {
            course: &self.course,
            robot: self.robot.clone(),
            start: episode::random_start(&self.course, &pioneer::body(), seed),
            step_limit: self.step_limit,
            seed,
        }
    }

    /// Returns an agent before its first step.
    pub(super) fn mind(&self, agent: Agent) -> Result<Mind, EpisodeError> {
        self.cast.mind(agent, &self.course, &self.robot)
    }
}

/// Plays a run and returns its replay. `nodes` are the positions of the map's nodes, if the robot
/// has a map.
pub(super) fn replay(
    job: &Job<'_>,
    trial: &Trial<'_>,
    mind: &mut Mind,
    nodes: &[Point],
) -> Result<Replay, EpisodeError> {
    let mut recorder = Recorder::new(trial).knowing(nodes);
    let episode = episode::run(trial, mind, |step| recorder.see(step))?;
    let title = format!("{} in {}, run {}", job.row, trial.course.name, job.run);
    Ok(recorder.finish(title, &episode))
}
