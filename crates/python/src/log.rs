use std::path::PathBuf;

use pyo3::prelude::*;
use tolman_arena::registry::Registry;
use tolman_papers::real::{MappedLog, RobotLog};

use crate::errors::{reasons, unread, wrong};
use crate::map::PyMap;

/// Finds the way of a robot from its log.
///
/// Parameters
/// ----------
/// path : str or path
///     A log in the format of CARMEN or Wean Hall, plain or gzipped.
/// system : str
///     What finds it: "scan-matching", or another that the error of a wrong name lists.
///
/// Returns
/// -------
/// Map
///     With `path`, and places as far as the system has them.
///
/// Raises
/// ------
/// OSError
///     If the file cannot be read.
/// ValueError
///     If there is no such system, or the file is not such a log. The message names the line.
#[pyfunction]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over a path of its own"
)]
#[pyo3(signature = (path, system = "scan-matching"))]
pub(crate) fn map_log(py: Python<'_>, path: PathBuf, system: &str) -> PyResult<PyMap> {
    let registry = Registry::current();
    let found = registry.system(system);
    let mapper = found.and_then(|system| system.facts().log_mapper);
    let Some(mapper) = mapper else {
        let maps = registry.systems.iter();
        let maps = maps.filter(|system| system.facts().log_mapper.is_some());
        let names: Vec<&str> = maps.map(|system| system.name()).collect();
        return Err(wrong(format!(
            "system is '{system}' but has to be one of {}",
            names.join(", ")
        )));
    };
    let name = path.display().to_string();
    std::fs::metadata(&path).map_err(|error| unread(&name, &error))?;
    let mapped = py.detach(|| {
        let log = RobotLog::read(&path)?;
        log.map(mapper, &log.odometry(), |_| {})
    });
    let mapped = mapped.map_err(|error| wrong(format!("path: {}", reasons(&*error))))?;
    let MappedLog {
        poses,
        places,
        closures,
        certainty,
        ..
    } = mapped;
    Ok(PyMap {
        view: places,
        poses,
        system: system.to_owned(),
        outcome: "done".to_owned(),
        certainty,
        is_right: None,
        closures: Some(closures),
        file: Err("it comes from a log: tolman map --log writes such maps".to_owned()),
        lesson: None,
    })
}
