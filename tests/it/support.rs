//! Courses, minds and episodes for the scenarios.

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tolman_arena::Mind;
use tolman_arena::cast::{Agent, Cast};
use tolman_arena::course::Course;
use tolman_arena::episode::{Trial, random_start};
use tolman_arena::pioneer::{body, calibrated};
use tolman_robot::Body;
use tolman_sim::robots::LaserPioneerConfig;

/// Returns the workspace's folder.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// Returns the folder with the mazes and logs of others. If it is not here, says so.
pub(crate) fn data_of_others() -> Option<PathBuf> {
    let folder =
        env::var_os("TOLMAN_DATA").map_or_else(|| root().join("../shared/data"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    // Written past the test harness, which would keep it to itself.
    let missing = folder.display();
    let _ = writeln!(
        io::stderr(),
        "SKIPPED: {missing} is not there; set TOLMAN_DATA to run this test"
    );
    None
}

/// Returns the files in a folder, in alphabetical order.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
        .collect();
    files.sort();
    files
}

/// Returns the course of a maze file for the calibrated robot.
pub(crate) fn course(path: &Path) -> Course {
    course_for(path, &body())
}

/// Returns the course of a maze file for a robot of this body.
pub(crate) fn course_for(path: &Path, body: &Body) -> Course {
    let text = fs::read_to_string(path).unwrap();
    let file = tolman_maze::read(&text).unwrap_or_else(|error| panic!("{path:?}: {error}"));
    Course::for_body(&path.to_string_lossy(), &file, body).unwrap()
}

/// Returns the course of one of the project's own mazes.
pub(crate) fn own_course(name: &str) -> Course {
    course(&root().join("mazes").join(name))
}

/// Returns a run of the calibrated robot from the random start of this seed.
pub(crate) fn trial(course: &Course, seed: u64) -> Trial<'_> {
    trial_of(course, calibrated(), seed)
}

/// Returns a run of `robot` from the random start of this seed.
pub(crate) fn trial_of(course: &Course, robot: LaserPioneerConfig, seed: u64) -> Trial<'_> {
    let start = random_start(course, &body(), seed);
    Trial {
        course,
        robot,
        start,
        step_limit: 500,
        seed,
    }
}

/// Returns a fresh mind of an agent for the calibrated robot.
pub(crate) fn mind(cast: &Cast, agent: Agent, course: &Course) -> Mind {
    cast.mind(agent, course, &calibrated()).unwrap()
}
