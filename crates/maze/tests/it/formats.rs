//! Tests the meaning of each format's texts, and the mazes that a format cannot hold.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tolman_maze::{
    Braided, Cell, Direction, Format, Grid, Knowledge, Maze, MazeFile, Walls, WriteError, parse,
    parse_as, read, write,
};

/// A 4 × 4 maze, the same in all four formats.
const DRAWN: &str = "\
o---o---o---o---o
|               |
o   o---o---o   o
|   | G   G |   |
o   o   o   o   o
|   | G   G     |
o   o   o   o---o
| S |           |
o---o---o---o---o
";
const NUMBERS: &str = "4\n1,5,5,6\n3,7,6,10\n11,15,12,10\n8,9,5,12\n";

fn drawn() -> Maze {
    parse_as(DRAWN, Format::Mazefiles).unwrap().maze
}

#[test]
fn a_drawing_is_read_as_it_looks() {
    let maze = drawn();
    assert_eq!(maze.grid(), Grid::new(4, 4));
    assert_eq!(maze.start(), Some((Cell::new(0, 0), Direction::North)));
    let goals = [
        Cell::new(1, 1),
        Cell::new(1, 2),
        Cell::new(2, 1),
        Cell::new(2, 2),
    ];
    assert_eq!(maze.goals(), goals);
    let open = |cell: Cell| Direction::ALL.map(|direction| u8::from(maze.is_open(cell, direction)));
    assert_eq!(
        open(Cell::new(0, 0)),
        [1, 0, 0, 0],
        "north, east, south, west of the start"
    );
    assert_eq!(open(Cell::new(0, 3)), [0, 1, 1, 0]);
    assert_eq!(open(Cell::new(2, 1)), [1, 1, 1, 1]);
    assert_eq!(open(Cell::new(3, 0)), [0, 0, 0, 1]);
    assert_eq!(maze.to_string(), DRAWN);
}

#[test]
fn all_formats_tell_the_same_maze() {
    let file = MazeFile::from(drawn());
    for format in Format::ALL {
        // A binary format of other sizes.
        if format == Format::Maz {
            continue;
        }
        let text = write(&file, format).unwrap();
        assert_eq!(Format::detect(&text).unwrap(), format);
        assert_eq!(read(&text).unwrap(), file, "{format}:\n{text}");
        let windows = format!("\u{feff}{}\r\n\r\n", text.replace('\n', "\r\n"));
        assert_eq!(
            read(&windows).unwrap(),
            file,
            "{format} with CR LF and a byte order mark"
        );
        let old = text.replace('\n', "\r");
        assert_eq!(read(&old).unwrap(), file, "{format} with CR alone");
    }
    assert_eq!(write(&file, Format::Numbers).unwrap(), NUMBERS);
    let num = write(&file, Format::Num).unwrap();
    assert!(num.starts_with("0 0 0 1 1 1\n0 1 0 1 0 1\n"), "{num}");
    let shuffled: Vec<&str> = num.lines().rev().collect();
    assert_eq!(
        read(&shuffled.join("\n")).unwrap(),
        file,
        "cells may come in any order"
    );
}

#[test]
fn a_drawing_may_be_drawn_in_several_ways() {
    let check = |text: &str| assert_eq!(read(text).unwrap().maze, drawn(), "\n{text}");
    check(&DRAWN.replace('o', "+"));
    check(&DRAWN.replace(" S ", "S  ").replace('G', "g"));
    check(&DRAWN.replace('\n', "   \n"));
    check(&DRAWN.replace('\n', "\n    ").replacen('o', "    o", 1));
    check(&format!("\n\n{DRAWN}\n\n"));
    check(&DRAWN.replace(" S ", "   "));
    check(&format!("{DRAWN}Drawn in 1987.\n| not a wall |\n"));
    check(&format!("{DRAWN}old maze of the club\n+1 cell\n"));
    check(&DRAWN.replacen('\n', "  the north border, größer\n", 1));
}

#[test]
fn a_header_tells_what_a_drawing_cannot() {
    let check = |header: &str, expect: MazeFile| {
        let text = format!("{header}\n{DRAWN}");
        assert_eq!(read(&text).unwrap(), expect, "{header}");
    };
    let plain = || MazeFile::from(drawn());
    let facing = |heading| {
        let mut file = plain();
        file.maze.set_start(Some((Cell::new(0, 0), heading)));
        file
    };
    check("# nothing", plain());
    check("format = tolman maze 1", plain());
    check(
        "name = Grüne Ecke",
        MazeFile {
            name: Some("Grüne Ecke".to_owned()),
            ..plain()
        },
    );
    check(
        "name=\" a \"b\"",
        MazeFile {
            name: Some(" a \"b".to_owned()),
            ..plain()
        },
    );
    check(
        "  corridor_width =0.25 ",
        MazeFile {
            corridor_width: Some(0.25),
            ..plain()
        },
    );
    check(
        "corridor_width = 1e1",
        MazeFile {
            corridor_width: Some(10.0),
            ..plain()
        },
    );
    check(
        "corridor_width = 0.95 # metres",
        MazeFile {
            corridor_width: Some(0.95),
            ..plain()
        },
    );
    check(
        "name = Cell #7",
        MazeFile {
            name: Some("Cell #7".to_owned()),
            ..plain()
        },
    );
    check("format = tolman maze 1 # by hand", plain());
    check("start = 0 0 east # not north", facing(Direction::East));
    check("start = 0 0", plain());
    check("start = 0 0 North", plain());
    check("start = (0, 0), east", facing(Direction::East));
    check("start = 0,0,south", facing(Direction::South));
    check("destination = 1 1, 1 2, 2 1, 2 2", plain());
    check("destination = (2, 2); (1, 1); (1, 2); (2, 1)", plain());

    let unmarked = DRAWN.replace(['S', 'G'], " ");
    let text = format!("start = 3 3 west\ndestination = 0 1 3 0\n{unmarked}# the end\n");
    let maze = read(&text).unwrap().maze;
    assert_eq!(maze.start(), Some((Cell::new(3, 3), Direction::West)));
    assert_eq!(maze.goals(), [Cell::new(0, 1), Cell::new(3, 0)]);

    let anywhere = format!("destination = 3 0\n{unmarked}");
    assert_eq!(
        read(&anywhere).unwrap().maze.start(),
        None,
        "a corridor world needs no start"
    );
}

#[test]
fn tolmans_format_gives_everything_back() {
    let mut maze = Maze::open(Grid::new(3, 2));
    maze.set_goals(vec![Cell::new(2, 0)]);
    let names = [
        None,
        Some(""),
        Some("J"),
        Some(" \"quoted\" = # ¶"),
        Some("\""),
    ];
    let starts = [
        None,
        Some((Cell::new(0, 1), Direction::West)),
        Some((Cell::new(2, 0), Direction::North)),
    ];
    for name in names {
        for corridor_width in [None, Some(0.1), Some(0.001), Some(1000.0)] {
            for start in starts {
                maze.set_start(start);
                let name = name.map(str::to_owned);
                let file = MazeFile {
                    name,
                    corridor_width,
                    maze: maze.clone(),
                    unknown: Vec::new(),
                    goal_is_assumed: false,
                };
                let text = write(&file, Format::Tolman).unwrap();
                assert_eq!(read(&text).unwrap(), file, "\n{text}");
            }
        }
    }
}

#[test]
fn what_a_format_cannot_hold_it_refuses() {
    let check = |change: fn(&mut MazeFile), format: Format, expect: &str| {
        let mut file = MazeFile::from(drawn());
        change(&mut file);
        let error = write(&file, format).unwrap_err();
        assert_eq!(error.to_string(), expect);
    };
    let goal = |file: &mut MazeFile| file.maze.set_goals(vec![Cell::new(3, 3)]);
    check(
        goal,
        Format::Numbers,
        "the format `numbers` cannot hold the goals (3, 3): they are always the middle, (1, 1), \
         (1, 2), (2, 1), (2, 2); write it as `tolman`",
    );
    check(
        |file| file.maze.set_goals(vec![]),
        Format::Num,
        "the format `num` cannot hold the goals none: they are always the middle, (1, 1), (1, 2), \
         (2, 1), (2, 2); write it as `tolman`",
    );
    let east = |file: &mut MazeFile| {
        file.maze
            .set_start(Some((Cell::new(0, 0), Direction::East)));
    };
    check(
        east,
        Format::Num,
        "the format `num` cannot hold the start (0, 0) looking east: its start is always (0, 0) \
         looking north; write it as `tolman`",
    );
    check(
        |file| file.maze.set_start(None),
        Format::Mazefiles,
        "the format `mazefiles` cannot hold a maze without a start: it has an S that looks north; \
         write it as `tolman`",
    );
    check(
        |file| {
            let landmark = [(Cell::new(0, 3), 1)];
            file.maze.set_landmarks(landmark.into_iter().collect());
        },
        Format::Num,
        "the format `num` cannot hold landmarks: write it as `tolman`",
    );
    check(
        |file| file.maze = Maze::open(Grid::new(3, 3)),
        Format::Numbers,
        "the format `numbers` cannot hold a maze of 3 × 3 cells: it needs a square of even size; \
         write it as `tolman`",
    );
    check(
        |file| file.name = Some("two\nlines".to_owned()),
        Format::Tolman,
        "the name \"two\\nlines\" has a line break or another control character: a maze's name is one \
         line of text",
    );
    check(
        |file| file.corridor_width = Some(f64::NAN),
        Format::Tolman,
        "the corridor width is NaN m; give 0.001 to 1000 m",
    );
    check(
        |file| file.maze.set_wall(Cell::new(3, 2), Direction::East, false),
        Format::Tolman,
        "the border of cell (3, 2) is open to the east: close it with a wall",
    );
    check(
        |file| file.maze.set_goals(vec![Cell::new(4, 0)]),
        Format::Tolman,
        "the goal (4, 0) lies outside the maze: columns run from 0 to 3, rows from 0 to 3",
    );
    check(
        |file| file.maze = Maze::open(Grid::new(1, 1025)),
        Format::Tolman,
        "a side of 1025 cells is too long: mazes of up to 1024 are written",
    );
    let file = MazeFile::from(Maze::open(Grid::new(0, 3)));
    assert!(matches!(
        write(&file, Format::Num),
        Err(WriteError::Maze(_))
    ));
}

#[test]
fn the_largest_maze_goes_through_every_format() {
    let mut maze = Maze::open(Grid::new(Grid::MAX_SIDE, Grid::MAX_SIDE));
    maze.set_start(Some((Cell::new(0, 0), Direction::North)));
    maze.set_goals(maze.grid().middle().collect());
    let file = MazeFile::from(maze);
    for format in Format::ALL {
        if format == Format::Maz {
            continue;
        }
        let text = write(&file, format).unwrap();
        assert!(parse(&text).unwrap() == file, "{format}");
    }
}

#[test]
fn formats_have_names() {
    for format in Format::ALL {
        assert_eq!(format.to_string().parse(), Ok(format));
        assert_eq!(format.name(), format.to_string());
    }
    let error = "csv".parse::<Format>().unwrap_err();
    assert_eq!(
        error.to_string(),
        "`csv` is not a maze format: use numbers, mazefiles, boxes, num, tolman, blocks, underscores, hex, maz"
    );
    assert_eq!(format!("{:>10}|", Format::Num), "       num|");
}

#[test]
fn formats_are_known_by_their_files_names() {
    let extension = |format: Format| format.extension();
    let all = [
        Format::Numbers,
        Format::Mazefiles,
        Format::Num,
        Format::Tolman,
    ];
    assert_eq!(all.map(extension), ["txt", "txt", "num", "maze"]);
}

#[test]
fn directions_turn_as_a_compass_does() {
    use Direction::{East, North, South, West};
    for (number, heading) in (0..4).zip([North, East, South, West]) {
        let seen: Vec<Direction> = [North, East, South, West]
            .map(|side| heading.turned(side))
            .into();
        let mut expected = vec![North, East, South, West];
        expected.rotate_left(number);
        assert_eq!(seen, expected, "{heading:?}");
        for side in Direction::ALL {
            assert_eq!(heading.turned(side).seen_from(heading), side);
        }
    }
}

/// A maze of 3 × 3 cells in every way that others draw it.
const SAME: [&str; 8] = [
    "+---+---+---+\n|     G     |\n+   +---+   +\n|   |       |\n+   +   +---+\n| S |       |\n+---+---+---+\n",
    "+--+--+--+\n|    G   |\n+  +--+  +\n|  |     |\n+  +  +--+\n|S |     |\n+--+--+--+\n",
    "#######\n#  G  #\n# ### #\n# #   #\n# # ###\n#S#   #\n#######\n",
    "##############\n##    G     ##\n##  ######  ##\n##  ##      ##\n##  ##  ######\n##S ##      ##\n##############\n",
    "1111111\n100E001\n1011101\n1010001\n1010111\n1S10001\n1111111\n",
    "███████\n█  G  █\n█ ███ █\n█ █   █\n█ █ ███\n█S█   █\n███████\n",
    "┌───────────┐\n│     G     │\n│   ┌───╴   │\n│   │       │\n│   │   ╶───┤\n│ S │       │\n└───┴───────┘\n",
    "type octile\nheight 7\nwidth 7\nmap\n@@@@@@@\n@..G..@\n@.@@@.@\n@.@...@\n@.@.@@@\n@S@...@\n@@@@@@@\n",
];

#[test]
fn others_draw_the_same_maze() {
    let [first, others @ ..] = SAME;
    let maze = read(first).unwrap().maze;
    for text in others {
        assert_eq!(
            read(text)
                .unwrap_or_else(|error| panic!("{error}\n{text}"))
                .maze,
            maze,
            "{text}"
        );
    }
    let mut marked = maze.clone();
    marked.set_start(Some((Cell::new(0, 0), Direction::North)));
    let hex = write(&marked.clone().into(), Format::Hex).unwrap();
    assert_eq!(read(&hex).unwrap().maze, marked, "{hex}");
    // Walls alone: start and goal by the rules.
    marked.set_goals(vec![Cell::new(1, 1)]);
    let text = " _ _ _\n|  _  |\n| |  _|\n|_|_ _|\n";
    assert_eq!(read(text).unwrap().maze, marked, "{text}");
    for text in [
        "#####\n#   #\n#   #\n#####\n",
        "#####\n# # #\n#####\n# # #\n",
    ] {
        let told = read(text).unwrap_err().to_string();
        assert!(told.contains("is no maze of cells"), "{told}");
    }
}

#[test]
fn binary_mazes_come_back_without_the_mouses_marks() {
    for side in [16, 32] {
        let mut maze = Maze::open(Grid::new(side, side));
        maze.set_wall(Cell::new(0, 0), Direction::East, true);
        maze.set_wall(Cell::new(3, 9), Direction::North, true);
        maze.set_start(Some((Cell::new(0, 0), Direction::North)));
        maze.set_goals(maze.grid().middle().collect());
        let text = write(&maze.clone().into(), Format::Maz).unwrap();
        assert_eq!(
            (text.len(), text.as_bytes()[0]),
            (usize::from(side * side), 0b1110)
        );
        let marked: Vec<u8> = text.bytes().map(|byte| byte | 0xf0).collect();
        assert_eq!(tolman_maze::maz_text(&marked).as_deref(), Some(&*text));
        assert_eq!(read(&text).unwrap().maze, maze);
    }
    assert_eq!(
        tolman_maze::maz_text(&DRAWN.repeat(9).as_bytes()[..256]),
        None
    );
}

#[test]
fn unknown_walls_and_missing_goals_are_told() {
    let text = "+---+---+---+\n|           |\n+   + . +   +\n|   .       |\n+   +   +---+\n| S |       |\n+---+---+---+\n";
    let file = read(text).unwrap();
    assert!(file.goal_is_assumed);
    assert_eq!(file.maze.goals(), [Cell::new(1, 1)]);
    let unknown = [
        (Cell::new(0, 1), Direction::East),
        (Cell::new(1, 1), Direction::North),
    ];
    assert_eq!(file.unknown, unknown);
    assert_eq!(
        file.knowledge(Cell::new(1, 1), Direction::West),
        Knowledge::Unknown
    );
    assert_eq!(
        file.knowledge(Cell::new(0, 0), Direction::East),
        Knowledge::Wall
    );
    let again = read(&write(&file, Format::Mazefiles).unwrap()).unwrap();
    assert_eq!(
        (again.unknown, again.maze),
        (file.unknown.clone(), file.maze.clone())
    );
    assert!(matches!(
        write(&file, Format::Num),
        Err(WriteError::Unknown { .. })
    ));
}

#[test]
fn four_quarters_and_two_mirrors_change_nothing() {
    let maze = drawn();
    let turned = maze.rotated();
    assert_ne!(turned, maze);
    assert_eq!(turned.rotated().rotated().rotated(), maze);
    assert_eq!(maze.mirrored().mirrored(), maze);
    assert_eq!(
        maze.mirrored().rotated(),
        maze.rotated().rotated().rotated().mirrored()
    );
}

/// What every format holds: a square of a size that all have, a start in the corner, the middle for
/// the goal.
fn classic(side: u16, seed: u64) -> MazeFile {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let braided = Braided {
        width: side,
        height: side,
        share: 0.5,
    };
    let mut maze = braided.generate(&mut rng).unwrap();
    maze.set_goals(maze.grid().middle().collect());
    in_the_corner(maze.into())
}

fn in_the_corner(mut file: MazeFile) -> MazeFile {
    file.maze
        .set_start(Some((Cell::new(0, 0), Direction::North)));
    file
}

#[test]
fn every_format_becomes_every_other_turned_and_mirrored() {
    for (side, seed) in [(16, 1), (16, 2), (32, 3)] {
        let file = classic(side, seed);
        for from in Format::ALL {
            let text = write(&file, from).unwrap();
            assert_eq!(Format::detect(&text), Ok(from));
            for motion in 0..8 {
                let mut expected = parse(&text).unwrap();
                if motion >= 4 {
                    expected = expected.mirrored();
                }
                for _ in 0..motion % 4 {
                    expected = expected.rotated();
                }
                let expected = in_the_corner(expected);
                for to in Format::ALL {
                    let text = write(&expected, to).unwrap();
                    assert_eq!(parse(&text).unwrap(), expected, "{from} to {to}, {motion}");
                }
            }
        }
    }
}

#[test]
fn unknown_walls_turn_with_their_maze() {
    let mut file = classic(16, 4);
    let unknown = |side| (Cell::new(3, 5), side);
    file.unknown = vec![unknown(Direction::North), unknown(Direction::East)];
    for (cell, side) in file.unknown.clone() {
        file.maze.set_wall(cell, side, false);
    }
    let turned = file.clone().rotated();
    assert_eq!(
        turned.knowledge(Cell::new(5, 12), Direction::South),
        Knowledge::Unknown
    );
    for format in [Format::Mazefiles, Format::Boxes] {
        let text = write(&in_the_corner(turned.clone()), format).unwrap();
        assert_eq!(parse(&text).unwrap(), in_the_corner(turned.clone()));
    }
    assert_eq!(turned.rotated().rotated().rotated(), file);
    assert_eq!(file.clone().mirrored().mirrored(), file);
}

#[test]
fn a_drawing_of_boxes_looks_like_one() {
    let text = "\
┌───┬───┬───┬───┐
│               │
│   ┌───────┐   │
│   │ G   G │   │
│   │   +   ╵   │
│   │ G   G     │
│   │   ╷   ╶───┤
│ S │   │       │
└───┴───┴───────┘
";
    let file = read(text).unwrap();
    assert_eq!(write(&file, Format::Boxes).unwrap(), text);
}
