//! Drives by the paper's map (section 3.4, "find a path").

use rand::RngExt;
use tolman_arena::gngslam::{Pitch, gather_by};
use tolman_arena::run::{TaskEnd, within};
use tolman_draw::{Figure, FloorPlan, GraphNode, NodeMark, Series};
use tolman_experiment::{BoxError, Fields, Job, Options, Record, Row, Run, Table, record};
use tolman_geom::{Point, Pose};
use tolman_maps::place_map::{ImageForm, PlaceMap};
use tolman_systems::gngslam::{PlacePilot, PlacePilotConfig, Wanderer, WandererConfig};
use tolman_systems::stream;

use crate::plan::network_graph;
use crate::rows::row_of;

/// Name of the table.
pub(super) const DRIVEN: &str = "driven";

/// The rows with λ: the middle of the paper's range, and a value that gives as many nodes as our
/// best maps have.
const ROWS: [(&str, u32); 2] = [("λ 575, as in Table 3.1", 575), ("λ 60", 60)];

/// Default number of runs of a row, and that for a first look.
const RUNS: u32 = 40;
const QUICK_RUNS: u32 = 2;

/// Number of records in the paper, and number of drives by each map.
const RECORDS: u32 = 1006;
const DRIVES: u32 = 10;

/// Maximum number of pieces of way in a drive.
const MOST_PIECES: u32 = 60;

/// Random stream of a run's seed for the map and the goals.
const DRIVES_STREAM: u64 = 4;

/// Distance from the goal within which a drive ends near it, m.
const NEAR: f64 = 1.0;

record! {
    /// Drives by one map.
    struct DrivenFields {
        /// Mean distance at the end of a drive between the robot's true position and that of the
        /// record.
        error_m: f64 => lower("error at the goal").unit("m"),
        /// Mean distance at the beginning of a drive.
        start_m: f64 => neither("distance at the start").unit("m"),
        /// Share of drives that truly ended within 1 m of their record.
        near_percent: f64 => higher("within 1 m").percent(),
        /// Share of drives that began within 1 m of it.
        near_at_start_percent: f64 => neither("within 1 m at the start").percent(),
        /// Share of drives that ended at the goal's node by odometry.
        done_percent: f64 => higher("arrived, by its wheels").percent(),
        /// Number of pieces of a drive, each a turn and a leg of at most 0.4 m.
        pieces: f64 => lower("pieces of the way").decimals(1),
        /// Number of nodes of the map.
        nodes: usize => neither("nodes"),
    }
}

/// Returns whether a table is this one.
pub(super) fn has(table: &str) -> bool {
    table == DRIVEN
}

pub(super) fn table(options: &Options) -> Table {
    let runs = options.runs_else(RUNS, QUICK_RUNS);
    Table::of::<DrivenFields>(DRIVEN, "Ways planned on the paper's map, and driven")
        .metrics_from(DrivenFields::error_m)
        .rows(ROWS.map(|(row, _)| Row::new(row).runs(runs)))
        .note(format!(
            "Each run gathers {RECORDS} records, and learns a map of image (40 × 30, hsv) and \
             odometry. It drives by the map to where {DRIVES} random records were taken, each time \
             from where it is. Wheels slip and otherwise count rightly. The paper plans ways and \
             drives none."
        ))
}

/// A place map, and drives by it.
struct DrivenMap {
    map: PlaceMap,
    /// True pose of the origin of the map's odometry.
    world_from_map: Pose,
    /// Each drive begins where the one before ended.
    drives: Vec<PlaceDrive>,
}

/// A drive to the place of a record.
struct PlaceDrive {
    /// True position of the robot at each look, m. The first one is where the drive began.
    path: Vec<Point>,
    /// True position at which the record was taken, m.
    goal: Point,
    end: TaskEnd,
}

impl PlaceDrive {
    /// Returns the distance of the robot from the goal at the end, m.
    fn error_m(&self) -> f64 {
        self.off(self.path.last())
    }

    /// Returns the distance of the robot from the goal at the start, m.
    fn start_m(&self) -> f64 {
        self.off(self.path.first())
    }

    fn off(&self, at: Option<&Point>) -> f64 {
        at.map_or(f64::INFINITY, |at| (at - self.goal).norm())
    }
}

fn driven(job: &Job<'_>) -> Result<DrivenMap, BoxError> {
    let (_, period) = row_of(job, ROWS, |(name, _)| *name == job.row)?;
    drive_place_map(period, job.seed, RECORDS, DRIVES)
}

/// Gathers `records` records on the pitch and learns a place map of image and odometry with the
/// paper's settings but for λ, `period`. Then the same robot drives on by that map to the places of
/// `drives` random records. `seed` seeds all random numbers.
fn drive_place_map(
    period: u32,
    seed: u64,
    records: u32,
    drives: u32,
) -> Result<DrivenMap, BoxError> {
    let pitch = Pitch::named("pitch")?;
    let mut robot = pitch.put(pitch.robot(seed, 0.0)?, seed)?;
    let world_from_map = robot.truth().pose;
    let mut wanderer = Wanderer::new(WandererConfig::paper(), seed);
    let data = gather_by(&pitch, &mut robot, &mut wanderer, seed, records)?;
    let mut rng = stream(seed, DRIVES_STREAM);
    let (_, map) = data.learn(ImageForm::Pixels, Some(period), &mut rng)?;
    let mut driven = Vec::new();
    for _ in 0..drives {
        let wanted = rng.random_range(0..data.records.len() as u32) as usize;
        let wanted = &data.records[wanted];
        let goal = map.nearest(&wanted.record)?;
        let mut pilot = PlacePilot::new(&map, PlacePilotConfig::pioneer_2dx(), goal);
        let mut path = vec![robot.truth().pose.position];
        let ended = within(MOST_PIECES, || {
            let standing = pilot.act(&mut robot, &mut wanderer)?;
            path.push(robot.truth().pose.position);
            Ok::<_, BoxError>(standing)
        })?;
        driven.push(PlaceDrive {
            path,
            goal: wanted.truth.position,
            end: ended.end,
        });
    }
    Ok(DrivenMap {
        map,
        world_from_map,
        drives: driven,
    })
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let DrivenMap { map, drives, .. } = driven(job)?;
    let mean = |of: &dyn Fn(&PlaceDrive) -> f64| {
        drives.iter().map(of).sum::<f64>() / drives.len().max(1) as f64
    };
    let percent = |is: &dyn Fn(&PlaceDrive) -> bool| {
        100.0 * drives.iter().filter(|drive| is(drive)).count() as f64 / drives.len().max(1) as f64
    };
    let fields = DrivenFields {
        error_m: mean(&PlaceDrive::error_m),
        start_m: mean(&PlaceDrive::start_m),
        near_percent: percent(&|drive| drive.error_m() < NEAR),
        near_at_start_percent: percent(&|drive| drive.start_m() < NEAR),
        done_percent: percent(&|drive| drive.end == TaskEnd::Done),
        pieces: mean(&|drive| (drive.path.len() - 1) as f64),
        nodes: map.network().ids().count(),
    };
    Ok(fields.fields()?)
}

/// Width of a plan, user units.
const WIDTH: f64 = 460.0;

/// Number of drives in the picture.
const SHOWN: usize = 3;

/// Returns the map of the last row's first run over the pitch, with the first drives by it.
pub(super) fn figures(runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let (row, _) = ROWS[1];
    let Some(run) = runs.iter().find(|run| run.is_of(DRIVEN, row)) else {
        return Ok(Vec::new());
    };
    let DrivenMap {
        map,
        world_from_map,
        drives,
    } = driven(&run.job())?;
    let mut plan = FloorPlan::of_world(&Pitch::named("pitch")?.course.world, WIDTH);
    let node = |id| {
        let position = world_from_map.transform(map.position(id)?);
        Some(GraphNode::at(position).mark(NodeMark::Ring))
    };
    plan.graph(&network_graph(map.network(), node).radius(2.0));
    for (series, drive) in (1..).zip(drives.iter().take(SHOWN)) {
        plan.trajectory(&drive.path, Series(series));
        plan.label(drive.goal, "goal");
    }
    let drawing = plan.drawing("A place map over the pitch, and drives by it.");
    Ok(vec![
        Figure::new("driven", "Driving by the paper's map", drawing)
            .caption("Nodes lie where the odometry had them, and the robot where it truly was. Each drive begins where the one before ended.")
            .table(DRIVEN),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_on_the_map_is_driven() {
        let driven = drive_place_map(30, 2, 200, 6).unwrap();
        let drives = driven.drives.iter();
        let done = drives.filter(|drive| drive.end == TaskEnd::Done);
        assert!(done.count() >= 5);
        let mean = |of: fn(&PlaceDrive) -> f64| driven.drives.iter().map(of).sum::<f64>() / 6.0;
        let (end, start) = (mean(PlaceDrive::error_m), mean(PlaceDrive::start_m));
        assert!(end < 0.8 * start, "{end} m of {start} m");
    }
}
