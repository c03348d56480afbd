//! The first difference between two runs.

use core::fmt;

use serde::Serialize;

use super::of_trace::{Portrait, RobotTrace, Trace};

/// The first step at which two traces differ, and the difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Step number; 0 is the start.
    pub step: u32,
    /// Index of the first robot that differs in this step.
    pub robot: u32,
    /// First of its numbers that differs.
    pub what: Differs,
}

/// Kind of difference between two traces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Differs {
    /// Commands of the robot.
    Command,
    /// Poses of the robot.
    Pose,
    /// Whether the robot touched something.
    Bump,
    /// Length of the traces: the first trace ends here.
    FirstEnds,
    /// Length of the traces: the second trace ends here.
    SecondEnds,
    /// Robots: only one trace has this robot.
    Robots,
}

impl fmt::Display for Difference {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { step, robot, what } = self;
        let ends =
            |which| format!("are the same to the bit up to step {step}, where the {which} ends");
        let part = match what {
            Differs::Command => "command",
            Differs::Pose => "pose",
            Differs::Bump => "bump",
            Differs::FirstEnds => return formatter.write_str(&ends("first")),
            Differs::SecondEnds => return formatter.write_str(&ends("second")),
            Differs::Robots => return formatter.write_str("do not have the same number of robots"),
        };
        write!(formatter, "first differ at step {step}: in the {part}")?;
        if *robot > 0 {
            write!(formatter, " of robot {robot}")?;
        }
        Ok(())
    }
}

/// Returns the first difference of two traces, or `None` if they are the same to the bit. O(steps).
pub(super) fn first_difference<M: Portrait>(
    first: &Trace<M>,
    second: &Trace<M>,
) -> Option<Difference> {
    let (ones, others) = (first.robots(), second.robots());
    let differences = (0_u32..).zip(ones.iter().zip(others));
    let earliest = differences
        .filter_map(|(robot, (one, other))| of_robot(robot, one, other))
        .min_by_key(|difference| (difference.step, difference.robot));
    let missing = (ones.len() != others.len()).then(|| Difference {
        step: 0,
        robot: ones.len().min(others.len()) as u32,
        what: Differs::Robots,
    });
    missing.or(earliest)
}

fn of_robot<M: Portrait>(
    robot: u32,
    one: &RobotTrace<M>,
    other: &RobotTrace<M>,
) -> Option<Difference> {
    let differs = |step: usize, what: Differs| {
        Some(Difference {
            step: step as u32,
            robot,
            what,
        })
    };
    if !same(&one.poses[0], &other.poses[0]) {
        return differs(0, Differs::Pose);
    }
    let (ends, other_ends) = (one.commands.len(), other.commands.len());
    for step in 0..ends.min(other_ends) {
        let what = if !same(&one.commands[step], &other.commands[step]) {
            Differs::Command
        } else if !same(&one.poses[step + 1], &other.poses[step + 1]) {
            Differs::Pose
        } else if one.bumps[step] != other.bumps[step] {
            Differs::Bump
        } else {
            continue;
        };
        return differs(step + 1, what);
    }
    match ends.cmp(&other_ends) {
        core::cmp::Ordering::Less => differs(ends, Differs::FirstEnds),
        core::cmp::Ordering::Greater => differs(other_ends, Differs::SecondEnds),
        core::cmp::Ordering::Equal => None,
    }
}

/// Returns whether two values are the same to the bit. The shortest text that reads back as a
/// number differs wherever its bits do, as in the trace itself.
fn same<T: Serialize>(one: &T, other: &T) -> bool {
    match (serde_json::to_string(one), serde_json::to_string(other)) {
        (Ok(one), Ok(other)) => one == other,
        // What was read from a trace can be written again, so this does not occur.
        _ => false,
    }
}
