//! Draws a maze with the stops of both runs.

use tolman_arena::micromouse::{MouseTrial, Ruling};
use tolman_maze::{Cell, Maze};

/// Returns the drawing of the maze, with a dot on every stop of the first run and a star on those
/// of the second. The marks of start and goal stay.
pub(super) fn of(maze: &Maze, trial: &MouseTrial) -> String {
    let mut lines: Vec<Vec<char>> = maze
        .to_string()
        .lines()
        .map(|line| line.chars().collect())
        .collect();
    let mut mark = '.';
    for step in &trial.steps {
        if step.event == Ruling::RunTwo {
            mark = '*';
        }
        put(&mut lines, maze, step.cell, mark);
    }
    let lines: Vec<String> = lines.into_iter().map(String::from_iter).collect();
    lines.join("\n")
}

fn put(lines: &mut [Vec<char>], maze: &Maze, cell: Cell, mark: char) {
    let row = 2 * usize::from(maze.grid().height().saturating_sub(cell.y)) - 1;
    let column = 4 * usize::from(cell.x) + 2;
    let place = lines.get_mut(row).and_then(|line| line.get_mut(column));
    if let Some(place @ (' ' | '.')) = place {
        *place = mark;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tolman_arena::micromouse::try_on;
    use tolman_systems::micromouse::Searcher;

    #[test]
    fn stops_are_marked() {
        let text = "\
o---o---o---o
|         G |
o   o---o   o
|   |       |
o   o   o---o
| S |       |
o---o---o---o
";
        let maze = tolman_maze::read(text).unwrap().maze;
        let (trial, judgement) = try_on(&maze, Searcher::Certify, 0, |_| {}).unwrap();
        assert_eq!(judgement.run_2, Some(2));
        let expect = "\
o---o---o---o
| *       G |
o   o---o   o
|   |       |
o   o   o---o
| S |       |
o---o---o---o";
        assert_eq!(of(&maze, &trial), expect);
    }
}
