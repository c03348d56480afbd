//! Worlds that are not mazes.

use std::fs;

use crate::{CORRIDOR, folder, tolman, tolman_fed, tolman_in};

/// A passage of 4 × 1 m, off the origin.
const PASSAGE: &str = r#"{"format": "tolman-world", "version": 1,
    "polylines": [{"points": [[-1, 2], [3, 2], [3, 3], [-1, 3]], "closed": true}],
    "zones": [{"name": "destination", "areas": [{"disc": {"centre": [2.4, 2.5], "radius": 0.4}}]},
              {"name": "start", "areas": [{"disc": {"centre": [-0.5, 2.5], "radius": 0.2}}]}]}"#;

const YAML: &str = "image: hall.pgm\nresolution: 0.5\norigin: [-1, -1, 0]\nnegate: 0\n\
                    occupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// The same passage as a grid: unknown all round.
const PGM: &str = "P2\n8 4\n255\n205 205 205 205 205 205 205 205\n254 254 254 254 254 254 254 254\n\
                   254 254 254 254 254 254 254 254\n0 0 0 0 0 0 0 0\n";

fn with_worlds(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    for (file, text) in [
        ("passage.json", PASSAGE),
        ("hall.yaml", YAML),
        ("hall.pgm", PGM),
        ("corridor.maze", CORRIDOR),
    ] {
        fs::write(folder.join(file), text).unwrap();
    }
    folder
}

#[test]
fn a_robot_runs_in_a_world_file_and_in_an_occupancy_grid() {
    let folder = with_worlds("world-run");
    for world in [
        &["--world", "passage.json", "--start", "marked"][..],
        &[
            "--world",
            "hall.yaml",
            "--goal",
            "2.4,0,0.4",
            "--start",
            "-0.5,0",
        ],
    ] {
        let looks = [
            "--replay",
            "run.html",
            "--svg",
            "run.svg",
            "--trace",
            "run.jsonl",
        ];
        let run = [&["run", "wall-follow"], world, &looks[..]].concat();
        let told = tolman_in(&folder, &run).done();
        assert!(told.contains("reached the destination"), "{told}");
        let picture = fs::read_to_string(folder.join("run.svg")).unwrap();
        assert!(picture.contains("trajectory"));
        let again = ["replay", "run.jsonl", "--out", "run.html"];
        tolman_in(&folder, &again).done();
    }
}

#[test]
fn a_map_of_a_world_is_learned_and_followed_there_alone() {
    let folder = with_worlds("world-learn");
    let learn = ["learn", "--system", "mslst", "--world", "passage.json"];
    let few = [
        "--set",
        "scan_steps=300",
        "--set",
        "graph_actions=80",
        "--out",
        "map.json",
    ];
    tolman_in(&folder, &[&learn[..], &few].concat()).done();
    let drive = ["drive", "--map", "map.json", "--steps", "3000", "--world"];
    let told = tolman_in(&folder, &[&drive[..], &["passage.json"]].concat()).done();
    assert!(told.contains("mslst is done"), "{told}");
    let show = [
        "map",
        "show",
        "map.json",
        "--world",
        "passage.json",
        "--svg",
        "map.svg",
    ];
    tolman_in(&folder, &show).done();
    let check = ["map", "check", "map.json", "--world", "passage.json"];
    tolman_in(&folder, &check).refused(1, &["places for each true one"]);
    let moved = PASSAGE.replace("[3, 2], [3, 3]", "[4, 2], [4, 3]");
    fs::write(folder.join("passage.json"), moved).unwrap();
    let parts = ["passage.json has been drawn again", "--anyway"];
    tolman_in(&folder, &[&drive[..], &["passage.json"]].concat()).refused(2, &parts);
    let maze = ["drive", "--map", "map.json", "--maze", "corridor.maze"];
    tolman_in(&folder, &maze).refused(2, &["learned in passage.json", "--anyway"]);
}

#[test]
fn a_map_of_cpm_says_what_it_can_of_a_world() {
    let folder = folder("world-cpm");
    let world = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../mazes/worlds/corridors.json"
    );
    let learn = "learn --system cpm-better --robot laser-pioneer --steps 1500 --out map.json --replay map.html --world";
    let arguments: Vec<&str> = learn.split(' ').chain([world]).collect();
    tolman_in(&folder, &arguments).failed(1, &["ran out of time"]);
    let replay = fs::read_to_string(folder.join("map.html")).unwrap();
    assert!(replay.contains("places on the map"));
    let check = ["map", "check", "map.json", "--world", world];
    tolman_in(&folder, &check).refused(1, &["unfinished", "% of the true ways"]);
    let show = [
        "map", "show", "map.json", "--svg", "map.svg", "--world", world,
    ];
    tolman_in(&folder, &show).refused(2, &["has no positions of its junctions", "--svg"]);
}

#[test]
fn what_needs_a_maze_says_so() {
    let folder = with_worlds("world-maze");
    let refused = |arguments: &[&str], part: &str| {
        let world = [arguments, &["--world", "passage.json"]].concat();
        tolman_in(&folder, &world).refused(2, &[part, "--maze"]);
    };
    refused(&["run", "oracle"], "the oracle needs a maze of cells");
    refused(
        &["run", "unlocalized-oracle"],
        "the oracle needs a maze of cells",
    );
    let learn = [
        "learn",
        "--system",
        "diktiometry-better",
        "--out",
        "map.json",
    ];
    refused(&learn, "the diktiometry's office needs a maze of cells");
}

#[test]
fn a_world_that_does_not_serve_is_refused() {
    let folder = with_worlds("world-refused");
    let refused = |more: &[&str], parts: &[&str]| {
        tolman_in(&folder, &[&["run", "avoid"], more].concat()).refused(2, parts);
    };
    refused(&[], &["--maze <FILE>|--world <FILE>"]);
    refused(
        &["--maze", "corridor.maze", "--world", "passage.json"],
        &["cannot be used with"],
    );
    refused(
        &["--maze", "corridor.maze", "--goal", "1,1"],
        &["--goal is only for --world", "G"],
    );
    refused(
        &["--maze", "corridor.maze", "--corridor", "1"],
        &["--corridor", "corridor_width"],
    );
    refused(&["--world", "none.json"], &["none.json"]);
    refused(
        &["--world", "corridor.maze"],
        &["corridor.maze is a maze", "--maze", "docs/worlds.md"],
    );
    refused(
        &["--world", "hall.yaml"],
        &["hall.yaml", "no zone `destination`", "--goal X,Y"],
    );
    refused(
        &["--world", "hall.yaml", "--goal", "9,9"],
        &["nowhere outside the destination"],
    );
    refused(
        &["--world", "hall.yaml", "--goal", "9"],
        &["--goal", "expected X,Y"],
    );
    refused(
        &["--world", "passage.json", "--goal", "0,0"],
        &["already", "leave --goal out"],
    );
    refused(
        &["--world", "passage.json", "--corridor", "0.3"],
        &["0.3 m wide", "--corridor"],
    );
    refused(
        &["--world", "passage.json", "--corridor", "no"],
        &["`no` is not a finite number"],
    );
    fs::write(folder.join("hall.pgm"), "P2 8 4 255 254").unwrap();
    let torn = ["--world", "hall.yaml", "--goal", "2,0"];
    refused(&torn, &["hall.pgm", "byte 14", "with 1 of 32 values"]);
    fs::write(folder.join("hall.yaml"), YAML.replace("0.5", "half")).unwrap();
    refused(&torn, &["hall.yaml", "line 2", "`resolution` is `half`"]);
}

#[test]
fn a_world_may_come_from_standard_input() {
    let run = [
        "run", "avoid", "--world", "-", "--start", "marked", "--json",
    ];
    let told = tolman_fed(PASSAGE, &run).done();
    assert!(told.contains("\"maze\": \"standard input\""), "{told}");
    tolman(&["map", "check", "x.json"]).refused(2, &["--maze <FILE>|--world <FILE>"]);
}
