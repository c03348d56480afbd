//! Rays per second of every caster, in mazes and among free walls of 36 to 40,000 unit walls.
//!
//! One iteration is one scan: 72 beams of 2.5 units from a random pose, aimed and cast. The table
//! at the end gives the median in million rays a second and the ratio to parry2d's polyline in this
//! run.

#![expect(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a bench that cannot set itself up has failed, and its table is its result"
)]

mod measure;

use criterion::Criterion;
use measure::Table;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_geom::{Heading, Point, Pose, Vector};
use tolman_maze::{Braided, Direction, Maze};
use tolman_robot::Ring;
use tolman_sim::casters::{BeamSweep, Caster, Lanes, LatticeWalk, ParryPolyline, WallIndex};
use tolman_sim::{CorridorSize, WallSegment, World};

/// Sides of square mazes; a perfect one of side n has (n + 1)² unit walls.
const SIDES: [u16; 4] = [5, 19, 62, 199];

const BEAMS: u32 = 72;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut table = Table::new("Mray/s", "parry2d polyline");
    for side in SIDES {
        let column = format!("{}", (side + 1) * (side + 1));
        let mut rng = ChaCha8Rng::seed_from_u64(u64::from(side));
        let maze = Braided {
            width: side,
            height: side,
            share: 0.0,
        }
        .generate(&mut rng)
        .unwrap();
        let poses = poses(&maze, &mut rng);

        let world = World::from_maze(&maze, &CorridorSize::thin(1.0)).unwrap();
        let casters: [(&str, Box<dyn Caster>); 5] = [
            (
                "parry2d polyline",
                Box::new(ParryPolyline::new(world.walls())),
            ),
            (
                "lattice walk",
                Box::new(LatticeWalk::new(&world, Lanes::Baseline).unwrap()),
            ),
            (
                "lattice walk, AVX2",
                Box::new(LatticeWalk::new(&world, Lanes::Widest).unwrap()),
            ),
            (
                "wall index",
                Box::new(WallIndex::new(world.walls(), Lanes::Baseline)),
            ),
            (
                "wall index, AVX2",
                Box::new(WallIndex::new(world.walls(), Lanes::Widest)),
            ),
        ];
        for (name, caster) in casters {
            scan(
                &mut criterion,
                &mut table,
                "grid maze",
                &column,
                name,
                &*caster,
                &poses,
            );
        }

        let walls = bent(&maze, &mut rng);
        let casters: [(&str, Box<dyn Caster>); 3] = [
            ("parry2d polyline", Box::new(ParryPolyline::new(&walls))),
            (
                "wall index",
                Box::new(WallIndex::new(&walls, Lanes::Baseline)),
            ),
            (
                "wall index, AVX2",
                Box::new(WallIndex::new(&walls, Lanes::Widest)),
            ),
        ];
        for (name, caster) in casters {
            scan(
                &mut criterion,
                &mut table,
                "free walls",
                &column,
                name,
                &*caster,
                &poses,
            );
        }
    }
    criterion.final_summary();
    println!("{table}");
}

fn scan(
    criterion: &mut Criterion,
    table: &mut Table,
    group: &str,
    column: &str,
    name: &str,
    caster: &dyn Caster,
    poses: &[Pose],
) {
    let mut sweep = BeamSweep::new(Ring::full(BEAMS, 2.5));
    let mut next = poses.iter().cycle().copied();
    let mut one_scan = || {
        sweep.aim(next.next().unwrap_or_default());
        caster.scan(&mut sweep);
        sweep.range(0)
    };
    let label = format!("{group}, {column} walls, {name}");
    let per_second = measure::per_second(criterion, &label, &mut one_scan);
    table.enter(
        group,
        name,
        column,
        per_second.map(|scans| scans * f64::from(BEAMS) / 1e6),
    );
}

/// Returns poses of a robot that keeps off the walls.
fn poses(maze: &Maze, rng: &mut ChaCha8Rng) -> Vec<Pose> {
    let mut along = |count: u16| {
        f64::from(rng.random_range(0..u32::from(count))) + 0.3 + 0.4 * rng.random::<f64>()
    };
    let positions: Vec<Point> = (0..1024)
        .map(|_| Point::new(along(maze.grid().width()), along(maze.grid().height())))
        .collect();
    let heading = |_| Heading::from_radians(rng.random_range(-3.0..3.0));
    let headings: Vec<Heading> = (0..1024).map(heading).collect();
    positions
        .into_iter()
        .zip(headings)
        .map(|(point, heading)| Pose::new(point, heading))
        .collect()
}

/// Returns the unit walls of a maze between posts that were moved out of line, so that no two are
/// parallel.
fn bent(maze: &Maze, rng: &mut ChaCha8Rng) -> Vec<WallSegment> {
    let grid = maze.grid();
    let columns = usize::from(grid.width()) + 1;
    let posts: Vec<Point> = (0..columns * (usize::from(grid.height()) + 1))
        .map(|post| {
            let aside = Vector::new(rng.random_range(-0.15..0.15), rng.random_range(-0.15..0.15));
            Point::new((post % columns) as f64, (post / columns) as f64) + aside
        })
        .collect();
    let post = |x: u16, y: u16| posts[usize::from(y) * columns + usize::from(x)];
    let mut walls = Vec::new();
    for cell in grid.cells() {
        let (x, y) = (cell.x, cell.y);
        let sides = [
            (Direction::West, post(x, y), post(x, y + 1), true),
            (Direction::South, post(x, y), post(x + 1, y), true),
            (
                Direction::East,
                post(x + 1, y),
                post(x + 1, y + 1),
                x + 1 == grid.width(),
            ),
            (
                Direction::North,
                post(x, y + 1),
                post(x + 1, y + 1),
                y + 1 == grid.height(),
            ),
        ];
        for (direction, start, end, counts) in sides {
            if counts && !maze.is_open(cell, direction) {
                walls.push(WallSegment::between(start, end));
            }
        }
    }
    walls
}
