//! Systems as processes of their own, and the complete bodies that drive with them.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::{Ended, folder, tolman_in};

fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// Returns the words by which the brain of a body ends its tasks.
fn verdicts(said: &str) -> Vec<Value> {
    let lines = said
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap());
    lines
        .filter_map(|mut line| line.get_mut("ended").map(Value::take))
        .collect()
}

fn learns_and_goes_home(said: &str) {
    let [explored, home] = verdicts(said).try_into().unwrap();
    assert_eq!(explored["task"], "explore");
    assert_eq!(explored["verdict"]["map"], "right", "{explored}");
    assert_eq!(home["task"], "reach-goal");
    assert_eq!(home["standing"], "done", "{home}");
}

#[test]
fn the_body_in_python_learns_its_maze() {
    if Command::new("python3").arg("-V").output().is_err() {
        // Past the test harness, which would keep it to itself.
        let _ = std::io::stderr().write_all(b"SKIPPED: python3 is not there\n");
        return;
    }
    let body = examples().join("body.py");
    let lines = fs::read_to_string(&body).unwrap().lines().count();
    assert!(lines <= 60, "{lines} lines");
    let tolman = env!("CARGO_BIN_EXE_tolman");
    let run = Command::new("python3")
        .arg(body)
        .arg(tolman)
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    learns_and_goes_home(&String::from_utf8(run.stdout).unwrap());
}

#[test]
fn the_body_in_cpp_learns_its_maze() {
    if Command::new("g++").arg("--version").output().is_err() {
        let _ = std::io::stderr().write_all(b"SKIPPED: g++ is not there\n");
        return;
    }
    let folder = folder("brain-cpp");
    let mut build = Command::new("g++");
    build.args([
        "-std=c++17",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-O1",
        "-o",
        "body",
    ]);
    build.arg(examples().join("body.cpp")).current_dir(&folder);
    assert!(build.status().unwrap().success());
    // As its first lines say.
    let line = "mkfifo back && ./body < back | \"$TOLMAN\" brain --system mslst-better --robot \"$ROBOT\" \
                --task explore --task reach-goal > back";
    let mut run = Command::new("sh");
    run.args(["-c", line]).current_dir(&folder);
    run.env("TOLMAN", env!("CARGO_BIN_EXE_tolman"))
        .env("ROBOT", examples().join("robot.toml"));
    let run = run.output().unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    learns_and_goes_home(&String::from_utf8(run.stderr).unwrap());
}

/// Lets a brain read these lines.
fn brain(name: &str, measures: &str, lines: &str) -> Ended {
    let folder = folder(name);
    fs::write(folder.join("robot.toml"), measures).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_tolman"));
    command.args([
        "brain",
        "--system",
        "mslst-better",
        "--robot",
        "robot.toml",
        "--task",
        "explore",
    ]);
    command.current_dir(&folder);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // A brain that has refused its measures reads nothing.
    let _ = child.stdin.take().unwrap().write_all(lines.as_bytes());
    child.wait_with_output().unwrap().into()
}

const MEASURES: &str = "\
diameter = 0.25
corridor_width = 0.5
compass_error = 0.07
odometry_error = 0.05
[laser]
beams = 8
max_range = 2.0
";

#[test]
fn a_bad_line_ends_the_brain_and_is_named() {
    let cases = [
        (
            "{\"sensing\":{\"time_us\":1,\"ranges\":[NaN]}}\n",
            2,
            "line 1 of the body is no message",
        ),
        (
            "{\"sensing\":{\"time_us\":1,\"ranges\":[1,2]}}\n",
            2,
            "line 1 of the body has 2 ranges",
        ),
        (
            "{\"sensing\":{\"time_us\":5}}\n{\"sensing\":{\"time_us\":4}}\n",
            2,
            "line 2 of the body is from 4 µs",
        ),
        (
            "{\"sensing\":{\"time_us\":5}}\n",
            1,
            "lines end after line 1",
        ),
    ];
    for (lines, code, expected) in cases {
        let ended = brain("brain-bad", MEASURES, lines);
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        assert!(ended.err.contains(expected), "{}", ended.err);
        let last: Value = serde_json::from_str(ended.out.lines().last().unwrap()).unwrap();
        assert!(last["stop"].as_str().unwrap().contains(expected), "{last}");
    }
}

#[test]
fn measures_that_fit_no_robot_are_refused_before_anything_moves() {
    let cases = [
        (
            MEASURES.replace("0.25", "0.75"),
            "a `corridor_width` above the `diameter`",
        ),
        (
            MEASURES.replace("max_range = 2.0", "max_range = 0.3"),
            "it needs to see from",
        ),
        (
            MEASURES.replace("odometry_error = 0.05\n", ""),
            "needs `odometry_error`",
        ),
        (MEASURES.replace("beams", "rays"), "unknown field `rays`"),
    ];
    for (measures, expected) in cases {
        let ended = brain("brain-measures", &measures, "");
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains(expected), "{}", ended.err);
        assert_eq!(ended.out, "");
    }
}

#[test]
fn a_run_that_somebody_watched_is_judged() {
    let folder = folder("brain-judge");
    let maze = "name = Way\nstart = 0 0 east\n\n+---+---+\n| S   G |\n+---+---+\n";
    fs::write(folder.join("way.maze"), maze).unwrap();
    let run = |links: &str| {
        format!(
            "{{\"pitch\":1,\"path\":[[0.5,0.5],[1.5,0.5]],\
             \"actions\":[{{\"motions\":0,\"visits\":1,\"place\":null}},{{\"motions\":1,\"visits\":2,\"place\":null}}],\
             \"visits\":{{\"naming\":\"each_arrival\",\"places\":[0,1]}},\
             \"map\":{{\"places\":[{{\"id\":0,\"position\":null,\"landmark\":\"Start\"}},{{\"id\":1,\"position\":null,\"landmark\":\"Goal\"}}],\"links\":{links}}}}}"
        )
    };
    let judge = |links: &str| {
        fs::write(folder.join("run.json"), run(links)).unwrap();
        tolman_in(
            &folder,
            &[
                "judge",
                "run.json",
                "--system",
                "cpm-better",
                "--maze",
                "way.maze",
            ],
        )
    };
    assert_eq!(judge("[[0,1],[1,0]]").done(), "the map is right\n");
    judge("[]").refused(1, &["it has no links"]);
}
