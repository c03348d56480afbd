use std::fs;

use tolman_maze::Direction::{East, North, South, West};
use tolman_maze::{Cell, Direction, Grid, Maze};

use crate::{folder, tolman_in};

/// A loop with two dead ends; the goal is one of them.
const RING: &str = "\
o---o---o---o---o
|   |         G |
o   o   o---o---o
|       |       |
o   o---o   o   o
|       |   |   |
o---o   o   o   o
|               |
o---o---o---o---o
";

#[test]
fn a_maze_is_surveyed_looked_at_planned_on_and_gone_on_with() {
    let folder = folder("survey");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let survey = [
        "learn",
        "--system",
        "diktiometry-better",
        "--maze",
        "ring.maze",
        "--set",
        "colours=6",
        "--set",
        "moves=80",
        "--out",
        "ring.json",
    ];
    let told = tolman_in(&folder, &survey).done();
    assert!(
        told.contains("80 moves:") && told.contains("purity 1.000"),
        "{told}"
    );
    let first = fs::read(folder.join("ring.json")).unwrap();
    tolman_in(&folder, &survey).done();
    assert_eq!(fs::read(folder.join("ring.json")).unwrap(), first);

    let on = [
        "learn",
        "--system",
        "diktiometry-better",
        "--maze",
        "ring.maze",
        "--from",
        "ring.json",
        "--set",
        "moves=60",
        "--seed",
        "2",
        "--out",
        "on.json",
    ];
    let told = tolman_in(&folder, &on).done();
    assert!(
        told.contains("140 moves:") && told.contains("purity 1.000"),
        "{told}"
    );

    let show = [
        "map",
        "show",
        "on.json",
        "--maze",
        "ring.maze",
        "--svg",
        "on.svg",
        "--json",
    ];
    let shown = tolman_in(&folder, &show).done();
    let shown: serde_json::Value = serde_json::from_str(&shown).unwrap();
    let places = shown["places"].as_array().unwrap();
    let svg = fs::read_to_string(folder.join("on.svg")).unwrap();
    assert!(svg.starts_with("<svg"));
    let told = tolman_in(&folder, &["map", "show", "on.json"]).done();
    assert!(told.contains("140 moves"), "{told}");

    // To every place there is a way, and it ends there.
    for place in places {
        let id = place["id"].to_string();
        let plan = tolman_in(
            &folder,
            &["map", "plan", "on.json", "--from", "0", "--to", &id],
        );
        let plan = plan.done();
        let end = plan.lines().last().map(str::to_owned).unwrap_or_default();
        assert!(
            end.contains(&format!("to place {id} ("))
                || id == "0" && end.contains("ends where it begins"),
            "{plan}"
        );
    }
    let refused = ["map", "plan", "on.json", "--to", "999"];
    tolman_in(&folder, &refused).refused(2, &["no place 999", "choose one of"]);
}

#[test]
fn a_map_says_which_diktiometry_learned_it() {
    let folder = folder("which diktiometry");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    let system = |file: &str| {
        let shown = carry_out(&format!("map show {file} --json")).done();
        let shown: serde_json::Value = serde_json::from_str(&shown).unwrap();
        shown["system"].as_str().unwrap().to_owned()
    };
    for name in ["diktiometry", "diktiometry-better"] {
        let learn = format!("learn --system {name} --maze ring.maze --set moves=5");
        carry_out(&format!("{learn} --out {name}.json")).failed(1, &["wrong or unfinished"]);
        assert_eq!(system(&format!("{name}.json")), name);
        let on = format!("learn --system {name} --maze ring.maze --from {name}.json");
        carry_out(&format!("{on} --set moves=2 --out on.json")).failed(1, &["wrong or unfinished"]);
        assert_eq!(system("on.json"), name);
    }
    // Earlier versions had one name for both, and merged by looks.
    let better = fs::read_to_string(folder.join("diktiometry-better.json")).unwrap();
    let former = better.replacen("diktiometry-better", "diktiometry", 1);
    let former = former.replacen("\"version\":3", "\"version\":2", 1);
    fs::write(folder.join("former.json"), former).unwrap();
    assert_eq!(system("former.json"), "diktiometry-better");
    let on = "learn --maze ring.maze --from former.json --set moves=2 --out on.json --system";
    carry_out(&format!("{on} diktiometry")).refused(2, &["give --system diktiometry-better"]);
    carry_out(&format!("{on} diktiometry-better")).failed(1, &["wrong or unfinished"]);
}

#[test]
fn a_plan_to_where_no_way_is_known_is_a_failure() {
    let folder = folder("no plan");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let survey = "learn --system diktiometry-better --maze ring.maze --set moves=1 --out ring.json";
    let survey: Vec<&str> = survey.split(' ').collect();
    tolman_in(&folder, &survey).failed(1, &["wrong or unfinished", "of the true ways"]);
    let back = "map plan ring.json --from 1 --to 0";
    let back: Vec<&str> = back.split(' ').collect();
    let told = ["no way is known on the map in ring.json"];
    tolman_in(&folder, &back).refused(1, &told);
}

/// Returns a maze of one corridor from the lower left cell: its ways, and the cells each leads.
fn corridor(legs: &[(Direction, usize)]) -> Maze {
    let mut maze = Maze::solid(Grid::new(21, 21));
    let mut at = Cell::new(0, 0);
    maze.set_start(Some((at, Direction::North)));
    for (direction, cells) in legs {
        for _ in 0..*cells {
            maze.set_wall(at, *direction, false);
            at = maze.beside(at, *direction).unwrap();
        }
    }
    maze
}

#[test]
fn a_map_that_grows_without_end_is_given_up() {
    let folder = folder("endless");
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    // It turns both ways, so that its turns alone do not prove it to be one loop.
    let legs = [
        (East, 20),
        (North, 10),
        (West, 10),
        (North, 10),
        (West, 10),
        (South, 20),
    ];
    let mut bent = corridor(&legs);
    bent.set_goals(vec![Cell::new(10, 10)]);
    fs::write(folder.join("bent.maze"), bent.to_string()).unwrap();
    let learn =
        "learn --system diktiometry-better --maze bent.maze --set moves=5000 --out bent.json";
    let told = [
        "the map grows without end: only 6 of its",
        "walls of more colours",
    ];
    carry_out(learn).failed(1, &told);
}

#[test]
fn a_survey_is_gone_on_with_by_the_robot_that_made_it_and_furnished_as_it_was() {
    let folder = folder("whose survey");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    let survey = "learn --system diktiometry-better --maze ring.maze";
    let by_laser = format!("{survey} --robot laser-pioneer --set moves=5 --out laser.json");
    carry_out(&by_laser).failed(1, &["wrong or unfinished"]);
    let on = format!("{survey} --from laser.json --out on.json");
    carry_out(&format!("{on} --set moves=2")).failed(1, &["wrong or unfinished"]);
    for (wrong, told) in [
        ("--robot camera-pioneer", "was learned by the laser Pioneer"),
        ("--set colours=3", "choose one of: heed, moves"),
    ] {
        carry_out(&format!("{on} {wrong}")).refused(2, &[told]);
    }
    let drive = "drive --map laser.json --maze ring.maze --preset paper";
    carry_out(drive).refused(2, &["leave --preset out"]);
    let in_time = format!("{survey} --steps 500 --out short.json");
    carry_out(&in_time).failed(1, &["ran out of time"]);
}

#[test]
fn a_robot_that_is_put_down_anywhere_drives_to_the_goal() {
    let folder = folder("put down");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    carry_out("learn --system diktiometry-better --maze ring.maze --set colours=6 --set moves=80 --out ring.json")
        .done();
    let drive = "drive --map ring.json --maze ring.maze --start";
    for start in ["random --seed 3", "random --seed 4", "6.1,2.2,45", "marked"] {
        let told = carry_out(&format!("{drive} {start}"));
        assert!(
            told.done().contains("diktiometry-better is done"),
            "{start}"
        );
    }
    let told = ["out of time", "the robot is not at the goal"];
    carry_out(&format!("{drive} random --seed 3 --steps 20")).failed(1, &told);
    carry_out(&format!("{drive} 4,4")).refused(2, &["(4, 4) m lies between the corridors"]);
    carry_out(&format!("{drive} 40,4")).refused(2, &["(40, 4) m", "start in a corridor"]);
    carry_out("learn --system diktiometry-better --maze ring.maze --set moves=1 --out start.json")
        .failed(1, &["of the true ways"]);
    let told = ["the goal is not on the map"];
    carry_out("drive --map start.json --maze ring.maze --start random").failed(1, &told);
}

#[test]
fn a_goal_between_two_places_is_planned_and_driven_to() {
    let folder = folder("amid");
    let amid = RING.replace("        G |", "    G     |");
    fs::write(folder.join("amid.maze"), amid).unwrap();
    let carry_out = |line: &str| tolman_in(&folder, &line.split(' ').collect::<Vec<_>>());
    carry_out("learn --system diktiometry-better --maze amid.maze --set colours=6 --set moves=80 --out amid.json")
        .done();
    let planned = carry_out("map plan amid.json");
    assert!(planned.done().contains("to the goal on the way"));
    for start in ["", " --start random --seed 3", " --start random --seed 4"] {
        let told = carry_out(&format!("drive --map amid.json --maze amid.maze{start}"));
        assert!(
            told.done().contains("diktiometry-better is done"),
            "{start}"
        );
    }
}

#[test]
fn a_file_that_is_no_sound_survey_is_refused() {
    let folder = folder("no survey");
    fs::write(folder.join("ring.maze"), RING).unwrap();
    let survey = [
        "learn",
        "--system",
        "diktiometry-better",
        "--maze",
        "ring.maze",
        "--set",
        "moves=5",
        "--out",
        "ring.json",
    ];
    tolman_in(&folder, &survey).failed(1, &["wrong or unfinished"]);
    let text = fs::read_to_string(folder.join("ring.json")).unwrap();
    let check = |changed: &str, expect: &str| {
        fs::write(folder.join("changed.json"), changed).unwrap();
        let on = "learn --system diktiometry-better --maze ring.maze --from changed.json --out never.json";
        let on: Vec<&str> = on.split(' ').collect();
        tolman_in(&folder, &on).refused(2, &["changed.json", expect]);
        assert!(!folder.join("never.json").exists());
    };
    check("{}", "not a learned map");
    check(&text[..text.len() - 40], "this map is cut off");
    check(
        &text.replacen("\"version\":3", "\"version\":7", 1),
        "version is 7",
    );
    check(
        &text.replacen("\"moves\":5,", "\"moves\":9,", 1),
        "cut off: it has 5 of 9 moves",
    );
    tolman_in(&folder, &["learn", "--out", "never.json"]).refused(2, &["--maze"]);
    for (former, now) in [
        (
            &["survey", "--maze", "ring.maze"][..],
            "tolman learn --system diktiometry-better",
        ),
        (&["solve", "--map", "map.json"], "tolman drive"),
        (&["cpm", "solve", "--map", "map.json"], "tolman drive"),
        (&["cpm", "learn"], "tolman learn --system cpm-better"),
        (&["cpm", "distinct", "a.maze"], "tolman maze distinct"),
    ] {
        tolman_in(&folder, former).refused(2, &[now]);
    }
}
