//! Robots that move from cell to cell, many at once: what the environments `tolman/Errand-v0`,
//! `tolman/Learn-v0` and `tolman/Locate-v0` are made of.

mod episode;
mod floor;
mod oracle;
mod settings;
mod task;

use numpy::ndarray::{Array1, Array2, Array3};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use tolman_maze::MazeFile;

use self::episode::Episode;
use self::settings::{Given, Settings, Source};
use self::task::GridTask;
use crate::errors::wrong;
use crate::maze::{PyMaze, walls};

/// Robots with one task, each in a maze of its own.
#[pyclass(name = "Grids", module = "tolman._tolman")]
pub(crate) struct PyGrids {
    settings: Settings,
    source: Source,
    robots: Vec<Robot>,
}

/// A robot, and where its random numbers stand.
struct Robot {
    seed: u64,
    /// Number of the episode since it was seeded.
    number: u64,
    episode: Episode,
    /// Walls of its maze as its observation has them; empty if it has none.
    walls: Array2<u8>,
}

/// Rewards, whether each episode has ended, and whether it was cut off.
type Outcomes<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
);

/// What makes a copy: of each robot its seed, its episode and its actions.
type Played = Vec<(u64, u64, Vec<u32>)>;

#[pymethods]
impl PyGrids {
    /// Makes `seeds.len()` robots, each with the random numbers of its seed.
    #[new]
    #[expect(clippy::too_many_arguments, reason = "all but the first have names")]
    #[pyo3(signature = (task, maze, seeds, *, width, height, rays, landmarks, errands, max_steps))]
    fn new(
        task: &str,
        maze: Given<'_>,
        seeds: Vec<u64>,
        width: i64,
        height: i64,
        rays: bool,
        landmarks: i64,
        errands: i64,
        max_steps: i64,
    ) -> PyResult<Self> {
        let numbers = [width, height, landmarks, errands, max_steps];
        let settings = Settings::new(GridTask::of_name(task)?, rays, numbers)?;
        if seeds.is_empty() {
            return Err(wrong(
                "seeds is empty but has to have one for each robot".to_owned(),
            ));
        }
        let source = settings.source(maze)?;
        let robots = seeds
            .into_iter()
            .map(|seed| Robot::new(&settings, &source, seed, 0));
        Ok(Self {
            robots: robots.collect::<PyResult<_>>()?,
            settings,
            source,
        })
    }

    /// Begins another episode of all robots, by default in the mazes that they have. A seed seeds
    /// the robot's random numbers again.
    #[pyo3(signature = (seeds, maze = None))]
    fn reset(&mut self, seeds: Vec<Option<u64>>, maze: Option<Given<'_>>) -> PyResult<()> {
        if seeds.len() != self.robots.len() {
            return Err(wrong(format!(
                "seeds has {} but has to have one, or None, for each of {} robots",
                seeds.len(),
                self.robots.len()
            )));
        }
        let source = match maze {
            Some(given) => self.settings.source(given)?,
            None => self.source.clone(),
        };
        let robots = self.robots.iter().zip(seeds).map(|(robot, seed)| {
            let (seed, number) = seed.map_or((robot.seed, robot.number + 1), |seed| (seed, 0));
            Robot::new(&self.settings, &source, seed, number)
        });
        self.robots = robots.collect::<PyResult<_>>()?;
        self.source = source;
        Ok(())
    }

    /// Makes a step of each robot: 0 moves it a cell ahead, 1 turns it a quarter to the right, 2 to
    /// the left. In the task `locate` 3 + 4 cell + heading tells where it is. A robot whose episode
    /// has ended begins another one instead, with no reward.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "Python hands over an array of its own"
    )]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: PyReadonlyArray1<'_, i64>,
    ) -> PyResult<Outcomes<'py>> {
        let actions = actions.as_array();
        let count = self.robots.len();
        if actions.len() != count {
            return Err(wrong(format!(
                "actions has {} but has to have one for each of {count} robots",
                actions.len()
            )));
        }
        let most = i64::from(self.settings.action_count()) - 1;
        if let Some(wrong_one) = actions.iter().find(|action| !(0..=most).contains(*action)) {
            return Err(wrong(format!(
                "action is {wrong_one} but has to be from 0 to {most}"
            )));
        }
        let mut rewards = Array1::zeros(count);
        let mut ended = Array1::from_elem(count, false);
        let mut cut = Array1::from_elem(count, false);
        for (at, robot) in self.robots.iter_mut().enumerate() {
            if robot.has_ended(&self.settings) {
                *robot = Robot::new(&self.settings, &self.source, robot.seed, robot.number + 1)?;
                continue;
            }
            rewards[at] = robot.episode.step(actions[at] as u32);
            ended[at] = robot.episode.left() == 0;
            cut[at] = !ended[at] && robot.has_ended(&self.settings);
        }
        Ok((
            rewards.into_pyarray(py),
            ended.into_pyarray(py),
            cut.into_pyarray(py),
        ))
    }

    /// Returns what the robots sense, an array for each part, with a row for each robot.
    fn observed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let count = self.robots.len();
        let observed = PyDict::new(py);
        let mut sides = Array2::<u8>::zeros((count, 4));
        for (mut row, robot) in sides.outer_iter_mut().zip(&self.robots) {
            row.iter_mut()
                .zip(robot.episode.sides())
                .for_each(|(to, side)| *to = side);
        }
        observed.set_item("sides", sides.into_pyarray(py))?;
        match self.settings.task {
            GridTask::Learn => {}
            GridTask::Errand => {
                let both = self.robots.iter().map(|robot| robot.episode.landmarks());
                let both: Vec<[i64; 2]> = both.collect();
                for (name, at) in [("here", 0), ("wanted", 1)] {
                    let numbers: Array1<i64> = both.iter().map(|both| both[at]).collect();
                    observed.set_item(name, numbers.into_pyarray(py))?;
                }
            }
            GridTask::Locate => {
                let (rows, columns) = self.robots[0].walls.dim();
                let mut all = Array3::<u8>::zeros((count, rows, columns));
                for (mut to, robot) in all.outer_iter_mut().zip(&self.robots) {
                    to.assign(&robot.walls);
                }
                observed.set_item("walls", all.into_pyarray(py))?;
            }
        }
        Ok(observed)
    }

    /// Returns where the robots are, a row for each: column, row, and heading as the number of
    /// quarter turns to the right from north.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<i64>> {
        let width = u32::from(self.settings.size.0);
        let mut poses = Array2::zeros((self.robots.len(), 3));
        for (mut row, robot) in poses.outer_iter_mut().zip(&self.robots) {
            let stand = robot.episode.stand;
            row[0] = i64::from(stand.cell % width);
            row[1] = i64::from(stand.cell / width);
            row[2] = stand.heading.index() as i64;
        }
        poses.into_pyarray(py)
    }

    /// Returns the mazes, one for each robot.
    #[getter]
    fn mazes(&self) -> Vec<PyMaze> {
        let (width, height) = self.settings.size;
        let mazes = self.robots.iter().map(|robot| PyMaze {
            name: format!("{} {width}x{height}", self.settings.task.name()),
            file: MazeFile::from(robot.episode.floor.maze.clone()),
        });
        mazes.collect()
    }

    /// Returns the cells of each robot's landmarks, in the order of their numbers.
    #[getter]
    fn landmarks(&self) -> Vec<Vec<(u32, u32)>> {
        let width = u32::from(self.settings.size.0);
        let cells = self.robots.iter().map(|robot| {
            let cells = robot.episode.landmark_cells().iter();
            cells.map(|cell| (cell % width, cell / width)).collect()
        });
        cells.collect()
    }

    /// Returns the number of steps in which one who knows all would do the rest, for each robot.
    /// In the task `learn` that one always looks where something new is seen soonest.
    #[getter]
    fn oracle_steps<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        let steps = self.robots.iter().map(|robot| robot.episode.oracle_steps());
        steps.collect::<Array1<u32>>().into_pyarray(py)
    }

    /// Returns the sum of the rewards that follow for one who does the rest in these steps.
    #[getter]
    fn oracle_rewards<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let rewards = self
            .robots
            .iter()
            .map(|robot| robot.episode.oracle_rewards());
        rewards.collect::<Array1<f64>>().into_pyarray(py)
    }

    /// Returns whether each robot's episode has ended or was cut off.
    #[getter]
    fn ended<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let ended = self
            .robots
            .iter()
            .map(|robot| robot.has_ended(&self.settings));
        ended.collect::<Array1<bool>>().into_pyarray(py)
    }

    /// Returns the number of actions.
    #[getter]
    fn action_count(&self) -> u32 {
        self.settings.action_count()
    }

    /// Returns robots that have done what others did, which gives them the same state.
    #[staticmethod]
    fn _played(
        arguments: &Bound<'_, PyTuple>,
        named: &Bound<'_, PyDict>,
        played: Played,
    ) -> PyResult<Self> {
        let made = arguments
            .py()
            .get_type::<Self>()
            .call(arguments, Some(named))?;
        let mut made = made.extract::<PyRefMut<'_, Self>>()?;
        let made = &mut *made;
        let robots = played.into_iter().map(|(seed, number, actions)| {
            let mut robot = Robot::new(&made.settings, &made.source, seed, number)?;
            for action in actions {
                robot.episode.step(action);
            }
            PyResult::Ok(robot)
        });
        Ok(Self {
            robots: robots.collect::<PyResult<_>>()?,
            settings: made.settings.clone(),
            source: made.source.clone(),
        })
    }

    /// Returns what makes a copy, for `pickle` and `copy`.
    #[expect(clippy::type_complexity, reason = "a tuple is what Python takes apart")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(
        Bound<'py, PyAny>,
        (Bound<'py, PyTuple>, Bound<'py, PyDict>, Played),
    )> {
        let py = slf.py();
        let this = slf.borrow();
        let Settings {
            task,
            size,
            rays,
            landmarks,
            errands,
            max_steps,
        } = this.settings;
        let maze = match &this.source {
            Source::Drawn(family) => family.name.into_pyobject(py)?.into_any(),
            Source::Same(floor) => {
                let file = MazeFile::from(floor.maze.clone());
                let maze = PyMaze {
                    name: task.name().to_owned(),
                    file,
                };
                Bound::new(py, maze)?.into_any()
            }
        };
        let seeds: Vec<u64> = this.robots.iter().map(|robot| robot.seed).collect();
        let named = PyDict::new(py);
        named.set_item("width", size.0)?;
        named.set_item("height", size.1)?;
        named.set_item("rays", rays)?;
        named.set_item("landmarks", landmarks)?;
        named.set_item("errands", errands)?;
        named.set_item("max_steps", max_steps)?;
        let arguments = (task.name(), maze, seeds).into_pyobject(py)?;
        let played = this
            .robots
            .iter()
            .map(|robot| (robot.seed, robot.number, robot.episode.actions.clone()));
        Ok((
            slf.getattr("_played")?,
            (arguments, named, played.collect()),
        ))
    }
}

impl Robot {
    fn new(settings: &Settings, source: &Source, seed: u64, number: u64) -> PyResult<Self> {
        let episode = settings.episode(source, seed, number)?;
        let walls = match settings.task {
            GridTask::Errand | GridTask::Learn => Array2::zeros((0, 0)),
            GridTask::Locate => walls(&episode.floor.maze),
        };
        Ok(Self {
            seed,
            number,
            episode,
            walls,
        })
    }

    fn has_ended(&self, settings: &Settings) -> bool {
        let steps = self.episode.actions.len();
        self.episode.left() == 0 || steps >= settings.max_steps as usize
    }
}
