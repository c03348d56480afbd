//! Localizes a mouse that was put down anywhere.

use tolman_control::heading_of;
use tolman_geom::Point;
use tolman_maps::wall_map::{CellRay, RayEnd};
use tolman_maze::{Cell, Direction, Walls};
use tolman_planners::{PoseKnowledge, PoseSet};
use tolman_robot::{Standing, Task};

use super::MazeMouse;
use super::pilot::Body;
use crate::micromouse::{SIDE, Search};

/// Belief of a mouse that was put down anywhere in the maze.
#[derive(Clone, Debug)]
pub(super) struct Lost {
    /// Possible poses of the mouse. The compass gives its heading.
    pub(super) poses: PoseSet<SIDE>,
    looks: Direction,
    /// Middle of the mouse's cell, m, in a frame that may be off by whole cells.
    middle: Point,
}

impl Lost {
    /// Takes in the visible walls of its cell.
    fn see(&mut self, walls: &impl Walls, rays: &[CellRay]) {
        for ray in rays {
            let is_open = ray.open > 0;
            if is_open || ray.end == RayEnd::Wall {
                let side = ray.direction.seen_from(self.looks);
                self.poses.see(walls, side, is_open);
            }
        }
    }

    /// Goes to the next cell by a side of its own, and returns that cell's middle.
    fn drive(&mut self, walls: &impl Walls, side: Direction, pitch: f64) -> Point {
        self.poses.drive(walls, side);
        self.looks = self.looks.turned(side);
        self.middle += heading_of(self.looks).unit() * pitch;
        self.middle
    }
}

impl<S: Search> MazeMouse<S> {
    /// Forgets the mouse's place: the mouse may be in any cell where it has been.
    pub(super) fn lose_itself(&mut self) -> Standing {
        let looks = Direction::North;
        let cells = self.brief.grid.cells();
        let known = cells.filter(|cell| self.walls.visits(*cell) > 0);
        let poses = PoseSet::among(self.brief.grid, known.map(|cell| (cell, looks)));
        let middle = self.config.middle(self.brief.start);
        self.route.clear();
        self.pilot.put_at(middle);
        match poses {
            Ok(poses) => {
                self.lost = Some(Lost {
                    poses,
                    looks,
                    middle,
                });
                Standing::UnderWay
            }
            Err(too_large) => Standing::gave_up(alloc::format!("{too_large}")),
        }
    }

    /// Makes the next action of a lost mouse: it looks, and drives to where the possible cells
    /// differ.
    pub(super) fn find_itself<R: Body>(
        &mut self,
        mut lost: Lost,
        robot: &mut R,
        task: Task,
    ) -> Result<Standing, R::Error> {
        let Some(rays) = self.pilot.look(robot, lost.middle)? else {
            self.lost = Some(lost);
            return Ok(Standing::UnderWay);
        };
        lost.see(&self.walls, &rays);
        let standing = match lost.poses.location() {
            PoseKnowledge::Found { cell, .. } => return Ok(self.found_itself(&lost, cell, task)),
            PoseKnowledge::Nowhere => Standing::gave_up("what it sees fits nowhere on its map"),
            PoseKnowledge::Among { poses } => match lost.poses.next_drive(&self.walls) {
                Some(side) => {
                    let target = lost.drive(&self.walls, side, self.config.pitch);
                    let arrival = self.pilot.drive_to(robot, target)?;
                    self.standing(arrival)
                }
                None => {
                    Standing::gave_up(alloc::format!("its map cannot tell {poses} cells apart"))
                }
            },
        };
        // Who gives up is still lost.
        self.lost = Some(lost);
        Ok(standing)
    }

    fn found_itself(&mut self, lost: &Lost, cell: Cell, task: Task) -> Standing {
        let position = self.pose().position + (self.config.middle(cell) - lost.middle);
        self.pilot.put_at(position);
        self.at = cell;
        match task {
            Task::Localize => Standing::Done,
            Task::Explore | Task::Reach(_) => Standing::UnderWay,
        }
    }
}
