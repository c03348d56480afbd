use alloc::collections::VecDeque;
use alloc::vec;
use alloc::vec::Vec;

use tolman_geom::{Point, Vector};

use super::WallGrid;
use super::wall_grid::{GridIndex, around, index_of, middle};

/// Ground of a [`WallGrid`] where a robot can stand and has not been yet.
#[derive(Debug)]
pub struct Clearings<'a> {
    grid: &'a WallGrid,
    radius: f64,
    /// Whether ways lead over unknown ground, too.
    hopeful: bool,
}

/// Distances over the ground to where a way leads, as far as they were computed.
#[derive(Debug)]
pub struct GroundWay<'a> {
    clearings: &'a Clearings<'a>,
    /// Number of cells to the end of the way, by slot of the grid.
    cells: Vec<u32>,
}

const UNREACHED: u32 = u32::MAX;

/// Half-width of the square round a point whose cells count as near, cells.
const BY: i32 = 5;
/// Number of cells beyond the robot for which the way is computed: the greatest error of an action.
const ASTRAY: u32 = 16;

impl<'a> Clearings<'a> {
    pub(super) const fn new(grid: &'a WallGrid, radius: f64) -> Self {
        let hopeful = false;
        Self {
            grid,
            radius,
            hopeful,
        }
    }

    /// Returns the same ground, over which ways lead as if all that is unknown were floor: the
    /// robot then drives by the shortest way that nothing on the map forbids, and learns on it
    /// whether it is one (Stentz 1994, *Optimal and efficient path planning for partially-known
    /// environments*).
    #[must_use]
    pub const fn hopeful(self) -> Self {
        Self {
            hopeful: true,
            ..self
        }
    }

    fn leads_over(&self, index: GridIndex) -> bool {
        self.grid.stands(index, self.radius)
            || (self.hopeful && self.grid.may_stand(index, self.radius))
    }

    pub(super) const fn grid(&self) -> &'a WallGrid {
        self.grid
    }

    /// Returns whether the robot can stand at this point.
    #[must_use]
    pub fn stands(&self, at: Point) -> bool {
        self.grid.stands(index_of(at), self.radius)
    }

    /// Returns the distance, up to `most`, m, that the robot can go straight ahead before its body
    /// meets a wall or unknown ground.
    #[must_use]
    pub fn straight(&self, from: Point, unit: Vector, most: f64) -> f64 {
        let steps = (most / WallGrid::CELL) as u32;
        let free = (1..=steps)
            .take_while(|step| self.stands(from + unit * (f64::from(*step) * WallGrid::CELL)));
        free.count() as f64 * WallGrid::CELL
    }

    /// Returns the way from about `from` to the nearest ground where the robot could stand and has
    /// not been; `None` if there is none. O(cells on the way).
    #[must_use]
    pub fn way_to_gap(&self, from: Point) -> Option<GroundWay<'_>> {
        let starts = self.stands_by(from);
        let (gap, _) = self.flood(&starts, |_, slot, _| !self.grid.was_visited(slot));
        Some(self.way_between(&starts, &[gap?]))
    }

    /// Returns the way from about `from` to about `to`; `None` if the robot cannot stand at either.
    /// O(cells on the way).
    #[must_use]
    pub fn way_to(&self, from: Point, to: Point) -> Option<GroundWay<'_>> {
        let (starts, ends) = (self.stands_by(from), self.stands_by(to));
        (!starts.is_empty() && !ends.is_empty()).then(|| self.way_between(&starts, &ends))
    }

    /// Returns the way from about `from` to the nearest of several points where the robot has
    /// stood; `None` if it can stand at none of them now. O(cells on the way).
    #[must_use]
    pub fn way_to_any(&self, from: Point, to: &[Point]) -> Option<GroundWay<'_>> {
        let starts = self.stands_by(from);
        let ends = to.iter().map(|to| index_of(*to));
        let ends: Vec<GridIndex> = ends.filter(|end| self.leads_over(*end)).collect();
        (!starts.is_empty() && !ends.is_empty()).then(|| self.way_between(&starts, &ends))
    }

    fn way_between(&self, starts: &[GridIndex], ends: &[GridIndex]) -> GroundWay<'_> {
        let mut limit = None;
        let (_, cells) = self.flood(ends, |index, _, cells| {
            if limit.is_none() && starts.contains(&index) {
                limit = Some(cells + ASTRAY);
            }
            limit.is_some_and(|limit| cells > limit)
        });
        GroundWay {
            clearings: self,
            cells,
        }
    }

    /// Returns whether any of the places leads to ground where the robot could stand and has not
    /// been. O(cells).
    #[must_use]
    pub fn has_gap(&self, places: impl IntoIterator<Item = Point>) -> bool {
        let starts: Vec<GridIndex> = places
            .into_iter()
            .flat_map(|place| self.stands_by(place))
            .collect();
        let (gap, _) = self.flood(&starts, |_, slot, _| !self.grid.was_visited(slot));
        gap.is_some()
    }

    /// Returns whether the robot can have gone along a trail: from each point to the next it sees
    /// the ground between, or it knows a way of at most `longest` m. O(points · cells seen, and
    /// cells for each point that does not see the next).
    #[must_use]
    pub fn allow(&self, trail: &[Point], longest: f64) -> bool {
        let is_short = |from: Point, to: Point| {
            let metres = self.way_to(from, to).and_then(|way| way.metres(from));
            metres.is_some_and(|metres| metres <= longest)
        };
        let mut steps = trail.windows(2);
        steps.all(|ends| self.grid.sees(ends[0], ends[1]) || is_short(ends[0], ends[1]))
    }

    /// Returns whether the robot can stand in each cell and come to it from any of the places, by
    /// slot of the grid. O(cells).
    pub(super) fn reached(&self, places: impl IntoIterator<Item = Point>) -> Vec<bool> {
        let starts = places.into_iter().map(index_of);
        let starts: Vec<GridIndex> = starts
            .filter(|index| self.grid.stands(*index, self.radius))
            .collect();
        let (_, cells) = self.flood(&starts, |_, _, _| false);
        cells.into_iter().map(|cells| cells != UNREACHED).collect()
    }

    /// Spreads from `starts` over the ground where the robot can stand until `ends` returns `true`.
    /// Returns the cell where it ended, and the number of cells to each.
    fn flood(
        &self,
        from: &[GridIndex],
        mut ends: impl FnMut(GridIndex, usize, u32) -> bool,
    ) -> (Option<GridIndex>, Vec<u32>) {
        let mut cells = vec![UNREACHED; self.grid.len()];
        let mut queue = VecDeque::new();
        for from in from {
            if let Some(slot) = self.grid.slot(*from) {
                cells[slot] = 0;
                queue.push_back((*from, slot));
            }
        }
        while let Some((index, slot)) = queue.pop_front() {
            let gone = cells[slot];
            if ends(index, slot, gone) {
                return (Some(index), cells);
            }
            for next in neighbours(index) {
                if let Some(slot) = self.grid.slot(next)
                    && cells[slot] == UNREACHED
                    && self.leads_over(next)
                {
                    cells[slot] = gone + 1;
                    queue.push_back((next, slot));
                }
            }
        }
        (None, cells)
    }

    /// Returns the cells near a point in which the robot can stand and from which no wall separates
    /// it. The robot's own cell is among them, whatever the map says.
    fn stands_by(&self, at: Point) -> Vec<GridIndex> {
        let cells = around(index_of(at), BY);
        let stands: Vec<GridIndex> = cells
            .filter(|index| self.grid.stands(*index, self.radius))
            .collect();
        let in_sight = stands.iter().copied();
        let in_sight = in_sight.filter(|index| self.grid.sees(at, middle(*index)));
        let in_sight: Vec<GridIndex> = in_sight.collect();
        if in_sight.is_empty() {
            stands
        } else {
            in_sight
        }
    }
}

impl GroundWay<'_> {
    /// Returns the distance from a point to the way's end, m; `None` if it was not computed.
    #[must_use]
    pub fn metres(&self, from: Point) -> Option<f64> {
        let stands = self.clearings.stands_by(from).into_iter();
        let left = stands.filter_map(|index| {
            let cells = self.cells[self.clearings.grid.slot(index)?];
            let aside = (middle(index) - from).norm();
            (cells != UNREACHED).then_some((aside, cells))
        });
        let nearest = left.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, cells)| f64::from(cells) * WallGrid::CELL)
    }
}

fn neighbours([column, row]: GridIndex) -> [GridIndex; 4] {
    [
        [column + 1, row],
        [column, row + 1],
        [column - 1, row],
        [column, row - 1],
    ]
}

#[cfg(test)]
mod tests {
    use alloc::collections::BTreeSet;

    use super::super::GroundKind;
    use super::*;

    /// Radius below a cell's, so that the robot stands in every cell of floor.
    const RADIUS: f64 = 0.04;

    /// Returns the grid of a drawing whose first row is the lowest. `#` is a wall and a space is
    /// unknown. `v` is floor where the robot has been, and all else is floor.
    fn drawn(drawing: &[&str]) -> WallGrid {
        let letter = |[column, row]: GridIndex| drawing[row as usize].as_bytes()[column as usize];
        let end = [drawing[0].len() as i32, drawing.len() as i32];
        let mut grid = WallGrid::of([[0, 0], end], |index| match letter(index) {
            b'#' => GroundKind::Wall,
            b' ' => GroundKind::Unknown,
            _ => GroundKind::Floor,
        });
        for index in grid.indices().filter(|index| letter(*index) == b'v') {
            grid.visit(middle(index), 0.01);
        }
        grid
    }

    /// Returns a corridor one cell wide from column 1 on, visited up to `visited`.
    fn corridor(length: usize, visited: usize) -> WallGrid {
        let wall = "#".repeat(length + 2);
        let (been, left) = ("v".repeat(visited), ".".repeat(length - visited));
        drawn(&[&wall, &alloc::format!("#{been}{left}#"), &wall])
    }

    #[test]
    fn the_way_to_a_gap_is_computed_a_little_beyond_the_robot() {
        let grid = corridor(80, 60);
        let clearings = Clearings::new(&grid, RADIUS);
        let at = |column| middle([column, 1]);
        let way = clearings.way_to_gap(at(50)).unwrap();
        // The gap begins at column 61. From the nearest cell about the robot, 55, it is 6 cells, so
        // that 6 + 16 and one more are computed.
        let computed = 61 - (6 + ASTRAY as i32 + 1);
        for column in computed..=61 {
            let expected = f64::from(61 - column) * WallGrid::CELL;
            let metres = way.metres(at(column)).unwrap();
            assert!((metres - expected).abs() < 1e-9, "{column}: {metres}");
        }
        // Off the computed cells, the nearest of them counts if it is near.
        assert_eq!(way.metres(at(computed - BY)), way.metres(at(computed)));
        assert_eq!(way.metres(at(computed - BY - 1)), None);
    }

    #[test]
    fn no_trail_leads_through_a_wall() {
        // A wall of one cell between two corridors, which meet at the right end.
        let wall = "#".repeat(42);
        let (upper, end) = ("v".repeat(40), "v".repeat(20));
        let between = alloc::format!("{}{end}#", "#".repeat(21));
        let row = alloc::format!("#{upper}#");
        let grid = drawn(&[&wall, &row, &row, &between, &row, &row, &wall]);
        let clearings = Clearings::new(&grid, RADIUS);
        let at = |column, row| middle([column, row]);
        let round = [at(8, 1), at(30, 1), at(30, 5), at(8, 5)];
        assert!(clearings.allow(&round, 0.5));
        // From column 16 the way round is some ten cells, from column 2 some forty.
        assert!(clearings.allow(&[at(16, 1), at(16, 5)], 1.0));
        assert!(!clearings.allow(&[at(2, 1), at(2, 5)], 1.0));
        assert!(clearings.allow(&[at(2, 1), at(2, 5)], 3.0));
        assert!(!clearings.allow(&[at(8, 1), at(2, 1), at(2, 5), at(8, 5)], 1.0));
        assert!(clearings.allow(&[at(2, 1)], 0.0) && clearings.allow(&[], 0.0));
    }

    #[test]
    fn the_way_to_a_point_leads_to_the_ground_about_it() {
        let grid = corridor(80, 80);
        let clearings = Clearings::new(&grid, RADIUS);
        let at = |column| middle([column, 1]);
        let way = clearings.way_to(at(50), at(20)).unwrap();
        for column in [26, 40, 50] {
            let expected = f64::from(column - 20 - BY) * WallGrid::CELL;
            let metres = way.metres(at(column)).unwrap();
            assert!((metres - expected).abs() < 1e-9, "{column}: {metres}");
        }
        assert_eq!(way.metres(at(70)), None);
        assert!(clearings.way_to(at(50), middle([20, 20])).is_none());
    }

    #[test]
    fn a_gap_is_what_can_be_reached_and_was_not() {
        let all = corridor(20, 20);
        let clearings = Clearings::new(&all, RADIUS);
        assert!(clearings.way_to_gap(middle([10, 1])).is_none());
        assert!(!clearings.has_gap([middle([10, 1])]));
        let left = corridor(20, 19);
        let clearings = Clearings::new(&left, RADIUS);
        assert!(clearings.has_gap([middle([2, 1])]));
        assert!(!clearings.has_gap([]));
        // Ground behind a wall is not a gap.
        let apart = drawn(&["#########", "#vvv#...#", "#########"]);
        let clearings = Clearings::new(&apart, RADIUS);
        assert!(!clearings.has_gap([middle([1, 1])]));
        assert!(clearings.has_gap([middle([1, 1]), middle([7, 1])]));
    }

    #[test]
    fn what_is_near_behind_a_wall_is_not_where_the_robot_stands() {
        let grid = drawn(&["#####", "#vvv#", "#####", "#...#", "#####"]);
        let clearings = Clearings::new(&grid, RADIUS);
        let stands = |at| -> BTreeSet<GridIndex> { clearings.stands_by(at).into_iter().collect() };
        let row = |row| BTreeSet::from([1, 2, 3].map(|column| [column, row]));
        assert_eq!(stands(middle([2, 1])), row(1));
        assert_eq!(stands(middle([3, 3])), row(3));
        // Inside a wall nothing is in sight: whatever is near counts.
        let both: BTreeSet<_> = row(1).union(&row(3)).copied().collect();
        assert_eq!(stands(middle([2, 2])), both);
        assert!(stands(middle([2, 30])).is_empty());
        let open = drawn(&["...............", "..............."]);
        let near = Clearings::new(&open, RADIUS).stands_by(middle([7, 0]));
        assert_eq!(near.len() as i32, 2 * (2 * BY + 1));
    }

    #[test]
    fn straight_on_it_goes_until_the_body_meets_something() {
        let grid = drawn(&["........#", "........ ", "........."]);
        let clearings = Clearings::new(&grid, RADIUS);
        let from = |row| middle([1, row]);
        let straight = |row, most| clearings.straight(from(row), Vector::x(), most);
        for (row, most, cells) in [(0, 1.0, 6.0), (1, 1.0, 6.0), (2, 0.17, 3.0), (2, 1.0, 7.0)] {
            let expected = cells * WallGrid::CELL;
            assert!((straight(row, most) - expected).abs() < 1e-9, "{row}");
        }
        // A wider body keeps farther off.
        let wide = Clearings::new(&grid, 0.12);
        let free = wide.straight(from(0), Vector::x(), 1.0);
        assert!((free - 4.0 * WallGrid::CELL).abs() < 1e-9, "{free}");
        assert!(clearings.stands(from(0)) && !clearings.stands(middle([8, 0])));
    }

    #[test]
    fn reached_is_all_that_hangs_together() {
        let grid = drawn(&[".#...", ".#.#.", "...#.", "#####", "....."]);
        let clearings = Clearings::new(&grid, RADIUS);
        let reached = clearings.reached([middle([0, 0]), middle([1, 0])]);
        let expected = "1011110101111010000000000";
        let found: alloc::string::String = reached
            .iter()
            .map(|reached| if *reached { '1' } else { '0' })
            .collect();
        assert_eq!(found, expected);
        assert!(!clearings.reached([]).contains(&true));
    }
}
