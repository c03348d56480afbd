//! The better MSLST by the command: it learns a maze, and its map is looked at, checked and driven
//! by.

use std::fs;

use serde_json::Value;

use crate::{CORRIDOR, folder, tolman_in};

const LEARN: [&str; 7] = [
    "learn",
    "--system",
    "mslst-better",
    "--maze",
    "corridor.maze",
    "--out",
    "map.json",
];

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn a_map_is_learned_looked_at_and_driven_by() {
    let folder = folder("mslst-better");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let looks = ["--json", "--replay", "learned.html"];
    let told = json(&tolman_in(&folder, &[&LEARN[..], &looks].concat()).done());
    assert_eq!(told["complaint"], Value::Null, "{told}");
    let first = fs::read(folder.join("map.json")).unwrap();
    tolman_in(&folder, &LEARN).done();
    let again = fs::read(folder.join("map.json")).unwrap();
    assert_eq!(again, first, "the same seed");

    let show = ["map", "show", "map.json", "--maze", "corridor.maze"];
    let drawn = ["--svg", "map.svg", "--json"];
    let shown = json(&tolman_in(&folder, &[&show[..], &drawn].concat()).done());
    assert!(shown["places"].as_u64().unwrap() >= 3, "{shown}");
    assert!(shown["error_m"].as_f64().unwrap() < 0.2, "{shown}");
    assert!(
        !shown["goal_places"].as_array().unwrap().is_empty(),
        "{shown}"
    );
    let drawing = fs::read_to_string(folder.join("map.svg")).unwrap();
    assert!(drawing.starts_with("<svg"));
    let told = tolman_in(&folder, &["map", "plan", "map.json"]).done();
    assert!(told.contains(" m, to place "), "{told}");
    let check = ["map", "check", "map.json", "--maze", "corridor.maze"];
    let told = tolman_in(&folder, &check).done();
    assert!(told.contains("is right"), "{told}");

    let drive = ["drive", "--map", "map.json", "--maze", "corridor.maze"];
    let looks = ["--seed", "5", "--replay", "drive.html", "--json"];
    let told = json(&tolman_in(&folder, &[&drive[..], &looks].concat()).done());
    assert_eq!(told["reached"], true, "{told}");
}

#[test]
fn a_map_that_is_unfinished_spoiled_or_of_another_maze_is_told_of() {
    let folder = folder("mslst-better-unfinished");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let few = [&LEARN[..], &["--steps", "1"]].concat();
    tolman_in(&folder, &few).failed(1, &["map.json is wrong or unfinished", "ran out of time"]);
    let check = ["map", "check", "map.json", "--maze", "corridor.maze"];
    tolman_in(&folder, &check).refused(1, &["wrong or unfinished"]);
    let plan = ["map", "plan", "map.json", "--to", "999"];
    tolman_in(&folder, &plan).refused(2, &["no place 999"]);
    let off = [&LEARN[..], &["--set", "diameter=-1"]].concat();
    tolman_in(&folder, &off).refused(2, &["`diameter` is -1; give a number from 0.05 to 5"]);
    let unknown = [&LEARN[..], &["--set", "patience=1"]].concat();
    tolman_in(&folder, &unknown).refused(2, &["no setting patience", "odometry_sd"]);
    let text = fs::read_to_string(folder.join("map.json")).unwrap();
    let spoiled = text.replace("\"cell\":0.05", "\"cell\":0.5");
    fs::write(folder.join("map.json"), spoiled).unwrap();
    tolman_in(&folder, &["map", "show", "map.json"]).refused(2, &["cells are 0.5 m wide"]);
}
