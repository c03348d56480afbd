#[cfg(unix)]
use core::time::Duration;
use std::fs;
use std::path::Path;
#[cfg(unix)]
use std::process::{Command, Stdio};
#[cfg(unix)]
use std::thread::sleep;

use serde_json::Value;

use crate::{CORRIDOR, folder, tolman, tolman_in};
#[cfg(unix)]
use crate::{Ended, command_in};

/// Returns two runs of each row of the baselines in the corridor, results in `out`.
fn baselines(folder: &Path, out: &str, more: &[&str]) -> crate::Ended {
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let usual = [
        "experiment",
        "baselines",
        "--maze",
        "corridor.maze",
        "--runs",
        "2",
        "--out",
        out,
    ];
    tolman_in(folder, &[&usual[..], more].concat())
}

#[test]
fn the_list_names_what_there_is() {
    assert!(
        tolman(&["experiment", "--list"])
            .done()
            .contains("baselines")
    );
}

#[test]
#[ignore = "takes a minute: cargo test -p tolman --test cli -- --ignored tour"]
fn alone_it_is_a_demo_and_a_table_of_all_systems() {
    let folder = folder("tour");
    let ended = tolman_in(&folder, &["experiment"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for part in [
        "tour/demo.html",
        "MSLST Better    arrives in random mazes",
        "matches",
        "experiment --all",
    ] {
        assert!(ended.out.contains(part), "no {part} in:\n{}", ended.out);
    }
    let table = ended.out.lines().skip_while(|line| !line.is_empty());
    for line in table {
        assert!(line.chars().count() <= 80, "{line}");
    }
    let page = fs::read_to_string(folder.join("results/tour/report.html")).unwrap();
    assert!(folder.join("results/tour/demo.html").is_file());
    for name in ["mslst-2-j", "cpm-aliased", "gngslam-online"] {
        assert!(page.contains(&format!("{name}/report.html")), "{name}");
        let own = folder.join("results/tour").join(name).join("report.html");
        assert!(own.is_file(), "{name}");
    }
}

#[test]
fn a_folder_of_results_is_written() {
    let folder = folder("results");
    let shown = baselines(&folder, "out", &[]).done();
    for part in ["Avoid", "Wall-follow", "Random", "Oracle", "report.html"] {
        assert!(shown.contains(part), "no {part} in:\n{shown}");
    }
    let out = folder.join("out");
    for name in ["report.html", "summary.json", "runs.jsonl", "config.toml"] {
        assert!(fs::metadata(out.join(name)).unwrap().len() > 100, "{name}");
    }
    assert_ne!(fs::read_dir(out.join("figures")).unwrap().count(), 0);
}

#[test]
fn two_folders_are_compared() {
    let folder = folder("compare");
    baselines(&folder, "one", &[]).done();
    baselines(&folder, "two", &["--jobs", "1"]).done();
    baselines(&folder, "three", &["--seed", "2"]).done();
    let compare = |a, b| tolman_in(&folder, &["experiment", "--compare", a, b]);
    assert!(
        compare("one", "two")
            .done()
            .contains("one and two agree in all")
    );
    compare("one", "three").refused(1, &["one and three differ", "row Avoid: seed is"]);
    compare("one", "four").refused(1, &["four/runs.jsonl"]);
}

#[test]
fn a_folder_is_verified() {
    let folder = folder("verify");
    baselines(&folder, "one", &[]).done();
    let verify = [
        "experiment",
        "baselines",
        "--maze",
        "corridor.maze",
        "--verify",
        "one",
    ];
    let told = tolman_in(&folder, &verify);
    assert_eq!(told.code, Some(0), "{}", told.err);
    assert!(told.out.contains("were played again and agree to the bit"));
    let file = folder.join("one/runs.jsonl");
    let whole = fs::read_to_string(&file).unwrap();
    let flipped = whole.replacen("\"steps\":12,", "\"steps\":13,", 1);
    assert_ne!(flipped, whole);
    fs::write(&file, flipped).unwrap();
    tolman_in(&folder, &verify).refused(1, &["runs.jsonl, line", "checksum"]);
    assert_ne!(
        fs::read_to_string(&file).unwrap(),
        whole,
        "nothing is mended"
    );
    tolman_in(&folder, &[&verify[..], &["--seed", "2"]].concat()).refused(2, &["seed 1"]);
}

#[test]
fn json_is_the_summary() {
    let folder = folder("json");
    let shown = baselines(&folder, "out", &["--json"]).done();
    assert_eq!(
        shown,
        fs::read_to_string(folder.join("out/summary.json")).unwrap()
    );
    let shown: Value = serde_json::from_str(&shown).unwrap();
    assert_eq!(shown["experiment"], "baselines");
    assert_eq!(shown["seed"], 1);
    assert!(!shown["rows"].as_array().unwrap().is_empty());
}

#[test]
fn the_number_of_jobs_changes_nothing() {
    let folder = folder("jobs");
    baselines(&folder, "one", &["--jobs", "1"]).done();
    baselines(&folder, "two", &["--jobs", "2"]).done();
    let runs = |out: &str| fs::read_to_string(folder.join(out).join("runs.jsonl")).unwrap();
    assert_eq!(runs("one"), runs("two"));
}

#[test]
fn a_limit_of_the_caller_ends_runs() {
    let folder = folder("limit");
    baselines(&folder, "out", &["--limit", "3"]).done();
    let runs = fs::read_to_string(folder.join("out/runs.jsonl")).unwrap();
    for line in runs.lines().filter(|line| line.contains("\"steps\"")) {
        let run: Value = serde_json::from_str(line).unwrap();
        assert!(run["steps"].as_u64().unwrap() <= 3, "{line}");
    }
    let config = fs::read_to_string(folder.join("out/config.toml")).unwrap();
    assert!(config.contains("--limit 3"), "{config}");
    baselines(&folder, "none", &["--limit", "0"]).refused(2, &["--limit"]);
}

#[test]
fn a_broken_line_is_reported_and_its_run_made_again() {
    let folder = folder("broken");
    baselines(&folder, "out", &[]).done();
    let file = folder.join("out/runs.jsonl");
    let whole = fs::read_to_string(&file).unwrap();
    fs::write(&file, &whole[..whole.len() - 20]).unwrap();
    let ended = baselines(&folder, "out", &[]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("played again"), "{}", ended.err);
    assert_eq!(fs::read_to_string(&file).unwrap(), whole);
}

#[test]
#[cfg(unix)]
fn an_interrupted_experiment_says_how_it_goes_on() {
    let folder = folder("interrupted");
    fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let experiment = "experiment baselines --maze corridor.maze --runs 100000 --out out";
    let experiment: Vec<&str> = experiment.split(' ').collect();
    let mut child = command_in(&folder, &experiment)
        .env_remove("CARGO")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let runs = folder.join("out/runs.jsonl");
    while !fs::metadata(&runs).is_ok_and(|runs| runs.len() > 0) {
        assert_eq!(child.try_wait().unwrap(), None, "it ended by itself");
        sleep(Duration::from_millis(10));
    }
    let id = child.id().to_string();
    let killed = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(killed.success());
    let told = Ended::from(child.wait_with_output().unwrap());
    told.refused(
        130,
        &[
            "stopped after",
            "go on from there with: tolman experiment baselines --maze corridor.maze",
        ],
    );
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn bad_input_is_refused() {
    tolman(&["experiment", "genius"]).refused(2, &["genius", "baselines"]);
    tolman(&["experiment", "baselines", "--runs", "0"]).refused(2, &["--runs"]);
    tolman(&["experiment", "baselines", "--jobs", "0"]).refused(2, &["--jobs"]);
    tolman(&["experiment", "baselines", "--runs=-1"]).refused(2, &["--runs"]);
    tolman(&["experiment", "baselines", "--maze", "gone.maze"]).refused(2, &["gone.maze"]);
}

#[test]
fn a_maze_the_robot_does_not_fit_is_refused() {
    let folder = folder("narrow");
    fs::write(folder.join("narrow.maze"), CORRIDOR.replace("0.95", "0.3")).unwrap();
    tolman_in(
        &folder,
        &[
            "experiment",
            "baselines",
            "--maze",
            "narrow.maze",
            "--out",
            "out",
        ],
    )
    .refused(2, &["narrow.maze", "does not fit"]);
    assert!(!folder.join("out").exists(), "nothing half-written");
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = folder("unwritable");
    baselines(&folder, "corridor.maze/out", &[]).refused(2, &["corridor.maze/out"]);
}

#[test]
fn a_folder_of_something_else_is_left_alone() {
    let folder = folder("foreign");
    fs::create_dir(folder.join("out")).unwrap();
    fs::write(folder.join("out/thesis.tex"), "precious").unwrap();
    baselines(&folder, "out", &[]).refused(2, &["thesis.tex"]);
    assert_eq!(fs::read_dir(folder.join("out")).unwrap().count(), 1);
}

#[test]
fn a_table_is_filled_alone_and_the_others_runs_are_kept() {
    let folder = folder("table");
    let all = baselines(&folder, "out", &["--json"]).done();
    let tables = |summary: &str| {
        let summary: Value = serde_json::from_str(summary).unwrap();
        let rows = summary["rows"].as_array().unwrap().clone();
        let mut tables: Vec<String> = rows
            .iter()
            .map(|row| row["table"].as_str().unwrap().to_owned())
            .collect();
        tables.dedup();
        tables
    };
    let both = tables(&all);
    assert_eq!(both.len(), 2, "{both:?}");
    let chosen = ["--table", &both[1], "--json"];
    let one = baselines(&folder, "out", &chosen);
    assert_eq!(one.code, Some(0), "{}", one.err);
    assert_eq!(tables(&one.out), both[1..]);
    // Of that table one row.
    let row = |summary: &str| {
        let summary: Value = serde_json::from_str(summary).unwrap();
        let rows = summary["rows"].as_array().unwrap().clone();
        rows.iter()
            .map(|row| row["row"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    let first = row(&one.out)[0].clone();
    let alone = baselines(&folder, "out", &[&chosen[..], &["--row", &first]].concat());
    assert_eq!(alone.code, Some(0), "{}", alone.err);
    assert!(
        row(&alone.out).iter().all(|name| *name == first),
        "{}",
        alone.out
    );
    baselines(&folder, "out", &["--row", "nope"]).refused(2, &["nope", &first]);
    // All runs are still there, so that none is played.
    let again = baselines(&folder, "out", &["--json"]);
    assert!(again.err.contains("there from before"), "{}", again.err);
    assert!(!again.err.contains("played"), "{}", again.err);
    assert_eq!(again.out, all);
    // A table that is not there is named with those that are.
    let ended = baselines(&folder, "out", &["--table", "nope"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("\"nope\""), "{}", ended.err);
}

#[test]
fn shares_are_merged_to_what_one_command_makes() {
    let folder = folder("shares");
    baselines(&folder, "one", &[]).done();
    let share = "trial --experiment baselines --maze corridor.maze --runs 2 --out many --chunk";
    let share: Vec<&str> = share.split(' ').collect();
    let share = |chunk: &str| tolman_in(&folder, &[&share[..], &[chunk]].concat());
    share("3/8").done();
    tolman_in(&folder, &["merge", "many"]).refused(2, &["runs are missing", "1/8, 2/8, 4/8"]);
    for number in [1, 2, 4, 5, 6, 7, 8] {
        share(&format!("{number}/8")).done();
    }
    let merged = tolman_in(&folder, &["merge", "many"]);
    assert_eq!(merged.code, Some(0), "{}", merged.err);
    assert!(
        merged.out.contains("The report: many/report.html"),
        "{}",
        merged.out
    );
    for name in ["runs.jsonl", "summary.json"] {
        let read = |out: &str| fs::read_to_string(folder.join(out).join(name)).unwrap();
        assert_eq!(read("one"), read("many"), "{name}");
    }
    share("9/8").refused(2, &["9/8", "such as 3/8"]);
    tolman_in(&folder, &["merge", "one"]).refused(2, &["there are no chunks in one"]);
}
