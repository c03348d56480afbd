//! The main loop of a micromouse, with sensors and motors simulated on a drawing.

use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};
use tolman_firmware::{Command, Mouse, Sides};
use tolman_maze::{Braided, Cell, Direction, Maze};
use tolman_planners::speed_run::{RunStep, SpeedRunConfig, SpeedRunTimes};

/// A simulated mouse: its maze, its cell and its direction.
struct Body<'a> {
    maze: &'a Maze,
    cell: Cell,
    heading: Direction,
}

impl Body<'_> {
    fn look(&self) -> Sides {
        Sides::read(|side| self.maze.is_open(self.cell, self.heading.turned(side)))
    }

    fn drive(&mut self, side: Direction) {
        self.heading = self.heading.turned(side);
        let next = self.maze.grid().neighbour(self.cell, self.heading);
        self.cell = next.unwrap_or(self.cell);
    }
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let braided = Braided {
        width: 16,
        height: 16,
        share: 0.5,
    };
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut maze = braided.generate(&mut rng)?;
    maze.set_goals(maze.grid().middle().collect());
    let times = SpeedRunTimes::new(&SpeedRunConfig::classic())?;
    let mut mouse = Mouse::new(&times, maze.goals());
    let (cell, heading) = (Cell::new(0, 0), Direction::North);
    let mut body = Body {
        maze: &maze,
        cell,
        heading,
    };
    let run_ms = loop {
        match mouse.arrive(body.look())? {
            Command::Drive(side) => body.drive(side),
            Command::Ready { run_ms } => break run_ms,
            Command::CarryBack | Command::GiveUp => return Err("the mouse is lost".into()),
        }
    };
    let mut moves = 0;
    mouse.run(|_: RunStep| moves += 1)?;
    assert!(body.cell == cell && run_ms > 0 && moves > 0);
    Ok(())
}
