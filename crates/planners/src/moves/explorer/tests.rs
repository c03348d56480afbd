//! The stops that the mouse makes for, compared with the definitions in their plainest form.

use alloc::vec;
use alloc::vec::Vec;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use tolman_maze::{Braided, Grid, Knowledge, Maze};

use super::*;

/// A maze of which the sides of some cells were seen.
struct Glimpsed {
    maze: Maze,
    seen: Vec<Cell>,
}

impl Walls for Glimpsed {
    fn grid(&self) -> Grid {
        self.maze.grid()
    }

    fn knowledge(&self, cell: Cell, direction: Direction) -> Knowledge {
        let was_seen = |cell: Cell| self.seen.contains(&cell);
        match self.grid().neighbour(cell, direction) {
            Some(beside) if !was_seen(cell) && !was_seen(beside) => Knowledge::Unknown,
            _ => self.maze.knowledge(cell, direction),
        }
    }
}

impl Glimpsed {
    /// Returns a maze after a walk of random leaps, and the cell in which it ended.
    fn after_walk(seed: u64) -> (Self, Cell) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let shape = Braided {
            width: 5 + (seed % 4) as u16,
            height: 6,
            share: 0.5,
        };
        let mut maze = shape.generate(&mut rng).unwrap();
        // From the middle there is something to see on all sides.
        maze.set_start(Some((Cell::new(2, 2), Direction::North)));
        let mut at = Cell::new(2, 2);
        let mut seen = vec![at];
        for _ in 0..seed % 13 {
            let side = Direction::ALL[(rng.next_u32() % 4) as usize];
            if maze.is_open(at, side) {
                at = at.beyond(side).unwrap();
                seen.push(at);
            }
        }
        (Self { maze, seen }, at)
    }

    fn may_pass(&self, cell: Cell, side: Direction) -> bool {
        self.knowledge(cell, side) != Knowledge::Wall
    }

    fn can_pass(&self, cell: Cell, side: Direction) -> bool {
        self.knowledge(cell, side) == Knowledge::Open
    }

    fn unknown_sides(&self, cell: Cell) -> usize {
        let is_unknown = |side: &&Direction| !self.knowledge(cell, **side).is_known();
        Direction::ALL.iter().filter(is_unknown).count()
    }

    /// Returns the fewest steps from some cells to every cell, by [`Grid::index`].
    fn steps(&self, from: &[Cell], open: impl Fn(Cell, Direction) -> bool) -> Vec<Option<u16>> {
        let grid = self.grid();
        let mut steps = vec![None; grid.cell_count()];
        for cell in from {
            steps[grid.index(*cell)] = Some(0);
        }
        for round in 0..=grid.cell_count() as u16 {
            for cell in grid.cells() {
                if steps[grid.index(cell)] != Some(round) {
                    continue;
                }
                for leap in leaps(cell, &open) {
                    let slot = &mut steps[grid.index(leap.end)];
                    *slot = slot.or(Some(round + 1));
                }
            }
        }
        steps
    }
}

fn leaps(from: Cell, open: impl Fn(Cell, Direction) -> bool) -> Vec<Leap> {
    let along = |side| Leap::row(from, side, |cell| open(cell, side)).collect::<Vec<_>>();
    Direction::ALL.into_iter().flat_map(along).collect()
}

/// Returns the cells that a leap drives out of.
fn driven(from: Cell, leap: Leap) -> Vec<Cell> {
    let next = |cell: &Cell| cell.beyond(leap.direction);
    let cells = core::iter::successors(Some(from), next);
    cells.take(leap.cells.into()).collect()
}

/// Knowledge of a maze, with all numbers of steps.
struct Plain<'a> {
    known: &'a Glimpsed,
    from_start: Vec<Option<u16>>,
    to_goal: Vec<Option<u16>>,
    from_here: Vec<Option<u16>>,
    runs: Vec<[Option<u16>; 4]>,
}

impl<'a> Plain<'a> {
    fn new(known: &'a Glimpsed, start: Cell, at: Cell) -> Self {
        let hoped = |cell, side| known.may_pass(cell, side);
        let plain = Self {
            known,
            from_start: known.steps(&[start], hoped),
            to_goal: known.steps(known.maze.goals(), hoped),
            from_here: known.steps(&[at], |cell, side| known.can_pass(cell, side)),
            runs: Vec::new(),
        };
        plain.with_runs()
    }

    /// Stops on known ground from where something can be seen, with the steps there.
    fn stops(&self) -> impl Iterator<Item = (Cell, f32)> {
        let grid = self.known.grid();
        grid.cells().filter_map(move |cell| {
            let steps = self.from_here[grid.index(cell)].filter(|steps| *steps > 0)?;
            (self.known.unknown_sides(cell) > 0).then_some((cell, f32::from(steps)))
        })
    }

    /// Returns the steps of the best run over one side.
    fn run_over(&self, cell: Cell, side: Direction) -> Option<u16> {
        self.runs[self.known.grid().index(cell)][side.index()]
    }

    /// Computes the best run over each side, by cell and [`Direction::index`].
    fn with_runs(mut self) -> Self {
        let grid = self.known.grid();
        let hoped = |cell, side| self.known.may_pass(cell, side);
        let mut runs = vec![[None::<u16>; 4]; grid.cell_count()];
        let mut note = |cell: Cell, side: Direction, run: u16| {
            let slot = &mut runs[grid.index(cell)][side.index()];
            *slot = Some(slot.map_or(run, |best| best.min(run)));
        };
        for from in grid.cells() {
            for leap in leaps(from, hoped) {
                let ends = (
                    self.from_start[grid.index(from)],
                    self.to_goal[grid.index(leap.end)],
                );
                let (Some(before), Some(after)) = ends else {
                    continue;
                };
                for cell in driven(from, leap) {
                    note(cell, leap.direction, before + 1 + after);
                    let beyond = cell.beyond(leap.direction).unwrap();
                    note(beyond, leap.direction.opposite(), before + 1 + after);
                }
            }
        }
        self.runs = runs;
        self
    }

    /// Returns the value of a stop for the proof, as the weights document it.
    fn told(&self, config: &MoveExplorerConfig, cell: Cell, limit: u16, open: u16) -> f32 {
        let sides = Direction::ALL.into_iter();
        let unknown = sides.filter(|side| !self.known.knowledge(cell, *side).is_known());
        let runs = unknown.filter_map(|side| self.run_over(cell, side));
        let better = runs.filter(|run| *run < limit);
        let worth = |run: u16| config.base + libm::powf(config.patience, f32::from(run - open));
        better.map(worth).sum()
    }

    /// Returns, for each cell, the fewest unknown sides on a way of fewest steps to the goal.
    fn unknown_walls(&self) -> Vec<f32> {
        let grid = self.known.grid();
        let mut walls = vec![f32::INFINITY; grid.cell_count()];
        for goal in self.known.maze.goals() {
            walls[grid.index(*goal)] = 0.0;
        }
        let hoped = |cell, side| self.known.may_pass(cell, side);
        for steps in 1..=grid.cell_count() as u16 {
            for cell in grid.cells() {
                if self.to_goal[grid.index(cell)] != Some(steps) {
                    continue;
                }
                for leap in leaps(cell, hoped) {
                    if self.to_goal[grid.index(leap.end)] != Some(steps - 1) {
                        continue;
                    }
                    let sides = driven(cell, leap).into_iter();
                    let unknown =
                        |cell: &Cell| !self.known.knowledge(*cell, leap.direction).is_known();
                    let on_it = sides.filter(unknown).count() as f32 + walls[grid.index(leap.end)];
                    let slot = &mut walls[grid.index(cell)];
                    *slot = slot.min(on_it);
                }
            }
        }
        walls
    }
}

/// Returns weights every one of which matters.
fn weights() -> MoveExplorerConfig {
    MoveExplorerConfig {
        known_step: 0.97,
        unknown_wall: 0.31,
        sight: 0.59,
        early_proof: 0.7,
        patience: 0.43,
        base: 0.083,
        nearness: 1.57,
    }
}

fn explorer(known: &Glimpsed) -> MoveExplorer<8> {
    MoveExplorer::new(weights(), known.maze.start().unwrap().0).unwrap()
}

fn is_close(a: f32, b: f32) -> bool {
    (a - b).abs() <= 1e-4 * (1.0 + a.abs())
}

/// Returns in how many mazes there was something to choose.
fn each_walk(mut check: impl FnMut(&Glimpsed, Cell) -> bool) -> usize {
    let check = |seed| {
        let (known, at) = Glimpsed::after_walk(seed);
        check(&known, at)
    };
    (0..120).map(check).filter(|chosen| *chosen).count()
}

#[test]
fn the_stops_for_a_proof_are_those_that_tell_most_near_by() {
    let chosen = each_walk(|known, at| {
        let mut explorer = explorer(known);
        let start = explorer.start;
        let plain = Plain::new(known, start, at);
        let Some(open) = plain.to_goal[known.grid().index(start)] else {
            return false;
        };
        let chart = explorer.chart(known, known.maze.goals(), at).unwrap();
        assert_eq!(chart.open(), Some(open));
        let mut tried = false;
        for limit in [open + 1, open + 2, open + 5] {
            let score = |cell: Cell, steps: f32| {
                plain.told(&weights(), cell, limit, open) / libm::powf(steps, weights().nearness)
            };
            let mut scores: Vec<f32> = plain
                .stops()
                .map(|(cell, steps)| score(cell, steps))
                .collect();
            scores.retain(|score| *score > 0.0);
            scores.sort_by(|a, b| b.total_cmp(a));
            let found: Vec<Cell> = explorer.proofs::<5>(&chart, at, limit).iter().collect();
            assert_eq!(found.len(), scores.len().min(5));
            for (cell, expect) in found.iter().zip(&scores) {
                let steps = plain.from_here[known.grid().index(*cell)].unwrap();
                let found = score(*cell, steps.into());
                assert!(is_close(found, *expect), "{cell}: {found}, not {expect}");
            }
            for (cell, _) in plain.stops() {
                let tells = plain.told(&weights(), cell, limit, open) > 0.0;
                assert_eq!(explorer.tells(&chart, cell, limit), tells);
            }
            tried |= scores.len() > 1;
        }
        tried
    });
    assert!(chosen > 40, "{chosen}");
}

#[test]
fn while_no_way_is_known_the_best_approach_is_taken() {
    let chosen = each_walk(|known, at| {
        let mut explorer = explorer(known);
        let plain = Plain::new(known, explorer.start, at);
        let chart = explorer.chart(known, known.maze.goals(), at).unwrap();
        let unknown_walls = plain.unknown_walls();
        let config = weights();
        let score = |cell: Cell, steps: f32| {
            let index = known.grid().index(cell);
            let onward =
                f32::from(plain.to_goal[index]?) + config.unknown_wall * unknown_walls[index];
            let seen = known.unknown_sides(cell) as f32;
            Some(config.sight * seen - config.known_step * steps - onward)
        };
        let scores = plain.stops().filter_map(|(cell, steps)| score(cell, steps));
        let best = scores.max_by(f32::total_cmp);
        let found = explorer.best_approach(&chart, at).map(|cell| {
            let steps = plain.from_here[known.grid().index(cell)].unwrap();
            score(cell, steps.into()).unwrap()
        });
        assert_eq!(best.is_some(), found.is_some());
        let (Some(best), Some(found)) = (best, found) else {
            return false;
        };
        assert!(is_close(best, found), "{found}, not {best}");
        plain.stops().count() > 1
    });
    assert!(chosen > 40, "{chosen}");
}

/// Checks which task each state of knowledge leads to, and when to none.
#[test]
fn what_there_is_to_do_follows_what_is_known() {
    let (mut early, mut near, mut home, mut done) = (0, 0, 0, 0);
    each_walk(|known, at| {
        let mut explorer = explorer(known);
        let chart = explorer.chart(known, known.maze.goals(), at).unwrap();
        let visited = known
            .seen
            .iter()
            .any(|cell| known.maze.goals().contains(cell));
        if visited {
            explorer.goal = Goal::Visited;
        }
        let certain = |cell, side| known.can_pass(cell, side);
        let run = known.steps(known.maze.goals(), certain)[known.grid().index(explorer.start)];
        let open = chart.open().unwrap();
        let told = |limit| {
            let best = explorer.proofs::<1>(&chart, at, limit).best()?;
            let plain = Plain::new(known, explorer.start, at);
            let steps = plain.from_here[known.grid().index(best)]?;
            let told = plain.told(&weights(), best, limit, open);
            Some((best, told / libm::powf(steps.into(), weights().nearness)))
        };
        match (run, explorer.task(&chart, at)) {
            (Some(run), Task::Decided(MoveDecision::Finished { moves })) => {
                assert!(visited && run == open && moves == run);
                done += 1;
            }
            (Some(run), Task::Prove { closed }) => {
                assert!(visited && run > open && closed == run);
            }
            (Some(_), Task::DriveTo(goal)) => {
                let steps = known.steps(&[at], certain);
                let to = |goal: &Cell| steps[known.grid().index(*goal)];
                assert!(!visited && known.maze.goals().contains(&goal));
                let reached = known.maze.goals().iter().filter_map(to);
                assert_eq!(to(&goal), reached.min());
                home += 1;
            }
            (None, Task::DriveTo(stop)) => match told(open + 1) {
                Some((best, score)) if score > weights().early_proof => {
                    assert_eq!(stop, best);
                    early += 1;
                }
                _ => {
                    assert_eq!(Some(stop), explorer.best_approach(&chart, at));
                    near += 1;
                }
            },
            (run, _) => panic!("a known run of {run:?} steps, and stuck"),
        }
        true
    });
    assert!(
        early > 5 && near > 5 && home > 3 && done > 3,
        "{early} {near} {home} {done}"
    );
}
