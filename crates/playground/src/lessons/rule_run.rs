//! Sends a robot with a rule through a maze.

use alloc::collections::BTreeMap;
use core::ops::ControlFlow;

use tolman_arena::Mind;
use tolman_arena::course::Course;
use tolman_arena::episode::{Trial, run_while};
use tolman_arena::pioneer::{CORRIDOR_WIDTH, calibrated, without_noise};
use tolman_film::Recorder;
use tolman_geom::Pose;
use tolman_maze::{Cell, Direction, Maze};
use tolman_replay::json;
use tolman_systems::control::heading_of;

use super::{RuleBrain, start_of};
use crate::PlaygroundError;

/// How a run by a rule ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RuleEnd {
    /// The robot came to the goal.
    Arrived,
    /// It came to the same cell with the same heading again and again, so it will for ever.
    Circles,
    /// No line of its rule named an open side, or time was up.
    Stuck,
}

/// A run by a rule.
#[derive(Clone, Debug)]
pub(super) struct RuleRun {
    pub(super) end: RuleEnd,
    /// Length of the way, cells.
    pub(super) cells: usize,
    /// The run in the replay player's form.
    pub(super) replay: String,
}

/// The run is broken off when a cell is left the third time to the same side. A rule without a
/// memory then repeats itself.
const ROUNDS: u32 = 3;

/// Time steps that a robot may make per cell of the maze. A wall follower meets each cell at most
/// four times in a round and needs about three steps a cell.
const STEPS_PER_CELL: u32 = 100;

/// Sends the laser Pioneer of the MSLST paper, without noise, from the start of a maze. It obeys a
/// rule: see [`RuleBrain`].
pub(super) fn run(maze: &Maze, rule: &[Direction]) -> Result<RuleRun, PlaygroundError> {
    let (start, heading) = start_of(maze);
    let course = Course::new("lesson", maze.clone(), CORRIDOR_WIDTH)?;
    let trial = Trial {
        robot: without_noise(&calibrated()),
        start: Pose::new(course.cell_centre(start), heading_of(heading)),
        step_limit: STEPS_PER_CELL * maze.grid().cell_count() as u32,
        seed: 1,
        course: &course,
    };
    let brain = RuleBrain::new(rule.to_vec(), course.corridor_width, heading);
    let mut mind = Mind::Brain(Box::new(brain));
    let mut recorder = Recorder::new(&trial);
    let mut left: BTreeMap<(Cell, Direction), u32> = BTreeMap::new();
    let mut at = start;
    let (mut cells, mut circles) = (0, false);
    let episode = run_while(&trial, &mut mind, None, |step| {
        recorder.see(step);
        let position = step.robot.truth().pose.position;
        let cell = course.world.cell_at(position).unwrap_or(at);
        if cell != at {
            let rounds = left.entry((at, step.action)).or_default();
            *rounds += 1;
            circles |= *rounds == ROUNDS;
            (at, cells) = (cell, cells + 1);
        }
        match circles {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    })?;
    let end = match (episode.reached, circles) {
        (true, _) => RuleEnd::Arrived,
        (false, true) => RuleEnd::Circles,
        (false, false) => RuleEnd::Stuck,
    };
    let replay = recorder.finish("A robot with a rule", &episode);
    Ok(RuleRun {
        end,
        cells,
        replay: json(&replay)?,
    })
}
