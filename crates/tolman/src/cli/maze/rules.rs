//! The rules of micromouse contests, and the mazes that break them.

use tolman_maze::{Cell, Direction, Maze};

use crate::cli::words::counted;

/// Returns what in a maze is against the rules of the contests, in words.
pub(super) fn broken(maze: &Maze) -> Vec<String> {
    let mut broken = Vec::new();
    if let Some((start, _)) = maze.start()
        && maze.degree(start) != 1
    {
        let walls = 4 - maze.degree(start);
        broken.push(format!(
            "the start {start} has {walls} walls instead of three"
        ));
    }
    let middle: Vec<Cell> = maze.grid().middle().collect();
    if maze.goals() != middle {
        broken.push("the goal is not the middle of the maze".to_owned());
    }
    let inner = middle.iter().flat_map(|cell| {
        let sides = [Direction::North, Direction::East].into_iter();
        sides.filter_map(|side| Some((*cell, side, maze.grid().neighbour(*cell, side)?)))
    });
    for (cell, side, beyond) in inner.filter(|(.., beyond)| middle.contains(beyond)) {
        if !maze.is_open(cell, side) {
            broken.push(format!(
                "a wall stands within the goal, between {cell} and {beyond}"
            ));
        }
    }
    let mut bare = maze.grid().cells().filter(|cell| {
        let is_goal = |cell: Cell| middle.contains(&cell);
        let around =
            [Direction::North, Direction::East].map(|side| maze.grid().neighbour(*cell, side));
        maze.is_room(*cell) && !(is_goal(*cell) && around.into_iter().flatten().all(is_goal))
    });
    if let Some(first) = bare.next() {
        let others = match bare.count() {
            0 => String::new(),
            n => format!(", nor at {}", counted(n, "other post")),
        };
        broken.push(format!(
            "no wall ends at the post north-east of {first}{others}"
        ));
    }
    broken
}

/// Returns whether two mazes have the same walls, turned or mirrored.
pub(super) fn are_alike(one: &Maze, other: &Maze) -> bool {
    let mut turned = other.clone();
    for quarter in 0..8 {
        let walls = |maze: &Maze| {
            let mut bare = maze.clone();
            bare.set_start(None);
            bare.set_goals(Vec::new());
            bare
        };
        if walls(one) == walls(&turned) {
            return true;
        }
        turned = if quarter == 3 {
            other.mirrored()
        } else {
            turned.rotated()
        };
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAZE: &str = "\
o---o---o---o---o
|               |
o   o---o---o   o
|   | G   G |   |
o   o   o   o   o
|   | G   G     |
o   o---o---o---o
| S |           |
o---o---o---o---o
";

    #[test]
    fn each_rule_is_told() {
        let maze = tolman_maze::read(MAZE).unwrap().maze;
        assert_eq!(broken(&maze), Vec::<String>::new());
        let told = |change: fn(&mut Maze)| {
            let mut maze = tolman_maze::read(MAZE).unwrap().maze;
            change(&mut maze);
            broken(&maze).join("; ")
        };
        let (start, goal) = (Cell::new(0, 0), Cell::new(1, 1));
        assert!(
            told(|maze| maze.set_wall(Cell::new(0, 0), Direction::East, false)).contains("2 walls")
        );
        assert!(told(|maze| maze.set_goals(vec![Cell::new(3, 3)])).contains("not the middle"));
        assert!(
            told(|maze| maze.set_wall(Cell::new(1, 1), Direction::East, true))
                .contains("within the goal")
        );
        let bare = told(|maze| {
            maze.set_wall(Cell::new(0, 0), Direction::East, false);
            maze.set_wall(Cell::new(1, 0), Direction::North, false);
        });
        assert!(
            !bare.contains("post north-east of (0, 0)"),
            "a wall to the north is left: {bare}"
        );
        let mut other = maze.rotated().mirrored();
        assert!(are_alike(&maze, &other));
        other.set_wall(
            start,
            Direction::North,
            other.is_open(start, Direction::North),
        );
        assert!(!are_alike(&maze, &other), "{goal}");
    }
}
