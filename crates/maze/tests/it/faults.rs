//! Bad files, and the place and repair that each error names.

use tolman_maze::{Format, read, read_as};

/// Checks the message of the error with which `text` is refused.
#[track_caller]
fn check(text: &str, expect: &str) {
    let error = read(text).map(|file| file.maze.to_string()).unwrap_err();
    assert_eq!(error.to_string(), expect, "\n{text}");
}

#[test]
fn texts_that_are_no_maze() {
    let empty = "line 1, column 1: the file is empty: expected a maze";
    for text in ["", " ", "\n\n", "\u{feff}", "\r\n", "\t"] {
        check(text, empty);
        for format in Format::ALL {
            assert_eq!(read_as(text, format).unwrap_err().to_string(), empty);
        }
    }
    check(
        "\n  <!DOCTYPE html>",
        "line 2, column 3: found `<!DOCTYPE html>`, with which no maze file begins: expected a drawing \
         of posts `o` or `+` and walls `---` and `|`, a `key = value` line before one, a grid of `#`, a drawing \
         of `_` and `|`, a size above rows of numbers, hexadecimal rows, or lines `X Y N E S W`; \
         docs/maze-format.md shows how to convert others",
    );
}

#[test]
fn drawings() {
    check(
        "o---o---o\n| S   G |\no---o   o\n",
        "line 3, column 7: the border of cell (1, 0) is open to the south: close it with a wall",
    );
    check(
        "o   o---o\n| S   G |\no---o---o\n",
        "line 1, column 3: the border of cell (0, 0) is open to the north: close it with a wall",
    );
    check(
        "o---o---o\n| S   G\no---o---o\n",
        "line 2, column 8: the line is too short, 7 characters: the first line of the drawing has posts \
         for 2 columns, so expected 9 (one every 4 characters, and the last): draw a rectangle, and wall off the rest",
    );
    check(
        "o---o---o\n  S   G |\no---o---o\n",
        "line 2, column 1: the border of cell (0, 0) is open to the west: close it with a wall",
    );
    check(
        "  o---o---o\n  | S | G |\n  o---o---o\n",
        "line 2, column 9: no way leads from the start (0, 0) to the goal (1, 0): open a wall \
         between them",
    );
    check(
        "o---o---o\n| S   G |\n",
        "line 2, column 1: the drawing stops in the middle of a row, with its line 2: n rows of cells \
         take 2n + 1 lines, the last of them the south border",
    );
    check(
        "o---o---o\n",
        "line 1, column 1: the drawing stops in the middle of a row, with its line 1: n rows of cells \
         take 2n + 1 lines, the last of them the south border",
    );
    check(
        "o---o---o\n| S   G |\n\no---o---o\n",
        "line 2, column 1: the drawing stops in the middle of a row, with its line 2: n rows of cells \
         take 2n + 1 lines, the last of them the south border",
    );
    check(
        "o---o---o\n|\tS   G |\no---o---o\n",
        "line 2, column 2: found a tab: draw with blanks",
    );
    check(
        "o---o---o\n| S x G |\no---o---o\n",
        "line 2, column 5: found 'x': expected `|`, a blank or `.` between two cells",
    );
    check(
        "o---o---o\n| S | ö |\no---o---o\n",
        "line 2, column 7: found 'ö': expected a blank, `S`, `G` or the number of one landmark, 1 to 8, in a cell",
    );
    check(
        "o---o---o\n| S   G |\no-- o---o\n",
        "line 3, column 4: found ' ': expected `---`, three blanks or ` . ` between two posts, \
         all as far apart as the first two, as in `+---+---+`",
    );
    check(
        "o---o---o\n| S   S |\no---o---o\n",
        "line 2, column 7: the start is marked twice, in (0, 0) and in (1, 0): keep one `S`",
    );
    check(
        "o---o---o\n| S   G |\no---*---o\n",
        "line 3, column 5: found '*': expected a post, `o` or `+`, at every corner of a cell",
    );
    check(
        "o---o---o\n| S   G |\n|---o---o\n",
        "line 3, column 1: found '|': expected a post, `o` or `+`, at every corner of a cell",
    );
    check(
        "o---o---o\n! S   G !\no---o---o\n",
        "line 2, column 1: found '!': expected a post, `|` or a blank at the west border",
    );
    let remark = "o---o---o\n| S   G |   north | pit -- a note\no---o---o\n";
    assert!(read(remark).is_ok());
    check(
        "o---o---o\n| S   G |   |\no---o---o\n",
        "line 2, column 10: the drawing goes on beyond the east border: its first line has posts for 2 \
         columns (one every 4 characters); draw a rectangle, and wall off the rest",
    );
    check(
        "o---o---o\n| S   G |\no---o---o---o\n",
        "line 3, column 10: the drawing goes on beyond the east border: its first line has posts for 2 \
         columns (one every 4 characters); draw a rectangle, and wall off the rest",
    );
    check(
        "o---o---o---o\n| S   G |\no---o---o---o\n",
        "line 2, column 10: the line is too short, 9 characters: the first line of the drawing has posts \
         for 3 columns, so expected 13 (one every 4 characters, and the last): draw a rectangle, and wall off the rest",
    );
    check(
        "o---o---o\n| S   G  \no---o---o\n",
        "line 2, column 9: the border of cell (1, 0) is open to the east: close it with a wall",
    );
    check(
        "+===+===+\n| S   G |\n+===+===+\n",
        "line 1, column 2: found '=': expected `---`, three blanks or ` . ` between two posts, all \
         as far apart as the first two, as in `+---+---+`",
    );
    check(
        "# No goal\n\n  +---+\n  | S |\n  +---+\n",
        "line 3, column 3: the maze has no goal: mark at least one cell as the destination",
    );
    check(
        &format!("{}o\n", "o---".repeat(1025)),
        "line 1, column 1: a side of 1025 cells is too long: mazes of up to 1024 are read",
    );
    check(
        &format!("{}o---o\n", "o---o\n|   |\n".repeat(1025)),
        "line 1, column 1: a side of 1025 cells is too long: mazes of up to 1024 are read",
    );
}

#[test]
fn numbers() {
    let size = "the size of the maze, an even number of cells";
    check(
        "3\n",
        &format!("line 1, column 1: found `3`: expected {size}"),
    );
    check(
        "\n 0\n",
        &format!("line 2, column 2: found `0`: expected {size}"),
    );
    check(
        "1,5\n",
        &format!("line 1, column 1: found `1,5`: expected {size}"),
    );
    check(
        "99999999999999999999\n",
        &format!("line 1, column 1: found `99999999999999999999`: expected {size}"),
    );
    check(
        "4000000000\n",
        "line 1, column 1: a side of 4000000000 cells is too long: mazes of up to 1024 are read",
    );
    check(
        "2\n3,6\n9\n",
        "line 3, column 1: found 1 numbers, expected 2: write one number for each row of the maze, \
         from the south, with commas between them",
    );
    check(
        "2\n3,6,\n9,12\n",
        "line 2, column 1: found 3 numbers, expected 2: write one number for each row of the maze, \
         from the south, with commas between them",
    );
    check(
        "2\n3,6\n",
        "line 3, column 1: found 1 columns, expected 2: write one line for each column of the maze, \
         from the west",
    );
    check(
        "2\n3,6\n9,12\n9,12\n",
        "line 4, column 1: found 3 columns, expected 2: drop this line, or correct the size on line 1",
    );
    let bits = "expected a sum of open sides, 0 … 15: 1 north, 2 east, 4 south, 8 west";
    check(
        "2\n3, 16\n9,12\n",
        &format!("line 2, column 4: found `16`: {bits}"),
    );
    check(
        "2\n3,6\n-9,12\n",
        &format!("line 3, column 1: found `-9`: {bits}"),
    );
    check(
        "2\n3,\n9,12\n",
        &format!("line 2, column 3: found ``: {bits}"),
    );
    check(
        "2\n3,6\n9,1.5\n",
        &format!("line 3, column 3: found `1.5`: {bits}"),
    );
    check(
        "2\n3,7\n9,12\n",
        "line 2, column 3: the border of cell (0, 1) is open to the north: close it with a wall",
    );
    check(
        "2\n3,6\n8,12\n",
        "line 3, column 1: cell (1, 0) is walled to the north, but (1, 1) beyond is open to the \
         south: make the two agree",
    );
    check(
        "2\n3,6\n9,4\n",
        "line 2, column 3: cell (0, 1) is open to the east, but (1, 1) beyond is walled to the west: \
         make the two agree",
    );
    check(
        "4\n1,5,5,4\n0,0,0,0\n0,0,0,0\n0,0,0,0\n",
        "line 3, column 3: no way leads from the start (0, 0) to the goal (1, 1): open a wall \
         between them",
    );
}

#[test]
fn num() {
    let count = "a line has the column, the row, and 1 or 0 for the walls in the north, east, south and west";
    check(
        "0 0 1 1 1\n",
        &format!("line 1, column 1: found 5 numbers, expected 6: {count}"),
    );
    check(
        "0 0 1 1 1 1 1\n",
        &format!("line 1, column 1: found 7 numbers, expected 6: {count}"),
    );
    let wall = "expected 1 for a wall or 0 for none";
    check(
        "0 0 1 1 2 1\n",
        &format!("line 1, column 9: found `2`: {wall}"),
    );
    check(
        "0 0 1 1 1 1\n0 1 1 1 1 yes\n",
        &format!("line 2, column 11: found `yes`: {wall}"),
    );
    check(
        "0 0 1 1 1 1\n0 -1 1 1 1 1\n",
        "line 2, column 3: found `-1`: expected a column or row counted from 0",
    );
    check(
        "0 0 1 1 1 1\n1024 0 1 1 1 1\n",
        "line 2, column 1: a side of 1025 cells is too long: mazes of up to 1024 are read",
    );
    check(
        "0 0 1 0 1 1\n1 0 1 1 1 0\n0 0 1 0 1 1\n",
        "line 3, column 1: cell (0, 0) was already given on line 1: keep one of the two lines",
    );
    check(
        "0 0 1 0 1 1\n1 1 1 1 1 0\n",
        "line 2, column 1: cell (1, 0) of the 2 × 2 maze is missing: add a line for it",
    );
    check(
        "1023 1023 1 1 1 1\n",
        "line 1, column 1: cell (0, 0) of the 1024 × 1024 maze is missing: add a line for it",
    );
    check(
        "0 0 1 0 1 1\n1 0 1 1 1 1\n",
        "line 1, column 1: cell (0, 0) is open to the east, but (1, 0) beyond is walled to the west: \
         make the two agree",
    );
    check(
        "0 0 1 0 0 1\n1 0 1 1 1 0\n",
        "line 1, column 1: the border of cell (0, 0) is open to the south: close it with a wall",
    );
    check(
        "0 0 1 1 1 1\n1 0 1 1 1 1\n2 0 1 1 1 1\n",
        "line 2, column 1: no way leads from the start (0, 0) to the goal (1, 0): open a wall \
         between them",
    );
}

#[test]
fn headers() {
    let with = |header: &str, expect: &str| {
        check(
            &format!("{header}\n\n+---+---+\n| S   G |\n+---+---+\n"),
            expect,
        );
    };
    with(
        "corridor-width = 1",
        "line 1, column 1: `corridor-width` is not a key of a maze file: use format, name, \
         corridor_width, start, destination",
    );
    with(
        "name = J\n\nthe J maze",
        "line 3, column 1: found `the J maze`: expected `key = value`, a comment after `#`, or the \
         drawing",
    );
    with(
        "name = J\n# again\n name = K",
        "line 3, column 2: `name` was already given on line 1: keep one of the two lines",
    );
    with(
        "name =",
        "line 1, column 7: found `` for `name`: expected a line of text",
    );
    with(
        "name = a\tb",
        "line 1, column 8: found `a\\tb` for `name`: expected a line of text",
    );
    with(
        "format = tolman maze 2",
        "line 1, column 10: found `tolman maze 2` for `format`: expected `tolman maze 1`, the only \
         version so far",
    );
    for width in [
        "0", "-0.5", "NaN", "inf", "1e999", "1e300", "1000.1", "0.0009", "1e-320", "0,5", "0.5 m",
        "",
    ] {
        with(
            &format!("corridor_width = {width}")
                .trim_end()
                .replace("width =0", "width = 0"),
            &format!(
                "line 1, column {}: found `{width}` for `corridor_width`: expected metres from \
                 0.001 to 1000, a plain number as in `0.5`",
                if width.is_empty() { 17 } else { 18 }
            ),
        );
    }
    with(
        "corridor_width = # 0.5",
        "line 1, column 18: found `` for `corridor_width`: expected metres from 0.001 to 1000, a plain \
         number as in `0.5`",
    );
    let start = "expected a column and a row, counted from 0 in the south-west corner, and the \
                 direction to look if it is not north, as in `0 0 east`";
    for value in [
        "0",
        "0 0 0",
        "0 0 up",
        "0 0 1 0 north",
        "-1 0",
        "north",
        "0 99999",
    ] {
        with(
            &format!("start = {value}"),
            &format!("line 1, column 9: found `{value}` for `start`: {start}"),
        );
    }
    with(
        "start = 2 0",
        "line 1, column 9: the start (2, 0) lies outside the maze: columns run from 0 to 1, rows from \
         0 to 0",
    );
    with(
        "start = 1 0",
        "line 1, column 9: `start` is (1, 0), but the drawing has its `S` in (0, 0): drop one of the \
         two",
    );
    with(
        "destination = 0 0, 1 0",
        "line 1, column 15: `destination` is (0, 0), (1, 0), but the drawing has its `G` in (1, 0): \
         drop one of the two",
    );
    with(
        "destination = 1",
        "line 1, column 15: found `1` for `destination`: expected a column and a row for each cell, \
         counted from 0 in the south-west corner, as in `7 7` or `7 7, 8 7`",
    );
    with(
        "destination = 1 1",
        "line 1, column 15: the goal (1, 1) lies outside the maze: columns run from 0 to 1, rows from \
         0 to 0",
    );
    check(
        "name = J\n",
        "line 2, column 1: the drawing is missing: draw the maze below the header, with posts and \
         walls as in `+---+` and `|`; lines that start with `#` are comments: redraw a maze of blocks so that its walls are lines between cells",
    );
    check(
        "name = J\n+---+\n| G |\n+---+\nstart = 0 0\n",
        "line 5, column 1: found `start = 0 0` below the drawing: put it above, or after a `#`",
    );
    check(
        "name = J\n+---+---+\n| G |   |\n+---+---+\n",
        "line 3, column 3: the goal (0, 0) is walled in on all four sides: open one of its walls",
    );
    check(
        "name = J\n\n\t+---+\n",
        "line 3, column 1: found a tab: draw with blanks",
    );
}

#[test]
fn long_lines_are_cut_in_messages() {
    let error = read(&format!("name = J\n{}", "x".repeat(100_000)))
        .unwrap_err()
        .to_string();
    assert!(error.len() < 200, "{error}");
}
