use std::io::{self, BufRead};

use super::{Detail, Reader, Recordable, Recording, ReplayError, StepRecord, TraceLine};
use crate::{RobotId, Simulation};

/// Simulates a trace again, compares every number of every line, and returns the simulation at its
/// end.
///
/// # Errors
/// If the trace cannot be read, a robot was disturbed from outside its configuration, or the first
/// line that differs.
pub fn replay<M: Recordable>(trace: impl BufRead) -> Result<Simulation<M>, ReplayError> {
    replay_with(trace, |_, config| M::from_config(config))
}

/// Replays a trace as [`replay`] does, with robots that `build` makes from their configurations. It
/// is for robots that are [disturbed](crate::noise::Disturbance) by code, which the trace cannot
/// hold.
///
/// # Errors
/// If the trace cannot be read, a robot cannot be built or is not disturbed as the trace says, or
/// the first line that differs.
pub fn replay_with<M: Recordable, E: core::error::Error + Send + Sync + 'static>(
    trace: impl BufRead,
    build: impl FnMut(RobotId, M::Config) -> Result<M, E>,
) -> Result<Simulation<M>, ReplayError> {
    let reader = Reader::<M, _>::open(trace)?;
    let mut recording = start(&reader, build)?;
    let robots = reader.robots().len();
    // One tick's lines, gathered until there is one per robot.
    let mut tick: Vec<(usize, StepRecord<M>)> = Vec::new();
    for event in reader {
        match event? {
            (line, TraceLine::Step(step)) => {
                tick.push((line, step));
                if tick.len() == robots {
                    again(&mut recording, &tick)?;
                    tick.clear();
                }
            }
            (line, TraceLine::Place { robot, pose }) => {
                let placed = recording.place(robot, pose);
                placed.map_err(|source| refused(line, source))?;
            }
            (line, TraceLine::Door { name, state }) => {
                recording
                    .set_door(&name, state)
                    .map_err(|source| refused(line, source))?;
            }
        }
    }
    recording.finish().map_err(|source| refused(1, source))
}

/// Returns the robots of a trace at its beginning.
fn start<M: Recordable, R: BufRead, E: core::error::Error + Send + Sync + 'static>(
    reader: &Reader<M, R>,
    mut build: impl FnMut(RobotId, M::Config) -> Result<M, E>,
) -> Result<Recording<M, io::Sink>, ReplayError> {
    let mut robots = Vec::new();
    for (index, ((config, pose), recorded)) in (0..).zip(reader.robots().zip(reader.disturbances()))
    {
        let model = build(RobotId(index), config.clone()).map_err(|source| refused(1, source))?;
        let built = model.disturbances();
        if built != recorded {
            return Err(ReplayError::Disturbances {
                robot: index,
                recorded: recorded.to_vec(),
                built,
            });
        }
        robots.push((model, pose));
    }
    let world = reader.world().clone();
    Recording::start(world, reader.seed(), robots, io::sink(), Detail::Sensing)
        .map_err(|source| refused(1, source))
}

/// Simulates one tick and compares it.
fn again<M: Recordable>(
    recording: &mut Recording<M, io::Sink>,
    lines: &[(usize, StepRecord<M>)],
) -> Result<(), ReplayError> {
    let commands: Vec<M::Command> = lines.iter().map(|(_, step)| step.command.clone()).collect();
    let first = lines.first().map_or(1, |(line, _)| *line);
    recording
        .step(&commands)
        .map_err(|source| refused(first, source))?;
    for (line, step) in lines {
        let mut now = recording.line(step.robot, &step.command);
        if step.sensing.is_none() {
            now.sensing = None;
        }
        // The shortest text that reads back as a number differs wherever its bits do.
        let text = |step: &StepRecord<M>| {
            serde_json::to_string(step).map_err(|error| ReplayError::of_line(*line, &error))
        };
        let (recorded, replayed) = (text(step)?, text(&now)?);
        if recorded != replayed {
            let (line, tick, robot) = (*line, step.tick, step.robot.0);
            return Err(ReplayError::Differs {
                line,
                tick,
                robot,
                recorded,
                replayed,
            });
        }
    }
    Ok(())
}

fn refused(line: usize, source: impl core::error::Error + Send + Sync + 'static) -> ReplayError {
    ReplayError::Refused {
        line,
        source: Box::new(source),
    }
}
