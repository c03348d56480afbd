use std::fs;

use crate::{CORRIDOR, folder, tolman_in};

/// Learns a little of the corridor and keeps it in `map.json`.
const LEARN: [&str; 9] = [
    "learn",
    "--maze",
    "corridor.maze",
    "--steps",
    "300",
    "--actions",
    "60",
    "--out",
    "map.json",
];

#[test]
fn a_map_is_learned_looked_at_and_followed() {
    let folder = folder("learn");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let told = tolman_in(&folder, &LEARN).done();
    assert!(told.contains("states"), "{told}");
    let first = fs::read(folder.join("map.json")).unwrap();
    tolman_in(&folder, &LEARN).done();
    assert_eq!(
        fs::read(folder.join("map.json")).unwrap(),
        first,
        "the same seed"
    );

    let show = [
        "map",
        "show",
        "map.json",
        "--maze",
        "corridor.maze",
        "--svg",
        "map.svg",
        "--json",
    ];
    let shown = tolman_in(&folder, &show).done();
    let shown: serde_json::Value = serde_json::from_str(&shown).unwrap();
    let nodes = shown["nodes"].as_u64().unwrap();
    assert!(
        nodes > 3 && shown["destination_nodes"].as_u64().unwrap() < nodes,
        "{shown}"
    );
    assert!(
        fs::read_to_string(folder.join("map.svg"))
            .unwrap()
            .starts_with("<svg")
    );

    let solve = [
        "solve",
        "--map",
        "map.json",
        "--maze",
        "corridor.maze",
        "--steps",
        "2000",
    ];
    let told = tolman_in(&folder, &solve).done();
    assert!(told.contains("mslst reached the destination"), "{told}");
}

#[test]
fn what_is_no_map_is_refused() {
    let folder = folder("no-map");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let solve = ["solve", "--map", "corridor.maze", "--maze", "corridor.maze"];
    tolman_in(&folder, &solve).refused(2, &["corridor.maze", "tolman learn", "line 1"]);
    tolman_in(&folder, &["map", "show", "nothing.json"]).refused(2, &["nothing.json"]);
    let threshold = [&LEARN[..], &["--threshold", "NaN"]].concat();
    tolman_in(&folder, &threshold).refused(2, &["NaN", "--threshold"]);
    assert!(!folder.join("map.json").exists());
}
