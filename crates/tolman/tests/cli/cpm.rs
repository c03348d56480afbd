use std::fs;

use crate::{CORRIDOR, folder, tolman_in};

/// A junction with a dead end to the goal.
const MAZE: &str = "\
name = Fork
corridor_width = 0.25
start = 0 0 north

o---o---o---o
|           |
o   o---o   o
|   | G |   |
o   o   o   o
| S |       |
o---o---o---o
";

#[test]
fn a_map_is_learned_looked_at_and_driven_by() {
    let folder = folder("cpm");
    fs::write(folder.join("fork.maze"), MAZE).unwrap();
    let learn = ["cpm", "learn", "--maze", "fork.maze", "--out", "map.json"];
    let told = tolman_in(&folder, &learn).done();
    assert!(told.contains("clusters"), "{told}");
    let first = fs::read(folder.join("map.json")).unwrap();
    tolman_in(&folder, &learn).done();
    let again = fs::read(folder.join("map.json")).unwrap();
    assert_eq!(again, first, "the same seed");

    let show = [
        "map",
        "show",
        "map.json",
        "--maze",
        "fork.maze",
        "--svg",
        "map.svg",
    ];
    let told = tolman_in(&folder, &show).done();
    assert!(told.contains("observations from the start"), "{told}");
    let svg = fs::read_to_string(folder.join("map.svg")).unwrap();
    assert!(svg.contains("A0") && svg.contains("goal"), "{svg}");

    let solve = [
        "cpm",
        "solve",
        "--map",
        "map.json",
        "--maze",
        "fork.maze",
        "--json",
    ];
    let told = tolman_in(&folder, &solve).done();
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(told["reached"], true, "{told}");

    // The file is cut off, of another time, of another maze.
    let text = String::from_utf8(first).unwrap();
    fs::write(folder.join("cut.json"), &text[..text.len() / 2]).unwrap();
    tolman_in(&folder, &["map", "show", "cut.json"]).refused(2, &["cut.json", "line 1"]);
    let later = text.replace("\"version\":1", "\"version\":2");
    fs::write(folder.join("later.json"), later).unwrap();
    let refused = ["version is 2", "update tolman"];
    tolman_in(&folder, &["map", "show", "later.json"]).refused(2, &refused);
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let elsewhere = [
        "cpm",
        "solve",
        "--map",
        "corridor.maze",
        "--maze",
        "fork.maze",
    ];
    tolman_in(&folder, &elsewhere).refused(2, &["corridor.maze", "tolman cpm learn"]);
}
