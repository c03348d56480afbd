//! Draws the chip's memory for the linker, and packs the mazes in which the emulated mouse runs.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

use tolman_maze::{Cell, Direction, Maze};

/// Memory of the emulated chip. The program tells how much of it the mouse needs.
const MEMORY: &str = "MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 1M
  RAM : ORIGIN = 0x20000000, LENGTH = 64K
}
";

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::write(out.join("memory.x"), MEMORY)?;
    println!("cargo::rustc-link-search={}", out.display());
    fs::write(
        out.join("mazes.rs"),
        packed(Path::new("../../../mazes/grid"))?,
    )?;
    Ok(())
}

/// Returns the classic mazes of a folder as an array: of each maze the goals, and of each cell, by
/// y and then x, bits of its open sides.
fn packed(folder: &Path) -> Result<String, Box<dyn Error>> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()?;
    files.sort();
    let mut mazes = Vec::new();
    for file in files {
        let maze = tolman_maze::parse(&fs::read_to_string(&file)?)?.maze;
        if (maze.grid().width(), maze.grid().height()) == (16, 16) {
            let name = file.file_stem().unwrap_or_default().display();
            mazes.push(format!(
                "({:?}, {}, {})",
                name.to_string(),
                goals(&maze),
                open(&maze)
            ));
        }
    }
    Ok(format!("&[{}]", mazes.join(",\n")))
}

fn goals(maze: &Maze) -> String {
    let cells = maze.goals().iter();
    let cells: Vec<String> = cells
        .map(|cell| format!("Cell::new({}, {})", cell.x, cell.y))
        .collect();
    format!("&[{}]", cells.join(", "))
}

fn open(maze: &Maze) -> String {
    let bits = |cell: Cell| -> u8 {
        let open = Direction::ALL
            .into_iter()
            .filter(|side| maze.is_open(cell, *side));
        open.map(|side| 1 << side.index()).sum()
    };
    format!("{:?}", maze.grid().cells().map(bits).collect::<Vec<u8>>())
}
