//! A mouse explores a maze that it does not know, until its way to the goal is proven the shortest.
#![expect(clippy::print_stdout, reason = "what the mouse finds is its result")]

use core::error::Error;

use tolman_systems::maze::{Cell, Direction, Maze, read};
use tolman_systems::micromouse::{Brief, Movement, Rotation, Searcher, Sight};

const MAZE: &str = "\
o---o---o---o
|           |
o   o---o   o
|   |     G |
o   o---o   o
| S |       |
o---o---o---o
";

/// Returns the open cells up to the next wall.
fn open_cells(maze: &Maze, from: Cell, direction: Direction) -> u16 {
    let ahead = core::iter::successors(Some(from), |&cell| maze.beside(cell, direction));
    ahead.count() as u16 - 1
}

fn main() -> Result<(), Box<dyn Error>> {
    let maze = read(MAZE)?.maze;
    let (start, facing) = maze.start().ok_or("it has a start")?;
    let brief = Brief {
        grid: maze.grid(),
        start,
        heading: facing,
        goals: maze.goals().into(),
    };
    let mut mouse = Searcher::Certify.mouse(&brief, 0)?;
    let (mut at, mut heading, mut orders) = (start, facing, 0);
    loop {
        let sides = [heading.left(), heading, heading.right()];
        let [left, front, right] = sides.map(|side| open_cells(&maze, at, side));
        let order = mouse.next(Sight { left, front, right })?;
        let (Rotation::Degrees(turn), Movement::Cells(cells)) = (order.rotation, order.movement)
        else {
            break; // It wants to be put back to the start: it has explored enough.
        };
        heading = sides[(turn / 90 + 1) as usize];
        for _ in 0..cells {
            at = maze.beside(at, heading).ok_or("it drives into a wall")?;
        }
        orders += 1;
    }
    let proof = mouse.certificate().ok_or("it is proven")?;
    println!(
        "after {orders} moves: {} of them lead to the goal, and fewer cannot",
        proof.closed_cost
    );
    assert_eq!(proof.closed_cost, proof.open_cost);
    Ok(())
}
