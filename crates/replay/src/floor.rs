//! Cells of a maze that a robot can reach, and those where it has been.

use tolman_geom::{Point, Vector};
use tolman_maze::{Cell, Direction, Grid};
use tolman_sim::{Bounds, World};

use super::{SceneryZone, TimeSeries, ZoneKind};

/// The cells of a maze world that a robot can reach from its start.
#[derive(Clone, Debug)]
pub struct Floor<'a> {
    world: &'a World,
    grid: Grid,
    pitch: f64,
    /// Whether each cell can be reached, by cell index.
    reachable: Vec<bool>,
}

impl<'a> Floor<'a> {
    /// Returns the cells that can be reached from `start`. Returns `None` if the world was not made
    /// from a maze, or `start` lies outside of the maze. Doors do not count as walls. O(cells)
    /// rays.
    pub fn from(world: &'a World, start: Point) -> Option<Self> {
        let (grid, first) = (world.grid()?, world.cell_at(start)?);
        let mut floor = Self {
            world,
            grid,
            pitch: 2.0 * world.cell_centre(Cell::new(0, 0)).x,
            reachable: vec![false; grid.cells().count()],
        };
        let mut open = vec![first];
        floor.reachable[grid.index(first)] = true;
        while let Some(cell) = open.pop() {
            for direction in Direction::ALL {
                if let Some(next) = grid.neighbour(cell, direction)
                    && !floor.reachable[grid.index(next)]
                    && floor.is_open(cell, direction)
                {
                    floor.reachable[grid.index(next)] = true;
                    open.push(next);
                }
            }
        }
        Some(floor)
    }

    /// Returns whether there is no wall between the middles of a cell and its neighbour.
    fn is_open(&self, cell: Cell, direction: Direction) -> bool {
        let (east, north) = direction.step();
        let direction = Vector::new(f64::from(east), f64::from(north));
        let caster = self.world.caster();
        caster.cast(self.world.cell_centre(cell), direction, self.pitch) > 0.9 * self.pitch
    }

    /// Returns the cells that cannot be reached, as few rectangles as possible.
    pub fn solid(&self) -> Vec<SceneryZone> {
        // Each run of a row grows northwards while the next row has the same run.
        let mut done: Vec<(Cell, Cell)> = Vec::new();
        let mut growing: Vec<(Cell, Cell)> = Vec::new();
        for y in 0..self.grid.height() {
            let mut next = Vec::new();
            for (west, east) in self.solid_runs(y) {
                let below = growing
                    .iter()
                    .position(|(first, last)| (first.x, last.x) == (west, east));
                let south = below.map_or(y, |below| growing.swap_remove(below).0.y);
                next.push((Cell::new(west, south), Cell::new(east, y)));
            }
            done.append(&mut growing);
            growing = next;
        }
        done.append(&mut growing);
        let rectangles = done.into_iter();
        rectangles
            .map(|(first, last)| self.zone(first, last))
            .collect()
    }

    /// Returns the first and last column of each run of unreachable cells in a row.
    fn solid_runs(&self, y: u16) -> Vec<(u16, u16)> {
        let mut runs: Vec<(u16, u16)> = Vec::new();
        for x in 0..self.grid.width() {
            if self.reachable[self.grid.index(Cell::new(x, y))] {
                continue;
            }
            match runs.last_mut() {
                Some((_, east)) if *east + 1 == x => *east = x,
                _ => runs.push((x, x)),
            }
        }
        runs
    }

    /// Returns the rectangle from its south-western to its north-eastern cell.
    fn zone(&self, first: Cell, last: Cell) -> SceneryZone {
        let half = Vector::new(0.5 * self.pitch, 0.5 * self.pitch);
        let min = self.world.cell_centre(first) - half;
        let max = self.world.cell_centre(last) + half;
        SceneryZone {
            kind: ZoneKind::Solid,
            name: String::new(),
            corners: Bounds { min, max }.corners().to_vec(),
        }
    }

    /// Returns, step by step, the share of the reachable cells that the robot's centre has visited.
    pub fn coverage(&self, path: impl IntoIterator<Item = Point>) -> TimeSeries {
        let all = self.reachable.iter().filter(|cell| **cell).count();
        let mut seen = vec![false; self.reachable.len()];
        let mut count = 0_u32;
        let mut series = TimeSeries::new("coverage", "%");
        for (step, position) in (0_u32..).zip(path) {
            let Some(cell) = self.world.cell_at(position) else {
                continue;
            };
            let index = self.grid.index(cell);
            if self.reachable[index] && !seen[index] {
                seen[index] = true;
                count += 1;
                series.sample(step, f64::from(count) / all as f64);
            }
        }
        series
    }
}

#[cfg(test)]
mod tests {
    use tolman_sim::CorridorSize;

    use super::*;
    use crate::Sample;

    #[test]
    fn what_is_walled_off_is_solid_and_the_rest_can_be_covered() {
        let maze = "\
o---o---o---o
| S   G |   |
o---o---o   o
|       |   |
o   o   o   o
|       |   |
o---o---o---o
";
        let maze = tolman_maze::parse(maze).unwrap().maze;
        let size = CorridorSize {
            corridor_width: 1.0,
            wall_thickness: 0.1,
        };
        let world = World::from_maze(&maze, &size).unwrap();
        let centre = |x| world.cell_centre(Cell::new(x, 2));
        let floor = Floor::from(&world, centre(0)).unwrap();
        let solid = floor.solid();
        let areas = solid.iter().map(|zone| {
            let size = zone.corners[2] - zone.corners[0];
            libm::round(size.x * size.y / (1.1 * 1.1)) as u32
        });
        assert_eq!(
            areas.collect::<Vec<u32>>(),
            [6, 1],
            "two rows of three, one cell atop"
        );

        let path = [centre(0), centre(0), centre(1), centre(2)];
        let samples = floor.coverage(path).samples;
        let expected = [(0, 0.5), (2, 1.0)].map(|(step, value)| Sample { step, value });
        assert_eq!(samples, expected);
    }
}
