//! Brains as programs of their own: the guide's in Python, and shell scripts.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::{folder, tolman, tolman_in};

/// A bend to the left and one to the right, each of which a wall-follower has to see.
const BENDS: &str = "\
name = Bends
start = 0 0 north

+---+---+---+
|       | G |
+   +   +   +
| S |       |
+---+---+---+
";

/// Lets a shell script drive in the maze of bends.
fn host_script(name: &str, script: &str, more: &[&str]) -> crate::Ended {
    let folder = folder(name);
    std::fs::write(folder.join("bends.maze"), BENDS).unwrap();
    std::fs::write(folder.join("brain.sh"), script).unwrap();
    let mut arguments = vec!["host", "--maze", "bends.maze", "--start", "marked"];
    arguments.extend(more);
    arguments.extend(["--", "sh", "brain.sh"]);
    tolman_in(&folder, &arguments)
}

#[test]
fn the_brain_of_the_guide_gets_to_the_goal() {
    if Command::new("python3").arg("-V").output().is_err() {
        // Past the test harness, which would keep it to itself.
        let _ =
            std::io::Write::write_all(&mut std::io::stderr(), b"SKIPPED: python3 is not there\n");
        return;
    }
    let folder = folder("host-guide");
    std::fs::write(folder.join("bends.maze"), BENDS).unwrap();
    std::fs::write(
        folder.join("brain.py"),
        tolman(&["host", "--template"]).done(),
    )
    .unwrap();
    for seed in ["1", "2", "3"] {
        let to_goal = [
            "host",
            "--maze",
            "bends.maze",
            "--seed",
            seed,
            "--json",
            "--",
            "python3",
            "brain.py",
        ];
        let told: Value = serde_json::from_str(&tolman_in(&folder, &to_goal).done()).unwrap();
        assert_eq!(told["reached"], true, "{told}");
        let [driven, shortest] = ["driven", "shortest"].map(|name| told[name].as_f64().unwrap());
        assert!((0.5..4.0).contains(&(driven / shortest)), "{told}");
    }
}

#[test]
fn the_guide_shows_the_brain_that_the_command_writes() {
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/own-robot.md");
    let guide = std::fs::read_to_string(guide).unwrap();
    let brain = tolman(&["host", "--template"]).done();
    assert_eq!(brain.lines().count(), 20);
    assert!(guide.contains(&format!("```python\n{brain}```")));
}

#[test]
fn the_example_is_the_mapper_that_the_command_writes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mapper = tolman(&["host", "--template", "mapper"]).done();
    assert!(mapper.lines().count() <= 40);
    let example = std::fs::read_to_string(root.join("crates/python/examples/mapper.py"));
    assert_eq!(example.unwrap(), mapper);
    let guide = std::fs::read_to_string(root.join("docs/arena.md")).unwrap();
    assert!(guide.contains(&format!("```python\n{mapper}```")));
}

#[test]
fn a_program_is_told_of_its_robot_and_hears_each_time_step() {
    let script = "read -r hello; echo \"$hello\" >&2\n\
                  for turn in 0.1 0.2; do read -r seen; echo \"{\\\"turn\\\": $turn, \\\"translate\\\": 0}\"; done\n\
                  read -r seen; echo \"$seen\" >&2; echo '{\"give_up\": \"it is dark\"}'\n";
    let ended = host_script("host-hello", script, &["--log"]);
    assert_eq!(ended.code, Some(1), "{}", ended.err);
    let mut lines = ended.err.lines();
    let hello: Value = serde_json::from_str(lines.next().unwrap()).unwrap();
    assert_eq!(hello["hello"]["protocol"], 1);
    assert_eq!(hello["hello"]["robot"], "laser-pioneer");
    let seen: Value = serde_json::from_str(lines.next().unwrap()).unwrap();
    assert_eq!(seen["step"], 2);
    assert_eq!(
        seen["sensing"]["scan"]["ranges"].as_array().unwrap().len(),
        72
    );
    let rest: String = lines.collect();
    assert!(
        rest.contains("gave up: it is dark, after 2 steps"),
        "{rest}"
    );
}

#[test]
fn a_program_that_fails_is_said_to() {
    let early = host_script("host-early", "read -r hello; read -r seen; exit 3\n", &[]);
    early.refused(1, &["the program ended with exit status: 3"]);
    let nonsense = "read -r hello; read -r seen; echo ahead; read -r seen\n";
    let nonsense = host_script("host-nonsense", nonsense, &[]);
    nonsense.refused(1, &["answer to step 0 is `ahead`", "{\"done\": true}"]);
    let slow = host_script("host-slow", "sleep 60\n", &["--time-limit", "1"]);
    slow.refused(1, &["the program is out of time"]);
    let done = "read -r hello; read -r seen; echo '{\"done\": true}'\n";
    let done = host_script("host-done", done, &[]);
    done.refused(1, &["is not at the goal of Bends"]);
    let still =
        "read -r hello; while read -r seen; do echo '{\"turn\": 0, \"translate\": 0}'; done\n";
    let still = host_script("host-still", still, &["--steps", "5"]);
    still.refused(1, &["out of time, after 5 steps"]);
}

#[test]
fn an_e_puck_is_driven_by_its_wheels() {
    let script = "read -r hello; echo \"$hello\" >&2; read -r seen\n\
                  echo '{\"left\": 1.0, \"right\": 1.0}'; read -r seen; echo '{\"done\": true}'\n";
    let ended = host_script("host-e-puck", script, &["--log", "--robot", "e-puck"]);
    assert_eq!(ended.code, Some(1), "{}", ended.err);
    assert!(ended.err.contains("\"robot\":\"e-puck\""), "{}", ended.err);
    assert!(
        ended.err.contains("is done, after 1 steps"),
        "{}",
        ended.err
    );
}

#[test]
fn what_cannot_be_hosted_is_refused() {
    tolman(&["host", "--maze", "mazes/none.maze", "--", "true"]).refused(2, &["none.maze"]);
    tolman(&["host", "--", "true"]).refused(2, &["--maze"]);
    let other = host_script("host-other", "", &["--robot", "elephant"]);
    other.refused(2, &["there is no robot elephant", "laser-pioneer"]);
}
