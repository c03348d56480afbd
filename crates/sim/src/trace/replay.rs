use std::io::{self, BufRead};

use serde::de::DeserializeOwned;

use super::lines::{FORMAT, Header, Line, Step, VERSION};
use super::{Detail, Recordable, Recording, ReplayError};
use crate::world::Head;
use crate::{RobotId, Simulation, World};

/// Simulates a trace again and compares every number of every line; gives the simulation as it stands
/// at the end.
///
/// # Errors
/// If the trace cannot be read, or the first line that differs.
pub fn replay<M: Recordable>(trace: impl BufRead) -> Result<Simulation<M>, ReplayError> {
    let mut lines = trace.lines().zip(1..);
    let (first, _) = lines.next().ok_or(ReplayError::Empty)?;
    let mut recording = start::<M>(&first?)?;
    // One tick's lines, gathered until there is one per robot.
    let mut tick: Vec<(usize, Step<M>)> = Vec::new();
    for (text, line) in lines {
        match parse::<Line<M>>(&text?, line)? {
            Line::Step(step) => {
                let (robot, expected) = (tick.len(), recording.simulation().tick() + 1);
                if (step.robot as usize, step.tick) != (robot, expected) {
                    return Err(ReplayError::Order {
                        line,
                        robot,
                        tick: expected,
                    });
                }
                tick.push((line, step));
                if tick.len() == recording.simulation().robots().len() {
                    again(&mut recording, &tick)?;
                    tick.clear();
                }
            }
            Line::Place { robot, pose } => {
                if let Some((_, step)) = tick.first() {
                    let (robot, tick) = (tick.len(), step.tick);
                    return Err(ReplayError::Order { line, robot, tick });
                }
                let placed = recording.place(RobotId(robot), pose);
                placed.map_err(|source| refused(line, source))?;
            }
            Line::Door { name, state } => {
                recording
                    .set_door(&name, state)
                    .map_err(|source| refused(line, source))?;
            }
        }
    }
    if let Some((line, step)) = tick.last() {
        let (line, robot) = (line + 1, step.robot as usize + 1);
        return Err(ReplayError::Order {
            line,
            robot,
            tick: step.tick,
        });
    }
    recording.finish().map_err(|source| refused(1, source))
}

fn start<M: Recordable>(text: &str) -> Result<Recording<M, io::Sink>, ReplayError> {
    let head: Head = parse(text, 1)?;
    if head.format != FORMAT {
        return Err(ReplayError::Format { found: head.format });
    }
    if head.version != VERSION {
        return Err(ReplayError::Version {
            found: head.version,
        });
    }
    let header: Header<M> = parse(text, 1)?;
    let world = World::from_json(&header.world.to_string())?;
    let mut robots = Vec::new();
    for start in header.robots {
        let model = M::from_config(start.config).map_err(|source| refused(1, source))?;
        robots.push((model, start.pose));
    }
    Recording::start(world, header.seed, robots, io::sink(), Detail::Sensing)
        .map_err(|source| refused(1, source))
}

/// Simulates one tick and compares it.
fn again<M: Recordable>(
    recording: &mut Recording<M, io::Sink>,
    lines: &[(usize, Step<M>)],
) -> Result<(), ReplayError> {
    let commands: Vec<M::Command> = lines.iter().map(|(_, step)| step.command.clone()).collect();
    let first = lines.first().map_or(1, |(line, _)| *line);
    recording
        .step(&commands)
        .map_err(|source| refused(first, source))?;
    for (line, step) in lines {
        let mut now = recording.line(RobotId(step.robot), &step.command);
        if step.sensing.is_none() {
            now.sensing = None;
        }
        // The shortest text that reads back as a number differs wherever its bits do.
        let text = |step: &Step<M>| {
            serde_json::to_string(step).map_err(|source| ReplayError::Line {
                line: *line,
                column: 0,
                source,
            })
        };
        let (recorded, replayed) = (text(step)?, text(&now)?);
        if recorded != replayed {
            let (line, tick, robot) = (*line, step.tick, step.robot);
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

fn parse<T: DeserializeOwned>(text: &str, line: usize) -> Result<T, ReplayError> {
    serde_json::from_str(text).map_err(|source| ReplayError::Line {
        line,
        column: source.column(),
        source,
    })
}

fn refused(line: usize, source: impl core::error::Error + Send + Sync + 'static) -> ReplayError {
    ReplayError::Refused {
        line,
        source: Box::new(source),
    }
}
