use std::path::PathBuf;

use pyo3::prelude::*;
use tolman_papers::real::{LogSystem, MappedLog, RobotLog};

use crate::errors::{reasons, unread, wrong};
use crate::map::PyMap;

/// Finds the way of a robot from its log, in the format of CARMEN or Wean Hall, plain or gzipped.
#[pyfunction]
#[expect(
    clippy::needless_pass_by_value,
    reason = "Python hands over a path of its own"
)]
#[pyo3(signature = (path, system = "scan-matching"))]
pub(crate) fn map_log(py: Python<'_>, path: PathBuf, system: &str) -> PyResult<PyMap> {
    let Some(found) = LogSystem::named(system) else {
        let names = LogSystem::ALL.map(LogSystem::name);
        return Err(wrong(format!(
            "system is '{system}' but has to be one of {}",
            names.join(", ")
        )));
    };
    let name = path.display().to_string();
    std::fs::metadata(&path).map_err(|error| unread(&name, &error))?;
    let mapped = py.detach(|| {
        let log = RobotLog::read(&path)?;
        log.map(found, &log.odometry(), |_| {})
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
        system: found.name().to_owned(),
        outcome: "done".to_owned(),
        certainty,
        is_right: None,
        closures: Some(closures),
    })
}
