//! Where robots begin: at the maze's start, or at random.

use std::fs;

use serde_json::Value;

use crate::{CORRIDOR, folder, tolman_fed, tolman_in};

/// A ring without a start.
const RING: &str = "\
name = Ring
corridor_width = 0.3

+---+---+---+
|         G |
+   +---+   +
|   |   |   |
+   +---+   +
|           |
+---+---+---+
";

/// A room with its start on a goal.
const ON_GOAL: &str = "\
o---o---o
| G     |
o   o   o
|S G  G |
o---o---o
";

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_run_begins_at_the_start_of_the_maze() {
    let begun = |maze: &str, more: &[&str]| {
        let run = ["run", "oracle", "--maze", "-", "--json"];
        json(&tolman_fed(maze, &[&run[..], more].concat()).done())["start"].clone()
    };
    let marked = begun(CORRIDOR, &["--start", "marked"]);
    for seed in ["1", "2"] {
        assert_eq!(begun(CORRIDOR, &["--seed", seed]), marked);
    }
    assert_ne!(begun(CORRIDOR, &["--start", "random"]), marked);
    // Without a start it begins anywhere.
    let unmarked = CORRIDOR.replace('S', " ");
    let anywhere = |seed| begun(&unmarked, &["--seed", seed]);
    assert_ne!(anywhere("1"), anywhere("2"));
}

#[test]
fn a_maze_without_a_start_is_learned_and_entered() {
    let folder = folder("no-start");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    for system in ["micromouse", "cpm-better"] {
        let told = carry_out(&format!("arena ring.maze --system {system} --json"));
        let line = told.failed(0, &["corridor_width = 0.3 of Ring is ignored"]);
        assert_eq!(json(&line)["right"], true, "{system}: {line}");
    }
    carry_out("learn --system cpm-better --maze ring.maze --out map.json").done();
    let told = carry_out("drive --map map.json --maze ring.maze --seed 2").done();
    assert!(told.contains("put down at random, in cell ("), "{told}");
    carry_out("mouse --maze ring.maze").done();
    carry_out("race --maze ring.maze").done();
}

#[test]
fn a_start_on_a_goal_is_a_run_of_no_length() {
    let folder = folder("start-on-goal");
    fs::write(folder.join("room.maze"), ON_GOAL).unwrap();
    for (verb, length) in [("mouse", "0 steps, proven"), ("race", "0.000 s, proven")] {
        let told = tolman_in(&folder, &[verb, "room.maze"]).done();
        assert!(told.contains("the start is a goal"), "{verb}: {told}");
        assert!(told.contains(length), "{verb}: {told}");
    }
}

#[test]
fn a_map_with_fewer_ways_than_the_world_is_given_up() {
    let folder = folder("fewer-ways");
    let room = "o---o---o\n| S     |\no   o   o\n|     G |\no---o---o\n";
    fs::write(folder.join("room.maze"), room).unwrap();
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    carry_out("learn --system cpm-better --maze room.maze --out map.json")
        .failed(1, &["open square"]);
    carry_out("drive --map map.json --maze room.maze")
        .failed(1, &["gave up: it is not sure where it is"]);
}

#[test]
fn settings_are_listed_with_their_values() {
    let folder = folder("settings");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let told = tolman_in(&folder, &["systems", "mslst"]).done();
    assert!(told.contains("--set threshold="), "{told}");
    assert!(
        told.contains("[default]") && !told.contains("micromouse"),
        "{told}"
    );
    let all = json(&tolman_in(&folder, &["systems", "--json"]).done());
    for system in all["systems"].as_array().unwrap() {
        let name = system["name"].as_str().unwrap();
        let has = system["settings"]
            .as_object()
            .is_some_and(|all| !all.is_empty());
        let expected = system["learns"] == true && !["micromouse", "wall-belief"].contains(&name);
        assert_eq!(has, expected, "{name}");
    }
    let learn = [
        "learn",
        "--maze",
        "corridor.maze",
        "--out",
        "map.json",
        "--system",
    ];
    let asked = [&learn[..], &["mslst", "--set", "help"]].concat();
    tolman_in(&folder, &asked).refused(2, &["threshold="]);
    let none = [&learn[..], &["micromouse", "--set", "patience=3"]].concat();
    tolman_in(&folder, &none).refused(2, &["there are no settings"]);
}
