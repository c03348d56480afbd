//! Maps of the logs that are here.

use tolman_draw::Figure;
use tolman_experiment::{BoxError, Run};

use super::{LogMapper, MapPicture, Real, small};

/// Returns a picture of the small log's map.
pub(super) fn of(real: &Real, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    if !runs.iter().any(|run| run.table == small::NAME) {
        return Ok(Vec::new());
    }
    let log = &real.small.log;
    let found = log.map(LogMapper::ScanMatching, &log.odometry(), |_| {})?;
    let drawing = MapPicture::of(log, &found.poses).drawing(720.0)?;
    let figure = Figure::new(
        "small-log",
        "The simulated office, by scan matching",
        drawing,
    );
    Ok(vec![figure.table(small::NAME)])
}
