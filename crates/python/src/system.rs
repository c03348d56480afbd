use std::sync::OnceLock;

use pyo3::prelude::*;
use tolman_arena::contest::{Condition, Contest, LearnRecord, Moment};
use tolman_arena::registry::{Registry, RobotEntry, Schooling};
use tolman_arena::run::TaskEnd;

use crate::errors::{refused, wrong};
use crate::map::PyMap;
use crate::maze::PyMaze;

/// Returns the names of the systems that learn a map of a maze.
#[pyfunction]
pub(crate) fn systems() -> Vec<String> {
    let learners = Registry::current().learners();
    learners.map(|system| system.name().to_owned()).collect()
}

/// Lets a system learn a map of a maze with a simulated robot: the one of its paper (`"own"`) or
/// another that can carry it, such as `"laser-pioneer"`. The same `seed` gives the same map.
#[pyfunction]
#[pyo3(signature = (maze, system = "mslst-better", seed = 1, *, robot = "own"))]
pub(crate) fn learn(
    py: Python<'_>,
    maze: &PyMaze,
    system: &str,
    seed: u64,
    robot: &str,
) -> PyResult<PyMap> {
    let found = Registry::current().system(system);
    let found = found.filter(|found| found.learns());
    let Some(contestant) = found else {
        return Err(wrong(format!(
            "system is '{system}' but has to be one of {}",
            systems().join(", ")
        )));
    };
    let robot = match robot {
        "own" => None,
        name => Some(robot_named(name)?),
    };
    let contest = Contest {
        contestant,
        robot,
        maze: maze.maze(),
        name: &maze.name,
        condition: Condition::AsMade,
        starts: 0,
        seed,
        stopwatch: None,
    };
    py.detach(|| learned(&contest))
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

fn learned(contest: &Contest<'_>) -> PyResult<PyMap> {
    let mut seen = None;
    let schooling = SCHOOLING.get_or_init(Schooling::default);
    let record = contest.play(schooling, |outing, moment| {
        if moment == Moment::Over {
            seen = Some((outing.map(), outing.path().to_vec()));
        }
    });
    let record = record.map_err(|error| refused("maze", &error))?;
    if let Some(why) = record.abstained {
        let name = contest.contestant.title();
        return Err(wrong(format!("maze: {name} cannot learn it: {why}")));
    }
    let (Some(learned), Some((view, poses))) = (record.learned, seen) else {
        return Err(wrong("system: it learns no map".to_owned()));
    };
    Ok(PyMap {
        view,
        poses,
        system: contest.contestant.name().to_owned(),
        outcome: outcome(&learned),
        certainty: learned.certainty,
        is_right: Some(learned.judgement.is_right),
        closures: None,
    })
}

fn outcome(learned: &LearnRecord) -> String {
    match &learned.end {
        TaskEnd::Done => "done".to_owned(),
        TaskEnd::OutOfTime => "out of time".to_owned(),
        TaskEnd::GaveUp { why } => format!("gave up: {why}"),
    }
}
