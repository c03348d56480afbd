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

/// Maximum length of a spur that leads into a corner, in clearances where it begins. It would be √2
/// less in a square room, and is 1.9 in a corridor of one more square.
const SPUR: f64 = 1.5;
/// Maximum distance of knots that are one place, as a share of the sum of their clearances. Two
/// junctions side by side are at least half of it apart.
const SAME: f64 = 0.35;

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
            let ends = self.branches.remove(spur).ends;
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

    /// Merges knots that are one place: near each other, or joined by a way everywhere at least
    /// `open` off the walls, m.
    pub(super) fn merge(&mut self, open: f64) {
        while let Some(link) = self.shortest(|graph, degrees, branch| {
            let [a, b] = branch.ends;
            let room = graph.knots[&a].clearance + graph.knots[&b].clearance;
            let are_junctions = degrees[&a] > 2 && degrees[&b] > 2;
            are_junctions && (branch.length() < SAME * room || branch.narrowest > open)
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
