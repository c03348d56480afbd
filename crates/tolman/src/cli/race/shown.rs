//! A race, prepared for viewing.

use std::path::Path;

use serde_json::json;
use tolman_arena::micromouse::SideSeen;
use tolman_geom::{Heading, Point, Pose};
use tolman_maze::{Cell, Direction, Maze};
use tolman_planners::speed_run::{RunState, SpeedRunConfig};
use tolman_systems::micromouse::competition::RunLeg;

use super::told::in_words;
use crate::cli::Result;
use crate::cli::looks::Looks;
use crate::cli::mouse::{Came, Way, WayStep};

/// The way of a mouse: the exploration cell by cell, then the fast run.
pub(super) struct Shown {
    way: Way,
    /// Last cell of the exploration so far.
    last: Option<Cell>,
}

impl Shown {
    /// Returns the way of a mouse that is about to begin; `None` if it is not to be shown.
    pub(super) fn new(
        file: &Path,
        maze: &Maze,
        config: &SpeedRunConfig,
        looks: &Looks,
    ) -> Result<Option<Self>> {
        let header = json!({ "rules": "competition", "mouse": config });
        let pitch = config.cell_mm / 1000.0;
        let way = Way::watched(file, maze, header, pitch, looks, None)?;
        Ok(way.map(|way| Self { way, last: None }))
    }

    /// Adds that the exploring mouse is in `cell` and sees its four sides.
    pub(super) fn arrive(&mut self, cell: Cell, open: [bool; 4]) {
        if let Some(last) = self.last.replace(cell)
            && let Some(side) = side_towards(last, cell)
        {
            self.way.go(WayStep {
                pose: self.way.in_cell(cell, side),
                words: format!("explore, {side}"),
                line: json!({ "explore": side.to_string(), "cell": cell }),
                came: Came::Moved,
            });
        }
        let sides = Direction::ALL.into_iter().zip(open);
        let seen: Vec<SideSeen> = sides
            .map(|(side, is_open)| SideSeen {
                cell,
                side,
                stands: !is_open,
            })
            .collect();
        self.way.see(&seen);
    }

    /// Adds the fast run: a point in the middle of every side that it crosses, and one where each
    /// move ends.
    pub(super) fn run(&mut self, run: &[RunLeg]) {
        self.way.begin_run();
        for (number, leg) in run.iter().enumerate() {
            let next = run.get(number + 1).map(|leg| leg.step.from);
            for pose in self.poses(leg, next) {
                self.way.go(WayStep {
                    pose,
                    words: in_words(leg),
                    line: json!({ "run": in_words(leg), "move": number }),
                    came: Came::Moved,
                });
            }
        }
    }

    fn poses(&self, leg: &RunLeg, next: Option<RunState>) -> Vec<Pose> {
        let (mut cell, on_side) = match leg.step.from {
            RunState::Straight { cell, .. } => (cell, None),
            RunState::Diagonal { cell, into, .. } => (cell, cell.beyond(into.opposite())),
            RunState::Edge { cell, heading } => (cell, cell.beyond(heading.opposite())),
        };
        // A state on a side is on that through which the mouse enters its cell.
        let mut at = on_side.map_or(self.middle(cell), |before| self.between(before, cell));
        let mut poses = Vec::new();
        for side in leg.step.directions() {
            let Some(beyond) = cell.beyond(side) else {
                break;
            };
            self.push(&mut poses, &mut at, self.between(cell, beyond));
            cell = beyond;
        }
        if matches!(next, None | Some(RunState::Straight { .. })) {
            self.push(&mut poses, &mut at, self.middle(cell));
        }
        poses
    }

    fn push(&self, poses: &mut Vec<Pose>, at: &mut Point, to: Point) {
        let way = to - *at;
        if way.norm() > 0.0 {
            poses.push(Pose::new(to, Heading::of(way)));
            *at = to;
        }
    }

    fn middle(&self, cell: Cell) -> Point {
        self.way.in_cell(cell, Direction::North).position
    }

    fn between(&self, cell: Cell, other: Cell) -> Point {
        let (one, other) = (self.middle(cell), self.middle(other));
        one + (other - one) / 2.0
    }

    pub(super) fn into_way(self) -> Way {
        self.way
    }
}

/// Returns the side of `from` on which `to` is; `None` if they are not neighbours.
pub(super) fn side_towards(from: Cell, to: Cell) -> Option<Direction> {
    let mut sides = Direction::ALL.into_iter();
    sides.find(|side| from.beyond(*side) == Some(to))
}
