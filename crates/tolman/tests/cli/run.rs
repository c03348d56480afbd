use std::fs;

use tolman_sim::robots::LaserPioneer;

use crate::{CORRIDOR, folder, tolman, tolman_fed, tolman_in};

/// Runs a brain in the corridor with these further options.
fn run(more: &[&str]) -> crate::Ended {
    tolman_fed(
        CORRIDOR,
        &[&["run", "oracle", "--maze", "-"], more].concat(),
    )
}

#[test]
fn a_run_tells_its_outcome() {
    let told = run(&["--start", "marked"]).done();
    assert!(told.contains("reached the destination"), "{told}");
}

#[test]
fn the_same_seed_makes_the_same_run() {
    let run = |seed| {
        tolman_fed(
            CORRIDOR,
            &["run", "avoid", "--maze", "-", "--json", "--seed", seed],
        )
        .done()
    };
    assert_eq!(run("4"), run("4"));
    assert_ne!(run("4"), run("5"));
}

#[test]
fn a_run_out_of_time_fails_and_is_told() {
    let early = ["--start", "marked", "--steps", "1"];
    let parts = ["oracle did not arrive"];
    run(&early).refused(1, &parts);
    let told = run(&[&early[..], &["--json"]].concat()).failed(1, &parts);
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!(
        (&told["reached"], &told["steps"]),
        (&false.into(), &1.into())
    );
}

#[test]
fn a_picture_is_drawn() {
    let folder = folder("run");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let run = [
        "run",
        "oracle",
        "--maze",
        "corridor.maze",
        "--start",
        "marked",
    ];
    tolman_in(&folder, &[&run[..], &["--svg", "run.svg"]].concat()).done();
    let picture = fs::read_to_string(folder.join("run.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("trajectory"));
}

#[test]
fn a_run_that_is_watched_where_there_is_no_terminal_is_the_same_run() {
    for json in [&[][..], &["--json"][..]] {
        let told = run(json).done();
        assert_eq!(run(&[json, &["--live"][..]].concat()).done(), told);
    }
}

#[test]
fn an_unknown_brain_is_refused_with_those_there_are() {
    tolman(&["run", "genius", "--maze", "x"]).refused(2, &["genius", "wall-follow", "oracle"]);
}

#[test]
fn a_robot_that_does_not_fit_is_refused() {
    let narrow = CORRIDOR.replace("0.95", "0.4");
    tolman_fed(&narrow, &["run", "avoid", "--maze", "-"])
        .refused(2, &["0.4 m", "does not fit", "corridor_width"]);
}

#[test]
fn a_start_in_a_wall_or_outside_is_refused() {
    run(&["--start", "0.95,0.1"]).refused(2, &["start"]);
    run(&["--start", "-5,0.5"]).refused(2, &["start"]);
}

#[test]
fn a_start_that_is_no_place_is_refused() {
    run(&["--start", "NaN,1"]).refused(2, &["NaN"]);
    run(&["--start", "somewhere"]).refused(2, &["--start", "expected random"]);
}

#[test]
fn a_marked_start_has_to_be_marked() {
    let unmarked = CORRIDOR.replace('S', " ");
    tolman_fed(
        &unmarked,
        &["run", "avoid", "--maze", "-", "--start", "marked"],
    )
    .refused(2, &["marks no start"]);
}

#[test]
fn a_run_of_no_steps_is_refused() {
    run(&["--steps", "0"]).refused(2, &["--steps"]);
}

#[test]
fn a_start_that_leads_nowhere_is_bad_input() {
    // In the solid inside of the J, outside of it, and in its south wall.
    for (start, part) in [
        ("5,8", "no way leads from"),
        ("-3,1", "no way leads from"),
        ("1.5,0.1", "does not fit"),
    ] {
        let maze = include_str!("../../mazes/j.maze");
        let run = ["run", "avoid", "--maze", "-", "--start", start];
        tolman_fed(maze, &run).refused(2, &[part]);
    }
}

#[test]
fn a_trace_replays_to_the_bit() {
    let folder = folder("trace");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let run = ["run", "avoid", "--maze", "corridor.maze", "--json"];
    let told = tolman_in(&folder, &[&run[..], &["--trace", "run.jsonl"]].concat()).done();
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    let trace = fs::read(folder.join("run.jsonl")).unwrap();
    let again = tolman_sim::trace::replay::<LaserPioneer>(trace.as_slice()).unwrap();
    assert_eq!(told["steps"], again.tick());
}

#[test]
fn rays_by_parry2d_make_a_run_alike() {
    let run = |caster| {
        let told = run(&["--start", "marked", "--json", "--caster", caster]).done();
        let told: serde_json::Value = serde_json::from_str(&told).unwrap();
        assert_eq!(told["reached"], true, "{caster}");
        told["steps"].as_u64().unwrap()
    };
    assert!(run("built-in").abs_diff(run("parry2d")) <= 1);
}

#[test]
fn results_name_the_caster_they_were_made_with() {
    let folder = folder("caster");
    let results = |caster| {
        let words = "experiment baselines --quick --runs 1 --maze corridor.maze --out";
        let words: Vec<&str> = words.split(' ').collect();
        let mine = folder.join(caster);
        let out = mine.to_str().unwrap();
        tolman_in(&folder, &[&words[..], &[out, "--caster", caster]].concat());
        let config = fs::read_to_string(mine.join("config.toml")).unwrap();
        let runs = fs::read_to_string(mine.join("runs.jsonl")).unwrap();
        (config, runs.lines().count())
    };
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let (usual, rows) = results("built-in");
    let (parry, same_rows) = results("parry2d");
    assert!(!usual.contains("--caster"), "{usual}");
    assert!(parry.contains("--caster parry2d"), "{parry}");
    assert!(parry.contains("caster = \"parry2d\""), "{parry}");
    assert_eq!(rows, same_rows);
}
