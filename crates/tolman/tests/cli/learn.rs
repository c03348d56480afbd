use std::fs;

use crate::{CORRIDOR, folder, tolman_in};

/// Learns a little of the corridor and keeps it in `map.json`.
const LEARN: [&str; 11] = [
    "learn",
    "--system",
    "mslst",
    "--maze",
    "corridor.maze",
    "--set",
    "scan_steps=300",
    "--set",
    "graph_actions=60",
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
        "drive",
        "--map",
        "map.json",
        "--maze",
        "corridor.maze",
        "--steps",
        "2000",
    ];
    let told = tolman_in(&folder, &solve).done();
    assert!(told.contains("mslst is done"), "{told}");
}

#[test]
fn what_is_no_map_is_refused() {
    let folder = folder("no-map");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let solve = ["drive", "--map", "corridor.maze", "--maze", "corridor.maze"];
    tolman_in(&folder, &solve).refused(2, &["corridor.maze is a maze", "tolman learn"]);
    tolman_in(&folder, &["map", "show", "nothing.json"]).refused(2, &["nothing.json"]);
    let unknown = [&LEARN[..], &["--set", "patience=3"]].concat();
    tolman_in(&folder, &unknown).refused(2, &["no setting patience", "threshold"]);
    let wrong = [&LEARN[..], &["--set", "memory=much"]].concat();
    tolman_in(&folder, &wrong).refused(2, &["memory=much"]);
    let other = [&LEARN[..2], &["mlsts"], &LEARN[3..]].concat();
    tolman_in(&folder, &other).refused(2, &["no system mlsts", "mslst, mslst-better, cpm"]);
    assert!(!folder.join("map.json").exists());
}
