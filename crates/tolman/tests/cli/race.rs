//! The competition mouse.

use alloc::collections::BTreeMap;

use serde_json::Value;

use crate::{folder, tolman_in};

/// The start faces a wall; the way out is to the east.
const MAZE: &str = "\
o---o---o---o---o
|               |
o   o---o---o   o
|   |     G |   |
o   o   o---o   o
|   |           |
o---o---o   o   o
| S             |
o---o---o---o---o
";

fn with_maze(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    std::fs::write(folder.join("a.maze"), MAZE).unwrap();
    folder
}

#[test]
fn a_race_tells_its_costs_and_its_moves() {
    let folder = with_maze("race");
    let told = tolman_in(&folder, &["race", "a.maze", "--json"]).done();
    let told: Value = serde_json::from_str(&told).unwrap();
    assert_eq!(told["proven"], true);
    let cells = &told["cells"];
    let cell = |name: &str| cells[name].as_u64().unwrap();
    assert_eq!(cell("all"), cell("search") + cell("proof") + cell("home"));
    let path = told["search_path"].as_str().unwrap();
    assert_eq!(path.len() as u64, cell("all"));
    assert!(path.starts_with('R'), "it turns to where it can go: {path}");
    let moves = told["moves"].as_array().unwrap();
    let sum: u64 = moves
        .iter()
        .map(|one| one["time_ms"].as_u64().unwrap())
        .sum();
    assert_eq!(told["run_ms"], sum);
    let letters = told["run_path"].as_str().unwrap();
    let diagonals = moves.iter().filter(|one| one["move"] == "diagonal");
    let halves: u64 = diagonals.map(|one| one["cells"].as_u64().unwrap()).sum();
    assert_eq!(letters.matches('w').count() as u64, halves, "{letters}");
    let told = tolman_in(&folder, &["race", "a.maze"]).done();
    assert!(
        told.contains("proven: ") && told.contains("proof "),
        "{told}"
    );
}

#[test]
fn a_mouse_is_driven_as_its_file_says() {
    let folder = with_maze("race-mouse");
    let template = tolman_in(&folder, &["race", "--template"]).done();
    let run_ms = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).unwrap();
        let told = tolman_in(&folder, &["race", "a.maze", "--json", "--mouse", name]).done();
        let told: Value = serde_json::from_str(&told).unwrap();
        told["run_ms"].as_u64().unwrap()
    };
    let usual = run_ms("usual.toml", &template);
    let small = tolman_in(&folder, &["race", "--template", "half-size"]).done();
    assert!(run_ms("small.toml", &small) < usual, "half the way");
    let slow = template.replace("f90 = 531", "f90 = 631");
    assert_ne!(slow, template);
    assert!(run_ms("slow.toml", &slow) >= usual);
    for (text, parts) in [
        ("cell = 3", &["bad.toml", "cell", "--template"][..]),
        (
            &template.replace("= 594.0", "= 0"),
            &["turn_speed_mm_s", "above 0"],
        ),
        (
            &template.replace("f90 = 531", "f90_ms = 427"),
            &[
                "bad.toml",
                "F90 takes at least 428 ms at 594 mm/s: its shortest way is 255 mm",
            ],
        ),
    ] {
        std::fs::write(folder.join("bad.toml"), text).unwrap();
        let bad = ["race", "a.maze", "--mouse", "bad.toml"];
        tolman_in(&folder, &bad).refused(2, parts);
    }
}

#[test]
fn a_race_is_drawn_and_played() {
    let folder = with_maze("race-looks");
    let looks = [
        "race", "a.maze", "--svg", "r.svg", "--replay", "r.html", "--trace", "r.jsonl",
    ];
    tolman_in(&folder, &looks).done();
    let picture = std::fs::read_to_string(folder.join("r.svg")).unwrap();
    assert!(picture.matches("trajectory").count() >= 2, "both ways");
    let replay = std::fs::read_to_string(folder.join("r.html")).unwrap();
    assert!(replay.contains("walls it knows"));
    let trace = std::fs::read_to_string(folder.join("r.jsonl")).unwrap();
    assert!(trace.lines().nth(1).unwrap().contains("explore"));
    assert!(trace.lines().last().unwrap().contains("run"));
}

#[test]
fn one_bad_maze_in_a_folder_does_not_void_the_others() {
    let folder = with_maze("race-folder");
    std::fs::write(folder.join("b.maze"), "no maze").unwrap();
    std::fs::write(folder.join("c.png"), b"\x89PNG\xff").unwrap();
    let large = format!("start = 0 0\ndestination = 39 0\n\n{}", corridor(40));
    std::fs::write(folder.join("d.maze"), large).unwrap();
    let robots = format!("corridor_width = 0.5\n\n{MAZE}");
    std::fs::write(folder.join("e.maze"), robots).unwrap();
    let startless = format!("name = F\n\n{}", MAZE.replace('S', " "));
    std::fs::write(folder.join("f.maze"), startless).unwrap();
    for verb in ["race", "mouse"] {
        let told = tolman_in(&folder, &[verb, "."]);
        assert_eq!(told.code, Some(2), "{}", told.err);
        assert!(
            told.out.contains("./a.maze: ") && told.out.contains("proven"),
            "{}",
            told.out
        );
        assert!(
            told.err.contains("3 of 4 mazes are invalid"),
            "{}",
            told.err
        );
        for skipped in [
            "./e.maze is a maze for robots",
            "./f.maze is a maze for robots",
        ] {
            assert!(told.err.contains(skipped), "{}", told.err);
        }
    }
}

/// Stairs, on which a first mouse turns in every cell.
const STAIRS: &str = "\
o---o---o---o---o
|         G |   |
o   o---o---o---o
|       |   |   |
o---o   o---o---o
|       |   |   |
o   o---o---o---o
| S |   |   |   |
o---o---o---o---o
";

#[test]
fn a_first_mouse_turns_within_cells() {
    let folder = with_maze("race-beginner");
    std::fs::write(folder.join("stairs.txt"), STAIRS).unwrap();
    let race = |more: &[&str]| {
        let race = ["race", "stairs.txt", "--no-diagonals"];
        tolman_in(&folder, &[&race[..], more].concat()).done()
    };
    let told = race(&["--moves", "cells"]);
    assert!(told.contains("proven: FRLLRRF;"), "{told}");
    let told: Value = serde_json::from_str(&race(&["--json"])).unwrap();
    let moves = told["moves"].as_array().unwrap();
    let fs90 = moves.iter().filter(|one| one["move"] == "FS90");
    assert_eq!(fs90.count(), 5, "{told}");
    // The middle of the start, and the side that the first turn begins on.
    assert_eq!(moves[0]["from"]["half_x"], 1);
    assert_eq!(moves[1]["from"]["half_y"], 2);
    let beginner = tolman_in(&folder, &["race", "--template", "beginner"]).done();
    std::fs::write(folder.join("curves.toml"), &beginner).unwrap();
    let place = beginner.replace("fs90 = 406", "in_place_ms = 300");
    std::fs::write(folder.join("place.toml"), &place).unwrap();
    let told = race(&[
        "--mouse",
        "curves.toml",
        "--mouse",
        "place.toml",
        "--moves",
        "names",
    ]);
    let table: Vec<&str> = told.lines().collect();
    assert_eq!(table.len(), 4, "{told}");
    assert!(
        table[1].starts_with("  mouse        run, s  cells"),
        "{told}"
    );
    assert!(
        table[2].starts_with("  curves.toml") && table[2].contains("SS90SR, SS90SL"),
        "{told}"
    );
    assert!(
        table[3].starts_with("  place.toml ") && table[3].contains("IP90R, IP90L"),
        "{told}"
    );
    let none = beginner.replace("fs90 = 406", "");
    std::fs::write(folder.join("none.toml"), none).unwrap();
    let bad = [
        "race",
        "stairs.txt",
        "--no-diagonals",
        "--mouse",
        "none.toml",
    ];
    tolman_in(&folder, &bad).refused(2, &["none.toml", "in_place_ms"]);
}

#[test]
fn a_builders_route_is_timed_and_checked() {
    let folder = with_maze("race-route");
    std::fs::write(folder.join("stairs.txt"), STAIRS).unwrap();
    let route = |route: &str| {
        tolman_in(
            &folder,
            &["race", "stairs.txt", "--no-diagonals", "--route", route],
        )
    };
    let by_cells = route("FRLLRRF").done();
    assert!(by_cells.contains("0.000 s less"), "{by_cells}");
    assert_eq!(route("sRLLRRsss").done(), by_cells);
    route("FRLL").refused(1, &["not a goal"]);
    route("FF").refused(1, &["cell 2", "wall"]);
    route("SS").refused(1, &["cannot be driven", "not known to be open"]);
    route("FX").refused(2, &["`X`"]);
}

#[test]
fn a_half_known_maze_is_planned_in() {
    let folder = with_maze("race-half");
    let half = STAIRS.replace(
        "|       |   |   |\no   o---o---o---o\n| S",
        "|       |   |   |\no . o---o---o---o\n| S",
    );
    std::fs::write(folder.join("half.txt"), half).unwrap();
    let told = tolman_in(&folder, &["race", "half.txt"]).done();
    assert!(
        told.contains("1 unknown wall: no run is known; the best possible"),
        "{told}"
    );
    let told = tolman_in(&folder, &["mouse", "half.txt"]).done();
    assert!(
        told.contains("the best possible takes 6 steps; next, turn right from (0, 0)"),
        "{told}"
    );
    let at = ["race", "half.txt", "--at", "0,1,south"];
    let told = tolman_in(&folder, &at).done();
    assert!(told.contains("from (0, 1)"), "{told}");
    tolman_in(&folder, &["mouse", "half.txt", "--at", "9,9"])
        .refused(2, &["--at (9, 9)", "half.txt"]);
    tolman_in(&folder, &["mouse", "a.maze", "--at", "0,0"])
        .refused(2, &["unknown walls", "--start"]);
}

#[test]
fn start_and_goal_may_be_given() {
    let folder = with_maze("race-marks");
    std::fs::write(folder.join("bare.txt"), MAZE.replace('G', " ")).unwrap();
    let told = tolman_in(&folder, &["race", "bare.txt"]);
    assert!(
        told.err.contains("marks no goal: the middle is taken"),
        "{}",
        told.err
    );
    let marked = [
        "race", "bare.txt", "--goal", "3,3", "--start", "0,3,east", "--moves", "names",
    ];
    let told = tolman_in(&folder, &marked).done();
    assert!(told.contains("FWD 540 mm;"), "{told}");
    tolman_in(&folder, &["race", "bare.txt", "--goal", "4,0"]).refused(2, &["--goal (4, 0)"]);
}

#[test]
fn a_long_run_is_a_run() {
    let folder = with_maze("race-long");
    // Thirty-two rows of 31 cells, each left at its end for the next.
    let (cells, rows) = (31, 32);
    let line = |open_at: Option<usize>| -> String {
        let wall = |x| if open_at == Some(x) { "o   " } else { "o---" };
        (0..cells).map(wall).collect::<String>() + "o\n"
    };
    let mut maze = line(None);
    for row in 0..rows {
        let mark = if row == 0 {
            "| G "
        } else if row == rows - 1 {
            "| S "
        } else {
            "|   "
        };
        maze += &format!("{mark}{}|\n", " ".repeat(4 * cells - 4));
        let end = if row % 2 == 0 { cells - 1 } else { 0 };
        maze += &line(Some(end).filter(|_| row < rows - 1));
    }
    std::fs::write(folder.join("long.txt"), maze).unwrap();
    let beginner = tolman_in(&folder, &["race", "--template", "beginner"]).done();
    let slow = beginner.replace("= 1500.0", "= 400.0");
    std::fs::write(folder.join("slow.toml"), slow).unwrap();
    let told = tolman_in(
        &folder,
        &["race", "long.txt", "--mouse", "slow.toml", "--json"],
    )
    .done();
    let told: Value = serde_json::from_str(&told).unwrap();
    assert!(told["run_ms"].as_u64().unwrap() > 400_000, "{told}");
    assert_eq!(told["proven"], true);
}

/// Returns a row of cells.
fn corridor(cells: usize) -> String {
    let line = format!("{}+\n", "+---".repeat(cells));
    format!("{line}|{}|\n{line}", " ".repeat(4 * cells - 1))
}

/// Moves of the JSON, driven by a geometry of this test's own: walls are read off the drawing, and
/// each move is a row of half steps and eighths of a turn.
mod replayed {
    use serde_json::Value;

    /// Half steps to the east and north, by eighths of a turn counter-clockwise from east.
    const STEP: [(i64, i64); 8] = [
        (1, 0),
        (1, 1),
        (0, 1),
        (-1, 1),
        (-1, 0),
        (-1, -1),
        (0, -1),
        (1, -1),
    ];

    /// Returns whether a place in half cells is free: the middle of a cell, or an open side.
    fn is_free(drawing: &[Vec<char>], x: i64, y: i64) -> bool {
        let row = drawing.len() as i64 - 1 - y;
        let at = |column: i64| {
            let line = usize::try_from(row).ok().and_then(|row| drawing.get(row));
            let letter = line.zip(usize::try_from(column).ok());
            letter.and_then(|(line, column)| line.get(column)).copied()
        };
        match (x.rem_euclid(2), y.rem_euclid(2)) {
            (1, 1) => x > 0 && y > 0,
            (0, 1) => at(2 * x) == Some(' '),
            (1, 0) => at(2 * x) == Some(' '),
            // A post.
            _ => false,
        }
    }

    /// Returns the angles of a turn, in eighths, with half a step before and after each.
    fn angles(kind: &str, is_diagonal: bool) -> &'static [i64] {
        match (kind, is_diagonal) {
            ("F45", _) => &[1],
            ("F90", _) => &[1, 1],
            ("F135", false) => &[1, 2],
            ("F135", true) => &[2, 1],
            ("F180", _) => &[1, 2, 1],
            ("FV90" | "FS90", _) => &[2],
            _ => unreachable!("{kind}"),
        }
    }

    /// Drives all moves of a line, and returns how many there are.
    pub(super) fn check(line: &Value, drawing: &str) -> usize {
        let rows: Vec<Vec<char>> = drawing
            .lines()
            .filter(|line| line.starts_with(['o', '+', '|']))
            .map(|line| line.chars().collect())
            .collect();
        let number = |value: &Value| value.as_i64().unwrap();
        let moves = line["moves"].as_array().unwrap();
        let first = &moves[0]["from"];
        let (mut x, mut y) = (number(&first["half_x"]), number(&first["half_y"]));
        let mut eighths = number(&first["heading_deg"]).rem_euclid(360) / 45;
        let mut total = number(&line["start_ms"]) + number(&line["stop_ms"]);
        for one in moves {
            let from = &one["from"];
            let told = (number(&from["half_x"]), number(&from["half_y"]));
            assert_eq!(told, (x, y), "{one} in {line}");
            let heading = number(&from["heading_deg"]).rem_euclid(360) / 45;
            assert_eq!(heading, eighths, "{one} in {line}");
            total += number(&one["time_ms"]);
            let go = |x: &mut i64, y: &mut i64, eighths: i64| {
                let (east, north) = STEP[eighths.rem_euclid(8) as usize];
                (*x, *y) = (*x + east, *y + north);
                assert!(is_free(&rows, *x, *y), "({x}, {y}): {one} in\n{drawing}");
            };
            let steps = one["half_cells"].as_i64().or(one["cells"].as_i64());
            if let Some(steps) = steps {
                assert_eq!(one["move"] == "diagonal", eighths % 2 == 1, "{one}");
                (0..steps).for_each(|_| go(&mut x, &mut y, eighths));
                continue;
            }
            let side = if one["side"] == "left" { 1 } else { -1 };
            let kind = one["move"].as_str().unwrap();
            let turns = angles(kind, eighths % 2 == 1);
            go(&mut x, &mut y, eighths);
            for turn in turns {
                eighths = (eighths + side * turn).rem_euclid(8);
                go(&mut x, &mut y, eighths);
            }
        }
        assert_eq!(total, number(&line["run_ms"]), "{line}");
        let (column, row) = ((2 * x) as usize, rows.len() - 1 - y as usize);
        assert_eq!(
            rows[row][column], 'G',
            "the run ends in a goal: {line}\n{drawing}"
        );
        moves.len()
    }
}

#[test]
fn six_thousand_moves_are_replayed_without_a_doubt() {
    let folder = folder("race-replayed");
    std::fs::create_dir(folder.join("mazes")).unwrap();
    let mut drawings = BTreeMap::new();
    for seed in 0..150_u32 {
        let (family, size) = [
            ("braided", "16x16"),
            ("rooms", "16x16"),
            ("perfect", "12x12"),
        ][seed as usize % 3];
        let seed = seed.to_string();
        let call = ["maze", "generate", family, "--size", size, "--seed", &seed];
        let name = format!("mazes/{seed}.maze");
        let maze = tolman_in(&folder, &call).done();
        std::fs::write(folder.join(&name), &maze).unwrap();
        drawings.insert(name, maze);
    }
    let mut moves = 0;
    for more in [&[][..], &["--no-diagonals"]] {
        let call = [&["race", "mazes", "--json"], more].concat();
        let told = tolman_in(&folder, &call).done();
        for line in told.lines() {
            let line: Value = serde_json::from_str(line).unwrap();
            moves += replayed::check(&line, &drawings[line["maze"].as_str().unwrap()]);
        }
    }
    assert!(moves >= 6000, "{moves}");
}

#[test]
fn speeds_over_time_are_drawn_for_each_mouse() {
    let folder = with_maze("race-speeds");
    let template = tolman_in(&folder, &["race", "--template"]).done();
    std::fs::write(folder.join("a.toml"), &template).unwrap();
    let fast = template.replace("top_speed_mm_s = 1500.0", "top_speed_mm_s = 3000.0");
    assert_ne!(fast, template);
    std::fs::write(folder.join("b.toml"), fast).unwrap();
    let call = [
        "race", "a.maze", "--speeds", "s.svg", "--mouse", "a.toml", "--mouse", "b.toml",
    ];
    tolman_in(&folder, &call).done();
    let svg = std::fs::read_to_string(folder.join("s.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.contains("a.toml") && svg.contains("b.toml"));
    // Two, each with its sample in the legend.
    assert_eq!(svg.matches("class=\"line\"").count(), 4, "{svg}");
    std::fs::create_dir(folder.join("two")).unwrap();
    for name in ["two/a.maze", "two/b.maze"] {
        std::fs::write(folder.join(name), MAZE).unwrap();
    }
    let told = tolman_in(&folder, &["race", "two", "--speeds", "t.svg"]);
    assert_eq!(told.code, Some(2));
    assert!(told.err.contains("two holds 2"), "{}", told.err);
}
