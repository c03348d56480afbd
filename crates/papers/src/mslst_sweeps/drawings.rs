//! Other drawings of the Large maze. The paper's own is lost, so one drawing says little of what the paper's
//! would have shown: these have the features that it names and are random in all else.
//!
//! As with our own drawing, the baselines alone decide which of them are sized as the paper's. MSLST has no part in it.

use core::ops::RangeInclusive;

use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{Cell, Direction, Grid, Maze, MazeFile};

use crate::venue::{PaperRow, Venue, large_like};
use tolman_arena::cast::Agent;
use tolman_arena::course::Course;
use tolman_arena::episode;
use tolman_arena::pioneer;
use tolman_experiment::{BoxError, run_seed};

/// Runs of each baseline on a drawing.
const RUNS: u32 = 200;

/// Trees that are tried before the search is given up.
const TRIES: u32 = 1_000_000;

/// "Several dead ends."
const DEAD_ENDS: usize = 3;

/// How a maze is drawn.
#[derive(Debug)]
pub(super) struct Corridors {
    /// The name in a configuration.
    pub(super) name: &'static str,
    /// Junctions, bends and dead ends lie on a lattice with so many columns and rows.
    lattice: RangeInclusive<u32>,
    /// Cells from one line of the lattice to the next. A cell is 1.9 robot units and MSLST remembers eight.
    gap: RangeInclusive<u32>,
    /// The most cells that a robot may go without a bend, a junction or a dead end.
    longest: u32,
    /// How far steps per action may be from the paper's, as a share.
    pace: f64,
}

/// Long corridors, as those of our own drawing: the baselines come near all of the paper's figures.
pub(super) const LONG: &Corridors = &Corridors {
    name: "Long",
    lattice: 3..=4,
    gap: 2..=9,
    longest: u32::MAX,
    pace: 0.2,
};

/// None longer than MSLST remembers. The baselines come near the paper's success and steps; there are more turns,
/// so that their actions take more steps than the paper's.
pub(super) const SHORT: &Corridors = &Corridors {
    name: "Short",
    lattice: 4..=7,
    gap: 2..=4,
    longest: 4,
    pace: 0.6,
};

/// The drawing of a seed: the first one sized as the paper's.
pub(super) fn of(corridors: &Corridors, seed: u64) -> Result<Course, BoxError> {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    for _ in 0..TRIES {
        let Some(maze) = drawn(corridors, rng) else {
            continue;
        };
        let course = Course::for_body("Large, redrawn", &MazeFile::from(maze), &pioneer::body())?;
        let venue = large_like(course);
        if sized(&venue, corridors, seed)? {
            return Ok(venue.course);
        }
    }
    Err(format!("none of {TRIES} drawings is sized as the paper's maze").into())
}

/// "Several dead ends, a four-way intersection, and a loop … a defined destination zone in the bottom right
/// corner", one of each where the paper has "a".
fn drawn(corridors: &Corridors, rng: &mut impl Rng) -> Option<Maze> {
    let lattice = Grid::new(
        rng.random_range(corridors.lattice.clone()) as u16,
        rng.random_range(corridors.lattice.clone()) as u16,
    );
    let mut maze = tree(lattice, rng);
    let closed: Vec<(Cell, Direction)> = between(lattice)
        .filter(|&(cell, direction)| !maze.is_open(cell, direction))
        .collect();
    let (cell, direction) = *pick(&closed, rng)?;
    maze.set_wall(cell, direction, false);
    let crossings = lattice.cells().filter(|&cell| maze.degree(cell) == 4);
    let wanted = crossings.count() == 1 && maze.dead_ends().count() >= DEAD_ENDS;
    let stretched = wanted.then(|| stretched(&maze, corridors, rng))?;
    (longest_corridor(&stretched) <= corridors.longest).then_some(stretched)
}

/// A tree that grows by a random opening at a time until it has every cell.
fn tree(grid: Grid, rng: &mut impl Rng) -> Maze {
    let mut maze = Maze::solid(grid);
    let mut known = vec![false; grid.cell_count()];
    known[0] = true;
    loop {
        let ways: Vec<(Cell, Direction)> = between(grid)
            .filter(|&(cell, direction)| {
                grid.neighbour(cell, direction)
                    .is_some_and(|next| known[grid.index(cell)] != known[grid.index(next)])
            })
            .collect();
        let Some(&(cell, direction)) = pick(&ways, rng) else {
            return maze;
        };
        maze.set_wall(cell, direction, false);
        known[grid.index(cell)] = true;
        if let Some(next) = grid.neighbour(cell, direction) {
            known[grid.index(next)] = true;
        }
    }
}

/// Every two neighbours once.
fn between(grid: Grid) -> impl Iterator<Item = (Cell, Direction)> {
    grid.cells()
        .flat_map(|cell| [(cell, Direction::North), (cell, Direction::East)])
        .filter(move |&(cell, direction)| grid.neighbour(cell, direction).is_some())
}

/// The same corridors, with random distances between the lattice's columns and rows.
fn stretched(lattice: &Maze, corridors: &Corridors, rng: &mut impl Rng) -> Maze {
    let mut places = |count: u16| -> Vec<u16> {
        let mut at = 0;
        let mut places = vec![at];
        for _ in 1..count {
            at += rng.random_range(corridors.gap.clone()) as u16;
            places.push(at);
        }
        places
    };
    let (columns, rows) = (
        places(lattice.grid().width()),
        places(lattice.grid().height()),
    );
    let place = |cell: Cell| Cell::new(columns[usize::from(cell.x)], rows[usize::from(cell.y)]);
    let corner = place(Cell::new(
        lattice.grid().width() - 1,
        lattice.grid().height() - 1,
    ));
    let grid = Grid::new(corner.x + 1, corner.y + 1);
    let mut maze = Maze::solid(grid);
    for (cell, direction) in between(lattice.grid()) {
        if !lattice.is_open(cell, direction) {
            continue;
        }
        let Some(end) = lattice.grid().neighbour(cell, direction).map(place) else {
            continue;
        };
        let mut here = place(cell);
        while here != end {
            maze.set_wall(here, direction, false);
            let Some(next) = grid.neighbour(here, direction) else {
                break;
            };
            here = next;
        }
    }
    maze.set_goals(vec![Cell::new(corner.x, 0)]);
    maze
}

/// The most cells from a bend, junction or dead end straight on to the next.
fn longest_corridor(maze: &Maze) -> u32 {
    let ahead = |cell, direction| {
        maze.is_open(cell, direction)
            .then(|| maze.grid().neighbour(cell, direction))
            .flatten()
    };
    let goes_on = |cell, direction: Direction| {
        maze.degree(cell) == 2
            && maze.is_open(cell, direction)
            && maze.is_open(cell, direction.opposite())
    };
    let mut longest = 0;
    for cell in maze.grid().cells() {
        for direction in [Direction::North, Direction::East] {
            if goes_on(cell, direction) {
                continue;
            }
            let (mut here, mut cells) = (cell, 0);
            while let Some(next) = ahead(here, direction) {
                (here, cells) = (next, cells + 1);
                if !goes_on(here, direction) {
                    break;
                }
            }
            longest = longest.max(cells);
        }
    }
    longest
}

fn pick<'a, T>(items: &'a [T], rng: &mut impl Rng) -> Option<&'a T> {
    let last = (items.len() as u32).checked_sub(1)?;
    items.get(rng.random_range(0..=last) as usize)
}

/// Whether the baselines come out as in the paper, by the margins that our own drawing was held to.
fn sized(venue: &Venue, corridors: &Corridors, seed: u64) -> Result<bool, BoxError> {
    for agent in [Agent::Avoid, Agent::WallFollow] {
        let Some(paper) = venue.paper(agent.name()) else {
            return Err(format!("the paper has no row {:?}", agent.name()).into());
        };
        if !near(venue, agent, paper, corridors, seed)? {
            return Ok(false);
        }
    }
    Ok(true)
}

fn near(
    venue: &Venue,
    agent: Agent,
    paper: &PaperRow,
    corridors: &Corridors,
    seed: u64,
) -> Result<bool, BoxError> {
    let (mut reached, mut actions, mut steps) = (0, 0, 0);
    for run in 0..RUNS {
        let trial = venue.trial(run_seed(seed, "drawings", run));
        let mut mind = venue.mind(agent)?;
        let episode = episode::run(&trial, &mut mind, |_| {})?;
        reached += u32::from(episode.reached);
        actions += episode.actions;
        steps += episode.steps;
    }
    let mean = |sum: u32| f64::from(sum) / f64::from(RUNS);
    let within = |ours: f64, theirs: f64, share: f64| (ours / theirs - 1.0).abs() <= share;
    let pace = f64::from(steps) / f64::from(actions);
    Ok(
        (100.0 * mean(reached) - paper.success_percent).abs() <= 15.0
            && within(mean(steps), paper.steps.0, 0.35)
            && within(pace, paper.steps.0 / paper.actions.0, corridors.pace),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawings_have_what_the_paper_names() {
        let rng = &mut ChaCha8Rng::seed_from_u64(1);
        let mut draw =
            |corridors| -> Vec<Maze> { (0..2000).filter_map(|_| drawn(corridors, rng)).collect() };
        let mazes = [draw(LONG), draw(SHORT)].concat();
        assert!(mazes.len() > 20, "{}", mazes.len());
        for maze in mazes {
            let inside: Vec<Cell> = maze.reachable().collect();
            let openings: usize = inside.iter().map(|&cell| maze.degree(cell)).sum();
            let crossings = inside.iter().filter(|&&cell| maze.degree(cell) == 4);
            assert_eq!(crossings.count(), 1);
            assert!(maze.dead_ends().count() >= DEAD_ENDS);
            // A tree has one passage less than cells: this is one loop.
            assert_eq!(openings / 2, inside.len());
            assert_eq!(maze.goals(), [Cell::new(maze.grid().width() - 1, 0)]);
        }
    }
}
