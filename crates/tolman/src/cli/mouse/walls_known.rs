use alloc::collections::BTreeMap;

use tolman_arena::micromouse::SideSeen;
use tolman_geom::Point;
use tolman_maze::{Cell, Direction, Grid, Wall};
use tolman_replay::{EdgeKind, MapEdge, MapGrowth, MapNode, TimeSeries};

/// Walls that a mouse knows, with the step at which it learned each.
#[derive(Debug)]
pub(super) struct WallsKnown {
    grid: Grid,
    /// Distance between two posts, m.
    pitch: f64,
    /// Sides of cells that are known, by the wall that stands there or could stand there.
    sides: BTreeMap<Wall, SideKnown>,
}

/// Knowledge of a mouse about one side.
#[derive(Clone, Copy, Debug)]
struct SideKnown {
    /// Step at which the mouse first saw the side.
    since: u32,
    stands: bool,
}

impl WallsKnown {
    /// Returns an empty record, for a `grid` whose posts are `pitch` metres apart.
    pub(super) const fn new(grid: Grid, pitch: f64) -> Self {
        Self {
            grid,
            pitch,
            sides: BTreeMap::new(),
        }
    }

    /// Records a side that was seen after `step`.
    pub(super) fn see(&mut self, since: u32, seen: SideSeen) {
        let SideSeen { cell, side, stands } = seen;
        let known = self.sides.entry(self.grid.wall(cell, side));
        known.or_insert(SideKnown { since, stands });
    }

    /// Returns whether the mouse knows that there is no wall on a side of a cell.
    pub(super) fn knows_open(&self, cell: Cell, side: Direction) -> bool {
        let known = self.sides.get(&self.grid.wall(cell, side));
        known.is_some_and(|known| !known.stands)
    }

    /// Returns the numbers of the two posts of a wall; `None` if the grid has no such wall.
    fn posts(&self, wall: Wall) -> Option<(u32, u32)> {
        let (cell, side) = self.grid.side(wall)?;
        let (x, y) = (u32::from(cell.x), u32::from(cell.y));
        let [from, to] = match side {
            Direction::North => [(x, y + 1), (x + 1, y + 1)],
            Direction::East => [(x + 1, y), (x + 1, y + 1)],
            Direction::South => [(x, y), (x + 1, y)],
            Direction::West => [(x, y), (x, y + 1)],
        };
        let post = |(x, y)| y * (u32::from(self.grid.width()) + 1) + x;
        Some((post(from), post(to)))
    }

    /// Returns the known walls as a map that grows.
    pub(super) fn growth(&self) -> MapGrowth {
        let walls = self.sides.iter().filter(|(_, known)| known.stands);
        let standing: BTreeMap<(u32, u32), u32> = walls
            .filter_map(|(wall, known)| Some((self.posts(*wall)?, known.since)))
            .collect();
        let mut posts: BTreeMap<u32, u32> = BTreeMap::new();
        for (&(from, to), &step) in &standing {
            for post in [from, to] {
                let born = posts.entry(post).or_insert(step);
                *born = step.min(*born);
            }
        }
        let columns = u32::from(self.grid.width()) + 1;
        let at = |post: u32| {
            Point::new(f64::from(post % columns), f64::from(post / columns)) * self.pitch
        };
        let nodes = posts
            .iter()
            .map(|(post, born)| MapNode::new(*post, at(*post), *born));
        let edges = standing.iter().map(|(&(from, to), &born)| MapEdge {
            kind: EdgeKind::Wall,
            ..MapEdge::new(from, to, born)
        });
        MapGrowth {
            name: "walls it knows".to_owned(),
            nodes: nodes.collect(),
            edges: edges.collect(),
        }
    }

    /// Returns the number of known sides at each step.
    pub(super) fn count(&self) -> TimeSeries {
        let mut steps: Vec<u32> = self.sides.values().map(|known| known.since).collect();
        steps.sort_unstable();
        let mut series = TimeSeries::new("sides of cells it knows", "");
        for (known, step) in (1_u32..).zip(steps) {
            series.sample(step, f64::from(known));
        }
        series
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_is_known_from_the_first_step_it_was_seen_in() {
        let mut known = WallsKnown::new(Grid::new(2, 2), 1.0);
        let side = |x, side, stands| SideSeen {
            cell: Cell::new(x, 0),
            side,
            stands,
        };
        known.see(0, side(0, Direction::East, true));
        known.see(3, side(1, Direction::West, true));
        known.see(3, side(1, Direction::North, false));
        let growth = known.growth();
        assert_eq!(growth.edges.len(), 1, "from both sides it is one wall");
        assert_eq!(
            (growth.edges[0].a, growth.edges[0].b, growth.edges[0].born),
            (1, 4, 0)
        );
        assert_eq!(growth.nodes[1].position, Point::new(1.0, 1.0));
        let samples = known.count().samples;
        let samples = samples
            .iter()
            .map(|sample| (sample.step, sample.value as u32));
        assert_eq!(samples.collect::<Vec<_>>(), [(0, 1), (3, 2)]);
    }
}
