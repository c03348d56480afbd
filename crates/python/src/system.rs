use core::slice;
use core::time::Duration;
use std::sync::OnceLock;
use std::time::Instant;

use pyo3::prelude::*;
use tolman_arena::Outing;
use tolman_arena::contest::{Condition, Contest, LearnRecord, SteppedContest, TaskRecord};
use tolman_arena::course::Terrain;
use tolman_arena::registry::{
    MapText, Registry, RobotEntry, Schooling, Settings, Setup, Start, SystemEntry,
};
use tolman_arena::run::{self, TaskEnd};
use tolman_film::Film;
use tolman_maze::MazeFile;
use tolman_replay::Replay;
use tolman_robot::{Goal, Landmark, Task};

use crate::drive::PyDrive;
use crate::errors::{reasons, refused, wrong};
use crate::map::PyMap;
use crate::maze::PyMaze;

/// Returns the names of the systems that learn a map of a maze, as a list of str.
#[pyfunction]
pub(crate) fn systems() -> Vec<String> {
    let learners = Registry::current().learners();
    learners.map(|system| system.name().to_owned()).collect()
}

/// Lets a system learn a map of a maze with a simulated robot. Ctrl-C ends it within one action of
/// the robot.
///
/// Parameters
/// ----------
/// maze : Maze
///     Where the robot drives.
/// system : str
///     One of `systems()`.
/// seed : int
///     From 0. The same seed gives the same map.
/// robot : str
///     The robot of the system's paper, "own", or another that can carry it, such as
///     "laser-pioneer".
/// progress : callable or None
///     Called now and then with the number of time steps so far and a few words.
///
/// Returns
/// -------
/// Map
///
/// Raises
/// ------
/// ValueError
///     If there is no such system or robot, or it cannot learn in this maze.
#[pyfunction]
#[pyo3(signature = (maze, system = "mslst-better", seed = 1, *, robot = "own", progress = None))]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over objects of their own"
)]
pub(crate) fn learn(
    py: Python<'_>,
    maze: Py<PyMaze>,
    system: &str,
    seed: u64,
    robot: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyMap> {
    let lesson = Lesson {
        maze,
        system: of_name(system)?,
        robot: match robot {
            "own" => None,
            name => Some(robot_named(name)?),
        },
        seed,
    };
    lesson.learn(py, progress.as_ref())
}

/// Returns the system of this name that learns maps.
fn of_name(name: &str) -> PyResult<&'static dyn SystemEntry> {
    let found = Registry::current().system(name);
    found.filter(|found| found.learns()).ok_or_else(|| {
        wrong(format!(
            "system is '{name}' but has to be one of {}",
            systems().join(", ")
        ))
    })
}

/// Returns the robot called `name`.
fn robot_named(name: &str) -> PyResult<RobotEntry> {
    let registry = Registry::current();
    registry.robot(name).ok_or_else(|| {
        let names = registry.robots.iter().map(|robot| robot.name);
        let names: Vec<&str> = ["own"].into_iter().chain(names).collect();
        wrong(format!(
            "robot is '{name}' but has to be one of {}",
            names.join(", ")
        ))
    })
}

/// Knowledge that systems learn once, before they are sent out.
static SCHOOLING: OnceLock<Schooling> = OnceLock::new();

fn schooling() -> &'static Schooling {
    SCHOOLING.get_or_init(Schooling::default)
}

/// What a map is learned from. The same lesson gives the same map.
pub(crate) struct Lesson {
    pub(crate) maze: Py<PyMaze>,
    system: &'static dyn SystemEntry,
    /// `None` for the one that the system is made for.
    robot: Option<RobotEntry>,
    seed: u64,
}

impl Lesson {
    fn learn(self, py: Python<'_>, progress: Option<&Py<PyAny>>) -> PyResult<PyMap> {
        let (mut map, _) = py.detach(|| self.held(progress, false))?;
        map.lesson = Some(self);
        Ok(map)
    }

    /// Returns the replay of the lesson, which is held again for it.
    pub(crate) fn replay(&self, py: Python<'_>) -> PyResult<Replay> {
        let (_, replay) = py.detach(|| self.held(None, true))?;
        replay.ok_or_else(|| wrong("nothing was recorded".to_owned()))
    }

    /// Holds the lesson, with Python's lock released.
    fn held(
        &self,
        progress: Option<&Py<PyAny>>,
        is_filmed: bool,
    ) -> PyResult<(PyMap, Option<Replay>)> {
        let maze = self.maze.get();
        let contest = Contest {
            contestant: self.system,
            robot: self.robot,
            maze: maze.maze(),
            name: &maze.name,
            condition: Condition::AsMade,
            starts: 0,
            seed: self.seed,
            stopwatch: None,
        };
        let name = self.system.title();
        if let Some(why) = contest.abstains() {
            return Err(wrong(format!("maze: {name} cannot learn it: {why}")));
        }
        let stepped = SteppedContest::new(&contest, schooling());
        let mut stepped = stepped.map_err(|error| refused("maze", &error))?;
        stepped.explore();
        let mut film = is_filmed.then(|| Film::new(stepped.outing()));
        let mut watch = Watch::new(progress);
        let record = loop {
            let record = stepped.act();
            if let Some(film) = &mut film {
                film.see(stepped.outing());
            }
            match record {
                Some(TaskRecord::Learned(record)) => break *record,
                Some(_) => return Err(wrong("system: it learns no map".to_owned())),
                None => watch.look(stepped.outing())?,
            }
        };
        let outing = stepped.outing();
        let replay = film.map(|film| {
            let title = format!("{name} in {}", maze.name);
            film.replay(outing, title).thinned(MOST_STEPS)
        });
        let map = PyMap {
            view: outing.map(),
            poses: outing.path().to_vec(),
            system: self.system.name().to_owned(),
            outcome: outcome(&record.end),
            certainty: record.certainty,
            is_right: Some(record.judgement.is_right),
            closures: None,
            file: file(outing, &record),
            lesson: None,
        };
        Ok((map, replay))
    }
}

/// Maximum number of time steps of a replay, as in those that the command writes.
const MOST_STEPS: usize = 4000;

/// Returns the file of a map, or why there is none.
fn file(outing: &dyn Outing, record: &LearnRecord) -> Result<String, String> {
    let text = outing.map_file().map_err(|error| reasons(&*error))?;
    let text = text.ok_or("the system keeps no map")?;
    MapText::with_truth(&text, &record.evidence).map_err(|error| error.to_string())
}

fn outcome(end: &TaskEnd) -> String {
    match end {
        TaskEnd::Done => "done".to_owned(),
        TaskEnd::OutOfTime => "out of time".to_owned(),
        TaskEnd::GaveUp { why } => format!("gave up: {why}"),
    }
}

/// Tells of progress and lets Python handle signals, now and then.
struct Watch<'a> {
    progress: Option<&'a Py<PyAny>>,
    last: Instant,
}

impl<'a> Watch<'a> {
    fn new(progress: Option<&'a Py<PyAny>>) -> Self {
        Self {
            progress,
            last: Instant::now(),
        }
    }

    /// # Errors
    /// What a signal or `progress` raises.
    fn look(&mut self, outing: &dyn Outing) -> PyResult<()> {
        if self.last.elapsed() < Duration::from_millis(50) {
            return Ok(());
        }
        self.last = Instant::now();
        Python::attach(|py| {
            py.check_signals()?;
            if let Some(progress) = self.progress {
                progress.call1(py, (outing.path().len() - 1, outing.words()))?;
            }
            Ok(())
        })
    }
}

/// Returns a map that was read from a file.
pub(crate) fn opened(name: String, text: String) -> PyResult<PyMap> {
    let text = MapText::read(name, text).map_err(|error| refused("path", &error))?;
    let system = of_name(&text.system)?;
    let map = system.map(&text).and_then(|map| map.view());
    let view = map.map_err(|error| wrong(format!("path: {}", reasons(&*error))))?;
    Ok(PyMap {
        view,
        poses: Vec::new(),
        system: system.name().to_owned(),
        outcome: "read from a file".to_owned(),
        certainty: None,
        is_right: None,
        closures: None,
        file: Ok(text.text),
        lesson: None,
    })
}

/// Sends a robot from a random place to the goal of `maze` by a map's file. Called with Python's
/// lock released.
pub(crate) fn drive(
    file: &str,
    maze: &PyMaze,
    seed: u64,
    progress: Option<&Py<PyAny>>,
) -> PyResult<PyDrive> {
    let map = MapText::read("the map".to_owned(), file.to_owned());
    let map = map.map_err(|error| refused("map", &error))?;
    let system = of_name(&map.system)?;
    let terrain = Terrain::Maze(MazeFile::from(maze.maze().clone()));
    let setup = Setup {
        world: &maze.name,
        terrain: &terrain,
        seed,
        start: Some(Start::Random),
        steps: None,
        robot: robot_named(&map.origin.robot)?,
        from: None,
        settings: Settings::default(),
        condition: Condition::AsMade,
        doors: &[],
        schooling: schooling(),
    };
    let outing = system.driver(slice::from_ref(&map), &setup);
    let mut outing = outing.map_err(|error| wrong(format!("maze: {}", reasons(&*error))))?;
    let drawing = outing.course().drawing();
    if map.origin.drawing.is_some_and(|learned| learned != drawing) {
        return Err(wrong(format!(
            "maze is {}, and the map was learned in another, {}",
            maze.name, map.origin.world
        )));
    }
    let mut film = Film::new(&*outing);
    let mut watch = Watch::new(progress);
    let arrive = Task::Reach(Goal::Landmark(Landmark::Goal));
    let ended = run::until_done(&mut *outing, |outing| {
        let standing = outing.act(arrive);
        let standing = standing.map_err(|error| wrong(reasons(&*error)))?;
        film.see(outing);
        watch.look(outing)?;
        PyResult::Ok(standing)
    })?;
    let title = format!("{} drives in {}", system.title(), maze.name);
    Ok(PyDrive {
        reached: ended.end == TaskEnd::Done && outing.landmark() == Some(Landmark::Goal),
        outcome: outcome(&ended.end),
        bumps: outing.bumped().len(),
        poses: outing.path().to_vec(),
        replay: film.replay(&*outing, title).thinned(MOST_STEPS),
    })
}
