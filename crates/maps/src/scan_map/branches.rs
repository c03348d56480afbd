use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use super::WallGrid;
use super::skeleton::Skeleton;
use super::wall_grid::GridIndex;

/// The lines of a [`Skeleton`] as a graph: knots where lines meet or end, and branches between
/// them.
#[derive(Debug, Default)]
pub(super) struct Branches {
    /// Knots by number; numbers of removed knots are missing.
    knots: BTreeMap<usize, Knot>,
    branches: Vec<Branch>,
}

/// Point where lines meet or end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Knot {
    pub(super) at: GridIndex,
    /// Distance of the nearest wall, m.
    pub(super) clearance: f64,
}

/// A line between two knots, which may be the same.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    pub(super) ends: [usize; 2],
    /// Cells from the first end to the second, both included.
    pub(super) cells: Vec<GridIndex>,
    /// Minimum clearance along the branch, m.
    pub(super) narrowest: f64,
}

/// Maximum length of a spur that leads into a corner, in clearances where it begins. In mazes of
/// ten families corners had at most 1.23, and dead ends of one square mostly 1.41 to 2.
const SPUR: f64 = 1.3;

impl Branch {
    fn of(ends: [usize; 2], cells: Vec<GridIndex>, clearance: impl Fn(GridIndex) -> f64) -> Self {
        let clearances = cells.iter().map(|at| clearance(*at));
        Self {
            ends,
            narrowest: clearances.fold(f64::INFINITY, f64::min),
            cells,
        }
    }

    /// Returns the length of the branch, m.
    pub(super) fn length(&self) -> f64 {
        let step = |pair: &[GridIndex]| {
            let [x, y] = [0, 1].map(|axis| f64::from(pair[1][axis] - pair[0][axis]));
            libm::hypot(x, y)
        };
        self.cells.windows(2).map(step).sum::<f64>() * WallGrid::CELL
    }
}

impl Branches {
    /// Returns the branches of a skeleton of ground that lies at least `radius` off the walls, m.
    /// O(cells · log cells).
    pub(super) fn of(skeleton: &Skeleton, radius: f64) -> Self {
        let beside: BTreeMap<GridIndex, Vec<GridIndex>> = skeleton
            .cells()
            .map(|at| (at, skeleton.beside(at).collect()))
            .collect();
        let clearance = |at: GridIndex| skeleton.depth(at) + radius;
        let mut graph = Self::default();
        let mut numbers: BTreeMap<GridIndex, usize> = BTreeMap::new();
        let mut passed: BTreeSet<GridIndex> = BTreeSet::new();
        let ends = beside.iter().filter(|(_, next)| next.len() != 2);
        // The remaining cells form rings, which may begin at any cell.
        let rings = beside.iter().filter(|(_, next)| next.len() == 2);
        for (at, next) in ends.chain(rings) {
            if passed.contains(at) {
                continue;
            }
            let is_ring = next.len() == 2;
            for way in next {
                let cells = follow(&beside, *at, *way);
                let Some(end) = cells.last().copied() else {
                    continue;
                };
                // This line was already followed from its other end.
                let again = [cells[cells.len() - 2], end];
                let is_first = [*at, *way] <= [end, again[0]] || is_ring;
                if is_first && !(is_ring && passed.contains(way)) {
                    let ends = [*at, end].map(|at| {
                        let next = numbers.len();
                        *numbers.entry(at).or_insert(next)
                    });
                    passed.extend(&cells[1..cells.len() - 1]);
                    graph.branches.push(Branch::of(ends, cells, clearance));
                }
            }
            let next = numbers.len();
            numbers.entry(*at).or_insert(next);
        }
        let knot = |at| Knot {
            at,
            clearance: clearance(at),
        };
        graph.knots = numbers
            .into_iter()
            .map(|(at, number)| (number, knot(at)))
            .collect();
        graph
    }

    /// Returns the knots, by number.
    pub(super) const fn knots(&self) -> &BTreeMap<usize, Knot> {
        &self.knots
    }

    /// Returns the branches between knots.
    pub(super) fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Removes branches that only lead into corners, the shortest first.
    pub(super) fn prune(&mut self) {
        while let Some(spur) = self.shortest(|graph, degrees, branch| {
            let [root, tip] = match branch.ends {
                [a, b] if degrees[&a] == 1 => [b, a],
                ends => ends,
            };
            let is_spur = degrees[&tip] == 1 && degrees[&root] > 2;
            is_spur && branch.length() < SPUR * graph.knots[&root].clearance
        }) {
            let Branch { ends, .. } = self.branches.remove(spur);
            let degrees = self.degrees();
            for end in ends {
                match degrees[&end] {
                    0 => {
                        self.knots.remove(&end);
                    }
                    2 => self.dissolve(end),
                    _ => {}
                }
            }
        }
    }

    /// Makes a knot in the middle of each room that lines only cross: where cells of a branch have
    /// more than `open` to the nearest wall, m, and its ends do not. O(cells).
    pub(super) fn mark_rooms(&mut self, open: f64, clearance: impl Fn(GridIndex) -> f64) {
        let mut next = 0;
        while let Some(branch) = self.branches.get(next) {
            let widths: Vec<f64> = branch.cells.iter().map(|at| clearance(*at)).collect();
            let is_open = |width: &f64| *width > open;
            // A room at an end is the place of the knot there.
            let first = widths.iter().position(|width| !is_open(width));
            let last = widths.iter().rposition(|width| !is_open(width));
            let between = first.zip(last).map(|(first, last)| first..last);
            let widest = between.and_then(|between| {
                let wide = between.filter(|index| is_open(&widths[*index]));
                wide.max_by(|a, b| widths[*a].total_cmp(&widths[*b]))
            });
            match widest {
                // Its halves are looked at later.
                Some(index) => {
                    let middle = self.split(next, index);
                    if let Some(knot) = self.knots.get_mut(&middle) {
                        knot.clearance = widths[index];
                    }
                }
                None => next += 1,
            }
        }
    }

    /// Merges knots that are one place: joined by a way and less than `apart` from each other, m,
    /// or joined by a way everywhere at least `open` off the walls, m. A ring less than `apart`
    /// long goes.
    pub(super) fn merge(&mut self, apart: f64, open: f64) {
        while let Some(link) = self.shortest(|graph, degrees, branch| {
            let [a, b] = branch.ends;
            let [x, y] = [0, 1].map(|axis| {
                f64::from(graph.knots[&a].at[axis] - graph.knots[&b].at[axis]) * WallGrid::CELL
            });
            let far = if a == b {
                branch.length()
            } else {
                libm::hypot(x, y)
            };
            let are_junctions = degrees[&a] > 2 && degrees[&b] > 2;
            far < apart || (are_junctions && branch.narrowest > open)
        }) {
            let [a, b] = self.branches.remove(link).ends;
            if a == b {
                if self.degrees()[&a] == 2 {
                    self.dissolve(a);
                }
                continue;
            }
            let clearance = |knot: usize| self.knots[&knot].clearance;
            let [kept, lost] = if clearance(a) < clearance(b) {
                [b, a]
            } else {
                [a, b]
            };
            self.knots.remove(&lost);
            for branch in &mut self.branches {
                branch.ends = branch.ends.map(|end| if end == lost { kept } else { end });
            }
        }
    }

    /// Returns the knot nearest to `at` within `reach` cells for which `fits` is true. If there is
    /// none, makes one on the nearest branch; without branches, returns the nearest knot. `None` if
    /// the graph has no knots.
    pub(super) fn knot_at(
        &mut self,
        at: GridIndex,
        reach: f64,
        fits: impl Fn(usize, GridIndex) -> bool,
    ) -> Option<usize> {
        let far =
            |cell: GridIndex| libm::hypot(f64::from(cell[0] - at[0]), f64::from(cell[1] - at[1]));
        let within =
            |(number, knot): &(&usize, &Knot)| far(knot.at) <= reach && fits(**number, knot.at);
        let nearer = |a: &(&usize, &Knot), b: &(&usize, &Knot)| far(a.1.at).total_cmp(&far(b.1.at));
        let fitting = self.knots.iter().filter(within).min_by(nearer);
        if let Some((number, _)) = fitting {
            return Some(*number);
        }
        let cells = self
            .branches
            .iter()
            .enumerate()
            .flat_map(|(number, branch)| {
                let cells = branch.cells.iter().enumerate();
                cells.map(move |(index, cell)| (far(*cell), number, index))
            });
        match cells.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, number, index)) => Some(self.split(number, index)),
            None => Some(*self.knots.iter().min_by(nearer)?.0),
        }
    }

    /// Returns the number of branches that end at each knot; one that begins and ends there counts
    /// twice.
    pub(super) fn degrees(&self) -> BTreeMap<usize, usize> {
        let mut degrees: BTreeMap<usize, usize> =
            self.knots.keys().map(|knot| (*knot, 0)).collect();
        for end in self.branches.iter().flat_map(|branch| branch.ends) {
            *degrees.entry(end).or_default() += 1;
        }
        degrees
    }

    fn split(&mut self, branch: usize, index: usize) -> usize {
        let number = self.knots.keys().next_back().map_or(0, |last| last + 1);
        let Branch {
            ends,
            cells,
            narrowest,
        } = self.branches.swap_remove(branch);
        let at = cells[index];
        let clearance = narrowest;
        self.knots.insert(number, Knot { at, clearance });
        self.branches.push(Branch {
            ends: [ends[0], number],
            cells: cells[..=index].to_vec(),
            narrowest,
        });
        self.branches.push(Branch {
            ends: [number, ends[1]],
            cells: cells[index..].to_vec(),
            narrowest,
        });
        number
    }

    /// Joins the two branches at a knot that has no others.
    fn dissolve(&mut self, knot: usize) {
        let mut at_it =
            (0..self.branches.len()).filter(|index| self.branches[*index].ends.contains(&knot));
        // A ring keeps one knot.
        let (Some(one), Some(other)) = (at_it.next(), at_it.next()) else {
            return;
        };
        let other = self.branches.remove(other);
        let branch = &mut self.branches[one];
        if branch.ends[1] != knot {
            branch.ends.reverse();
            branch.cells.reverse();
        }
        let mut onward = other;
        if onward.ends[0] != knot {
            onward.ends.reverse();
            onward.cells.reverse();
        }
        branch.narrowest = branch.narrowest.min(onward.narrowest);
        branch.ends[1] = onward.ends[1];
        branch.cells.extend(onward.cells.into_iter().skip(1));
        self.knots.remove(&knot);
    }

    /// Returns the index of the shortest branch for which `is_meant` holds, given the degrees of
    /// all knots.
    fn shortest(
        &self,
        is_meant: impl Fn(&Self, &BTreeMap<usize, usize>, &Branch) -> bool,
    ) -> Option<usize> {
        let degrees = self.degrees();
        let meant = self.branches.iter().enumerate();
        let meant = meant.filter(|(_, branch)| is_meant(self, &degrees, branch));
        let lengths = meant.map(|(index, branch)| (branch.length(), index));
        let shortest = lengths.min_by(|a, b| a.0.total_cmp(&b.0));
        shortest.map(|(_, index)| index)
    }
}

/// Returns the cells of the line from `at` through `way` to the next knot, both ends included.
fn follow(
    beside: &BTreeMap<GridIndex, Vec<GridIndex>>,
    at: GridIndex,
    way: GridIndex,
) -> Vec<GridIndex> {
    let mut cells = alloc::vec![at, way];
    let (mut before, mut here) = (at, way);
    while here != at
        && let Some([one, other]) = beside.get(&here).map(Vec::as_slice)
    {
        let next = if *one == before { *other } else { *one };
        cells.push(next);
        (before, here) = (here, next);
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::super::GroundKind;
    use super::*;

    const CELL: f64 = WallGrid::CELL;

    /// Returns a branch that runs straight from one end to the other.
    fn branch(ends: [usize; 2], from: GridIndex, to: GridIndex, narrowest: f64) -> Branch {
        let way = [to[0] - from[0], to[1] - from[1]];
        let steps = way[0].abs().max(way[1].abs());
        let cell = |step: i32| [0, 1].map(|axis| from[axis] + step * way[axis].signum());
        Branch {
            ends,
            cells: (0..=steps).map(cell).collect(),
            narrowest,
        }
    }

    /// Returns two junctions `apart` cells apart, each with two dead ends of its own.
    fn two_junctions(apart: i32, clearance: f64, narrowest: f64) -> Branches {
        let (left, right) = ([0, 0], [apart, 0]);
        let tips = [[-40, 40], [-40, -40], [apart + 40, 40], [apart + 40, -40]];
        let knots = [left, right].into_iter().chain(tips);
        let knots = knots.map(|at| Knot { at, clearance });
        let between = branch([0, 1], left, right, narrowest);
        let spurs = (2..).zip(tips).map(|(number, tip)| {
            let (root, at) = if number < 4 { (0, left) } else { (1, right) };
            branch([root, number], at, tip, clearance)
        });
        Branches {
            knots: knots.enumerate().collect(),
            branches: [between].into_iter().chain(spurs).collect(),
        }
    }

    #[test]
    fn junctions_are_one_place_if_near_or_joined_by_open_ground() {
        let clearance = 0.5;
        let near = 0.7;
        let less = libm::ceil(near / CELL) as i32 - 1;
        for (apart, narrowest, is_one) in [
            (less, 0.1, true),
            (less + 2, 0.1, false),
            (less + 2, 0.3, false),
            (less + 2, 0.4, true),
        ] {
            let mut graph = two_junctions(apart, clearance, narrowest);
            graph.merge(near, 0.3);
            let knots = if is_one { 5 } else { 6 };
            assert_eq!(graph.knots().len(), knots, "{apart} {narrowest}");
            assert_eq!(graph.branches().len(), knots - 1, "{apart} {narrowest}");
            let most = graph.degrees().into_values().max();
            assert_eq!(most, Some(if is_one { 4 } else { 3 }));
        }
    }

    #[test]
    fn the_roomier_of_two_junctions_is_kept() {
        for kept in [0, 1] {
            let mut graph = two_junctions(3, 0.5, 0.1);
            graph.knots.get_mut(&kept).unwrap().clearance = 0.6;
            graph.merge(0.7, 0.3);
            assert!(graph.knots().contains_key(&kept));
            assert!(!graph.knots().contains_key(&(1 - kept)));
        }
    }

    #[test]
    fn a_dead_end_is_no_junction() {
        let mut graph = two_junctions(3, 0.5, 0.1);
        graph.branches.truncate(3);
        for tip in [4, 5] {
            graph.knots.remove(&tip);
        }
        graph.merge(0.1, 0.05);
        // Knot 1 has only the branch from the junction now.
        assert_eq!(graph.branches().len(), 3);
        assert_eq!(graph.knots().len(), 4);
    }

    /// Returns a knot with `ways` branches to dead ends, and a ring that begins and ends at it.
    fn ring_with(ways: usize) -> Branches {
        let tips = [[-40, 0], [0, -40], [-40, -40]];
        let knots = [[0, 0]].into_iter().chain(tips.into_iter().take(ways));
        let knots = knots.map(|at| Knot { at, clearance: 0.5 });
        let mut ring = branch([0, 0], [0, 0], [1, 1], 0.1);
        ring.cells.extend([[1, 0], [0, 0]]);
        let spurs = (1..).zip(tips.into_iter().take(ways));
        let spurs = spurs.map(|(number, tip)| branch([0, number], [0, 0], tip, 0.2));
        Branches {
            knots: knots.enumerate().collect(),
            branches: [ring].into_iter().chain(spurs).collect(),
        }
    }

    #[test]
    fn a_knot_that_only_a_ring_made_dissolves_with_it() {
        // Of the two branches at it one is left, through where it was.
        let mut graph = ring_with(2);
        graph.merge(0.7, 9.0);
        assert_eq!(graph.branches().len(), 1);
        let left = &graph.branches()[0];
        assert_eq!(left.cells.len(), 81);
        assert!(left.cells.contains(&[0, 0]));
        assert_eq!(graph.knots().keys().copied().collect::<Vec<_>>(), [1, 2]);
        // With one branch it is a dead end, and with three a junction.
        for ways in [1, 3] {
            let mut graph = ring_with(ways);
            graph.merge(0.7, 9.0);
            assert_eq!(graph.branches().len(), ways);
            assert_eq!(graph.knots().len(), ways + 1);
        }
    }

    /// Returns the lines of a drawing, in rows from south to north: `.` is ground.
    fn of_lines(drawing: &[&str]) -> Branches {
        let end = [drawing[0].len() as i32, drawing.len() as i32];
        let letters: Vec<u8> = drawing.iter().flat_map(|row| row.bytes()).collect();
        let grid = WallGrid::of([[0, 0], end], |_| GroundKind::Floor);
        let ground = letters.iter().map(|letter| *letter == b'.').collect();
        Branches::of(&Skeleton::of(&grid, ground), 0.2)
    }

    #[test]
    fn lines_are_followed_once_and_rings_too() {
        for (drawing, knots, branches) in [
            (&["       ", " ..... ", "       "][..], 2, 1),
            (
                &[
                    "       ", " ..... ", " .   . ", " .   . ", " ..... ", "       ",
                ],
                1,
                1,
            ),
            (
                &["  .    ", "  .    ", ".......", "    .  ", "    .  "],
                6,
                5,
            ),
            (
                &[
                    "         ",
                    " ....    ",
                    " .  .    ",
                    " .  .... ",
                    " ....    ",
                    "         ",
                ],
                2,
                2,
            ),
            (&["   ", " . ", "   "], 1, 0),
        ] {
            let graph = of_lines(drawing);
            assert_eq!(graph.knots().len(), knots, "{drawing:?} {graph:?}");
            assert_eq!(graph.branches().len(), branches, "{drawing:?} {graph:?}");
            for branch in graph.branches() {
                let ends = branch.ends.map(|end| graph.knots()[&end].at);
                let (first, last) = (branch.cells.first(), branch.cells.last());
                assert_eq!((first, last), (Some(&ends[0]), Some(&ends[1])));
            }
            // A cell of a line lies a cell off the border.
            let clearance = CELL + 0.2;
            let knots = graph.knots().values();
            assert!(
                knots
                    .into_iter()
                    .all(|knot| (knot.clearance - clearance).abs() < 1e-9)
            );
            let narrowest = graph.branches().iter().map(|branch| branch.narrowest);
            assert!(
                narrowest
                    .into_iter()
                    .all(|narrowest| (narrowest - clearance).abs() < 1e-9)
            );
        }
    }

    #[test]
    fn short_spurs_are_pruned_and_their_knots_dissolve() {
        // At a clearance of 0.2 m and a cell a spur is shorter than SPUR times as much.
        let most = SPUR * (CELL + 0.2) / CELL;
        let spur = |length: usize| {
            let mut rows = alloc::vec![" ".repeat(81); length];
            rows.push(".".repeat(81));
            for row in &mut rows[..length] {
                row.replace_range(40..41, ".");
            }
            let rows: Vec<&str> = rows.iter().map(alloc::string::String::as_str).collect();
            let mut graph = of_lines(&rows);
            let before = graph.branches().len();
            graph.prune();
            (before, graph.branches().len(), graph.knots().len())
        };
        let less = libm::ceil(most) as usize - 1;
        assert_eq!(spur(less), (3, 1, 2));
        assert_eq!(spur(less + 2), (3, 3, 4));
        // What lies between two knots only is no spur, however short.
        let mut line = of_lines(&["   ", "...", "   "]);
        line.prune();
        assert_eq!(line.branches().len(), 1);
    }

    #[test]
    fn the_length_is_that_of_straight_and_diagonal_steps() {
        let mut line = branch([0, 1], [2, 3], [6, 3], 0.1);
        assert!((line.length() - 4.0 * CELL).abs() < 1e-12);
        line.cells.extend([[7, 4], [7, 5]]);
        let expected = (5.0 + core::f64::consts::SQRT_2) * CELL;
        assert!((line.length() - expected).abs() < 1e-12);
    }
}
