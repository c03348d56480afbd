//! GNG-SLAM by the command: maps of worlds and of mazes, and data sets.

use std::fs;

use serde_json::Value;

use crate::{CORRIDOR, folder, tolman_in};

/// A room of 3 × 2.5 m with one red wall and a box.
const ROOM: &str = r#"{"format": "tolman-world", "version": 1,
    "polylines": [
        {"points": [[0, 0], [3, 0], [3, 2.5], [0, 2.5]], "closed": true, "material": {"colour": [205, 195, 170]}},
        {"points": [[0.01, 0.3], [0.01, 2.2]], "material": {"colour": [190, 60, 50]}},
        {"points": [[2.6, 2.2], [2.9, 2.2], [2.9, 2.4], [2.6, 2.4]], "closed": true, "material": {"colour": [30, 60, 190]}}],
    "zones": [{"name": "destination", "areas": [{"disc": {"centre": [0.9, 0.9], "radius": 0.4}}]},
              {"name": "start", "areas": [{"disc": {"centre": [2, 1.2], "radius": 0.2}}]}]}"#;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

const LEARN: [&str; 9] = [
    "learn",
    "--system",
    "gng-slam-better",
    "--world",
    "room.json",
    "--set",
    "quiet_looks=60",
    "--out",
    "map.json",
];

#[test]
fn a_map_of_a_room_is_learned_looked_at_and_driven_by() {
    let folder = folder("gngslam");
    fs::write(folder.join("room.json"), ROOM).unwrap();
    let looks = ["--json", "--replay", "learned.html", "--svg", "way.svg"];
    let told = json(&tolman_in(&folder, &[&LEARN[..], &looks].concat()).done());
    assert_eq!(told["complaint"], Value::Null, "{told}");
    let show = ["map", "show", "map.json", "--world", "room.json"];
    let drawn = ["--svg", "map.svg", "--json"];
    let shown = json(&tolman_in(&folder, &[&show[..], &drawn].concat()).done());
    assert!(shown["places"].as_u64().unwrap() > 10, "{shown}");
    assert!(shown["error_m"].as_f64().unwrap() < 0.3, "{shown}");
    assert!(
        fs::read_to_string(folder.join("map.svg"))
            .unwrap()
            .starts_with("<svg")
    );
    let told = tolman_in(&folder, &["map", "plan", "map.json"]).done();
    assert!(told.contains(" m to place "), "{told}");
    let check = ["map", "check", "map.json", "--world", "room.json"];
    let told = tolman_in(&folder, &check).done();
    assert!(told.contains("is right"), "{told}");

    let drive = [
        "drive",
        "--map",
        "map.json",
        "--world",
        "room.json",
        "--seed",
        "5",
    ];
    let looks = ["--replay", "drive.html", "--trace", "drive.jsonl", "--json"];
    let told = json(&tolman_in(&folder, &[&drive[..], &looks].concat()).done());
    assert_eq!(told["reached"], true, "{told}");
    let replay = ["replay", "drive.jsonl", "--out", "again.html"];
    tolman_in(&folder, &replay).done();

    // It goes on with the map.
    let on = [
        "--from",
        "map.json",
        "--set",
        "quiet_looks=5",
        "--seed",
        "3",
    ];
    tolman_in(&folder, &[&LEARN[..], &on].concat()).done();
}

#[test]
fn a_map_that_is_unfinished_or_of_another_world_is_told_of() {
    let folder = folder("gngslam-unfinished");
    fs::write(folder.join("room.json"), ROOM).unwrap();
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let few = [&LEARN[..], &["--steps", "60"]].concat();
    tolman_in(&folder, &few).failed(1, &["map.json is wrong or unfinished", "ran out of time"]);
    let check = ["map", "check", "map.json", "--world", "room.json"];
    tolman_in(&folder, &check).refused(1, &["wrong or unfinished"]);
    let other = ["map", "check", "map.json", "--maze", "corridor.maze"];
    tolman_in(&folder, &other).refused(1, &["learned in another world"]);
    let drive = ["drive", "--map", "map.json", "--maze", "corridor.maze"];
    tolman_in(&folder, &drive).refused(2, &["room.json", "--anyway"]);
    let plan = ["map", "plan", "map.json", "--to", "999"];
    tolman_in(&folder, &plan).refused(2, &["no place 999"]);
}

#[test]
fn a_laser_pioneer_learns_a_maze() {
    let folder = folder("gngslam-maze");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let learn = [
        "learn",
        "--system",
        "gng-slam-better",
        "--robot",
        "laser-pioneer",
    ];
    let there = ["--maze", "corridor.maze", "--out", "map.json"];
    tolman_in(&folder, &[&learn[..], &there].concat()).done();
    // Its places are points on the floor, many for each true one.
    let check = ["map", "check", "map.json", "--maze", "corridor.maze"];
    tolman_in(&folder, &check).refused(1, &["places for each true one"]);
}

#[test]
fn a_data_set_is_gathered_kept_and_scored() {
    let folder = folder("gngslam-data");
    let gather = [
        "pitch",
        "gather",
        "pitch",
        "--records",
        "60",
        "--out",
        "records.jsonl",
    ];
    let told = tolman_in(&folder, &gather).done();
    let show = ["pitch", "show", "records.jsonl"];
    assert_eq!(tolman_in(&folder, &show).done(), told, "it comes back");
    let looks = ["--svg", "records.svg", "--json"];
    let shown = json(&tolman_in(&folder, &[&show[..], &looks].concat()).done());
    assert_eq!(shown["records"], 60);
    assert!(
        fs::read_to_string(folder.join("records.svg"))
            .unwrap()
            .starts_with("<svg")
    );
    let score = [
        "pitch",
        "score",
        "records.jsonl",
        "--growth-period",
        "10",
        "--json",
    ];
    let scored = json(&tolman_in(&folder, &score).done());
    assert!(scored["score"].as_f64().unwrap() > 0.0, "{scored}");
    let text = fs::read_to_string(folder.join("records.jsonl")).unwrap();
    fs::write(folder.join("half.jsonl"), &text[..text.len() / 2]).unwrap();
    tolman_in(&folder, &["pitch", "show", "half.jsonl"]).refused(2, &["half.jsonl", "line"]);
    tolman_in(&folder, &["pitch", "world", "beach"]).refused(2, &["no arena is called"]);
}
