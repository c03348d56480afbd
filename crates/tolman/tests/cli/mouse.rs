//! A micromouse under the paper's rules.

use serde_json::Value;
use tolman_maze::{Cell, Direction, Maze};

use crate::{folder, tolman_in};

const MAZE: &str = "\
o---o---o---o---o---o
|                   |
o   o---o---o---o   o
|   |       | G |   |
o   o   o   o   o   o
|   |   |       |   |
o   o   o---o---o   o
| S |               |
o---o---o---o---o---o
";

/// Returns the rules once more, as short as they go: the steps of both runs. Each step says where
/// it led.
fn replay(maze: &Maze, text: &str) -> Option<(u32, u32)> {
    let start = maze.start()?;
    let (mut at, mut heading) = start;
    let (mut steps, mut hit, mut run_1) = (0, false, None);
    for line in text.lines().skip(1) {
        let order: Value = serde_json::from_str(line).unwrap();
        steps += 1;
        assert_eq!(order["step"], steps);
        if order["rotation"] == "Reset" && order["movement"] == "Reset" {
            assert!(hit && run_1.is_none(), "a reset the rules do not allow");
            run_1 = Some(steps);
            (at, heading) = start;
            continue;
        }
        heading = match order["rotation"].as_i64().unwrap() {
            -90 => heading.left(),
            90 => heading.right(),
            other => {
                assert_eq!(other, 0, "a quarter turn or none");
                heading
            }
        };
        let cells = order["movement"].as_i64().unwrap();
        assert!((-3..=3).contains(&cells));
        let ahead: Direction = if cells < 0 {
            heading.opposite()
        } else {
            heading
        };
        for _ in 0..cells.abs() {
            assert!(maze.is_open(at, ahead), "it runs into no wall");
            at = maze.grid().neighbour(at, ahead)?;
        }
        hit |= maze.goals().contains(&at);
        assert_eq!(
            (&order["cell"]["x"], &order["cell"]["y"]),
            (&at.x.into(), &at.y.into())
        );
        assert_eq!(order["heading"], heading.to_string());
        if let Some(run_1) = run_1
            && maze.goals().contains(&at)
        {
            return Some((run_1, steps - run_1));
        }
    }
    None
}

fn with_maze(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    std::fs::write(folder.join("a.maze"), MAZE).unwrap();
    folder
}

#[test]
fn the_steps_it_writes_make_the_score_it_tells() {
    let maze: Maze = tolman_maze::read(MAZE).unwrap().maze;
    assert!(maze.goals().contains(&Cell::new(3, 2)));
    for search in [
        "certify",
        "certify-worth",
        "certify-plain",
        "target",
        "counter-50",
        "random",
    ] {
        let folder = with_maze(&format!("mouse-steps-{search}"));
        let arguments = [
            "mouse", "a.maze", "--search", search, "--trace", "s.jsonl", "--json",
        ];
        let told = tolman_in(&folder, &arguments).done();
        let told: Value = serde_json::from_str(&told).unwrap();
        let steps = std::fs::read_to_string(folder.join("s.jsonl")).unwrap();
        let header: Value = serde_json::from_str(steps.lines().next().unwrap()).unwrap();
        assert_eq!(
            (&header["format"], &header["version"]),
            (&"tolman-mouse-trace".into(), &1.into())
        );
        assert_eq!(
            (&header["maze"], &header["search"]),
            (&"a.maze".into(), &search.into())
        );
        let (run_1, run_2) = replay(&maze, &steps).unwrap();
        assert_eq!(
            (told["run_1"].as_u64(), told["run_2"].as_u64()),
            (Some(run_1.into()), Some(run_2.into()))
        );
        assert_eq!(
            told["score"].as_f64(),
            Some(f64::from(run_1) / 30.0 + f64::from(run_2))
        );
        if ["certify", "certify-plain"].contains(&search) {
            assert_eq!(
                (&told["certified"], &told["optimum"]),
                (&Value::Bool(true), &told["run_2"])
            );
        }
    }
}

#[test]
fn a_folder_ends_in_a_drawing_and_a_summary() {
    let folder = with_maze("mouse-folder");
    std::fs::create_dir(folder.join("mazes")).unwrap();
    for name in ["b.maze", "c.maze"] {
        std::fs::write(folder.join("mazes").join(name), MAZE).unwrap();
    }
    let told = tolman_in(&folder, &["mouse", "mazes", "--jobs", "2"]);
    assert_eq!(told.code, Some(0), "{}", told.err);
    let lines: Vec<&str> = told.out.lines().collect();
    assert!(lines[0].starts_with("mazes/b.maze: ") && lines[0].ends_with(", proven"));
    assert!(
        told.out
            .contains("mazes/b.maze, with the stops of the first run")
    );
    let last = lines[lines.len() - 1];
    assert!(
        last.starts_with("2 mazes: 2 finished, 2 proven; mean score "),
        "{last}"
    );
    for look in ["--trace", "--replay", "--svg"] {
        tolman_in(&folder, &["mouse", "mazes", look, "x"]).refused(2, &[look, "mazes holds 2"]);
    }
    tolman_in(&folder, &["mouse", "mazes", "--live"]).refused(2, &["--live", "name a file"]);
}

#[test]
fn a_maze_that_the_mouse_does_not_solve_is_a_failure() {
    let folder = folder("mouse-unsolved");
    let generate = "maze generate perfect --size 32x32 --out large.maze";
    let generate: Vec<&str> = generate.split(' ').collect();
    tolman_in(&folder, &generate).done();
    let told = tolman_in(&folder, &["mouse", "large.maze", "--search", "random"]);
    let told = told.failed(1, &["the mouse did not solve large.maze"]);
    assert!(told.contains("large.maze: not done after"), "{told}");
    std::fs::write(folder.join("a.maze"), MAZE).unwrap();
    let told = tolman_in(&folder, &["mouse", ".", "--search", "random"]);
    let told = told.failed(1, &["the mouse did not solve 1 of 2 mazes"]);
    assert!(told.contains("2 mazes: 1 finished"), "{told}");
}

#[test]
fn what_no_mouse_can_run_in_is_refused() {
    let folder = with_maze("mouse-refused");
    let large = tolman_maze::Maze::open(tolman_maze::Grid::new(40, 3));
    let mut large = large;
    large.set_start(Some((Cell::new(0, 0), Direction::North)));
    large.set_goals(vec![Cell::new(9, 1)]);
    std::fs::write(folder.join("large.maze"), large.to_string()).unwrap();
    tolman_in(&folder, &["mouse", "large.maze"]).refused(2, &["large.maze", "40 × 3", "32 × 32"]);
    tolman_in(&folder, &["mouse", "none.maze"]).refused(2, &["none.maze"]);
    tolman_in(&folder, &["mouse", "a.maze", "--search", "luck"]).refused(2, &["luck", "certify"]);
    tolman_in(&folder, &["mouse", "a.maze", "--until", "goal"]).refused(2, &["--until worth"]);
    tolman_in(&folder, &["mouse", "a.maze", "--until", "worth"]).done();
}

#[test]
fn a_run_is_drawn_and_played() {
    let folder = with_maze("mouse-looks");
    let looks = [
        "mouse", "a.maze", "--svg", "m.svg", "--replay", "m.html", "--live",
    ];
    let told = tolman_in(&folder, &looks).done();
    assert!(
        told.contains("proven") && told.contains("replay: file://"),
        "{told}"
    );
    let picture = std::fs::read_to_string(folder.join("m.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("trajectory"));
    let replay = std::fs::read_to_string(folder.join("m.html")).unwrap();
    assert!(
        replay.contains("walls it knows"),
        "the walls that the mouse knew"
    );
    std::fs::write(folder.join("other.html"), "mine").unwrap();
    let other = ["mouse", "a.maze", "--replay", "other.html"];
    tolman_in(&folder, &other).refused(2, &["other.html", "--force"]);
}
