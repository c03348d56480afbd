//! Errors that say what was meant, and what takes a file of another kind.

use crate::{CORRIDOR, folder, tolman, tolman_in};

#[test]
fn what_was_probably_meant_is_named() {
    for (words, meant) in [
        (&["expermient"][..], "experiment"),
        (&["experiment", "basleines"], "did you mean baselines?"),
        (&["experiment", "baselines", "--rusn", "3"], "--runs"),
        (
            &["experiment", "baselines", "--table", "2 (I)"],
            "did you mean 2 (J)?",
        ),
        (
            &["experiment", "baselines", "--replay", "2 (J)", "Avoit", "0"],
            "did you mean Avoid?",
        ),
        (
            &[
                "learn",
                "--system",
                "mslts",
                "--maze",
                "none.maze",
                "--out",
                "map.json",
            ],
            "did you mean mslst?",
        ),
        (
            &["arena", "--system", "cmp-better"],
            "did you mean cpm-better?",
        ),
        (&["arena", "--family", "ofice"], "did you mean office?"),
    ] {
        tolman(words).refused(2, &[meant]);
    }
}

#[test]
fn a_robot_that_was_probably_meant_is_named() {
    let folder = folder("meant-robot");
    std::fs::write(folder.join("corridor.maze"), CORRIDOR).unwrap();
    let words = ["learn", "--system", "mslst", "--maze", "corridor.maze"];
    let more = ["--robot", "lazer-pioneer", "--out", "map.json"];
    tolman_in(&folder, &[&words[..], &more].concat()).refused(2, &["did you mean laser-pioneer?"]);
}

#[test]
fn the_tour_takes_no_number_of_runs_and_names_the_flag_that_does() {
    tolman(&["experiment", "--runs", "3"]).refused(2, &["--all"]);
}

#[test]
fn a_file_of_another_kind_is_named_with_the_verb_that_takes_it() {
    let folder = folder("kinds");
    std::fs::write(folder.join("a.maze"), CORRIDOR).unwrap();
    let map = r#"{"format":"tolman-map","version":1}"#;
    std::fs::write(folder.join("map.json"), map).unwrap();
    let world = r#"{"format":"tolman-world","version":1,"walls":[]}"#;
    std::fs::write(folder.join("world.json"), world).unwrap();
    std::fs::write(folder.join("a.log"), "# CARMEN\nPARAM a 1 nohost 0\n").unwrap();
    std::fs::write(folder.join("log.gz"), [0x1f, 0x8b, 8, 0]).unwrap();
    let run = "run avoid --maze a.maze --steps 3 --trace trace.jsonl";
    let words: Vec<&str> = run.split(' ').collect();
    tolman_in(&folder, &words).failed(1, &[]);
    for (words, is, taken_by) in [
        ("map show a.maze", "a.maze is a maze", "tolman maze show"),
        (
            "maze check map.json",
            "map.json is a learned map",
            "tolman map show",
        ),
        (
            "maze show trace.jsonl",
            "trace.jsonl is a trace",
            "tolman replay",
        ),
        (
            "maze show world.json",
            "is a world with free walls",
            "--world",
        ),
        ("replay a.maze --out a.html", "a.maze is a maze", "--maze"),
        ("map show trace.jsonl", "is a trace", "tolman replay"),
        (
            "maze show a.log",
            "a.log is a robot's log",
            "tolman map --log",
        ),
        (
            "map show a.log",
            "a.log is a robot's log",
            "tolman map --log",
        ),
        ("maze show log.gz", "is packed by gzip", "tolman map --log"),
        ("map show log.gz", "is packed by gzip", "gunzip"),
        (
            "experiment mslst --maze map.json",
            "is a learned map",
            "map show",
        ),
        (
            "experiment mslst --maze log.gz",
            "is packed by gzip",
            "tolman map --log",
        ),
        (
            "map --log a.maze --out o",
            "a.maze is a maze",
            "tolman maze",
        ),
        ("map --log map.json --out o", "is a learned map", "map show"),
        ("run avoid --world a.maze", "a.maze is a maze", "--maze"),
    ] {
        let words: Vec<&str> = words.split(' ').collect();
        tolman_in(&folder, &words).failed(2, &[is, taken_by]);
    }
}
