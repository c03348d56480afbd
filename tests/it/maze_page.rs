//! The page that explains the maze file is true.

use tolman_maze::{Cell, Format, read};

const PAGE: &str = include_str!("../../docs/maze-format.md");

/// Returns the text of the page's first block marked `text`.
fn example() -> &'static str {
    let (_, block) = PAGE.split_once("```text\n").unwrap();
    block.split_once("```").unwrap().0
}

#[test]
fn the_example_is_read_as_it_is_explained() {
    assert_eq!(Format::detect(example()).unwrap(), Format::Tolman);
    let file = read(example()).unwrap();
    assert_eq!(file.name.as_deref(), Some("Loop with a room"));
    assert_eq!(file.corridor_width, Some(0.95));
    assert_eq!(file.maze.start().unwrap().0, Cell::new(0, 0));
    assert_eq!(file.maze.goals(), [Cell::new(4, 1)]);
    assert_eq!(
        (file.maze.grid().width(), file.maze.grid().height()),
        (5, 3)
    );
}

/// Every value in the table's example column is taken; the cells are those of the example.
#[test]
fn the_keys_of_the_table_are_the_keys_that_are_read() {
    let drawing = &example()[example().find('+').unwrap()..];
    let unmarked = drawing.replace(['S', 'G'], " ");
    let (_, section) = PAGE.split_once("## The lines above it").unwrap();
    let (table, _) = section.split_once("\n## ").unwrap();
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    let mut header = String::new();
    for row in rows {
        let cell = row.trim_end_matches('|').rsplit('|').next().unwrap();
        let line = cell.trim().trim_matches('`');
        header.push_str(&format!("{line}\n"));
    }
    for key in ["format", "name", "corridor_width", "start", "destination"] {
        assert!(
            header.contains(&format!("{key} = ")),
            "{key} is not in\n{header}"
        );
    }
    read(&format!("{header}\n{unmarked}")).unwrap();
}

/// What is drawn inside the walled-off area is not part of the maze.
#[test]
fn the_long_j_maze_is_one_corridor_and_the_rest_is_solid() {
    let maze = read(include_str!("../../mazes/j-long.maze")).unwrap().maze;
    let count = |degrees: &[usize]| {
        let of_degree = |cell: &Cell| degrees.contains(&maze.degree(*cell));
        maze.reachable().filter(of_degree).count()
    };
    assert_eq!((count(&[1]), count(&[2]), count(&[3, 4])), (2, 39, 0));
    assert_eq!(
        maze.reachable().count() + maze.sealed().count(),
        maze.grid().cell_count()
    );
}
