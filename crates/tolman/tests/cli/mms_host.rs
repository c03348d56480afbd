//! Mice as programs of their own: shell scripts.

use crate::{folder, tolman_in};

/// 2 × 2: the middle is everything, so that the first movement is at the goal.
const SQUARE: &str = "+---+---+\n|     G |\n+   +   +\n| S |   |\n+---+---+\n";

/// 4 × 4 with the goal in the middle: one cell east of the second cell north of the start.
pub(crate) const MIDDLE: &str = "\
+---+---+---+---+
|               |
+   +---+---+   +
|   | G   G |   |
+   +   +   +   +
|     G   G |   |
+   +---+---+   +
| S |           |
+---+---+---+---+
";

const SOLVER: &str = "\
ask() { echo \"$1\"; read -r reply; }
echo 'setColor 0 0 g'
ask moveForward
ask turnRight
ask moveForward
ask 'getStat score'
echo \"heard $reply\" >&2
";

fn host_in(name: &str, script: &str, mazes: &[(&str, &str)], more: &[&str]) -> crate::Ended {
    let folder = folder(name);
    std::fs::write(folder.join("mouse.sh"), script).unwrap();
    std::fs::create_dir(folder.join("mazes")).unwrap();
    for (name, maze) in mazes {
        std::fs::write(folder.join("mazes").join(name), maze).unwrap();
    }
    let mut arguments = vec!["mms-host", "--mouse", "sh mouse.sh", "--maze", "mazes"];
    arguments.extend(more);
    tolman_in(&folder, &arguments)
}

#[test]
fn a_mouse_is_scored_in_half_steps_and_in_cells() {
    let told = host_in("solver", SOLVER, &[("middle.maze", MIDDLE)], &["--log"]);
    assert_eq!(told.code, Some(0));
    // Half-steps: 2 + 2 effective, a turn, and a tenth of it; cells: 1 + 1 and a turn.
    assert_eq!(
        told.out,
        "mazes/middle.maze: solved, score 5.5 (3.3 in cells), 3 movements, 0 crashes, done\n"
    );
    assert_eq!(told.err, "heard 5.5\n");
}

#[test]
fn a_folder_of_mazes_ends_in_a_summary() {
    let mazes = [("b.maze", MIDDLE), ("a.maze", SQUARE), (".hidden", "?")];
    let told = host_in("folder-of-mazes", SOLVER, &mazes, &["--jobs", "2"]);
    let lines: Vec<&str> = told.out.lines().collect();
    assert!(lines[0].starts_with("mazes/a.maze: solved"), "{}", told.out);
    assert!(lines[1].starts_with("mazes/b.maze: solved"), "{}", told.out);
    assert!(
        lines[2].starts_with("2 of 2 solved, mean score"),
        "{}",
        told.out
    );
}

#[test]
fn a_mouse_that_solves_some_mazes_fails_with_their_number() {
    // To the north of the start, and no farther: that is the goal of the smaller maze alone.
    let script = "echo moveForward; read -r reply";
    let mazes = [("a.maze", SQUARE), ("b.maze", MIDDLE)];
    let told = host_in("one-of-two", script, &mazes, &["--time-limit", "5"]);
    let told = told.failed(1, &["the mouse did not solve 1 of 2 mazes"]);
    assert!(told.contains("1 of 2 solved"), "{told}");
}

#[test]
fn a_mouse_that_does_nothing_is_stopped() {
    for (name, script, ended) in [
        ("sleeper", "sleep 60", "out_of_time"),
        // Asks and never listens, until the pipe is full.
        ("deaf", "while :; do echo wallFront; done", "out_of_time"),
        (
            "dervish",
            "while :; do echo turnLeft; read -r _; done",
            "out_of_movements",
        ),
        (
            "ram",
            "while :; do echo moveForward; read -r _; done",
            "out_of_movements",
        ),
        (
            "babbler",
            "head -c 100000 /dev/zero; sleep 60",
            "line_too_long",
        ),
        ("failing", "exit 3", "failed"),
        ("idle", "echo hello", "done"),
    ] {
        // On a busy machine a move may take longer than it should.
        let seconds = if ended == "out_of_time" { "1" } else { "30" };
        let limits = ["--json", "--time-limit", seconds, "--move-limit", "50"];
        let told = host_in(name, script, &[("middle.maze", MIDDLE)], &limits);
        let told = told.failed(1, &["did not solve mazes/middle.maze"]);
        let told: serde_json::Value = serde_json::from_str(&told).unwrap();
        assert_eq!(told["ended"], ended, "{name}");
        assert_eq!(told["solved"], false, "{name}");
        assert!((told["score"].as_f64().unwrap() - 2000.0).abs() < 1e-6);
    }
}

#[test]
fn what_cannot_be_hosted_is_refused() {
    let folder = folder("unhosted");
    std::fs::write(folder.join("a.maze"), MIDDLE).unwrap();
    std::fs::create_dir(folder.join("empty")).unwrap();
    let refused = |mouse: &str, maze: &str, parts: &[&str]| {
        tolman_in(&folder, &["mms-host", "--mouse", mouse, "--maze", maze]).refused(2, parts);
    };
    refused("", "a.maze", &["empty", "name a program"]);
    refused(
        "no-such-mouse",
        "a.maze",
        &["`no-such-mouse` does not start"],
    );
    refused("sh 'mouse", "a.maze", &["quotation mark"]);
    refused("sh mouse", "empty", &["holds no file"]);
    refused("sh mouse", "b.maze", &["b.maze"]);
}

#[test]
fn our_own_mouse_solves_a_folder() {
    let folder = folder("own-mouse");
    for (name, maze) in [("a.maze", MIDDLE), ("b.maze", SQUARE)] {
        std::fs::write(folder.join(name), maze).unwrap();
    }
    let mouse = format!("'{}' mouse --mms", env!("CARGO_BIN_EXE_tolman"));
    let told = tolman_in(
        &folder,
        &["mms-host", "--mouse", &mouse, "--maze", ".", "--log"],
    );
    assert_eq!(told.code, Some(0), "{}", told.err);
    assert!(told.out.contains("2 of 2 solved"), "{}", told.out);
    assert!(told.out.contains("0 crashes, done"), "{}", told.out);
    assert!(told.err.contains("the best possible"), "{}", told.err);
    tolman_in(&folder, &["mouse", "--mms", "a.maze"]).refused(2, &["--mms"]);
    tolman_in(&folder, &["mouse"]).refused(2, &["FILE|DIR"]);
}

#[test]
fn a_hosted_mouse_is_written_down_and_played() {
    let script = SOLVER.replace("ask moveForward\n", "ask wallFront\nask moveForward\n");
    let looks = ["--trace", "m.jsonl", "--replay", "m.html", "--svg", "m.svg"];
    let told = host_in("hosted-looks", &script, &[("middle.maze", MIDDLE)], &looks);
    let told = told.done();
    assert!(
        told.contains("solved") && told.contains("replay: file://"),
        "{told}"
    );
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("hosted-looks");
    let trace = std::fs::read_to_string(folder.join("m.jsonl")).unwrap();
    let lines: Vec<serde_json::Value> = trace
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(lines[0]["format"], "tolman-mouse-trace");
    assert_eq!(lines[0]["rules"], "mms");
    assert_eq!(lines.len(), 4, "three movements");
    assert_eq!(lines[1]["sensed"][0]["wall"], false);
    assert_eq!(
        (&lines[1]["move"], &lines[1]["cell"]["y"]),
        (&"moveForward".into(), &1.into())
    );
    assert_eq!(lines[3]["cell"]["x"], 1);
    for file in ["m.html", "m.svg"] {
        assert!(folder.join(file).is_file());
    }
    let told = host_in(
        "hosted-many",
        SOLVER,
        &[("a.maze", MIDDLE), ("b.maze", SQUARE)],
        &looks,
    );
    told.refused(2, &["--svg needs a single maze", "holds 2"]);
}
