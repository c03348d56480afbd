use tolman_robot::{Standing, Stopping};
use tolman_sim::robots::{Pioneer2dx, Pioneer2dxConfig};
use tolman_systems::gngslam::{Wanderer, WandererConfig};
use tolman_systems::stream;

use super::data_set::mislabel;
use super::{DataSet, Goals, LabelledRecord, Pitch};
use crate::run::within;
use crate::{BoxError, Simulated};

/// Random stream of a run's seed for the labels; those of the arena are 1 and 2, that of the
/// wanderer 0.
const LABELS: u64 = 3;

/// Lets a robot wander in an arena until it has taken `count` records, and returns them with the
/// truth (section 3.2; the paper has 1006). `seed` seeds all random numbers: its start, its noise,
/// its turns and the labels.
///
/// # Errors
/// If the robot cannot be built or put down, or takes no snapshot.
///
/// ```
/// use tolman_arena::gngslam::{Pitch, gather};
///
/// let pitch = Pitch::named("pitch")?;
/// let data = gather(&pitch, pitch.robot(1, 0.0)?, 1, 12)?;
/// assert_eq!(data.records.len(), 12);
/// assert!(data.records.iter().all(|record| pitch.course.leads_on(record.truth.position)));
/// # Ok::<(), tolman_arena::BoxError>(())
/// ```
pub fn gather(
    pitch: &Pitch,
    robot: Pioneer2dxConfig,
    seed: u64,
    count: u32,
) -> Result<DataSet, BoxError> {
    let mut robot = pitch.put(robot, seed)?;
    let mut wanderer = Wanderer::new(WandererConfig::paper(), seed);
    gather_by(pitch, &mut robot, &mut wanderer, seed, count)
}

/// Gathers records like [`gather`], with the caller's own robot and wanderer, which may go on
/// afterwards.
///
/// # Errors
/// As [`gather`].
pub fn gather_by(
    pitch: &Pitch,
    robot: &mut Stopping<Simulated<Pioneer2dx>>,
    wanderer: &mut Wanderer,
    seed: u64,
    count: u32,
) -> Result<DataSet, BoxError> {
    if count == 0 {
        return Err("0 records were asked for; gather at least 1".into());
    }
    let mut records = Vec::with_capacity(count as usize);
    within(count, || {
        let record = wanderer.leg(robot)?;
        let truth = robot.truth().pose;
        let cell = pitch.cells.cell_of(truth.position);
        records.push(LabelledRecord {
            record,
            truth,
            cell,
            label: cell,
        });
        Ok::<_, BoxError>(Standing::UnderWay)
    })?;
    mislabel(&mut records, &mut stream(seed, LABELS));
    Ok(DataSet {
        arena: pitch.course.name.clone(),
        seed,
        cells: pitch.cells,
        goals: Goals::find(pitch, &records),
        records,
    })
}
