//! Drives by the paper's map (section 3.4, "find a path").

use tolman_arena::gngslam::{DrivenMap, Pitch, PlaceDrive, drive_place_map};
use tolman_draw::{Figure, FloorPlan, GraphEdge, GraphNode, GraphPicture, NodeMark, Series};
use tolman_experiment::{BoxError, Fields, Job, Metric, Options, Record, Row, Run, Table, record};
use tolman_maps::place_map::PlaceMapConfig;
use tolman_robot::Standing;

/// Name of the table.
const DRIVEN: &str = "driven";

/// The rows with λ: the middle of the paper's range, and a value that gives as many nodes as our
/// best maps have.
const ROWS: [(&str, u32); 2] = [("λ 575, as in Table 3.1", 575), ("λ 60", 60)];

/// Default number of runs of a row, and that for a first look.
const RUNS: u32 = 40;
const QUICK_RUNS: u32 = 2;

/// Number of records in the paper, and number of drives by each map.
const RECORDS: usize = 1006;
const DRIVES: u32 = 10;

/// Distance from the goal within which a drive ends near it, m.
const NEAR: f64 = 1.0;

record! {
    /// Drives by one map.
    struct DrivenFields {
        /// Mean distance at the end of a drive between the robot's true position and that of the
        /// record.
        error_m: f64 => lower("error at the goal").unit("m").decimals(2),
        /// Mean distance at the beginning of a drive.
        start_m: f64 => neither("distance at the start").unit("m").decimals(2),
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
        .metric(Metric::mean(DrivenFields::error_m))
        .metric(Metric::mean(DrivenFields::start_m))
        .metric(Metric::mean(DrivenFields::near_percent))
        .metric(Metric::mean(DrivenFields::near_at_start_percent))
        .metric(Metric::mean(DrivenFields::done_percent))
        .metric(Metric::mean(DrivenFields::pieces))
        .metric(Metric::mean(DrivenFields::nodes))
        .rows(ROWS.map(|(row, _)| Row::new(row).runs(runs)))
        .note(format!(
            "Each run gathers {RECORDS} records, and learns a map of image (40 × 30, hsv) and \
             odometry. It drives by the map to where {DRIVES} random records were taken, each time \
             from where it is. Wheels slip and otherwise count rightly. The paper plans ways and \
             drives none."
        ))
}

fn driven(row: &str, seed: u64) -> Result<DrivenMap, BoxError> {
    let period = ROWS.iter().find(|(name, _)| *name == row);
    let (_, period) = period.ok_or_else(|| format!("there is no row {row:?} of {DRIVEN}"))?;
    let mut config = PlaceMapConfig::paper();
    config.gng.growth_period = *period;
    Ok(drive_place_map(
        &Pitch::paper()?,
        config,
        seed,
        RECORDS,
        DRIVES,
    )?)
}

pub(super) fn run(job: &Job<'_>) -> Result<Fields, BoxError> {
    let DrivenMap { map, drives, .. } = driven(job.row, job.seed)?;
    let count = drives.len().max(1) as f64;
    let percent = |is: &dyn Fn(usize) -> bool| {
        100.0 * (0..drives.len()).filter(|drive| is(*drive)).count() as f64 / count
    };
    let fields = DrivenFields {
        error_m: drives.iter().map(PlaceDrive::error_m).sum::<f64>() / count,
        start_m: drives.iter().map(PlaceDrive::start_m).sum::<f64>() / count,
        near_percent: percent(&|drive| drives[drive].error_m() < NEAR),
        near_at_start_percent: percent(&|drive| drives[drive].start_m() < NEAR),
        done_percent: percent(&|drive| drives[drive].standing == Standing::Done),
        pieces: drives
            .iter()
            .map(|drive| (drive.path.len() - 1) as f64)
            .sum::<f64>()
            / count,
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
    let mut of_row = runs
        .iter()
        .filter(|run| run.table == DRIVEN && run.row == row);
    let Some(run) = of_row.next() else {
        return Ok(Vec::new());
    };
    let DrivenMap {
        map,
        world_from_map,
        drives,
    } = driven(row, run.seed)?;
    let mut plan = FloorPlan::of_world(&Pitch::paper()?.world, WIDTH);
    let mut graph = GraphPicture::new().radius(2.0);
    let positions: Vec<_> = map.positions().collect();
    for (_, position) in &positions {
        let node = GraphNode::at(world_from_map.transform(*position)).mark(NodeMark::Ring);
        graph.node(node.series(Series(0)));
    }
    let place = |node| positions.iter().position(|(id, _)| *id == node);
    for edge in map.network().edges() {
        if let (Some(a), Some(b)) = (place(edge.ends.0), place(edge.ends.1)) {
            graph.edge(GraphEdge::between(a, b));
        }
    }
    plan.graph(&graph);
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
