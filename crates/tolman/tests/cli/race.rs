//! The competition mouse.

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
    let slow = template.replace("f90_ms = 375", "f90_ms = 475");
    assert_ne!(slow, template);
    assert!(run_ms("slow.toml", &slow) >= usual);
    for (text, parts) in [
        ("cell = 3", &["bad.toml", "cell", "--template"][..]),
        (
            &template.replace("= 420.0", "= 0"),
            &["turn_speed_mm_s", "above 0"],
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

/// Returns a row of cells.
fn corridor(cells: usize) -> String {
    let line = format!("{}+\n", "+---".repeat(cells));
    format!("{line}|{}|\n{line}", " ".repeat(4 * cells - 1))
}
