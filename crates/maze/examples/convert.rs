//! A maze file is checked, measured and written in another format.
#![expect(clippy::print_stdout, reason = "what it finds out is its result")]

use core::error::Error;

use tolman_maze::{Format, read, write};

const DRAWN: &str = "\
name = Hook
corridor_width = 0.5

+---+---+---+
|           |
+   +---+   +
| S |     G |
+---+---+---+
";

fn main() -> Result<(), Box<dyn Error>> {
    // A slip of the pen: the error names the line and what to do.
    let slip = DRAWN.replace("| S |     G |", "| S |     X |");
    if let Err(error) = read(&slip) {
        println!("refused: {error}");
    }

    let file = read(DRAWN)?;
    let maze = &file.maze;
    let (start, heading) = maze.start().ok_or("it has a start")?;
    let steps = maze.steps_to_goal()[maze.grid().index(start)];
    println!(
        "{}: {} cells, {} dead ends; from {start} facing {heading} {} steps to the goal",
        file.name.as_deref().unwrap_or("a maze"),
        maze.reachable().count(),
        maze.dead_ends().count(),
        steps.ok_or("a way leads to the goal")?,
    );
    assert_eq!(steps, Some(4));

    // As the collection mazefiles has them, which tells no width.
    println!("{}", write(&file, Format::Mazefiles)?);
    Ok(())
}
