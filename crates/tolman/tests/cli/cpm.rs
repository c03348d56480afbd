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

/// One way to the goal, without a junction.
const HOOK: &str = "\
name = Hook
corridor_width = 0.25
start = 0 0 north

o---o---o---o---o
|               |
o   o---o---o   o
| S | G         |
o---o---o---o---o
";

/// Learns a map of a maze, `map.json`.
const fn learn(maze: &str) -> [&str; 7] {
    [
        "learn",
        "--system",
        "cpm-better",
        "--maze",
        maze,
        "--out",
        "map.json",
    ]
}

/// Drives by a map.
const fn drive<'a>(map: &'a str, maze: &'a str) -> [&'a str; 5] {
    ["drive", "--map", map, "--maze", maze]
}

#[test]
fn a_map_is_learned_looked_at_and_driven_by() {
    let folder = folder("cpm");
    fs::write(folder.join("fork.maze"), MAZE).unwrap();
    let learn = learn("fork.maze");
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

    let json = [&drive("map.json", "fork.maze")[..], &["--json"]].concat();
    let told = tolman_in(&folder, &json).done();
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(told["reached"], true, "{told}");

    // The same without a learning maze.
    let unlearned = [&learn[..5], &["--preset", "unlearned", "--out", "own.json"]].concat();
    let told = tolman_in(&folder, &unlearned).done();
    assert!(told.contains("patterns, of"), "{told}");
    tolman_in(&folder, &drive("own.json", "fork.maze")).done();

    // The file is cut off, of another time, of another maze.
    let text = String::from_utf8(first).unwrap();
    fs::write(folder.join("cut.json"), &text[..text.len() / 2]).unwrap();
    let cut_off = ["cut.json", "this map is cut off", "line 1"];
    tolman_in(&folder, &["map", "show", "cut.json"]).refused(2, &cut_off);
    fs::write(folder.join("cut.json"), &text[..40]).unwrap();
    tolman_in(&folder, &["map", "show", "cut.json"]).refused(2, &cut_off);
    fs::write(folder.join("none.json"), "{}").unwrap();
    let none = ["none.json: this is not a learned map", "tolman learn"];
    tolman_in(&folder, &["map", "show", "none.json"]).refused(2, &none);
    let later = text.replace("\"version\":3", "\"version\":4");
    fs::write(folder.join("later.json"), later).unwrap();
    let refused = ["version is 4", "update tolman"];
    tolman_in(&folder, &["map", "show", "later.json"]).refused(2, &refused);
    let former = r#"{"format":"tolman-cpm","version":2,"system":"faithful"}"#;
    fs::write(folder.join("former.json"), former).unwrap();
    let refused = ["former.json", "\"tolman-cpm\"", "tolman learn"];
    tolman_in(&folder, &["map", "show", "former.json"]).refused(2, &refused);
    let told = tolman_in(&folder, &["map", "plan", "map.json"]).done();
    assert!(told.contains("observations to junction"), "{told}");
    // A drive leaves a trace that plays.
    let trace = [
        &drive("map.json", "fork.maze")[..],
        &["--trace", "drive.jsonl"],
    ]
    .concat();
    tolman_in(&folder, &trace).done();
    tolman_in(&folder, &["replay", "drive.jsonl"]).done();
    let replay = fs::read_to_string(folder.join("drive.html")).unwrap();
    assert!(replay.contains("left wheel"));
    let check = ["map", "check", "map.json", "--maze", "fork.maze"];
    assert_eq!(tolman_in(&folder, &check).done(), "map.json is right\n");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let elsewhere = drive("corridor.maze", "fork.maze");
    tolman_in(&folder, &elsewhere).refused(2, &["corridor.maze", "tolman learn"]);
}

#[test]
fn a_robot_that_knows_two_mazes_is_put_down_anywhere_in_one() {
    let folder = folder("cpm-anywhere");
    fs::write(folder.join("fork.maze"), MAZE).unwrap();
    fs::write(folder.join("hook.maze"), HOOK).unwrap();
    let learned = [
        ("fork.maze", "1", "fork.json"),
        ("hook.maze", "1", "hook.json"),
        ("hook.maze", "2", "other.json"),
    ];
    for (maze, seed, out) in learned {
        let learn = ["learn", "--system", "cpm-better"];
        let of = ["--maze", maze, "--seed", seed, "--out", out];
        let preset = match out {
            "other.json" => ["--preset", "unlearned"],
            _ => ["--preset", "learned"],
        };
        tolman_in(&folder, &[&learn[..], &of[..], &preset[..]].concat()).done();
    }
    let solve = |more: &[&str]| {
        let solve = ["drive", "--maze", "fork.maze", "--map", "fork.json"];
        tolman_in(&folder, &[&solve[..], more].concat())
    };
    let both = ["--map", "hook.json"];
    for seed in ["1", "2", "3"] {
        let random = ["--start", "random", "--seed", seed, "--json"];
        let told = solve(&[&both[..], &random[..]].concat()).done();
        let told: serde_json::Value = serde_json::from_str(&told).unwrap();
        assert_eq!(told["reached"], true, "{told}");
        assert_eq!(told["map"], "fork.json", "{told}");
    }
    // From the start, which it is not told; then askew in mid-corridor.
    let told = solve(&[&both[..], &["--start", "marked"]].concat()).done();
    let taken = "fork.json is taken for the map";
    assert!(told.contains(taken), "{told}");
    let told = solve(&["--start", "0.125,0.375,80"]).done();
    assert!(told.contains("cpm-better is done"), "{told}");

    solve(&["--map", "other.json"]).refused(2, &["other.json", "other patterns", "unlearned"]);
    solve(&["--start", "0.25,0.3"]).refused(2, &["does not fit"]);
    solve(&["--start", "9,9"]).refused(2, &["no way leads from (9, 9) m"]);
    solve(&["--start", "somewhere"]).refused(2, &["expected random, marked"]);
}

/// Checks that `tolman learn` refuses a maze, with the texts `told`.
fn refused_maze(name: &str, maze: &str, told: &[&str]) {
    let folder = folder(name);
    fs::write(folder.join("maze.maze"), maze).unwrap();
    tolman_in(&folder, &learn("maze.maze")).refused(2, told);
    assert!(!folder.join("map.json").exists());
}

#[test]
fn a_goal_that_is_walled_off_is_told() {
    let walled = MAZE.replace("| S |       |", "| S |   |   |").replace(
        "|   | G |   |\no   o   o   o",
        "|   | G |   |\no   o---o   o",
    );
    refused_maze("cpm-walled", &walled, &["no way leads from the start"]);
    let without = MAZE.replace('G', " ");
    refused_maze("cpm-no-goal", &without, &["the maze has no goal"]);
}

#[test]
fn fragments_that_look_alike_are_told() {
    let folder = folder("cpm-distinct");
    let corridor = "corridor_width = 0.25\nstart = 0 0 east\n\no---o---o---o---o---o\n| S               G |\no---o---o---o---o---o\n";
    fs::write(folder.join("corridor.maze"), corridor).unwrap();
    let alike = ["maze", "distinct", "corridor.maze", "--walks", "1"];
    tolman_in(&folder, &alike).refused(2, &["not below 0.8", "bend one of them"]);
    let none = ["maze", "distinct", "corridor.maze", "--walks", "0"];
    tolman_in(&folder, &none).refused(2, &["--walks"]);
    let below = ["maze", "distinct", "corridor.maze", "--below", "nan"];
    tolman_in(&folder, &below).refused(2, &["a number from 0 to 1"]);
}

#[test]
fn a_maze_without_junctions_is_learned_and_driven() {
    let folder = folder("cpm-corridor");
    let corridor = "start = 0 1 east\n\no---o---o---o\n| S         |\no---o---o   o\n|     G     |\no---o---o---o\n";
    fs::write(folder.join("corridor.maze"), corridor).unwrap();
    tolman_in(&folder, &learn("corridor.maze")).done();
    let told = tolman_in(&folder, &drive("map.json", "corridor.maze")).done();
    assert!(told.contains("cpm-better is done"), "{told}");
    // By this map the first fragment leads to the goal; there it leads to a junction.
    let junction = "name = Junction\nstart = 0 0 north\n\no---o---o\n|   | G |\no   o   o\n|       |\no   o   o\n| S |   |\no---o---o\n";
    fs::write(folder.join("junction.maze"), junction).unwrap();
    let elsewhere = drive("map.json", "junction.maze");
    let told = [
        "map.json was learned in corridor.maze",
        "this is Junction",
        "--anyway",
    ];
    tolman_in(&folder, &elsewhere).refused(2, &told);
    let json = [&elsewhere[..], &["--anyway", "--json"]].concat();
    let told = tolman_in(&folder, &json).failed(1, &["not at the goal of Junction"]);
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(told["reached"], false, "{told}");
}

#[test]
fn corridors_of_a_width_that_the_robot_cannot_tell_are_told() {
    for width in ["0.19", "0.31", "0.4", "1.2"] {
        let wide = MAZE.replace(
            "corridor_width = 0.25",
            &format!("corridor_width = {width}"),
        );
        let told = format!("corridors are {width} m wide");
        refused_maze(
            "cpm-width",
            &wide,
            &[&told, "sensors reach 0.25 m", "corridor_width"],
        );
    }
    let folder = folder("cpm-width-enough");
    let wide = MAZE.replace("corridor_width = 0.25", "corridor_width = 0.3");
    fs::write(folder.join("maze.maze"), wide).unwrap();
    tolman_in(&folder, &learn("maze.maze")).done();
}

/// Four cells without a wall between them, where a robot that follows corridors overlooks
/// junctions.
const ROOM: &str = "\
name = Room
corridor_width = 0.25
start = 0 0 north

o---o---o---o---o
|               |
o   o---o   o   o
|   | G         |
o   o---o---o   o
| S |           |
o---o---o---o---o
";

#[test]
fn a_map_with_other_fragments_than_there_are_is_told() {
    let folder = folder("cpm-room");
    fs::write(folder.join("room.maze"), ROOM).unwrap();
    let explore = [&learn("room.maze")[..], &["--until", "explored"]].concat();
    let told = [
        "the map in map.json is wrong or unfinished",
        "there is an open square of 2 × 2 cells",
    ];
    tolman_in(&folder, &explore).failed(1, &told);
}

#[test]
fn a_map_of_another_robot_or_maze_is_refused_or_fails_as_it_is_said() {
    let folder = folder("cpm-other");
    fs::write(folder.join("fork.maze"), MAZE).unwrap();
    let learn = learn("fork.maze");
    tolman_in(&folder, &learn).done();
    let text = fs::read_to_string(folder.join("map.json")).unwrap();
    let solve = |map: &str, maze: &str| tolman_in(&folder, &drive(map, maze));
    // Another robot's dictionary under this map, a later version, and a map of another maze.
    let key = "\"fingerprint\":\"";
    let at = text.find(key).unwrap() + key.len();
    let other = format!("{}{}{}", &text[..at], "0123456789abcdef", &text[at + 16..]);
    fs::write(folder.join("other.json"), other).unwrap();
    solve("other.json", "fork.maze").refused(2, &["other.json", "fingerprint", "changed"]);
    let later = text.replace("\"version\":3", "\"version\":4");
    fs::write(folder.join("later.json"), later).unwrap();
    solve("later.json", "fork.maze").refused(2, &["version is 4", "update tolman"]);
    let crossing = "start = 1 1 north\n\no---o---o---o\n|   | G |   |\no---o   o---o\n|     S     |\no---o   o---o\n|   |   |   |\no---o---o---o\n";
    fs::write(folder.join("crossing.maze"), crossing).unwrap();
    solve("map.json", "crossing.maze").refused(2, &["map.json was learned in Fork"]);
    let redrawn = MAZE.replace("|   | G |   |", "|   | G     |");
    fs::write(folder.join("redrawn.maze"), redrawn).unwrap();
    solve("map.json", "redrawn.maze").refused(2, &["Fork has been drawn again"]);
    let pioneer = [
        &drive("map.json", "fork.maze")[..],
        &["--robot", "laser-pioneer"],
    ]
    .concat();
    tolman_in(&folder, &pioneer).refused(2, &["a robot 0.5 m across does not fit"]);
}
