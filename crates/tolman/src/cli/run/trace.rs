//! The trace of a run, which can be watched, and which the simulator can repeat to the bit.

use tolman_arena::episode::Trial;
use tolman_robot::TurnTranslate;
use tolman_sim::robots::LaserPioneer;
use tolman_sim::trace::{Detail, Recording};

/// Returns the trace of a trial that these commands drove, as JSON lines. They hold the world, the
/// robot, and the command, true pose, bump and readings of every step.
///
/// The run is simulated once more for it; the same commands give the same run.
///
/// # Errors
/// If the commands do not belong to a run of this trial.
pub(super) fn of(trial: &Trial<'_>, commands: &[TurnTranslate]) -> anyhow::Result<Vec<u8>> {
    let robot = LaserPioneer::new(trial.robot.clone())?;
    let mut lines = Vec::new();
    let mut recording = Recording::start(
        trial.course.world.clone(),
        trial.seed,
        vec![(robot, trial.start)],
        &mut lines,
        Detail::Sensing,
    )?;
    for command in commands {
        recording.step(&[*command])?;
    }
    recording.finish()?;
    Ok(lines)
}
