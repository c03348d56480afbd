use numpy::PyArray1;
use pyo3::prelude::*;
use tolman_arena::course::Course;
use tolman_arena::episode::random_start;
use tolman_arena::pioneer::{CoursePioneer, body, calibrated, without_noise};
use tolman_geom::{Heading, Point, Pose};
use tolman_robot::{Landmark, Robot, SensesLandmarks, TurnTranslate};
use tolman_sim::robots::LaserPioneer;

use crate::errors::{reasons, refused, wrong};
use crate::maze::PyMaze;

/// A pose as Python writes it: x and y in metres, heading in radians counter-clockwise from east.
pub(crate) type PoseTuple = (f64, f64, f64);

/// A simulated Pioneer with a ring of laser beams, a compass and encoders, in a maze.
///
/// Parameters
/// ----------
/// maze : Maze
///     Where it drives.
/// seed : int
///     From 0, of all random numbers.
/// start : "marked", "random" or (float, float, float)
///     The maze's start, anywhere, or x and y, m from the south-west corner, and heading, rad
///     counter-clockwise from east.
/// noise : bool
///     Whether motors and sensors err.
///
/// Raises
/// ------
/// ValueError
///     If the maze is not one that a robot can drive in, or the start lies in a wall.
#[pyclass(name = "Robot", module = "tolman")]
pub(crate) struct PyRobot {
    robot: CoursePioneer,
    course: Course,
    /// What it was made of.
    made: (Py<PyMaze>, u64, Start, bool),
    /// All steps so far, turn and translate: a copy repeats them.
    driven: Vec<(f64, f64)>,
}

/// The start of a robot.
#[derive(Clone, FromPyObject, IntoPyObject)]
enum Start {
    Named(String),
    At(PoseTuple),
}

#[pymethods]
impl PyRobot {
    /// Puts a robot into a maze: at the maze's start (`"marked"`), anywhere (`"random"`) or at (x,
    /// y, heading). `seed` seeds all random numbers; without `noise`, motors and sensors are
    /// perfect.
    #[new]
    #[pyo3(
        signature = (maze, *, seed = 1, start = Start::Named("marked".to_owned()), noise = true),
        text_signature = "(maze, *, seed=1, start='marked', noise=True)"
    )]
    fn new(maze: Py<PyMaze>, seed: u64, start: Start, noise: bool) -> PyResult<Self> {
        let made = (maze, seed, start.clone(), noise);
        let maze = made.0.get();
        let course = Course::for_body(&maze.name, &maze.file, &body());
        let course = course.map_err(|error| refused("maze", &error))?;
        let start = match start {
            Start::Named(name) if name == "marked" => {
                course.start().map_err(|error| refused("start", &error))?
            }
            Start::Named(name) if name == "random" => random_start(&course, &body(), seed),
            Start::Named(name) => {
                return Err(wrong(format!(
                    "start is '{name}' but has to be 'marked', 'random' or (x, y, heading)"
                )));
            }
            Start::At((x, y, heading)) if [x, y, heading].iter().all(|part| part.is_finite()) => {
                Pose::new(Point::new(x, y), Heading::from_radians(heading))
            }
            Start::At(_) => return Err(wrong("start has a part that is not finite".to_owned())),
        };
        let config = match noise {
            true => calibrated(),
            false => without_noise(&calibrated()),
        };
        let robot = LaserPioneer::new(config).map_err(|error| refused("noise", &error))?;
        let robot = course.robot_at(start, robot, seed);
        let robot = robot.map_err(|error| refused("start", &error))?;
        Ok(Self {
            robot,
            course,
            made,
            driven: Vec::new(),
        })
    }

    /// Returns a robot that has made the steps of another, which gives it the same state.
    #[staticmethod]
    fn _driven(
        py: Python<'_>,
        maze: Py<PyMaze>,
        seed: u64,
        start: Start,
        noise: bool,
        driven: Vec<(f64, f64)>,
    ) -> PyResult<Self> {
        let mut robot = Self::new(maze, seed, start, noise)?;
        for (turn, translate) in driven {
            robot.step(py, turn, translate)?;
        }
        Ok(robot)
    }

    /// Returns what makes a copy, for `pickle` and `copy`.
    #[expect(clippy::type_complexity, reason = "a tuple is what Python takes apart")]
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(
        Bound<'py, PyAny>,
        (Py<PyMaze>, u64, Start, bool, Vec<(f64, f64)>),
    )> {
        let this = slf.borrow();
        let (maze, seed, start, noise) = &this.made;
        let made = (
            maze.clone_ref(slf.py()),
            *seed,
            start.clone(),
            *noise,
            this.driven.clone(),
        );
        Ok((slf.getattr("_driven")?, made))
    }

    /// Makes a time step.
    ///
    /// Parameters
    /// ----------
    /// turn : float
    ///     Share of a full turn per step, from −1 to 1, counter-clockwise.
    /// translate : float
    ///     Share of a full step ahead, from −1 to 1.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If a share is not from −1 to 1.
    fn step(&mut self, py: Python<'_>, turn: f64, translate: f64) -> PyResult<()> {
        for (name, value) in [("turn", turn), ("translate", translate)] {
            if !value.is_finite() {
                return Err(wrong(format!(
                    "{name} is {value} but has to be a finite number"
                )));
            }
        }
        let command = TurnTranslate { turn, translate };
        let robot = &mut self.robot;
        py.detach(|| robot.step(&command))
            .map_err(|error| wrong(reasons(&error)))?;
        self.driven.push((turn, translate));
        Ok(())
    }

    /// Returns the ranges of the laser's beams, m, an array of shape (beams,), counter-clockwise
    /// from the one that looks ahead; `None` if the laser gave no reading.
    #[getter]
    fn ranges<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        let scan = self.robot.sensing().scan.as_ref();
        scan.map(|scan| PyArray1::from_slice(py, &scan.ranges))
    }

    /// Returns the heading from the compass, rad, counter-clockwise from east; `None` if it gave
    /// none.
    #[getter]
    fn compass(&self) -> Option<f64> {
        self.robot.sensing().compass.map(Heading::radians)
    }

    /// Returns the odometry of the last step: distance, m, and turn, rad, counter-clockwise.
    #[getter]
    fn odometry(&self) -> Option<(f64, f64)> {
        let odometry = self.robot.sensing().odometry;
        odometry.map(|rolled| (rolled.distance, rolled.turn))
    }

    /// Returns whether it touched something in the last step.
    #[getter]
    fn bump(&self) -> bool {
        self.robot.sensing().bump.unwrap_or(false)
    }

    /// Returns whether it is in the goal.
    #[getter]
    fn at_goal(&self) -> bool {
        self.robot.landmark() == Some(Landmark::Goal)
    }

    /// Returns the true pose, which the robot does not sense: x and y, m, and heading, rad
    /// counter-clockwise from east.
    #[getter]
    fn pose(&self) -> PoseTuple {
        tuple(self.robot.truth().pose)
    }

    /// Returns the number of steps it has made.
    #[getter]
    fn steps(&self) -> u64 {
        self.robot.truth().tick
    }

    /// Returns the number of beams of its laser.
    #[getter]
    fn beams(&self) -> u32 {
        self.robot.model().config().ring.beams
    }

    /// Returns the maximum range of its laser, m.
    #[getter]
    fn reach(&self) -> f64 {
        self.robot.model().config().ring.max_range
    }

    /// Returns the distance between the middles of two cells side by side, m.
    #[getter]
    fn pitch(&self) -> f64 {
        self.course.pitch()
    }

    /// Returns the number of steps after which a run has failed, as in the tables of MSLST's paper.
    /// It is proportional to the length of all corridors.
    #[getter]
    fn step_limit(&self) -> u32 {
        self.course.step_limit()
    }
}

pub(crate) fn tuple(pose: Pose) -> PoseTuple {
    (pose.position.x, pose.position.y, pose.heading.radians())
}
