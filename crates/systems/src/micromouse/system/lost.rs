//! Localizes a mouse that was put down anywhere, or carried while it explores.

use alloc::collections::BTreeMap;

use tolman_control::heading_of;
use tolman_geom::Point;
use tolman_maps::wall_map::{CellRay, RayEnd};
use tolman_maze::{Cell, Direction, Walls};
use tolman_planners::{PoseKnowledge, PoseSet};
use tolman_robot::{Standing, Task};

use super::MazeMouse;
use super::pilot::Body;
use crate::micromouse::{SIDE, Search};

/// Belief of a mouse that is anywhere in the maze.
#[derive(Clone, Debug)]
pub(super) struct Lost {
    /// Possible poses of the mouse. The compass gives its heading.
    pub(super) poses: PoseSet<SIDE>,
    looks: Direction,
    /// Middle of the mouse's cell, m, in a frame that may be off by whole cells.
    middle: Point,
    /// Number of visits to each cell since it was lost, by its offset from the first one.
    visits: BTreeMap<[i32; 2], u32>,
    /// Offset of its cell from the first one.
    at: [i32; 2],
}

/// Maximum number of visits to a cell while the known walls do not tell where the mouse is.
const MOST_VISITS: u32 = 4;
/// Maximum number of times that an exploring mouse is carried before it gives up.
const MOST_CARRIED: u32 = 3;

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

    /// Returns the side of its own by which it leaves for the neighbour where it was least often,
    /// since the known walls do not tell where it is. `None` if it was everywhere often enough.
    fn wander(&self, rays: &[CellRay]) -> Option<Direction> {
        let open = rays.iter().filter(|ray| ray.open > 0);
        let visits = |ray: &CellRay| {
            let there = beyond(self.at, ray.direction);
            self.visits.get(&there).copied().unwrap_or(0)
        };
        let ways = open.map(|ray| (visits(ray), ray.direction));
        let (visits, direction) = ways.min()?;
        (visits < MOST_VISITS).then(|| direction.seen_from(self.looks))
    }

    /// Goes to the next cell by a side of its own, and returns that cell's middle.
    fn drive(&mut self, walls: &impl Walls, side: Direction, pitch: f64) -> Point {
        self.poses.drive(walls, side);
        self.looks = self.looks.turned(side);
        self.middle += heading_of(self.looks).unit() * pitch;
        self.at = beyond(self.at, self.looks);
        *self.visits.entry(self.at).or_default() += 1;
        self.middle
    }
}

/// Returns the offset of the neighbour in a direction.
fn beyond([x, y]: [i32; 2], direction: Direction) -> [i32; 2] {
    let (east, north) = direction.step();
    [x + i32::from(east), y + i32::from(north)]
}

impl<S: Search> MazeMouse<S> {
    /// Notices that it was carried while it explored: it may be in any cell of the maze.
    pub(super) fn was_carried(&mut self) -> Standing {
        self.carried += 1;
        if self.carried > MOST_CARRIED {
            return Standing::gave_up("walls contradict its map again and again");
        }
        self.lose_itself(self.brief.grid.cells().collect())
    }

    /// Forgets the mouse's place: the mouse may be in any of these cells.
    pub(super) fn lose_itself(&mut self, cells: Vec<Cell>) -> Standing {
        let looks = Direction::North;
        let poses = cells.into_iter().map(|cell| (cell, looks));
        let poses = PoseSet::among(self.brief.grid, poses);
        let middle = self.config.middle(self.brief.start);
        self.route.clear();
        self.has_come = true;
        self.pilot.put_at(middle);
        match poses {
            Ok(poses) => {
                self.lost = Some(Lost {
                    poses,
                    looks,
                    middle,
                    visits: BTreeMap::from([([0, 0], 1)]),
                    at: [0, 0],
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
        let Some(view) = self.pilot.look(robot, lost.middle)? else {
            self.lost = Some(lost);
            return Ok(Standing::UnderWay);
        };
        if view.was_carried {
            return Ok(self.was_carried());
        }
        lost.see(&self.walls, &view.rays);
        let standing = match lost.poses.location() {
            PoseKnowledge::Found { cell, .. } => return Ok(self.found_itself(&lost, cell, task)),
            PoseKnowledge::Nowhere => Standing::gave_up("what it sees fits nowhere on its map"),
            PoseKnowledge::Among { poses } => match self.next_side(&mut lost, &view.rays) {
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
        // Who gives up is still lost, and who is carried again begins with all cells.
        self.lost.get_or_insert(lost);
        Ok(standing)
    }

    /// Returns the side by which a lost mouse leaves its cell: to where the possible cells differ,
    /// or else to where it has hardly been, while there is something to find out.
    fn next_side(&self, lost: &mut Lost, rays: &[CellRay]) -> Option<Direction> {
        let telling = lost.poses.next_drive(&self.walls);
        let is_unfinished = self.walls.unknown_count() > 0;
        telling.or_else(|| lost.wander(rays).filter(|_| is_unfinished))
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
