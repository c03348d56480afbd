//! The Intel lab: errors of relative poses, compared with relations verified by hand.

use std::path::PathBuf;
use std::sync::OnceLock;

use tolman_arena::log_score::RelationScore;
use tolman_experiment::{BoxError, Fields, Job, Metric, Record, Row, Table, record};
use tolman_formats::ReadRelations;
use tolman_robot::Trajectory;

use super::trajectories::{Wear, worse};
use super::{FoundClosure, LogMapper, MappedLog, RobotLog};
use crate::data;
use crate::kept::once;
use crate::rows::row_of;

/// Name of the table.
pub(super) const NAME: &str = "relations";

const LOG: &str = "logs/mrpt-intel/intel_raw_every5th.clf.gz";
const RELATIONS: &str = "logs/intel-relations/intel.relations.gz";
const PUBLISHED: &str = "logs/radish/intel-corrected.log.gz";

/// Difference between the times of the relations and of the published log, s.
const PUBLISHED_TIMES: f64 = 976_052_857.34;

/// Error, by the dense map, above which a closure is wrong, m.
const WRONG_M: f64 = 0.5;
/// Distance, by the dense map, above which two visits are not to the same place, m. A room or a
/// crossing of corridors is this wide, and the robot may be anywhere in it.
const ELSEWHERE_M: f64 = 4.0;
/// Row whose wheels have added errors.
const MADE_WORSE: &str = "intel dense, wheels made worse";

pub(super) const ROWS: [(&str, Option<LogMapper>); 9] = [
    ("intel raw", Some(LogMapper::Odometry)),
    ("intel published", None),
    ("intel matching", Some(LogMapper::Matching)),
    ("intel places", Some(LogMapper::Places)),
    ("intel diktiometry", Some(LogMapper::Diktiometry)),
    ("intel cpm", Some(LogMapper::Cpm)),
    ("intel place graph", Some(LogMapper::PlaceGraph)),
    ("intel dense", Some(LogMapper::ScanMatching)),
    (MADE_WORSE, Some(LogMapper::ScanMatching)),
];

/// The log, read when it is first needed.
#[derive(Debug, Default)]
pub(super) struct Intel {
    log: OnceLock<RobotLog>,
    /// The dense map: a row of its own, and the reference for places.
    dense: OnceLock<MappedLog>,
}

/// Returns the path of a data file; `None` if it is missing.
pub(super) fn file(name: &str) -> Option<PathBuf> {
    let path = data::folder()?.join(name);
    path.exists().then_some(path)
}

/// Returns the message for missing data; `None` if all of these files are here.
pub(super) fn missing_of<const N: usize>(files: [&str; N], what: &str) -> Option<String> {
    let is_here = files.into_iter().all(|name| file(name).is_some());
    (!is_here).then(|| data::missing(what))
}

/// Returns the message for missing data.
pub(super) fn missing() -> Option<String> {
    let what = "the logs of the Intel lab and their relations";
    missing_of([LOG, RELATIONS, PUBLISHED], what)
}

record! {
    /// A way through the Intel lab.
    struct RelationRun {
        /// Mean error of a relation: the distance between the found and the verified position of
        /// its second pose, seen from the first.
        error_m: f64 => lower("error, all relations").unit("m").at_least(0).decimals(3),
        /// The same error over relations whose times are more than 30 s apart, so that the robot
        /// has come back in between.
        error_over_30s_m: f64 => lower("error, over 30 s").unit("m").at_least(0).decimals(3),
        /// Number of relations on the way.
        relations: usize => neither("relations").decimals(0),
        /// Number of places that were recognized again.
        closures: usize => neither("closures").decimals(0),
        /// For a map of places: number of closures that the dense map places elsewhere.
        wrong_closures: Option<usize> => lower("wrong closures").decimals(0),
        /// For a map of places: number of places.
        places: usize => neither("places").decimals(0),
        /// Number of visits to places.
        visits: usize => neither("visits").decimals(0),
        /// Number of times that it recognized a place.
        recognized: usize => neither("recognized").decimals(0),
        /// Number of these times at which the robot was elsewhere, by the dense map.
        wrongly_recognized: Option<usize> => lower("wrongly recognized").decimals(0),
    }
}

pub(super) fn table() -> Table {
    let missing = missing();
    let row = |(name, _): (&str, Option<LogMapper>)| match &missing {
        Some(missing) => Row::new(name).missing(missing),
        None if name == MADE_WORSE => Row::new(name),
        None => Row::new(name).run_each(1),
    };
    let worst = Metric::greatest("worst_over_30s_m", RelationRun::error_over_30s_m);
    Table::of::<RelationRun>(NAME, "The Intel lab, compared with relations verified by hand")
        .metrics_from(RelationRun::error_m)
        .metric(worst.titled("worst, over 30 s"))
        .rows(ROWS.map(row))
        .note(
            "Every fifth scan of the raw log. Relations within 30 s have a floor of 0.09 m, because \
             their times are between scans that are a second apart. Published: the corrected log \
             that others use, made by a mapper of its authors. Matching: scans matched to earlier \
             ones, without closures. Places: with closures where a junction, a bend, a dead end or a \
             room was recognized. Diktiometry, CPM, place graph: the same places, recognized by that \
             mapper alone. Dense: with closures everywhere. A closure of a map of places is wrong if \
             the dense map has it more than half a metre elsewhere. A place is wrongly recognized if \
             the dense map has it more than four metres from the earlier visit. Wheels made worse: \
             they also turn 2° a metre to one side all the way, and every way is 5 % too long or too \
             short. The sides are drawn for each run.",
        )
}

impl Intel {
    fn log(&self) -> Result<&RobotLog, BoxError> {
        once(&self.log, || {
            Ok(RobotLog::read(
                &file(LOG).ok_or("the log of the Intel lab is gone")?,
            )?)
        })
    }

    fn dense(&self) -> Result<&MappedLog, BoxError> {
        once(&self.dense, || {
            let log = self.log()?;
            log.map(LogMapper::ScanMatching, &log.odometry(), |_| {})
        })
    }

    /// Returns the way of a row.
    fn way(&self, job: &Job<'_>) -> Result<(Trajectory, MappedLog), BoxError> {
        let (_, system) = row_of(job, ROWS, |(name, _)| *name == job.row)?;
        let Some(system) = system else {
            let path = file(PUBLISHED).ok_or("the published log of the Intel lab is gone")?;
            let mut log = RobotLog::read(&path)?;
            for scan in &mut log.scans {
                scan.time += PUBLISHED_TIMES;
            }
            let mapped = log.map(LogMapper::Odometry, &log.odometry(), |_| {})?;
            return Ok((log.trajectory(&mapped.poses), mapped));
        };
        let log = self.log()?;
        let mapped = match (job.row, system) {
            (MADE_WORSE, _) => {
                let odometry = worse(&log.odometry(), Wear::OF_RAW, job.seed);
                log.map(system, &odometry, |_| {})?
            }
            (_, LogMapper::ScanMatching) => self.dense()?.clone(),
            _ => log.map(system, &log.odometry(), |_| {})?,
        };
        Ok((log.trajectory(&mapped.poses), mapped))
    }

    /// Returns the number of closures that the dense map places elsewhere.
    fn wrong(&self, mapped: &MappedLog) -> Result<usize, BoxError> {
        let dense = self.dense()?;
        let is_wrong = |closure: &&FoundClosure| {
            let [there, here] = [closure.earlier, closure.later]
                .map(|keyframe| dense.poses[mapped.keyframes[keyframe]]);
            let off = there.between(here).position - closure.measured.position;
            off.norm() > WRONG_M
        };
        Ok(mapped.closed.iter().filter(is_wrong).count())
    }

    /// Returns the number of recognized places that the dense map places elsewhere.
    fn elsewhere(&self, mapped: &MappedLog, recognized: &[[usize; 2]]) -> Result<usize, BoxError> {
        let dense = self.dense()?;
        let is_elsewhere = |pair: &&[usize; 2]| {
            let [there, here] = pair.map(|keyframe| dense.poses[mapped.keyframes[keyframe]]);
            (there.position - here.position).norm() > ELSEWHERE_M
        };
        Ok(recognized.iter().filter(is_elsewhere).count())
    }

    pub(super) fn run(&self, job: &Job<'_>) -> Result<Fields, BoxError> {
        let (way, mapped) = self.way(job)?;
        let path = file(RELATIONS).ok_or("the relations of the Intel lab are gone")?;
        let relations = ReadRelations::open(&path)?.relations;
        let score = RelationScore::of(&way, &relations).ok_or("no relation lies on the way")?;
        let (visits, recognized) = (mapped.visits.len(), mapped.recognized());
        let run = RelationRun {
            error_m: score.error,
            error_over_30s_m: score.far_error.ok_or("no relation is far")?,
            relations: score.relations,
            closures: mapped.closures,
            wrong_closures: match visits {
                0 => None,
                _ => Some(self.wrong(&mapped)?),
            },
            places: mapped.places.places.len(),
            visits,
            recognized: recognized.len(),
            wrongly_recognized: match visits {
                0 => None,
                _ => Some(self.elsewhere(&mapped, &recognized)?),
            },
        };
        Ok(run.fields()?)
    }
}
