//! The paper's pictures: the mouse's knowledge and its visits, on maze 2.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use tolman_geom::Point;
use tolman_maps::wall_map::WallMap;
use tolman_maze::{Cell, Direction, Knowledge, Maze, Walls};
use tolman_planners::{Passages, TooLarge, Unknown};

use super::Micromouse;
use tolman_arena::micromouse::{MouseTrial, Ruling, brief};
use tolman_draw::{Drawing, Figure, FloorPlan, Series, Shade};
use tolman_experiment::{BoxError, Run};
use tolman_systems::micromouse::{
    Certify, CounterSearch, Driver, RunTwo, SIDE, Search, Searcher, TargetSearch,
};

/// Width of a plan, user units.
const WIDTH: f64 = 420.0;

/// Table whose maze is shown, as in the paper.
pub(super) const TABLE: &str = "2";

pub(super) fn of(experiment: &Micromouse, runs: &[Run]) -> Result<Vec<Figure>, BoxError> {
    let Some(table) = experiment.paper.iter().find(|table| table.name == TABLE) else {
        return Ok(Vec::new());
    };
    let Some((_, maze)) = table.mazes().next() else {
        return Ok(Vec::new());
    };
    let brief = brief(maze)?;
    let target = || Driver::new(brief.clone(), TargetSearch::new(), RunTwo::FewestCells);
    let mut figures = vec![
        uncertainty(&known_after(maze, &mut target()?, 1)?, 1),
        uncertainty(&known_after(maze, &mut target()?, 60)?, 60),
    ];
    // The first counter search of the table, with its original seed.
    let seed = runs.iter().find(|run| {
        run.table == TABLE
            && table
                .row(&run.row)
                .is_some_and(|(searcher, _)| searcher == Searcher::Counter50)
    });
    if let Some(run) = seed {
        let search = CounterSearch::new(50, ChaCha8Rng::seed_from_u64(run.seed));
        let mut mouse = Driver::new(brief, search, RunTwo::FewestCells)?;
        let map = known_after(maze, &mut mouse, u32::MAX)?;
        figures.push(counters(&map));
        figures.push(dead_ends(&map));
    }
    figures.extend(open_and_closed(maze)?);
    Ok(figures)
}

/// Returns the mouse's map after `steps` steps, or at the end of its first run.
fn known_after<S: Search>(
    maze: &Maze,
    mouse: &mut Driver<S>,
    steps: u32,
) -> Result<WallMap<SIDE>, BoxError> {
    let (mut known, mut made) = (None, 0);
    MouseTrial::play(maze, mouse, |step, mouse| {
        made += 1;
        if made == steps || step.event == Ruling::RunTwo {
            known.get_or_insert(*mouse.map());
        }
    })?;
    Ok(known.unwrap_or(*mouse.map()))
}

fn uncertainty(map: &WallMap<SIDE>, steps: u32) -> Figure {
    let shade = Shade::new("unknown sides", 0.0, 4.0);
    let drawing = values(map, &shade, |cell| f64::from(map.uncertainty(cell)));
    let title = format!("Uncertainty after {steps} steps");
    Figure::new(format!("uncertainty-{steps}"), title, drawing)
        .caption("How many sides of each cell nobody has looked at, in target search; the walls that are known.")
        .table(TABLE)
}

fn counters(map: &WallMap<SIDE>) -> Figure {
    let grid = map.grid();
    let visits = |cell| f64::from(map.visits(cell));
    let shade = Shade::of("visits", grid.cells().map(visits));
    Figure::new("counters", "Counter map", values(map, &shade, visits))
        .caption("How often each cell was visited in the first run of a counter search.")
        .table(TABLE)
}

fn dead_ends(map: &WallMap<SIDE>) -> Figure {
    let shade = Shade::new("dead end", 0.0, 1.0).series(Series(1));
    let drawing = values(map, &shade, |cell| {
        f64::from(u8::from(map.is_dead_end(cell)))
    });
    Figure::new("dead-ends", "Dead ends", drawing)
        .caption("The cells with three known walls at the end of that run.")
        .table(TABLE)
}

/// Returns the moment of our search at which open path and closed path differ most.
fn open_and_closed(maze: &Maze) -> Result<Option<Figure>, BoxError> {
    let Some((start, _)) = maze.start() else {
        return Ok(None);
    };
    let search = Certify::tuned(maze.grid(), start)?;
    let mut mouse = Driver::new(brief(maze)?, search, RunTwo::FewestMoves)?;
    let (mut steps, mut explores, mut found) = (0, true, None);
    MouseTrial::play(maze, &mut mouse, |step, mouse| {
        steps += 1;
        explores &= step.event != Ruling::RunTwo;
        let best = |unknown| run(mouse.map(), unknown, maze, start);
        if explores
            && found.is_none()
            && let (Ok(open), Ok(closed)) = (best(Unknown::Open), best(Unknown::Closed))
            && closed.len() > 1
            && open.len() < closed.len()
        {
            found = Some((steps, walls(mouse.map()), open, closed));
        }
    })?;
    Ok(found.map(|(steps, walls, open, closed)| {
        let mut plan = FloorPlan::of_walls(&walls, WIDTH);
        plan.trajectory(&open, Series(1));
        plan.trajectory(&closed, Series(0));
        let drawing = plan.drawing("The walls known so far with two runs from start to goal.");
        let caption = format!(
            "After {steps} steps of our search: the best run that is certain takes {} steps (first colour), the best \
             that can be hoped for {} (second colour). It is over when both take as many.",
            closed.len() - 1,
            open.len() - 1
        );
        let figure = Figure::new("open-and-closed", "Open path and closed path", drawing);
        figure.caption(caption).table(TABLE)
    }))
}

/// Returns the stops of the best run; `None` if there is no run.
fn run(
    map: &WallMap<SIDE>,
    unknown: Unknown,
    maze: &Maze,
    start: Cell,
) -> Result<Vec<Point>, TooLarge> {
    let passages = Passages::<SIDE>::new(map, unknown)?;
    let plan = RunTwo::FewestMoves.plan(&passages, start, maze.goals());
    let stops = plan.into_iter().flatten().map(|leap| middle(leap.end));
    Ok(core::iter::once(middle(start)).chain(stops).collect())
}

fn values(map: &WallMap<SIDE>, shade: &Shade, value: impl Fn(Cell) -> f64) -> Drawing {
    let mut plan = FloorPlan::of_walls(&walls(map), WIDTH);
    let cells: Vec<(Point, f64)> = map
        .grid()
        .cells()
        .map(|cell| (middle(cell), value(cell)))
        .collect();
    plan.cells(&cells, 1.0, shade);
    plan.drawing(format!(
        "The known walls of the maze, with {} in each cell.",
        shade.title
    ))
}

fn middle(cell: Cell) -> Point {
    Point::new(f64::from(cell.x) + 0.5, f64::from(cell.y) + 0.5)
}

/// Returns the walls that are known to stand, in cells.
fn walls(map: &WallMap<SIDE>) -> Vec<[Point; 2]> {
    let grid = map.grid();
    let sides = grid
        .cells()
        .flat_map(|cell| Direction::ALL.map(|side| (cell, side)));
    let once = |cell, side| {
        matches!(side, Direction::North | Direction::East) || grid.neighbour(cell, side).is_none()
    };
    sides
        .filter(|(cell, side)| once(*cell, *side) && map.knowledge(*cell, *side) == Knowledge::Wall)
        .map(|(cell, side)| {
            let (x, y) = (f64::from(cell.x), f64::from(cell.y));
            let (from, to) = match side {
                Direction::North => ((x, y + 1.0), (x + 1.0, y + 1.0)),
                Direction::East => ((x + 1.0, y), (x + 1.0, y + 1.0)),
                Direction::South => ((x, y), (x + 1.0, y)),
                Direction::West => ((x, y), (x, y + 1.0)),
            };
            [Point::new(from.0, from.1), Point::new(to.0, to.1)]
        })
        .collect()
}
