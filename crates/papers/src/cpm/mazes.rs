//! Mazes of the experiment.

use std::path::PathBuf;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tolman_maze::{Cell, Direction, Maze, Perfect};

use super::trials::BETTER;
use crate::maze_file;
use tolman_arena::course::Course;
use tolman_arena::cpm::{BendLikeness, CORRIDOR_WIDTH, epuck_course};
use tolman_experiment::BoxError;

/// Number of cells along each side of an aliased maze.
const ALIASED_SIDE: u16 = 5;

/// Returns the paper's three mazes, redrawn.
pub(super) fn papers() -> Result<Vec<Course>, BoxError> {
    [
        include_str!("../../mazes/cpm-1.maze"),
        include_str!("../../mazes/cpm-2.maze"),
        include_str!("../../mazes/cpm-3.maze"),
    ]
    .into_iter()
    .map(read)
    .collect()
}

/// Returns the maze of figure 11, redrawn.
pub(super) fn real() -> Result<Course, BoxError> {
    read(include_str!("../../mazes/cpm-real.maze"))
}

/// Returns the maze in which the common patterns are learned.
pub(super) fn learning() -> Result<Course, BoxError> {
    read(include_str!("../../mazes/cpm-learning.maze"))
}

fn read(text: &str) -> Result<Course, BoxError> {
    Ok(epuck_course("", tolman_maze::read(text)?)?)
}

/// Returns the mazes of some files. A name that is already used, here or by another row, gets a
/// number.
pub(super) fn from_files(files: &[PathBuf]) -> Result<Vec<Course>, BoxError> {
    let mut courses: Vec<Course> = Vec::new();
    for path in files {
        let mut course = epuck_course(&maze_file::stem(path), maze_file::read(path)?)
            .map_err(|error| maze_file::in_file(path, error))?;
        let rows = |name: &str| [name.to_owned(), format!("{name}{BETTER}")];
        course.name = maze_file::told_apart(&course.name, |name| {
            let mut taken = courses.iter().flat_map(|before| rows(&before.name));
            taken.any(|row| rows(name).contains(&row))
        });
        courses.push(course);
    }
    Ok(courses)
}

/// Returns a random maze with short and similar fragments, without rooms.
///
/// Every other dead end is opened. The start is in the south-west, the goal in the dead end
/// farthest from it. Mazes are drawn until one has two fragments that bend alike.
pub(super) fn aliased(seed: u64) -> Result<Course, BoxError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    loop {
        let maze = braided(&mut rng)?;
        if BendLikeness::of(&maze).alike_pairs > 0 {
            return Ok(Course::new("Aliased", maze, CORRIDOR_WIDTH)?);
        }
    }
}

fn braided(rng: &mut impl Rng) -> Result<Maze, BoxError> {
    let side = ALIASED_SIDE;
    let mut maze = Perfect {
        width: side,
        height: side,
    }
    .generate(rng)?;
    let start = Cell::new(0, 0);
    let dead_ends: Vec<Cell> = maze.dead_ends().filter(|cell| *cell != start).collect();
    for cell in dead_ends.into_iter().step_by(2) {
        let first = rng.random_range(0..4_u32) as usize;
        let shut = (0..4)
            .map(|turn| Direction::ALL[(first + turn) % 4])
            .find(|direction| {
                let inside = maze.grid().neighbour(cell, *direction).is_some();
                inside && !maze.is_open(cell, *direction) && {
                    let mut opened = maze.clone();
                    opened.set_wall(cell, *direction, false);
                    !opened.grid().cells().any(|cell| opened.is_room(cell))
                }
            });
        if let Some(direction) = shut {
            maze.set_wall(cell, direction, false);
        }
    }
    let ahead = if maze.is_open(start, Direction::North) {
        Direction::North
    } else {
        Direction::East
    };
    let steps = maze.steps_to(&[start]);
    let grid = maze.grid();
    let farthest = maze
        .grid()
        .cells()
        .filter(|cell| maze.degree(*cell) == 1 && *cell != start)
        .max_by_key(|cell| steps[grid.index(*cell)]);
    let goal = farthest.unwrap_or(Cell::new(ALIASED_SIDE - 1, ALIASED_SIDE - 1));
    maze.set_start(Some((start, ahead)));
    maze.set_goals(vec![goal]);
    Ok(maze)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn no_two_mazes_have_a_row_of_one_name() {
        let folder =
            std::env::temp_dir().join(format!("tolman-cpm-courses-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let maze = "start = 0 0 east\n\no---o---o\n| S   G |\no---o---o\n";
        let names = ["Loop", "Loop", "Loop better"];
        let files: Vec<PathBuf> = (0..)
            .zip(names)
            .map(|(number, name)| {
                let path = folder.join(format!("{number}.maze"));
                fs::write(&path, format!("name = {name}\n{maze}")).unwrap();
                path
            })
            .collect();
        let courses = from_files(&files).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        let found: Vec<&str> = courses.iter().map(|course| course.name.as_str()).collect();
        assert_eq!(found, ["Loop", "Loop (2)", "Loop better (2)"]);
    }
}
