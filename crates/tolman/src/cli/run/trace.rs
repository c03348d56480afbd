//! A run written down, so that others can look at it and the simulator can repeat it to the bit.

use tolman_arena::episode::Trial;
use tolman_robot::TurnTranslate;
use tolman_sim::robots::LaserPioneer;
use tolman_sim::trace::{Detail, Recording};

/// Returns the trace of a trial that was driven by these commands: JSON lines with the world, the
/// robot, and every step's command, true pose, bump and readings.
///
/// The run is made once more for it: the same commands make the same run.
///
/// # Errors
/// If the commands are not those of a run of this trial.
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
